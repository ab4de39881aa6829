// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distance from the surface to the mesh, seen from the surface's vertices. Each knows the point
// of the mesh that is nearest to it, on a face whose normal agrees (if there is one). After changes
// of the mesh it is found again by going downhill from face to face, which can overestimate small
// distances; large ones are exact.
#ifndef CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_SURFACE_WATCH_H
#define CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_SURFACE_WATCH_H

#include <CGAL/PowerRTF/extraction/improvement/Star_mesh.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
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

  /// A point of the surface and where the mesh is nearest to it.
  struct Watched {
    Vec3d point, normal;
    double weight; ///< area of the surface that it stands for, of its vertices
    Halfedge face;
    std::array<double, 3> barycentric; ///< of the nearest point: source, target, apex of `face`
    Vec3d nearest;
    double distance;
  };

  /// \pre `mesh` has a face
  explicit Surface_watch(const Star_mesh& mesh)
      : m_mesh(&mesh), m_far(large * std::sqrt(mesh.guide().surface().area / double(mesh.size())))
  {
    choose_points();
    Halfedge start = topology().halfedge(*topology().faces().begin());
    for (Watched& w : m_points) { // they are in spatial order: most often it is not far
      w.face = start;
      go_downhill(w);
      if (w.distance <= m_far) start = w.face;
    }
    find_far();
  }

  /// The same for a copy of that mesh.
  Surface_watch(const Surface_watch& other, const Star_mesh& mesh) : Surface_watch(other)
  {
    m_mesh = &mesh;
  }

  int size() const { return int(m_points.size()); }
  const Watched& operator[](int i) const { return m_points[i]; }

  double max_distance() const
  {
    double d = 0;
    for (const Watched& w : m_points) d = std::max(d, w.distance);
    return d;
  }

  /// After any changes of the mesh.
  void update()
  {
    for (Watched& w : m_points) go_downhill(w);
    find_far();
  }

  /// The largest distance of what is nearest to the star of `v`, with `v` at `p`; or any that is no
  /// less than `limit`.
  double farthest_around(Vertex v, const Vec3d& p,
                         double limit = std::numeric_limits<double>::infinity()) const
  {
    const Faces faces = patch(v);
    double farthest = 0;
    for (const Halfedge h : halfedges_around_target(v, topology()))
      if (!topology().is_border(h))
        for (const int i : m_at_face[topology().face(h)]) {
          Watched w = m_points[i];
          find(w, faces, v, p);
          farthest = std::max(farthest, w.distance);
          if (farthest >= limit) return farthest;
        }
    return farthest;
  }

  /// After `v` has moved.
  void update_around(Vertex v)
  {
    const Faces faces = patch(v);
    boost::container::small_vector<int, 64> watched;
    for (const Halfedge h : halfedges_around_target(v, topology())) {
      if (topology().is_border(h)) continue;
      auto& here = m_at_face[topology().face(h)];
      watched.insert(watched.end(), here.begin(), here.end());
      here.clear();
    }
    for (const int i : watched) {
      find(m_points[i], faces, v, m_mesh->point(v));
      m_at_face[topology().face(m_points[i].face)].push_back(i);
    }
  }

