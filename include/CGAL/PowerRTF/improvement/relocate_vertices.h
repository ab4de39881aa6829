// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lowers the maximal distance where no vertex near by can be spared: an edge that bridges a hollow
// is flipped; or a vertex is taken out of a flat part of the mesh (edge collapse) and put where the
// surface and the mesh are farthest apart (edge split). Kept only if the triangles around the
// places that change can be made good, and if the maximal distance falls. In the same way a vertex
// is put where triangles are bad that neither moves nor flips mend: one is missing there.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_RELOCATE_VERTICES_H
#define CGAL_POWER_RTF_IMPROVEMENT_RELOCATE_VERTICES_H

#include <CGAL/PowerRTF/extraction/intersecting_faces.h>
#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/optimize_bad_triangles.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Vertex_relocator {
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Edge = Star_mesh::Edge;

  /// `min_agreement`: of the stars that can spare their vertex; the flattest come first.
  Vertex_relocator(Star_mesh& mesh, Bad_triangle_optimizer& optimizer, Distance_tracker& tracker,
                   double min_agreement = Improvement_parameters::Relocation::flat_agreement)
      : m(mesh), m_optimizer(optimizer), m_tracker(tracker), m_steep(mesh), m_spare_changed(mesh),
        m_stride(1 + mesh.size() / Parameters::max_candidates), m_min_agreement(min_agreement),
        m_spacing(std::sqrt(mesh.projector().surface().area / double(mesh.size())))
  {}

  /// Looks at what is farther away than `share` times the farthest. `tolerable`: badness of the
  /// triangles that a change may leave. \returns whether anything has changed.
  bool run(double share, double tolerable = Triangle_badness::tolerable)
  {
    m_tolerable = tolerable;
    std::vector<Tip> tips = find_tips(share);
    if (tips.empty()) return false;
    const double farthest = tips.front().distance;
    Star_mesh::Checkpoint before(m);
    if (!change(tips)) return false;
    tips = find_tips(share);
    if (tips.empty() || tips.front().distance < farthest) return true;
    before.restore();
    m_tracker.update();
    return false;
  }

  /// The same at the farthest place of a mesh that has changed, even if others are farther then.
  bool run_once(double tolerable)
  {
    m_tolerable = tolerable;
    m_tracker.update();
    return change(find_tips(1));
  }

  /// Puts vertices where triangles are still bad, if that makes them good. \returns whether
  /// anything has changed.
  bool mend()
  {
    m_tolerable = Triangle_badness::tolerable;
    bool changed = false;
    for (const Working_mesh::Face f : find_bad()) {
      Cancellation::poll();
      const auto& mesh = m.working().mesh;
      if (mesh.is_removed(f) || !(m_optimizer.badness(f) > m_tolerable))
        continue; // mended with another
      const Vec3d center = middle(f);
      Star_mesh::Checkpoint now(m);
      if (fill(f) && !intersects_near(center))
        changed = true;
      else
        now.restore();
    }
    if (changed) m_tracker.update();
    return changed;
  }

  /// The largest distance that is worth a look, or 0.
  double farthest()
  {
    const std::vector<Tip> tips = find_tips(1);
    return tips.empty() ? 0 : tips.front().distance;
  }

