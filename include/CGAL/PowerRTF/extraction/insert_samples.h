// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// First half of "insertion and decimation": the surface's facets are
// triangulated so that every sample becomes a vertex. The result has exactly the topology of the
// surface, wherever the samples lie: in a facet, on an edge, at a vertex, or at the same place.
//
// Places are integer barycentric coordinates (sum 2^40): an edge's places are the same seen from
// both sides and exactly collinear in the plane, so that each facet is triangulated for itself and
// the pieces fit. A place says only where a sample is joined in; the vertex keeps the sample's own
// position.
#ifndef CGAL_POWER_RTF_EXTRACTION_INSERT_SAMPLES_H
#define CGAL_POWER_RTF_EXTRACTION_INSERT_SAMPLES_H

#include <CGAL/PowerRTF/features/flat_patches.h>
#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The surface with the samples as additional vertices.
struct Refined_surface {
  std::vector<Vec3d> points;   ///< the surface's vertices, then the inserted samples; on the grid
  Unset_vector<Vec3d> normals; ///< unit normal of the surface at each point
  std::vector<int> samples;    ///< the sample that each vertex is; -1: none
  std::vector<Triangle> triangles;
  std::vector<int> patches;   ///< by triangle: the surface's flat patch that it is a part of
  std::vector<Edge> features; ///< the pieces of the creases and borders
  std::optional<Mirror_plane> mirror{}; ///< that of the surface
};

/// Builds a `Refined_surface`. The result does not depend on the samples' order.
class Sample_inserter {
public:
  /// `features`: places of the last samples.
  /// \throw Invalid_input_error if a sample names no facet of the surface or is not finite.
  Sample_inserter(const Surface& surface, const Samples& samples,
                  const std::vector<Edge_place>& features)
      : m_surface(surface), m_samples(samples), m_features(features),
        m_first_feature(int(samples.size() - features.size()))
  {
    sort_samples();
    start_from_surface();
    place_features();
    place_samples();
    separate_edge_places();
    m_refined.triangles.reserve(surface.triangles.size() + 2 * samples.size());
    const Flat_patches patches(surface, Flat_patches::coplanar_sine);
    auto inside = m_inside.begin();
    for (int f = 0; f < int(surface.triangles.size()); ++f) {
      Cancellation::poll(f, surface.triangles.size());
      const auto begin = inside;
      while (inside != m_inside.end() && inside->facet == f) ++inside;
      triangulate_facet(f, begin, inside);
      m_refined.patches.resize(m_refined.triangles.size(), patches[f]);
    }
    if (!features.empty()) cut_features();
    for (Vec3d& p : m_refined.points) p = surface.normalization.snapped(p);
    m_refined.mirror = surface.mirror;
  }

  Refined_surface release() { return std::move(m_refined); }

private:
  using Kernel = Exact_predicates_inexact_constructions_kernel;
  using Vertex_base = Triangulation_vertex_base_with_info_2<int, Kernel>;
  using Triangulation =
      Delaunay_triangulation_2<Kernel, Triangulation_data_structure_2<Vertex_base>>;
  using Place = std::array<std::int64_t, 3>; // barycentric, in units of 2^-40

  static constexpr std::int64_t one = std::int64_t(1) << 40;
  static constexpr std::int64_t snap = std::int64_t(1) << 20; // nearer than 1e-6: on edge or vertex

  struct Inside_sample {
    int facet, vertex;
    Place place;
  };
  struct Edge_sample {
    int from, to, vertex; // from < to
    std::int64_t at;      // distance from `from`
  };

  void sort_samples()
  {
    for (std::size_t s = 0; s < m_samples.size(); ++s) {
      const int f = m_samples.facets[s];
      const Vec3d& p = m_samples.points[s];
      if (f < 0 || f >= int(m_surface.triangles.size()))
        throw Invalid_input_error("sample " + std::to_string(s) + " lies on no facet");
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw Invalid_input_error("sample " + std::to_string(s) + " has no finite position");
    }
    m_order.resize(m_samples.size());
    std::iota(m_order.begin(), m_order.end(), 0);
    const auto key = [this](int s) {
      const Vec3d& p = m_samples.points[s];
      return std::make_tuple(m_samples.facets[s], p.x, p.y, p.z);
    };
    std::stable_sort(m_order.begin(), m_order.end(), [&](int s, int t) { return key(s) < key(t); });
  }

