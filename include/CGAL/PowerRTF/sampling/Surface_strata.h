// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stratified points of a surface: one in each of many parts of equal mass. (How it is unrolled for
// that: unroll_surface.h.)
#ifndef CGAL_POWER_RTF_SAMPLING_SURFACE_STRATA_H
#define CGAL_POWER_RTF_SAMPLING_SURFACE_STRATA_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/host_device.h>
#include <CGAL/PowerRTF/sampling/random_source.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace CGAL::PowerRTF {

/// Maps a surface to the cube [-1, 1]^3 around it, where neither its size nor its position decides
/// anything.
struct Surface_cube {
  Vec3d middle;
  double scale;

  CGAL_POWER_RTF_HD Vec3d to_inside(const Vec3d& p) const { return (p - middle) * scale; }
  CGAL_POWER_RTF_HD Vec3d to_outside(const Vec3d& p) const { return p * (1 / scale) + middle; }
};

inline Surface_cube cube_around(const Box3<double>& box)
{
  const Vec3d size = box.hi - box.lo;
  return {0.5 * (box.lo + box.hi), 2 / (std::max)({size.x, size.y, size.z})};
}

/// A surface unrolled: its facets component by component, in spatial order, and each facet along
/// the curve that bisects it again and again (Sierpinski's). Where parts of equal mass follow each
/// other along that curve, each is in one piece and about as wide as it is long. Non-owning.
struct Strata_view {
  struct Point {
    int at;        ///< the place of its facet among those that are unrolled
    Vec3d weights; ///< barycentric coordinates
  };

  int size = 0;                    ///< facets
  const int* bases = nullptr;      ///< longest edges: edge i of facet f is 3 f + i
  const int* components = nullptr; ///< of the facets
  const double* sums = nullptr;    ///< of the masses of the facets before; at last, of all

  CGAL_POWER_RTF_HD double mass() const { return sums[size]; }
  CGAL_POWER_RTF_HD int facet(int at) const { return bases[at] / 3; }

  /// The place of the facet with `point(index, count, seed)`.
  CGAL_POWER_RTF_HD int place(std::size_t index, std::size_t count, std::uint64_t seed) const
  {
    const double sum = sum_before(index, count, seed);
    int begin = 1, end = size;
    while (begin < end) {
      const int middle = begin + (end - begin) / 2;
      if (sum < sums[middle])
        end = middle;
      else
        begin = middle + 1;
    }
    return begin - 1;
  }

  /// A point at random in the `index`-th of `count` parts of equal mass. `densities`: function
  /// facet -> those at its three corners.
  template <class Densities>
  CGAL_POWER_RTF_HD Point point(std::size_t index, std::size_t count, std::uint64_t seed,
                                const Densities& densities) const
  {
    const int at = place(index, count, seed), longest = bases[at] % 3;
    const Vec3d density = densities(facet(at));
    const double mass_of_facet = sums[at + 1] - sums[at];
    double share = (sum_before(index, count, seed) - sums[at]) / mass_of_facet;
    double left = mass_of_facet / (mass() / double(count)); // parts in what is left of the facet
    Corners corners{corner(longest), corner((longest + 1) % 3), corner((longest + 2) % 3)};
    for (; left > 1; left /= 2) {
      const double first = share_of_first_half(corners, density);
      const bool goes_first = share < first;
      share = goes_first ? share / first : (share - first) / (1 - first);
      corners = half(corners, goes_first);
    }
    // Uniform in the triangle that is left.
    double a = counted_random(seed, index, 1), b = counted_random(seed, index, 2);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    return {at, (1 - a - b) * corners.from + a * corners.to + b * corners.apex};
  }

private:
  /// Barycentric coordinates. The curve through a triangle runs from the base's first end to its
  /// second; halved at the middle of the base, it passes the apex.
  struct Corners {
    Vec3d from, to, apex;
    CGAL_POWER_RTF_HD Vec3d middle() const { return 0.5 * (from + to); }
  };

  CGAL_POWER_RTF_HD double sum_before(std::size_t index, std::size_t count,
                                      std::uint64_t seed) const
  {
    return mass() / double(count) * (double(index) + counted_random(seed, index, 0));
  }

  CGAL_POWER_RTF_HD static Vec3d corner(int i)
  {
    return {double(i == 0), double(i == 1), double(i == 2)};
  }

  CGAL_POWER_RTF_HD static Corners half(const Corners& c, bool first)
  {
    return first ? Corners{c.from, c.apex, c.middle()} : Corners{c.apex, c.to, c.middle()};
  }

  CGAL_POWER_RTF_HD static double share_of_first_half(const Corners& c, const Vec3d& density)
  {
    const double a = dot(c.from, density), b = dot(c.to, density), apex = dot(c.apex, density),
                 m = (a + b) / 2;
    return (a + m + apex) / (a + b + 2 * (m + apex));
  }
};

/// Owns what is behind a `Strata_view`.
struct Surface_strata {
  internal::Unset_vector<int> bases, components;
  internal::Unset_vector<double> sums;

  Strata_view view() const
  {
    return {static_cast<int>(bases.size()), bases.data(), components.data(), sums.data()};
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_SURFACE_STRATA_H
