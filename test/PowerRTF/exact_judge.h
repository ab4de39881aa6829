// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a mesh file holds, counted with exact predicates on the file's own coordinates. Shares no
// code with the package.
#ifndef CGAL_POWER_RTF_TEST_EXACT_JUDGE_H
#define CGAL_POWER_RTF_TEST_EXACT_JUDGE_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/box_intersection_d.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace judge {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Facet = std::array<std::size_t, 3>;

struct Mesh {
  std::vector<Point> points;
  std::vector<Facet> facets;
  Kernel::Triangle_3 triangle(std::size_t f) const
  {
    return {points[facets[f][0]], points[facets[f][1]], points[facets[f][2]]};
  }
};

/// The triangle mesh in a file. \throws std::runtime_error it cannot be read, or is none
inline Mesh read(const std::string& file)
{
  Mesh mesh;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_polygon_soup(file, mesh.points, polygons))
    throw std::runtime_error(file + " cannot be read");
  for (const auto& p : polygons) {
    if (p.size() != 3) throw std::runtime_error(file + " has a facet that is no triangle");
    mesh.facets.push_back({p[0], p[1], p[2]});
  }
  return mesh;
}

/// The mesh with vertices at equal places made one.
inline Mesh merged(const Mesh& mesh)
{
  Mesh result;
  std::map<Point, std::size_t> index;
  const auto vertex = [&](std::size_t v) {
    const auto [it, is_new] = index.insert({mesh.points[v], result.points.size()});
    if (is_new) result.points.push_back(mesh.points[v]);
    return it->second;
  };
  for (const Facet& f : mesh.facets)
    result.facets.push_back({vertex(f[0]), vertex(f[1]), vertex(f[2])});
  return result;
}

struct Topology {
  std::size_t vertices = 0, unused_vertices = 0, facets = 0, components = 0, border_loops = 0;
  std::size_t non_manifold_edges = 0, non_manifold_vertices = 0;
  std::size_t sheets = 0; ///< components once it is cut along the edges of more than two facets
  long euler_characteristic = 0;
  bool oriented = true;   ///< no edge is traversed twice in the same direction
  bool orientable = true; ///< across the edges of two facets

  bool is_manifold() const { return non_manifold_edges == 0 && non_manifold_vertices == 0; }
};

/// Elements 0 to below `count`, of which some are made equivalent.
class Classes {
  boost::disjoint_sets_with_storage<> m_sets;

public:
  explicit Classes(std::size_t count) : m_sets(count) {}
  void unite(std::size_t a, std::size_t b) { m_sets.union_set(a, b); }
  std::size_t find(std::size_t a) { return m_sets.find_set(a); }
};

struct Side {
  std::size_t facet, corner; ///< from this corner of the facet to its next one
  std::size_t first() const { return 3 * facet + corner; }
  std::size_t second() const { return 3 * facet + (corner + 1) % 3; }
};

/// By their ends, which are sorted: in which facets they are.
using Edges = std::map<std::pair<std::size_t, std::size_t>, std::vector<Side>>;

inline Edges edges_of(const Mesh& mesh)
{
  Edges edges;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    for (std::size_t i = 0; i < 3; ++i)
      edges[std::minmax(mesh.facets[f][i], mesh.facets[f][(i + 1) % 3])].push_back({f, i});
  return edges;
}

/// Whether the edge has the same direction in both facets.
inline bool is_same_way(const Mesh& mesh, const Side& a, const Side& b)
{
  return mesh.facets[a.facet][a.corner] == mesh.facets[b.facet][b.corner];
}

/// Makes the corners of two facets at the ends of their edge equivalent.
inline void unite_corners(Classes& corners, const Mesh& mesh, const Side& a, const Side& b)
{
  const bool same = is_same_way(mesh, a, b);
  corners.unite(a.first(), same ? b.first() : b.second());
  corners.unite(a.second(), same ? b.second() : b.first());
}

/// The curves of border edges, each going on in the next one around a vertex of its sheet: loops,
/// and paths between edges of more than two facets.
inline std::size_t border_curves(const Mesh& mesh, const Edges& edges)
{
  Classes corners(3 * mesh.facets.size());
  std::vector<std::size_t> borders;
  for (const auto& [ends, sides] : edges) {
    if (sides.size() == 2) unite_corners(corners, mesh, sides[0], sides[1]);
    if (sides.size() > 1) continue;
    corners.unite(sides[0].first(), sides[0].second());
    borders.push_back(sides[0].first());
  }
  std::set<std::size_t> curves;
  for (const std::size_t c : borders) curves.insert(corners.find(c));
  return curves.size();
}

