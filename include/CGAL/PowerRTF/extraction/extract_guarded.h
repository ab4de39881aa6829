// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Extraction by insertion where the samples are too sparse for the surface: a thin part, close
// sheets, a small handle. No collapse and no flip may add a self-intersection there; the vertices
// of the surface that have to stay for that become samples, in exchange for samples at flat places
// (of creases and borders if there are no others), so that their number stays. (An addition to the
// paper.)
#ifndef CGAL_POWER_RTF_EXTRACTION_EXTRACT_GUARDED_H
#define CGAL_POWER_RTF_EXTRACTION_EXTRACT_GUARDED_H

#include <CGAL/PowerRTF/extraction/Ball_union.h>
#include <CGAL/PowerRTF/extraction/Intersection_guard.h>
#include <CGAL/PowerRTF/extraction/decimate.h>
#include <CGAL/PowerRTF/extraction/delaunay_flips.h>
#include <CGAL/PowerRTF/extraction/remove_intersections.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Where the samples are too sparse.
struct Sparse_places {
  std::vector<Ball> balls; // around corners of intersecting triangles, and what is no sample
  std::size_t torn = 0;    // vertices, without all their copies on a seam
  std::size_t intersections = 0, vertices = 0; // that are no samples

  // A seam that is torn is worst, and an intersection worse than a vertex too many.
  std::pair<std::size_t, std::size_t> defects() const
  {
    return {torn, 6 * intersections + vertices};
  }
};

inline Sparse_places sparse_places(const Working_mesh& m)
{
  std::vector<char> is_sparse(m.samples.size(), false);
  const auto pairs = Intersection_finder(m).all();
  for (const auto& [f, g] : pairs)
    for (const auto face : {f, g})
      for (const auto v : m.corners(face)) is_sparse[v] = true;
  Sparse_places result;
  result.intersections = pairs.size();
  for (const auto v : m.mesh.vertices()) {
    const bool is_sample = m.samples[v] >= 0;
    if (m.mesh.is_isolated(v) || !(is_sparse[v] || !is_sample)) continue;
    if (!is_sample) ++result.vertices;
    if (m.is_torn(v)) ++result.torn;
    double longest = 0;
    for (const auto h : halfedges_around_target(v, m.mesh))
      longest = std::max(longest, length(m.point(m.mesh.source(h)) - m.point(v)));
    result.balls.push_back({m.point(v), longest});
  }
  return result;
}

class Guarded_extraction {
public:
  using Vertex = Working_mesh::Vertex;
  using Halfedge = Working_mesh::Halfedge;

  /// Changes within a flat patch add no intersections, but where another sheet lies in its plane
  /// up to rounding.
  enum class Care { off_patches, everywhere };

  /// Self-intersections are avoided in `balls`, which are taken `reach` times as large.
  Guarded_extraction(const Surface& surface, const Samples& samples,
                     const Feature_samples& features, const std::vector<Ball>& balls, double reach,
                     const Seam_places& seams, Care care)
      : m_may_go(may_go(surface, samples, features)),
        m(mesh_with_samples(surface, samples, features, seams, care)),
        m_guard(m, sight(balls, reach)), m_was_everywhere(m_guard.watches_all()),
        m_flipper(m, 0.1, &m_guard), m_next_twin(static_cast<int>(samples.size()))
  {}

  void run()
  {
    m_flipper.push_around_samples();
    m_flipper.run(20 * m.mesh.number_of_edges());
    decimate();
    exchange();
    Edge_flipper flipper(m, -0.7, &m_guard);
    for (const auto e : m.mesh.edges()) flipper.push(e);
    flipper.run(20 * m.mesh.number_of_edges());
    if (!m.places.empty()) Intersection_remover(m, flipper).run(); // of the surface itself
  }

  const Working_mesh& mesh() const { return m; }
  bool has_too_few_samples() const { return m_rest.size() > m_may_go.size(); }
  bool was_everywhere() const { return m_was_everywhere; }

private:
  enum class Place { inside, on_feature };

  static Working_mesh mesh_with_samples(const Surface& surface, const Samples& samples,
                                        const Feature_samples& features, const Seam_places& seams,
                                        Care care)
  {
    Working_mesh mesh(insert_samples(surface, samples, features.places));
    mesh.set_places(seams);
    if (care == Care::everywhere) std::fill(mesh.patches.begin(), mesh.patches.end(), -1);
    return mesh;
  }

  // By sample: all but those at corners, and those at a mirror, whose number counts.
  static std::vector<char> may_go(const Surface& surface, const Samples& samples,
                                  const Feature_samples& features)
  {
    std::vector<char> result(samples.size(), true);
    const std::size_t first = samples.size() - features.size();
    for (std::size_t k = 0; k < features.size(); ++k)
      result[first + k] = features.places[k].from != features.places[k].to &&
                          !surface.is_at_mirror(samples.points[first + k]);
    return result;
  }

  std::vector<Intersection_guard::Sight> sight(const std::vector<Ball>& balls, double reach) const
  {
    const Ball_union inner(balls, reach), outer(balls, 2 * reach);
    std::vector<Intersection_guard::Sight> result;
    for (const Vertex v : m.mesh.vertices())
      result.push_back(inner.contains(m.point(v))   ? Intersection_guard::watched
                       : outer.contains(m.point(v)) ? Intersection_guard::known
                                                    : Intersection_guard::unknown);
    return result;
  }

