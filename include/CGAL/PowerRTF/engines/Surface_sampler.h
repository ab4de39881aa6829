// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a sample takes from the surface: its projection, its normal and its density, in the two ways
// that `Remeshing_options` names (over the facet, or over the nearest vertices as in the paper).
#ifndef CGAL_POWER_RTF_ENGINES_SURFACE_SAMPLER_H
#define CGAL_POWER_RTF_ENGINES_SURFACE_SAMPLER_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/engines/Facet_tree.h>
#include <CGAL/PowerRTF/surface/Surface.h>
#include <CGAL/PowerRTF/surface/nearest_vertices.h>
#include <CGAL/PowerRTF/surface/surface_geometry.h>
#include <CGAL/PowerRTF/surface/vertex_facets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace CGAL {
namespace PowerRTF {

/// Cosine of the compatibility angle Theta (degrees); -2 when every pair is compatible.
inline double compatibility_cosine(double normal_angle)
{ return normal_angle >= 180 ? -2 : std::cos(normal_angle * 3.14159265358979323846 / 180); }

class Surface_sampler {
public:
  /// Keeps references to `surface`.
  Surface_sampler(const Surface& surface, const Remeshing_options& options)
      : m_surface(surface), m_options(options),
        m_cos_angle(compatibility_cosine(options.normal_angle)),
        m_facets(surface.points, surface.triangles, surface.facet_patches)
  {
    if (options.projection == Projection::nearest_vertices ||
        options.attributes == Attributes::nearest_vertices)
      m_vertices = std::make_unique<Vertices>(surface);
  }

  /// Projects `target` onto the facets whose normals agree with `normal` (Section 4.2.2), on the
  /// patch of the facet `hint`, which is probably near. The result's facet is -1 when no facet agrees.
  Surface_point<double> project(const Vec3d& target, const Vec3d& normal, int hint) const
  {
    if (m_options.projection == Projection::nearest_facet)
      return nearest_facet(m_facets.view(), target, normal, m_cos_angle, hint);
    return project_near_vertices(target, normal, patch_of(hint));
  }

  /// Normal n_i and density rho(s_i) of a point of facet `facet` (Section 4.3).
  void attributes(const Vec3d& p, int facet, Vec3d& normal, double& density) const
  {
    if (m_options.attributes == Attributes::nearest_vertices)
      if (attributes_near_vertices(p, patch_of(facet), normal, density)) return;
    const Triangle& t = m_surface.triangles[facet];
    double beta, gamma;
    barycentric_coordinates(p, m_surface.points[t[0]], m_surface.points[t[1]],
                            m_surface.points[t[2]], beta, gamma);
    const std::array<double, 3> weights{1 - beta - gamma, beta, gamma};
    // Of the vertices, not of the facet: small facets of real meshes are sometimes turned over.
    normal = interpolated_normal(m_surface, facet, weights);
    density = interpolated_density(m_surface, facet, weights);
  }

  const Facet_tree& facet_tree() const { return m_facets; }

private:
  struct Vertices {
    explicit Vertices(const Surface& surface) : nearest(surface), facets(vertex_facets(surface)) {}
    Nearest_vertices nearest;
    Vertex_facets facets;
  };

  int patch_of(int facet) const
  { return m_surface.facet_patches.empty() ? 0 : m_surface.facet_patches[facet]; }

  Surface_point<double> project_near_vertices(const Vec3d& target, const Vec3d& normal,
                                              int patch) const
  {
    std::vector<int> near(m_options.projection_neighbors);
    near.resize(m_vertices->nearest.find(target, m_options.projection_neighbors, near.data()));
    Surface_point<double> best;
    for (int v : near)
      for (int k = m_vertices->facets.first[v]; k < m_vertices->facets.first[v + 1]; ++k) {
        const int f = m_vertices->facets.facet[k];
        if (patch_of(f) != patch) continue;
        if (!(dot(m_surface.facet_normals[f], normal) > m_cos_angle)) continue;
        const Triangle& t = m_surface.triangles[f];
        const Vec3d q = nearest_point_on_triangle(target, m_surface.points[t[0]],
                                                  m_surface.points[t[1]], m_surface.points[t[2]]);
        const double d = squared_length(q - target);
        if (best.facet < 0 || d < best.squared_distance) best = {q, f, d};
      }
    return best;
  }

  /// Means over the k_n and k_d nearest vertices whose normals agree with the basic normal, the
  /// mean of the three nearest ones (NVISPC), and which lie on the patch. `false` if none does.
  bool attributes_near_vertices(const Vec3d& p, int patch, Vec3d& normal, double& density) const
  {
    const int k = std::max({m_options.normal_neighbors, m_options.density_neighbors, 3});
    std::vector<int> near(k);
    near.resize(m_vertices->nearest.find(p, k, near.data()));
    if (!m_surface.facet_patches.empty()) {
      const auto is_elsewhere = [&](int v) {
        return patch_of(m_vertices->facets.facet[m_vertices->facets.first[v]]) != patch;
      };
      near.erase(std::remove_if(near.begin(), near.end(), is_elsewhere), near.end());
      if (near.empty()) return false;
    }
    const auto& normals = m_surface.vertex_normals;
    Vec3d basic{0, 0, 0};
    for (std::size_t l = 0; l < near.size() && l < 3; ++l) basic += normals[near[l]];
    basic = normalized(basic);
    Vec3d sum{0, 0, 0};
    double densities = 0;
    int compatible = 0;
    for (int l = 0; l < int(near.size()); ++l) {
      if (!(dot(basic, normals[near[l]]) > m_cos_angle)) continue;
      if (l < m_options.normal_neighbors) sum += normals[near[l]];
      if (l < m_options.density_neighbors) {
        densities += m_surface.vertex_density[near[l]];
        ++compatible;
      }
    }
    normal = squared_length(sum) > 0 ? normalized(sum) : normals[near[0]];
    density = compatible > 0 ? densities / compatible : m_surface.vertex_density[near[0]];
    return true;
  }

  const Surface& m_surface;
  Remeshing_options m_options;
  double m_cos_angle;
  Facet_tree m_facets;
  std::unique_ptr<Vertices> m_vertices;
};

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_ENGINES_SURFACE_SAMPLER_H
