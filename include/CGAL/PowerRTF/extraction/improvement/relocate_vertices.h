// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lowers the maximal distance where no vertex near by can be spared: an edge that bridges a hollow
// is flipped; or a vertex is taken out of a flat part of the mesh (edge collapse) and put where the
// surface and the mesh are farthest apart (edge split). Kept only if the triangles around the
// places that change can be made good, and if the maximal distance falls.
#ifndef CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_RELOCATE_VERTICES_H
#define CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_RELOCATE_VERTICES_H

#include <CGAL/PowerRTF/extraction/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/extraction/improvement/Surface_watch.h>
#include <CGAL/PowerRTF/extraction/improvement/mend_stars.h>
#include <CGAL/PowerRTF/extraction/improvement/triangle_badness.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

class Vertex_relocator
{
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Edge = Star_mesh::Edge;

  Vertex_relocator(Star_mesh& mesh, Star_mender& mender, Surface_watch& watch)
      : m(mesh), m_mender(mender), m_watch(watch),
        m_spacing(std::sqrt(mesh.guide().surface().area / double(mesh.size())))
  {
  }

  /// Looks at what is farther away than `share` times the farthest. `tolerable`: badness of the
  /// triangles that a change may leave. \returns whether anything has changed.
  bool run(double share, double tolerable = Triangle_badness::tolerable)
  {
    m_tolerable = tolerable;
    std::vector<Tip> tips = find_tips(share);
    if (tips.empty()) return false;
    const double farthest = tips.front().distance;
    const std::vector<Vertex> spare = find_spare(tips);
    const Star_mesh before = m;
    std::size_t next = 0;
    bool changed = false;
    for (const Tip& tip : tips) {
      Cancellation::poll();
      const Star_mesh now = m;
      if (tip.is_edge && flip(tip) && !intersects_near(tip.point)) {
        changed = true;
        continue;
      }
      m.restore(now);
      bool removed = false;
      while (next < spare.size() && !(removed = remove(spare[next++]))) m.restore(now);
      if (removed && insert(tip) && !intersects_near(tip.point)) {
        changed = true;
        continue;
      }
      m.restore(now);
      if (!changed) return false; // the farthest stays
    }
    if (!changed) return false;
    m_watch.update();
    tips = find_tips(share);
    if (tips.empty() || tips.front().distance < farthest) return true;
    m.restore(before);
    m_watch.update();
    return false;
  }

  /// The largest distance that is worth a look, or 0.
  double farthest() const
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

  static constexpr int max_tips = 4, max_tries = 3; // whatever the size of the mesh
  static constexpr double large = 0.2;              // distance, in units of sqrt(area / n)
  static constexpr double apart = 3;                // of places that change, in the same unit
  static constexpr double steep = 0.5; // sine of the angle of an edge and the surface at its ends
  static constexpr double flat = 0.9;  // agreement of stars that can be spared
  static constexpr double worthwhile = 0.85;
  static constexpr double worst_after_collapse = 1, worst_after_split = 5; // what can be mended
  static constexpr int rounds = 16;

  bool is_apart(const Vec3d& p, const std::vector<Vec3d>& others) const
  {
    const double least = apart * m_spacing;
    return std::all_of(others.begin(), others.end(),
                       [&](const Vec3d& q) { return squared_length(p - q) > least * least; });
  }

