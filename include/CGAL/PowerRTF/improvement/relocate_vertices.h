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

#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/Vertex_mover.h>
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

  Vertex_relocator(Star_mesh& mesh, Bad_triangle_optimizer& optimizer, Distance_tracker& tracker)
      : m(mesh), m_optimizer(optimizer), m_tracker(tracker),
        m_mover(mesh, optimizer, Parameters::flat_agreement), m_steep(mesh),
        m_spacing(std::sqrt(mesh.projector().surface().area / double(mesh.size())))
  {}

  /// Looks at what is farther away than `share` times the farthest. `tolerable`: badness of the
  /// triangles that a change may leave. \returns whether anything has changed.
  bool run(double share, double tolerable = Triangle_badness::tolerable)
  {
    tolerate(tolerable);
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

  /// Puts vertices where triangles are still bad, if that makes them good. \returns whether
  /// anything has changed.
  bool mend()
  {
    tolerate(Triangle_badness::tolerable);
    bool changed = false;
    for (const Working_mesh::Face f : find_bad()) {
      Cancellation::poll();
      const auto& mesh = m.working().mesh;
      if (mesh.is_removed(f) || !(m_optimizer.badness(f) > m_tolerable))
        continue; // mended with another
      const Vec3d center = middle(f);
      Star_mesh::Checkpoint now(m);
      if (fill(f) && !m_mover.intersects_near(center))
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
  struct Tip : Missing_vertex {
    double distance;
    bool is_edge; // the middle of the edge is what is far from the surface
  };

  using Parameters = Improvement_parameters::Relocation;

  void tolerate(double badness)
  {
    m_tolerable = badness;
    m_mover.tolerate(badness);
  }

  // Unless the farthest stays. \returns whether anything has changed
  bool change(const std::vector<Tip>& tips)
  {
    std::vector<Vec3d> places;
    for (const Tip& tip : tips) places.push_back(tip.point);
    const std::vector<Vertex> spare = m_mover.find_spare(places);
    const auto is_any = [] { return true; };
    std::size_t next = 0;
    bool changed = false;
    for (const Tip& tip : tips) {
      Cancellation::poll();
      Star_mesh::Checkpoint now(m);
      if (tip.is_edge) {
        if (flip(tip) && !m_mover.intersects_near(tip.point)) {
          changed = true;
          continue;
        }
        now.restore();
      }
      bool removed = false;
      while (next < spare.size() && !(removed = m_mover.remove(spare[next++]))) now.restore();
      if (removed && m_mover.insert(tip, is_any) && !m_mover.intersects_near(tip.point)) {
        changed = true;
        continue;
      }
      now.restore();
      if (!changed) return false; // the farthest stays
    }
    if (changed) m_tracker.update();
    return changed;
  }

  // The farthest first; empty if none is far.
  std::vector<Tip> find_tips(double share)
  {
    double least = Parameters::min_distance * m_spacing;
    std::vector<Tip> all;
    for (const int i : m_tracker.farther_than(least))
      all.push_back({{m_tracker.point(i), m_tracker[i].nearest, m_tracker[i].face},
                     m_tracker[i].distance,
                     false});
    const auto& mesh = m.working().mesh;
    const std::vector<Edge> steep = steep_edges();
    std::vector<std::pair<Vec3d, double>> far(steep.size());
    for_each_chunk(m.concurrency(), int(steep.size()), 16, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) far[k] = across(mesh.halfedge(steep[k]));
    });
    for (std::size_t k = 0; k < steep.size(); ++k) {
      const auto& [point, distance] = far[k];
      const Halfedge h = mesh.halfedge(steep[k]);
      if (distance > least) all.push_back({{point, middle(h), h}, distance, true});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Tip& s, const Tip& t) { return s.distance > t.distance; });
    std::vector<Tip> tips;
    std::vector<Vec3d> places;
    for (const Tip& tip : all) {
      if (int(tips.size()) == Parameters::max_tips || tip.distance < share * all.front().distance)
        break;
      if (!m_mover.is_apart(tip.point, places)) continue;
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
    return m_mover.is_good_around(mesh.source(mesh.halfedge(e))) && m_mover.is_good_around(v) &&
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
      if (!m_mover.is_apart(middle(f), places)) continue;
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
    for (const Vertex spare : m_mover.find_spare({middle(f)})) {
      if (tries++ == Parameters::max_tries) break;
      if (!m_mover.remove(spare)) {
        before.restore();
        continue;
      }
      Star_mesh::Checkpoint removed(m);
      for (const Halfedge h :
           m_mover.edges_to_split(near, [this](Halfedge g) { return middle(g); })) {
        const Vertex v = m.split(h, m.projector().nearest(middle(h)));
        m_mover.release_around(v);
        if (m_mover.is_good_around(v)) return true;
        removed.restore();
      }
      return false;
    }
    return false;
  }

  Star_mesh& m;
  Bad_triangle_optimizer& m_optimizer;
  Distance_tracker& m_tracker;
  Vertex_mover m_mover;
  Watched_faces m_steep; // have an edge that may be flipped and is steep
  double m_spacing, m_tolerable = 0;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_RELOCATE_VERTICES_H
