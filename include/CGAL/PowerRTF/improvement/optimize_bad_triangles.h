// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Targeted optimization of the few bad triangles that smoothing leaves: the vertices around them
// search their tangent planes for places with less energy, and edges are flipped where that, with
// the search after it, lowers the energy. The rest of the mesh stays as it is. What has failed is
// not tried again before something near it has changed.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_OPTIMIZE_BAD_TRIANGLES_H
#define CGAL_POWER_RTF_IMPROVEMENT_OPTIMIZE_BAD_TRIANGLES_H

#include <CGAL/PowerRTF/extraction/Intersection_guard.h>
#include <CGAL/PowerRTF/improvement/Changed_vertices.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/tangent_search.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Bad_triangle_optimizer {
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Edge = Star_mesh::Edge;
  using Face = Working_mesh::Face;
  using State = Star_mesh::State;

  /// `guard`: what makes faces intersect is not done; \pre no faces of `mesh` do.
  explicit Bad_triangle_optimizer(Star_mesh& mesh, Intersection_guard* guard = nullptr)
      : m(mesh), m_guard(guard), m_anchors(m.size()),
        m_anchored(filled(m.concurrency(), m.size(), 0u)),
        m_failed_searches(filled(m.concurrency(), m.size(), State(0))),
        m_failed_flips(filled(m.concurrency(), m.working().mesh.number_of_edges(), State(0))),
        m_colors(filled(m.concurrency(), m.size(), 0)),
        m_zoned(filled(m.concurrency(), m.size(), 0u)), m_bad(mesh)
  {}

  double badness(Face f) const { return judgment(f).badness; }

  /// Whether a triangle is worse than tolerable.
  bool is_needed() { return !faces_worse_than(Triangle_badness::tolerable).empty(); }

  /// Triangles are bad at these vertices alone, if at all.
  void expect_at(const std::vector<int>& vertices) { m_bad.assign(vertices); }

  /// Sorted. \pre `limit` >= 0
  std::vector<Face> faces_worse_than(double limit)
  {
    const std::vector<Face>& bad = m_bad.find([this](Face f) { return badness(f) > 0; });
    std::vector<Face> faces;
    for (const int k :
         select(m.concurrency(), int(bad.size()), [&](int k) { return badness(bad[k]) > limit; }))
      faces.push_back(bad[k]);
    return faces;
  }

  /// Releases the pinned vertices of the triangles that are still bad. \returns their number.
  std::size_t release_pinned()
  {
    const auto& mesh = m.working().mesh;
    std::size_t released = 0;
    for (const Face f : faces_worse_than(Triangle_badness::tolerable))
      for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) released += m.release(v);
    return released;
  }

  /// At most `rounds` passes over the bad triangles. \returns how many are left.
  std::size_t run(int rounds) { return run(rounds, faces_worse_than(0)).size(); }

  /// The same for the triangles around `v` and its neighbors. \returns the largest badness that is
  /// left there.
  double run_around(Vertex v, int rounds)
  {
    std::vector<Face> bad;
    for (const Face f : m.working().faces_near(v))
      if (badness(f) > 0) bad.push_back(f);
    double worst = 0;
    for (const Face f : run(rounds, std::move(bad))) worst = std::max(worst, badness(f));
    for (const Face f : m.working().faces_near(v)) worst = std::max(worst, badness(f));
    return worst;
  }

