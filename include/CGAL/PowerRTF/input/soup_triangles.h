// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The polygons of a soup as triangles, and their points in the unit box.
#ifndef CGAL_POWER_RTF_INPUT_SOUP_TRIANGLES_H
#define CGAL_POWER_RTF_INPUT_SOUP_TRIANGLES_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/degenerate_facets.h>
#include <CGAL/PowerRTF/input/Polygon_soup.h>
#include <CGAL/PowerRTF/input/near_borders.h>
#include <CGAL/PowerRTF/input/polygon_triangulation.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The mapping of the points marked in `used` to the unit box.
inline Normalization unit_box(const std::vector<Vec3d>& points, const std::vector<int>& used,
                              Concurrency concurrency)
{
  const int vertices = static_cast<int>(points.size());
  const std::vector<int> not_finite = select(concurrency, vertices, [&](int v) {
    const Vec3d& p = points[v];
    return used[v] && !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  });
  if (!not_finite.empty())
    throw Invalid_input_error("vertex " + std::to_string(not_finite[0]) +
                              " has a coordinate that is not a finite number");
  const auto first = std::find(used.begin(), used.end(), 1);
  const Vec3d any = first == used.end() ? Vec3d{0, 0, 0} : points[first - used.begin()];
  const Box3<double> box = reduce(
      concurrency, vertices, Box3<double>{any, any},
      [&](Box3<double>& b, int v) {
        if (used[v]) b.add(points[v]);
      },
      [](Box3<double>& b, const Box3<double>& part) { b.add(part); });
  const Vec3d low = box.lo, high = box.hi, size = high - low;
  const double side = (std::max)({size.x, size.y, size.z});
  if (!(side < 1e300)) throw Invalid_input_error("the coordinates are too large");
  if (!(side > 1e-300)) throw Invalid_input_error("the surface has no area");
  int exponent;
  if (std::frexp(side, &exponent) == 0.5) --exponent;
  Normalization result;
  result.scale = std::ldexp(1., -exponent);
  // A vertex of the result may leave the input's box a little.
  for (const double x : {low.x, low.y, low.z, high.x, high.y, high.z})
    result.reach = (std::max)(result.reach, std::abs(x) + side);
  // Floats hold the center, too, where they hold anything like the surface.
  const double coarse = result.spacing<float>(), fine = result.spacing<double>();
  result.center = snapped(low + 0.5 * size, 1024 * coarse < side ? coarse : fine);
  result.grid = fine * result.scale;
  return result;
}

/// Cuts the polygons into triangles of distinct vertices; `vertex[v]` stands for corner `v`.
inline std::vector<Triangle> triangulated(const Polygon_soup& soup,
                                          const std::vector<Vec3d>& points,
                                          const std::vector<int>& vertex, Repair_counts& repairs,
                                          Concurrency concurrency)
{
  std::vector<Triangle> triangles;
  const int polygons = static_cast<int>(soup.first.size()) - 1;
  const auto corner = [&](int k, int i) { return vertex[soup.corners[soup.first[k] + i]]; };
  const auto is_triangle = [&](int k) {
    return soup.first[k + 1] - soup.first[k] == 3 && corner(k, 0) != corner(k, 1) &&
           corner(k, 1) != corner(k, 2) && corner(k, 2) != corner(k, 0);
  };
  if (select(concurrency, polygons, [&](int k) { return !is_triangle(k); }).empty()) {
    resize_in_parallel(concurrency, triangles, polygons);
    for_each_index(concurrency, polygons, [&](int k) {
      triangles[k] = {corner(k, 0), corner(k, 1), corner(k, 2)};
    });
    return triangles;
  }
  triangles.reserve(soup.first.size() - 1);
  std::vector<int> polygon;
  for (std::size_t k = 0; k + 1 < soup.first.size(); ++k) {
    Cancellation::poll_now_and_then();
    polygon.clear();
    for (int i = soup.first[k]; i < soup.first[k + 1]; ++i) {
      const int v = vertex[soup.corners[i]];
      if (polygon.empty() || polygon.back() != v) polygon.push_back(v);
    }
    while (polygon.size() > 1 && polygon.back() == polygon.front()) polygon.pop_back();
    if (polygon.size() < 3) {
      ++repairs.degenerate_facets;
      continue;
    }
    if (polygon.size() == 3)
      triangles.push_back({polygon[0], polygon[1], polygon[2]});
    else {
      triangulate_polygon(points, polygon, triangles);
      ++repairs.triangulated_polygons;
    }
  }
  repairs.degenerate_facets += drop_collapsed(triangles);
  return triangles;
}

/// By point: whether a polygon has it.
inline std::vector<int> used_points(const Polygon_soup& soup, Concurrency concurrency)
{
  std::vector<int> used(soup.points.size(), 0);
  for_each_index(concurrency, static_cast<int>(soup.corners.size()),
                 [&](int c) { atomic_store(&used[soup.corners[c]], 1); });
  return used;
}

/// For each vertex the one that stands for all at the same point: the first of those that are used,
/// or of all if none is.
inline std::vector<int> merged_vertices(const Polygon_soup& soup, const std::vector<int>& used,
                                        Concurrency concurrency)
{
  std::vector<int> vertex = first_of_equal_points(soup.points, concurrency);
  if (std::find(used.begin(), used.end(), 0) == used.end()) return vertex;
  std::vector<int> first_used(vertex.size(), -1);
  for (std::size_t v = 0; v < vertex.size(); ++v) {
    int& first = first_used[vertex[v]];
    if (used[v] && first < 0) first = static_cast<int>(v);
  }
  for (int& v : vertex)
    if (first_used[v] >= 0) v = first_used[v];
  return vertex;
}

/// The points of a soup in the unit box.
struct Boxed_points {
  Normalization normalization;
  std::vector<int> used;     ///< by point: whether a polygon has it
  std::vector<Vec3d> points; ///< of those that are not used: 0
};

/// \throws Invalid_input_error no facet, a coordinate that is not finite or too large, no area
inline Boxed_points boxed_points(const Polygon_soup& soup, Concurrency concurrency)
{
  if (soup.first.size() == 1) throw Invalid_input_error("the mesh has no facet");
  Boxed_points result;
  std::vector<int>& used = result.used;
  used = used_points(soup, concurrency);
  result.normalization = unit_box(soup.points, used, concurrency);
  resize_in_parallel(concurrency, result.points, soup.points.size());
  for_each_index(concurrency, static_cast<int>(soup.points.size()), [&](int v) {
    result.points[v] = used[v] ? result.normalization.to_inside(soup.points[v]) : Vec3d{0, 0, 0};
  });
  return result;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INPUT_SOUP_TRIANGLES_H
