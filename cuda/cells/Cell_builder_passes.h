// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The member functions of `Cell_builder` for the passes of the paper's rule over the weights.
#ifndef CGAL_POWER_RTF_CUDA_CELL_BUILDER_PASSES_H
#define CGAL_POWER_RTF_CUDA_CELL_BUILDER_PASSES_H

#include "cell_builder.h"
#include "warp_weight_passes.cuh"

#include <algorithm>

namespace CGAL::PowerRTF::device {

inline int blocks(int n, int threads) { return (n + threads - 1) / threads; }

template <class Real>
Weight_pass_state* Cell_builder<Real>::pass_state()
{
  if (m_pass_state.size() == 0) {
    m_pass_state.allocate(m_backend, 1);
    m_backend.fill(m_pass_state.data(), Weight_pass_state(), 1);
  }
  return m_pass_state.data();
}

template <class Real>
bool Cell_builder<Real>::start_weight_passes(const Weight_pass_input<Real>& in)
{
  using Counters = Pass_counters<Real>;
  const int processors = m_backend.multiprocessors(), warps = blocks(m_sites, processors);
  if (m_cells == 0 || warps > max_pass_warps<Real> || m_sites > 32 * Counters::max_groups)
    return false;
  const auto kernel = warp_weight_passes_kernel<Real>;
  const int bytes = warps * int(sizeof(Warp_cell_memory<Real>));
  int device = 0, max_bytes = 0;
  check(cudaGetDevice(&device), "weight passes");
  check(cudaDeviceGetAttribute(&max_bytes, cudaDevAttrMaxSharedMemoryPerBlockOptin, device),
        "weight passes");
  if (bytes + int(sizeof(typename Pass_exchange<Real>::Memory)) > max_bytes) return false;
  check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, bytes),
        "weight passes");
  gather_new_weights();
  Weight_pass_state* const state = pass_state();
  m_pass_records.allocate(m_backend, 2 * std::size_t(m_sites));
  m_partials.allocate(m_backend, 2 * std::size_t(processors));
  m_pass_counters.allocate(m_backend, 1);

  Warp_pass_arguments<Real> a;
  a.view = view();
  a.targets.radius = m_radius.data();
  a.targets.guard = m_guard.data();
  a.targets.out = in.out;
  a.links = {m_links.next.data(), m_links.previous.data()};
  a.in = in;
  a.records = m_pass_records.data();
  a.masses = m_partials.data();
  a.counters = m_pass_counters.data();
  a.state = state;
  check(cudaMemsetAsync(a.counters, 0, sizeof(Counters), m_backend.stream()), "weight passes");
  void* parameters[] = {&a};
  check(cudaLaunchCooperativeKernel(reinterpret_cast<void*>(kernel), processors, 32 * warps,
                                    parameters, bytes, m_backend.stream()),
        "weight passes");
  m_arrays = in.arrays;
  ++m_stamps.weights;
  return true;
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_CELL_BUILDER_PASSES_H
