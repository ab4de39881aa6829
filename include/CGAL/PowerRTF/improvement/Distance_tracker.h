// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one-sided distance from the surface to the mesh, sampled at the surface's vertices. For each
// of them the nearest point of the mesh is kept, on a face whose normal agrees (if there is one).
// After changes of the mesh it is updated by descent from face to face, which can overestimate
// small distances; large ones are exact.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_DISTANCE_TRACKER_H
#define CGAL_POWER_RTF_IMPROVEMENT_DISTANCE_TRACKER_H

#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Distance_tracker {
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Face = Working_mesh::Face;

  /// A point of the surface and where the mesh is nearest to it.
  struct Tracked_point {
    Vec3d point, normal;
    double weight; ///< area of the surface that it stands for, of its vertices
    Halfedge face;
    std::array<double, 3> barycentric; ///< of the nearest point: source, target, apex of `face`
    Vec3d nearest;
    double distance;
    int facet; ///< of the surface, at the point
  };

  /// \pre `mesh` has a face
  explicit Distance_tracker(const Star_mesh& mesh)
      : m_mesh(&mesh),
        m_tree_search_distance(Parameters::tree_search_distance *
                               std::sqrt(mesh.projector().surface().area / double(mesh.size()))),
        m_seen(mesh.size(), 0)
  {
    choose_points();
    const std::vector<Halfedge> starts = first_faces();
    for_each_chunk(mesh.concurrency(), size(), chunk, [&](int begin, int end) {
      Halfedge start = starts[begin / chunk];
      for (int i = begin; i < end; ++i) { // in spatial order: most often it is not far
        Tracked_point& w = m_points[i];
        w.face = start;
        descend(w);
        if (w.distance <= m_tree_search_distance) start = w.face;
      }
    });
    find_far();
  }

  /// After the mesh has become another one with the same number of faces.
  void update_all()
  {
    m_seen.assign(m_mesh->size(), 0);
    update();
  }

  int size() const { return int(m_points.size()); }
  const Tracked_point& operator[](int i) const { return m_points[i]; }

  /// Those that are nearest to a face.
  const auto& at_face(Face f) const { return m_at_face[f]; }

  double max_distance() const
  {
    return reduce(
        m_mesh->concurrency(), size(), 0.,
        [&](double& d, int i) { d = std::max(d, m_points[i].distance); },
        [](double& d, double part) { d = std::max(d, part); });
  }

  /// The points that are farther away, in order.
  std::vector<int> farther_than(double distance) const
  {
    return select(m_mesh->concurrency(), size(),
                  [&](int i) { return m_points[i].distance > distance; });
  }

  /// After any changes of the mesh.
  void update()
  {
    const int vertices = int(m_mesh->size());
    std::vector<char> changed(vertices); // by vertex: its star
    for_each_index(m_mesh->concurrency(), vertices,
                   [&](int i) { changed[i] = has_changed_around(Vertex(Vertex::size_type(i))); });
    for_each_index(m_mesh->concurrency(), size(), [&](int i) {
      Tracked_point& w = m_points[i];
      const auto [a, b, c] = m_mesh->working().corners(w.face);
      if (changed[a] || changed[b] || changed[c]) descend(w);
    });
    for_each_index(m_mesh->concurrency(), vertices,
                   [&](int i) { m_seen[i] = m_mesh->changes(Vertex(Vertex::size_type(i))); });
    find_far();
  }

  /// The largest distance of what is nearest to the star of `v`, with `v` at `p`; or any that is no
  /// less than `limit`.
  double farthest_around(Vertex v, const Vec3d& p,
                         double limit = std::numeric_limits<double>::infinity()) const
  {
    const Faces faces = patch(v, p);
    double farthest = 0;
    for (const Halfedge h : halfedges_around_target(v, topology()))
      if (!topology().is_border(h))
        for (const int i : m_at_face[topology().face(h)]) {
          Tracked_point w = m_points[i];
          search_faces(w, faces, v, p);
          farthest = std::max(farthest, w.distance);
          if (farthest >= limit) return farthest;
        }
    return farthest;
  }

  /// After `v` has moved.
  void update_around(Vertex v)
  {
    const Faces faces = patch(v, m_mesh->point(v));
    boost::container::small_vector<int, 64> tracked;
    for (const Halfedge h : halfedges_around_target(v, topology())) {
      if (topology().is_border(h)) continue;
      auto& here = m_at_face[topology().face(h)];
      tracked.insert(tracked.end(), here.begin(), here.end());
      here.clear();
    }
    for (const int i : tracked) {
      search_faces(m_points[i], faces, v, m_mesh->point(v));
      m_at_face[topology().face(m_points[i].face)].push_back(i);
    }
  }

