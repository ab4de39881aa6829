// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distance from the surface to the mesh, seen from the surface's vertices: each knows the face
// that is nearest to it among those whose normals agree.
#ifndef CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_SURFACE_WATCH_H
#define CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_SURFACE_WATCH_H

#include <CGAL/PowerRTF/extraction/improvement/Star_mesh.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

class Surface_watch
{
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Face = Working_mesh::Mesh::Face_index;

  /// Of a surface with very many vertices, every k-th is watched. Flips make the watch void; it
  /// then is a good `earlier` one for the next, only to be faster.
  explicit Surface_watch(const Star_mesh& mesh, const Surface_watch* earlier = nullptr) : m(mesh)
  {
    const Surface& surface = m.guide().surface();
    const auto& topology = m.working().mesh;
    std::vector<Vec3d> points;
    std::vector<Triangle> triangles;
    points.reserve(m.size());
    triangles.reserve(topology.number_of_faces());
    for (const Vertex v : topology.vertices()) points.push_back(m.point(v));
    for (const Face f : topology.faces()) {
      const Halfedge h = topology.halfedge(f);
      triangles.push_back({int(topology.source(h)), int(topology.target(h)),
                           int(topology.target(topology.next(h)))});
    }
    const Facet_tree tree(points, triangles);
    const std::size_t stride = 1 + surface.points.size() / (max_watched * m.size());
    m_at_face.resize(triangles.size());
    int hint = -1;
    for (std::size_t v = 0; v < surface.points.size(); v += stride) {
      if (earlier) hint = earlier->m_hints[m_hints.size()];
      const auto y = nearest_facet(tree.view(), surface.points[v], surface.vertex_normals[v],
                                   largest_turn, hint);
      m_hints.push_back(y.facet);
      if (y.facet < 0) continue;
      hint = y.facet;
      m_at_face[y.facet].push_back(int(m_points.size()));
      m_points.push_back({surface.points[v], y.point, y.facet, std::sqrt(y.squared_distance)});
    }
  }

  int size() const { return int(m_points.size()); }
  const Vec3d& point(int i) const { return m_points[i].point; }
  const Vec3d& nearest(int i) const { return m_points[i].nearest; }
  int face(int i) const { return m_points[i].face; }
  double distance(int i) const { return m_points[i].distance; }

  double max_distance() const
  {
    double d = 0;
    for (const Watched& w : m_points) d = std::max(d, w.distance);
    return d;
  }

  /// The largest distance of what is nearest to the star of `v`, with `v` at `p`.
  double farthest_around(Vertex v, const Vec3d& p) const
  {
    const Faces faces = patch(v);
    double farthest = 0;
    for (const Halfedge h : halfedges_around_target(v, m.working().mesh))
      if (!m.working().mesh.is_border(h))
        for (const int i : m_at_face[m.working().mesh.face(h)])
          farthest = std::max(farthest, find(m_points[i].point, faces, v, p).distance);
    return farthest;
  }

  /// After `v` has moved.
  void update_around(Vertex v)
  {
    const auto& mesh = m.working().mesh;
    const Faces faces = patch(v);
    boost::container::small_vector<int, 64> watched;
    for (const Halfedge h : halfedges_around_target(v, mesh)) {
      if (mesh.is_border(h)) continue;
      auto& here = m_at_face[mesh.face(h)];
      watched.insert(watched.end(), here.begin(), here.end());
      here.clear();
    }
    for (const int i : watched) {
      m_points[i] = find(m_points[i].point, faces, v, m.point(v));
      m_at_face[m_points[i].face].push_back(i);
    }
  }

private:
  static constexpr std::size_t max_watched = 16; // surface vertices for each vertex of the mesh
  static constexpr double largest_turn = -0.35;  // cosine

  using Faces = boost::container::small_vector<Face, 32>;
  struct Watched {
    Vec3d point, nearest;
    int face;
    double distance;
  };

  // The faces around v and its neighbours.
  Faces patch(Vertex v) const
  {
    const auto& mesh = m.working().mesh;
    Faces faces;
    for (const Halfedge h : halfedges_around_target(v, mesh))
      for (const Halfedge g : halfedges_around_target(mesh.opposite(h), mesh))
        if (!mesh.is_border(g)) faces.push_back(mesh.face(g));
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  Watched find(const Vec3d& x, const Faces& faces, Vertex v, const Vec3d& p) const
  {
    const auto& mesh = m.working().mesh;
    Watched w{x, x, -1, std::numeric_limits<double>::infinity()};
    for (const Face f : faces) {
      const Halfedge h = mesh.halfedge(f);
      const auto at = [&](Vertex u) { return u == v ? p : m.point(u); };
      const Vec3d y = nearest_point_on_triangle(x, at(mesh.source(h)), at(mesh.target(h)),
                                                at(mesh.target(mesh.next(h))));
      const double d = squared_length(y - x);
      if (d < w.distance) w = {x, y, int(f), d};
    }
    w.distance = std::sqrt(w.distance);
    return w;
  }

  const Star_mesh& m;
  std::vector<Watched> m_points;
  std::vector<int> m_hints; // by surface vertex: the nearest face, -1: none agrees
  std::vector<boost::container::small_vector<int, 4>> m_at_face;
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_SURFACE_WATCH_H