private:
  // A place where surface and mesh are far apart.
  struct Tip {
    double distance;
    Vec3d point; // of the surface
    Vec3d mesh_point;
    Halfedge near; // of the mesh
    bool is_edge;  // the middle of that edge is what is far from the surface
  };

  using Parameters = Improvement_parameters::Relocation;

  static constexpr double infinity = std::numeric_limits<double>::infinity();

  // Unless the farthest stays. \returns whether anything has changed
  bool change(const std::vector<Tip>& tips)
  {
    std::vector<Vec3d> places;
    for (const Tip& tip : tips) places.push_back(tip.point);
    const std::vector<Vertex> spare = find_spare(places);
    std::size_t next = 0;
    bool changed = false;
    for (const Tip& tip : tips) {
      Cancellation::poll();
      Star_mesh::Checkpoint now(m);
      if (tip.is_edge) {
        if (flip(tip) && !intersects_near(tip.point)) {
          changed = true;
          continue;
        }
        now.restore();
      }
      bool removed = false;
      while (next < spare.size() && !(removed = remove(spare[next++]))) now.restore();
      if (removed && insert(tip) && !intersects_near(tip.point)) {
        changed = true;
        continue;
      }
      now.restore();
      if (!changed) return false; // the farthest stays
    }
    if (changed) m_tracker.update();
    return changed;
  }

  bool is_apart(const Vec3d& p, const std::vector<Vec3d>& others) const
  {
    const double least = Parameters::min_separation * m_spacing;
    return std::all_of(others.begin(), others.end(),
                       [&](const Vec3d& q) { return squared_length(p - q) > least * least; });
  }

  // The farthest first; empty if none is far.
  std::vector<Tip> find_tips(double share)
  {
    double least = Parameters::min_distance * m_spacing;
    std::vector<Tip> all;
    for (const int i : m_tracker.farther_than(least))
      all.push_back({m_tracker[i].distance, m_tracker.point(i), m_tracker[i].nearest,
                     m_tracker[i].face, false});
    const auto& mesh = m.working().mesh;
    const std::vector<Edge> steep = steep_edges();
    std::vector<std::pair<Vec3d, double>> far(steep.size());
    for_each_chunk(m.concurrency(), int(steep.size()), 16, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) far[k] = across(mesh.halfedge(steep[k]));
    });
    for (std::size_t k = 0; k < steep.size(); ++k) {
      const auto& [point, distance] = far[k];
      const Halfedge h = mesh.halfedge(steep[k]);
      if (distance > least) all.push_back({distance, point, middle(h), h, true});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Tip& s, const Tip& t) { return s.distance > t.distance; });
    std::vector<Tip> tips;
    std::vector<Vec3d> places;
    for (const Tip& tip : all) {
      if (int(tips.size()) == Parameters::max_tips || tip.distance < share * all.front().distance)
        break;
      if (!is_apart(tip.point, places)) continue;
      tips.push_back(tip);
      places.push_back(tip.point);
    }
    return tips;
  }

  // Those that may be flipped, sorted.
  std::vector<Edge> steep_edges()
  {
    const auto& mesh = m.working().mesh;
    const auto is_wanted = [&](Halfedge h) { return is_steep(h) && m.is_free(mesh.edge(h)); };
    const auto& faces = m_steep.find([&](Working_mesh::Face f) {
      const Halfedge h = mesh.halfedge(f);
      return is_wanted(h) || is_wanted(mesh.next(h)) || is_wanted(mesh.prev(h));
    });
    return gather_uniquely<Edge>(m.concurrency(), int(faces.size()), [&](int k, auto&& add) {
      for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(faces[k])))
        if (is_wanted(h)) add(Edge(mesh.edge(h).idx())); // whichever halfedge it was found by
    });
  }

  bool is_steep(Halfedge h) const
  {
    const Vertex a = m.working().mesh.source(h), b = m.working().mesh.target(h);
    const Vec3d e = m.point(b) - m.point(a);
    return std::max(std::abs(dot(e, m.normal(a))), std::abs(dot(e, m.normal(b)))) >
           Parameters::steep_sine * length(e);
  }

  Vec3d middle(Halfedge h) const
  {
    const auto& mesh = m.working().mesh;
    return 0.5 * (m.point(mesh.source(h)) + m.point(mesh.target(h)));
  }

  // The point of the surface that is nearest to the middle of an edge, and its distance.
  std::pair<Vec3d, double> across(Halfedge h) const
  {
    const Vec3d p = middle(h);
    const Vec3d q = m.projector().nearest(p, m.facet(m.working().mesh.source(h))).point;
    return {q, length(q - p)};
  }

  bool flip(const Tip& tip)
  {
    const auto& mesh = m.working().mesh;
    const Edge e = mesh.edge(tip.near);
    const Vertex v = mesh.source(tip.near), u = mesh.target(tip.near);
    if (!m.working().is_flippable(e) || mesh.degree(v) < 4 || mesh.degree(u) < 4) return false;
    m.flip(e);
    return is_good_around(mesh.source(mesh.halfedge(e))) && is_good_around(v) &&
           across(mesh.halfedge(e)).second < Parameters::worthwhile_share * tip.distance;
  }

  Vec3d middle(Working_mesh::Face f) const
  {
    const auto [a, b, c] = m.points(m.working().mesh.halfedge(f));
    return (a + b + c) * (1 / 3.);
  }

  // The worst triangles, apart from each other.
  std::vector<Working_mesh::Face> find_bad() const
  {
    std::vector<std::pair<double, Working_mesh::Face>> bad;
    for (const auto f : m_optimizer.faces_worse_than(m_tolerable))
      bad.push_back({-m_optimizer.badness(f), f});
    std::sort(bad.begin(), bad.end());
    std::vector<Working_mesh::Face> faces;
    std::vector<Vec3d> places;
    for (const auto& [negative_badness, f] : bad) {
      if (int(faces.size()) == Parameters::max_tips) break;
      if (!is_apart(middle(f), places)) continue;
      faces.push_back(f);
      places.push_back(middle(f));
    }
    return faces;
  }

  // Puts a vertex from a flat part into the triangle or next to it.
  bool fill(Working_mesh::Face f)
  {
    const Halfedge near = m.working().mesh.halfedge(f);
    Star_mesh::Checkpoint before(m);
    int tries = 0;
    for (const Vertex spare : find_spare({middle(f)})) {
      if (tries++ == Parameters::max_tries) break;
      if (!remove(spare)) {
        before.restore();
        continue;
      }
      Star_mesh::Checkpoint removed(m);
      for (const Halfedge h : edges_to_split(near, [this](Halfedge g) { return middle(g); })) {
        const Vertex v = m.split(h, m.projector().nearest(middle(h)));
        release_around(v);
        if (is_good_around(v)) return true;
        removed.restore();
      }
      return false;
    }
    return false;
  }

  // The vertices in flat parts that leave the best triangles behind, then those in others, apart
  // from `places`; of a large mesh, of some vertices: many are as good.
  std::vector<Vertex> find_spare(std::vector<Vec3d> places)
  {
    update_spare_costs();
    std::vector<std::pair<double, Vertex>> candidates;
    for (const int k : select(m.concurrency(), int(m_spare_costs.size()),
                              [&](int k) { return m_spare_costs[k] < infinity; }))
      candidates.push_back({m_spare_costs[k], Vertex(k * m_stride)});
    sort(m.concurrency(), candidates.begin(), candidates.end());
    std::vector<Vertex> spare;
    for (const auto& [b, v] : candidates)
      if (is_apart(m.point(v), places)) {
        spare.push_back(v);
        places.push_back(m.point(v));
        if (int(spare.size()) == Parameters::max_tips * Parameters::max_tries) break;
      }
    return spare;
  }

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
    if (!m.is_movable(v)) return none;
    const Star star = m.star(v);
    std::pair<double, Halfedge> best{Parameters::max_collapse_badness, Halfedge()};
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

  bool remove(Vertex v)
  {
    const Halfedge h = best_collapse(v).second;
    return h.is_valid() && is_good_around(m.collapse(h));
  }

  // Splits an edge near the tip; the new vertex goes to the tip or, if that breaks the triangles,
  // part of the way.
  bool insert(const Tip& tip)
  {
    Star_mesh::Checkpoint before(m);
    for (const double share : {1., 0.6, 0.3}) {
      const Vec3d p = tip.mesh_point + share * (tip.point - tip.mesh_point);
      for (const Halfedge h : edges_to_split(tip.near, [&p](Halfedge) { return p; })) {
        const Vertex v = m.split(h, m.projector().nearest(p));
        if (share < 1) m.move_off(v, p);
        release_around(v);
        m.pin(v);
        if (is_good_around(v)) return true;
        before.restore();
      }
    }
    return false;
  }

  void release_around(Vertex v)
  {
    const auto& mesh = m.working().mesh;
    for (const Halfedge h : halfedges_around_target(v, mesh))
      for (const Halfedge g : halfedges_around_target(mesh.opposite(h), mesh))
        m.release(mesh.source(g));
  }

  // Those around the face at `near` that leave the best triangles. `place(h)`: of the new vertex.
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

  bool is_good_around(Vertex v)
  {
    return m_optimizer.run_around(v, Parameters::optimization_rounds) <= m_tolerable;
  }

  // Far places are often thin: what is on their other side must not be met.
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

  Star_mesh& m;
  Bad_triangle_optimizer& m_optimizer;
  Distance_tracker& m_tracker;
  Watched_faces m_steep;              // have an edge that may be flipped and is steep
  Changed_vertices m_spare_changed;   // since the following was found
  std::size_t m_stride;               // between the vertices that may be spared
  Unset_vector<double> m_spare_costs; // of these: see `best_collapse()`
  double m_min_agreement, m_spacing, m_tolerable = 0;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_RELOCATE_VERTICES_H
