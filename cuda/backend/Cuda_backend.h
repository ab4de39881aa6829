// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The device engine's operations on one GPU and one stream: buffers, loops, reductions in a fixed
// order, copies, time. Every error of the CUDA runtime is thrown. Stream and memory are the
// device's context's, which has them back in the end.
#ifndef CGAL_POWER_RTF_CUDA_CUDA_BACKEND_H
#define CGAL_POWER_RTF_CUDA_CUDA_BACKEND_H

#include "Device_context.h"
#include "Staging_ring.h"
#include "kernels.cuh"
#include <CGAL/PowerRTF/geometry/Surface_facets.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <CGAL/tags.h>

#include <cuda_runtime.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <string>
#include <utility>

namespace CGAL::PowerRTF::device {

class Cuda_backend {
public:
  static constexpr bool is_host = false;
  static constexpr bool works_by_warps = true;
  static constexpr int max_resident = 300000; ///< threads that a GPU runs at once
  /// Of what is done in the host's memory.
  static internal::Concurrency concurrency() { return Parallel_if_available_tag(); }

  /// Memory of the device's context that no backend has. Nothing may be under way with it in the
  /// end.
  class Kept_memory {
  public:
    Kept_memory(Device_context& context, void* data, std::size_t bytes)
        : m_context(&context), m_data(data), m_bytes(bytes)
    {}
    Kept_memory(Kept_memory&& other) noexcept
        : m_context(other.m_context), m_data(std::exchange(other.m_data, nullptr)),
          m_bytes(other.m_bytes)
    {}
    Kept_memory& operator=(Kept_memory&&) = delete;
    ~Kept_memory()
    {
      if (m_data) m_context->memory().give_back(m_data, m_bytes);
    }
    std::size_t bytes() const { return m_bytes; }

  private:
    Device_context* m_context;
    void* m_data;
    std::size_t m_bytes;
  };

  /// Device memory that is given back with it. Its contents are lost when it grows.
  template <class T>
  class Buffer {
  public:
    Buffer() = default;
    Buffer(Buffer&& other) noexcept { swap(other); }
    Buffer& operator=(Buffer&& other) noexcept
    {
      Buffer(std::move(other)).swap(*this);
      return *this;
    }
    ~Buffer() { release(); }

    /// \throws Cuda_error when the memory does not suffice, with how much was needed
    void allocate(Cuda_backend& backend, std::size_t n)
    {
      if (n <= m_capacity) {
        m_size = n;
        return;
      }
      release();
      m_data = static_cast<T*>(backend.take(n * sizeof(T)));
      m_backend = &backend;
      m_capacity = m_size = n;
    }
    T* data() { return m_data; }
    const T* data() const { return m_data; }
    std::size_t size() const { return m_size; }

    /// What it has from now on outlives the backend. \pre it has something
    Kept_memory keep()
    {
      const std::size_t bytes = m_capacity * sizeof(T);
      m_backend->m_bytes -= bytes;
      Kept_memory kept(m_backend->m_context, std::exchange(m_data, nullptr), bytes);
      m_capacity = m_size = 0;
      return kept;
    }

  private:
    void swap(Buffer& other) noexcept
    {
      std::swap(m_backend, other.m_backend);
      std::swap(m_data, other.m_data);
      std::swap(m_size, other.m_size);
      std::swap(m_capacity, other.m_capacity);
    }
    void release()
    {
      if (m_data) m_backend->give_back(m_data, m_capacity * sizeof(T));
      m_data = nullptr;
      m_capacity = m_size = 0;
    }

    Cuda_backend* m_backend = nullptr;
    T* m_data = nullptr;
    std::size_t m_size = 0, m_capacity = 0;
  };

  /// One item that both host and device see: the device writes it through the bus, the host reads
  /// it after `synchronize()`.
  template <class T>
  class Shared_item {
  public:
    explicit Shared_item(Cuda_backend& backend)
        : m_memory(backend.m_context.pinned_memory(), backend.stream(), sizeof(T)),
          m_item(new (m_memory.data()) T())
    {}
    T* data() { return m_item; }

