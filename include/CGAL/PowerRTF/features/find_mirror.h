// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plane that a surface is symmetric about. Only planes across an axis come into question: about
// another one, numbers of finite precision have no exact images. Such a plane is that through the
// origin, through the middle of the bounding box or through the center of gravity of the surface.
#ifndef CGAL_POWER_RTF_FEATURES_FIND_MIRROR_H
#define CGAL_POWER_RTF_FEATURES_FIND_MIRROR_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/bounding_box.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// A plane, and the point whose image is farthest from the surface.
struct Mirror_candidate {
  Mirror_plane plane{0, 0};
  Vec3d farthest{0, 0, 0};
  double squared_deviation = std::numeric_limits<double>::infinity();
};

class Mirror_search {
public:
  /// \param spacing of the samples
  Mirror_search(const Surface& surface, double spacing, Concurrency concurrency)
      : m_surface(surface), m_tree(surface.points, surface.triangles, {}, concurrency),
        m_box(bounding_box(surface.points, surface.triangles, concurrency)), m_spacing(spacing),
        m_concurrency(concurrency)
  {
    for (std::size_t f = 0; f < surface.triangles.size(); ++f)
      for (const int v : surface.triangles[f])
        m_center += (surface.facet_areas[f] / (3 * surface.area)) * surface.points[v];
  }

  /// Whether all lies in one plane across `axis`, as nearly as may be.
  bool is_flat(int axis) const
  {
    return Mirror_plane::coordinate(m_box.hi - m_box.lo, axis) <= tolerance();
  }

  /// The best plane across `axis`, unless `best` is as good.
  void look_across(int axis, Mirror_candidate& best) const
  {
    const Normalization& normalization = m_surface.normalization;
    const auto coordinate = [&](const Vec3d& point) {
      return Mirror_plane::coordinate(normalization.snapped(point), axis);
    };
    const double middle = coordinate(0.5 * (m_box.lo + m_box.hi)),
                 origin = coordinate(normalization.to_inside({0, 0, 0}));
    std::vector<double> seen;
    for (const double at : {origin, middle, coordinate(m_center)}) {
      // The image of the box is off it by twice as much; one plane is for the message.
      const bool is_off = 2 * std::abs(at - middle) > tolerance() && at != middle;
      if (is_off || std::any_of(seen.begin(), seen.end(), [&](double other) {
            return std::abs(at - other) < unseen * m_spacing;
          }))
        continue;
      seen.push_back(at);
      const Mirror_candidate candidate = judged({axis, at});
      if (rank(candidate) < rank(best)) best = candidate;
    }
  }

  double tolerance() const { return m_spacing / 2; }
  double deviation(const Mirror_candidate& c) const { return std::sqrt(c.squared_deviation); }

  /// In words, why the best is not good enough.
  std::string reason(const Mirror_candidate& best, bool is_given) const
  {
    const double unit = 1 / m_surface.normalization.scale;
    const Vec3d p = m_surface.normalization.to_outside(best.farthest);
    const Vec3d on_plane = m_surface.normalization.to_outside(best.plane.foot({0, 0, 0}));
    std::ostringstream text;
    text << "the surface is not symmetric about ";
    if (!is_given) text << "any plane across an axis; the best is ";
    text << "the plane "
         << "xyz"[best.plane.axis] << " = " << Mirror_plane::coordinate(on_plane, best.plane.axis)
         << ": the mirror image of its point (" << p.x << ", " << p.y << ", " << p.z << ") is "
         << deviation(best) * unit << " away from it, but may be no more than "
         << tolerance() * unit << ", half the spacing of the samples";
    return text.str();
  }

private:
  /// In units of the spacing. Deviations that no one sees are equal: of planes about which a
  /// surface is symmetric up to rounding, the first one counts.
  static constexpr double unseen = 0.01;

  double rank(const Mirror_candidate& c) const
  {
    return (std::max)(deviation(c), unseen * m_spacing);
  }

  Mirror_candidate judged(const Mirror_plane& plane) const
  {
    const auto look_at = [&](Mirror_candidate& farthest, const Vec3d& p) {
      const double d = m_tree.nearest_anywhere(plane.image(p)).squared_distance;
      if (d > farthest.squared_deviation) farthest = {plane, p, d};
    };
    const int vertices = static_cast<int>(m_surface.points.size()),
              facets = static_cast<int>(m_surface.triangles.size());
    return reduce(
        m_concurrency, vertices + facets, Mirror_candidate{plane, {0, 0, 0}, -1},
        [&](Mirror_candidate& farthest, int i) {
          if (i < vertices)
            look_at(farthest, m_surface.points[i]);
          else
            for_each_point(i - vertices, [&](const Vec3d& p) { look_at(farthest, p); });
        },
        [](Mirror_candidate& farthest, const Mirror_candidate& part) {
          if (part.squared_deviation > farthest.squared_deviation) farthest = part;
        });
  }

  /// Calls `f` for points of a facet that is larger than the spacing, no farther apart than that.
  template <class F>
  void for_each_point(int facet, F&& f) const
  {
    constexpr double most = 64; // on a side
    const Triangle& t = m_surface.triangles[facet];
    const Vec3d &a = m_surface.points[t[0]], ab = m_surface.points[t[1]] - a,
                ac = m_surface.points[t[2]] - a;
    const double longest =
        std::sqrt((std::max)({squared_length(ab), squared_length(ac), squared_length(ac - ab)}));
    const int parts = static_cast<int>((std::min)(std::ceil(longest / m_spacing), most));
    if (parts <= 1) return;
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j) f(a + (1. * i / parts) * ab + (1. * j / parts) * ac);
  }

  const Surface& m_surface;
  Facet_tree m_tree;
  Box3<double> m_box;
  Vec3d m_center{0, 0, 0}; // of gravity
  double m_spacing;
  Concurrency m_concurrency;
};

} // namespace internal

/// The plane of symmetry of `surface`, on the grid of the result's points.
/// \param wanted across which axis; not `none`
/// \param spacing of the samples, of which the image of no point may be off by more than a half
/// \throws Invalid_input_error the surface is not as symmetric as that, or lies in the plane
inline Mirror_plane find_mirror(const Surface& surface, Symmetry wanted, double spacing,
                                Symmetry_report& report,
                                internal::Concurrency concurrency = Sequential_tag())
{
  const internal::Mirror_search search(surface, spacing, concurrency);
  internal::Mirror_candidate best;
  const bool is_given = wanted != Symmetry::automatic;
  for (int axis = 0; axis < 3; ++axis) {
    if (is_given && static_cast<int>(wanted) != static_cast<int>(Symmetry::x) + axis) continue;
    if (!search.is_flat(axis))
      search.look_across(axis, best);
    else if (is_given)
      throw Invalid_input_error("the surface lies in the plane that it would be symmetric about");
  }
  if (search.deviation(best) > search.tolerance())
    throw Invalid_input_error(search.reason(best, is_given));
  const Vec3d on_plane = surface.normalization.to_outside(best.plane.foot({0, 0, 0}));
  report.axis = "xyz"[best.plane.axis];
  report.at = Mirror_plane::coordinate(on_plane, best.plane.axis);
  report.deviation = search.deviation(best) / surface.normalization.scale;
  return best.plane;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_FIND_MIRROR_H
