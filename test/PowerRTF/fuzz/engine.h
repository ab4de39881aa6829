// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What fuzzing engines and fuzz targets call each other: https://llvm.org/docs/LibFuzzer.html
#ifndef CGAL_POWER_RTF_TEST_FUZZ_ENGINE_H
#define CGAL_POWER_RTF_TEST_FUZZ_ENGINE_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

extern "C" {
/// The target's: runs one input. -1: it is none, and is not to be kept.
int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
/// The target's: changes an input. Returns its new size, at most `max_size`.
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                    unsigned seed);
/// The engine's: the same, of bytes.
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);
}

namespace fuzz {

inline std::string text_of(const std::uint8_t* data, std::size_t size)
{
  return {reinterpret_cast<const char*>(data), size};
}

/// Puts `text` into the place of an input, which stays as it is if the text is too long.
inline std::size_t replace(std::uint8_t* data, std::size_t size, std::size_t max_size,
                           const std::string& text)
{
  if (text.size() > max_size) return size;
  std::copy(text.begin(), text.end(), data);
  return text.size();
}

} // namespace fuzz

#endif // CGAL_POWER_RTF_TEST_FUZZ_ENGINE_H
