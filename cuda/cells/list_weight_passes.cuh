// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 2, lines 3 to 10: the passes of the paper's rule over the weights in one cooperative
// kernel, where there are more sites than warps. Cells without a kept list (guarded, empty, at
// features) are made by warps of their own, which keep the sites that may cut them in memory; the
// others come from their lists at the same time, a lane each. A pass has two barriers: before the
// mean mass, and before the new weights.
#ifndef CGAL_POWER_RTF_CUDA_LIST_WEIGHT_PASSES_CUH
#define CGAL_POWER_RTF_CUDA_LIST_WEIGHT_PASSES_CUH

#include "Weight_pass_state.h"
#include "group_cells.cuh"
#include "second_pass.cuh"

#include <CGAL/PowerRTF/optimization/multiplicative_weights.h>

#include <cooperative_groups.h>

namespace CGAL {
namespace PowerRTF {
namespace device {

template <class Real>
struct List_pass_arguments {
  Group_view<Real> view;       ///< the tree: for the weights that the lists were made for
  Kept_lists<Real> lists;
  Cell_targets<Real> targets;  ///< out.area: of the current weights, if lists are; rest: scratch
  Feature_links links;
  Packed_site<Real>* sites = nullptr; ///< those of `view`, to be written
  Site<Real>* caller_sites = nullptr;
  const Real *density = nullptr, *first = nullptr, *sixth = nullptr; ///< the caller's order
  Multiplicative_weight_rule rule{};
  int passes = 0;
  double* partials = nullptr; ///< one per block
  List_pass_state* state = nullptr;
};

/// Sum over the block's threads, the same on all; in a fixed order.
__device__ inline double block_sum(double x)
{
  __shared__ double of_warps[32];
#pragma unroll
  for (int step = 16; step > 0; step /= 2) x += __shfl_xor_sync(full_warp, x, step);
  __syncthreads();
  if (threadIdx.x % 32 == 0) of_warps[threadIdx.x / 32] = x;
  __syncthreads();
  double sum = 0;
  for (int w = 0; w < int(blockDim.x) / 32; ++w) sum += of_warps[w];
  return sum;
}

/// Sum of x over all threads of the grid, the same on all; in a fixed order.
__device__ inline double grid_sum(const cooperative_groups::grid_group& grid, double* partials,
                                  double x)
{
  x = block_sum(x);
  if (threadIdx.x == 0) partials[blockIdx.x] = x;
  grid.sync();
  double sum = 0;
  for (int b = threadIdx.x; b < int(gridDim.x); b += blockDim.x) sum += __ldcg(partials + b);
  return block_sum(sum);
}

/// Sums in integers: the same in any order.
class Mass_sum {
public:
  /// `unit`: about a cell's mass.
  __device__ explicit Mass_sum(double unit) : m_scale(unit > 0 ? parts / unit : 0) {}
  __device__ void clear() { m_sum = 0; }
  __device__ void add(double mass) { m_sum += __double2ll_rn(fmin(mass * m_scale, 1e18)); }
  /// Adds those of a block to the sum of all.
  __device__ void leave(unsigned long long* total, int lane)
  {
    __shared__ long long of_warps[32];
#pragma unroll
    for (int step = 16; step > 0; step /= 2) m_sum += __shfl_xor_sync(full_warp, m_sum, step);
    __syncthreads();
    if (lane == 0) of_warps[threadIdx.x / 32] = m_sum;
    __syncthreads();
    if (threadIdx.x != 0) return;
    for (int w = 1; w < int(blockDim.x) / 32; ++w) m_sum += of_warps[w];
    if (m_sum != 0) atomicAdd(total, static_cast<unsigned long long>(m_sum));
  }
  __device__ double mass(unsigned long long total) const
  { return m_scale > 0 ? double(total) / m_scale : 0; }

private:
  static constexpr double parts = 1 << 28;
  double m_scale;
  long long m_sum = 0;
};

template <class Real>
union List_pass_memory {
  Ring_memory<Real, 32> polygons;
  Warp_cell_memory<Real> special;
  __device__ List_pass_memory() {}
};

/// The rounds of the kernel below, as a warp sees them.
template <class Real>
class List_weight_passes {
public:
  __device__ List_weight_passes(const List_pass_arguments<Real>& a, List_pass_memory<Real>& memory)
      : m(a), m_memory(memory), m_lane(threadIdx.x % 32),
        m_warp(threadIdx.x / 32 * gridDim.x + blockIdx.x), m_warps(gridDim.x * blockDim.x / 32),
        m_groups(a.view.tree.nodes(0))
  {}