inline Topology topology(const Mesh& mesh)
{
  const std::size_t count = mesh.facets.size();
  const Edges edges = edges_of(mesh);
  Topology t;
  Classes directed(2 * count), fans(3 * count), sheets(count);
  Classes parts(mesh.points.size());
  std::set<std::size_t> crowded_vertices;
  for (const auto& [ends, sides] : edges) {
    parts.unite(ends.first, ends.second);
    if (sides.size() > 2) {
      ++t.non_manifold_edges;
      crowded_vertices.insert({ends.first, ends.second});
    }
    if (sides.size() == 2) sheets.unite(sides[0].facet, sides[1].facet);
    for (std::size_t k = 1; k < sides.size(); ++k) {
      const Side a = sides[0], b = sides[k];
      const bool same = is_same_way(mesh, a, b);
      unite_corners(fans, mesh, a, b);
      if (same || sides.size() > 2) t.oriented = false;
      if (sides.size() > 2) continue;
      directed.unite(2 * a.facet, 2 * b.facet + same); // 2 f: as it is, 2 f + 1: turned round
      directed.unite(2 * a.facet + 1, 2 * b.facet + !same);
    }
  }

  std::set<std::size_t> components, sheet_names;
  std::map<std::size_t, std::set<std::size_t>> fans_of;
  for (std::size_t f = 0; f < count; ++f) {
    components.insert(parts.find(mesh.facets[f][0]));
    sheet_names.insert(sheets.find(f));
    if (directed.find(2 * f) == directed.find(2 * f + 1)) t.orientable = false;
    for (int i = 0; i < 3; ++i) fans_of[mesh.facets[f][i]].insert(fans.find(3 * f + i));
  }
  for (const auto& [v, classes] : fans_of)
    t.non_manifold_vertices += classes.size() > 1 || crowded_vertices.count(v) > 0;
  t.vertices = fans_of.size();
  t.unused_vertices = mesh.points.size() - t.vertices;
  t.facets = count;
  t.components = components.size();
  t.border_loops = border_curves(mesh, edges);
  t.sheets = sheet_names.size();
  t.euler_characteristic = long(t.vertices) - long(edges.size()) + long(count);
  return t;
}

inline bool is_degenerate(const Mesh& mesh, std::size_t f)
{
  const Kernel::Triangle_3 t = mesh.triangle(f);
  return CGAL::collinear(t[0], t[1], t[2]);
}

inline std::size_t degenerate_facets(const Mesh& mesh)
{
  std::size_t count = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) count += is_degenerate(mesh, f);
  return count;
}

/// Whether two facets with an area have more in common than their common vertices and edge.
inline bool do_cross(const Mesh& mesh, std::size_t f, std::size_t g)
{
  Facet a = mesh.facets[f], b = mesh.facets[g];
  int shared = 0; // moved to the front in both
  for (int i = 0; i < 3; ++i) {
    const auto match = std::find(b.begin() + shared, b.end(), a[i]);
    if (match == b.end()) continue;
    std::iter_swap(b.begin() + shared, match);
    std::swap(a[shared], a[i]);
    ++shared;
  }
  const auto point = [&](std::size_t v) { return mesh.points[v]; };
  if (shared == 0) return CGAL::do_intersect(mesh.triangle(f), mesh.triangle(g));
  if (shared == 1)
    return CGAL::do_intersect(Kernel::Segment_3(point(a[1]), point(a[2])), mesh.triangle(g)) ||
           CGAL::do_intersect(Kernel::Segment_3(point(b[1]), point(b[2])), mesh.triangle(f));
  if (shared == 2) // one lies on the other
    return CGAL::coplanar(point(a[0]), point(a[1]), point(a[2]), point(b[2])) &&
           CGAL::coplanar_orientation(point(a[0]), point(a[1]), point(a[2]), point(b[2])) ==
               CGAL::POSITIVE;
  return true;
}

/// Pairs of facets that cross or touch each other elsewhere than in their common vertices.
inline std::size_t self_intersections(const Mesh& mesh)
{
  using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;
  std::vector<Box> boxes;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    if (!is_degenerate(mesh, f)) boxes.emplace_back(mesh.triangle(f).bbox(), f);
  std::size_t pairs = 0;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    pairs += do_cross(mesh, a.info(), b.info());
  });
  return pairs;
}

/// Whether the mesh is a 2-manifold without facets without area and without self-intersections.
inline bool is_clean(const Mesh& mesh)
{
  return topology(mesh).is_manifold() && degenerate_facets(mesh) == 0 &&
         self_intersections(mesh) == 0;
}

} // namespace judge

#endif // CGAL_POWER_RTF_TEST_EXACT_JUDGE_H
