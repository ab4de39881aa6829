// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 2, lines 3 to 10, where each site finds a warp: the passes of the paper's rule over the
// weights in one cooperative kernel. A warp keeps its cell and the sites that may cut it.
//
// A pass has one barrier, after the cells: a warp tells the mass of its cell, and each warp that
// keeps the site finds its next weight by itself, as all find the same mean mass. What certifies a
// cell, how much the weights near it have grown (see Kept_lists.h), must be told before the
// barrier: a bound of the growth, for a mean mass up to a limit (the rule's change increases with
// it); where the mean has passed the limit, nothing is certified.
#ifndef CGAL_POWER_RTF_CUDA_WARP_WEIGHT_PASSES_CUH
#define CGAL_POWER_RTF_CUDA_WARP_WEIGHT_PASSES_CUH

#include "Weight_pass_state.h"
#include "second_pass.cuh"

#include <CGAL/PowerRTF/optimization/multiplicative_weights.h>

namespace CGAL {
namespace PowerRTF {
namespace device {

/// Of a block, at most: 3000 sites find a warp each on 132 multiprocessors, with 80 registers.
template <class Real>
constexpr int most_pass_warps = sizeof(Real) == 4 ? 24 : 12;

/// Of the mean mass from pass to pass; see above.
constexpr double most_increase = 1.1;

template <class Real>
struct Warp_pass_arguments {
  Group_view<Real> view; ///< with the weights to begin with
  Cell_targets<Real> targets;
  Feature_links links;
  Site<Real>* caller_sites = nullptr;
  const Real *density = nullptr, *first = nullptr, *sixth = nullptr; ///< the caller's order
  Multiplicative_weight_rule rule{};
  int passes = 0;
  Pass_record<Real>* records = nullptr; ///< 2 for each place, used in turn
  double* masses = nullptr;             ///< sums of the cells' masses, 2 for each block
  Pass_counters<Real>* counters = nullptr;
  Weight_pass_state* state = nullptr;
};

/// What other multiprocessors have written during the kernel.
template <class T>
__device__ inline T load_from_all(const T* p)
{
  return load_words(p, [](const int4* word) { return __ldcg(word); });
}

/// The weights of a pass: what the sites were gathered for are those to begin with.
template <class Real>
struct Pass_weights {
  static constexpr bool keeps = true;
  static constexpr Real plain_part = 2, guard_part = Real(1.15), whole_part = Real(1.1);
  const Pass_record<Real>* records; ///< null: the weights have not changed
  Multiplicative_weight_rule rule;
  const Real* growth;
  Real own_weight, own_now, own_growth, all_growth, unknown_growth;

  __device__ Real listed(const Packed_site<Real>& site, int) const { return site.weight; }
  using Record = Pass_record<Real>;
  __device__ Record record(int place) const { return load_from_all(records + place); }
  __device__ Real current(const Record& r) const { return next_weight(r, rule); }
  __device__ Real current(const Packed_site<Real>& site, int place) const
  { return records ? current(record(place)) : site.weight; }
  __device__ Real growth_of(int group) const { return __ldcg(growth + group) + unknown_growth; }
  __device__ Real reach_for(Real radius) const { return reach_after_growth(radius, all_growth); }

