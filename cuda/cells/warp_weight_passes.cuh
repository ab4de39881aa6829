// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 2, lines 3 to 10, where each site finds a warp: the passes of the paper's rule over the
// weights in one cooperative kernel. A warp keeps its cell and the sites that may cut it.
//
// A pass has one barrier, after the cells. A warp publishes the mass of its cell; every warp that
// keeps the site computes its next weight itself, as all find the same mean mass. The certificate
// of a cell needs the growth of the weights near it (see Verlet_lists.h) before the barrier: an
// upper bound of it, valid for mean masses up to a limit, as the rule's change increases with the
// mean. When the mean exceeds the limit, no cell is certified.
//
// What it is worth, on an H200: a whole run of the paper's preset takes 9 to 25 ms with this
// kernel, 31 to 101 ms without it (kitten, fertility; --preset paper -n 3000 --traits cuda).
#ifndef CGAL_POWER_RTF_CUDA_WARP_WEIGHT_PASSES_CUH
#define CGAL_POWER_RTF_CUDA_WARP_WEIGHT_PASSES_CUH

#include "Pass_exchange.cuh"
#include "warp_cells.cuh"

namespace CGAL::PowerRTF::device {

/// Of the mean mass from pass to pass; see above.
constexpr double max_increase = 1.1;

/// Loads what other multiprocessors may have written during the kernel.
template <class T>
__device__ inline T load_from_all(const T* p)
{
  return load_words(p, [](const int4* word) { return __ldcg(word); });
}

/// The weights of a pass. The sites were gathered for the initial weights.
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
  {
    return records ? current(record(place)) : site.weight;
  }
  __device__ Real growth_of(int group) const { return __ldcg(growth + group) + unknown_growth; }
  __device__ Real reach_for(Real radius) const { return reach_after_growth(radius, all_growth); }

  __device__ static Real next_weight(const Pass_record<Real>& r,
                                     const Multiplicative_weight_rule& rule)
  {
    return r.weight + Real(rule(r.mass, r.distance));
  }
};

/// A bound of the rule's change of a weight for mean masses up to `max_mean`.
template <class Real>
__device__ inline Real max_change(const Pass_record<Real>& r,
                                  const Multiplicative_weight_rule& rule, double max_mean)
{
  const Real d2 = r.distance * r.distance, rounding = 1 + 64 * internal::epsilon<Real>();
  if (!(r.mass > 0)) return Real(0.2) * d2 * rounding;
  const Real lack = 1 - quick_quotient(Real(r.mass), Real(fmin(max_mean, 1e30)));
  return lack > 0 ? Real(rule.step) * (lack + 64 * internal::epsilon<Real>()) * d2 / 2 * rounding
                  : Real(0);
}

/// Result of `remake_cell()`, in registers.
template <class Real>
struct Remade_cell {
  Kept_sites<Real> kept;
  Real guard;
  Cell_status status;
  Warp_polygon<Real> polygon;
};

/// `Warp_cell::construct()`, not inlined: its registers would count for all passes.
template <class Real>
__device__ __noinline__ void
remake_cell(const Group_view<Real>& view, Warp_cell_memory<Real>& memory, int place, Real radius,
            const Pass_weights<Real>& weights, int lane, Remade_cell<Real>& result)
{
  Warp_cell<Real> cell(view, memory, place, lane);
  result.status =
      cell.construct(weights, radius, result.guard, guess_of_sixth(view, radius), result.kept);
  result.polygon = cell.polygon();
}

