// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The member functions of `Cell_builder` for the passes of the paper's rule over the weights.
#ifndef CGAL_POWER_RTF_CUDA_CELL_BUILDER_PASSES_H
#define CGAL_POWER_RTF_CUDA_CELL_BUILDER_PASSES_H

#include "cell_builder.h"
#include "large_weight_passes.cuh"
#include "list_weight_passes.cuh"
#include "warp_weight_passes.cuh"

#include <algorithm>

namespace CGAL {
namespace PowerRTF {
namespace device {

// Calls of set_weights(): the lists grow too short.
constexpr unsigned list_every = 10;
static_assert(list_every <= Large_pass_state::most_passes, "one look per making of the lists");
// From here on the steps of the paper's passes are kernels of their own.
constexpr int large_sites = 65536;
inline int blocks(int n, int threads) { return (n + threads - 1) / threads; }

template <class Real>
bool Cell_builder<Real>::start_weight_passes(const Sites_arrays<Real>& arrays, Site<Real>* sites,
                                             const Real* density, const Real* first,
                                             const Real* sixth,
                                             const Multiplicative_weight_rule& rule, int passes,
                                             const Cell_outputs<Real>& out)
{
  using Counters = Pass_counters<Real>;
  const int processors = m_backend.multiprocessors(), warps = blocks(m_sites, processors);
  if (m_cells == 0 || warps > most_pass_warps<Real> || m_sites > 32 * Counters::most_groups)
    return false;
  const auto kernel = warp_weight_passes_kernel<Real>;
  const int bytes = warps * int(sizeof(Warp_cell_memory<Real>));
  int device = 0, most_bytes = 0;
  check(cudaGetDevice(&device), "weight passes");
  check(cudaDeviceGetAttribute(&most_bytes, cudaDevAttrMaxSharedMemoryPerBlockOptin, device),
        "weight passes");
  if (bytes + int(sizeof(typename Pass_exchange<Real>::Memory)) > most_bytes) return false;
  check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, bytes),
        "weight passes");
  if (m_are_weights_old) set_weights(m_arrays);
  const std::size_t before = m_backend.bytes();
  m_pass_records.allocate(m_backend, 2 * std::size_t(m_sites));
  m_partials.allocate(m_backend, 2 * std::size_t(processors));
  m_pass_counters.allocate(m_backend, 1);
  if (m_pass_state.size() == 0) {
    m_pass_state.allocate(m_backend, 1);
    m_backend.fill(m_pass_state.data(), Weight_pass_state(), 1);
  }
  m_bytes += m_backend.bytes() - before;

  Warp_pass_arguments<Real> a;
  a.view = view();
  a.targets.radius = m_radius.data();
  a.targets.guard = m_guard.data();
  a.targets.out = out;
  a.links = {m_next.data(), m_previous.data()};
  a.caller_sites = sites;
  a.density = density;
  a.first = first;
  a.sixth = sixth;
  a.rule = rule;
  a.passes = passes;
  a.records = m_pass_records.data();
  a.masses = m_partials.data();
  a.counters = m_pass_counters.data();
  a.state = m_pass_state.data();
  check(cudaMemsetAsync(a.counters, 0, sizeof(Counters), m_backend.stream()), "weight passes");
  void* parameters[] = {&a};
  check(cudaLaunchCooperativeKernel(reinterpret_cast<void*>(kernel), processors, 32 * warps,
                                    parameters, bytes, m_backend.stream()),
        "weight passes");
  m_arrays = arrays;
  m_are_weights_old = true;
  return true;
}

template <class Real>
int Cell_builder<Real>::paper_weight_passes(const Sites_arrays<Real>& arrays, Site<Real>* sites,
                                            const Real* density, const Real* first,
                                            const Real* sixth,
                                            const Multiplicative_weight_rule& rule, int passes,
                                            const Cell_outputs<Real>& out)
{
  if (m_cells == 0) return 0;
  if (m_sites > large_sites)
    return large_weight_passes(arrays, sites, density, first, sixth, rule, passes, out);
  if (!start_weight_passes(arrays, sites, density, first, sixth, rule, passes, out))
    return list_weight_passes(arrays, sites, density, first, sixth, rule, passes, out);
  Weight_pass_state state;
  m_backend.download(&state, m_pass_state.data(), 1);
  return state.done;
}

template <class Real>
int Cell_builder<Real>::list_weight_passes(const Sites_arrays<Real>& arrays, Site<Real>* sites,
                                           const Real* density, const Real* first,
                                           const Real* sixth,
                                           const Multiplicative_weight_rule& rule, int passes,
                                           const Cell_outputs<Real>& out)
{
  constexpr int warps = list_pass_warps<Real>, threads = 32 * warps;
  const auto kernel = list_weight_passes_kernel<Real>;
  const std::size_t before = m_backend.bytes();
  m_area.allocate(m_backend, m_cells);
  m_list_state.allocate(m_backend, 1);
  // A warp for each group, and others for the cells without lists.
  const int processors = m_backend.multiprocessors(), groups = blocks(m_sites, 32);
  int resident = 0;
  check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&resident, kernel, threads, 0),
        "weight passes");
  const int wanted = blocks(groups + groups / 8 + 32, warps * processors);
  const int grid = processors * std::min(wanted, resident);
  m_partials.allocate(m_backend, grid);
  m_bytes += m_backend.bytes() - before;

  List_pass_arguments<Real> a;
  a.sites = m_packed.data();
  a.caller_sites = sites;
  a.density = density;
  a.first = first;
  a.sixth = sixth;
  a.rule = rule;
  a.partials = m_partials.data();
  a.state = m_list_state.data();
  int done = 0;
  for (bool again = true; again;) {
    m_list_use = List_use::make;
    m_are_lists_current = false;
    take(arrays, false);
    a.targets = Cell_targets<Real>();
    a.targets.out.area = m_area.data();
    construct(a.targets, true); // the masses to begin with, and the lists
    List_pass_state state;
    m_backend.fill(m_list_state.data(), state, 1);
    a.view = view();
    a.lists = lists();
    a.targets.radius = m_radius.data();
    a.targets.guard = m_guard.data();
    a.targets.rest = m_rest.data();
    a.links = {m_next.data(), m_previous.data()};
    a.passes = std::min(passes - done, int(List_pass_state::most_passes));
    void* parameters[] = {&a};
    check(cudaLaunchCooperativeKernel(reinterpret_cast<void*>(kernel), grid, threads, parameters, 0,
                                      m_backend.stream()),
          "weight passes");
    // Before a look at the state: nearly always these are the last weights.
    m_list_use = List_use::read;
    take(arrays, false);
    build(out);
    m_backend.download(&state, m_list_state.data(), 1);
    done += state.done;
    again = !state.equal && done < passes && state.done > 0;
  }
  return done;
}