  // The farthest first; empty if none is far.
  std::vector<Tip> find_tips(double share) const
  {
    double least = large * m_spacing;
    std::vector<Tip> all;
    for (int i = 0; i < m_watch.size(); ++i)
      if (m_watch[i].distance > least)
        all.push_back(
            {m_watch[i].distance, m_watch[i].point, m_watch[i].nearest, m_watch[i].face, false});
    const auto& mesh = m.working().mesh;
    for (const Edge e : mesh.edges()) {
      const Halfedge h = mesh.halfedge(e);
      if (!m.is_free(e) || !is_steep(h)) continue;
      const auto [point, distance] = across(h);
      if (distance > least) all.push_back({distance, point, middle(h), h, true});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Tip& s, const Tip& t) { return s.distance > t.distance; });
    std::vector<Tip> tips;
    std::vector<Vec3d> places;
    for (const Tip& tip : all) {
      if (int(tips.size()) == max_tips || tip.distance < share * all.front().distance) break;
      if (!is_apart(tip.point, places)) continue;
      tips.push_back(tip);
      places.push_back(tip.point);
    }
    return tips;
  }

  bool is_steep(Halfedge h) const
  {
    const Vertex a = m.working().mesh.source(h), b = m.working().mesh.target(h);
    const Vec3d e = m.point(b) - m.point(a);
    return std::max(std::abs(dot(e, m.normal(a))), std::abs(dot(e, m.normal(b)))) >
           steep * length(e);
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
    const Vec3d q = m.guide().nearest(p).point;
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
           across(mesh.halfedge(e)).second < worthwhile * tip.distance;
  }

  // The vertices in flat parts that leave the best triangles behind.
  std::vector<Vertex> find_spare(const std::vector<Tip>& tips) const
  {
    std::vector<std::pair<double, Vertex>> candidates;
    for (const Vertex v : m.working().mesh.vertices()) {
      const double badness = best_collapse(v).first;
      if (badness < worst_after_collapse) candidates.push_back({badness, v});
    }
    std::sort(candidates.begin(), candidates.end());
    std::vector<Vertex> spare;
    std::vector<Vec3d> places;
    for (const Tip& tip : tips) places.push_back(tip.point);
    for (const auto& [badness, v] : candidates)
      if (is_apart(m.point(v), places)) {
        spare.push_back(v);
        places.push_back(m.point(v));
        if (int(spare.size()) == max_tips * max_tries) break;
      }
    return spare;
  }

  // The halfedge from v that leaves the best triangles when it is collapsed, and the badness of the
  // worst of them.
  std::pair<double, Halfedge> best_collapse(Vertex v) const
  {
    const auto& mesh = m.working().mesh;
    std::pair<double, Halfedge> best{worst_after_collapse, Halfedge()};
    if (!m.is_movable(v)) return best;
    const Star star = m.star(v);
    if (m.agreement(star, m.point(v), m.normal(v)) < flat) return best;
    for (const Star::Corner& c : star.corners)
      if (!m.is_movable(c.vertex_a)) return best;
    for (const Halfedge h : halfedges_around_target(v, mesh)) {
      const Vertex u = mesh.source(h);
      double worst = 0;
      for (const Star::Corner& c : star.corners)
        if (c.vertex_a != u && c.vertex_b != u)
          worst = std::max(worst, triangle_badness(m.point(u), c.a, c.b).badness);
      if (worst < best.first && Euler::does_satisfy_link_condition(mesh.edge(h), mesh))
        best = {worst, mesh.opposite(h)};
    }
    return best;
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
    const Star_mesh before = m;
    for (const double share : {1., 0.6, 0.3}) {
      const Vec3d p = tip.mesh_point + share * (tip.point - tip.mesh_point);
      for (const Halfedge h : edges_to_split(tip, p)) {
        const Vertex v = m.split(h, m.guide().nearest(p));
        if (share < 1) m.move_off(v, p);
        release_around(v);
        m.pin(v);
        if (is_good_around(v)) return true;
        m.restore(before);
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

  // Those that leave the best triangles.
  std::vector<Halfedge> edges_to_split(const Tip& tip, const Vec3d& p) const
  {
    const auto& mesh = m.working().mesh;
    std::vector<std::pair<double, Halfedge>> candidates;
    for (const Vertex v : mesh.vertices_around_face(tip.near))
      for (const Halfedge g : halfedges_around_target(v, mesh))
        for (const Halfedge h : {g, mesh.prev(g)}) {
          if (!m.is_free(mesh.edge(h))) continue;
          const auto is_same = [&](const auto& c) { return mesh.edge(c.second) == mesh.edge(h); };
          if (std::any_of(candidates.begin(), candidates.end(), is_same)) continue;
          const double badness = badness_of_split(h, p);
          if (badness < worst_after_split) candidates.push_back({badness, h});
        }
    std::sort(candidates.begin(), candidates.end());
    std::vector<Halfedge> edges;
    for (const auto& [badness, h] : candidates)
      if (edges.size() < max_tries) edges.push_back(h);
    return edges;
  }

  // Of the worst of the four triangles; none may turn over.
  double badness_of_split(Halfedge h, const Vec3d& p) const
  {
    const auto& mesh = m.working().mesh;
    double worst = 0;
    for (const Halfedge side : {h, mesh.opposite(h)}) {
      const Vec3d a = m.point(mesh.source(side)), b = m.point(mesh.target(side)),
                  c = m.point(mesh.target(mesh.next(side))), normal = cross(b - a, c - a);
      if (!(dot(normal, cross(p - a, c - a)) > 0 && dot(normal, cross(b - p, c - p)) > 0))
        return worst_after_split;
      worst =
          std::max({worst, triangle_badness(a, p, c).badness, triangle_badness(p, b, c).badness});
    }
    return worst;
  }

  bool is_good_around(Vertex v)
  {
    return m_mender.run_around(v, rounds) <= m_tolerable;
  }

  // Far places are often thin: what is on their other side must not be met.
  bool intersects_near(const Vec3d& p) const
  {
    const auto& mesh = m.working().mesh;
    const double radius = 4 * m_spacing;
    std::vector<Working_mesh::Mesh::Face_index> faces;
    for (const auto f : mesh.faces())
      if (squared_length(m.point(mesh.target(mesh.halfedge(f))) - p) < radius * radius)
        faces.push_back(f);
    return Polygon_mesh_processing::does_self_intersect(faces, mesh);
  }

  Star_mesh& m;
  Star_mender& m_mender;
  Surface_watch& m_watch;
  double m_spacing, m_tolerable = 0;
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_RELOCATE_VERTICES_H
