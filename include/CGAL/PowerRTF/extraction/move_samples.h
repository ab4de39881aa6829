// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the samples are too sparse for the surface (a thin part, close sheets, a small handle) the
// extracted mesh intersects itself or keeps vertices of the surface. Samples are then moved there
// from flat places far away, and the mesh is extracted anew: the number of samples stays.
// (An addition to the paper.)
#ifndef CGAL_POWER_RTF_EXTRACTION_MOVE_SAMPLES_H
#define CGAL_POWER_RTF_EXTRACTION_MOVE_SAMPLES_H

#include <CGAL/PowerRTF/engines/Facet_tree.h>
#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/surface/point_grid.h>
#include <CGAL/PowerRTF/surface/surface_geometry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

class Sample_mover
{
public:
  /// `movable`: the first so many samples; the others stay.
  Sample_mover(const Surface& surface, std::size_t movable)
      : m_surface(surface), m_may_go(movable, true),
        m_tree(surface.points, surface.triangles, surface.facet_patches)
  {
  }

  /// Moves samples of `mesh`, which was extracted on `samples`, to the places around the facets
  /// `bad` and to the vertices that are no samples.
  /// \returns the number of samples that were moved
  std::size_t run(const Extracted_mesh& mesh, const std::vector<int>& bad, Samples& samples)
  {
    mark_region(mesh, bad, samples.size());
    find_places(mesh, bad, samples);
    const std::vector<int> removable = removable_samples(mesh, samples.size());
    const std::size_t moved = std::min(removable.size(), m_places.size());
    for (std::size_t k = 0; k < moved; ++k) {
      put(removable[k], m_places[k], samples);
      m_may_go[removable[k]] = false;
    }
    return moved;
  }

private:
  struct Place {
    Vec3d point;
    int facet;
    Vec3d normal;
  };

  // Sets the distance of each vertex to the bad facets in edges: 0, 1, 2, or 3 for all others.
  void mark_region(const Extracted_mesh& mesh, const std::vector<int>& bad, std::size_t samples)
  {
    m_rings.assign(mesh.points.size(), far);
    for (const int f : bad)
      for (const int v : mesh.triangles[f]) m_rings[v] = 0;
    for (std::size_t v = samples; v < mesh.points.size(); ++v) m_rings[v] = 0;
    for (int ring = 1; ring < far; ++ring)
      for (const Triangle& t : mesh.triangles)
        if (std::min({m_rings[t[0]], m_rings[t[1]], m_rings[t[2]]}) == ring - 1)
          for (const int v : t) m_rings[v] = std::min(m_rings[v], ring);
  }

  // The vertices that are no samples, then points inside the bad facets and those around them.
  void find_places(const Extracted_mesh& mesh, const std::vector<int>& bad, const Samples& samples)
  {
    m_places.clear();
    std::vector<int> all(samples.size());
    std::iota(all.begin(), all.end(), 0);
    const double spacing = std::sqrt(m_surface.area / double(samples.size()));
    const Point_grid grid(samples.points, all, spacing);
    const auto is_free = [&](const Place& place, double radius) {
      bool free = true;
      const auto look = [&](const Vec3d& normal) {
        if (dot(normal, place.normal) > same_sheet) free = false;
      };
      grid.for_each_near(place.point, radius, [&](int s, double) { look(samples.normals[s]); });
      for (const Place& other : m_places)
        if (squared_length(other.point - place.point) < radius * radius) look(other.normal);
      return free;
    };
    for (std::size_t v = samples.size(); v < mesh.points.size(); ++v)
      m_places.push_back(place_near(mesh.points[v], Vec3d{0, 0, 0}, -2));
    std::vector<std::pair<double, Place>> places;
    for (const int f : bad) {
      const Triangle& t = mesh.triangles[f];
      for (int i = 0; i < 3; ++i) {
        const int a = t[i], b = t[(i + 1) % 3];
        const Vec3d p = mesh.points[a], q = mesh.points[b];
        const Vec3d normal = normal_at(mesh, samples, a) + normal_at(mesh, samples, b);
        places.emplace_back(-length(p - q), place_near(0.5 * (p + q), normal, same_sheet));
      }
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [negative_length, place] : places)
      if (place.facet >= 0 && is_free(place, -closest * negative_length)) m_places.push_back(place);
  }

  Vec3d normal_at(const Extracted_mesh& mesh, const Samples& samples, int v) const
  {
    if (v < int(samples.size())) return samples.normals[v];
    return place_near(mesh.points[v], Vec3d{0, 0, 0}, -2).normal;
  }

  Place place_near(const Vec3d& p, const Vec3d& normal, double least_cosine) const
  {
    const Surface_point<double> y = nearest_facet(m_tree.view(), p, normalized(normal), least_cosine, -1);
    return {y.point, y.facet, y.facet < 0 ? Vec3d{0, 0, 0} : m_surface.facet_normals[y.facet]};
  }

  // Samples far from the bad facets, no two neighbours, the least missed first: the height of the
  // mesh at the sample over its ring.
  std::vector<int> removable_samples(const Extracted_mesh& mesh, std::size_t samples) const
  {
    std::vector<double> height(samples, 0);
    std::vector<std::vector<int>> ring(samples);
    std::vector<Vec3d> normals(samples, Vec3d{0, 0, 0});
    for (const Triangle& t : mesh.triangles) {
      const Vec3d n = cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
      for (int i = 0; i < 3; ++i)
        if (t[i] < int(samples)) {
          normals[t[i]] += n;
          ring[t[i]].push_back(t[(i + 1) % 3]);
        }
    }
    std::vector<int> order;
    for (std::size_t v = 0; v < m_may_go.size(); ++v) {
      if (!m_may_go[v] || m_rings[v] < far) continue;
      order.push_back(int(v));
      const Vec3d n = normalized(normals[v]);
      for (const int u : ring[v])
        height[v] = std::max(height[v], std::abs(dot(n, mesh.points[u] - mesh.points[v])));
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return height[a] < height[b]; });
    std::vector<char> is_taken(mesh.points.size(), 0);
    std::vector<int> chosen;
    for (const int v : order) {
      if (is_taken[v]) continue;
      chosen.push_back(v);
      for (const int u : ring[v]) is_taken[u] = 1;
    }
    return chosen;
  }

  void put(int s, const Place& place, Samples& samples) const
  {
    const Triangle& t = m_surface.triangles[place.facet];
    double beta, gamma;
    barycentric_coordinates(place.point, m_surface.points[t[0]], m_surface.points[t[1]],
                            m_surface.points[t[2]], beta, gamma);
    const std::array<double, 3> weights{1 - beta - gamma, beta, gamma};
    samples.points[s] = place.point;
    samples.facets[s] = place.facet;
    samples.normals[s] = interpolated_normal(m_surface, place.facet, weights);
    samples.density[s] = interpolated_density(m_surface, place.facet, weights);
    if (!samples.patches.empty() && !m_surface.facet_patches.empty())
      samples.patches[s] = m_surface.facet_patches[place.facet];
  }

  static constexpr int far = 3;              // rings around bad facets from which nothing is taken
  static constexpr double same_sheet = 0.2;  // cosine
  static constexpr double closest = 0.3;     // to other samples, of the length of the edge

  const Surface& m_surface;
  std::vector<char> m_may_go; // the first samples that have not been moved yet
  Facet_tree m_tree;
  std::vector<int> m_rings;
  std::vector<Place> m_places;
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_MOVE_SAMPLES_H
