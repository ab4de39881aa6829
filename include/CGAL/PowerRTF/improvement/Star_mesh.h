// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh that the improvement works on: the working mesh, the place of each vertex on the
// surface, which vertices may move, and when each has changed. A move is tried on the star of a
// vertex and kept only if it folds nothing; a flip that is undone leaves no trace. The ends of
// feature edges, kept vertices and those on borders never move; features have no normal: what lies
// beside them is judged by its own side alone.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_STAR_MESH_H
#define CGAL_POWER_RTF_IMPROVEMENT_STAR_MESH_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Surface_projector.h>
#include <CGAL/PowerRTF/improvement/Undoable_edits.h>
#include <CGAL/PowerRTF/internal/mixed_bits.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/Star_view.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The edges around a vertex, one for each of its triangles: the triangle (v, a, b) is
/// counter-clockwise.
struct Star {
  struct Corner {
    Vec3d a, b;
    Working_mesh::Vertex vertex_a, vertex_b;
  };
  boost::container::small_vector<Corner, 12> corners;

  template <class F>
  void for_each(const F& f) const
  {
    for (const Corner& c : corners) f(c);
  }

  /// `sum` and `energy(p, a, b)`, never negative, of the triangles with the center at `p`; or what
  /// is no less than `limit`.
  template <class Energy>
  double sum(const Vec3d& p, const Energy& energy,
             double limit = std::numeric_limits<double>::infinity(), double sum = 0) const
  {
    for (const Corner& c : corners)
      if (!((sum += energy(p, c.a, c.b)) < limit)) break;
    return sum;
  }
};

class Star_mesh {
public:
  using Vertex = Working_mesh::Vertex;
  using Halfedge = Working_mesh::Halfedge;
  using Edge = Working_mesh::Edge;
  /// Stands for all that has happened to a vertex and its neighbors.
  using State = std::uint64_t;

  /// `carriers`: for the first points of `mesh`, or none, the facets that they probably lie on.
  /// `concurrency`: of the loops over all of it. `find`: what finds links instead, where it does.
  /// `memory`: a mesh whose memory is used, or an empty one.
  /// \throw Invalid_input_error if `mesh` is no oriented 2-manifold
  Star_mesh(const Extracted_mesh& mesh, const Surface_projector& projector,
            const std::vector<int>& carriers = {}, Concurrency concurrency = Sequential_tag(),
            const Find_links& find = {}, Working_mesh::Mesh&& memory = Working_mesh::Mesh())
      : m_concurrency(concurrency), m_projector(&projector),
        m(mesh.points, mesh.triangles, concurrency, find, std::move(memory)),
        m_facets(mesh.points.size()), m_heights(filled(concurrency, mesh.points.size(), 0.)),
        m_locked(filled(concurrency, mesh.points.size(), no)), m_movable(mesh.points.size()),
        m_pinned(filled(concurrency, mesh.points.size(), no)),
        m_on_feature(filled(concurrency, mesh.points.size(), no)), m_kept(mesh.points.size()),
        m_changes(filled(concurrency, mesh.points.size(), 1u)),
        m_is_feature(filled(concurrency, m.mesh.number_of_edges(), no))
  {
    const std::size_t n = mesh.points.size();
    constexpr double rounding = 1e-3; // of a point on the surface, in units of the spacing
    const double reach = rounding * std::sqrt(projector.surface().area / double(n));
    m.normals.resize(n);
    m.mirror = projector.surface().mirror;
    if (!mesh.places.empty()) m.set_places(mesh.places);
    for (const auto& [a, b] : mesh.feature_edges) {
      m_on_feature[a] = m_on_feature[b] = true;
      const Halfedge h = m.mesh.halfedge(Vertex(a), Vertex(b));
      if (h.is_valid()) m_is_feature[m.mesh.edge(h)] = true;
    }
    for_each_chunk(concurrency, int(n), 256, [&](int begin, int end) {
      for (int v = begin; v < end; ++v) {
        const Vec3d& p = mesh.points[v];
        const auto place = std::size_t(v) < carriers.size()
                               ? projector.on_facet(p, carriers[v], reach)
                               : projector.nearest(p, v > begin ? m_facets[v - 1] : -1);
        m_facets[v] = place.facet;
        m.normals[v] = place.normal;
        m_kept[v] = mesh.is_kept(v);
        if (m_kept[v]) m_on_feature[v] = true;
        m_movable[v] = is_interior(Vertex(v));
      }
    });
  }

