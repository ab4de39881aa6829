// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the nodes of a lattice are made of: stratified points of the surface, level by level from
// fine to coarse, which are made where the fields are, and the sites on creases and borders.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_PLAN_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_PLAN_H

#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/sampling/Component_share.h>
#include <CGAL/PowerRTF/sampling/Surface_strata.h>
#include <CGAL/PowerRTF/sampling/lattice_nodes.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace CGAL::PowerRTF {

/// Sites on creases and borders as nodes of a level, which are points of the lattice.
struct Lattice_sites {
  std::vector<Vec3f> points;  ///< in the cube
  std::vector<Vec3f> normals; ///< unit
  std::vector<int> components;
  std::vector<float> spacing;
  std::vector<Phasor> directions;         ///< along a curve, six times the angle
  std::vector<unsigned char> is_directed; ///< the direction stays

  std::size_t size() const { return points.size(); }
  void resize(std::size_t n)
  {
    points.resize(n);
    normals.resize(n);
    components.resize(n);
    spacing.resize(n);
    directions.resize(n);
    is_directed.resize(n);
  }
};

struct Lattice_plan {
  Surface_strata strata; ///< facets are called by their places in the surface's tree
  Surface_cube cube;     ///< the nodes' coordinates are inside
  std::vector<Component_share> shares;
  std::vector<std::size_t> free; ///< nodes of each level, but for sites
  std::vector<Lattice_sites> sites;
  bool is_even; ///< the spacing is the same everywhere
  std::uint64_t seed;

  /// Of the random numbers of a level's nodes.
  std::uint64_t seed_of(std::size_t level) const { return seed + 1 + level; }
};

constexpr double nodes_per_lattice_point = 4;

/// The free nodes of each level, from fine to coarse, for a lattice of so many points.
inline std::vector<std::size_t> lattice_levels(std::size_t points)
{
  constexpr double coarsening = 4, coarsest = 64;
  std::vector<std::size_t> sizes;
  for (double size = nodes_per_lattice_point * static_cast<double>(points);; size /= coarsening) {
    sizes.push_back(static_cast<std::size_t>(std::ceil(size)));
    if (size <= coarsest) return sizes;
  }
}

/// h of a node, inside the cube.
CGAL_POWER_RTF_HD inline float node_spacing(const Surface_cube& cube, const Component_share& share,
                                            double density)
{
  const double cell = share.cell_mass / density; // sqrt(3) / 2 h^2
  return static_cast<float>(cube.scale * std::sqrt(2 / std::sqrt(3.) * cell));
}

/// Makes a free node of a level.
template <class Real>
struct Make_node {
  Surface_view<Real> surface;
  Strata_view strata;
  Surface_cube cube;
  const Component_share* shares;
  int count;
  std::uint64_t seed;
  Vec3f *points, *normals;
  int* components;
  float* spacing;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    const auto densities = [&](int facet) {
      return Vec3d{attributes(facet, 0).density, attributes(facet, 1).density,
                   attributes(facet, 2).density};
    };
    const Strata_view::Point place = strata.point(i, count, seed, densities);
    const Vec3d w = place.weights;
    const int facet = strata.facet(place.at);
    const Facet_corners<Real> f = surface.facets[facet];
    const auto mean = [&](const Vec3<Real>& a, const Vec3<Real>& b, const Vec3<Real>& c) {
      return w.x * to_double(a) + w.y * to_double(b) + w.z * to_double(c);
    };
    const Vec3d normal =
        mean(attributes(facet, 0).normal, attributes(facet, 1).normal, attributes(facet, 2).normal);
    const bool is_clear = squared_length(normal) > 1e-6;
    points[i] = to_real<float>(cube.to_inside(mean(f.a, f.b, f.c)));
    normals[i] = to_real<float>(is_clear ? normalized(normal) : to_double(f.normal));
    components[i] = strata.components[place.at];
    spacing[i] = node_spacing(cube, shares[components[i]], dot(w, densities(facet)));
  }

private:
  CGAL_POWER_RTF_HD const Vertex_attributes<Real>& attributes(int facet, int corner) const
  {
    return surface.attributes[surface.facet_vertices[3 * facet + corner]];
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_PLAN_H