private:
  static constexpr std::size_t most = 16;       // points for each vertex of the mesh
  static constexpr double largest_turn = -0.35; // cosine
  static constexpr double large = 0.25;         // distance, in units of sqrt(area / n)
  static constexpr int max_steps = 30;          // downhill

  using Faces = boost::container::small_vector<Face, 32>;

  const Working_mesh::Mesh& topology() const { return m_mesh->working().mesh; }

  // In spatial order. Of a surface with very many vertices, every k-th.
  void choose_points()
  {
    const Surface& surface = m_mesh->guide().surface();
    const auto& facets = m_mesh->guide().facets();
    const std::size_t vertices = surface.points.size(),
                      stride = 1 + vertices / (most * m_mesh->size());
    std::vector<int> numbers(vertices, -1); // of the points
    std::vector<char> seen(vertices, false);
    std::size_t order = 0;
    for (int place = 0; place < facets.tree.items; ++place) {
      const int f = facets.facets[place].id;
      for (const int v : surface.triangles[f]) {
        if (!std::exchange(seen[v], true) && order++ % stride == 0) {
          numbers[v] = size();
          m_points.push_back({surface.points[v],
                              surface.vertex_normals[v],
                              0,
                              Halfedge(),
                              {1, 0, 0},
                              surface.points[v],
                              0});
        }
        if (numbers[v] >= 0) m_points[numbers[v]].weight += surface.facet_areas[f] / 3;
      }
    }
  }

  // Those that seem to be far are searched for in the whole mesh.
  void find_far()
  {
    std::vector<Watched*> far;
    for (Watched& w : m_points)
      if (w.distance > m_far) far.push_back(&w);
    if (!far.empty()) find(far);
    assign();
  }

  void find(const std::vector<Watched*>& some)
  {
    std::vector<Vec3d> points;
    std::vector<Triangle> triangles;
    std::vector<Halfedge> halfedges;
    for (const Vertex v : topology().vertices()) points.push_back(m_mesh->point(v));
    for (const Face f : topology().faces()) {
      const Halfedge h = topology().halfedge(f);
      halfedges.push_back(h);
      triangles.push_back({int(topology().source(h)), int(topology().target(h)),
                           int(topology().target(topology().next(h)))});
    }
    const Facet_tree tree(points, triangles);
    int hint = -1;
    for (Watched* w : some) {
      hint = nearest_facet(tree.view(), w->point, w->normal, largest_turn, hint).facet;
      if (hint < 0) hint = tree.nearest(w->point).facet; // none agrees: any
      look_at(*w, halfedges[hint], Vertex(), {}, any);
    }
  }

  void assign()
  {
    m_at_face.resize(topology().number_of_faces());
    for (auto& here : m_at_face) here.clear();
    for (int i = 0; i < size(); ++i) m_at_face[topology().face(m_points[i].face)].push_back(i);
  }

  static bool agrees(const Watched& w, const Vec3d& a, const Vec3d& b, const Vec3d& c)
  {
    const Vec3d n = cross(b - a, c - a);
    return dot(n, w.normal) > largest_turn * length(n);
  }

  // Takes the face of `h` if it is nearer than `distance` and agrees, or if `distance` is `any`.
  // With v at p.
  bool look_at(Watched& w, Halfedge h, Vertex v, const Vec3d& p, double distance) const
  {
    const auto& mesh = topology();
    const auto at = [&](Vertex u) { return u == v ? p : m_mesh->point(u); };
    const Vec3d a = at(mesh.source(h)), b = at(mesh.target(h)), c = at(mesh.target(mesh.next(h)));
    const Vec3d y = nearest_point_on_triangle(w.point, a, b, c);
    const double d = length(y - w.point);
    if (distance < any && !(d < distance && agrees(w, a, b, c))) return false;
    double beta, gamma;
    barycentric_coordinates(y, a, b, c, beta, gamma);
    w.face = h;
    w.nearest = y;
    w.distance = d;
    w.barycentric = {1 - beta - gamma, beta, gamma};
    return true;
  }

  // From the face on to those at the edge or corner where the nearest point is.
  void go_downhill(Watched& w) const
  {
    const auto& mesh = topology();
    look_at(w, w.face, Vertex(), {}, any);
    if (!agrees(w, m_mesh->point(mesh.source(w.face)), m_mesh->point(mesh.target(w.face)),
                m_mesh->point(mesh.target(mesh.next(w.face)))))
      w.distance = disagreement; // worse than all that agree
    for (int step = 0; step < max_steps; ++step) {
      const std::array<Halfedge, 3> around{w.face, mesh.next(w.face), mesh.prev(w.face)};
      int corner = -1, opposite = -1; // of the corners source, target, apex
      for (int k = 0; k < 3; ++k) {
        if (w.barycentric[k] >= 1 - rounding)
          corner = k;
        else if (w.barycentric[k] <= rounding)
          opposite = k;
      }
      bool nearer = false;
      if (corner >= 0) {
        for (const Halfedge h : halfedges_around_target(around[(corner + 2) % 3], mesh))
          if (!mesh.is_border(h) && mesh.face(h) != mesh.face(w.face))
            nearer |= look_at(w, h, Vertex(), {}, closer * w.distance);
      } else if (opposite >= 0) {
        const Halfedge h = mesh.opposite(around[(opposite + 1) % 3]);
        if (!mesh.is_border(h)) nearer = look_at(w, h, Vertex(), {}, closer * w.distance);
      }
      if (!nearer) return;
    }
  }

  // The faces around v and its neighbours.
  Faces patch(Vertex v) const
  {
    const auto& mesh = topology();
    Faces faces;
    for (const Halfedge h : halfedges_around_target(v, mesh))
      for (const Halfedge g : halfedges_around_target(mesh.opposite(h), mesh))
        if (!mesh.is_border(g)) faces.push_back(mesh.face(g));
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    return faces;
  }

  void find(Watched& w, const Faces& faces, Vertex v, const Vec3d& p) const
  {
    look_at(w, w.face, v, p, any);
    for (const Face f : faces) look_at(w, topology().halfedge(f), v, p, w.distance);
  }

  static constexpr double disagreement = std::numeric_limits<double>::max();
  static constexpr double any = std::numeric_limits<double>::infinity();
  static constexpr double rounding = 1e-9;   // of barycentric coordinates
  static constexpr double closer = 1 - 1e-9; // what is less than this times is less

  const Star_mesh* m_mesh;
  double m_far; // the least distance that is searched for in the whole mesh
  std::vector<Watched> m_points;
  std::vector<boost::container::small_vector<int, 12>> m_at_face; // by face: the points
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_SURFACE_WATCH_H