  void decimate() { Decimator(m, m_flipper, &m_guard).run(); }

  // Samples take the places of the vertices that could not be removed, and their own vertices are
  // removed; those of them that cannot be removed are exchanged again.
  void exchange()
  {
    std::size_t fewest = m_may_go.size() + 1;
    for (int round = 0, vain = 0; round < max_exchanges && vain < max_vain; ++round) {
      find_rest();
      if (m_rest.size() > m_may_go.size()) return;
      vain = m_rest.size() < fewest ? 0 : vain + 1;
      fewest = std::min(fewest, m_rest.size());
      const std::vector<Vertex> removable = removable_samples();
      const std::size_t count = std::min(m_rest.size(), removable.size());
      if (count == 0) return;
      for (std::size_t k = 0; k < count; ++k) {
        const int s = m.samples[removable[k]];
        m_may_go[s] = false;
        m.samples[m_rest[k]] = s;
        m.samples[removable[k]] = -1;
        if (m.is_on_seam(m_rest[k])) add_twins(m_rest[k]);
        m_guard.watch_around(removable[k]);
      }
      decimate();
    }
  }

  // Of those at one place on a seam, the first.
  void find_rest()
  {
    m_rest.clear();
    std::set<int> seen;
    for (const Vertex v : m.mesh.vertices())
      if (m.samples[v] < 0 && !m.mesh.is_isolated(v) &&
          (!m.is_on_seam(v) || seen.insert(m.places[v]).second))
        m_rest.push_back(v);
  }

  // `v` has become a sample: the numbers of its copies come after all samples.
  void add_twins(Vertex v)
  {
    for (const Vertex copy : m.copies(m.places[v]))
      if (copy != v) m.samples[copy] = m_next_twin++;
  }

  // Those on creases and borders only if there are no others: they show the shape.
  std::vector<Vertex> removable_samples()
  {
    for (const bool at_once : {true, false})
      for (const Place place : {Place::inside, Place::on_feature})
        for (int rings = 2; rings >= 0; --rings) {
          std::vector<Vertex> found = removable_samples(place, rings, at_once);
          if (!found.empty()) return found;
        }
    return {};
  }

  // Samples that are so many edges away from the vertices that are to stay, no two of them
  // neighbors, those first over whose neighbors the mesh is least high; no more than needed.
  // `at_once`: only those that can be collapsed as the mesh is now. A small component may have
  // none: it would only give back what it takes.
  std::vector<Vertex> removable_samples(Place place, int rings, bool at_once)
  {
    std::vector<char> is_near(m.samples.size(), false);
    for (const Vertex v : m_rest) is_near[v] = true;
    for (int ring = 0; ring < rings; ++ring) {
      const std::vector<char> inner = is_near;
      for (const auto e : m.mesh.edges()) {
        const Vertex a = m.mesh.vertex(e, 0), b = m.mesh.vertex(e, 1);
        if (inner[a] || inner[b]) is_near[a] = is_near[b] = true;
      }
    }
    std::vector<std::pair<double, Vertex>> order;
    for (const Vertex v : m.mesh.vertices()) {
      const int s = m.samples[v];
      if (s < 0 || m.is_on_seam(v) || !m_may_go[s] || is_near[v] || m.mesh.is_isolated(v) ||
          !is_at(place, v))
        continue;
      Vec3d normal{0, 0, 0};
      for (const Halfedge h : halfedges_around_target(v, m.mesh))
        if (!m.mesh.is_border(h)) normal += m.area_vector(v, m.apex(h), m.mesh.source(h));
      normal = normalized(normal);
      double height = 0;
      for (const Halfedge h : halfedges_around_target(v, m.mesh))
        height = std::max(height, std::abs(dot(normal, m.point(m.mesh.source(h)) - m.point(v))));
      order.emplace_back(height, v);
    }
    std::sort(order.begin(), order.end());
    std::vector<Vertex> chosen;
    for (const auto& [height, v] : order) {
      if (chosen.size() == m_rest.size()) break;
      Cancellation::poll();
      if (is_near[v] || !is_collapsible(v, at_once)) continue;
      chosen.push_back(v);
      for (const Halfedge h : halfedges_around_target(v, m.mesh)) is_near[m.mesh.source(h)] = true;
    }
    return chosen;
  }

  bool is_at(Place place, Vertex v) const
  {
    if (place == Place::inside) return !m.is_on_feature(v) && !m.mesh.is_border(v);
    const std::vector<Vertex>& curve = m.feature_neighbors(v);
    return curve.size() == 2 && !m.is_feature(curve[0], curve[1]);
  }

  bool is_collapsible(Vertex v, bool at_once)
  {
    if (at_once) m_guard.watch_around(v);
    for (const Halfedge h : halfedges_around_source(v, m.mesh))
      if ((!m.is_on_feature(v) || m.is_feature(m.mesh.edge(h))) &&
          Euler::does_satisfy_link_condition(m.mesh.edge(h), m.mesh) &&
          !(at_once && m_guard.forbids_collapse(h)))
        return true;
    return false;
  }

  static constexpr int max_exchanges = 300, max_vain = 20;

  std::vector<char> m_may_go; // by sample: may be exchanged, and has not been
  std::vector<Vertex> m_rest; // could not be removed, though they were no samples
  Working_mesh m;
  Intersection_guard m_guard;
  bool m_was_everywhere; // from the beginning
  Edge_flipper m_flipper;
  int m_next_twin;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_EXTRACT_GUARDED_H
