// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fields of a lattice behind plain arrays: it knows no backend, so that an engine can make them
// where it works.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_BASE_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_BASE_H

#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF {

/// A free node of the finest level; coordinates are those of the plan's cube.
struct Lattice_node {
  Vec3<float> point, normal;
  float spacing; ///< h
  int component;
  int facet; ///< the place in the surface's tree
};

/// A point that may become a sample.
struct Sample_candidate {
  Vec3<float> point;
  float distance;    ///< from the node, relative to the spacing; -1: the point is the node
  Lattice_node node; ///< where the lattice is seen from
};

using Sample_candidates = internal::Unset_vector<Sample_candidate>;

class Lattice_field_base {
public:
  virtual ~Lattice_field_base() = default;
  /// The directions of the rows, and the places of the points for all spacings times `factor`.
  virtual void solve(float factor) = 0;
  /// Finds the lattice's points on the components that have one. \pre solved
  /// \returns how many there are; those that come twice, where the fields do not fit, count once
  virtual std::size_t find_points() = 0;
  /// The points that were found last; then the free nodes that are near none of them and no site on
  /// creases and borders, and all of the components without lattice.
  virtual Sample_candidates candidates() = 0;
  /// `n` of them, for one component, by elimination; none where the host has to choose. What was
  /// solved may be gone.
  virtual std::optional<Sample_candidates> choose_candidates(std::size_t n) = 0;
  /// The free nodes of the components c with `is_wanted[c]`.
  virtual Sample_candidates nodes_of(const std::vector<unsigned char>& is_wanted) = 0;
};

/// Makes `n` candidates of a field, for one component, the samples that the `set_samples()` of the
/// engine that has made the field takes next. \returns how many of them are no points of the
/// lattice; none: the host has to choose
using Place_candidates =
    std::function<std::optional<std::size_t>(Lattice_field_base& field, std::size_t n)>;

struct Lattice_plan;

/// The plan has to live as long as the result.
using Make_lattice_field =
    std::function<std::unique_ptr<Lattice_field_base>(const Lattice_plan& plan)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_BASE_H
