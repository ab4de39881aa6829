// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps by which a vertex is moved from a flat part of the mesh to where one is missing: it is
// taken out (edge collapse) and put there (edge split), and the triangles around both places are
// made good.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_VERTEX_MOVER_H
#define CGAL_POWER_RTF_IMPROVEMENT_VERTEX_MOVER_H

#include <CGAL/PowerRTF/extraction/intersecting_faces.h>
#include <CGAL/PowerRTF/improvement/Changed_vertices.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/optimize_bad_triangles.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Where a vertex is missing: a point of the surface, what is near it of the mesh, and a halfedge
/// of the face that this is on.
struct Missing_vertex {
  Vec3d point, mesh_point;
  Working_mesh::Halfedge near;
};

class Vertex_mover {
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;

  /// `min_agreement`: of the stars that can spare their vertex; the flattest come first.
  /// `max_badness`: of triangles right after a collapse.
  Vertex_mover(Star_mesh& mesh, Bad_triangle_optimizer& optimizer, double min_agreement,
               double max_badness = Parameters::max_collapse_badness)
      : m(mesh), m_optimizer(optimizer), m_spare_changed(mesh),
        m_stride(1 + mesh.size() / Parameters::max_candidates), m_min_agreement(min_agreement),
        m_max_badness(max_badness),
        m_spacing(std::sqrt(mesh.projector().surface().area / double(mesh.size())))
  {}

  /// The badness of the triangles that a step may leave.
  void tolerate(double badness) { m_tolerable = badness; }

  /// The vertices in flat parts that leave the best triangles behind, then those in others; of a
  /// large mesh, of some vertices: many are as good.
  std::vector<Vertex> find_spare()
  {
    update_spare_costs();
    std::vector<std::pair<double, Vertex>> candidates;
    for (const int k : select(m.concurrency(), int(m_spare_costs.size()),
                              [&](int k) { return m_spare_costs[k] < infinity; }))
      candidates.push_back({m_spare_costs[k], Vertex(k * m_stride)});
    sort(m.concurrency(), candidates.begin(), candidates.end());
    std::vector<Vertex> spare;
    for (const auto& [cost, v] : candidates) spare.push_back(v);
    return spare;
  }

  /// The first of them that are apart from each other and from `places`.
  std::vector<Vertex> find_spare(std::vector<Vec3d> places)
  {
    std::vector<Vertex> spare;
    for (const Vertex v : find_spare())
      if (is_apart(m.point(v), places)) {
        spare.push_back(v);
        places.push_back(m.point(v));
        if (int(spare.size()) == Parameters::max_tips * Parameters::max_tries) break;
      }
    return spare;
  }

  /// Takes a vertex out. \returns whether what is left is good.
  bool remove(Vertex v)
  {
    const Halfedge h = collapse_of(v);
    return h.is_valid() && remove(h);
  }
  /// The same by the collapse of `h`.
  bool remove(Halfedge h) { return is_good_around(m.collapse(h)); }
  /// The halfedge from `v` by whose collapse it is taken out; invalid if it cannot be spared.
  Halfedge collapse_of(Vertex v) const { return best_collapse(v).second; }

  /// Splits an edge near the place; the new vertex goes there or, if that breaks the triangles,
  /// part of the way. The first split is taken that leaves good triangles and of which `holds()`.
  /// \returns whether there is one.
  template <class Holds>
  bool insert(const Missing_vertex& place, const Holds& holds)
  {
    Star_mesh::Checkpoint before(m);
    for (const double share : {1., 0.6, 0.3}) {
      const Vec3d p = place.mesh_point + share * (place.point - place.mesh_point);
      for (const Halfedge h : edges_to_split(place.near, [&p](Halfedge) { return p; })) {
        const Vertex v = m.split(h, m.projector().nearest(p));
        if (share < 1) m.move_off(v, p);
        release_around(v);
        m.pin(v);
        if (is_good_around(v) && holds()) return true;
        before.restore();
      }
    }
    return false;
  }

  /// The edges around the face at `near` that leave the best triangles. `place(h)`: of the new
  /// vertex.
  template <class Place>
  std::vector<Halfedge> edges_to_split(Halfedge near, Place&& place) const
  {
    const auto& mesh = m.working().mesh;
    std::vector<std::pair<double, Halfedge>> candidates;
    for (const Vertex v : mesh.vertices_around_face(near))
      for (const Halfedge g : halfedges_around_target(v, mesh))
        for (const Halfedge h : {g, mesh.prev(g)}) {
          if (!m.is_free(mesh.edge(h))) continue;
          const auto is_same = [&](const auto& c) { return mesh.edge(c.second) == mesh.edge(h); };
          if (std::any_of(candidates.begin(), candidates.end(), is_same)) continue;
          const double badness = badness_of_split(h, place(h));
          if (badness < Parameters::max_split_badness) candidates.push_back({badness, h});
        }
    std::sort(candidates.begin(), candidates.end());
    std::vector<Halfedge> edges;
    for (const auto& [badness, h] : candidates)
      if (edges.size() < Parameters::max_tries) edges.push_back(h);
    return edges;
  }

