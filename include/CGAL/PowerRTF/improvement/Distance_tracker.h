// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one-sided distance from the surface to the mesh, sampled at the surface's vertices, or at
// other points. For each of them the nearest point of the mesh is kept, on a face whose normal
// agrees (if there is one). After changes of the mesh it is updated by descent from face to face,
// which can overestimate small distances; large ones are exact.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_DISTANCE_TRACKER_H
#define CGAL_POWER_RTF_IMPROVEMENT_DISTANCE_TRACKER_H

#include <CGAL/PowerRTF/improvement/Changed_vertices.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Points_by_face.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/nearest_faces.h>
#include <CGAL/PowerRTF/improvement/tracked_points.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <boost/container/small_vector.hpp>
#include <boost/range/iterator_range.hpp>

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

  /// Of the surface's vertices. `faces`: the nearest of those that agree with each, or -1; or none
  /// are known. \pre `mesh` has a face
  Distance_tracker(const Star_mesh& mesh, Unset_vector<Tracked_point>&& points,
                   const Unset_vector<int>& faces = {})
      : Distance_tracker(mesh, {}, std::move(points),
                         Parameters::tree_search_distance *
                             std::sqrt(mesh.projector().surface().area / double(mesh.size())),
                         faces)
  {}

  /// Of `others` instead; any face may be nearest to them. From `exact` on distances are.
  Distance_tracker(const Star_mesh& mesh, Surface_points&& others, double exact)
      : Distance_tracker(mesh, std::move(others), tracked_points(others), exact, {})
  {}

  /// After the mesh has become another one with the same number of faces.
  void update_all()
  {
    m_changed.add_all();
    m_finder.forget();
    update();
  }

  int size() const { return int(m_points.size()); }
  const Tracked_point& operator[](int i) const { return m_points[i]; }
  /// Of the surface, as its normal.
  const Vec3d& point(int i) const { return point(m_points[i]); }
  /// \pre it is a vertex
  const Vec3d& normal(int i) const { return surface().vertex_normals[m_points[i].vertex]; }

  /// Those that are nearest to a face.
  boost::iterator_range<const int*> at_face(Face f) const { return m_faces.at(f); }

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
    if (distance >= m_tree_search_distance) return farther_than(distance, m_far);
    return select(m_mesh->concurrency(), size(),
                  [&](int i) { return m_points[i].distance > distance; });
  }

  /// After any changes of the mesh.
  void update()
  {
    const std::vector<int> changed = m_changed.take(), near = points_near(changed);
    for_each_index(m_mesh->concurrency(), int(near.size()),
                   [&](int k) { descend_anew(m_points[near[k]], changed); });
    const std::vector<int> farther = farther_than(m_tree_search_distance, near);
    m_far.insert(m_far.end(), farther.begin(), farther.end());
    const std::vector<int> far = find_far();
    constexpr std::size_t points_per_change = 8; // where it pays to go through those alone
    if (points_per_change * (near.size() + far.size()) > m_points.size()) {
      assign();
    } else {
      for (const int i : near) reassign(i);
      for (const int i : far) reassign(i);
    }
  }

  /// Before an update: whether the points at what has changed are no farther away than `distance`,
  /// as descents from where they were tell.
  bool are_within(double distance) const
  {
    const std::vector<int> changed = m_changed.find(), near = points_near(changed);
    return std::all_of(near.begin(), near.end(), [&](int i) {
      Tracked_point w = m_points[i];
      descend_anew(w, changed);
      return w.distance <= distance;
    });
  }

  /// Instead of an update, where the mesh is again as it was at the last one.
  void skip_update() { m_changed.take(); }

  /// The largest distance of what is nearest to the star of `v`, with `v` at `p`, but no less than
  /// `enough`; or any that is no less than `limit`. `at`: the point that has been farthest, or -1,
  /// is looked at first.
  double farthest_around(Vertex v, const Vec3d& p, double limit, double enough, int& at) const
  {
    const Faces faces = patch(v, p);
    double farthest = enough;
    const double step = length(p - m_mesh->point(v)); // no distance grows by more
    const auto reaches_limit = [&](int i) {
      if (m_points[i].distance + step < clearly_less * farthest) return false;
      Tracked_point w = m_points[i];
      search_faces(w, faces, v, p, farthest);
      if (w.distance > farthest) farthest = w.distance, at = i;
      return farthest >= limit;
    };
    if (at >= 0 && reaches_limit(at)) return farthest;
    for (const Halfedge h : halfedges_around_target(v, topology()))
      if (!topology().is_border(h))
        for (const int i : at_face(topology().face(h)))
          if (reaches_limit(i)) return farthest;
    return farthest;
  }
  double farthest_around(Vertex v, const Vec3d& p,
                         double limit = std::numeric_limits<double>::infinity()) const
  {
    int at = -1;
    return farthest_around(v, p, limit, 0, at);
  }

  /// After `v` has moved.
  void update_around(Vertex v)
  {
    const Faces faces = patch(v, m_mesh->point(v));
    boost::container::small_vector<int, 64> tracked;
    for (const Halfedge h : halfedges_around_target(v, topology())) {
      if (topology().is_border(h)) continue;
      const auto here = at_face(topology().face(h));
      tracked.insert(tracked.end(), here.begin(), here.end());
    }
    for (const int i : tracked) {
      search_faces(m_points[i], faces, v, m_mesh->point(v));
      reassign(i);
      if (m_points[i].distance > m_tree_search_distance) m_far.push_back(i);
    }
  }

