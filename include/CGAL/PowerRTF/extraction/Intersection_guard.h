// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps a mesh free of self-intersections while edges are collapsed and flipped: says of each
// change whether it would add some, by exact predicates.
#ifndef CGAL_POWER_RTF_EXTRACTION_INTERSECTION_GUARD_H
#define CGAL_POWER_RTF_EXTRACTION_INTERSECTION_GUARD_H

#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/internal/triangles_intersect.h>

#include <CGAL/Bbox_3.h>

#include <boost/container/small_vector.hpp>
#include <boost/geometry/algorithms/covered_by.hpp>
#include <boost/geometry/algorithms/equals.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

class Intersection_guard
{
public:
  using Vertex = Working_mesh::Vertex;
  using Halfedge = Working_mesh::Halfedge;
  using Edge = Working_mesh::Edge;
  using Face = Working_mesh::Mesh::Face_index;
  using Corners = std::array<Vertex, 3>;
  using Faces = boost::container::small_vector<Face, 24>;
  using Triangles = boost::container::small_vector<Corners, 24>;

  /// How a vertex is seen: changes that make triangles at a watched one are judged, against the
  /// triangles at known ones.
  enum Sight : char { unknown, known, watched };

  /// `sight`: by vertex.
  Intersection_guard(const Working_mesh& mesh, std::vector<Sight>&& sight)
      : m(mesh), m_sight(std::move(sight)), m_is_inserted(mesh.mesh.number_of_faces(), false)
  {
    for (const Face f : m.mesh.faces()) insert(f);
  }

  /// Watches the vertices around `u`.
  void watch_around(Vertex u)
  {
    for (const Halfedge h : halfedges_around_target(u, m.mesh))
      m_sight[m.mesh.source(h)] = watched;
    for (const Halfedge h : halfedges_around_target(u, m.mesh))
      for (const Halfedge g : halfedges_around_target(m.mesh.source(h), m.mesh))
        if (!m.mesh.is_border(g) && !m_is_inserted[m.mesh.face(g)]) insert(m.mesh.face(g));
  }

  /// Whether flipping the edge adds an intersection.
  bool forbids_flip(Edge e) const
  {
    const Halfedge h = m.mesh.halfedge(e), o = m.mesh.opposite(h);
    const Vertex a = m.mesh.source(h), b = m.mesh.target(h), c = m.mesh.target(m.mesh.next(h)),
                 d = m.mesh.target(m.mesh.next(o));
    return adds_intersections({m.mesh.face(h), m.mesh.face(o)},
                              {Corners{a, d, c}, Corners{d, b, c}});
  }

  /// Whether moving the source of `h` to its target adds an intersection.
  bool forbids_collapse(Halfedge h) const
  {
    const Vertex v = m.mesh.target(h);
    Faces old;
    Triangles fresh;
    for (const Halfedge g : halfedges_around_source(m.mesh.source(h), m.mesh)) {
      if (m.mesh.is_border(g)) continue;
      old.push_back(m.mesh.face(g));
      const Vertex a = m.mesh.target(g), b = m.mesh.target(m.mesh.next(g));
      if (a != v && b != v) fresh.push_back({v, a, b});
    }
    return adds_intersections(old, fresh);
  }

  /// To be called before and after a change, for the faces that it touches.
  void insert(Face f)
  {
    const Corners t = corners(f);
    if (std::all_of(t.begin(), t.end(), [this](Vertex v) { return m_sight[v] == unknown; })) return;
    m_is_inserted[f] = true;
    m_tree.insert(entry(f));
  }
  void erase(Face f)
  {
    if (!m_is_inserted[f]) return;
    m_is_inserted[f] = false;
    m_tree.remove(entry(f));
  }
  void erase_around(Vertex u, Vertex v)
  {
    for (const Halfedge h : halfedges_around_target(u, m.mesh))
      if (!m.mesh.is_border(h)) erase(m.mesh.face(h));
    for (const Halfedge h : halfedges_around_target(v, m.mesh))
      if (!m.mesh.is_border(h) && m.mesh.source(h) != u && m.mesh.target(m.mesh.next(h)) != u)
        erase(m.mesh.face(h));
  }
  void insert_around(Vertex v)
  {
    for (const Halfedge h : halfedges_around_target(v, m.mesh))
      if (!m.mesh.is_border(h)) insert(m.mesh.face(h));
  }

private:
  using Points = std::array<Epick::Point_3, 3>;
  using Tree_point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Tree_box = boost::geometry::model::box<Tree_point>;
  using Entry = std::pair<Tree_box, Face>;
  using Tree = boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>>;

  Points points(const Corners& t) const
  {
    return {m.mesh.point(t[0]), m.mesh.point(t[1]), m.mesh.point(t[2])};
  }
  static Bbox_3 box(const Points& p) { return p[0].bbox() + p[1].bbox() + p[2].bbox(); }
  static bool is_degenerate(const Points& p) { return collinear(p[0], p[1], p[2]); }

  Corners corners(Face f) const
  {
    const Halfedge h = m.mesh.halfedge(f);
    return {m.mesh.source(h), m.mesh.target(h), m.mesh.target(m.mesh.next(h))};
  }

  Entry entry(Face f) const
  {
    const Bbox_3 b = box(points(corners(f)));
    return {to_tree(b), f};
  }
  static Tree_box to_tree(const Bbox_3& b)
  {
    return {{b.xmin(), b.ymin(), b.zmin()}, {b.xmax(), b.ymax(), b.zmax()}};
  }

  // The faces, none of `except`, that intersect the triangle; at most `most`.
  std::size_t count(const Corners& t, const Faces& except, std::size_t most) const
  {
    const Points p = points(t);
    const Bbox_3 b = box(p);
    std::size_t found = 0;
    for (auto it = m_tree.qbegin(boost::geometry::index::intersects(to_tree(b)));
         it != m_tree.qend() && found < most; ++it) {
      const Face f = it->second;
      if (std::find(except.begin(), except.end(), f) != except.end()) continue;
      const Corners u = corners(f);
      const Points q = points(u);
      if (!is_degenerate(q) && triangles_intersect(t, p, u, q)) ++found;
    }
    return found;
  }

  // The intersections of the triangles with each other and with faces that are none of `except`; no
  // more are counted once there are `most`. A triangle without area counts as one.
  std::size_t count(const Triangles& triangles, const Faces& except, std::size_t most) const
  {
    std::size_t sum = 0;
    for (auto t = triangles.begin(); t != triangles.end() && sum < most; ++t) {
      if (is_degenerate(points(*t))) {
        ++sum;
        continue;
      }
      sum += count(*t, except, most - sum);
      for (auto u = triangles.begin(); u != t; ++u)
        if (!is_degenerate(points(*u)) && triangles_intersect(*t, points(*t), *u, points(*u)))
          ++sum;
    }
    return sum;
  }

  bool adds_intersections(const Faces& old, const Triangles& fresh) const
  {
    const bool is_watched = std::any_of(fresh.begin(), fresh.end(), [this](const Corners& t) {
      return std::max({m_sight[t[0]], m_sight[t[1]], m_sight[t[2]]}) == watched;
    });
    if (!is_watched) return false;
    if (count(fresh, old, 1) == 0) return false;
    Triangles now;
    for (const Face f : old) now.push_back(corners(f));
    const std::size_t before = count(now, old, std::size_t(-1));
    return count(fresh, old, before + 1) > before;
  }

  const Working_mesh& m;
  std::vector<Sight> m_sight;      // by vertex
  std::vector<char> m_is_inserted; // by face
  Tree m_tree;                     // of the inserted faces' boxes
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_INTERSECTION_GUARD_H