template <class Real>
int Cell_builder<Real>::large_weight_passes(const Sites_arrays<Real>& arrays, Site<Real>* sites,
                                            const Real* density, const Real* first,
                                            const Real* sixth,
                                            const Multiplicative_weight_rule& rule, int passes,
                                            const Cell_outputs<Real>& out)
{
  const int sum_blocks = 8 * m_backend.multiprocessors();
  const std::size_t before = m_backend.bytes();
  m_area.allocate(m_backend, m_cells);
  m_partials.allocate(m_backend, sum_blocks);
  m_large_state.allocate(m_backend, 1);
  m_bytes += m_backend.bytes() - before;

  const cudaStream_t stream = m_backend.stream();
  Large_pass_state* const device_state = m_large_state.data();
  const Pass_masses<Real> masses{density, m_area.data(), first, sixth, rule};
  Cell_outputs<Real> areas;
  areas.area = m_area.data();
  const auto use_lists = [&](List_use use) {
    m_list_use = use;
    m_are_lists_current = use == List_use::read;
  };
  use_lists(List_use::make);
  take(arrays, false);
  build(areas);
  int done = 0;
  bool renew = false; // the lists
  for (bool equal = false; !equal && done < passes;) {
    Large_pass_state state;
    m_backend.fill(device_state, state, 1);
    const int batch = std::min<int>(list_every, passes - done);
    for (int pass = 0; pass < batch; ++pass) {
      mean_mass_kernel<<<sum_blocks, sum_threads, 0, stream>>>(
          m_cells, density, m_area.data(), m_partials.data(), m_tickets.data() + 1, device_state);
      use_lists(renew && pass == 0 ? List_use::make : List_use::read);
      m_backend.fill(m_all_growth.data(), Real(0), 1);
      const int change_grid = blocks(m_sites, change_threads * changes_per_thread);
      change_weights_kernel<<<change_grid, change_threads, 0, stream>>>(
          masses, m_cells, m_order.data(), m_packed.data(), m_nodes.data(), Group_layout(m_sites),
          lists(), m_list_use == List_use::read, device_state, pass,
          m_open_counts.data() + (m_list_constructions - 1) % 2);
      raise_weights_kernel<<<1, 1024, 0, stream>>>(m_nodes.data(), Group_layout(m_sites));
      check(cudaGetLastError(), "weight passes");
      build(areas);
    }
    m_backend.download(&state, device_state, 1);
    int changes = 0; // a pass that finds all masses inside changes nothing, nor do those after it
    while (changes < batch && state.outside[changes]) ++changes;
    equal = changes < batch;
    renew = state.open > blocks(m_sites, 32) / 16;
    done += changes;
  }

  const bool subtract = m_cells == m_sites; // else they are relative to those of the features
  if (subtract)
    mean_weight_kernel<<<sum_blocks, sum_threads, 0, stream>>>(
        m_sites, m_packed.data(), m_partials.data(), m_tickets.data() + 1, device_state);
  give_weights_kernel<<<blocks(m_sites, 256), 256, 0, stream>>>(
      m_sites, m_cells, m_order.data(), m_packed.data(), device_state, subtract, sites);
  check(cudaGetLastError(), "weight passes");
  use_lists(List_use::read);
  take(arrays, false);
  build(out);
  return done;
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_CELL_BUILDER_PASSES_H