private:
  // \returns the triangles that are left.
  std::vector<Face> run(int rounds, std::vector<Face> bad)
  {
    ++m_run;
    double total = total_badness(bad);
    for (int round = 0; round < rounds && !bad.empty(); ++round) {
      const std::vector<Vertex> vertices = vertices_around(m, corners(bad));
      set_anchors(vertices);
      search(vertices);
      if (round % 2 == 1) flip_around(bad);
      bad = bad_faces_at(vertices); // only what is around them has changed
      const double now = total_badness(bad);
      if (round % 2 == 1 && now > Parameters::stagnation_share * total) break;
      if (round % 2 == 1) total = now;
    }
    return bad;
  }

  using Parameters = Improvement_parameters::Optimization;

  std::vector<Vertex> corners(const std::vector<Face>& faces) const
  {
    return gather_uniquely<Vertex>(m.concurrency(), int(faces.size()), [&](int k, auto&& add) {
      for (const Vertex v : m.working().corners(faces[k])) add(v);
    });
  }

  Triangle_badness judgment(Face f) const
  {
    const auto [a, b, c] = m.points(m.working().mesh.halfedge(f));
    return triangle_badness(a, b, c);
  }

  double total_badness(const std::vector<Face>& faces) const
  {
    Unset_vector<double> each(faces.size());
    for_each_index(m.concurrency(), int(faces.size()), [&](int k) { each[k] = badness(faces[k]); });
    return std::accumulate(each.begin(), each.end(), 0.);
  }

  static double triangle_energy(const Vec3d& a, const Vec3d& b, const Vec3d& c)
  {
    return triangle_badness(a, b, c).energy();
  }

  // The worst triangles first: their sum soon tells that a place is no better.
  static void sort_by_energy(Star& star, const Vec3d& p)
  {
    boost::container::small_vector<std::pair<double, Star::Corner>, 12> corners;
    for (const Star::Corner& c : star.corners)
      corners.emplace_back(-triangle_energy(p, c.a, c.b), c);
    std::stable_sort(corners.begin(), corners.end(),
                     [](const auto& x, const auto& y) { return x.first < y.first; });
    std::transform(corners.begin(), corners.end(), star.corners.begin(),
                   [](const auto& x) { return x.second; });
  }

  // Where the vertices are when the run comes to them.
  void set_anchors(const std::vector<Vertex>& vertices)
  {
    for_each_index(concurrency(), int(vertices.size()), [&](int k) {
      const Vertex v = vertices[k];
      const unsigned before = std::exchange(m_anchored[v], m_run);
      if (before == m_run || (before > 0 && m_anchors[v] == m.point(v))) return;
      m_anchors[v] = m.point(v);
      m.touch(v);
    });
  }

  std::vector<Face> bad_faces_at(const std::vector<Vertex>& vertices) const
  {
    const auto& mesh = m.working().mesh;
    return gather_uniquely<Face>(m.concurrency(), int(vertices.size()), [&](int k, auto&& add) {
      for (const Halfedge h : halfedges_around_target(vertices[k], mesh))
        if (!mesh.is_border(h) && badness(mesh.face(h)) > 0) add(mesh.face(h));
    });
  }

  // Whether something else notes what is done: then all is done one by one.
  bool is_noted() const { return m_guard || m.is_noted(); }
  // Of what is apart.
  Concurrency concurrency() const
  {
    return is_noted() ? Concurrency(Sequential_tag()) : m.concurrency();
  }

  // Neighbors one after the other, the others at once.
  void search(const std::vector<Vertex>& vertices)
  {
    constexpr int chunk = 8;
    for (const std::vector<Vertex>& some : colored(vertices))
      for_each_chunk(concurrency(), int(some.size()), chunk, [&](int begin, int end) {
        for (int k = begin; k < end; ++k) search(some[k]);
      });
  }

  // The vertices, which are sorted, in classes without neighbors: each in the first that is free.
  std::vector<std::vector<Vertex>> colored(const std::vector<Vertex>& vertices)
  {
    constexpr int chunk = 256;
    const int n = int(vertices.size());
    std::vector<std::vector<int>> parts((n + chunk - 1) / chunk); // neighbors that come before
    Unset_vector<int> counts(n);
    for_each_chunk(m.concurrency(), n, chunk, [&](int begin, int end) {
      std::vector<int>& part = parts[begin / chunk];
      for (int k = begin; k < end; ++k) {
        const std::size_t before = part.size();
        for (const Halfedge h : halfedges_around_target(vertices[k], m.working().mesh))
          if (const Vertex u = m.working().mesh.source(h); u < vertices[k]) part.push_back(int(u));
        counts[k] = int(part.size() - before);
      }
    });
    std::vector<std::vector<Vertex>> classes;
    std::vector<int> taken{-1}; // by color: the last that cannot have it; color 0 is none
    auto near = parts.begin();
    for (int k = 0, at = 0; k < n; ++k) {
      if (k % chunk == 0) near = parts.begin() + k / chunk, at = 0;
      for (const int end = at + counts[k]; at < end; ++at) taken[m_colors[(*near)[at]]] = k;
      int color = 1;
      while (color < int(taken.size()) && taken[color] == k) ++color;
      if (color == int(taken.size())) {
        taken.push_back(-1);
        classes.emplace_back();
      }
      m_colors[vertices[k]] = color;
      classes[color - 1].push_back(vertices[k]);
    }
    for_each_index(m.concurrency(), n, [&](int k) { m_colors[vertices[k]] = 0; });
    return classes;
  }

  void search(Vertex v)
  {
    if (!m.is_movable(v) || m.state_around(v) == m_failed_searches[v]) return;
    if (m_anchored[v] == 0) { // flips have led to it
      m_anchored[v] = m_run;
      m_anchors[v] = m.point(v);
    }
    if (!move_to_better(v)) m_failed_searches[v] = m.state_around(v);
  }

  bool move_to_better(Vertex v)
  {
    Star star = m.star(v);
    const Vec3d p = m.point(v), n = m.normal(v);
    sort_by_energy(star, p);
    const double scale = mean_edge(star, p);
    const double pull = Parameters::anchor_weight *
                        std::max(0., Parameters::curved_agreement - m.agreement(star, p, n)) /
                        (scale * scale);
    constexpr double unlimited = std::numeric_limits<double>::infinity();
    const auto energy = [&](const Vec3d& q, double limit) {
      return star.sum(q, triangle_energy, limit, pull * squared_length(q - m_anchors[v]));
    };
    const double start = energy(p, unlimited);
    double least = start;
    const Vec3d best =
        search_tangent_plane<Parameters>(p, n, Parameters::first_step * scale, least, energy);
    if (!(least < clearly_less * start)) return false;
    const auto place = m.project(v, best);
    if (place.facet < 0 || !(energy(place.point, clearly_less * start) < clearly_less * start))
      return false;
    if (m.agreement(star, place.point, place.normal) <
        std::min(Parameters::min_agreement, m.agreement(star, p, n) - Parameters::agreement_loss))
      return false;
    return move(v, place);
  }

  // False, with nothing moved, if faces would intersect.
  bool move(Vertex v, const Surface_projector::Place& place)
  {
    if (!m_guard) {
      m.move(v, place);
      return true;
    }
    const Surface_projector::Place before = m.place(v);
    m_guard->erase_around(v);
    m.move(v, place);
    const bool intersects = m_guard->intersects_around(v);
    if (intersects) m.move(v, before);
    m_guard->insert_around(v);
    return !intersects;
  }

  // Faces that are near each other one after the other, the others at once; where too few are, all
  // that is left one after the other.
  void flip_around(std::vector<Face> faces)
  {
    for (bool are_apart = !is_noted(); are_apart;) {
      std::vector<std::vector<Vertex>> zones(faces.size());
      for_each_chunk(concurrency(), int(faces.size()), 8, [&](int begin, int end) {
        for (int k = begin; k < end; ++k) zones[k] = zone(faces[k]);
      });
      ++m_zoning;
      std::vector<Face> now, later;
      for (std::size_t k = 0; k < faces.size(); ++k) {
        bool is_first = true;
        for (const Vertex v : zones[k])
          if (std::exchange(m_zoned[v], m_zoning) == m_zoning) is_first = false;
        (is_first ? now : later).push_back(faces[k]);
      }
      for_each_chunk(concurrency(), int(now.size()), 1, [&](int k, int) {
        if (badness(now[k]) > 0) flip_around(now[k]);
      });
      are_apart = !later.empty() && 4 * now.size() >= faces.size();
      faces.swap(later);
    }
    for (const Face f : faces)
      if (badness(f) > 0) flip_around(f);
  }

  // The vertices that flips around a face may change, and their neighbors; of those on seams the
  // copies, too. Hubs do not change.
  std::vector<Vertex> zone(Face f) const
  {
    const Working_mesh& working = m.working();
    const auto is_no_hub = [this](Vertex v) { return !m.is_hub(v); };
    const auto corners = working.corners(f);
    std::vector<Vertex> vertices, copies;
    std::copy_if(corners.begin(), corners.end(), std::back_inserter(vertices), is_no_hub);
    working.add_neighbors(vertices, 2, is_no_hub);
    for (const Vertex v : vertices) {
      if (!working.is_on_seam(v)) continue;
      const std::vector<Vertex>& at_place = working.copies(working.places[v]);
      copies.insert(copies.end(), at_place.begin(), at_place.end());
    }
    if (copies.empty()) return vertices;
    vertices.insert(vertices.end(), copies.begin(), copies.end());
    sort_uniquely(vertices);
    return vertices;
  }

  // Tries the edges of a bad triangle, and those opposite to its corners.
  void flip_around(Face f)
  {
    const auto& mesh = m.working().mesh;
    boost::container::small_vector<Edge, 24> edges;
    Halfedge h = mesh.halfedge(f);
    for (int k = 0; k < 3; ++k, h = mesh.next(h)) edges.push_back(mesh.edge(h));
    for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
      if (m.is_hub(mesh.target(h))) continue;
      for (const Halfedge g : halfedges_around_target(h, mesh))
        if (std::find(edges.begin(), edges.end(), mesh.edge(g)) == edges.end())
          edges.push_back(mesh.edge(g));
    }
    for (const Edge e : edges) {
      Cancellation::poll();
      if (flip_if_better(e) && mesh.is_valid(f) && !(badness(f) > 0)) return;
    }
  }

  bool flip_if_better(Edge e)
  {
    if (!m.is_free(e) || !m.working().is_flippable(e)) return false;
    const std::array<Vertex, 4> corners = m.corners(e);
    // a vertex of valence 3 or 4 cannot lose an edge; one of valence 8 is to get no more
    std::array<int, 4> valence;
    for (int k = 0; k < 4; ++k) valence[k] = m.working().degree_up_to(9, corners[k]);
    if (valence[0] < 5 || valence[1] < 5 || valence[2] > 7 || valence[3] > 7) return false;
    if (m.is_hub(corners[0]) || m.is_hub(corners[1])) return false;
    const auto shape = [&](int i, int j, int k) {
      return m.working().shape(corners[i], corners[j], corners[k]);
    };
    // In a plane the angles around a vertex of valence 4, or 9 and more, cannot all be good.
    const bool heals =
        std::min(valence[2], valence[3]) <= 4 || std::max(valence[0], valence[1]) == 9;
    if (std::min(shape(0, 3, 2), shape(1, 2, 3)) <
        (heals ? Parameters::min_healing_flip_shape : Parameters::min_flip_shape))
      return false; // hopeless
    State state = 0;
    for (const Vertex v : corners) state += m.state_around(v);
    if (state == m_failed_flips[e] || (m_guard && m_guard->forbids_flip(e))) return false;
    Star_mesh::Checkpoint before(m);
    std::array<State, 4> failed_searches;
    for (int k = 0; k < 4; ++k) failed_searches[k] = m_failed_searches[corners[k]];
    const double agreement = patch_agreement(corners), energy_before = patch_energy(corners);
    if (m_guard) m_guard->erase_around(corners);
    m.flip(e);
    if (m_guard) m_guard->insert_around(corners);
    for (int pass = 0; pass < 2; ++pass)
      for (const Vertex v : corners) search(v);
    if (patch_energy(corners) < clearly_less * energy_before &&
        patch_agreement(corners) >=
            std::min(Parameters::min_agreement, agreement - Parameters::agreement_loss))
      return true;
    if (m_guard) m_guard->erase_around(corners);
    before.rewind();
    if (m_guard) m_guard->insert_around(corners);
    for (int k = 0; k < 4; ++k) m_failed_searches[corners[k]] = failed_searches[k];
    m_failed_flips[e] = state;
    return false;
  }

  double patch_energy(const std::array<Vertex, 4>& corners) const
  {
    double sum = 0;
    for (const Face f : m.working().faces_at(corners)) sum += judgment(f).energy();
    return sum;
  }

  double patch_agreement(const std::array<Vertex, 4>& corners)
  {
    double least = 1;
    for (const Face f : m.working().faces_at(corners)) {
      const auto [a, b, c] = m.working().corners(f);
      least = std::min(least, m.agreement(a, b, c));
    }
    return least;
  }

  Star_mesh& m;
  Intersection_guard* m_guard; // or none
  unsigned m_run = 0;
  Unset_vector<Vec3d> m_anchors;         // by vertex: since the run of `m_anchored`, if that is one
  Unset_vector<unsigned> m_anchored;     // by vertex; or 0
  Unset_vector<State> m_failed_searches; // by vertex: the state in which it has failed
  Unset_vector<State> m_failed_flips;    // by edge: the sum of the corners' states
  Unset_vector<int> m_colors;            // by vertex: in a search; or 0
  Unset_vector<unsigned> m_zoned;        // by vertex: when it was in a zone
  unsigned m_zoning = 0;
  Watched_faces m_bad;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_OPTIMIZE_BAD_TRIANGLES_H
