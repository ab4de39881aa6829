// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Removes self-intersections by edge flips near the intersecting triangles, also flips that are not
// Delaunay. They are rare: thin parts and close sheets with few or badly distributed samples. What
// flips cannot repair is left to `Guarded_extraction`.
#ifndef CGAL_POWER_RTF_EXTRACTION_REMOVE_INTERSECTIONS_H
#define CGAL_POWER_RTF_EXTRACTION_REMOVE_INTERSECTIONS_H

#include <CGAL/PowerRTF/extraction/delaunay_flips.h>
#include <CGAL/PowerRTF/extraction/intersecting_faces.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Intersection_remover {
public:
  Intersection_remover(Working_mesh& mesh, Edge_flipper& flipper)
      : m(mesh), m_flipper(flipper), m_triangles(mesh), m_finder(mesh),
        m_has_changed(mesh.mesh.num_faces())
  {}

  /// \returns the number of intersecting pairs of triangles that are left.
  std::size_t run()
  {
    std::vector<Face_pair> pairs = m_finder.all();
    for (int round = 0; round < max_rounds && !pairs.empty() && m_tests < max_tests; ++round) {
      std::fill(m_has_changed.begin(), m_has_changed.end(), false);
      for (const Face_pair& pair : pairs)
        if (m_tests < max_tests) separate(pair);
      pairs = m_finder.updated(std::move(pairs), m_has_changed);
    }
    return pairs.size();
  }

private:
  using Vertex = Working_mesh::Vertex;
  using Halfedge = Working_mesh::Halfedge;
  using Edge = Working_mesh::Edge;
  using Face = Working_mesh::Face;
  using Faces = std::vector<Face>;

  static constexpr int max_rounds = 5;
  static constexpr int max_flips = 8; // for each pair
  // Of pairs of triangles: hopeless cases must not cost minutes.
  static constexpr std::size_t max_tests = 4000000;
  static constexpr int rings = 2;

  // Flips the edge near the pair that removes most intersections around it, as long as there is
  // one.
  void separate(const Face_pair& pair)
  {
    Cancellation::poll();
    if (count(pair.first, {pair.second}) == 0) return;
    for (int i = 0; i < max_flips; ++i) {
      const Faces region = faces_around({pair.first, pair.second}, rings);
      if (m_tests + region.size() * region.size() / 2 > max_tests) { // a vertex with many faces
        m_tests = max_tests;
        return;
      }
      if (are_apart(region)) return;
      std::ptrdiff_t best = 0; // change of the number of intersections
      Edge chosen;
      double best_shape = -1;
      for (const Edge e : edges_of(faces_around({pair.first, pair.second}, 1))) {
        if (m_tests >= max_tests) return;
        if (!m_flipper.is_legal(e)) continue;
        const std::ptrdiff_t before = count_at(e, region);
        flip(e);
        const std::ptrdiff_t change = count_at(e, region) - before;
        const double shape = worst_shape(e);
        flip(e);
        if (change > best || (change == best && shape <= best_shape)) continue;
        if (change == best && !chosen.is_valid()) continue;
        best = change;
        best_shape = shape;
        chosen = e;
      }
      if (!chosen.is_valid()) return;
      flip(chosen);
    }
  }

  void flip(Edge e)
  {
    m_flipper.flip(e);
    const Halfedge h = m.mesh.halfedge(e);
    m_has_changed[m.mesh.face(h)] = m_has_changed[m.mesh.face(m.mesh.opposite(h))] = true;
  }

  bool are_apart(const Faces& region)
  {
    for (const Face f : region)
      if (count(f, region) > 0) return false;
    return true;
  }

  // The intersections of the edge's two faces with those of the region and each other.
  std::ptrdiff_t count_at(Edge e, const Faces& region)
  {
    const Halfedge h = m.mesh.halfedge(e);
    const Face f = m.mesh.face(h), g = m.mesh.face(m.mesh.opposite(h));
    return count(f, region) + count(g, region) - (f != g && meet(f, g));
  }

  // The faces of the region that intersect `f`; itself when it has no area.
  std::ptrdiff_t count(Face f, const Faces& region)
  {
    m_tests += region.size();
    return std::count_if(region.begin(), region.end(), [&](Face g) { return meet(f, g); });
  }

  bool meet(Face f, Face g) const
  {
    const Triangle_points p = m_triangles.points(m_triangles.corners(f));
    if (f == g) return has_no_area(p);
    const Triangle_points q = m_triangles.points(m_triangles.corners(g));
    return do_overlap(box_of(p), box_of(q)) && !has_no_area(p) && !has_no_area(q) &&
           m_finder.intersect(f, g);
  }

  double worst_shape(Edge e) const
  {
    const Halfedge h = m.mesh.halfedge(e), o = m.mesh.opposite(h);
    const Vertex a = m.mesh.source(h), b = m.mesh.target(h);
    return std::min(m.shape(a, b, m.apex(h)), m.shape(b, a, m.apex(o)));
  }

  // The faces and those that share a vertex with them, `n` times.
  Faces faces_around(Faces faces, int n) const
  {
    for (; n > 0; --n) {
      std::vector<Vertex> vertices;
      for (const Face f : faces)
        for (const Vertex v : m_triangles.corners(f)) vertices.push_back(v);
      sort_uniquely(vertices);
      faces.clear();
      for (const Vertex v : vertices)
        for (const Halfedge g : m.mesh.halfedges_around_target(m.mesh.halfedge(v)))
          if (!m.mesh.is_border(g)) faces.push_back(m.mesh.face(g));
      sort_uniquely(faces);
    }
    return faces;
  }

  std::vector<Edge> edges_of(const Faces& faces) const
  {
    std::vector<Edge> edges;
    for (const Face f : faces)
      for (const Halfedge h : m.mesh.halfedges_around_face(m.mesh.halfedge(f)))
        edges.push_back(m.mesh.edge(h));
    sort_uniquely(edges);
    return edges;
  }

  Working_mesh& m;
  Edge_flipper& m_flipper;
  Face_triangles m_triangles;
  Intersection_finder m_finder;
  std::vector<char> m_has_changed; // by face, since the pairs were found
  std::size_t m_tests = 0;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_REMOVE_INTERSECTIONS_H
