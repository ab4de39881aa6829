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
    : m_context(Device_context::of(device)), m_stream(m_context),
      m_memory(Memory_of_stream{m_context.memory(), stream()}),
      m_staging(m_context.pinned_memory(), stream())
{
  internal::allocate_listed(*this, *this);
  fill(m_ticket.data(), 0u, 1);
  start_clock();
  stop_clock();
  synchronize(); // a kernel that this device cannot run says so here
}

void* Cuda_backend::take(std::size_t bytes)
{
  void* const block = m_memory.take(bytes);
  if (!block)
    throw Cuda_error("the memory of the GPU does not suffice: " + gibibytes(bytes) +
                     " more were needed beside " + gibibytes(m_bytes) + " in use; " +
                     gibibytes(m_context.free_bytes()) + " are free");
  m_bytes += bytes;
  m_most_bytes = std::max(m_most_bytes, m_bytes);
  return block;
}

void Cuda_backend::give_back(void* block, std::size_t bytes) noexcept
{
  m_memory.give_back(block, bytes);
  m_bytes -= bytes;
  if (cudaStreamQuery(stream()) == cudaSuccess)
    m_memory.release();
  else
    cudaGetLastError(); // that work is under way is no error
}

double Cuda_backend::seconds() const
{
  check(cudaEventSynchronize(m_stream->end), "clock");
  float milliseconds = 0;
  check(cudaEventElapsedTime(&milliseconds, m_stream->begin, m_stream->end), "clock");
  return milliseconds * 1e-3;
}

namespace {

/// The first bit of the keys that counts in a coarse order of n items.
int coarse_bit(int n)
{
  // Cubes about a quarter of the samples' spacing wide; a pass of the sort takes eight bits.
  int levels = 2;
  while (levels < 21 && (1ll << 2 * (levels - 2)) < n) ++levels;
  return std::max(63 - (3 * levels + 7) / 8 * 8, 0);
}

/// Sorts, or, if there is no scratch, writes how many bytes that needs.
void sort_pairs(unsigned char* scratch, std::size_t& bytes, const std::uint64_t* keys,
                std::uint64_t* sorted, const int* places, int* order, int n, int first_bit,
                cudaStream_t stream)
{
  check(cub::DeviceRadixSort::SortPairs(scratch, bytes, keys, sorted, places, order, n, first_bit,
                                        63, stream),
        "sorting");
}

/// Of all bits: fewer need no more.
std::size_t sort_scratch_bytes(int n)
{
  std::size_t bytes = 0;
  sort_pairs(nullptr, bytes, nullptr, nullptr, nullptr, nullptr, n, 0, nullptr);
  return bytes;
}

} // namespace

std::size_t Cuda_backend::least_bytes() { return internal::bytes_of_listed<Cuda_backend>(); }

std::size_t Cuda_backend::sort_bytes(int n)
{
  return internal::bytes_of_listed<Sort_arrays>(n, sort_scratch_bytes(n));
}

void Cuda_backend::sort_order(int n, std::uint64_t* keys, int* order, bool is_coarse)
{
  std::size_t bytes = sort_scratch_bytes(n);
  internal::allocate_listed(*this, m_sort, n, bytes);
  int* const places = m_sort.places.data();
  for_each(n, [=] __device__(int i) { places[i] = i; });
  sort_pairs(m_sort.scratch.data(), bytes, keys, m_sort.keys.data(), places, order, n,
             is_coarse ? coarse_bit(n) : 0, stream());
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
  m_sort.scratch.allocate(*this, bytes);
  check(cub::DeviceSelect::Flagged(m_sort.scratch.data(), bytes, all, is_wanted, items,
                                   m_selected.data(), n, stream()),
        "selecting");
  int count = 0;
  download(&count, m_selected.data(), 1);
  return count;
}

} // namespace CGAL::PowerRTF::device