  private:
    Pinned_block m_memory;
    T* m_item;
  };

  /// \throws Cuda_error when the device is missing or cannot be used
  explicit Cuda_backend(int device);
  Cuda_backend(const Cuda_backend&) = delete;
  Cuda_backend& operator=(const Cuda_backend&) = delete;

  template <class F>
  void for_each(int n, F f)
  {
    if (n <= 0) return;
    const int threads = n <= small ? 32 : 128;
    for_each_kernel<<<(n + threads - 1) / threads, threads, 0, stream()>>>(n, f);
    check(cudaGetLastError(), "starting a kernel");
  }

  /// Calls `f(i, lanes)` for i in [0, n): by eight lanes each when there are few items.
  template <class F>
  void for_each_by_lanes(int n, F f)
  {
    if (n <= 0) return;
    if (n <= few) {
      constexpr int threads = 64, items = threads / Eight_lanes::size;
      for_each_by_eight_kernel<<<(n + items - 1) / items, threads, 0, stream()>>>(n, f);
    } else {
      for_each_by_one_kernel<<<(n + 127) / 128, 128, 0, stream()>>>(n, f);
    }
    check(cudaGetLastError(), "starting a kernel");
  }

  /// The same by a warp each.
  template <class F>
  void for_each_by_warps(int n, F f)
  {
    if (n <= 0) return;
    constexpr int items = Warp_lanes::in_block, threads = items * Warp_lanes::size;
    for_each_by_warp_kernel<<<(n + items - 1) / items, threads, 0, stream()>>>(n, f);
    check(cudaGetLastError(), "starting a kernel");
  }

  template <int Sums, int Maxima, class F, class Finish>
  void reduce(int n, F f, Finish finish)
  {
    static_assert(Totals<Sums, Maxima>::size <= max_totals, "the partial sums have no room");
    int blocks = (n + reduction_threads - 1) / reduction_threads;
    blocks = blocks < 1 ? 1 : blocks > reduction_blocks ? reduction_blocks : blocks;
    reduce_kernel<Sums, Maxima><<<blocks, reduction_threads, 0, stream()>>>(
        n, f, finish, m_partials.data(), m_ticket.data());
    check(cudaGetLastError(), "starting a reduction");
  }

  /// Runs `f(team)` once for all: its threads share the work on n items and add numbers up, so that
  /// an iteration needs no further launches.
  template <class F>
  void run_team(int n, F f)
  {
    if (n <= block_team_items) {
      block_team_kernel<<<1, block_team_threads, 0, stream()>>>(f);
      check(cudaGetLastError(), "starting a kernel");
      return;
    }
    run_grid_team(std::min((n + grid_team_threads - 1) / grid_team_threads, max_team_blocks<F>()),
                  f);
  }

  /// Calls `f(sweep, i)` for i in [0, n), one sweep after the other; false: n are too many for one
  /// block.
  template <class F>
  bool run_sweeps(int n, int sweeps, F f)
  {
    if (n > block_team_threads) return false;
    sweeps_kernel<<<1, (n + 31) / 32 * 32, 0, stream()>>>(n, sweeps, f);
    check(cudaGetLastError(), "starting a kernel");
    return true;
  }

  /// Two reductions, of which the second knows the result of the first; see `Summary_rule`.
  template <class Rule>
  void reduce_twice(int n, const Rule& rule)
  {
    run_team(n, Two_reductions<Rule>{rule, n});
  }

  /// Runs `f(team)` with a thread for each item; false: there are not so many at a time.
  template <class F>
  bool run_resident_team(int n, F f)
  {
    const int blocks = (n + grid_team_threads - 1) / grid_team_threads;
    if (blocks > max_team_blocks<F>()) return false;
    run_grid_team(blocks, f);
    return true;
  }

  /// The order of n items by their keys, equal ones by number. `is_coarse`: of points by their
  /// codes along the Hilbert curve, where those in one small cube keep theirs.
  void sort_order(int n, std::uint64_t* keys, int* order, bool is_coarse = false);

