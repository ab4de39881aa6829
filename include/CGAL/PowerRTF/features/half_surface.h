// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The half of a surface that is above a plane. Facets across the plane are cut there, after
// vertices that are very near to it have been moved onto it, so that no slivers arise. The border
// that arises lies in the plane exactly.
#ifndef CGAL_POWER_RTF_FEATURES_HALF_SURFACE_H
#define CGAL_POWER_RTF_FEATURES_HALF_SURFACE_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/surface_geometry.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// Cuts one surface.
class Surface_halver {
public:
  /// \param nearness in units of the shortest edge at a vertex: nearer ones move onto the plane
  Surface_halver(const Surface& whole, const Mirror_plane& mirror, double nearness,
                 Concurrency concurrency)
      : m_whole(whole), m_names(whole.points.size(), -1)
  {
    set_heights(mirror, nearness);
    m_half.mirror = mirror;
    m_half.normalization = whole.normalization;
    std::vector<int> polygon;
    for (std::size_t f = 0; f < whole.triangles.size(); ++f) {
      const Triangle& t = whole.triangles[f];
      const auto [low, high] = std::minmax({m_heights[t[0]], m_heights[t[1]], m_heights[t[2]]});
      m_lies_in_plane |= low == 0 && high == 0;
      if (!(high > 0)) continue;
      polygon.clear();
      for (int i = 0; i < 3; ++i) {
        const int a = t[i], b = t[(i + 1) % 3];
        if (m_heights[a] >= 0) polygon.push_back(name(a));
        if (is_cut(a, b)) polygon.push_back(crossing(a, b));
      }
      add(polygon);
      if (!whole.facet_labels.empty())
        m_half.facet_labels.resize(m_half.triangles.size(), whole.facet_labels[f]);
    }
    m_half.adjacency = facet_adjacency(m_half.triangles, m_half.points.size(), concurrency);
    add_creases();
    compute_geometry(m_half, concurrency);
  }

  /// The half, if it is a 2-manifold whose facets meet the plane in its border only.
  std::optional<Surface> release()
  {
    if (m_lies_in_plane) return std::nullopt;
    const Mirror_plane& mirror = *m_half.mirror;
    const std::vector<int>& opposite = m_half.adjacency.opposite;
    std::vector<int> borders(m_half.points.size(), 0); // that leave a vertex
    for (int h = 0; h < static_cast<int>(opposite.size()); ++h) {
      const int a = halfedge_source(m_half.triangles, h), b = halfedge_target(m_half.triangles, h);
      if (opposite[h] == Facet_adjacency::none)
        ++borders[a];
      else if (mirror.has(m_half.points[a]) && mirror.has(m_half.points[b]))
        return std::nullopt;
    }
    for (std::size_t v = 0; v < borders.size(); ++v)
      if (mirror.has(m_half.points[v]) && borders[v] != 1) return std::nullopt;
    return std::move(m_half);
  }

private:
  void set_heights(const Mirror_plane& mirror, double nearness)
  {
    std::vector<double> shortest(m_whole.points.size(), std::numeric_limits<double>::infinity());
    for (const Triangle& t : m_whole.triangles)
      for (int i = 0; i < 3; ++i)
        for (const int other : {t[(i + 1) % 3], t[(i + 2) % 3]})
          shortest[t[i]] = (std::min)(shortest[t[i]],
                                      squared_length(m_whole.points[other] - m_whole.points[t[i]]));
    for (std::size_t v = 0; v < m_whole.points.size(); ++v) {
      const double height = mirror.height(m_whole.points[v]);
      m_heights.push_back(height * height <= nearness * nearness * shortest[v] ? 0 : height);
    }
  }

  bool is_cut(int a, int b) const
  {
    return (m_heights[a] > 0 && m_heights[b] < 0) || (m_heights[a] < 0 && m_heights[b] > 0);
  }

  /// The vertex of the half that `v` is, which is not below the plane.
  int name(int v)
  {
    if (m_names[v] < 0)
      m_names[v] =
          add(m_heights[v] > 0 ? m_whole.points[v] : m_half.mirror->foot(m_whole.points[v]),
              m_whole.vertex_density[v], v);
    return m_names[v];
  }

  /// The vertex where edge `ab` is cut.
  int crossing(int a, int b)
  {
    const auto [it, is_new] = m_crossings.insert({sorted_edge(a, b), -1});
    if (is_new) {
      if (m_heights[a] < 0) std::swap(a, b); // the same on both sides
      const double at = m_heights[a] / (m_heights[a] - m_heights[b]);
      const Vec3d &p = m_whole.points[a], &q = m_whole.points[b];
      const double rho = m_whole.vertex_density[a], sigma = m_whole.vertex_density[b];
      it->second = add(m_half.mirror->foot(p + at * (q - p)), rho + at * (sigma - rho), a);
    }
    return it->second;
  }

  int add(const Vec3d& p, double density, int original)
  {
    m_half.points.push_back(p);
    m_half.vertex_density.push_back(density);
    m_half.input_vertices.push_back(m_whole.input_vertices[original]);
    return static_cast<int>(m_half.points.size()) - 1;
  }

  /// Adds a triangle, or a quadrangle cut along its shorter diagonal.
  void add(const std::vector<int>& polygon)
  {
    const auto diagonal = [&](int i) {
      return squared_length(m_half.points[polygon[i + 2]] - m_half.points[polygon[i]]);
    };
    const int i = polygon.size() == 4 && diagonal(1) < diagonal(0) ? 1 : 0;
    m_half.triangles.push_back({polygon[i], polygon[i + 1], polygon[i + 2]});
    if (polygon.size() == 4)
      m_half.triangles.push_back({polygon[i], polygon[i + 2], polygon[(i + 3) % 4]});
  }

  /// Those that are left of the creases; in the plane, those on the border that arises.
  void add_creases()
  {
    const std::vector<Edge> border = border_edges(m_half.triangles, m_half.adjacency);
    for (const auto& [a, b] : m_whole.creases) {
      if (is_cut(a, b)) {
        m_half.creases.push_back(sorted_edge(name(m_heights[a] > 0 ? a : b), crossing(a, b)));
      } else if (m_names[a] >= 0 && m_names[b] >= 0) {
        const Edge edge = sorted_edge(m_names[a], m_names[b]);
        if (m_heights[a] > 0 || m_heights[b] > 0 ||
            std::binary_search(border.begin(), border.end(), edge))
          m_half.creases.push_back(edge);
      }
    }
    sort_uniquely(m_half.creases);
  }

  const Surface& m_whole;
  std::vector<double> m_heights; // by vertex
  std::vector<int> m_names;      // by vertex: that of the half, or -1
  std::map<Edge, int> m_crossings;
  bool m_lies_in_plane = false; // a facet
  Surface m_half;
};

} // namespace internal

/// The half of `whole` above `mirror`, with its density and creases.
/// \throws Invalid_input_error it touches the plane otherwise than across it
inline Surface half_surface(const Surface& whole, const Mirror_plane& mirror,
                            internal::Concurrency concurrency = Sequential_tag())
{
  constexpr double near = 0.05;
  for (const double nearness : {near, 0.})
    if (auto half = internal::Surface_halver(whole, mirror, nearness, concurrency).release())
      return *std::move(half);
  throw Invalid_input_error("the surface cannot be halved by its plane of symmetry: a part of it "
                            "lies in the plane, or touches it without going across");
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_HALF_SURFACE_H
