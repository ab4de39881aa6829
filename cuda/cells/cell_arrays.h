// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the construction of the cells reads and writes on the device: plain arrays, all in the order
// of the engine.
#ifndef CGAL_POWER_RTF_CUDA_CELL_ARRAYS_H
#define CGAL_POWER_RTF_CUDA_CELL_ARRAYS_H

#include <CGAL/PowerRTF/cells/Sites_view.h>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// The sites 0 .. cells - 1 have cells; those from there to `sites` - 1 only clip.
template <class Real>
struct Sites_arrays {
  const Site<Real>* sites = nullptr;   ///< points and weights
  const Vec3<Real>* normals = nullptr; ///< unit
  /// Cube root of the density that weights the centroids.
  const Real* density_root = nullptr;
  const int* patches =
      nullptr; ///< only sites of the same patch are compatible; null: all are of one
  /// The site after and before each fixed site on its patch's boundary, -1: none; see
  /// `clip_at_features()`. Null: there are none.
  const int *next = nullptr, *previous = nullptr;
  int cells = 0, sites_size = 0;
};

/// One entry per cell; a null pointer: not wanted.
template <class Real>
struct Cell_outputs {
  Real* area = nullptr;            ///< A(F_i); this and all below: of its part on the patch
  Real* mass = nullptr;            ///< integral of the density that weights the centroids
  Vec3<Real>* offset = nullptr;    ///< c_i - s_i
  unsigned char* status = nullptr; ///< a `Cell_status`
  int* edge_count = nullptr;       ///< edges with a neighbour, at most `edge_capacity`
  int* edge_neighbor = nullptr;    ///< edge k of cell i: [k * cells + i]
  Real* edge_ratio = nullptr;      ///< its length over the tangential distance of the neighbour
  int edge_capacity = 0;
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_CELL_ARRAYS_H