/// A warp's site in all passes: its cell, the sites that the warp keeps for it, and its weight.
template <class Real>
class Resident_cell {
public:
  __device__ Resident_cell(const Warp_pass_arguments<Real>& a, Warp_cell_memory<Real>& memory,
                           int place, int lane)
      : m(a), m_memory(memory), m_place(place), m_lane(lane), m_is_site(place < a.view.tree.items),
        m_id(m_is_site ? a.view.caller[place] : -1), m_is_cell(m_is_site && m_id < a.view.cells),
        m_cell(a.view, memory, m_is_site ? place : 0, lane),
        m_weight_before(m_cell.site().weight), m_record{m_weight_before, 0, 0}
  {
    if (!m_is_cell) return;
    m_density = a.in.density[m_id];
    m_last = a.targets.radius[m_id];
    if (m_last == 0) m_last = guess_of_radius(a.view, place, lane);
    // Both distances that nearly all need, in one search: that of the rule, and the guard's.
    const Neighbor_distances<Real> found =
        neighbor_distances(a.view, memory.stack, place, guess_of_sixth(a.view, m_last),
                           {a.view.cos_angle, Real(-2)}, 6, lane);
    m_guard = a.view.guard_factor * found.sixth;
    m_distance = found.first;
  }

  /// Makes the cell of the current weights and publishes its record. `max_mean`: what the growth of
  /// weights is bounded for; `all_growth`: that of all weights so far, `unknown_growth` with it.
  __device__ Pass_totals make(int pass, const Multiplicative_weight_rule& rule, double max_mean,
                              Real all_growth, Real unknown_growth)
  {
    Pass_totals own;
    if (m_is_cell) {
      const Real own_growth = m_record.weight - m_weight_before;
      construct({pass > 0 ? m.records + (pass - 1) % 2 * m.view.tree.items : nullptr, rule,
                 m.counters->growth[(pass + turns - 1) % turns], m_weight_before, m_record.weight,
                 own_growth, fmax(all_growth - own_growth, Real(0)), unknown_growth});
      m_record.mass = double(m_density) * area();
      m_record.distance = m_record.mass > 0 ? m_distance : distance_of_empty();
      const Real growth = own_growth + max_change(m_record, rule, max_mean);
      own.mass = m_record.mass;
      own.max_mass = own.min_mass = fmax(m_record.mass, 0.0); // rounding may make it negative
      own.growth = fmax(growth, Real(0));
      if (m_lane == 0 && growth > 0)
        atomic_max_nonnegative(&m.counters->growth[pass % turns][m_place / 32], growth);
    }
    if (m_is_site && m_lane == 0) m.records[pass % 2 * m.view.tree.items + m_place] = m_record;
    return own;
  }

  __device__ void change_weight(const Multiplicative_weight_rule& rule)
  {
    if (m_is_cell) m_record.weight = Pass_weights<Real>::next_weight(m_record, rule);
  }

  /// Writes the cell, and its weight less the `mean` one.
  __device__ void write(double mean)
  {
    if (!m_is_cell) return;
    // Large cells begin by the sites within the guard square the next time, too.
    const Real now = m_cell.radius();
    const bool is_plain = m_status == Cell_status::ok && (m_kept.is_plain || 3 * now < m_guard);
    const Real radius = is_plain ? now : -m_guard;
    if (m_lane == 0) {
      m.in.sites[m_id].weight = Real(m_record.weight - mean);
      m.targets.guard[m_place] = m_guard;
      if (radius != 0) m.targets.radius[m_id] = radius;
    }
    // Made here so that its frame occupies no registers before.
    Warp_cell<Real> cell(m.view, m_memory, m_place, m_lane);
    cell.set_polygon(m_cell.polygon());
    write_warp_cell(m.view, m.targets, m.links, m_memory, cell, m_place, m_id, m_status, m_lane);
  }

private:
  static constexpr int turns = Pass_counters<Real>::turns;

  /// By the sites that are kept, or anew.
  __device__ void construct(const Pass_weights<Real>& weights)
  {
    const bool has_kept = m_kept.place == m_place;
    if (has_kept && m_cell.renew(weights, m_kept, m_guard, m_status)) return;
    if (has_kept) m_last = m_cell.radius_to_begin(m_kept, m_status, m_guard);
    const Pass_weights<Real> copy = weights; // so that `weights` itself can stay in registers
    Remade_cell<Real> made;
    made.guard = m_guard;
    remake_cell(m.view, m_memory, m_place, m_last, copy, m_lane, made);
    m_guard = made.guard;
    m_kept = made.kept;
    m_status = made.status;
    m_cell.set_polygon(made.polygon);
    m_last = m_status == Cell_status::ok ? m_cell.radius() : -m_guard;
  }