  /// Notes the special cells.
  __device__ void begin()
  {
    for (int group = m_warp; group < m_groups; group += m_warps) {
      const Own_cell cell = cell_of(group);
      const bool is_special =
          cell.id >= 0 && (m.targets.radius[cell.id] < 0 ||
                           m.lists.sizes[cell.place] == Kept_lists<Real>::none);
      if (is_special) m.lists.sizes[cell.place] = Kept_lists<Real>::none;
      note(is_special, cell.place);
    }
  }

  /// The mass of the warp's groups.
  __device__ double mass() const
  {
    double sum = 0;
    for (int group = m_warp; group < m_groups; group += m_warps) {
      const Own_cell cell = cell_of(group);
      if (cell.id >= 0) sum += double(cell.density) * __ldcg(m.targets.out.area + cell.id);
    }
    return sum;
  }

  /// The cells of the current weights that have a list. Those that it does not prove are special
  /// from now on.
  __device__ void make_listed(Mass_sum& mass)
  {
    for (int group = m_warp; group < m_groups; group += m_warps) {
      const bool failed = !make_by_list(group, mass);
      const int place = group * 32 + m_lane;
      if (failed) m.lists.sizes[place] = Kept_lists<Real>::none;
      note(failed, place);
    }
  }

  /// The special cells [begin, end) of the current weights.
  __device__ void make_special(int begin, int end, Mass_sum& mass)
  {
    int k = m_warp - m_groups % m_warps; // the warps without groups go first
    if (k < 0) k += m_warps;
    for (k += (begin - k + m_warps - 1) / m_warps * m_warps; k < end; k += m_warps)
      if (k >= begin) make_special(__ldcg(m.targets.rest + k), mass);
  }

  /// The next weights. Returns whether a mass is outside the interval.
  __device__ bool change_weights(const Multiplicative_weight_rule& rule)
  {
    bool is_outside = false;
    Real most = 0;
    for (int group = m_warp; group < m_groups; group += m_warps) {
      const Own_cell own = cell_of(group);
      Real growth = 0;
      if (own.id >= 0) {
        const double mass = double(own.density) * __ldcg(m.targets.out.area + own.id);
        is_outside |= fabs(mass / rule.mean_mass - 1) > rule.tolerance;
        const Real weight = m.sites[own.place].weight +
                            Real(rule(mass, mass > 0 ? own.first : own.sixth));
        m.sites[own.place].weight = weight;
        growth = fmax(weight - own.list_weight, Real(0));
      }
      growth = warp_max(growth);
      if (m_lane == 0) m.lists.growth[group] = growth;
      most = fmax(most, growth);
    }
    if (m_lane == 0 && most > 0) atomic_raise(m.lists.all_growth, most);
    return __any_sync(full_warp, is_outside);
  }

  /// Calls f(place, id) for the cells of this warp.
  template <class F>
  __device__ void for_each_cell(F&& f) const
  {
    for (int group = m_warp; group < m_groups; group += m_warps) {
      const Own_cell own = cell_of(group);
      if (own.id >= 0) f(own.place, own.id);
    }
  }

private:
  /// What does not change.
  struct Own_cell {
    int place, id; // id < 0: no cell
    Real density, first, sixth, list_weight;
  };

  __device__ Own_cell cell_of(int group) const
  {
    Own_cell cell{group * 32 + m_lane, -1, 0, 0, 0, 0};
    if (cell.place >= m.view.tree.items || m.view.caller[cell.place] >= m.view.cells) return cell;
    cell.id = m.view.caller[cell.place];
    cell.density = m.density[cell.id];
    cell.first = m.first[cell.id];
    cell.sixth = m.sixth[cell.id];
    cell.list_weight = m.lists.weights[cell.place];
    return cell;
  }

  /// The lane's cell of the group. Returns false when its list does not prove it.
  __device__ bool make_by_list(int group, Mass_sum& mass)
  {
    m_kept.place = -1; // the memory is used for others
    const Real near = near_growth(m.lists, group, m_lane);
    const Own_cell own = cell_of(group);
    bool is_made = true;
    if (own.id >= 0 && m.lists.sizes[own.place] != Kept_lists<Real>::none) {
      Lane_cell<Real> cell;
      cell.place = own.place;
      cell.site = load(m.view.sites + own.place);
      const Tangent_frame<Real> frame(load(m.view.normals + own.place).normal);
      Ring_polygon<Real, 32> polygon(m_memory.polygons, m_lane);
      is_made = make_kept(m.view, m.lists, cell, frame, near, polygon);
      if (is_made) {
        const Real area = cell_area(Listed_polygon<Real>(polygon, nullptr, 0));
        m.targets.out.area[own.id] = area;
        mass.add(double(own.density) * area);
      }
    }
    __syncwarp();
    return is_made;
  }

