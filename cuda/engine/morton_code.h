// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CUDA_MORTON_CODE_H
#define CGAL_POWER_RTF_CUDA_MORTON_CODE_H

#include <CGAL/PowerRTF/cells/vector.h>

#include <cstdint>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// Every third bit of the result is one of the 21 low bits of `x`.
CGAL_POWER_RTF_HD inline std::uint64_t spread_bits(std::uint64_t x)
{
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  x = (x | x << 2) & 0x1249249249249249ull;
  return x;
}

/// Position of a point of [-1, 1)^3 along the Morton curve of 2^63 cubes.
template <class Real>
CGAL_POWER_RTF_HD inline std::uint64_t morton_code(const Vec3<Real>& p)
{
  const auto cell = [](Real x) {
    const double at = (double(x) + 1) * 0x1p20;
    return spread_bits(at > 0 ? at < 0x1p21 ? std::uint64_t(at) : 0x1fffffu : 0u);
  };
  return cell(p.x) | cell(p.y) << 1 | cell(p.z) << 2;
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_MORTON_CODE_H