  __device__ static Real next_weight(const Pass_record<Real>& r,
                                     const Multiplicative_weight_rule& rule)
  { return r.weight + Real(rule(r.mass, r.distance)); }
};

/// A bound of the rule's change of a weight for mean masses up to `most_mean`.
template <class Real>
__device__ inline Real most_change(const Pass_record<Real>& r,
                                   const Multiplicative_weight_rule& rule, double most_mean)
{
  const Real d2 = r.distance * r.distance, rounding = 1 + 64 * internal::epsilon<Real>();
  if (!(r.mass > 0)) return Real(0.2) * d2 * rounding;
  const Real lack = 1 - quick_quotient(Real(r.mass), Real(fmin(most_mean, 1e30)));
  return lack > 0 ? Real(rule.step) * (lack + 64 * internal::epsilon<Real>()) * d2 / 2 * rounding
                  : Real(0);
}

/// What a cell that is made anew leaves in registers.
template <class Real>
struct Remade_cell {
  Kept_sites<Real> kept;
  Real guard;
  Cell_status status;
  Warp_polygon<Real> polygon;
};

/// `Warp_cell::construct()`: a call of its own, as its registers would be those of all passes.
template <class Real>
__device__ __noinline__ void remake_cell(const Group_view<Real>& view,
                                         Warp_cell_memory<Real>& memory, int place, Real radius,
                                         const Pass_weights<Real>& weights, int lane,
                                         Remade_cell<Real>& result)
{
  Warp_cell<Real> cell(view, memory, place, lane);
  result.status = cell.construct(weights, radius, result.guard, guess_of_sixth(view, radius),
                                 result.kept);
  result.polygon = cell.polygon();
}

/// The parts of the kernel that all warps do together.
template <class Real>
class Pass_exchange {
  using Counters = Pass_counters<Real>;

public:
  struct Memory {
    Pass_totals of_warps[most_pass_warps<Real>];
    Pass_totals of_all;
  };

  __device__ Pass_exchange(const Warp_pass_arguments<Real>& a, Memory& memory)
      : m(a), m_memory(memory), m_warp(threadIdx.x / 32), m_lane(threadIdx.x % 32)
  {}

  /// Hands in the warp's part; returns that of all warps when all have come. Sums in a fixed order.
  __device__ Pass_totals totals(int pass, const Pass_totals& own)
  {
    if (m_lane == 0) m_memory.of_warps[m_warp] = own;
    __syncthreads();
    if (m_warp == 0) {
      const bool is_warp = m_lane < int(blockDim.x) / 32;
      const Pass_totals part = is_warp ? m_memory.of_warps[m_lane] : Pass_totals();
      const double mass = warp_sum(part.mass), most = warp_greatest(part.most);
      const double least = warp_least(part.least), growth = warp_greatest(part.growth);
      Counters& counters = *m.counters;
      const int turn = pass % Counters::turns;
      double* const of_blocks = m.masses + pass % 2 * gridDim.x;
      if (m_lane == 0) {
        of_blocks[blockIdx.x] = mass;
        atomicMax(counters.most + turn, bits_of(most));
        atomicMax(counters.not_least + turn, ~bits_of(least));
        atomicMax(counters.all_growth + turn, bits_of(growth));
        arrive(&counters.arrivals);
        const unsigned expected = (pass + 1) * gridDim.x;
        while (*static_cast<volatile unsigned*>(&counters.arrivals) < expected) {}
        __threadfence(); // one for the block: it empties the L1 cache of put-away registers, too
      }
      __syncwarp();
      Pass_totals all;
      all.most = number_of(__ldcg(counters.most + turn));
      all.least = number_of(~__ldcg(counters.not_least + turn));
      all.growth = number_of(__ldcg(counters.all_growth + turn));
      constexpr int at_once = 5; // their loads wait together
      for (int first = m_lane; first < int(gridDim.x); first += 32 * at_once) {
        double masses[at_once];
#pragma unroll
        for (int k = 0; k < at_once; ++k)
          masses[k] =
              first + 32 * k < int(gridDim.x) ? __ldcg(of_blocks + first + 32 * k) : 0;
#pragma unroll
        for (int k = 0; k < at_once; ++k) all.mass += masses[k];
      }
      all.mass = warp_sum(all.mass);
      if (m_lane == 0) m_memory.of_all = all;
    }
    __syncthreads();
    return m_memory.of_all;
  }

  /// Clears the counters of the pass after `pass`: all have done with those of the one before it.
  __device__ void clear_next(int pass)
  {
    if (blockIdx.x != 0) return;
    const int turn = (pass + 1) % Counters::turns;
    for (int k = threadIdx.x; k < m.view.tree.nodes(0); k += blockDim.x)
      m.counters->growth[turn][k] = 0;
    if (threadIdx.x == 0)
      m.counters->most[turn] = m.counters->not_least[turn] = m.counters->all_growth[turn] = 0;
  }

