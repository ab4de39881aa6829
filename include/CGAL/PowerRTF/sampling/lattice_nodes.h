// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nodes that carry the fields of a lattice: points of the surface with their nearest compatible
// neighbors, so that the input's tessellation does not matter.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_NODES_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_NODES_H

#include <CGAL/PowerRTF/geometry/Point_tree.h>
#include <CGAL/PowerRTF/geometry/Tangent_frame.h>
#include <CGAL/PowerRTF/sampling/phasor.h>

#include <cmath>
#include <cstddef>

namespace CGAL::PowerRTF {

using Vec3f = Vec3<float>;

/// What a node knows of a neighbor's lattice.
struct Lattice_edge {
  static constexpr unsigned none = (1u << 29) - 1;

  unsigned node : 29;  ///< the neighbor; `none`: there is none, nor any after it
  unsigned sixths : 3; ///< of a turn, from this node's axis to the neighbor's
  union {
    Short_phasor direction_turn; ///< what its direction is multiplied by, while these are smoothed
    Short_turn turns[2];         ///< then: what its phasors are multiplied by
  };

  CGAL_POWER_RTF_HD explicit Lattice_edge(unsigned its_node = none, unsigned its_sixths = 0)
      : node(its_node), sixths(its_sixths), turns{}
  {}
};

/// The waves whose crests are the rows of a hexagonal lattice, in the three directions: wave k has
/// the wave vector b_k, b_0 = (1, -1/sqrt 3) / h, b_1 = (0, 2/sqrt 3) / h, b_2 = -b_0 - b_1 in the
/// frame of the node's axis, and its phase at the node is b_k (node - p) turns, for any point p of
/// the lattice.
template <class Phasor>
struct Basic_waves {
  static constexpr int size = 3;
  Phasor wave[size];
};
using Waves = Basic_waves<Phasor>;
using Stored_waves = Basic_waves<Short_phasor>;

/// The unit tangent at a node along a row of the lattice, and the one to its left.
struct Lattice_frame {
  Vec3f axis, left;
};

/// Nodes of one level of the hierarchy. Non-owning.
struct Lattice_view {
  static constexpr int degree = 8; ///< a node's neighbors, at most

  int size = 0;
  int free = 0;                    ///< nodes from there on are sites on creases and borders
  const Vec3f* points = nullptr;   ///< in the unit box
  const Vec3f* normals = nullptr;  ///< unit
  const int* components = nullptr; ///< of the surface
  const float* node_spacing = nullptr;
  float scale = 1;               ///< of all spacings
  Lattice_edge* edges = nullptr; ///< `degree` per node, by increasing distance

  Vec3f* turning = nullptr; ///< angle of the lattice per length (`Set_turning`); null: none
  float* axes = nullptr;    ///< `quarter_tangent()` of a row's direction in the tangent frame
  Stored_waves* waves = nullptr;

  /// h, the distance between neighbors in the lattice.
  CGAL_POWER_RTF_HD float spacing(int i) const { return scale * node_spacing[i]; }
  CGAL_POWER_RTF_HD Lattice_frame frame(int i) const
  {
    const Tangent_frame<float> frame(normals[i]);
    const Phasor a = phasor_of_quarter(axes[i]);
    const Vec3f axis = a.x * frame.u + a.y * frame.v;
    return {axis, cross(normals[i], axis)};
  }
  CGAL_POWER_RTF_HD Lattice_edge* first_edge(int i) const
  {
    return edges + static_cast<std::size_t>(degree) * i;
  }
};

/// The node of the coarser level whose part of the surface has that of free node `i`.
CGAL_POWER_RTF_HD inline int coarse_node(const Lattice_view& coarse, const Lattice_view& fine,
                                         int i)
{
  return static_cast<int>(static_cast<long long>(i) * coarse.free / fine.free);
}

/// From node `j` of one level to node `i` of the same or another.
CGAL_POWER_RTF_HD inline Vec3f step_between(const Lattice_view& from, int j, const Lattice_view& to,
                                            int i)
{
  return to.points[i] - from.points[j];
}

/// The angle by which the lattice turns on that way, by the trapezoidal rule.
CGAL_POWER_RTF_HD inline float turning_between(const Lattice_view& from, int j,
                                               const Lattice_view& to, int i)
{
  if (!to.turning) return 0;
  return 0.5f * dot(from.turning[j] + to.turning[i], step_between(from, j, to, i));
}

/// Whether two normals agree enough for a field to be carried from one to the other.
CGAL_POWER_RTF_HD inline bool is_carried(const Vec3f& a, const Vec3f& b)
{
  return dot(a, b) > -0.9f;
}

/// The tangent `v` where the normal is `a`, carried to where it is `b` by the least rotation.
CGAL_POWER_RTF_HD inline Vec3f carried(const Vec3f& v, const Vec3f& a, const Vec3f& b)
{
  return v - (dot(v, b) / (1 + dot(a, b))) * (a + b);
}

/// The nearest nodes of the same component whose normals agree (NVISPC).
struct Find_lattice_neighbors {
  Lattice_view view;
  Point_tree_view<float> tree;
  float cos_angle;
  float reach; ///< distance within which most have so many, relative to the spacing

