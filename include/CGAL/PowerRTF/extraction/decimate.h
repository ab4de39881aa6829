// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Second half of "insertion and decimation": every vertex that is no sample
// is removed by collapsing it into a neighbor. The link condition (Dey et al., "Topology
// preserving edge contraction", 1999) holds for each collapse, so the mesh stays homeomorphic to
// the surface. Each pass removes vertices that are far apart and flips the edges around them to
// Delaunay, so degrees stay small and the cost is linear. Vertices that cannot go are tried again
// with weaker geometric conditions; the topological one always holds. Under a guard the copies of
// a vertex on a seam go together: it takes them for one.
#ifndef CGAL_POWER_RTF_EXTRACTION_DECIMATE_H
#define CGAL_POWER_RTF_EXTRACTION_DECIMATE_H

#include <CGAL/PowerRTF/extraction/delaunay_flips.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Decimator {
public:
  /// What `guard` forbids is not done.
  Decimator(Working_mesh& mesh, Edge_flipper& flipper, Intersection_guard* guard = nullptr)
      : m(mesh), m_flipper(flipper), m_guard(guard), m_touched(mesh.samples.size(), 0)
  {
    for (const Vertex v : m.mesh.vertices())
      if (m.samples[v] < 0 && !m.mesh.is_isolated(v)) m_rest.push_back(v);
    m_all = m_rest.size();
  }

  /// \returns the number of vertices that could not be removed.
  std::size_t run()
  {
    // Smallest cosine between new triangles and the surface; then: may borders recede?
    const std::pair<double, bool> stages[] = {{0.7, false}, {0.4, false}, {0.1, false},
                                              {0.1, true},  {-0.5, true}, {-2, true}};
    for (const auto& stage : stages) {
      m_min_agreement = stage.first;
      m_borders_may_recede = stage.second;
      do_passes();
    }
    for (bool progress = true; progress && !m_rest.empty();) {
      progress = false;
      for (const Vertex u : m_rest) {
        Cancellation::poll();
        if (!is_left(u)) continue;
        lower_degree(u);
        progress |= remove(u);
      }
      forget_removed();
      progress |= do_passes();
    }
    return m_rest.size();
  }