  /// Of the cell's part on its patch.
  __device__ Real area()
  {
    const Real area = m_cell.polygon().area(m_lane);
    if (!m.view.has_features) return area;
    Tangent_polygon<Real>& polygon = cell_in_memory(m_cell, m_memory, m_lane);
    Real part = 0;
    if (m_lane == 0) {
      const Tangent_frame<Real> frame(load(m.view.normals + m_place).normal);
      cut_at_features(m.view, m.links, frame, m_place, polygon);
      part = cell_area(polygon);
    }
    return __shfl_sync(full_warp, part, 0);
  }

  /// What the rule takes where the cell is empty: the distance of the sixth site.
  __device__ Real distance_of_empty()
  {
    if (m_sixth < 0)
      m_sixth = neighbor_distances(m.view, m_memory.stack, m_place, 2 * m_distance,
                                   {m.view.cos_angle, m.view.cos_angle}, 6, m_lane)
                    .sixth;
    return m_sixth;
  }

  const Warp_pass_arguments<Real>& m;
  Warp_cell_memory<Real>& m_memory;
  int m_place, m_lane;
  bool m_is_site;
  int m_id;
  bool m_is_cell;
  Warp_cell<Real> m_cell;
  Real m_weight_before;
  Pass_record<Real> m_record;
  Real m_density = 0, m_last = 0;
  Cell_status m_status = Cell_status::incomplete;
  Kept_sites<Real> m_kept;
  Real m_guard = 0, m_distance = 0, m_sixth = -1; // the latter: not known
};

/// One block on each multiprocessor; dynamic memory: a `Warp_cell_memory` for each warp.
template <class Real>
__global__ void __launch_bounds__(32 * max_pass_warps<Real>, 1)
    warp_weight_passes_kernel(const __grid_constant__ Warp_pass_arguments<Real> a)
{
  extern __shared__ __align__(16) unsigned char dynamic_memory[];
  __shared__ typename Pass_exchange<Real>::Memory exchange_memory;
  const int warp = threadIdx.x / 32;
  Warp_cell_memory<Real>& memory = reinterpret_cast<Warp_cell_memory<Real>*>(dynamic_memory)[warp];
  Pass_exchange<Real> exchange(a, exchange_memory);
  // Neighbors lie in different blocks, so that cells that need more time do.
  Resident_cell<Real> cell(a, memory, warp * gridDim.x + blockIdx.x, threadIdx.x % 32);

  Multiplicative_weight_rule rule = a.in.rule;
  double max_mean = max_increase * a.state->mean_mass; // of the last call: this serves as well
  if (!(max_mean > 0)) max_mean = 1e300;
  Real all_growth = 0, unknown_growth = 0;
  int pass = 0;
  for (;; ++pass) {
    const Pass_totals own = cell.make(pass, rule, max_mean, all_growth, unknown_growth);
    exchange.clear_next(pass);
    const Pass_totals all = exchange.totals(pass, own);
    const double mean = all.mass / a.view.cells;
    const bool is_growth_known = mean <= max_mean;
    rule.mean_mass = mean;
    max_mean = max_increase * mean;
    const bool equal = mean > 0 && all.max_mass <= (1 + rule.tolerance) * mean &&
                       all.min_mass >= (1 - rule.tolerance) * mean;
    if (equal || pass == a.in.passes) {
      if (blockIdx.x == 0 && threadIdx.x == 0) *a.state = {pass, equal, mean};
      break;
    }
    unknown_growth = is_growth_known ? Real(0) : Real(1e30);
    all_growth = Real(all.growth) + unknown_growth;
    cell.change_weight(rule);
  }
  // Without features the weights are relative to nothing.
  cell.write(a.view.cells == a.view.tree.items ? exchange.mean_weight(pass) : 0);
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WARP_WEIGHT_PASSES_CUH
