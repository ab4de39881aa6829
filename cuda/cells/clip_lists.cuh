// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The construction from lists, one thread per cell. Most cells still have the edges of the last
// construction: their corners are made one after another. The others of a block are collected, so
// that whole warps clip them; those that their lists do not give are left to `open_groups_kernel`.
#ifndef CGAL_POWER_RTF_CUDA_CLIP_LISTS_CUH
#define CGAL_POWER_RTF_CUDA_CLIP_LISTS_CUH

#include "group_cells.cuh"

namespace CGAL::PowerRTF::device {

template <class Real, bool WithMoments>
constexpr int clip_blocks = sizeof(Real) == 8 ? 4
                            : WithMoments     ? 6
                                              : 8; // of a multiprocessor

/// Whether a cell of squared radius `radius2` is complete. `growth`: the most that weights near it
/// have grown.
template <bool HaveGrown, class Real>
__device__ inline bool is_proved(const Verlet_lists<Real>& lists, const Lane_cell<Real>& cell,
                                 Real radius2, Real growth)
{
  const Real radius = quick_sqrt(radius2), list_radius = lists.radius[cell.place];
  constexpr Real none = 0;
  if (!HaveGrown)
    return list_suffices(radius, list_radius, list_radius, list_radius, none, none, none);
  return list_suffices(radius, list_radius, lists.outside[cell.place],
                       lists.group_radius[cell.place / 32],
                       cell.site.weight - lists.weights[cell.place], growth, *lists.all_growth);
}

/// Writes a proved cell with the last edges. Returns false when it must be cut at chords.
template <class Real>
__device__ inline bool
write_chain(const Group_view<Real>& view, const Cell_targets<Real>& targets,
            const Verlet_lists<Real>& lists, int place, const Ring_polygon<Real, 32>& polygon,
            const Tangent_frame<Real>& frame, const Chain_result<Real>& chain)
{
  const Cell_outputs<Real>& out = targets.out;
  const int id = view.caller[place];
  const Listed_polygon<Real> listed(polygon, lists.neighbors + place, lists.stride);
  if (view.has_features && touches_fixed(view, listed)) return false;
  targets.radius[id] = quick_sqrt(chain.radius2);
  write_moments(out, id, chain.moments, frame);
  if (out.status) out.status[id] = static_cast<unsigned char>(Cell_status::ok);
  if (out.edge_count) write_edges(view, out, place, id, listed, frame);
  if (targets.polygons.size) write_polygon(view, targets.polygons, id, listed);
  return true;
}

/// Makes a cell from its whole list. Returns false when that does not give it.
template <bool HaveGrown, class Real>
__device__ inline bool clip_whole_list(const Group_view<Real>& view,
                                       const Cell_targets<Real>& targets,
                                       const Verlet_lists<Real>& lists, int place, Real growth,
                                       Ring_polygon<Real, 32>& polygon)
{
  Lane_cell<Real> cell;
  cell.place = place;
  cell.site = load(view.sites + place);
  const Tangent_frame<Real> frame(load(view.normals + place).normal);
  if (!clip_entries(view, lists, cell, frame, lists.radius[place], lists.sizes[place], polygon) ||
      !is_proved<HaveGrown>(lists, cell, polygon.squared_radius(), growth) ||
      !write_listed(view, targets, place, view.caller[place], polygon, lists.neighbors + place,
                    lists.stride, frame, quick_sqrt(polygon.squared_radius())))
    return false;
  reorder_list(lists, place, polygon);
  return true;
}

/// `HaveGrown`: the weights may differ from those that the lists were made for. `WithMoments`: more
/// than areas is wanted.
template <class Real, bool HaveGrown, bool WithMoments>
__global__ void __launch_bounds__(32 * group_warps<Real>, clip_blocks<Real, WithMoments>)
    clip_lists_kernel(const __grid_constant__ Group_view<Real> view,
                      const __grid_constant__ Cell_targets<Real> targets,
                      const __grid_constant__ Verlet_lists<Real> lists, Open_groups open)
{
  constexpr int warps = group_warps<Real>;
  __shared__ Ring_memory<Real, 32> polygons[warps];
  __shared__ int others[32 * warps];
  __shared__ int others_count;
  __shared__ unsigned open_lanes[warps];
  __shared__ Real growths[warps];
  const int lane = threadIdx.x % 32, warp = threadIdx.x / 32;
  const int begin = blockIdx.x * blockDim.x, place = begin + threadIdx.x;
  if (threadIdx.x == 0) others_count = 0;
  if (lane == 0) open_lanes[warp] = 0;
  __syncthreads();
  Ring_polygon<Real, 32> polygon(polygons[warp], lane);

  const auto leave = [&](int p) {
    atomicOr(open_lanes + (p - begin) / 32, 1u << (p - begin) % 32);
  };

  const bool has_cell = place < view.tree.items && view.caller[place] < view.cells;
  const int sizes = has_cell ? lists.sizes[place] : Verlet_lists<Real>::none;
  const bool has_list = sizes != Verlet_lists<Real>::none;
  Lane_cell<Real> own;
  own.place = place;
  Chain_result<Real> chain;
  bool is_chain = false;
  Tangent_frame<Real> frame({0, 0, 1});
  if (has_list) {
    own.site = load(view.sites + place);
    frame = Tangent_frame<Real>(load(view.normals + place).normal);
    is_chain = clip_chain<WithMoments>(view, lists, own, frame, sizes, polygon, chain);
  }
  // Usually a bound for all weights will do.
  bool is_done = is_chain && is_proved<HaveGrown>(lists, own, chain.radius2,
                                                  HaveGrown ? *lists.all_growth : Real(0));
  if (HaveGrown && __any_sync(full_warp, has_list && !is_done)) {
    const Real growth = near_growth(lists, place / 32, lane);
    if (lane == 0) growths[warp] = growth;
    is_done = is_done || (is_chain && is_proved<HaveGrown>(lists, own, chain.radius2, growth));
  }
  if (has_list && !is_done)
    others[atomicAdd(&others_count, 1)] = place;
  else if (has_cell &&
           !(is_done && write_chain(view, targets, lists, place, polygon, frame, chain)))
    leave(place);
  __syncthreads();
  for (int k = threadIdx.x; k < others_count; k += blockDim.x) {
    const Real growth = HaveGrown ? growths[(others[k] - begin) / 32] : Real(0);
    if (!clip_whole_list<HaveGrown>(view, targets, lists, others[k], growth, polygon))
      leave(others[k]);
  }
  __syncthreads();
  if (lane == 0 && open_lanes[warp] != 0) {
    const int k = atomicAdd(open.count, 1);
    open.groups[k] = begin / 32 + warp;
    open.lanes[k] = open_lanes[warp];
  }
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_CLIP_LISTS_CUH
