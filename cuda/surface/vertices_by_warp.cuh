// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's projection and attributes of one sample by a warp: lane l keeps the l-th nearest
// vertex. The results are those of a single thread, in the same order of additions.
#ifndef CGAL_POWER_RTF_CUDA_VERTICES_BY_WARP_CUH
#define CGAL_POWER_RTF_CUDA_VERTICES_BY_WARP_CUH

#include "../backend/Warp_lanes.cuh"
#include "tree_by_lanes.cuh"

namespace CGAL::PowerRTF::device {

/// In lane l < k: the l-th of the `k` vertices nearest to `p`, at most 32 and all, by a search in
/// the tree. `within`: a squared distance that is known to hold as many. A call of its own: few
/// samples need it.
template <class Real>
__device__ __noinline__ int nearest_vertex_in_tree(const Surface_view<Real>& view,
                                                   const Vec3<Real>& p, int k, Real within,
                                                   Warp_lanes lanes)
{
  constexpr Real infinity = Real(1e30);
  const Packed_tree_layout& tree = view.vertex_tree;
  const int rank = lanes.rank();
  const float q[3] = {float(p.x), float(p.y), float(p.z)};
  Real distance = infinity; // of this lane's vertex
  int vertex = 0x7fffffff;
  float bound = bound_of(within);
  visit_near_leaves(tree, view.vertex_nodes, q, bound, lanes, [&](int node) {
    const int v = node * Packed_tree_layout::arity + rank;
    const bool is_there = v < tree.children_end(0, node);
    const Real d = is_there ? squared_length(view.vertices[v] - p) : infinity;
    const Real last = lanes.from(distance, k - 1);
    for (unsigned left = lanes.those_with(is_there && d <= last); left != 0; left &= left - 1) {
      const int source = __ffs(int(left)) - 1;
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
    if (farthest < infinity) bound = fminf(bound, bound_of(farthest));
  });
  return vertex;
}

/// What the lanes of a warp show each other.
template <class Real>
struct Vertex_memory {
  static constexpr int capacity = Surface_view<Real>::near_vertices;
  Real distances[capacity]; ///< of the candidates to the sample, squared
  int candidates[capacity];
  Real last; ///< distance of the last one found
  int found[Warp_lanes::size];
  int nodes[2][capacity]; ///< of a level of the tree and the next one
  Vertex_attributes<Real> attributes[Warp_lanes::size];
};

template <class Real>
__device__ inline Vertex_memory<Real>& vertex_memory()
{
  __shared__ Vertex_memory<Real> memories[Warp_lanes::in_block];
  return memories[threadIdx.x / Warp_lanes::size];
}

/// The vertex with the list that covers the largest ball around a point.
template <class Real>
struct List_center {
  Real cover; ///< the ball's radius
  int vertex;

  __device__ void take(const List_center& other)
  {
    if (other.cover > cover || (other.cover == cover && other.vertex < vertex)) *this = other;
  }
  /// Over lanes that differ in their ranks modulo `lanes_joined`.
  __device__ void join(int lanes_joined, Warp_lanes lanes)
  {
    for (int step = lanes_joined / 2; step > 0; step /= 2)
      take({lanes.exchanged(cover, step), lanes.exchanged(vertex, step)});
  }
};

/// Makes candidates of the vertices no farther from `p` than `within`, squared. Returns their
/// number, or -1: more than there is room for.
template <class Real>
__device__ inline int collect_vertices(const Surface_view<Real>& view, const Vec3<Real>& p,
                                       Real within, Vertex_memory<Real>& memory, Warp_lanes lanes)
{
  constexpr int arity = Packed_tree_layout::arity, nodes_at_once = Warp_lanes::size / arity;
  const Packed_tree_layout& tree = view.vertex_tree;
  const int rank = lanes.rank(), child = rank % arity;
  const float q[3] = {float(p.x), float(p.y), float(p.z)}, bound = bound_of(within);
  int size = 1; // nodes of this level
  lanes.synchronize();
  if (lanes.leads()) memory.nodes[(tree.levels - 1) % 2][0] = 0;
  for (int level = tree.levels - 1; level >= 0; --level) {
    lanes.synchronize();
    int next = 0; // nodes of the level below, or candidates
    for (int k = rank / arity; k - rank / arity < size; k += nodes_at_once) {
      const int node = k < size ? memory.nodes[level % 2][k] : 0, below = node * arity + child;
      bool is_near = k < size && below < tree.children_end(level, node);
      Real d = 0;
      if (level == 0) {
        d = is_near ? squared_length(view.vertices[below] - p) : Real(0);
        is_near = is_near && d <= within;
      } else {
        is_near =
            is_near && child_distance(tree, view.vertex_nodes, level, node, q, lanes) <= bound;
      }
      const unsigned near = lanes.those_with(is_near);
      const int place = next + __popc(near & lanes.those_before());
      next += __popc(near);
      if (next > Vertex_memory<Real>::capacity) return -1;
      if (!is_near) continue;
      (level == 0 ? memory.candidates : memory.nodes[(level - 1) % 2])[place] = below;
      if (level == 0) memory.distances[place] = d;
    }
    size = next;
  }
  return size;
}

/// The candidates of one lane: two vertices, or -1, and their squared distances to the sample.
template <class Real>
struct Two_candidates {
  static constexpr Real infinity = Real(1e30);
  int v[2] = {-1, -1};
  Real d[2] = {infinity, infinity};

  /// Reads two of the list of `center`, and makes candidates of those of the list that are no
  /// farther than the first `k`. Returns their number.
  __device__ int read_list(const Surface_view<Real>& view, const Vec3<Real>& p, int center, int k,
                           Vertex_memory<Real>& memory, Warp_lanes lanes)
  {
    const int rank = lanes.rank();
    const int* const list = view.near_lists + std::size_t(center) * memory.capacity + rank;
    v[0] = list[0];
    v[1] = list[Warp_lanes::size];
    if (v[0] >= 0) d[0] = squared_length(view.vertices[v[0]] - p);
    if (v[1] >= 0) d[1] = squared_length(view.vertices[v[1]] - p);
    Real within = rank < k ? d[0] : Real(0); // the first of the list are probably not far
    for (int step = Warp_lanes::size / 2; step > 0; step /= 2)
      within = fmax(within, lanes.exchanged(within, step));
    lanes.synchronize(); // the memory may still be read
    int candidates = 0;
#pragma unroll
    for (int m = 0; m < 2; ++m) {
      const unsigned near = lanes.those_with(d[m] <= within);
      const int place = candidates + __popc(near & lanes.those_before());
      if (d[m] <= within) {
        memory.distances[place] = d[m];
        memory.candidates[place] = v[m];
      }
      candidates += __popc(near);
    }
    lanes.synchronize();
    return candidates;
  }

  /// Reads two of the candidates that are there.
  __device__ void read_memory(const Vertex_memory<Real>& memory, int candidates, Warp_lanes lanes)
  {
    lanes.synchronize();
#pragma unroll
    for (int m = 0; m < 2; ++m) {
      const int own = m * Warp_lanes::size + lanes.rank();
      if (own >= candidates) continue;
      v[m] = memory.candidates[own];
      d[m] = memory.distances[own];
    }
  }

  /// Finds the first `k` of the candidates in the order of distances, and the last one's distance.
  __device__ void rank_nearest(int candidates, int k, Vertex_memory<Real>& memory,
                               Warp_lanes lanes) const
  {
    int place[2] = {0, 0};
#pragma unroll 4
    for (int c = 0; c < candidates; ++c) {
      const Real other = memory.distances[c];
      const int other_vertex = memory.candidates[c];
#pragma unroll
      for (int m = 0; m < 2; ++m)
        place[m] += other < d[m] || (other == d[m] && other_vertex < v[m]);
    }
#pragma unroll
    for (int m = 0; m < 2; ++m) {
      if (!(d[m] < infinity)) continue;
      if (place[m] < k) memory.found[place[m]] = v[m];
      if (place[m] == k - 1) memory.last = d[m];
    }
    lanes.synchronize();
  }
};

/// The same result as that of `nearest_vertex_in_tree()`. Looks first at the lists of vertices near
/// `hint`, a facet that is probably near: a list proves its nearest ones where the ball that it
/// covers holds them. A call of its own, which is made twice: instructions must be fetched, too.
template <class Real>
__device__ __noinline__ int nearest_vertex(const Surface_view<Real>& view, const Vec3<Real>& p,
                                           int k, int hint, Warp_lanes lanes)
{
  constexpr Real rounding = Real(2e-6); // of a few sums of lengths
  static_assert(Vertex_memory<Real>::capacity == 2 * Warp_lanes::size, "two candidates per lane");
  Vertex_memory<Real>& memory = vertex_memory<Real>();
  const int rank = lanes.rank();
  List_center<Real> center;
  center.vertex = view.facet_vertices[3 * hint + rank % 3];
  center.cover = view.near_reach[center.vertex] - length(view.vertices[center.vertex] - p);
  center.join(4, lanes); // all three corners
  Real last = Two_candidates<Real>::infinity;
  for (bool by_list = true;;) {
    Two_candidates<Real> own;
    int candidates = 0;
    if (by_list) {
      candidates = own.read_list(view, p, center.vertex, k, memory, lanes);
    } else {
      candidates = collect_vertices(view, p, last, memory, lanes);
      if (candidates < 0) return nearest_vertex_in_tree(view, p, k, last, lanes);
      own.read_memory(memory, candidates, lanes);
    }
    own.rank_nearest(candidates, k, memory, lanes);
    last = memory.last;
    const Real cover = center.cover - rounding * view.near_reach[center.vertex];
    if (!by_list || (cover > 0 && last < cover * cover)) return memory.found[rank < k ? rank : 0];

    List_center<Real> next = center;
#pragma unroll
    for (int m = 0; m < 2; ++m)
      if (own.v[m] >= 0) next.take({view.near_reach[own.v[m]] - std::sqrt(own.d[m]), own.v[m]});
    next.join(Warp_lanes::size, lanes);
    by_list = next.cover > center.cover; // else no list is better
    center = next;
  }
}

/// See the version for a single thread. The lanes share the facets, whatever vertex they are at.
template <class Real>
__device__ inline Surface_point<Real>
project_near_vertices(const Surface_view<Real>& view, const Vec3<Real>& p, const Vec3<Real>& normal,
                      Real cos_angle, int k, int hint, Warp_lanes lanes)
{
  const Facet_query<Real> query(view, p, normal, cos_angle, hint);
  const int rank = lanes.rank(), count = k < view.vertex_tree.items ? k : view.vertex_tree.items;
  const int vertex = nearest_vertex(view, p, count, hint, lanes);
  int first = 0, facets = 0; // of this lane's vertex
  if (rank < count) {
    first = view.first_facet[vertex];
    facets = view.first_facet[vertex + 1] - first;
  }
  int end = facets; // of the lanes up to this one
#pragma unroll
  for (int step = 1; step < Warp_lanes::size; step *= 2) {
    const int before = lanes.from_before(end, step);
    if (rank >= step) end += before;
  }
  const int all = lanes.from(end, Warp_lanes::size - 1), begin = end - facets;
  Surface_point<Real> best{}; // the first of equal ones
  int best_index = 0;
  for (int index = rank; index - rank < all; index += Warp_lanes::size) {
    int lane = 0; // the last one that begins no later
#pragma unroll
    for (int step = Warp_lanes::size / 2; step > 0; step /= 2)
      if (lanes.from(begin, lane + step) <= index) lane += step;
    const int at = lanes.from(first, lane) + index - lanes.from(begin, lane);
    if (index >= all) continue;
    const Surface_point<Real> x = query.onto(view.vertex_facets[at]);
    if (!is_nearer(x, index, best, best_index)) continue;
    best = x;
    best_index = index;
  }
  return nearest_of_lanes(best, best_index, lanes);
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
  const int count = k < view.vertex_tree.items ? k : view.vertex_tree.items;
  const int vertex = nearest_vertex(view, p, count, facet, lanes);
  bool counts = lanes.rank() < count;
  if (view.patches && counts)
    counts = view.patches[view.vertex_facets[view.first_facet[vertex]]] == view.patches[facet];
  const unsigned near = lanes.those_with(counts);
  if (near == 0) return attributes_of_facet(view, p, facet);
  Vertex_memory<Real>& memory = vertex_memory<Real>();
  if (counts) memory.attributes[__popc(near & lanes.those_before())] = view.attributes[vertex];
  lanes.synchronize();
  return mean_attributes<Real>(
      __popc(near), [&](int l) { return memory.attributes[l]; }, normal_neighbors,
      density_neighbors, cos_angle);
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_VERTICES_BY_WARP_CUH
