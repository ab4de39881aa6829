// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for cured_soup.h.
#ifndef CGAL_POWER_RTF_INPUT_CURED_SOUP_IMPL_H
#define CGAL_POWER_RTF_INPUT_CURED_SOUP_IMPL_H

#include <CGAL/PowerRTF/geometry/degenerate_facets.h>
#include <CGAL/PowerRTF/input/cured_soup.h>
#include <CGAL/PowerRTF/input/near_borders.h>
#include <CGAL/PowerRTF/input/resolve_intersections.h>
#include <CGAL/PowerRTF/input/soup_triangles.h>
#include <CGAL/PowerRTF/input/wrap_triangles.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The triangles of a soup in the unit box, vertices at the same place merged.
inline Triangle_set triangle_set(const Polygon_soup& soup, const Boxed_points& box,
                                 Concurrency concurrency)
{
  Repair_counts of_copy; // what is mended in the result is counted
  const std::vector<int> vertex = first_of_equal_points(box.points, concurrency);
  return {box.points, triangulated(soup, box.points, vertex, of_copy, concurrency)};
}

/// Points and triangles in the input's coordinates.
inline Polygon_soup to_soup(const Triangle_set& set, const Normalization& normalization)
{
  Polygon_soup soup;
  soup.merges_vertices = true;
  for (const Vec3d& p : set.points) soup.points.push_back(normalization.to_outside(p));
  soup.reserve_polygons(set.triangles.size());
  for (const Triangle& t : set.triangles) {
    for (const int v : t) soup.add_corner(v);
    soup.end_polygon();
  }
  return soup;
}

/// The edges' length that `options` asks for, or about that of as many samples.
inline double spacing_asked_for(const Triangle_set& set, const Remeshing_options& options,
                                double diagonal, double scale)
{
  if (options.edge_length > 0) return options.edge_length * scale;
  if (options.relative_edge_length > 0) return options.relative_edge_length * diagonal;
  double area = 0;
  for (const Triangle& t : set.triangles)
    area +=
        length(cross(set.points[t[1]] - set.points[t[0]], set.points[t[2]] - set.points[t[0]])) / 2;
  const double n = options.vertex_share > 0
                       ? options.vertex_share * static_cast<double>(set.points.size())
                       : static_cast<double>(options.number_of_samples);
  return std::sqrt(area / n);
}

/// The radius of the ball that wraps: as the spacing, which shows no more, but from a hundredth to
/// a twentieth of the diagonal. A smaller one takes minutes and enters every crack, a larger one
/// shows nothing of the shape.
inline double wrap_radius(const Triangle_set& set, const Remeshing_options& options, double scale)
{
  if (options.wrap_radius > 0) return options.wrap_radius * scale;
  Box3<double> box{set.points[set.triangles[0][0]], set.points[set.triangles[0][0]]};
  for (const Triangle& t : set.triangles)
    for (const int v : t) box.add(set.points[v]);
  const double diagonal = length(box.hi - box.lo);
  return std::clamp(spacing_asked_for(set, options, diagonal, scale), diagonal / 100,
                    diagonal / 20);
}

/// See `cured_soup()`.
inline Polygon_soup make_cured_soup(const Polygon_soup& soup, const Remeshing_options& options,
                                    Intersection_cure& cure, Concurrency concurrency)
{
  constexpr double radius_over_offset = 30; // as CGAL has it
  const Boxed_points box = boxed_points(soup, concurrency);
  Triangle_set set = triangle_set(soup, box, concurrency);
  if (degenerate_facets(set.points, set.triangles, concurrency).size() == set.triangles.size())
    throw Invalid_input_error("the surface has no area");
  const double grid = box.normalization.grid, scale = box.normalization.scale;
  if (options.intersections == Intersections::resolve) {
    cure.resolved_pairs = resolve_intersections(set, grid, concurrency);
  } else {
    const double radius = wrap_radius(set, options, scale), offset = radius / radius_over_offset;
    set = wrapped_triangles(set, radius, offset, grid);
    cure.wrap_radius = radius / scale;
    cure.wrap_offset = offset / scale;
  }
  return to_soup(set, box.normalization);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INPUT_CURED_SOUP_IMPL_H
