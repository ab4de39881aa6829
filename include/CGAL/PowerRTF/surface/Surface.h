// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input surface and the samples as flat arrays: what every later stage reads.
#ifndef CGAL_POWER_RTF_SURFACE_SURFACE_H
#define CGAL_POWER_RTF_SURFACE_SURFACE_H

#include <CGAL/PowerRTF/cells/vector.h>

#include <array>
#include <vector>

namespace CGAL {
namespace PowerRTF {

using Triangle = std::array<int, 3>;
using Edge = std::array<int, 2>;

/// The edge between `a` and `b`, smaller vertex first.
inline Edge sorted_edge(int a, int b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// Maps the input to the unit box and back: `inside = (outside - center) * scale`.
/// `scale` is a power of two, so that the mapping rounds only in the translation.
struct Normalization {
  Vec3d center{0, 0, 0}; ///< centre of the input's bounding box
  double scale = 1;      ///< power of two; the box's longest side becomes at most 1

  Vec3d to_inside(const Vec3d& p) const { return (p - center) * scale; }
  Vec3d to_outside(const Vec3d& p) const { return p * (1 / scale) + center; }
};

/// A triangulated, oriented 2-manifold surface (possibly with borders and several components) in
/// the coordinates of the unit box, with the fields that steer the sampling. One with one side only
/// (a Moebius strip) is oriented but for its seams.
struct Surface {
  std::vector<Vec3d> points;          ///< #V positions
  std::vector<Triangle> triangles;    ///< #F vertex indices, counter-clockwise seen from outside
  std::vector<Vec3d> facet_normals;   ///< #F unit normals
  std::vector<double> facet_areas;    ///< #F areas
  std::vector<Vec3d> vertex_normals;  ///< #V unit normals, n^v of the paper
  std::vector<double> vertex_density; ///< #V densities rho > 0; 1 everywhere: uniform
  std::vector<int> input_vertices;    ///< #V place of each vertex among those of the input
  std::vector<Edge> creases;          ///< edges, smaller vertex first, that the result must keep
  std::vector<Edge> seams;            ///< the creases at which the orientations do not agree
  /// #F patch of each facet: samples live on one patch. Empty: the surface is one patch.
  std::vector<int> facet_patches;
  double area = 0;                    ///< sum of the facets' areas
  Normalization normalization;
};

/// Points on the surface. The arrays have one entry per sample, in an order that stays the same
/// from the initial sampling to the vertices of the output.
struct Samples {
  std::vector<Vec3d> points;    ///< s_i, unit-box coordinates
  std::vector<int> facets;      ///< the surface's facet that carries s_i
  std::vector<Vec3d> normals;   ///< n_i, unit
  std::vector<double> density;  ///< rho(s_i)
  std::vector<double> weights;  ///< w_i (length squared); mean 0
  std::vector<int> patches;     ///< of the facets; empty: all on one patch

  std::size_t size() const { return points.size(); }
};

/// The samples of `a`, then those of `b`.
inline Samples joined(Samples a, const Samples& b)
{
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(a.points, b.points);
  append(a.facets, b.facets);
  append(a.normals, b.normals);
  append(a.density, b.density);
  append(a.weights, b.weights);
  append(a.patches, b.patches);
  return a;
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_SURFACE_SURFACE_H
