// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the warps of the weight passes in one kernel exchange: totals with a barrier for the grid.
#ifndef CGAL_POWER_RTF_CUDA_PASS_EXCHANGE_CUH
#define CGAL_POWER_RTF_CUDA_PASS_EXCHANGE_CUH

#include "Weight_pass_state.h"
#include "cell_outputs.cuh"
#include "warp_outputs.cuh"
#include "warp_reductions.cuh"

namespace CGAL::PowerRTF::device {

/// Of a block, at most: 3000 sites find a warp each on 132 multiprocessors, with 80 registers.
template <class Real>
constexpr int max_pass_warps = sizeof(Real) == 4 ? 24 : 12;

template <class Real>
struct Warp_pass_arguments {
  Group_view<Real> view; ///< with the weights to begin with
  Cell_targets<Real> targets;
  Feature_links links;
  Weight_pass_input<Real> in;           ///< the caller's order
  Pass_record<Real>* records = nullptr; ///< 2 for each place, used in turn
  double* masses = nullptr;             ///< sums of the cells' masses, 2 for each block
  Pass_counters<Real>* counters = nullptr;
  Weight_pass_state* state = nullptr;
};

/// The parts of the kernel that all warps do together.
template <class Real>
class Pass_exchange {
  using Counters = Pass_counters<Real>;

public:
  struct Memory {
    Pass_totals of_warps[max_pass_warps<Real>];
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
      const double mass = warp_sum(part.mass), max_mass = warp_max_nonnegative(part.max_mass);
      const double min_mass = warp_min_nonnegative(part.min_mass),
                   growth = warp_max_nonnegative(part.growth);
      Counters& counters = *m.counters;
      const int turn = pass % Counters::turns;
      double* const of_blocks = m.masses + pass % 2 * gridDim.x;
      if (m_lane == 0) {
        of_blocks[blockIdx.x] = mass;
        atomicMax(counters.max_mass + turn, bits_of(max_mass));
        atomicMax(counters.not_min_mass + turn, ~bits_of(min_mass));
        atomicMax(counters.all_growth + turn, bits_of(growth));
        arrive(&counters.arrivals);
        const unsigned expected = (pass + 1) * gridDim.x;
        while (*static_cast<volatile unsigned*>(&counters.arrivals) < expected) {
        }
        __threadfence(); // one for the block: it empties the L1 cache of put-away registers, too
      }
      __syncwarp();
      Pass_totals all;
      all.max_mass = number_of(__ldcg(counters.max_mass + turn));
      all.min_mass = number_of(~__ldcg(counters.not_min_mass + turn));
      all.growth = number_of(__ldcg(counters.all_growth + turn));
      constexpr int at_once = 5; // their loads wait together
      for (int first = m_lane; first < int(gridDim.x); first += 32 * at_once) {
        double masses[at_once];
#pragma unroll
        for (int k = 0; k < at_once; ++k)
          masses[k] = first + 32 * k < int(gridDim.x) ? __ldcg(of_blocks + first + 32 * k) : 0;
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
      m.counters->max_mass[turn] = m.counters->not_min_mass[turn] = m.counters->all_growth[turn] =
          0;
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
  {
    asm volatile("red.release.gpu.global.add.u32 [%0], 1;" ::"l"(arrivals) : "memory");
  }

  using Bits = unsigned long long; // numbers that are not negative, in the same order

  __device__ static Bits bits_of(double x) { return Bits(__double_as_longlong(x)); }
  __device__ static double number_of(Bits x)
  {
    return __longlong_as_double(static_cast<long long>(x));
  }

  const Warp_pass_arguments<Real>& m;
  Memory& m_memory;
  int m_warp, m_lane;
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_PASS_EXCHANGE_CUH
