// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's projection and attributes of one sample by a warp: lane l keeps the l-th nearest
// vertex. The results are those of a single thread, in the same order of additions.
#ifndef CGAL_POWER_RTF_CUDA_VERTICES_BY_WARP_CUH
#define CGAL_POWER_RTF_CUDA_VERTICES_BY_WARP_CUH

#include "../device/Warp_lanes.cuh"
#include "Surface_view.h"

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// In lane l: the l-th of the `k` <= 32 vertices nearest to `p`. Returns how many there are.
template <class Real>
__device__ inline int nearest_vertices(const Surface_view<Real>& view, const Vec3<Real>& p, int k,
                                       int& vertex, Warp_lanes lanes)
{
  constexpr int arity = Packed_tree_layout::arity;
  constexpr float none = 3e38f;
  const Packed_tree_layout& tree = view.vertex_tree;
  const int rank = lanes.rank(), child = rank % arity;
  const float q[3] = {float(p.x), float(p.y), float(p.z)};
  Real distance = Real(1e30); // of this lane's vertex
  vertex = 0x7fffffff;
  float bound = none;

  float pending[Packed_tree_layout::max_levels]; // of this lane's child, by level; none: done
  int level = tree.levels - 1, node = 0;
  for (bool is_new = true;;) {
    if (level == 0) {
      const int v = node * arity + rank;
      const bool is_there = v < tree.children_end(0, node);
      const Real d = is_there ? squared_length(view.vertices[v] - p) : Real(1e30);
      const Real last = lanes.from(distance, k - 1);
      for (unsigned left = lanes.those_with(is_there && d <= last); left != 0; left &= left - 1) {
        const int source = __ffs(left) - 1;
        const Real new_distance = lanes.from(d, source);
        const int new_vertex = lanes.from(v, source);
        const bool stays =
            distance < new_distance || (distance == new_distance && vertex < new_vertex);
        const int place = __popc(lanes.those_with(stays));
        const Real before_distance = lanes.from_before(distance);
        const int before_vertex = lanes.from_before(vertex);
        if (rank >= place) {
          distance = rank == place ? new_distance : before_distance;
          vertex = rank == place ? new_vertex : before_vertex;
        }
      }
      const Real farthest = lanes.from(distance, k - 1);
      bound = farthest < Real(1e30) ? bound_of(farthest) : none;
    } else if (is_new) {
      const Child_boxes& boxes = view.vertex_nodes[tree.first[level] + node];
      float sum = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const float outside =
            fmaxf(fabsf(q[axis] - boxes.center[axis][child]) - boxes.half[axis][child], 0.f);
        sum += outside * outside;
      }
      pending[level] = node * arity + child < tree.children_end(level, node) ? sum : none;
    }
    float nearest = none;
    const float mine = level > 0 && pending[level] <= bound ? pending[level] : none;
    if (level > 0) {
      nearest = mine;
#pragma unroll
      for (int step = arity / 2; step > 0; step /= 2)
        nearest = fminf(nearest, lanes.exchanged(nearest, step));
    }
    if (!(nearest < none)) { // nothing left here: up
      if (++level >= tree.levels) break;
      node /= arity;
      is_new = false;
      continue;
    }
    const int next = __ffs(lanes.those_with(mine == nearest)) - 1; // below 8: the others are copies
    if (child == next) pending[level] = none;
    node = node * arity + next;
    --level;
    is_new = true;
  }
  return k < tree.items ? k : tree.items;
}

/// See the version for a single thread.
template <class Real>
__device__ inline Surface_point<Real>
project_near_vertices(const Surface_view<Real>& view, const Vec3<Real>& p, const Vec3<Real>& normal,
                      Real cos_angle, int k, int hint, Warp_lanes lanes)
{
  const int patch = view.patches ? view.patches[hint] : 0;
  int vertex;
  const int count = nearest_vertices(view, p, k, vertex, lanes);
  Surface_point<Real> best;
  if (lanes.rank() < count)
    for (int at = view.first_facet[vertex]; at < view.first_facet[vertex + 1]; ++at) {
      const int place = view.vertex_facets[at];
      if (view.patches && view.patches[place] != patch) continue;
      const Facet_corners<Real> f = view.facets[place];
      if (!(dot(f.normal, normal) > cos_angle)) continue;
      const Vec3<Real> q = nearest_point_on_triangle(p, f.a, f.b, f.c);
      const Real d = squared_length(q - p);
      if (best.facet < 0 || d < best.squared_distance) best = {q, place, d};
    }
  int lane = lanes.rank(); // that found it: the first one wins
#pragma unroll
  for (int step = Warp_lanes::size / 2; step > 0; step /= 2) {
    const Surface_point<Real> other = {{lanes.exchanged(best.point.x, step),
                                        lanes.exchanged(best.point.y, step),
                                        lanes.exchanged(best.point.z, step)},
                                       lanes.exchanged(best.facet, step),
                                       lanes.exchanged(best.squared_distance, step)};
    const int other_lane = lanes.exchanged(lane, step);
    if (other.facet >= 0 &&
        (best.facet < 0 || other.squared_distance < best.squared_distance ||
         (other.squared_distance == best.squared_distance && other_lane < lane))) {
      best = other;
      lane = other_lane;
    }
  }
  return best;
}

/// See the version for a single thread.
template <class Real>
__device__ inline Vertex_attributes<Real>
attributes_near_vertices(const Surface_view<Real>& view, const Vec3<Real>& p, int facet,
                         int normal_neighbors, int density_neighbors, Real cos_angle,
                         Warp_lanes lanes)
{
  int k = normal_neighbors > density_neighbors ? normal_neighbors : density_neighbors;
  if (k < 3) k = 3;
  int vertex;
  const int count = nearest_vertices(view, p, k, vertex, lanes);
  bool counts = lanes.rank() < count;
  if (view.patches && counts)
    counts = view.patches[view.vertex_facets[view.first_facet[vertex]]] == view.patches[facet];
  const unsigned near = lanes.those_with(counts);
  if (near == 0) return attributes_of_facet(view, p, facet);
  const Vertex_attributes<Real> own =
      counts ? view.attributes[vertex] : Vertex_attributes<Real>{{0, 0, 0}, 0};
  const auto of = [&](int lane) {
    return Vertex_attributes<Real>{{lanes.from(own.normal.x, lane), lanes.from(own.normal.y, lane),
                                    lanes.from(own.normal.z, lane)},
                                   lanes.from(own.density, lane)};
  };
  Vec3<Real> basic{0, 0, 0}, sum{0, 0, 0};
  unsigned left = near;
  for (int l = 0; l < 3 && left != 0; ++l, left &= left - 1) basic += of(__ffs(left) - 1).normal;
  basic = normalized(basic);
  Real densities = 0;
  int compatible = 0, l = 0;
  for (left = near; left != 0; ++l, left &= left - 1) {
    const Vertex_attributes<Real> v = of(__ffs(left) - 1);
    if (!(dot(basic, v.normal) > cos_angle)) continue;
    if (l < normal_neighbors) sum += v.normal;
    if (l < density_neighbors) {
      densities += v.density;
      ++compatible;
    }
  }
  const Vertex_attributes<Real> nearest = of(__ffs(near) - 1);
  return {squared_length(sum) > 0 ? normalized(sum) : nearest.normal,
          compatible > 0 ? densities / compatible : nearest.density};
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_VERTICES_BY_WARP_CUH
