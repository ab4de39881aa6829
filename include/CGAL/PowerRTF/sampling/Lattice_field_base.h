// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fields of a lattice behind plain arrays: it knows no backend, so that an engine can make them
// where it works.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_BASE_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_BASE_H

#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/sampling/lattice_points.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace CGAL::PowerRTF {

/// Nodes as they come: first those that are free, in spatial order, then the sites on creases and
/// borders, which are points of the lattice.
struct Lattice_nodes {
  int free = 0;
  internal::Unset_vector<Vec3f> points;   ///< in the unit box
  internal::Unset_vector<Vec3f> normals;  ///< unit
  internal::Unset_vector<int> components; ///< of the surface
  internal::Unset_vector<float> spacing;  ///< h
  // Of the sites:
  internal::Unset_vector<Phasor> directions;         ///< along a curve, six times the angle
  internal::Unset_vector<unsigned char> is_directed; ///< the direction stays

  int size() const { return static_cast<int>(points.size()); }
  void resize(std::size_t free_nodes, std::size_t sites)
  {
    free = static_cast<int>(free_nodes);
    points.resize(free_nodes + sites);
    normals.resize(points.size());
    components.resize(points.size());
    spacing.resize(points.size());
    directions.resize(sites);
    is_directed.resize(sites);
  }
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

/// Points of the lattice, and the node that each is nearest to.
struct Chosen_points {
  std::vector<int> nodes; ///< in increasing order
  std::vector<Seen_point> points;
};

class Lattice_field_base {
public:
  virtual ~Lattice_field_base() = default;
  /// The directions of the rows, and the places of the points for all spacings times `factor`.
  virtual void solve(float factor) = 0;
  /// The lattice's points; some come twice where the fields do not fit. \pre solved
  virtual Chosen_points points() = 0;
  /// How many of some points have another one nearly at the same place.
  virtual std::size_t count_twins(const Chosen_points& points) = 0;
  /// Of each free node, whether none of the points and of the sites on creases and borders is near.
  virtual std::vector<unsigned char> gaps(const Chosen_points& points) = 0;
};

/// `levels`: from fine to coarse; free nodes of all levels are in the same order along the surface.
/// They have to live as long as the result. `is_even`: the spacing is the same everywhere.
using Make_lattice_field = std::function<std::unique_ptr<Lattice_field_base>(
    const std::vector<Lattice_nodes>& levels, bool is_even, std::uint64_t seed)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_BASE_H
