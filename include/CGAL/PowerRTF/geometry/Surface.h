// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The input surface and the samples as flat arrays: what every later stage reads.
#ifndef CGAL_POWER_RTF_GEOMETRY_SURFACE_H
#define CGAL_POWER_RTF_GEOMETRY_SURFACE_H

#include <CGAL/PowerRTF/geometry/Mirror_plane.h>
#include <CGAL/PowerRTF/geometry/snapped.h>
#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/Buckets.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFSurface
/// Indices of its vertices.
using Triangle = std::array<int, 3>;
/// \ingroup PkgPowerRTFSurface
/// Indices of its vertices, the smaller first.
using Edge = std::array<int, 2>;

/// The edge between `a` and `b`, smaller vertex first.
inline Edge sorted_edge(int a, int b) { return a < b ? Edge{a, b} : Edge{b, a}; }

/// Sorts the items and keeps the first of equal ones.
template <class Items>
void sort_uniquely(Items& items)
{
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

struct Resident_surface;

namespace internal {

struct Topology;

/// What is known of a surface or a mesh as it is, or nothing. A copy has nothing: what is copied is
/// going to change.
template <class T, class Pointer = std::shared_ptr<const T>>
struct Known {
  Pointer value;

  Known() = default;
  Known(const Known&) {}
  Known(Known&&) = default;
  Known& operator=(const Known&)
  {
    value.reset();
    return *this;
  }
  Known& operator=(Known&&) = default;
};

} // namespace internal

/// The facets across each edge. Halfedge `3 f + i` runs from corner `i` to corner `i + 1` of facet
/// `f`.
struct Facet_adjacency {
  static constexpr int none = -1;

  std::vector<int> opposite; ///< for each halfedge that of the other facet; `none` at borders and
                             ///< at edges of more than two facets
  internal::Buckets<int> corners; ///< of the facets, by vertex: `vertex_corners()`
  std::size_t border_edges = 0;
  std::size_t non_manifold_edges = 0; ///< edges of more than two facets
  bool same_direction = false;  ///< two facets traverse an edge alike: their orientations differ
  bool repeated_facets = false; ///< two facets have the same three vertices
};

/// \ingroup PkgPowerRTFSurface
/// Maps the input to the unit box and back: `inside = (outside - center) * scale`.
/// `scale` is a power of two. The points of a result lie on a grid on which the way back is exact:
/// what is judged inside is what is written outside.
struct Normalization {
  Vec3d center{0, 0, 0}; ///< near the center of the input's bounding box
  double scale = 1;      ///< power of two; the box's longest side becomes at most 1
  double reach = 0;      ///< no coordinate of a result is larger, outside
  double grid = 0;       ///< inside, a result's coordinates are multiples of it; 0: all are allowed

  Vec3d to_inside(const Vec3d& p) const { return (p - center) * scale; }
  Vec3d to_outside(const Vec3d& p) const { return p * (1 / scale) + center; }

  /// The finest grid on which `Number` holds all coordinates up to `reach`: its spacing, outside.
  template <class Number>
  double spacing() const
  {
    using Limits = std::numeric_limits<Number>;
    int exponent;
    std::frexp(reach, &exponent);
    return (std::max)(std::ldexp(1., exponent - Limits::digits), double(Limits::denorm_min()));
  }
  /// The point of the grid that is nearest to `p`.
  Vec3d snapped(const Vec3d& p) const { return grid > 0 ? PowerRTF::snapped(p, grid) : p; }
};

/// \ingroup PkgPowerRTFSurface
/// A triangulated, oriented 2-manifold surface (possibly with borders and several components) in
/// the coordinates of the unit box, with the fields that steer the sampling. One with one side only
/// (a Moebius strip) is oriented but for its seams. A network of such surfaces, which meet in edges
/// of more than two facets or touch in vertices, is one once it is cut along its seams and there.
struct Surface {
  std::vector<Vec3d> points;          ///< #V positions
  std::vector<Triangle> triangles;    ///< #F vertex indices, counter-clockwise seen from outside
  Facet_adjacency adjacency;          ///< of the triangles
  std::vector<Vec3d> facet_normals;   ///< #F unit normals
  std::vector<double> facet_areas;    ///< #F areas
  std::vector<Vec3d> vertex_normals;  ///< #V unit normals, \f$n^v\f$ of the paper
  std::vector<double> vertex_density; ///< #V densities \f$\rho > 0\f$; 1 everywhere: uniform
  std::vector<int> input_vertices;    ///< #V place of each vertex among those of the input
  std::vector<Edge> creases;          ///< edges, smaller vertex first, that the result must keep
  std::vector<int> facet_labels;      ///< #F labels, which creases part and whose areas the
                                      ///< result keeps; empty: none
  std::vector<Edge> seams;            ///< the creases at which the orientations do not
                                      ///< agree or more than two facets meet
  std::vector<int> contacts;          ///< vertices where sheets touch, off seams; sorted
  /// Edges of the border that the result has as they are, or the pieces that they have been halved
  /// into; sorted.
  std::vector<Edge> kept_edges;
  std::vector<int> kept_vertices; ///< their ends, and others that the result has; sorted
  std::vector<Vec3d> kept_points; ///< where those are in the input's coordinates
  bool has_own_density = false;   ///< of the user's own, which the result has everywhere
  /// #F patch of each facet: samples live on one patch. Empty: the surface is one patch.
  std::vector<int> facet_patches;
  /// Of the half of a symmetric surface, which is above: its border on the plane is where it goes
  /// on as its own mirror image.
  std::optional<Mirror_plane> mirror;
  std::size_t mirror_samples = 0; ///< to be on the plane; 0: as many as their spacing gives
  internal::Known<internal::Topology> topology; ///< of the facets as they are: `known_topology()`
  /// Where a GPU has the points and facets as they are; see `compute_geometry()`.
  internal::Known<Resident_surface> resident;
  double area = 0; ///< sum of the facets' areas
  Normalization normalization;

  /// Whether it must be cut to be an oriented 2-manifold.
  bool is_closed_up() const { return !seams.empty() || !contacts.empty(); }
  bool is_at_mirror(const Vec3d& p) const { return mirror && mirror->has(p); }
};

/// \ingroup PkgPowerRTFSurface
/// Points on the surface. The arrays have one entry per sample, in an order that stays the same
/// from the initial sampling to the vertices of the output.
struct Samples {
  std::vector<Vec3d> points;   ///< \f$s_i\f$, unit-box coordinates
  std::vector<int> facets;     ///< the surface's facet that carries \f$s_i\f$
  std::vector<Vec3d> normals;  ///< \f$n_i\f$, unit
  std::vector<double> density; ///< \f$\rho(s_i)\f$
  std::vector<double> weights; ///< \f$w_i\f$ (length squared); mean 0
  std::vector<int> patches;    ///< of the facets; empty: all on one patch

  std::size_t size() const { return points.size(); }
};

/// \ingroup PkgPowerRTFSurface
/// The samples of `a`, then those of `b`.
inline Samples joined(Samples a, const Samples& b)
{
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(a.points, b.points);
  append(a.facets, b.facets);
  append(a.normals, b.normals);
  append(a.density, b.density);
  append(a.weights, b.weights);
  append(a.patches, b.patches);
  return a;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SURFACE_H
