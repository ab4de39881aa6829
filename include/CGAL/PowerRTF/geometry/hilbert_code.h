// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_GEOMETRY_HILBERT_CODE_H
#define CGAL_POWER_RTF_GEOMETRY_HILBERT_CODE_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>

#include <cstdint>

namespace CGAL::PowerRTF {

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

/// Position of a cube, of 2^63, along the Hilbert curve, which has no leaps; its coordinates are
/// below 2^21. (Skilling, "Programming the Hilbert curve", 2004.)
CGAL_POWER_RTF_HD inline std::uint64_t hilbert_index(std::uint32_t i, std::uint32_t j,
                                                     std::uint32_t k)
{
  constexpr int bits = 21;
  std::uint32_t x[3] = {i, j, k};
  for (int bit = bits - 1; bit > 0; --bit)
    for (int axis = 0; axis < 3; ++axis) { // without branches: they would be guessed wrong
      const std::uint32_t below = (1u << bit) - 1, is_set = 0u - (x[axis] >> bit & 1);
      const std::uint32_t exchanged = (x[0] ^ x[axis]) & below & ~is_set;
      x[0] ^= exchanged | (below & is_set);
      x[axis] ^= exchanged;
    }
  x[1] ^= x[0]; // Gray code
  x[2] ^= x[1];
  std::uint32_t t = x[2] >> 1; // becomes the parity of all higher bits
  for (int shift = 1; shift < bits; shift *= 2) t ^= t >> shift;
  return spread_bits(x[0] ^ t) << 2 | spread_bits(x[1] ^ t) << 1 | spread_bits(x[2] ^ t);
}

/// One of the cubes, by its coordinates.
struct Hilbert_cube {
  std::uint32_t i, j, k;
};

/// The cube with a point of [-1, 1)^3. Planes of symmetry, like x = 0, are not sides of cubes:
/// rounding would decide there.
template <class Real>
CGAL_POWER_RTF_HD inline Hilbert_cube hilbert_cube(const Vec3<Real>& p)
{
  const auto cell = [](Real x) {
    const double at = (0.9510565 * double(x) + 1.0190983) * 0x1p20;
    return at > 0 ? at < 0x1p21 ? std::uint32_t(at) : 0x1fffffu : 0u;
  };
  return {cell(p.x), cell(p.y), cell(p.z)};
}

/// The cube around a box, cut up along the curve: no size or position decides the cubes.
class Curve_cube {
public:
  CGAL_POWER_RTF_HD explicit Curve_cube(const Box3<double>& box)
      : m_middle(0.5 * box.lo + 0.5 * box.hi)
  {
    const Vec3d half = 0.5 * box.hi - 0.5 * box.lo;
    m_reach = internal::larger(half.x, internal::larger(half.y, half.z));
  }

  /// The cube with a point of the box.
  CGAL_POWER_RTF_HD Hilbert_cube operator()(const Vec3d& p) const
  {
    const Vec3d at = p - m_middle;
    return m_reach > 0 ? hilbert_cube(Vec3d{at.x / m_reach, at.y / m_reach, at.z / m_reach})
                       : Hilbert_cube{0, 0, 0};
  }

private:
  Vec3d m_middle;
  double m_reach;
};

/// Position along the curve of the cube with a point.
template <class Real>
CGAL_POWER_RTF_HD inline std::uint64_t hilbert_code(const Vec3<Real>& p)
{
  const Hilbert_cube cube = hilbert_cube(p);
  return hilbert_index(cube.i, cube.j, cube.k);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_HILBERT_CODE_H
