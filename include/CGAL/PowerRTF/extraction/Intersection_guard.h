// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps a mesh free of self-intersections while edges are collapsed and flipped: says of each
// change whether it would add some, by exact predicates. Where faces pile up, as needles do, a
// change has to be judged against thousands of them: there is a limit to the work, beyond which no
// change is allowed at watched vertices.
#ifndef CGAL_POWER_RTF_EXTRACTION_INTERSECTION_GUARD_H
#define CGAL_POWER_RTF_EXTRACTION_INTERSECTION_GUARD_H

#include <CGAL/PowerRTF/extraction/intersecting_faces.h>
#include <CGAL/PowerRTF/geometry/Box_rtree.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Intersection_guard {
public:
  using Vertex = Working_mesh::Vertex;
  using Halfedge = Working_mesh::Halfedge;
  using Edge = Working_mesh::Edge;
  using Face = Working_mesh::Face;
  using Corners = Working_mesh::Corners;
  using Faces = boost::container::small_vector<Face, 24>;
  using Triangles = boost::container::small_vector<Corners, 24>;

  /// How a vertex is seen: changes that make triangles at a watched one are judged, against the
  /// triangles at known ones.
  enum Sight : char { unknown, known, watched };

  /// `sight`: by vertex.
  Intersection_guard(const Working_mesh& mesh, std::vector<Sight>&& sight)
      : m(mesh), m_triangles(mesh), m_sight(std::move(sight)),
        m_is_inserted(mesh.mesh.num_faces(), false),
        m_work_left(least_work + work_of_face * mesh.mesh.num_faces())
  {
    for (const Face f : m.mesh.faces()) insert(f);
  }

  bool watches_all() const
  {
    return std::all_of(m_sight.begin(), m_sight.end(), [](Sight s) { return s == watched; });
  }

  /// Watches the vertices around `u`.
  void watch_around(Vertex u)
  {
    for (const Halfedge h : halfedges_around_target(u, m.mesh)) m_sight[m.mesh.source(h)] = watched;
    for (const Halfedge h : halfedges_around_target(u, m.mesh))
      for (const Halfedge g : halfedges_around_target(m.mesh.source(h), m.mesh))
        if (!m.mesh.is_border(g)) insert(m.mesh.face(g));
  }

  /// Whether flipping the edge adds an intersection.
  bool forbids_flip(Edge e) const
  {
    const Halfedge h = m.mesh.halfedge(e), o = m.mesh.opposite(h);
    const Vertex a = m.mesh.source(h), b = m.mesh.target(h), c = m.apex(h), d = m.apex(o);
    return adds_intersections({m.mesh.face(h), m.mesh.face(o)},
                              {Corners{a, d, c}, Corners{d, b, c}});
  }

  /// Whether moving the source of `h` to its target adds an intersection.
  bool forbids_collapse(Halfedge h) const
  {
    Faces old;
    Triangles fresh;
    add_collapse(h, old, fresh);
    return adds_intersections(old, fresh);
  }

  /// The same of several at once: of the copies of a vertex on a seam, one in each sheet, to those
  /// of a neighbor on the seam, which then goes on by the edge between the places `seam`.
  /// \pre no face is at two of the sources
  bool forbids_collapses(const std::vector<Halfedge>& collapses, const PowerRTF::Edge& seam)
  {
    Faces old;
    Triangles fresh;
    for (const Halfedge h : collapses) add_collapse(h, old, fresh);
    m_triangles.set_coming_seam(seam);
    const bool result = adds_intersections(old, fresh);
    m_triangles.set_coming_seam({-1, -1});
    return result;
  }

  /// Whether a face around `v` intersects another.
  bool intersects_around(Vertex v) const
  {
    Faces star;
    Triangles triangles;
    for (const Halfedge h : halfedges_around_target(v, m.mesh)) {
      if (m.mesh.is_border(h)) continue;
      star.push_back(m.mesh.face(h));
      triangles.push_back(m_triangles.corners(star.back()));
    }
    return count(triangles, star, 1) > 0;
  }

  /// To be called before and after a change, for the faces that it touches.
  void insert(Face f)
  {
    if (m_is_inserted[f]) return;
    const Corners t = m_triangles.corners(f);
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
  void erase_around(Vertex v)
  {
    for (const Halfedge h : halfedges_around_target(v, m.mesh))
      if (!m.mesh.is_border(h)) erase(m.mesh.face(h));
  }
  void insert_around(Vertex v)
  {
    for (const Halfedge h : halfedges_around_target(v, m.mesh))
      if (!m.mesh.is_border(h)) insert(m.mesh.face(h));
  }
  template <std::size_t K>
  void erase_around(const std::array<Vertex, K>& vertices)
  {
    for (const Vertex v : vertices) erase_around(v);
  }
  template <std::size_t K>
  void insert_around(const std::array<Vertex, K>& vertices)
  {
    for (const Vertex v : vertices) insert_around(v);
  }

private:
  // In pairs of triangles that a plane parts; those that intersect take longer.
  static constexpr std::size_t least_work = 20000000, work_of_face = 6000,
                               work_of_intersection = 10;

  Rtree_entry<Face> entry(Face f) const
  {
    const Bbox_3 b = box_of(m_triangles.points(m_triangles.corners(f)));
    return {to_tree(b), f};
  }
  static Rtree_box to_tree(const Bbox_3& b)
  {
    return {{b.xmin(), b.ymin(), b.zmin()}, {b.xmax(), b.ymax(), b.zmax()}};
  }

  // The faces that moving the source of `h` to its target changes, and what becomes of them.
  void add_collapse(Halfedge h, Faces& old, Triangles& fresh) const
  {
    const Vertex v = m.mesh.target(h);
    for (const Halfedge g : halfedges_around_source(m.mesh.source(h), m.mesh)) {
      if (m.mesh.is_border(g)) continue;
      old.push_back(m.mesh.face(g));
      const Vertex a = m.mesh.target(g), b = m.apex(g);
      if (a != v && b != v) fresh.push_back({v, a, b});
    }
  }

  // The faces, none of `except`, that intersect the triangle; at most `most`.
  std::size_t count(const Corners& t, const Faces& except, std::size_t most) const
  {
    const Triangle_points p = m_triangles.points(t);
    const Bbox_3 b = box_of(p);
    std::size_t found = 0;
    for (auto it = m_tree.qbegin(boost::geometry::index::intersects(to_tree(b)));
         it != m_tree.qend() && found < most; ++it) {
      const Face f = it->second;
      add_work(1);
      if (std::find(except.begin(), except.end(), f) != except.end()) continue;
      const Corners u = m_triangles.corners(f);
      const Triangle_points q = m_triangles.points(u);
      if (has_no_area(q) || !m_triangles.intersect(t, p, u, q)) continue;
      add_work(work_of_intersection);
      ++found;
    }
    return found;
  }

  void add_work(std::size_t work) const { m_work_left -= std::min(work, m_work_left); }

  // The intersections of the triangles with each other and with faces that are none of `except`; no
  // more are counted once there are `most`. A triangle without area counts as one.
  std::size_t count(const Triangles& triangles, const Faces& except, std::size_t most) const
  {
    std::size_t sum = 0;
    for (auto t = triangles.begin(); t != triangles.end() && sum < most; ++t) {
      if (has_no_area(m_triangles.points(*t))) {
        ++sum;
        continue;
      }
      sum += count(*t, except, most - sum);
      for (auto u = triangles.begin(); u != t; ++u)
        if (!has_no_area(m_triangles.points(*u)) &&
            m_triangles.intersect(*t, m_triangles.points(*t), *u, m_triangles.points(*u)))
          ++sum;
    }
    return sum;
  }

  // Whether the faces are parts of one flat patch, and the triangles, too, not turned over; and off
  // seams, where another sheet may have the same edge.
  bool is_within_patch(const Faces& old, const Triangles& fresh) const
  {
    constexpr double clearly = 0.99; // cosine
    const int patch = m.patches.empty() ? -1 : m.patches[old[0]];
    if (patch < 0) return false;
    Vec3d normal{0, 0, 0};
    for (const Face f : old) {
      if (m.patches[f] != patch) return false;
      const Corners t = m_triangles.corners(f);
      normal += m.area_vector(t[0], t[1], t[2]);
    }
    const double l = length(normal);
    return std::all_of(fresh.begin(), fresh.end(), [&](const Corners& t) {
      if (std::any_of(t.begin(), t.end(), [&](Vertex v) { return m.is_on_seam(v); })) return false;
      const Vec3d n = m.area_vector(t[0], t[1], t[2]);
      return dot(n, normal) > clearly * length(n) * l;
    });
  }

  bool adds_intersections(const Faces& old, const Triangles& fresh) const
  {
    const bool is_watched = std::any_of(fresh.begin(), fresh.end(), [this](const Corners& t) {
      return std::max({m_sight[t[0]], m_sight[t[1]], m_sight[t[2]]}) == watched;
    });
    if (!is_watched || is_within_patch(old, fresh)) return false;
    Cancellation::poll();
    if (m_work_left == 0) return true;
    if (count(fresh, old, 1) == 0) return false;
    Triangles now;
    for (const Face f : old) now.push_back(m_triangles.corners(f));
    const std::size_t before = count(now, old, std::size_t(-1));
    return count(fresh, old, before + 1) > before;
  }

  const Working_mesh& m;
  Face_triangles m_triangles;
  std::vector<Sight> m_sight;      // by vertex
  std::vector<char> m_is_inserted; // by face
  Box_rtree<Face> m_tree;          // of the inserted faces' boxes
  mutable std::size_t m_work_left;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_INTERSECTION_GUARD_H