  /// Writes the items i of [0, n) with `is_wanted[i]` in order. \returns their number
  int select(int n, const unsigned char* is_wanted, int* items);

  /// Returns once `from` is no longer needed; the device has the items when it comes to them.
  template <class T>
  void upload(T* to, const T* from, std::size_t n)
  {
    m_staging.upload(to, from, n * sizeof(T));
  }
  template <class T>
  void download(T* to, const T* from, std::size_t n)
  {
    m_staging.download(to, from, n * sizeof(T));
    m_memory.release();
  }
  template <class T>
  void fill(T* to, T value, std::size_t n)
  {
    if (n == 0) return;
    fill_kernel<<<unsigned((n + 255) / 256), 256, 0, stream()>>>(to, value, n);
    check(cudaGetLastError(), "starting a kernel");
  }

  /// Whether that is on its device.
  bool has(const Resident_surface& surface) const { return surface.device == m_context.device(); }

  /// Whether so many bytes are free now.
  bool has_room(std::size_t bytes) const
  {
    return bytes <= m_context.free_bytes() + m_memory.kept();
  }

  /// From the beginning; see listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f)
  {
    f(&Cuda_backend::m_partials, std::size_t(reduction_blocks) * max_totals);
    f(&Cuda_backend::m_ticket, 1);
  }

  cudaStream_t stream() const { return m_stream->stream; }
  void synchronize()
  {
    check(cudaStreamSynchronize(stream()), "waiting for the kernels");
    m_staging.clear();
    m_memory.release();
  }
  int multiprocessors() const { return m_context.multiprocessors(); }

  /// The time on the device from `start_clock()` to the last `stop_clock()`.
  void start_clock() { check(cudaEventRecord(m_stream->begin, stream()), "clock"); }
  void stop_clock() { check(cudaEventRecord(m_stream->end, stream()), "clock"); }
  double seconds() const;

  /// The most that was held at a time.
  std::size_t bytes() const { return m_most_bytes; }
  /// What a backend has from the beginning, and what `sort_order()` of n items adds.
  static std::size_t least_bytes();
  static std::size_t sort_bytes(int n);
  const std::string& name() const { return m_context.name(); }

private:
  struct Sort_arrays {
    Buffer<std::uint64_t> keys;
    Buffer<int> places;
    Buffer<unsigned char> scratch; // of all of CUB's functions

    template <class F>
    static void for_each_array(F&& f, std::size_t n, std::size_t scratch_bytes)
    {
      f(&Sort_arrays::keys, n);
      f(&Sort_arrays::places, n);
      f(&Sort_arrays::scratch, scratch_bytes);
    }
  };

  /// \throws Cuda_error when the memory does not suffice
  void* take(std::size_t bytes);
  /// Keeps the block for this stream as long as its work is under way.
  void give_back(void* block, std::size_t bytes) noexcept;

  template <class F>
  int max_team_blocks() const
  {
    int per_multiprocessor = 0;
    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&per_multiprocessor, grid_team_kernel<F>,
                                                        grid_team_threads, 0),
          "occupancy");
    return std::min(per_multiprocessor * multiprocessors(), grid_team_blocks);
  }
  template <class F>
  void run_grid_team(int blocks, F f)
  {
    double* partials = m_partials.data();
    void* arguments[] = {&f, &partials};
    check(cudaLaunchCooperativeKernel(reinterpret_cast<void*>(grid_team_kernel<F>), dim3(blocks),
                                      dim3(grid_team_threads), arguments, 0, stream()),
          "starting a cooperative kernel");
  }

  static constexpr int small = 32768, few = 200000, max_totals = 128;

  Device_context& m_context;
  Borrowed_stream m_stream;
  Free_list<Memory_of_stream> m_memory;
  std::size_t m_bytes = 0, m_most_bytes = 0;
  Staging_ring m_staging;
  Buffer<double> m_partials;
  Buffer<unsigned> m_ticket;
  Sort_arrays m_sort;
  Buffer<int> m_selected; // their number
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_CUDA_BACKEND_H
