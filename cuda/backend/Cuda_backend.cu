// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Cuda_backend.h"

#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_select.cuh>
#include <thrust/iterator/counting_iterator.h>

#include <algorithm>
#include <string>

namespace CGAL::PowerRTF::device {

Cuda_backend::Cuda_backend(int device)
    : m_context(Device_context::of(device)), m_stream(m_context), m_pinned(*this, pinned_bytes)
{
  m_partials.allocate(*this, std::size_t(reduction_blocks) * max_totals);
  m_ticket.allocate(*this, 1);
  fill(m_ticket.data(), 0u, 1);
  start_clock();
  stop_clock();
  synchronize(); // a kernel that this device cannot run says so here
}

void* Cuda_backend::take(std::size_t bytes)
{
  void* const block = m_context.memory().take(bytes);
  if (!block)
    throw Cuda_error("the memory of the GPU does not suffice: " + gibibytes(bytes) +
                     " more were needed beside " + gibibytes(m_bytes) + " in use; " +
                     gibibytes(m_context.free_bytes()) + " are free");
  m_bytes += bytes;
  return block;
}

void Cuda_backend::give_back(void* block, std::size_t bytes) noexcept
{
  cudaStreamSynchronize(stream());
  m_context.memory().give_back(block, bytes);
  m_bytes -= bytes;
}

void* Cuda_backend::take_pinned(std::size_t bytes)
{
  void* const block = m_context.pinned_memory().take(bytes);
  if (!block) throw Cuda_error("the memory of the host that a GPU needs does not suffice");
  return block;
}

void Cuda_backend::give_back_pinned(void* block, std::size_t bytes) noexcept
{
  cudaStreamSynchronize(stream());
  m_context.pinned_memory().give_back(block, bytes);
}

double Cuda_backend::seconds() const
{
  check(cudaEventSynchronize(m_stream->end), "clock");
  float milliseconds = 0;
  check(cudaEventElapsedTime(&milliseconds, m_stream->begin, m_stream->end), "clock");
  return milliseconds * 1e-3;
}

void Cuda_backend::sort_order(int n, std::uint64_t* keys, int* order)
{
  // Cubes about a quarter of the samples' spacing wide; a pass of the sort takes eight bits.
  int levels = 2;
  while (levels < 21 && (1ll << 2 * (levels - 2)) < n) ++levels;
  const int begin = std::max(63 - (3 * levels + 7) / 8 * 8, 0);
  m_keys.allocate(*this, n);
  m_places.allocate(*this, n);
  int* const places = m_places.data();
  for_each(n, [=] __device__(int i) { places[i] = i; });
  std::size_t bytes = 0;
  check(cub::DeviceRadixSort::SortPairs(nullptr, bytes, keys, m_keys.data(), places, order, n,
                                        begin, 63, stream()),
        "sorting");
  m_scratch.allocate(*this, bytes);
  check(cub::DeviceRadixSort::SortPairs(m_scratch.data(), bytes, keys, m_keys.data(), places, order,
                                        n, begin, 63, stream()),
        "sorting");
}

int Cuda_backend::select(int n, const unsigned char* is_wanted, int* items)
{
  if (n <= 0) return 0;
  m_selected.allocate(*this, 1);
  const thrust::counting_iterator<int> all(0);
  std::size_t bytes = 0;
  check(cub::DeviceSelect::Flagged(nullptr, bytes, all, is_wanted, items, m_selected.data(), n,
                                   stream()),
        "selecting");
  m_scratch.allocate(*this, bytes);
  check(cub::DeviceSelect::Flagged(m_scratch.data(), bytes, all, is_wanted, items,
                                   m_selected.data(), n, stream()),
        "selecting");
  int count = 0;
  download(&count, m_selected.data(), 1);
  return count;
}

} // namespace CGAL::PowerRTF::device
