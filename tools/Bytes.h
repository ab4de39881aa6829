// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers from bytes, the same on machines of either byte order.
#ifndef POWER_RTF_TOOLS_BYTES_H
#define POWER_RTF_TOOLS_BYTES_H

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace tools {

/// The bits of a number of at most eight bytes.
inline std::uint64_t bits_of_bytes(std::string_view bytes, bool big_endian)
{
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bits = bits << 8 | static_cast<unsigned char>(bytes[big_endian ? i : bytes.size() - 1 - i]);
  return bits;
}

/// The number with the same bits.
template <class To, class From>
To bit_cast(From from)
{
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof(to));
  return to;
}

} // namespace tools

#endif // POWER_RTF_TOOLS_BYTES_H