  void start_from_surface()
  {
    const std::size_t vertices = m_surface.points.size() + m_samples.size();
    m_refined.points.reserve(vertices);
    m_refined.normals.reserve(vertices);
    m_refined.points = m_surface.points;
    m_refined.normals.assign(m_surface.vertex_normals.begin(), m_surface.vertex_normals.end());
    m_refined.samples.reserve(vertices);
    m_refined.samples.assign(m_surface.points.size(), -1);
  }

  int new_vertex(int s)
  {
    m_refined.points.push_back(m_samples.points[s]);
    m_refined.normals.push_back(m_samples.normals[s]);
    m_refined.samples.push_back(s);
    return int(m_refined.points.size()) - 1;
  }

  Place place_of(int s) const
  {
    const Triangle& t = m_surface.triangles[m_samples.facets[s]];
    const Vec3d origin = m_surface.points[t[0]], ab = m_surface.points[t[1]] - origin,
                ac = m_surface.points[t[2]] - origin, ap = m_samples.points[s] - origin;
    const Vec3d n = cross(ab, ac);
    double u = dot(cross(ap, ac), n) / dot(n, n), v = dot(cross(ab, ap), n) / dot(n, n);
    if (!std::isfinite(u) || !std::isfinite(v)) u = v = 1. / 3; // a facet without area
    u = std::min(std::max(u, 0.), 1.);
    v = std::min(std::max(v, 0.), 1.);
    if (u + v > 1) {
      u /= u + v;
      v = 1 - u;
    }
    const std::int64_t U = std::llround(u * double(one));
    const std::int64_t V = std::min<std::int64_t>(std::llround(v * double(one)), one - U);
    return {one - U - V, U, V};
  }

  void become_sample(int vertex, int s)
  {
    m_refined.points[vertex] = m_samples.points[s];
    m_refined.normals[vertex] = m_samples.normals[s];
    m_refined.samples[vertex] = s;
  }

  // First, so that they get their vertices.
  void place_features()
  {
    for (std::size_t k = 0; k < m_features.size(); ++k) {
      const Edge_place& p = m_features[k];
      const int s = m_first_feature + int(k);
      if (p.from == p.to) {
        become_sample(p.from, s);
        continue;
      }
      const double at = p.from < p.to ? p.at : 1 - p.at;
      const std::int64_t place = std::llround(at * double(one));
      m_on_edges.push_back({std::min(p.from, p.to), std::max(p.from, p.to), new_vertex(s),
                            std::min(std::max(place, std::int64_t(1)), one - 1)});
    }
  }

  void cut_features()
  {
    for (const Edge& e : feature_edges(m_surface)) {
      int last = e[0];
      for_each_on_edge(e[0], e[1], [&](const Edge_sample& sample) {
        m_refined.features.push_back({last, sample.vertex});
        last = sample.vertex;
      });
      m_refined.features.push_back({last, e[1]});
    }
  }

  void place_samples()
  {
    for (const int s : m_order) {
      if (s >= m_first_feature) continue;
      const int f = m_samples.facets[s];
      const Triangle& t = m_surface.triangles[f];
      Place place = place_of(s);
      const int small =
          int(std::count_if(place.begin(), place.end(), [](std::int64_t w) { return w < snap; }));
      if (small == 2) {
        const int corner = int(std::max_element(place.begin(), place.end()) - place.begin());
        const int vertex = t[corner];
        if (m_refined.samples[vertex] < 0) {
          become_sample(vertex, s);
          continue;
        }
        place.fill(2 * snap); // the vertex is taken: next to it, inside the facet
        place[corner] = one - 4 * snap;
      } else if (small == 1) {
        const int opposite = int(std::min_element(place.begin(), place.end()) - place.begin());
        int from = (opposite + 1) % 3, to = (opposite + 2) % 3;
        if (t[from] > t[to]) std::swap(from, to);
        if (!std::binary_search(m_surface.kept_edges.begin(), m_surface.kept_edges.end(),
                                Edge{t[from], t[to]})) {
          m_on_edges.push_back({t[from], t[to], new_vertex(s), place[to]});
          continue;
        }
        // The edge stays as it is: next to it, inside the facet.
        place[place[from] > place[to] ? from : to] -= 2 * snap - place[opposite];
        place[opposite] = 2 * snap;
      }
      m_inside.push_back({f, new_vertex(s), place});
    }
  }

