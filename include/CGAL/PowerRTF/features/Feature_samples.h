// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples that stay on corners, creases, borders and single vertices.
#ifndef CGAL_POWER_RTF_FEATURES_FEATURE_SAMPLES_H
#define CGAL_POWER_RTF_FEATURES_FEATURE_SAMPLES_H

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// A place on an edge of the surface, or at a vertex (`from == to`).
struct Edge_place {
  int from, to;
  double at; ///< 0: at `from`, 1: at `to`
};

/// \ingroup PkgPowerRTFSurface
/// The samples on creases and borders, and at single vertices.
struct Feature_samples {
  Samples samples;                ///< their normals are the means over the patches
  std::vector<Edge_place> places; ///< of the samples
  std::vector<Edge> edges;        ///< pairs of samples that the result must join
  Samples sites;                  ///< a copy of each sample for each patch
  /// For each site the next one along its patch's boundary, the patch to the left; -1: it is
  /// inside.
  std::vector<int> next;
  std::vector<int> samples_of_sites; ///< the sample that each site is a copy of

  std::size_t size() const { return samples.size(); }
  /// How many of the sites are inside their patches.
  std::size_t sites_inside() const { return std::count(next.begin(), next.end(), -1); }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_FEATURE_SAMPLES_H