  /// Appends the places of the lanes with `is_special`.
  __device__ void note(bool is_special, int place)
  {
    const unsigned lanes = __ballot_sync(full_warp, is_special);
    if (lanes == 0) return;
    int begin = 0;
    if (m_lane == 0) begin = atomicAdd(&m.state->specials, __popc(lanes));
    begin = __shfl_sync(full_warp, begin, 0);
    if (is_special) m.targets.rest[begin + __popc(lanes & ((1u << m_lane) - 1))] = place;
  }

  __device__ void make_special(int place, Mass_sum& mass)
  {
    const int id = m.view.caller[place];
    Warp_cell_memory<Real>& memory = m_memory.special;
    Warp_cell<Real> cell(m.view, memory, place, m_lane);
    const Kept_weights<Real> weights(m.lists, m.view.sites, place);
    Real guard = m.targets.guard[place];
    Cell_status status = Cell_status::incomplete;
    const bool is_kept = m_kept.place == place;
    if (!is_kept || !cell.renew(weights, m_kept, guard, status)) {
      Real last = is_kept ? cell.radius_to_begin(m_kept, status, guard) : m.targets.radius[id];
      if (last == 0) last = guess_of_radius(m.view, place, m_lane);
      status = cell.construct(weights, last, guard, guess_of_sixth(m.view, last), m_kept);
    }
    const Real radius = status == Cell_status::ok ? cell.radius() : -guard;
    Real area = cell.polygon().area(m_lane);
    if (m.view.has_features) {
      Tangent_polygon<Real>& polygon = cell_in_memory(cell, memory, m_lane);
      if (m_lane == 0) {
        cut_at_features(m.view, m.links, cell.frame(), place, polygon);
        area = cell_area(polygon);
      }
    }
    if (m_lane == 0) {
      m.targets.guard[place] = guard;
      if (radius != 0) m.targets.radius[id] = radius;
      m.targets.out.area[id] = area;
      mass.add(double(m.density[id]) * area);
    }
    __syncwarp();
  }

  const List_pass_arguments<Real>& m;
  List_pass_memory<Real>& m_memory;
  int m_lane, m_warp, m_warps, m_groups;
  Kept_sites<Real> m_kept;
};

template <class Real>
constexpr int list_pass_warps = sizeof(Real) == 4 ? 8 : 4; // of a block: 48 KB of shared memory

template <class Real>
__global__ void __launch_bounds__(32 * list_pass_warps<Real>, 2)
list_weight_passes_kernel(const __grid_constant__ List_pass_arguments<Real> a)
{
  const cooperative_groups::grid_group grid = cooperative_groups::this_grid();
  __shared__ List_pass_memory<Real> memories[list_pass_warps<Real>];
  List_weight_passes<Real> cells(a, memories[threadIdx.x / 32]);
  const int lane = threadIdx.x % 32;

  cells.begin();
  grid.sync();
  int specials = __ldcg(&a.state->specials);
  const int usual = specials;
  Mass_sum mass(0);
  Multiplicative_weight_rule rule = a.rule;
  for (int pass = 0;; ++pass) {
    if (pass > 0) {
      mass.clear();
      cells.make_listed(mass);
#pragma unroll 1
      for (int begin = 0;;) {
        cells.make_special(begin, specials, mass);
        mass.leave(&a.state->mass[pass], lane);
        grid.sync();
        const int now = __ldcg(&a.state->specials);
        if (now == specials) break;
        begin = specials; // those that the lists did not prove, shared by all warps
        specials = now;
        mass.clear();
      }
    }
    if (pass == 0) {
      rule.mean_mass = grid_sum(grid, a.partials, cells.mass()) / a.view.cells;
      mass = Mass_sum(rule.mean_mass);
    } else {
      rule.mean_mass = mass.mass(__ldcg(&a.state->mass[pass])) / a.view.cells;
    }
    if (cells.change_weights(rule) && lane == 0) a.state->outside[pass] = 1;
    grid.sync();
    const bool equal = __ldcg(a.state->outside + pass) == 0;
    // Where many cells are not proved by their lists, new lists are better.
    const bool is_slow = specials > usual + a.view.cells / 8;
    if (equal || pass + 1 == a.passes || is_slow) {
      if (grid.thread_rank() == 0) {
        a.state->done = pass + !equal;
        a.state->equal = equal;
      }
      break;
    }
  }

  double mean = 0;
  if (a.view.cells == a.view.tree.items) { // else the weights are relative to those of the features
    double sum = 0;
    cells.for_each_cell([&](int place, int) { sum += a.sites[place].weight; });
    mean = grid_sum(grid, a.partials, sum) / a.view.cells;
  }
  cells.for_each_cell(
      [&](int place, int id) { a.caller_sites[id].weight = Real(a.sites[place].weight - mean); });
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_LIST_WEIGHT_PASSES_CUH