  /// `locked`: by vertex, those that neither move nor get or lose an edge.
  void lock(const std::vector<char>& locked)
  {
    for_each_index(m_concurrency, int(size()), [&](int v) {
      m_locked[v] = locked[v];
      if (locked[v]) m_movable[v] = false;
    });
  }

  /// Undoes `lock()`.
  void unlock()
  {
    for (const Vertex v : m.mesh.vertices()) {
      if (!m_locked[v]) continue;
      touch(v);
      m_locked[v] = false, m_movable[v] = is_interior(v);
    }
  }

  Concurrency concurrency() const { return m_concurrency; }
  /// Whether a checkpoint of this thread is alive: then it does all by itself.
  bool is_noted() const { return checkpoint() != nullptr; }
  Working_mesh& working() { return m; }
  const Working_mesh& working() const { return m; }
  const Surface_projector& projector() const { return *m_projector; }
  std::size_t size() const { return m_facets.size(); }
  bool is_movable(Vertex v) const { return m_movable[v]; }
  /// A pinned vertex does not move until it is released.
  void pin(Vertex v)
  {
    touch(v);
    m_movable[v] = false, m_pinned[v] = true;
  }
  /// \returns whether `v` was pinned.
  bool release(Vertex v)
  {
    if (!m_pinned[v]) return false;
    touch(v);
    m_movable[v] = true, m_pinned[v] = false;
    return true;
  }

  /// How often `v` or its edges have changed; at least 1.
  unsigned changes(Vertex v) const { return m_changes[v]; }
  /// Another one after each change of `v` or a neighbor; 0 is none.
  State state_around(Vertex v) const
  {
    State sum = state(v);
    if (!m.has_edges(v)) return sum;
    for (const Halfedge h : halfedges_around_target(v, m.mesh)) sum += state(m.mesh.source(h));
    return sum;
  }
  /// `v` counts as changed. Comes before each change of it.
  void touch(Vertex v)
  {
    if (Checkpoint* const c = checkpoint())
      c->m_past.push_back(
          {v, place(v), m_heights[v], m_changes[v], m_locked[v], m_movable[v], m_pinned[v]});
    ++m_changes[v];
  }

  Vec3d point(Vertex v) const { return m.point(v); }
  /// The corners of the face at `h`.
  std::array<Vec3d, 3> points(Halfedge h) const
  {
    const auto [a, b, c] = m.corners(h);
    return {m.point(a), m.point(b), m.point(c)};
  }
  const Vec3d& normal(Vertex v) const { return m.normals[v]; }
  int facet(Vertex v) const { return m_facets[v]; }
  /// By vertex.
  const Unset_vector<int>& facets() const { return m_facets; }

  /// Whether `v` has too many edges to look at all of them often.
  bool is_hub(Vertex v) const
  {
    constexpr int hub_degree = Improvement_parameters::Stars::hub_degree;
    return m.degree_up_to(hub_degree, v) == hub_degree;
  }

  bool is_on_feature(Vertex v) const { return m_on_feature[v]; }
  /// Whether `v` does not even slide along its feature.
  bool is_kept(Vertex v) const { return m_kept[v]; }
  bool is_feature(Edge e) const { return m_is_feature[e]; }
  bool is_locked(Vertex v) const { return m_locked[v]; }

  /// False for borders, features, and if one of the four vertices around the edge is locked.
  bool is_free(Edge e) const
  {
    if (m.mesh.is_border(e) || m_is_feature[e]) return false;
    const auto [a, b, c, d] = corners(e);
    return !(m_locked[a] || m_locked[b] || m_locked[c] || m_locked[d]);
  }

  Star star(Vertex v) const
  {
    Star s;
    for (const Halfedge h : halfedges_around_target(v, m.mesh)) {
      if (m.mesh.is_border(h)) continue;
      const Vertex a = m.apex(h), b = m.mesh.source(h);
      s.corners.push_back({m.point(a), m.point(b), a, b});
    }
    return s;
  }

