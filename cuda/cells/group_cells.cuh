// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 1 for 32 cells at a time: the warp gathers the sites that may cut any cell of its
// group, then every lane clips, in rounds of growing radii. A cell is finished here only when it is
// proved to be complete and within the guard radius; all others are deferred.
//
// What it is worth, on an H200, preset quality: with warps for all cells that no list proves,
// kitten takes 22.9 instead of 17.3 ms for 20 000 samples and 24.2 instead of 20.2 ms for 30 000.
#ifndef CGAL_POWER_RTF_CUDA_GROUP_CELLS_CUH
#define CGAL_POWER_RTF_CUDA_GROUP_CELLS_CUH

#include "Verlet_lists.h"
#include "cell_outputs.cuh"
#include "warp_search.cuh"

namespace CGAL::PowerRTF::device {

/// Whether the cell lies within a few radii of that of lane `from`.
template <class Real>
__device__ inline bool is_near_lane(const Lane_cell<Real>& cell, int from)
{
  constexpr Real reach = 16;
  const Vec3<Real> other{__shfl_sync(full_warp, cell.site.point.x, from),
                         __shfl_sync(full_warp, cell.site.point.y, from),
                         __shfl_sync(full_warp, cell.site.point.z, from)};
  const Real radius = __shfl_sync(full_warp, cell.radius, from);
  return squared_length(cell.site.point - other) <= reach * reach * radius * radius;
}

/// The query for the cells of the lanes with `wants`, at least one.
template <class Real>
__device__ inline Group_query<Real> query_of_lanes(const Lane_cell<Real>& cell, bool wants,
                                                   Real radius)
{
  constexpr Real infinity = Real(1e30);
  const Vec3<Real> p = cell.site.point;
  Group_query<Real> query;
  query.lo = {warp_min(wants ? p.x : infinity), warp_min(wants ? p.y : infinity),
              warp_min(wants ? p.z : infinity)};
  query.hi = {warp_max(wants ? p.x : -infinity), warp_max(wants ? p.y : -infinity),
              warp_max(wants ? p.z : -infinity)};
  query.radius = radius;
  query.min_weight = warp_min(wants ? cell.site.weight : infinity);
  return query;
}

/// Gathers the sites that may cut the cells of the lanes with `wants` and lists them for each; the
/// lanes of a cell share the work and list in columns of their own.
template <int LanesPerCell, class Real>
__device__ inline void gather(const Group_view<Real>& view, Warp_memory<Real>& memory,
                              Lane_cell<Real>& cell, bool wants, int lane)
{
  const Group_query<Real> query =
      query_of_lanes(cell, wants, warp_max(wants ? cell.radius : Real(0)));
  const unsigned below_lane = (1u << lane) - 1;
  int gathered = 0;
  const auto list = [&]() {
    if (wants)
      cell.list(memory, gathered, view.guard_factor, lane, lane % LanesPerCell, LanesPerCell);
  };
  const auto add = [&](bool reached, const Packed_site<Real>& site, int place) {
    const unsigned lanes = __ballot_sync(full_warp, reached);
    if (gathered + __popc(lanes) > Warp_memory<Real>::max_candidates) {
      __syncwarp();
      list();
      gathered = 0;
      __syncwarp();
    }
    if (reached) {
      const int k = gathered + __popc(lanes & below_lane);
      memory.candidates.sites[k] = site;
      memory.candidates.places[k] = place;
    }
    gathered += __popc(lanes);
  };
  search_sites(view, memory.stack, query, lane, add);
  list();
  __syncwarp();
}

/// Brings the lists of a cell's lanes into the first one's column. That one's counts are then those
/// of all.
template <int LanesPerCell, class Real>
__device__ inline void join_lists(Warp_memory<Real>& memory, Lane_cell<Real>& cell, int lane)
{
  const int number = lane % LanesPerCell, first = lane - number;
  int before = 0, all = 0, near = 0;
#pragma unroll
  for (int k = 0; k < LanesPerCell; ++k) {
    const int of_lane = __shfl_sync(full_warp, cell.listed, first + k);
    if (k < number) before += of_lane;
    all += of_lane;
    near += __shfl_sync(full_warp, cell.near, first + k);
  }
  if (all <= Warp_memory<Real>::max_listed && number > 0)
    for (int k = 0; k < cell.listed; ++k)
      memory.listed[(before + k) * 32 + first] = memory.listed[k * 32 + lane];
  cell.listed = all;
  cell.near = near;
  __syncwarp();
}

/// A guess of a cell's radius where none is known: the second distance to sites of the same group
/// and to those before and after it on the curve.
template <int LanesPerCell, class Real>
__device__ inline Real guess_radius(const Group_view<Real>& view, const Lane_cell<Real>& cell,
                                    bool exists, int lane)
{
  Real d[2] = {Real(1e30), Real(1e30)};
  const auto offer = [&](const Vec3<Real>& p) {
    const Real d2 = squared_length(p - cell.site.point);
    d[1] = fmin(d[1], fmax(d[0], d2));
    d[0] = fmin(d[0], d2);
  };
  for (int step = 1; step < 32; ++step) {
    const int from = (lane + step) % 32;
    const Vec3<Real> other{__shfl_sync(full_warp, cell.site.point.x, from),
                           __shfl_sync(full_warp, cell.site.point.y, from),
                           __shfl_sync(full_warp, cell.site.point.z, from)};
    if (__shfl_sync(full_warp, int(exists), from) && from / LanesPerCell != lane / LanesPerCell)
      offer(other);
  }
  const int begin = cell.place - lane / LanesPerCell, end = begin + 32 / LanesPerCell;
  for (int k = 1; k <= 2; ++k) {
    if (begin - k >= 0) offer(view.sites[begin - k].point);
    if (end + k <= view.tree.items) offer(view.sites[end + k - 1].point);
  }
  for (int k = 1; k >= 0; --k)
    if (d[k] > 0 && d[k] < Real(1e30)) return std::sqrt(d[k]);
  return 1;
}

/// Writes a proved cell. Returns false when it must be cut at chords: it is deferred.
template <class Real>
__device__ inline bool write_listed(const Group_view<Real>& view, const Cell_targets<Real>& targets,
                                    int place, int id, const Ring_polygon<Real, 32>& polygon,
                                    const int* column, int stride, const Tangent_frame<Real>& frame,
                                    Real radius)
{
  const Listed_polygon<Real> listed(polygon, column, stride);
  if (view.has_features && touches_fixed(view, listed)) return false;
  targets.radius[id] = radius;
  write_cell(view, targets.out, place, id, Cell_status::ok, listed, frame);
  if (targets.polygons.size) write_polygon(view, targets.polygons, id, listed);
  return true;
}

template <class Real>
constexpr int group_warps = sizeof(Real) == 4 ? 4 : 2; // of a block: 48 KB of shared memory

/// The most that a weight has grown in the groups near this one.
template <class Real>
__device__ inline Real near_growth(const Verlet_lists<Real>& lists, int group, int lane)
{
  const int size = lists.group_sizes[group];
  if (size < 0) return *lists.all_growth;
  Real growth = 0;
  if (lane < size)
    growth = lists.growth[lists.groups[group * Verlet_lists<Real>::max_groups + lane]];
  return warp_max(growth);
}

/// Leaves the cells of the lanes with `deferred` to whole warps.
template <class Real>
__device__ inline void defer_cells(const Cell_targets<Real>& targets, const Lane_cell<Real>& cell,
                                   int id, bool deferred, int lane)
{
  const unsigned lanes = __ballot_sync(full_warp, deferred);
  if (lanes == 0) return;
  int begin = 0;
  if (lane == 0) begin = atomicAdd(targets.deferred_count, __popc(lanes));
  begin = __shfl_sync(full_warp, begin, 0);
  if (!deferred) return;
  targets.deferred[begin + __popc(lanes & ((1u << lane) - 1))] = cell.place;
  targets.radius[id] = std::fabs(cell.radius);
}

/// Makes the cells of the lanes with `open`, whose sites follow each other; what is not proved
/// is deferred. The first search is for `growth` times the last radius. Several lanes per
/// cell, where there are few cells, share the search and make lists for one of them.
template <int LanesPerCell, class Real>
__device__ inline void make_group(const Group_view<Real>& view, const Cell_targets<Real>& targets,
                                  Warp_memory<Real>& memory, int place, bool open, Real growth,
                                  int lane)
{
  // What a cell that was not complete, or for which too many sites were found, gets next.
  constexpr Real further_growth = Real(1.6), shrinkage = Real(0.7);
  constexpr Real largest_guess = 4; // of a radius, in the geometric mean of the group's
  constexpr int rounds = 4;
  const bool exists = place < view.tree.items;
  Lane_cell<Real> cell;
  cell.place = exists ? place : view.tree.items - 1;
  cell.site = load(view.sites + cell.place);
  const int id = view.caller[cell.place];
  const bool has_cell = exists && open && id < view.cells && lane % LanesPerCell == 0;
  const Packed_normal<Real> own = load(view.normals + cell.place);
  const Tangent_frame<Real> frame(own.normal);

  const Real last_radius = exists && id < view.cells ? targets.radius[id] : Real(-1);
  cell.radius = last_radius * growth;
  if (__any_sync(full_warp, last_radius == 0)) {
    const Real guess = guess_radius<LanesPerCell>(view, cell, exists, lane);
    // Alone beyond a jump of the curve, a site would look for others nearly everywhere.
    const Real most = largest_guess * std::exp(warp_sum(std::log(guess)) / 32);
    if (last_radius == 0) cell.radius = fmin(guess, most);
  }

  open = has_cell && last_radius >= 0; // below 0: the last one was deferred
  bool deferred = has_cell && !open;
  Ring_polygon<Real, 32> polygon(memory.polygons, lane);
  const int* const column = memory.listed + lane;
  for (int round = 0; round < rounds && __any_sync(full_warp, open); ++round) {
    bool is_cell = false, hopeless = false;
    cell.clear();
    // Along the curve there are jumps, of any length: the lanes near the first one go first.
    bool waits = __shfl_sync(full_warp, open, lane - lane % LanesPerCell);
    for (unsigned lanes; (lanes = __ballot_sync(full_warp, waits)) != 0;) {
      const bool is_near = is_near_lane(cell, __ffs(int(lanes)) - 1);
      gather<LanesPerCell>(view, memory, cell, waits && is_near, lane);
      waits = waits && !is_near;
    }
    if (LanesPerCell > 1) join_lists<LanesPerCell>(memory, cell, lane);
    // Within the guard radius: R <= guard_factor times the distance of the 6th neighbor.
    if (open && clip_listed(view, cell, own, frame, column, polygon, hopeless)) {
      is_cell = cell.near <= 6 && view.guard_factor >= 1;
      hopeless = !is_cell;
    }
    if (is_cell) {
      open = false;
      deferred = !write_listed(view, targets, cell.place, id, polygon, column, 32, frame,
                               std::sqrt(polygon.squared_radius()));
    } else if (open) {
      deferred = hopeless || round + 1 == rounds;
      open = !deferred;
      const bool too_many = cell.listed > Warp_memory<Real>::max_listed;
      if (open) cell.radius *= too_many ? shrinkage : further_growth;
    }
    if (LanesPerCell > 1)
      cell.radius = __shfl_sync(full_warp, cell.radius, lane - lane % LanesPerCell);
    __syncwarp();
  }
  defer_cells(targets, cell, id, deferred, lane);
}

/// All cells; one warp per 32 / `LanesPerCell` sites.
template <class Real, int LanesPerCell>
__global__ void __launch_bounds__(32 * group_warps<Real>)
    group_cells_kernel(const __grid_constant__ Group_view<Real> view,
                       const __grid_constant__ Cell_targets<Real> targets)
{
  __shared__ Warp_memory<Real> memories[group_warps<Real>];
  const int lane = threadIdx.x % 32;
  const int place = (blockIdx.x * blockDim.x + threadIdx.x) / LanesPerCell;
  if (place - lane / LanesPerCell >= view.tree.items) return;
  constexpr Real growth = Real(1.15); // what changes between two constructions
  make_group<LanesPerCell>(view, targets, memories[threadIdx.x / 32], place, true, growth, lane);
}

/// Groups of 32 sites with cells that their lists do not give.
struct Open_groups {
  int* groups = nullptr;
  unsigned* lanes = nullptr;                   ///< bit k: the cell of site k of the group
  int *count = nullptr, *next_count = nullptr; ///< the latter: of the next construction
};

/// The cells that are open; one warp per group.
template <class Real>
__global__ void __launch_bounds__(32 * group_warps<Real>)
    open_groups_kernel(const __grid_constant__ Group_view<Real> view,
                       const __grid_constant__ Cell_targets<Real> targets, Open_groups open)
{
  __shared__ Warp_memory<Real> memories[group_warps<Real>];
  if (blockIdx.x == 0 && threadIdx.x == 0) *open.next_count = 0;
  const int lane = threadIdx.x % 32, count = *open.count;
  const int warps = gridDim.x * blockDim.x / 32;
  constexpr Real growth = Real(1.6); // the lists' radii did not do
  for (int k = (blockIdx.x * blockDim.x + threadIdx.x) / 32; k < count; k += warps) {
    make_group<1>(view, targets, memories[threadIdx.x / 32], open.groups[k] * 32 + lane,
                  open.lanes[k] >> lane & 1, growth, lane);
    __syncwarp();
  }
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_GROUP_CELLS_CUH
