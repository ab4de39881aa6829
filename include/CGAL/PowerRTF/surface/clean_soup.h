// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polygons with indices -> an oriented 2-manifold of triangles in the unit box. Every repair is
// preceded by a linear check, so clean input costs little.
#ifndef CGAL_POWER_RTF_SURFACE_CLEAN_SOUP_H
#define CGAL_POWER_RTF_SURFACE_CLEAN_SOUP_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/surface/degenerate_facets.h>
#include <CGAL/PowerRTF/surface/facet_adjacency.h>
#include <CGAL/PowerRTF/surface/polygon_triangulation.h>
#include <CGAL/PowerRTF/surface/surface_geometry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CGAL {
namespace PowerRTF {
namespace internal {

/// Points and polygons; polygon `k` has the corners `corners[first[k]] .. corners[first[k+1]-1]`.
struct Polygon_soup {
  std::vector<Vec3d> points;
  std::vector<int> corners, first{0};

  void reserve_polygons(std::size_t n)
  {
    corners.reserve(3 * n);
    first.reserve(n + 1);
  }
  void end_polygon() { first.push_back(static_cast<int>(corners.size())); }

  template <class Integer>
  void add_corner(Integer v)
  {
    if (v < Integer(0) || static_cast<std::size_t>(v) >= points.size())
      throw Invalid_input_error("facet " + std::to_string(first.size() - 1) + " refers to vertex " +
                                std::to_string(v) + ", but there are only " +
                                std::to_string(points.size()) + " (numbered from 0)");
    corners.push_back(static_cast<int>(v));
  }
};

/// The first vertex at the same place, for each vertex (open addressing on the coordinates' bits).
inline std::vector<int> first_of_equal_points(const std::vector<Vec3d>& points)
{
  std::size_t slots = 16;
  while (slots < 2 * points.size()) slots *= 2;
  std::vector<int> table(slots, -1), first(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) {
    const double key[3] = {points[v].x + 0., points[v].y + 0., points[v].z + 0.}; // -0 becomes 0
    std::uint64_t bits[3], hash = 0;
    std::memcpy(bits, key, sizeof(key));
    for (const std::uint64_t b : bits) {
      hash = (hash ^ b) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 32;
    }
    std::size_t slot = hash & (slots - 1);
    while (table[slot] >= 0 && points[table[slot]] != points[v]) slot = (slot + 1) & (slots - 1);
    if (table[slot] < 0) table[slot] = static_cast<int>(v);
    first[v] = table[slot];
  }
  return first;
}

/// The mapping of the points marked in `used` to the unit box.
inline Normalization unit_box(const std::vector<Vec3d>& points, const std::vector<char>& used)
{
  Vec3d low{0, 0, 0}, high{0, 0, 0};
  bool is_first = true;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (!used[v]) continue;
    const Vec3d& p = points[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
      throw Invalid_input_error("vertex " + std::to_string(v) +
                                " has a coordinate that is not a finite number");
    if (is_first) low = high = p;
    is_first = false;
    low = {(std::min)(low.x, p.x), (std::min)(low.y, p.y), (std::min)(low.z, p.z)};
    high = {(std::max)(high.x, p.x), (std::max)(high.y, p.y), (std::max)(high.z, p.z)};
  }
  const Vec3d size = high - low;
  const double side = (std::max)({size.x, size.y, size.z});
  if (!(side < 1e300)) throw Invalid_input_error("the coordinates are too large");
  if (!(side > 1e-300)) throw Invalid_input_error("the surface has no area");
  int exponent;
  if (std::frexp(side, &exponent) == 0.5) --exponent;
  return {low + 0.5 * size, std::ldexp(1., -exponent)};
}

/// Cuts the polygons into triangles of distinct vertices; `vertex[v]` stands for corner `v`.
inline std::vector<Triangle> triangulated(const Polygon_soup& soup,
                                          const std::vector<Vec3d>& points,
                                          const std::vector<int>& vertex, Repair_counts& repairs)
{
  std::vector<Triangle> triangles;
  triangles.reserve(soup.first.size() - 1);
  std::vector<int> polygon;
  for (std::size_t k = 0; k + 1 < soup.first.size(); ++k) {
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
    const std::size_t before = triangles.size();
    if (polygon.size() == 3) triangles.push_back({polygon[0], polygon[1], polygon[2]});
    else {
      triangulate_polygon(points, polygon, triangles);
      ++repairs.triangulated_polygons;
    }
    const auto repeats_a_vertex = [](const Triangle& t)
    { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
    const auto kept = std::remove_if(triangles.begin() + before, triangles.end(), repeats_a_vertex);
    repairs.degenerate_facets += triangles.end() - kept;
    triangles.erase(kept, triangles.end());
  }
  return triangles;
}

/// Keeps the first of all triangles with the same three vertices.
inline void drop_repeated(std::vector<Triangle>& triangles, Repair_counts& repairs)
{
  std::set<Triangle> seen;
  const auto is_repeated = [&seen](Triangle t)
  {
    std::sort(t.begin(), t.end());
    return !seen.insert(t).second;
  };
  std::size_t kept = 0;
  for (const Triangle& t : triangles)
    if (!is_repeated(t)) triangles[kept++] = t;
  repairs.duplicate_facets += triangles.size() - kept;
  triangles.resize(kept);
}

/// Makes `triangles` an oriented 2-manifold or throws.
inline void make_manifold(std::vector<Triangle>& triangles, std::size_t vertices,
                          Repair_counts& repairs)
{
  Facet_adjacency adjacency = facet_adjacency(triangles, vertices);
  if (adjacency.repeated_facets) {
    drop_repeated(triangles, repairs);
    adjacency = facet_adjacency(triangles, vertices);
  }
  if (adjacency.non_manifold_edges > 0)
    throw Invalid_input_error("the surface is not a 2-manifold: " +
                              std::to_string(adjacency.non_manifold_edges) +
                              " edge(s) with more than two facets");
  if (adjacency.same_direction) {
    if (!orient_facets(triangles, adjacency, repairs.reoriented_facets))
      throw Invalid_input_error(
          "the surface cannot be oriented (it has one side only, like a Moebius strip)");
    adjacency = facet_adjacency(triangles, vertices);
  }
  if (const auto count = count_non_manifold_vertices(triangles, adjacency, vertices))
    throw Invalid_input_error("the surface is not a 2-manifold: " + std::to_string(count) +
                              " vertex(es) where parts of the surface touch in a point only");
}

/// Drops the vertices that no triangle uses.
inline Surface compacted(const std::vector<Vec3d>& points, std::vector<Triangle>&& triangles,
                         const Normalization& normalization)
{
  std::vector<int> new_index(points.size(), -1);
  for (const Triangle& t : triangles)
    for (const int v : t) new_index[v] = 0;
  Surface surface;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (new_index[v] < 0) continue;
    new_index[v] = static_cast<int>(surface.points.size());
    surface.points.push_back(points[v]);
    surface.input_vertices.push_back(static_cast<int>(v));
  }
  for (Triangle& t : triangles)
    for (int& v : t) v = new_index[v];
  surface.triangles = std::move(triangles);
  surface.vertex_density.assign(surface.points.size(), 1);
  surface.normalization = normalization;
  return surface;
}

/// The surface of `soup`; `vertex[v]` is the vertex that stands for `v`.
inline Surface clean_surface_of(const Polygon_soup& soup, const std::vector<Vec3d>& points,
                                const std::vector<int>& vertex, const Normalization& normalization,
                                Repair_counts& repairs)
{
  std::vector<Triangle> triangles = triangulated(soup, points, vertex, repairs);
  const std::size_t degenerate = degenerate_facets(points, triangles).size();
  if (degenerate == triangles.size()) throw Invalid_input_error("the surface has no area");
  make_manifold(triangles, points.size(), repairs);
  if (degenerate > 0) {
    repairs.duplicate_vertices += remove_degenerate_facets(points, triangles);
    repairs.degenerate_facets += degenerate - degenerate_facets(points, triangles).size();
  }
  Surface surface = compacted(points, std::move(triangles), normalization);
  compute_geometry(surface);
  return surface;
}

inline bool is_closed(const Surface& surface)
{ return facet_adjacency(surface.triangles, surface.points.size()).border_edges == 0; }

/// What `import_surface()` and `import_soup()` share. `merge`: vertices at the same place are one.
inline Surface clean_surface(Polygon_soup&& soup, bool merge, Repair_counts& repairs)
{
  if (soup.first.size() == 1) throw Invalid_input_error("the mesh has no facet");
  std::vector<char> used(soup.points.size(), 0);
  for (const int v : soup.corners) used[v] = 1;
  const Normalization normalization = unit_box(soup.points, used);

  std::vector<int> vertex(soup.points.size());
  std::size_t duplicates = 0, unused = 0;
  for (std::size_t v = 0; v < vertex.size(); ++v) vertex[v] = static_cast<int>(v);
  std::vector<int> merged_vertex;
  if (merge) {
    merged_vertex = first_of_equal_points(soup.points);
    for (std::size_t v = 0; v < vertex.size(); ++v)
      if (used[v] && merged_vertex[v] != vertex[v]) ++duplicates;
  }
  for (std::size_t v = 0; v < used.size(); ++v) unused += !used[v];

  std::vector<Vec3d> points(soup.points.size());
  for (std::size_t v = 0; v < points.size(); ++v)
    points[v] = used[v] ? normalization.to_inside(soup.points[v]) : Vec3d{0, 0, 0};
  repairs.unused_vertices += unused;
  if (duplicates == 0) return clean_surface_of(soup, points, vertex, normalization, repairs);

  Repair_counts attempt = repairs;
  try {
    attempt.duplicate_vertices += duplicates;
    Surface surface = clean_surface_of(soup, points, merged_vertex, normalization, attempt);
    repairs = attempt;
    return surface;
  } catch (const Invalid_input_error&) {
    // Sheets that touch: right as they were given if they are closed without merging.
    try {
      attempt = repairs;
      Surface surface = clean_surface_of(soup, points, vertex, normalization, attempt);
      if (is_closed(surface)) {
        repairs = attempt;
        return surface;
      }
    } catch (const Invalid_input_error&) {
    }
    throw;
  }
}

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_SURFACE_CLEAN_SOUP_H