  void release_around(Vertex v)
  {
    const auto& mesh = m.working().mesh;
    for (const Halfedge h : halfedges_around_target(v, mesh))
      for (const Halfedge g : halfedges_around_target(mesh.opposite(h), mesh))
        m.release(mesh.source(g));
  }

  bool is_good_around(Vertex v)
  {
    return m_optimizer.run_around(v, Parameters::optimization_rounds) <= m_tolerable;
  }

  /// Far places are often thin: what is on their other side must not be met.
  bool intersects_near(const Vec3d& p) const
  {
    const auto& mesh = m.working().mesh;
    const double radius = Parameters::intersection_radius * m_spacing;
    const std::vector<int> near = select(m.concurrency(), int(m.size()), [&](int v) {
      return squared_length(m.point(Vertex(v)) - p) < radius * radius &&
             !mesh.is_removed(Vertex(v));
    });
    return !Intersection_finder(m.working()).find(faces_around(m, near)).empty();
  }

  /// Whether `p` is far enough from `others` for changes there not to meet.
  bool is_apart(const Vec3d& p, const std::vector<Vec3d>& others) const
  {
    const double least = Parameters::min_separation * m_spacing;
    return std::all_of(others.begin(), others.end(),
                       [&](const Vec3d& q) { return squared_length(p - q) > least * least; });
  }

private:
  using Parameters = Improvement_parameters::Relocation;

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  // What it would cost to take a vertex out depends on it and its neighbors, and their edges.
  void update_spare_costs()
  {
    const std::vector<int> changed = m_spare_changed.take();
    const auto update = [this](std::size_t v) {
      if (v % m_stride == 0) m_spare_costs[v / m_stride] = best_collapse(Vertex(v)).first;
    };
    if (m_spare_changed.are_few(changed)) {
      const std::vector<Vertex> around = vertices_around(m, changed);
      for_each_index(m.concurrency(), int(around.size()), [&](int k) { update(around[k]); });
    } else {
      m_spare_costs.resize((m.size() + m_stride - 1) / m_stride);
      for_each_index(m.concurrency(), int(m_spare_costs.size()),
                     [&](int k) { update(k * m_stride); });
    }
  }

  // The halfedge from v that leaves the best triangles when it is collapsed, and the cost: the
  // badness of the worst of them, and what the star is bent.
  std::pair<double, Halfedge> best_collapse(Vertex v) const
  {
    const auto& mesh = m.working().mesh;
    const std::pair<double, Halfedge> none{infinity, Halfedge()};
    if (!m.is_movable(v) || !m.working().has_edges(v)) return none;
    const Star star = m.star(v);
    std::pair<double, Halfedge> best{m_max_badness, Halfedge()};
    std::size_t at = 0; // the star's corners are in this order
    for (const Halfedge h : halfedges_around_target(v, mesh)) {
      const double worst = badness_collapsed(star, at++, best.first);
      if (worst < best.first && Euler::does_satisfy_link_condition(mesh.edge(h), mesh))
        best = {worst, mesh.opposite(h)};
    }
    if (!best.second.is_valid()) return none; // most vertices
    for (const Star::Corner& c : star.corners)
      if (!m.is_movable(c.vertex_a)) return none;
    const double agreement = m.agreement(star, m.point(v), m.normal(v));
    if (agreement < m_min_agreement) return none;
    best.first += Parameters::bend_cost * std::max(0., Parameters::flat_agreement - agreement);
    return best;
  }

  // Of the worst triangle that a collapse of the star's vertex into `vertex_b` of a corner leaves,
  // or what is no less than `limit`. The first one looked at is mostly bad.
  static double badness_collapsed(const Star& star, std::size_t at, double limit)
  {
    const std::size_t n = star.corners.size();
    double worst = 0;
    for (std::size_t k = 1; k + 1 < n && worst < limit; ++k) {
      const Star::Corner& c = star.corners[(at + k) % n];
      worst = std::max(worst, triangle_badness(star.corners[at].b, c.a, c.b).badness);
    }
    return worst;
  }

  // Of the worst of the four triangles; none may turn over.
  double badness_of_split(Halfedge h, const Vec3d& p) const
  {
    const auto& mesh = m.working().mesh;
    double worst = 0;
    for (const Halfedge side : {h, mesh.opposite(h)}) {
      const auto [a, b, c] = m.points(side);
      const Vec3d normal = cross(b - a, c - a);
      if (!(dot(normal, cross(p - a, c - a)) > 0 && dot(normal, cross(b - p, c - p)) > 0))
        return Parameters::max_split_badness;
      worst =
          std::max({worst, triangle_badness(a, p, c).badness, triangle_badness(p, b, c).badness});
    }
    return worst;
  }

  Star_mesh& m;
  Bad_triangle_optimizer& m_optimizer;
  Changed_vertices m_spare_changed;   // since the following was found
  std::size_t m_stride;               // between the vertices that may be spared
  Unset_vector<double> m_spare_costs; // of these: see `best_collapse()`
  double m_min_agreement, m_max_badness, m_spacing, m_tolerable = 0;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_VERTEX_MOVER_H