private:
  using Vertex = Working_mesh::Vertex;
  using Halfedge = Working_mesh::Halfedge;

  // Passes until one removes nothing. \returns true if any vertex was removed.
  bool do_passes()
  {
    const std::size_t before = m_rest.size();
    for (bool progress = true; progress && !m_rest.empty();) {
      ++m_pass;
      progress = false;
      std::size_t removed = m_all - m_rest.size();
      for (const Vertex u : m_rest) {
        Cancellation::poll(removed, m_all);
        const bool goes = m_touched[u] != m_pass && is_left(u) && remove(u);
        removed += goes;
        progress |= goes;
      }
      forget_removed();
    }
    return m_rest.size() < before;
  }

  bool is_left(Vertex u) const { return m.samples[u] < 0 && !m.mesh.is_removed(u); }

  void forget_removed()
  {
    m_rest.erase(
        std::remove_if(m_rest.begin(), m_rest.end(), [this](Vertex u) { return !is_left(u); }),
        m_rest.end());
  }

  struct Candidate {
    double shape;
    Halfedge halfedge; // from u
    bool operator<(const Candidate& o) const { return shape > o.shape; }
  };

  // Collapses u into the neighbor that leaves the best triangles. At a border without samples
  // there may be none: the border then recedes to the samples.
  bool remove(Vertex u)
  {
    if (m_guard && m.is_on_seam(u)) return remove_copies(m.places[u]);
    find_ring(u);
    const std::vector<Vertex>& curve = m.feature_neighbors(u);
    if (!curve.empty())
      return curve.size() == 2 && !m.is_feature(curve[0], curve[1]) &&
             collapse_to_neighbor(u, [&](Halfedge h) { return m.is_feature(u, m.mesh.target(h)); });
    const auto anywhere = [](Halfedge) { return true; };
    if (!m.mesh.is_border(u)) return collapse_to_neighbor(u, anywhere);
    const auto along_border = [&](Halfedge h) { return m.mesh.is_border(m.mesh.edge(h)); };
    return collapse_to_neighbor(u, along_border) || (m_borders_may_recede && cut_off()) ||
           (m_borders_may_recede && collapse_to_neighbor(u, anywhere));
  }

  void find_ring(Vertex u)
  {
    m_ring.clear();
    for (const Halfedge h : halfedges_around_source(u, m.mesh)) m_ring.push_back(h);
  }

  struct Seam_collapse {
    double shape;
    std::vector<Halfedge> halfedges; // from each of the copies
    Edge seam;                       // that remains, by its places
  };

  // Collapses the copies at a place into those of one of its two neighbors on the seam.
  bool remove_copies(int place)
  {
    std::vector<Seam_collapse> candidates;
    for (const Vertex w : m.feature_neighbors(m.copies(place)[0]))
      if (std::optional<Seam_collapse> c = seam_collapse(place, m.places[w]))
        candidates.push_back(std::move(*c));
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const auto& a, const auto& b) { return a.shape > b.shape; });
    for (const Seam_collapse& c : candidates) {
      if (m_guard->forbids_collapses(c.halfedges, c.seam)) continue;
      std::size_t changed = 0;
      for (const Halfedge h : c.halfedges) {
        find_ring(m.mesh.source(h));
        changed += m_ring.size();
        collapse(h);
      }
      m_flipper.run(10 * changed);
      return true;
    }
    return false;
  }

  // None if not all copies at `from` can collapse into one at `to`, if they are so near each other
  // that one collapse would change the next, or if the seam would run along itself.
  std::optional<Seam_collapse> seam_collapse(int from, int to)
  {
    Seam_collapse result{1, {}, {-1, -1}};
    std::vector<Vertex> near; // at the sources
    for (const Vertex u : m.copies(from)) {
      const std::vector<Vertex>& curve = m.feature_neighbors(u);
      if (curve.size() != 2 || m.is_feature(curve[0], curve[1])) return {};
      const int i = m.places[curve[0]] == to ? 0 : 1, other = m.places[curve[1 - i]];
      const Edge seam = sorted_edge(to, other);
      if (to < 0 || other < 0 || other == to || m.places[curve[i]] != to) return {};
      if (!result.halfedges.empty() && seam != result.seam) return {};
      const Halfedge h = m.mesh.halfedge(u, curve[i]);
      if (!Euler::does_satisfy_link_condition(m.mesh.edge(h), m.mesh) || m.joins_twice(h))
        return {};
      find_ring(u);
      result.shape = std::min(result.shape, shape_after(u, curve[i]));
      if (result.shape < 0) return {};
      result.halfedges.push_back(h);
      result.seam = seam;
      near.push_back(u);
      for (const Halfedge g : m_ring) near.push_back(m.mesh.target(g));
    }
    std::sort(near.begin(), near.end());
    if (std::adjacent_find(near.begin(), near.end()) != near.end()) return {};
    const auto vanishes = [&](Halfedge g) {
      return !m.mesh.is_border(g) && m.places[m.apex(g)] == from;
    };
    for (const Vertex v : m.copies(to))
      for (const Halfedge g : halfedges_around_source(v, m.mesh))
        if (sorted_edge(to, m.places[m.mesh.target(g)]) == result.seam && !vanishes(g) &&
            !vanishes(m.mesh.opposite(g)))
          return {};
    return result;
  }

  template <class IsAllowed>
  bool collapse_to_neighbor(Vertex u, IsAllowed is_allowed)
  {
    m_candidates.clear();
    for (const Halfedge h : m_ring) {
      if (!is_allowed(h)) continue;
      const double shape = shape_after(u, m.mesh.target(h));
      if (shape >= 0) m_candidates.push_back({shape, h});
    }
    std::stable_sort(m_candidates.begin(), m_candidates.end());
    for (const Candidate& c : m_candidates)
      if (Euler::does_satisfy_link_condition(m.mesh.edge(c.halfedge), m.mesh) &&
          !m.joins_twice(c.halfedge) && !(m_guard && m_guard->forbids_collapse(c.halfedge))) {
        collapse(c.halfedge);
        m_flipper.run(10 * m_ring.size());
        return true;
      }
    return false;
  }

  // Removes the border vertex in the middle of the ring with its triangles; the opposite edges
  // become the border. The surface stays the same up to homeomorphism if these triangles meet the
  // border in no other place.
  bool cut_off()
  {
    const auto gap = std::find_if(m_ring.begin(), m_ring.end(),
                                  [this](Halfedge h) { return m.mesh.is_border(h); });
    std::rotate(m_ring.begin(), gap,
                m_ring.end()); // the triangles from one border edge to the other
    for (std::size_t i = 1; i < m_ring.size(); ++i) {
      if (m.mesh.is_border(m.mesh.edge(m.mesh.next(m_ring[i])))) return false;
      if (i + 1 < m_ring.size() && m.mesh.is_border(m.mesh.target(m_ring[i]))) return false;
    }
    for (const Halfedge h : m_ring) m_touched[m.mesh.target(h)] = m_pass;
    for (std::size_t i = 1; i < m_ring.size(); ++i) {
      if (m_guard) m_guard->erase(m.mesh.face(m_ring[i]));
      Euler::remove_face(m_ring[i], m.mesh);
    }
    return true;
  }

  // The worst shape of the triangles that collapsing u into v leaves; -1 if one of them does not
  // agree with the surface.
  double shape_after(Vertex u, Vertex v) const
  {
    double worst = 1;
    for (const Halfedge h : m_ring) {
      if (m.mesh.is_border(h)) continue;
      const Vertex a = m.mesh.target(h), b = m.apex(h);
      if (a == v || b == v) continue;
      if (m_min_agreement > -1) {
        const Vec3d n = m.area_vector(v, a, b);
        const double l = length(n);
        if (!(std::min({agreement_at(u, n, l, a, b), m.agreement(n, l, v), m.agreement(n, l, a),
                        m.agreement(n, l, b)}) > m_min_agreement))
          return -1;
      }
      worst = std::min(worst, m.shape(v, a, b));
    }
    return worst;
  }

  // On a curve the triangle `u a b` itself tells how the surface lies.
  double agreement_at(Vertex u, const Vec3d& n, double l, Vertex a, Vertex b) const
  {
    if (!m.is_on_feature(u)) return m.agreement(n, l, u);
    const Vec3d before = m.area_vector(u, a, b);
    const double length_before = length(before);
    return length_before > 0 ? dot(n, before) / (l * length_before) : 1;
  }

  // `collapse_edge()` keeps the end that it likes: the kept vertex becomes what the target was.
  void collapse(Halfedge to_v)
  {
    for (const Halfedge h : m_ring) m_touched[m.mesh.target(h)] = m_pass;
    const Vertex v = m.mesh.target(to_v);
    const auto point = m.mesh.point(v);
    const Vec3d normal = m.normals[v];
    const int sample = m.samples[v];
    const Vertex u = m.mesh.source(to_v);
    if (m_guard) m_guard->erase_around(std::array{u, v});
    leave_patches(u);
    if (m.is_on_feature(u)) m.shorten_feature(u, v);
    const Vertex kept = Euler::collapse_edge(m.mesh.edge(to_v), m.mesh);
    if (kept != v) m.rename_on_features(v, kept);
    m.mesh.point(kept) = point;
    m.normals[kept] = normal;
    m.samples[kept] = sample;
    m.replace_copy(u, v, kept);
    m_touched[kept] = m_pass;
    if (m_guard) m_guard->insert_around(kept);
    for (const Halfedge h : halfedges_around_target(kept, m.mesh)) {
      m_flipper.push(m.mesh.edge(h));
      m_flipper.push(m.mesh.edge(m.mesh.prev(h)));
    }
  }

  // The faces at `u` move out of their flat patches unless all are in the same.
  void leave_patches(Vertex u)
  {
    std::optional<int> patch;
    bool is_one = true;
    for (const Halfedge h : m_ring) {
      if (m.mesh.is_border(h)) continue;
      const int p = m.patches[m.mesh.face(h)];
      is_one = is_one && p == patch.value_or(p);
      patch = p;
    }
    if (is_one && !m.mesh.is_border(u)) return;
    for (const Halfedge h : m_ring)
      if (!m.mesh.is_border(h)) m.patches[m.mesh.face(h)] = -1;
  }

  // Flips edges at u away, best shapes first, so that it may become removable.
  void lower_degree(Vertex u)
  {
    for (bool progress = true; progress && m.mesh.degree(u) > 3;) {
      progress = false;
      double best = -1;
      Halfedge chosen;
      for (const Halfedge h : halfedges_around_source(u, m.mesh)) {
        if (m.mesh.is_border(m.mesh.edge(h))) continue;
        const Vertex v = m.mesh.target(h), c = m.apex(h), d = m.apex(m.mesh.opposite(h));
        const double shape = m.agreement(d, v, c) > 0 ? m.shape(d, v, c) : 0;
        if (shape <= best || !m_flipper.is_legal(m.mesh.edge(h))) continue; // the latter takes long
        best = shape;
        chosen = h;
        progress = true;
      }
      if (progress) m_flipper.flip(m.mesh.edge(chosen));
    }
  }

  Working_mesh& m;
  Edge_flipper& m_flipper;
  Intersection_guard* m_guard; // or none
  std::vector<Vertex> m_rest;  // no samples: still to be removed
  std::size_t m_all = 0;       // of these at the beginning
  std::vector<int> m_touched;  // by vertex: the last pass that changed something around it
  std::vector<Halfedge> m_ring;
  std::vector<Candidate> m_candidates;
  int m_pass = 0;
  double m_min_agreement = 1;
  bool m_borders_may_recede = false;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_DECIMATE_H