private:
  using Parameters = Improvement_parameters::Tracking;
  using Projection = Improvement_parameters::Projection;
  static constexpr int chunk = 1024; // of the points

  // A face in a ball.
  struct Bounded_face {
    Halfedge halfedge;
    Vec3d center;
    double radius;
  };
  using Faces = boost::container::small_vector<Bounded_face, 32>;

  const Working_mesh::Mesh& topology() const { return m_mesh->working().mesh; }

  // In spatial order. Of a surface with very many vertices, every k-th.
  void choose_points()
  {
    const Surface& surface = m_mesh->projector().surface();
    const std::size_t vertices = surface.points.size();
    const std::size_t stride = 1 + vertices / (Parameters::max_points_per_vertex * m_mesh->size());
    std::vector<int> numbers(vertices, -1); // of the points
    std::vector<char> seen(vertices, false);
    std::size_t order = 0;
    for (const int f : m_mesh->projector().tree().order())
      for (const int v : surface.triangles[f]) {
        if (!std::exchange(seen[v], true) && order++ % stride == 0) {
          numbers[v] = size();
          m_points.push_back({surface.points[v],
                              surface.vertex_normals[v],
                              0,
                              Halfedge(),
                              {1, 0, 0},
                              surface.points[v],
                              0,
                              f});
        }
        if (numbers[v] >= 0) m_points[numbers[v]].weight += surface.facet_areas[f] / 3;
      }
  }

  // By chunk of the points: a face near its first.
  std::vector<Halfedge> first_faces() const
  {
    const Facet_tree& tree = m_mesh->projector().tree();
    std::vector<Vertex> at_place(tree.order().size()); // of the tree: one that its facet carries
    for (const Vertex v : topology().vertices())
      if (!topology().is_isolated(v)) at_place[tree.place(m_mesh->facet(v))] = v;
    std::vector<Halfedge> faces;
    for (int first = 0; first < size(); first += chunk) {
      const int place = tree.place(m_points[first].facet), places = int(at_place.size());
      int distance = 0;
      const auto is_at = [&](int at) { return at >= 0 && at < places && at_place[at] != Vertex(); };
      while (!is_at(place - distance) && !is_at(place + distance)) ++distance;
      const Halfedge h = topology().halfedge(
          at_place[is_at(place - distance) ? place - distance : place + distance]);
      faces.push_back(topology().is_border(h) ? topology().opposite(h) : h);
    }
    return faces;
  }

  // Since the last update.
  bool has_changed_around(Vertex v) const
  {
    const auto has_changed = [this](Vertex u) { return m_mesh->changes(u) != m_seen[u]; };
    if (has_changed(v) || topology().is_isolated(v)) return has_changed(v);
    for (const Halfedge h : halfedges_around_target(v, topology()))
      if (has_changed(topology().source(h))) return true;
    return false;
  }

  // Those that seem to be far are searched for in the whole mesh.
  void find_far()
  {
    const std::vector<int> far = farther_than(m_tree_search_distance);
    if (!far.empty()) search_mesh(far);
    assign();
  }

  // \pre all faces are there: what has been taken out has been put back elsewhere
  void search_mesh(const std::vector<int>& some)
  {
    std::vector<Vec3d> points;
    const std::vector<Triangle> triangles = m_mesh->working().triangles();
    for (const Vertex v : topology().vertices()) points.push_back(m_mesh->point(v));
    if (!m_tree)
      m_tree.emplace(points, triangles, std::vector<int>(), m_mesh->concurrency());
    else
      m_tree->refit(points, triangles);
    for_each_chunk(m_mesh->concurrency(), int(some.size()), 16, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        Tracked_point& w = m_points[some[k]];
        const int hint = int(topology().face(w.face));
        int f = m_tree->nearest(w.point, w.normal, Projection::min_normal_cosine, hint).facet;
        if (f < 0) f = m_tree->nearest(w.point, hint).facet; // none agrees: any
        try_face(w, topology().halfedge(Face(Face::size_type(f))), Vertex(), {}, any);
      }
    });
  }

  void assign()
  {
    m_at_face.resize(topology().number_of_faces());
    for_each_index(m_mesh->concurrency(), int(m_at_face.size()),
                   [&](int f) { m_at_face[f].clear(); });
    for (int i = 0; i < size(); ++i) m_at_face[topology().face(m_points[i].face)].push_back(i);
  }

  static bool agrees(const Tracked_point& w, const Vec3d& a, const Vec3d& b, const Vec3d& c)
  {
    const Vec3d n = cross(b - a, c - a);
    return dot(n, w.normal) > Projection::min_normal_cosine * length(n);
  }

  // Assigns the face of `h` to the point if it is nearer than `distance` and agrees, or if
  // `distance` is `any`. With v at p.
  bool try_face(Tracked_point& w, Halfedge h, Vertex v, const Vec3d& p, double distance) const
  {
    const auto [a, b, c] = corners(h, v, p);
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

  // Goes from the face on to those at the edge or corner where the nearest point is.
  void descend(Tracked_point& w) const
  {
    const auto& mesh = topology();
    try_face(w, w.face, Vertex(), {}, any);
    if (const auto [a, b, c] = m_mesh->points(w.face); !agrees(w, a, b, c))
      w.distance = disagreement; // worse than all that agree
    for (int step = 0; step < Projection::max_downhill_steps; ++step) {
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
            nearer |= try_face(w, h, Vertex(), {}, clearly_less * w.distance);
      } else if (opposite >= 0) {
        const Halfedge h = mesh.opposite(around[(opposite + 1) % 3]);
        if (!mesh.is_border(h)) nearer = try_face(w, h, Vertex(), {}, clearly_less * w.distance);
      }
      if (!nearer) return;
    }
  }

  // The faces around v, which is at p, and its neighbors.
  Faces patch(Vertex v, const Vec3d& p) const
  {
    Faces faces;
    for (const Face f : m_mesh->working().faces_near(v)) {
      const Halfedge h = topology().halfedge(f);
      const auto [a, b, c] = corners(h, v, p);
      const Vec3d center = (a + b + c) * (1 / 3.);
      const double squared_radius = std::max(
          {squared_length(a - center), squared_length(b - center), squared_length(c - center)});
      faces.push_back({h, center, std::sqrt(squared_radius)});
    }
    return faces;
  }

  // With v at p.
  std::array<Vec3d, 3> corners(Halfedge h, Vertex v, const Vec3d& p) const
  {
    const auto at = [&](Vertex u) { return u == v ? p : m_mesh->point(u); };
    const auto [a, b, c] = m_mesh->working().corners(h);
    return {at(a), at(b), at(c)};
  }

  void search_faces(Tracked_point& w, const Faces& faces, Vertex v, const Vec3d& p) const
  {
    try_face(w, w.face, v, p, any);
    for (const Bounded_face& f : faces) {
      const double reach = clearly_less * length(w.point - f.center) - f.radius;
      if (reach < w.distance) try_face(w, f.halfedge, v, p, w.distance);
    }
  }

  static constexpr double disagreement = std::numeric_limits<double>::max();
  static constexpr double any = std::numeric_limits<double>::infinity();
  static constexpr double rounding = 1e-9; // of barycentric coordinates

  const Star_mesh* m_mesh;
  std::optional<Facet_tree> m_tree; // of the mesh's faces
  double m_tree_search_distance;    // the least distance that is searched for in the whole mesh
  std::vector<unsigned> m_seen;     // by vertex: its changes at the last update
  std::vector<Tracked_point> m_points;
  std::vector<boost::container::small_vector<int, 12>> m_at_face; // by face: the points
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_DISTANCE_TRACKER_H