  /// The place on the surface to which `v` would go.
  Surface_projector::Place project(Vertex v, const Vec3d& p) const
  {
    const double height = m_heights[v];
    auto place = m_projector->project(p - height * m.normals[v], m.normals[v], m_facets[v]);
    place.point += height * place.normal;
    return place;
  }

  double height(Vertex v) const { return m_heights[v]; }

  /// Moves `v`, off the surface too. False if no place of the surface agrees: then it stays.
  bool move_off(Vertex v, const Vec3d& p)
  {
    const auto place = m_projector->project(p, m.normals[v], m_facets[v]);
    if (place.facet < 0) return false;
    move(v, place);
    set_point(v, p);
    m_heights[v] = dot(p - place.point, place.normal);
    return true;
  }

  /// A triangle with the normals of the surface at its corners; 0: on a feature.
  struct Placed_triangle {
    std::array<Vec3d, 3> points, normals;
  };
  Placed_triangle placed(Vertex a, Vertex b, Vertex c) const
  {
    const auto normal = [this](Vertex v) {
      return m_on_feature[v] ? Vec3d{0, 0, 0} : m.normals[v];
    };
    return {{m.point(a), m.point(b), m.point(c)}, {normal(a), normal(b), normal(c)}};
  }

  /// See `star_agreement()`.
  double agreement(const Star& star, const Vec3d& p, const Vec3d& normal) const
  {
    return star_agreement(*this, star, p, normal);
  }

  /// The same for one triangle. Between features alone the surface's nearest facet counts.
  double agreement(const Placed_triangle& t) const
  {
    const auto& [a, b, c] = t.points;
    const Vec3d n = cross(b - a, c - a);
    const double l = length(n);
    if (!(l > 0)) return -1;
    double least = l;
    bool has_normal = false;
    for (const Vec3d& normal : t.normals)
      if (!(normal == Vec3d{0, 0, 0})) {
        least = std::min(least, dot(n, normal));
        has_normal = true;
      }
    if (!has_normal) least = dot(n, m_projector->nearest((a + b + c) * (1 / 3.)).normal);
    return least / l;
  }
  double agreement(Vertex a, Vertex b, Vertex c) const { return agreement(placed(a, b, c)); }

  /// The corners of its two triangles: its ends and the two that a flip joins.
  std::array<Vertex, 4> corners(Edge e) const
  {
    // not halfedge(e): that is the one that e was made from, and the order must not depend on it
    const Halfedge h = m.mesh.halfedge(e, 0), o = m.mesh.halfedge(e, 1);
    return {m.mesh.source(h), m.mesh.target(h), m.apex(h), m.apex(o)};
  }

  void flip(Edge e)
  {
    for (const Vertex v : corners(e)) touch(v);
    edits().flip(m.mesh, e);
  }

private:
  // What a vertex is, but for its edges.
  struct Vertex_state {
    Vertex vertex;
    Surface_projector::Place place;
    double height;
    unsigned changes;
    char is_locked, is_movable, is_pinned;
  };

public:
  /// As long as one lives, what its thread does to the mesh is noted and can be undone.
  class Checkpoint {
  public:
    explicit Checkpoint(Star_mesh& mesh) : m(mesh), m_outer(std::exchange(innermost(), this)) {}
    ~Checkpoint()
    {
      innermost() = m_outer;
      if (Checkpoint* const outer = m.checkpoint()) {
        outer->m_edits.append(std::move(m_edits));
        outer->m_past.insert(outer->m_past.end(), m_past.begin(), m_past.end());
      }
    }
    Checkpoint(const Checkpoint&) = delete;

    /// Brings back all that was. What has changed since then counts as changed now.
    void restore()
    {
      undo([this](const Vertex_state& s) { ++m.m_changes[s.vertex]; });
    }
    /// The same; but nothing tells that there was a change.
    void rewind()
    {
      undo([this](const Vertex_state& s) { m.m_changes[s.vertex] = s.changes; });
    }

  private:
    friend class Star_mesh;

    // Of the thread.
    static Checkpoint*& innermost()
    {
      thread_local Checkpoint* checkpoint = nullptr;
      return checkpoint;
    }

    template <class F>
    void undo(F&& f)
    {
      m_edits.undo(m.m.mesh);
      for (; !m_past.empty(); m_past.pop_back()) {
        m.restore(m_past.back());
        f(m_past.back());
      }
    }

