// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_MIXED_BITS_H
#define CGAL_POWER_RTF_INTERNAL_MIXED_BITS_H

#include <CGAL/PowerRTF/internal/host_device.h>

#include <cstdint>

namespace CGAL::PowerRTF::internal {

/// A one-to-one map of integers without visible pattern; 0 stays. (The mixing of SplitMix64:
/// Steele, Lea and Flood 2014.)
CGAL_POWER_RTF_HD inline std::uint64_t mixed_bits(std::uint64_t x)
{
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 27) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_MIXED_BITS_H
