// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Bytes as text.
#ifndef POWER_RTF_TOOLS_BASE64_H
#define POWER_RTF_TOOLS_BASE64_H

#include <cstddef>
#include <string>
#include <string_view>

namespace tools {

/// The first `count` bytes of texts in Base64 that follow one another, or all there are. Blanks are
/// passed over; the first other character that is no digit ends the texts.
inline std::string from_base64(std::string_view text, std::size_t count)
{
  const auto digit_of = [](char c) {
    return c >= 'A' && c <= 'Z'   ? c - 'A'
           : c >= 'a' && c <= 'z' ? c - 'a' + 26
           : c >= '0' && c <= '9' ? c - '0' + 52
           : c == '+'             ? 62
           : c == '/'             ? 63
                                  : -1;
  };
  std::string bytes;
  unsigned bits = 0, size = 0; // what is left of the digits so far
  for (const char c : text) {
    if (bytes.size() >= count) break;
    const int digit = digit_of(c);
    if (c == '=') size = 0; // the end of a text
    if (digit < 0 && std::string_view("= \t\r\n").find(c) == std::string_view::npos) break;
    if (digit < 0) continue;
    bits = bits << 6 | static_cast<unsigned>(digit);
    size += 6;
    if (size < 8) continue;
    size -= 8;
    bytes += static_cast<char>(bits >> size);
  }
  return bytes;
}

inline std::string to_base64(std::string_view bytes)
{
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

} // namespace tools

#endif // POWER_RTF_TOOLS_BASE64_H