    Star_mesh& m;
    Checkpoint* m_outer;
    Undoable_edits m_edits{true};
    std::vector<Vertex_state> m_past; // of those that were touched
  };

  /// Takes a vertex out of the mesh: of the two ends of `h` one stays, as its target was.
  /// \pre both may move, the link condition holds, no feature is near
  /// \returns what stays.
  Vertex collapse(Halfedge h)
  {
    const Vertex target = m.mesh.target(h);
    for (const Vertex v : {m.mesh.source(h), target}) touch(v);
    const Surface_projector::Place there = place(target);
    const double height = m_heights[target];
    const Vertex kept = edits().collapse(m, h);
    move(kept, there);
    touch_around(kept);
    m_heights[kept] = height;
    return kept;
  }

  /// Splits an edge and its two triangles at a new vertex, which gets the number of one that has
  /// been taken out.
  Vertex split(Halfedge h, const Surface_projector::Place& place)
  {
    const Vertex v = edits().split(m.mesh, h);
    move(v, place);
    touch_around(v);
    m_heights[v] = 0;
    return v;
  }

  Surface_projector::Place place(Vertex v) const { return {m.point(v), m.normals[v], m_facets[v]}; }

  void move(Vertex v, const Surface_projector::Place& place)
  {
    set_point(v, place.point);
    m.normals[v] = place.normal;
    m_facets[v] = place.facet;
  }

  /// To the point of the grid that is nearest to `p`.
  void set_point(Vertex v, const Vec3d& p)
  {
    touch(v);
    const Vec3d q = m_projector->surface().normalization.snapped(p);
    m.mesh.point(v) = Working_mesh::Point(q.x, q.y, q.z);
  }

  /// The vertices go where sweeps have moved them. \pre nothing is noted
  void move_all(const Swept_vertices& swept)
  {
    for_each_index(m_concurrency, swept.size(), [&](int i) {
      const Vertex v(i);
      if (!(swept.points[i] == point(v))) set_point(v, swept.points[i]);
      m.normals[v] = swept.normals[i];
      m_facets[v] = swept.facets[i];
      m_heights[v] = swept.heights[i];
    });
  }

  void write(Extracted_mesh& mesh) const
  {
    for_each_index(m_concurrency, int(size()), [&](int v) { mesh.points[v] = m.point(Vertex(v)); });
    m.write(mesh.triangles, m_concurrency);
  }

private:
  static constexpr char no = false;

  // The innermost of this thread, if it is of this mesh; or none.
  Checkpoint* checkpoint() const
  {
    Checkpoint* const c = Checkpoint::innermost();
    return c && &c->m == this ? c : nullptr;
  }
  Undoable_edits& edits()
  {
    Checkpoint* const c = checkpoint();
    return c ? c->m_edits : m_edits;
  }

  State state(Vertex v) const { return mixed_bits(State(v) << 32 | m_changes[v]); }

  // On neither feature nor border.
  bool is_interior(Vertex v) const
  {
    return !m_on_feature[v] && m.has_edges(v) && !m.mesh.is_border(v) && !m.is_on_seam(v);
  }

  void restore(const Vertex_state& s)
  {
    const Vertex v = s.vertex;
    m.mesh.point(v) = Working_mesh::Point(s.place.point.x, s.place.point.y, s.place.point.z);
    m.normals[v] = s.place.normal;
    m_facets[v] = s.place.facet;
    m_heights[v] = s.height;
    m_locked[v] = s.is_locked, m_movable[v] = s.is_movable, m_pinned[v] = s.is_pinned;
  }

  void touch_around(Vertex v)
  {
    for (const Halfedge h : halfedges_around_target(v, m.mesh)) touch(m.mesh.source(h));
  }

  Concurrency m_concurrency;
  const Surface_projector* m_projector;
  Working_mesh m;
  Unset_vector<int> m_facets;     // by vertex: the surface's facet that carries it
  Unset_vector<double> m_heights; // by vertex: over the surface
  Unset_vector<char> m_locked, m_movable, m_pinned, m_on_feature, m_kept;
  Unset_vector<unsigned> m_changes; // by vertex: of it or its edges
  Unset_vector<char> m_is_feature;  // by edge
  Undoable_edits m_edits{false};    // what is done without a checkpoint
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_STAR_MESH_H