  /// The mean weight of the last cells; all blocks find the same.
  __device__ double mean_weight(int pass)
  {
    const Pass_record<Real>* const records = m.records + pass % 2 * m.view.tree.items;
    double sum = 0;
    for (int k = threadIdx.x; k < m.view.tree.items; k += blockDim.x)
      sum += __ldcg(&records[k].weight);
    sum = warp_sum(sum);
    if (m_lane == 0) m_memory.of_warps[m_warp].mass = sum;
    __syncthreads();
    sum = 0;
    for (int w = 0; w < int(blockDim.x) / 32; ++w) sum += m_memory.of_warps[w].mass;
    return sum / m.view.tree.items;
  }

private:
  /// All that the block has written is seen by those who see this and fence after it.
  __device__ static void arrive(unsigned* arrivals)
  { asm volatile("red.release.gpu.global.add.u32 [%0], 1;" ::"l"(arrivals) : "memory"); }

  using Bits = unsigned long long; // numbers that are not negative, in the same order

  __device__ static Bits bits_of(double x) { return Bits(__double_as_longlong(x)); }
  __device__ static double number_of(Bits x)
  { return __longlong_as_double(static_cast<long long>(x)); }

  const Warp_pass_arguments<Real>& m;
  Memory& m_memory;
  int m_warp, m_lane;
};

/// One block on each multiprocessor; dynamic memory: a `Warp_cell_memory` for each warp.
template <class Real>
__global__ void __launch_bounds__(32 * most_pass_warps<Real>, 1)
warp_weight_passes_kernel(const __grid_constant__ Warp_pass_arguments<Real> a)
{
  extern __shared__ __align__(16) unsigned char dynamic_memory[];
  __shared__ typename Pass_exchange<Real>::Memory exchange_memory;
  const int warp = threadIdx.x / 32, lane = threadIdx.x % 32;
  Warp_cell_memory<Real>& memory =
      reinterpret_cast<Warp_cell_memory<Real>*>(dynamic_memory)[warp];
  Pass_exchange<Real> exchange(a, exchange_memory);

  // Neighbours lie in different blocks, so that cells that need more time do.
  const Group_view<Real>& view = a.view;
  const int place = warp * gridDim.x + blockIdx.x, items = view.tree.items;
  const bool is_site = place < items;
  const int id = is_site ? view.caller[place] : -1;
  const bool is_cell = is_site && id < view.cells;
  Warp_cell<Real> cell(view, memory, is_site ? place : 0, lane);
  const Real weight_before = cell.site().weight;
  Real density = 0, last = 0;
  Cell_status status = Cell_status::incomplete;
  Kept_sites<Real> kept;
  Real guard = 0;
  Real distance = 0, sixth = -1; // the latter: not known
  if (is_cell) {
    density = a.density[id];
    last = a.targets.radius[id];
    if (last == 0) last = guess_of_radius(view, place, lane);
    // Both distances that nearly all need, in one search: that of the rule, and the guard's.
    const Neighbor_distances<Real> found =
        neighbor_distances(view, memory.stack, place, guess_of_sixth(view, last),
                           {view.cos_angle, Real(-2)}, 6, lane);
    guard = view.guard_factor * found.sixth;
    distance = a.first ? a.first[id] : found.first;
  }

  Pass_record<Real> record{weight_before, 0, 0};
  Multiplicative_weight_rule rule = a.rule;
  double most_mean = most_increase * a.state->mean_mass; // of the last call: this serves as well
  if (!(most_mean > 0)) most_mean = 1e300;
  Real all_growth = 0, unknown_growth = 0;
  int pass = 0;
  for (;; ++pass) {
    Pass_counters<Real>& counters = *a.counters;
    constexpr int turns = Pass_counters<Real>::turns;
    Pass_totals own;
    if (is_cell) {
      const Real own_growth = record.weight - weight_before;
      const Pass_weights<Real> weights{
          pass > 0 ? a.records + (pass - 1) % 2 * items : nullptr,
          rule,
          counters.growth[(pass + turns - 1) % turns],
          weight_before,
          record.weight,
          own_growth,
          fmax(all_growth - own_growth, Real(0)),
          unknown_growth};
      if (kept.place != place || !cell.renew(weights, kept, guard, status)) {
        if (kept.place == place) last = cell.radius_to_begin(kept, status, guard);
        const Pass_weights<Real> copy = weights; // the address of another is known to the call
        Remade_cell<Real> made;
        made.guard = guard;
        remake_cell(view, memory, place, last, copy, lane, made);
        guard = made.guard;
        kept = made.kept;
        status = made.status;
        cell.set_polygon(made.polygon);
        last = status == Cell_status::ok ? cell.radius() : -guard;
      }
      Real area = cell.polygon().area(lane);
      if (view.has_features) {
        Tangent_polygon<Real>& polygon = cell_in_memory(cell, memory, lane);
        if (lane == 0) {
          cut_at_features(view, a.links, Tangent_frame<Real>(load(view.normals + place).normal),
                          place, polygon);
          area = cell_area(polygon);
        }
        area = __shfl_sync(full_warp, area, 0);
      }
      record.mass = double(density) * area;
      record.distance = distance;
      if (!(record.mass > 0)) {
        if (sixth < 0)
          sixth = a.sixth ? a.sixth[id]
                          : neighbor_distances(view, memory.stack, place, 2 * distance,
                                               {view.cos_angle, view.cos_angle}, 6, lane)
                                .sixth;
        record.distance = sixth;
      }
      const Real growth = own_growth + most_change(record, rule, most_mean);
      own.mass = record.mass;
      own.most = own.least = fmax(record.mass, 0.0); // rounding may make it negative
      own.growth = fmax(growth, Real(0));
      if (lane == 0 && growth > 0) atomic_raise(&counters.growth[pass % turns][place / 32], growth);
    }
    if (is_site && lane == 0) a.records[pass % 2 * items + place] = record;
    exchange.clear_next(pass);
    const Pass_totals all = exchange.totals(pass, own);
    const double mean = all.mass / view.cells;
    const bool is_growth_known = mean <= most_mean;
    rule.mean_mass = mean;
    most_mean = most_increase * mean;
    const bool equal = mean > 0 && all.most <= (1 + rule.tolerance) * mean &&
                       all.least >= (1 - rule.tolerance) * mean;
    if (equal || pass == a.passes) {
      if (blockIdx.x == 0 && threadIdx.x == 0) *a.state = {pass, equal, mean};
      break;
    }
    unknown_growth = is_growth_known ? Real(0) : Real(1e30);
    all_growth = Real(all.growth) + unknown_growth;
    if (is_cell) record.weight = Pass_weights<Real>::next_weight(record, rule);
  }

  // Without features the weights are relative to nothing.
  const double mean = view.cells == items ? exchange.mean_weight(pass) : 0;
  if (!is_cell) return;
  // Large cells begin by the sites within the guard square the next time, too.
  const Real now = cell.radius();
  const bool is_plain = status == Cell_status::ok && (kept.is_plain || 3 * now < guard);
  const Real radius = is_plain ? now : -guard;
  if (lane == 0) {
    a.caller_sites[id].weight = Real(record.weight - mean);
    a.targets.guard[place] = guard;
    if (radius != 0) a.targets.radius[id] = radius;
  }
  Warp_cell<Real> made_cell(view, memory, place, lane); // so that its frame is no burden before
  made_cell.set_polygon(cell.polygon());
  write_warp_cell(view, a.targets, a.links, memory, made_cell, place, id, status, lane);
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_WARP_WEIGHT_PASSES_CUH
