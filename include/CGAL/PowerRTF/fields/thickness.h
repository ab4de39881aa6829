// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How thick a surface is where it turns around: at fingers, the rims of plates, in grooves. A walk
// straight ahead, in a plane through a facet's normal, comes back on the other side there, after a
// way that is not much longer than the thickness. The two sides of a plate far from its rim do not
// count, nor do those of a sharp edge, which come together: triangles have room there.
#ifndef CGAL_POWER_RTF_FIELDS_THICKNESS_H
#define CGAL_POWER_RTF_FIELDS_THICKNESS_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/internal/mixed_bits.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// Walks on a surface, to its borders.
class Section_walker {
public:
  static constexpr double any = std::numeric_limits<double>::infinity();

  explicit Section_walker(const Surface& surface) : m(surface) {}

  /// The least distance from facet `f` to the other side; infinity: it is larger than `most`.
  double thickness(int f, double most) const
  {
    const auto [a, b, c] = m.triangles[f];
    const Vec3d center = (m.points[a] + m.points[b] + m.points[c]) * (1. / 3);
    double least = from(center, f, most);
    for (int h = 3 * f; h < 3 * f + 3; ++h) { // there the facet may be long against the thickness
      if (!is_bent(h)) continue;
      const Vec3d middle = 0.5 * (m.points[halfedge_source(m.triangles, h)] +
                                  m.points[halfedge_target(m.triangles, h)]);
      least = (std::min)(least, from(middle + 0.1 * (center - middle), f, (std::min)(least, most)));
    }
    return least;
  }

private:
  static constexpr int directions = 8;
  static constexpr double longest_way = 3;   // to the other side, over the thickness
  static constexpr double opposite = -0.766; // cosine of 140 degrees
  static constexpr double least_straight =
      0.7; // cosine of 45 degrees: through the surface, not along

  bool is_bent(int h) const
  {
    constexpr double bent = 0.94; // cosine of 20 degrees
    const int o = m.adjacency.opposite[h];
    return o != Facet_adjacency::none && dot(m.facet_normals[h / 3], m.facet_normals[o / 3]) < bent;
  }

  double from(const Vec3d& start, int f, double most) const
  {
    constexpr double pi = 3.14159265358979323846;
    const Vec3d u = normalized(m.points[m.triangles[f][1]] - m.points[m.triangles[f][0]]),
                w = cross(m.facet_normals[f], u);
    double least = any;
    for (int k = 0; k < directions; ++k) {
      const double angle = 2 * pi * (k + 0.5) / directions; // 0: along an edge
      least = (std::min)(least, in_plane(start, f, std::cos(angle) * u + std::sin(angle) * w,
                                         (std::min)(least, most)));
    }
    return least;
  }

  /// Goes to one side in the plane through `start` that is orthogonal to `across`.
  double in_plane(const Vec3d& start, int f, const Vec3d& across, double most) const
  {
    const auto side = [&](int v) { return dot(across, m.points[v] - start); };
    const auto is_exit = [&](int h) {
      return side(halfedge_source(m.triangles, h)) < 0 &&
             side(halfedge_target(m.triangles, h)) >= 0;
    };
    int h = 3 * f;
    while (!is_exit(h))
      if (++h == 3 * f + 3) return any;
    const int first = h;
    Vec3d at = start;
    for (double way = 0; way <= longest_way * most;) {
      const int a = halfedge_source(m.triangles, h), b = halfedge_target(m.triangles, h);
      const double share = side(a) / (side(a) - side(b));
      const Vec3d before = at, step = m.points[a] + share * (m.points[b] - m.points[a]) - before;
      const double size = length(step);
      if (size > 0 && dot(m.facet_normals[h / 3], m.facet_normals[f]) < opposite) {
        const double nearest = std::clamp(dot(start - before, step) / (size * size), 0., 1.);
        const Vec3d through = before + nearest * step - start;
        const double d = length(through), straight = std::abs(dot(through, m.facet_normals[f]));
        if (d < most && way + nearest * size <= longest_way * d && straight >= least_straight * d)
          return d;
      }
      way += size;
      at = before + step;
      const int entry = m.adjacency.opposite[h];
      if (entry == Facet_adjacency::none) return any;
      h = is_exit(next_halfedge(entry)) ? next_halfedge(entry) : previous_halfedge(entry);
      if (h == first) return any; // all around, which may be no way where a vertex is in the plane
    }
    return any;
  }

  const Surface& m;
};

} // namespace internal

/// Sets those of `thickness`, by facet, that are negative, to the thickness of `patches`, a surface
/// cut along its creases: as far as it is at most `most(f)`, and infinity elsewhere, as on those of
/// very many facets that are not looked at.
/// \param n of samples: for each of them so many facets are looked at
template <class Most>
void find_thickness(const Surface& patches, std::size_t n, const Most& most,
                    std::vector<double>& thickness,
                    internal::Concurrency concurrency = Sequential_tag())
{
  constexpr std::size_t facets_per_sample = 64;
  const internal::Section_walker walker(patches);
  const std::uint64_t stride = 1 + thickness.size() / (facets_per_sample * n);
  internal::for_each_index(concurrency, static_cast<int>(thickness.size()), [&](int f) {
    if (!(thickness[f] < 0)) return;
    const bool is_looked_at = internal::mixed_bits(static_cast<std::uint64_t>(f)) % stride == 0;
    thickness[f] = is_looked_at ? walker.thickness(f, most(f)) : internal::Section_walker::any;
  });
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_THICKNESS_H
