// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Extraction where the samples are too sparse for the surface: a thin part, close sheets, a small
// handle. No collapse and no flip may add a self-intersection there; the vertices of the surface
// that have to stay for that become samples, in exchange for samples at flat places: their number
// stays. Slower than `extract_by_insertion()`, which it mends. (An addition to the paper.)
#ifndef CGAL_POWER_RTF_EXTRACTION_EXTRACT_GUARDED_H
#define CGAL_POWER_RTF_EXTRACTION_EXTRACT_GUARDED_H

#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/surface/point_grid.h>
#include <CGAL/PowerRTF/surface/surface_geometry.h>
#include <CGAL/PowerRTF/surface/vertex_facets.h>

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

class Guarded_extraction
{
public:
  using Vertex = Working_mesh::Vertex;
  using Halfedge = Working_mesh::Halfedge;

  /// `movable`: the first so many samples may be exchanged. `is_watched`: function point -> whether
  /// intersections matter there.
  template <class Is_watched>
  Guarded_extraction(const Surface& surface, Samples& samples, const Feature_samples& features,
                     std::size_t movable, const Is_watched& is_watched)
      : m_surface(surface), m_samples(samples), m_movable(movable),
        m(insert_samples(surface, samples, features.places)), m_guard(m, flags(is_watched)),
        m_flipper(m, 0.1, &m_guard)
  {
  }

  Extracted_mesh run()
  {
    m_flipper.push_around_samples();
    m_flipper.run(20 * m.mesh.number_of_edges());
    decimate();
    exchange();
    Edge_flipper flipper(m, -0.7, &m_guard);
    for (const auto e : m.mesh.edges()) flipper.push(e);
    flipper.run(20 * m.mesh.number_of_edges());
    return to_extracted_mesh(m, m_samples);
  }

private:
  template <class Is_watched>
  std::vector<char> flags(const Is_watched& is_watched) const
  {
    std::vector<char> result;
    for (const Vertex v : m.mesh.vertices()) result.push_back(is_watched(m.point(v)));
    return result;
  }

  void decimate() { Decimator(m, m_flipper, &m_guard).run(); }

  // Samples take the places of the vertices that could not be removed, and their own vertices are
  // removed; those of them that cannot be removed are exchanged again.
  void exchange()
  {
    std::vector<char> may_go(m_movable, true);
    for (int round = 0; round < max_exchanges; ++round) {
      std::vector<Vertex> rest;
      for (const Vertex v : m.mesh.vertices())
        if (m.samples[v] < 0 && !m.mesh.is_isolated(v)) rest.push_back(v);
      const std::vector<Vertex> removable = removable_samples(rest, may_go);
      const std::size_t count = std::min(rest.size(), removable.size());
      if (count == 0) return;
      for (std::size_t k = 0; k < count; ++k) {
        const int s = m.samples[removable[k]];
        may_go[s] = false;
        m.samples[rest[k]] = s;
        m.samples[removable[k]] = -1;
        for (const Halfedge h : halfedges_around_target(removable[k], m.mesh))
          m_guard.watch(m.mesh.source(h));
        put(s, rest[k]);
      }
      decimate();
    }
  }

  void put(int s, Vertex v)
  {
    m_samples.points[s] = m.point(v);
    m_samples.normals[s] = m.normals[v];
  }

  // Samples that are away from the vertices `rest`, no two of them neighbours, those first over
  // whose neighbours the mesh is least high.
  std::vector<Vertex> removable_samples(const std::vector<Vertex>& rest,
                                        const std::vector<char>& may_go) const
  {
    std::vector<char> is_near(m.samples.size(), false);
    for (const Vertex v : rest) is_near[v] = true;
    for (int ring = 0; ring < rings_kept; ++ring) {
      const std::vector<char> inner = is_near;
      for (const auto e : m.mesh.edges()) {
        const Vertex a = m.mesh.vertex(e, 0), b = m.mesh.vertex(e, 1);
        if (inner[a] || inner[b]) is_near[a] = is_near[b] = true;
      }
    }
    std::vector<std::pair<double, Vertex>> order;
    for (const Vertex v : m.mesh.vertices()) {
      const int s = m.samples[v];
      if (s < 0 || s >= int(m_movable) || !may_go[s] || is_near[v] || m.mesh.is_isolated(v) ||
          m.mesh.is_border(v) || m.is_on_feature(v))
        continue;
      Vec3d normal{0, 0, 0};
      for (const Halfedge h : halfedges_around_target(v, m.mesh))
        normal += m.area_vector(v, m.mesh.target(m.mesh.next(h)), m.mesh.source(h));
      normal = normalized(normal);
      double height = 0;
      for (const Halfedge h : halfedges_around_target(v, m.mesh))
        height = std::max(height, std::abs(dot(normal, m.point(m.mesh.source(h)) - m.point(v))));
      order.emplace_back(height, v);
    }
    std::sort(order.begin(), order.end());
    std::vector<Vertex> chosen;
    for (const auto& [height, v] : order) {
      if (is_near[v]) continue;
      chosen.push_back(v);
      for (const Halfedge h : halfedges_around_target(v, m.mesh)) is_near[m.mesh.source(h)] = true;
    }
    return chosen;
  }

  static constexpr int max_exchanges = 10;
  static constexpr int rings_kept = 2; // around vertices that must stay

  const Surface& m_surface;
  Samples& m_samples;
  std::size_t m_movable;
  Working_mesh m;
  Intersection_guard m_guard;
  Edge_flipper m_flipper;
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_EXTRACT_GUARDED_H