  CGAL_POWER_RTF_HD float radius(int i) const { return reach * view.node_spacing[i]; }

  /// Of node `i`. `near`: all points within the radius, or null.
  CGAL_POWER_RTF_HD void operator()(int i, const Near_points<float>* near) const
  {
    constexpr int enough = 4, degree = Lattice_view::degree;
    constexpr float everywhere = 4; // the coordinates are those of the unit box
    const auto counts = [&](int j) {
      return j != i && view.components[j] == view.components[i] &&
             dot(view.normals[i], view.normals[j]) > cos_angle;
    };
    const Vec3f p = view.points[i];
    int found[degree];
    int count = near ? tree.nearest_of<degree>(*near, p, radius(i), found, counts)
                     : tree.nearest<degree>(p, radius(i), found, counts);
    if (count < enough) count = tree.nearest<degree>(p, everywhere, found, counts);
    Lattice_edge* const edges = view.first_edge(i);
    for (int e = 0; e < degree; ++e)
      edges[e] = Lattice_edge(e < count ? unsigned(found[e]) : Lattice_edge::none);
  }
};

/// The same for a node: many threads are faster so.
struct Find_neighbors_of_node {
  Find_lattice_neighbors find;
  CGAL_POWER_RTF_HD void operator()(int i) const { find(i, nullptr); }
};

/// The same for the nodes of a leaf of the tree, which have most of those that are near in common:
/// few threads are faster so.
struct Find_neighbors_of_leaf {
  Find_lattice_neighbors find;

  CGAL_POWER_RTF_HD void operator()(int leaf) const
  {
    const Point_tree_view<float>& tree = find.tree;
    const int begin = tree.tree.children_begin(leaf), end = tree.tree.children_end(0, leaf);
    float largest = 0;
    for (int i = begin; i < end; ++i) largest = internal::larger(largest, find.radius(i));
    Near_points<float> near;
    const bool are_known = tree.find_near(begin, end, largest, near);
    for (int i = begin; i < end; ++i) find(i, are_known ? &near : nullptr);
  }
};

/// Calls `f(edge)` for the edges of node `i`.
template <class F>
CGAL_POWER_RTF_HD inline void for_each_edge(const Lattice_view& view, int i, F&& f)
{
  Lattice_edge* const edges = view.first_edge(i);
  for (int e = 0; e < Lattice_view::degree && edges[e].node != Lattice_edge::none; ++e) f(edges[e]);
}

/// How fast a lattice turns whose spacing varies. Rows of a lattice that is deformed without shear
/// are the images of straight lines under a conformal map, dz/dw = h e^(i theta), which has an
/// analytic logarithm: by Cauchy's and Riemann's equations grad theta = n x grad log h.
struct Set_turning {
  Lattice_view view;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    const Tangent_frame<float> frame(view.normals[i]);
    float xx = 0, xy = 0, yy = 0, xh = 0, yh = 0; // least squares over the neighbors
    for_each_edge(view, i, [&](const Lattice_edge& edge) {
      const Vec3f d = step_between(view, i, view, int(edge.node));
      const float x = dot(d, frame.u), y = dot(d, frame.v);
      const float growth = std::log(view.node_spacing[edge.node] / view.node_spacing[i]);
      xx += x * x;
      xy += x * y;
      yy += y * y;
      xh += x * growth;
      yh += y * growth;
    });
    const float determinant = xx * yy - xy * xy;
    view.turning[i] = {0, 0, 0};
    if (!(determinant > 1e-3f * xx * yy)) return;
    const float gx = (yy * xh - xy * yh) / determinant, gy = (xx * yh - xy * xh) / determinant;
    view.turning[i] = gx * frame.v - gy * frame.u;
  }
};

/// One sweep that takes the noise out of the turning.
struct Smooth_turning {
  Lattice_view view;
  Vec3f* result;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    Vec3f sum = view.turning[i];
    int count = 1;
    for_each_edge(view, i, [&](const Lattice_edge& edge) {
      sum += view.turning[edge.node];
      ++count;
    });
    result[i] = (1.f / float(count)) * sum;
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_NODES_H
