// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brings the caller's sites into Hilbert order and makes the tree of arity 32 over them.
#ifndef CGAL_POWER_RTF_CUDA_SORT_SITES_CUH
#define CGAL_POWER_RTF_CUDA_SORT_SITES_CUH

#include "../backend/Cuda_backend.h"
#include "Verlet_lists.h"
#include "warp_search.cuh"
#include <CGAL/PowerRTF/cells/Cell_arrays.h>
#include <CGAL/PowerRTF/geometry/hilbert_code.h>

namespace CGAL::PowerRTF::device {

template <class Real>
void find_hilbert_keys(Cuda_backend& backend, int n, const Site<Real>* sites, std::uint64_t* keys)
{
  backend.for_each(n, [=] __device__(int i) { keys[i] = hilbert_code(sites[i].point); });
}

/// `places[id]`: where the caller's site `id` lies.
inline void invert_order(Cuda_backend& backend, int n, const int* order, int* places)
{
  backend.for_each(n, [=] __device__(int place) { places[order[place]] = place; });
}

/// The boundaries' links between the caller's sites as links between places.
inline void link_places(Cuda_backend& backend, int n, const int* order, const int* places,
                        const int* caller_links, int* links)
{
  backend.for_each(n, [=] __device__(int place) {
    const int to = caller_links[order[place]];
    links[place] = to < 0 ? -1 : places[to];
  });
}

/// The node above the lanes with `exists`, the same on all lanes.
template <class Real>
__device__ inline Group_node<Real> join_lanes(Group_node<Real> node, bool exists)
{
  constexpr Real infinity = Real(1e30);
  if (!exists)
    node = {{infinity, infinity, infinity}, -infinity, {-infinity, -infinity, -infinity}, 0};
  node.lo = {warp_min(node.lo.x), warp_min(node.lo.y), warp_min(node.lo.z)};
  node.hi = {warp_max(node.hi.x), warp_max(node.hi.y), warp_max(node.hi.z)};
  node.max_weight = warp_max(node.max_weight);
  return node;
}

/// Makes the nodes of the levels above 1, by a block of 32 warps.
template <class Real>
__device__ inline void make_upper_nodes(Group_node<Real>* nodes, const Group_layout& tree, int warp,
                                        int lane)
{
  for (int level = 2; level < tree.levels; ++level) {
    for (int k = warp; k < tree.nodes(level); k += 32) {
      const int child = k * Group_layout::arity + lane;
      const bool is_child = child < tree.nodes(level - 1);
      Group_node<Real> node{};
      if (is_child) {
        const volatile Group_node<Real>& c = nodes[tree.first[level - 1] + child];
        node = {{c.lo.x, c.lo.y, c.lo.z}, c.max_weight, {c.hi.x, c.hi.y, c.hi.z}, 0};
      }
      node = join_lanes(node, is_child);
      if (lane == 0) nodes[tree.first[level] + k] = node;
    }
    __threadfence_block();
    __syncthreads();
  }
}

constexpr int gather_threads = 1024; // a block makes the nodes of levels 0 and 1 of its sites

/// Copies the sites into Hilbert order (`positions`: everything, else their weights only), notes
/// how their weights compare with those that the lists were made for, or are to be, and makes the
/// tree's nodes; the block that ends last does the levels above 1.
template <class Real>
__global__ void __launch_bounds__(gather_threads)
    gather_sites_kernel(Sites_arrays<Real> arrays, bool positions, const int* order,
                        Packed_site<Real>* sites, Packed_normal<Real>* normals, Real* density_root,
                        Group_node<Real>* nodes, const __grid_constant__ Group_layout tree,
                        const __grid_constant__ Verlet_lists<Real> lists, bool compare, Real* guard,
                        unsigned* ticket)
{
  const int warp = threadIdx.x / 32, lane = threadIdx.x % 32;
  const int place = blockIdx.x * gather_threads + threadIdx.x;
  const bool exists = place < tree.items;
  Packed_site<Real> site{};
  if (exists) {
    const int id = order[place];
    const Site<Real> taken = arrays.sites[id];
    site = {taken.point, taken.weight};
    sites[place] = site;
    if (positions) {
      guard[place] = 0;
      normals[place] = {arrays.normals[id], arrays.patches ? arrays.patches[id] : 0};
      density_root[place] = arrays.density_root ? arrays.density_root[id] : Real(1);
    }
  }

  Group_node<Real> node{site.point, site.weight, site.point, 0};
  Real growth = 0;
  if (exists) {
    if (compare)
      growth = fmax(site.weight - lists.weights[place], Real(0));
    else
      lists.weights[place] = site.weight;
  }
  growth = warp_max(growth);
  node = join_lanes(node, exists);
  __shared__ Group_node<Real> of_warps[32];
  __shared__ Real growths[32];
  if (lane == 0) {
    of_warps[warp] = node;
    growths[warp] = growth;
    if (place < tree.items) {
      nodes[place / 32] = node;
      lists.growth[place / 32] = growth;
    }
  }
  __syncthreads();
  if (warp == 0) {
    growth = warp_max(growths[lane]);
    if (lane == 0 && growth > 0) atomic_max_nonnegative(lists.all_growth, growth);
    if (tree.levels > 1) {
      node = join_lanes(of_warps[lane], true); // warps without sites are empty boxes
      if (lane == 0) nodes[tree.first[1] + blockIdx.x] = node;
    }
  }
  if (tree.levels <= 2) return;

  if (!is_last_block(ticket)) return;
  make_upper_nodes(nodes, tree, warp, lane);
  if (threadIdx.x == 0) *ticket = 0;
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_SORT_SITES_CUH
