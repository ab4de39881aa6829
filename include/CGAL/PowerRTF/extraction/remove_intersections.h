// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Removes self-intersections by edge flips near the intersecting triangles, also flips that are not
// Delaunay. They are rare: thin parts and close sheets with few or badly distributed samples. What
// flips cannot repair is left to `Guarded_extraction`.
#ifndef CGAL_POWER_RTF_EXTRACTION_REMOVE_INTERSECTIONS_H
#define CGAL_POWER_RTF_EXTRACTION_REMOVE_INTERSECTIONS_H

#include <CGAL/PowerRTF/extraction/delaunay_flips.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

class Intersection_remover
{
public:
  Intersection_remover(Working_mesh& mesh, Edge_flipper& flipper) : m(mesh), m_flipper(flipper) {}

  /// \returns the number of intersecting pairs of triangles that are left.
  std::size_t run()
  {
    Pairs pairs = intersections(m.mesh.faces());
    for (int round = 0; round < max_rounds && !pairs.empty() && m_tested < max_tested; ++round) {
      for (const Pair& pair : pairs) separate(pair);
      pairs = intersections(m.mesh.faces());
    }
    return pairs.size();
  }

private:
  using Mesh = Working_mesh::Mesh;
  using Vertex = Working_mesh::Vertex;
  using Halfedge = Working_mesh::Halfedge;
  using Edge = Working_mesh::Edge;
  using Face = Mesh::Face_index;
  using Pair = std::pair<Face, Face>;
  using Pairs = std::vector<Pair>;

  static constexpr int max_rounds = 5;
  static constexpr int max_flips = 8;     // for each pair
  static constexpr std::size_t max_tested = 100000; // faces: hopeless cases must not cost minutes
  static constexpr int rings = 2;

  template <class FaceRange>
  Pairs intersections(const FaceRange& faces) const
  {
    Pairs pairs;
    Polygon_mesh_processing::self_intersections(faces, m.mesh, std::back_inserter(pairs));
    return pairs;
  }

  // Flips the edge near the pair that removes most intersections around it, as long as there is
  // one.
  void separate(const Pair& pair)
  {
    if (m_tested >= max_tested) return;
    if (intersections(std::vector<Face>{pair.first, pair.second}).empty()) return;
    for (int i = 0; i < max_flips && m_tested < max_tested; ++i) {
      const std::vector<Face> region = faces_around({pair.first, pair.second}, rings);
      std::size_t best = intersections(region).size();
      if (best == 0) return;
      Edge chosen;
      double best_shape = -1;
      for (const Edge e : edges_of(faces_around({pair.first, pair.second}, 1))) {
        if (!m_flipper.is_legal(e)) continue;
        m_tested += region.size();
        m_flipper.flip(e);
        const std::size_t count = intersections(region).size();
        const double shape = worst_shape(e);
        m_flipper.flip(e);
        if (count > best || (count == best && shape <= best_shape)) continue;
        if (count == best && !chosen.is_valid()) continue;
        best = count;
        best_shape = shape;
        chosen = e;
      }
      if (!chosen.is_valid()) return;
      m_flipper.flip(chosen);
    }
  }

  double worst_shape(Edge e) const
  {
    const Halfedge h = m.mesh.halfedge(e), o = m.mesh.opposite(h);
    const Vertex a = m.mesh.source(h), b = m.mesh.target(h);
    return std::min(m.shape(a, b, m.mesh.target(m.mesh.next(h))),
                    m.shape(b, a, m.mesh.target(m.mesh.next(o))));
  }

  // The faces and those that share a vertex with them, `n` times.
  std::vector<Face> faces_around(std::vector<Face> faces, int n) const
  {
    for (; n > 0; --n) {
      std::vector<Face> more;
      for (const Face f : faces)
        for (const Halfedge h : m.mesh.halfedges_around_face(m.mesh.halfedge(f)))
          for (const Halfedge g : m.mesh.halfedges_around_target(h))
            if (!m.mesh.is_border(g)) more.push_back(m.mesh.face(g));
      std::sort(more.begin(), more.end());
      more.erase(std::unique(more.begin(), more.end()), more.end());
      faces.swap(more);
    }
    return faces;
  }

  std::vector<Edge> edges_of(const std::vector<Face>& faces) const
  {
    std::vector<Edge> edges;
    for (const Face f : faces)
      for (const Halfedge h : m.mesh.halfedges_around_face(m.mesh.halfedge(f)))
        edges.push_back(m.mesh.edge(h));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
  }

  Working_mesh& m;
  Edge_flipper& m_flipper;
  std::size_t m_tested = 0;
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_REMOVE_INTERSECTIONS_H