  // Equal places on an edge become neighboring ones.
  void separate_edge_places()
  {
    std::sort(m_on_edges.begin(), m_on_edges.end(), [](const Edge_sample& a, const Edge_sample& b) {
      return std::tie(a.from, a.to, a.at, a.vertex) < std::tie(b.from, b.to, b.at, b.vertex);
    });
    for (std::size_t i = 1; i < m_on_edges.size(); ++i) {
      const Edge_sample& last = m_on_edges[i - 1];
      Edge_sample& now = m_on_edges[i];
      if (now.from == last.from && now.to == last.to) now.at = std::max(now.at, last.at + 1);
    }
    m_first_on_edges.assign(m_surface.points.size() + 1, 0);
    for (const Edge_sample& e : m_on_edges) ++m_first_on_edges[e.from + 1];
    std::partial_sum(m_first_on_edges.begin(), m_first_on_edges.end(), m_first_on_edges.begin());
  }

  using Inside_iterator = std::vector<Inside_sample>::iterator;

  void triangulate_facet(int f, Inside_iterator begin, Inside_iterator end)
  {
    const Triangle& t = m_surface.triangles[f];
    m_places.clear();
    for (int i = 0; i < 3; ++i) add_edge_places(t, i);
    if (m_places.empty() && end - begin <= 1) {
      if (begin == end)
        m_refined.triangles.push_back(t);
      else
        for (int i = 0; i < 3; ++i)
          m_refined.triangles.push_back({t[i], t[(i + 1) % 3], begin->vertex});
      return;
    }
    std::set<Place> used;
    for (; begin != end; ++begin) add(free_place(begin->place, used), begin->vertex);
    for (int i = 0; i < 3; ++i) {
      Place corner{0, 0, 0};
      corner[i] = one;
      add(corner, t[i]);
    }
    const Triangulation triangulation(m_places.begin(), m_places.end());
    for (auto face = triangulation.finite_faces_begin(); face != triangulation.finite_faces_end();
         ++face)
      m_refined.triangles.push_back(
          {face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  }

  void add_edge_places(const Triangle& t, int i)
  {
    int from = i, to = (i + 1) % 3;
    if (t[from] > t[to]) std::swap(from, to);
    for_each_on_edge(t[from], t[to], [&](const Edge_sample& sample) {
      Place place{0, 0, 0};
      place[from] = one - sample.at;
      place[to] = sample.at;
      add(place, sample.vertex);
    });
  }

  // From `from` to `to`, from < to.
  template <class F>
  void for_each_on_edge(int from, int to, F&& f) const
  {
    const auto first = m_on_edges.begin() + m_first_on_edges[from];
    const auto last = m_on_edges.begin() + m_first_on_edges[from + 1];
    auto it = std::lower_bound(first, last, to,
                               [](const Edge_sample& e, int vertex) { return e.to < vertex; });
    for (; it != last && it->to == to; ++it) f(*it);
  }

  void add(const Place& place, int vertex)
  {
    m_places.emplace_back(
        Kernel::Point_2(std::ldexp(double(place[1]), -40), std::ldexp(double(place[2]), -40)),
        vertex);
  }

  // The first place not used yet on a walk around `place` (squares of growing size; far smaller
  // than the distance to the facet's boundary).
  static Place free_place(const Place& place, std::set<Place>& used)
  {
    if (used.insert(place).second) return place;
    for (std::int64_t r = 1;; ++r)
      for (std::int64_t i = -r; i <= r; ++i)
        for (std::int64_t j = -r; j <= r; j += std::abs(i) == r ? 1 : 2 * r) {
          const Place near{place[0] - i - j, place[1] + i, place[2] + j};
          if (used.insert(near).second) return near;
        }
  }

  const Surface& m_surface;
  const Samples& m_samples;
  const std::vector<Edge_place>& m_features;
  int m_first_feature;
  Refined_surface m_refined;
  std::vector<int> m_order;
  std::vector<Inside_sample> m_inside; // by facet
  std::vector<Edge_sample> m_on_edges; // by edge, then along it
  std::vector<int> m_first_on_edges;   // by `from`
  std::vector<std::pair<Kernel::Point_2, int>> m_places;
};

/// Makes every sample a vertex of the surface. `features`: where the last samples lie on edges.
inline Refined_surface insert_samples(const Surface& surface, const Samples& samples,
                                      const std::vector<Edge_place>& features = {})
{
  return Sample_inserter(surface, samples, features).release();
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_INSERT_SAMPLES_H