private:
  Distance_tracker(const Star_mesh& mesh, Surface_points&& others,
                   Unset_vector<Tracked_point>&& points, double exact,
                   const Unset_vector<int>& faces)
      : m_mesh(&mesh), m_tree_search_distance(exact), m_changed(mesh), m_finder(mesh),
        m_others(std::move(others)), m_points(std::move(points))
  {
    for_each_index(mesh.concurrency(), int(faces.size()), [&](int i) {
      if (faces[i] >= 0)
        try_face(m_points[i], topology().halfedge(Face(faces[i])), Vertex(), {}, any);
    });
    m_far = all();
    find_far();
    assign();
  }

  using Parameters = Improvement_parameters::Tracking;
  using Projection = Improvement_parameters::Projection;

  // A face in a ball.
  struct Bounded_face {
    Halfedge halfedge;
    Vec3d center;
    double radius;
  };
  using Faces = boost::container::small_vector<Bounded_face, 32>;

  const Working_mesh::Mesh& topology() const { return m_mesh->working().mesh; }
  const Surface& surface() const { return m_mesh->projector().surface(); }
  bool are_vertices() const { return m_others.points.empty(); }
  const Vec3d& point(const Tracked_point& w) const
  {
    return (are_vertices() ? surface().points : m_others.points)[w.vertex];
  }

  // Descends, for some points, from vertices of the mesh that the facet of the surface there
  // carries, or those near in the order of the tree, until a point is not far.
  void descend_from_carriers(const std::vector<int>& some)
  {
    const Concurrency concurrency = m_mesh->concurrency();
    const Facet_tree& tree = m_mesh->projector().tree();
    const int places = int(tree.order().size());
    // By place in the tree: the last vertex that its facet carries.
    Unset_vector<int> at_place = filled(concurrency, places, -1);
    for_each_index(concurrency, int(m_mesh->size()), [&](int v) {
      if (m_mesh->working().has_edges(Vertex(v)))
        atomic_max(&at_place[tree.place(m_mesh->facet(Vertex(v)))], v);
    });
    const auto descend_to = [&](Tracked_point& best) {
      const int place = tree.place(best.facet);
      for (int distance = 0, tries = 0; distance < places; ++distance)
        for (const int at : {place - distance, place + distance}) {
          if (at < 0 || at >= places || at_place[at] < 0) continue;
          Tracked_point w = best;
          const Halfedge h = topology().halfedge(Vertex(at_place[at]));
          w.face = topology().is_border(h) ? topology().opposite(h) : h;
          descend(w);
          if (w.distance < best.distance) best = w;
          if (best.distance <= m_tree_search_distance || ++tries == Parameters::max_carriers)
            return;
        }
    };
    for_each_chunk(concurrency, int(some.size()), 64, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) descend_to(m_points[some[k]]);
    });
  }

  std::vector<int> all() const
  {
    return select(m_mesh->concurrency(), size(), [](int) { return true; });
  }

  std::vector<int> points_near(const std::vector<int>& changed) const
  {
    if (changed.size() > Parameters::nearly_all * double(m_mesh->size())) return all();
    // Where it pays to look at what is near those alone; others are far more than the vertices.
    const std::size_t vertices_per_change = are_vertices() ? 32 : 2;
    return m_changed.are_few(changed, vertices_per_change) ? points_near_few(changed)
                                                           : points_near_many(changed);
  }

  // The points at faces that have been removed and at those near vertices that have changed: next
  // to these, or next to a neighbor. What is not far has to be known no better where its face is as
  // it was.
  std::vector<int> points_near_few(const std::vector<int>& changed) const
  {
    std::vector<int> points;
    const auto add_at = [&](Face f) {
      const auto here = at_face(f);
      points.insert(points.end(), here.begin(), here.end());
    };
    const auto add_around = [&](const auto& vertices) {
      for (const Face f : faces_around(*m_mesh, vertices)) add_at(f);
    };
    are_vertices() ? add_around(vertices_around(*m_mesh, changed)) : add_around(changed);
    if (topology().number_of_removed_faces() > 0)
      for (const int f : select(m_mesh->concurrency(), int(topology().num_faces()),
                                [&](int f) { return topology().is_removed(Face(f)); }))
        add_at(Face(f));
    return points;
  }

  std::vector<int> points_near_many(const std::vector<int>& changed) const
  {
    std::vector<char> has_changed(m_mesh->size()), is_near(m_mesh->size());
    for_each_index(m_mesh->concurrency(), int(changed.size()),
                   [&](int k) { has_changed[changed[k]] = true; });
    for_each_index(m_mesh->concurrency(), int(m_mesh->size()), [&](int i) {
      const Vertex v(i);
      is_near[v] = has_changed[v];
      if (is_near[v] || !m_mesh->working().has_edges(v)) return;
      for (const Halfedge h : halfedges_around_target(v, topology()))
        if (has_changed[topology().source(h)]) is_near[v] = true;
    });
    return select(m_mesh->concurrency(), size(), [&](int i) {
      if (topology().is_removed(m_points[i].face) || topology().is_removed(m_faces.face(i)))
        return true;
      const auto [a, b, c] = m_mesh->working().corners(m_points[i].face);
      return is_near[a] || is_near[b] || is_near[c];
    });
  }

  // Of a face at the nearest of these vertices.
  Halfedge halfedge_near(const Vec3d& p, const std::vector<int>& vertices) const
  {
    double least = any;
    Halfedge nearest;
    for (const int v : vertices) {
      if (!m_mesh->working().has_edges(Vertex(v))) continue;
      const double d = squared_length(m_mesh->point(Vertex(v)) - p);
      if (d >= least) continue;
      least = d;
      nearest = topology().halfedge(Vertex(v));
    }
    return topology().is_border(nearest) ? topology().opposite(nearest) : nearest;
  }

  // Those of them that are farther away, in order.
  std::vector<int> farther_than(double distance, const std::vector<int>& some) const
  {
    std::vector<int> far;
    for (const int k : select(m_mesh->concurrency(), int(some.size()),
                              [&](int k) { return m_points[some[k]].distance > distance; }))
      far.push_back(some[k]);
    std::sort(far.begin(), far.end());
    far.erase(std::unique(far.begin(), far.end()), far.end());
    return far;
  }

  // Those that seem to be far are searched for in the whole mesh. Returns them.
  std::vector<int> find_far()
  {
    // Where it pays to look at all vertices before: so many, and more for each point.
    constexpr std::size_t few = 1 << 16, vertices_per_point = 512;
    m_far = farther_than(m_tree_search_distance);
    const std::vector<int> far = m_far;
    if (far.empty()) return far;
    if (are_vertices() && m_mesh->size() <= few + vertices_per_point * far.size()) {
      descend_from_carriers(far);
      m_far = farther_than(m_tree_search_distance);
    }
    if (!m_far.empty()) search_mesh(m_far);
    m_far = farther_than(m_tree_search_distance);
    return far;
  }

  void search_mesh(const std::vector<int>& some)
  {
    std::vector<Far_point> far;
    for (const int i : some)
      far.push_back({point(i), m_points[i].distance, are_vertices() ? &normal(i) : nullptr});
    const std::vector<Face> faces = m_finder.find(std::move(far));
    for_each_index(m_mesh->concurrency(), int(some.size()), [&](int k) {
      try_face(m_points[some[k]], topology().halfedge(faces[k]), Vertex(), {}, any);
    });
  }

  Face face(int i) const { return topology().face(m_points[i].face); }

  void assign()
  {
    m_faces.assign(m_mesh->concurrency(), size(), topology().num_faces(),
                   [this](int i) { return face(i); });
  }

  void reassign(int i) { m_faces.move(i, face(i)); }

  bool agrees(const Tracked_point& w, const Vec3d& a, const Vec3d& b, const Vec3d& c) const
  {
    return !are_vertices() || internal::agrees(surface().vertex_normals[w.vertex], a, b, c);
  }

  // Assigns the face of `h` to the point if it is nearer than `distance` and agrees, or if
  // `distance` is `any`. With v at p. Returns where on the face the nearest point is.
  std::optional<Triangle_part> try_face(Tracked_point& w, Halfedge h, Vertex v, const Vec3d& p,
                                        double distance) const
  {
    const auto [a, b, c] = corners(h, v, p);
    const Vec3d& x = point(w);
    Triangle_part part;
    const Vec3d y = nearest_point_on_triangle(x, a, b, c, part);
    const double d = length(y - x);
    if (distance < any && !(d < distance && agrees(w, a, b, c))) return {};
    w.face = h;
    w.nearest = y;
    w.distance = d;
    return part;
  }

  // If the face has been removed, from one at a vertex that has changed.
  void descend_anew(Tracked_point& w, const std::vector<int>& changed) const
  {
    if (topology().is_removed(w.face)) w.face = halfedge_near(point(w), changed);
    descend(w);
  }

  // Goes from the face on to those at the edge or corner where the nearest point is.
  void descend(Tracked_point& w) const
  {
    const auto& mesh = topology();
    Triangle_part part = *try_face(w, w.face, Vertex(), {}, any);
    if (const auto [a, b, c] = m_mesh->points(w.face); !agrees(w, a, b, c))
      w.distance = unknown_distance; // worse than all that agree
    for (int step = 0; step < Projection::max_downhill_steps; ++step) {
      if (part.kind == Triangle_part::inside) return;
      const std::array<Halfedge, 3> around{w.face, mesh.next(w.face), mesh.prev(w.face)};
      bool nearer = false;
      const auto try_next = [&](Halfedge h) {
        if (mesh.is_border(h)) return;
        if (const auto there = try_face(w, h, Vertex(), {}, clearly_less * w.distance)) {
          part = *there;
          nearer = true;
        }
      };
      if (part.kind == Triangle_part::edge) {
        try_next(mesh.opposite(around[part.index]));
      } else { // the corners are source, target and apex of the face
        const Face from = mesh.face(w.face);
        for (const Halfedge h : halfedges_around_target(around[(part.index + 2) % 3], mesh))
          if (mesh.face(h) != from) try_next(h);
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

  // Ends where the point is no farther than `enough`.
  void search_faces(Tracked_point& w, const Faces& faces, Vertex v, const Vec3d& p,
                    double enough = 0) const
  {
    try_face(w, w.face, v, p, any);
    for (const Bounded_face& f : faces) {
      if (w.distance <= enough) return;
      const double reach = clearly_less * length(point(w) - f.center) - f.radius;
      if (reach < w.distance) try_face(w, f.halfedge, v, p, w.distance);
    }
  }

  static constexpr double any = std::numeric_limits<double>::infinity();

  const Star_mesh* m_mesh;
  double m_tree_search_distance; // the least distance that is searched for in the whole mesh
  Changed_vertices m_changed;    // since the last update
  Nearest_face_finder m_finder;
  Surface_points m_others; // or none: the surface's vertices are tracked
  Unset_vector<Tracked_point> m_points;
  std::vector<int> m_far; // all that are farther than is searched for, and others
  Points_by_face m_faces; // as of the last update
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_DISTANCE_TRACKER_H
