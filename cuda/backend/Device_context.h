// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What outlives the engines on a GPU: its properties, and streams and memory that were given back,
// so that the second mesh of a process does not wait for them. Engines on several threads may have
// it at once.
#ifndef CGAL_POWER_RTF_CUDA_DEVICE_CONTEXT_H
#define CGAL_POWER_RTF_CUDA_DEVICE_CONTEXT_H

#include "Free_list.h"
#include "failures.h"

#include <cuda_runtime.h>

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

namespace CGAL::PowerRTF::device {

/// Memory of the current device.
struct Device_memory {
  /// \throws Cuda_error when the device fails
  static void* take(std::size_t bytes);
  static void give_back(void* block, std::size_t) noexcept { cudaFree(block); }
};

/// Memory of the host that devices see, too.
struct Pinned_memory {
  /// \throws Cuda_error when a device fails
  static void* take(std::size_t bytes);
  static void give_back(void* block, std::size_t) noexcept { cudaFreeHost(block); }
};

/// A stream, and events that tell its time.
struct Timed_stream {
  cudaStream_t stream = nullptr;
  cudaEvent_t begin = nullptr, end = nullptr;
};

class Device_context {
public:
  /// That of a device, which becomes the thread's current one; made when it is first asked for.
  /// \throws Cuda_error when there is no such device or it cannot be used
  static Device_context& of(int device);

  int device() const { return m_device; }
  const std::string& name() const { return m_name; }
  int multiprocessors() const { return m_multiprocessors; }

  Timed_stream take_stream();
  /// Nothing may be under way on it.
  void give_back(const Timed_stream& stream) noexcept;

  Free_list<Device_memory>& memory() { return m_memory; }
  Free_list<Pinned_memory>& pinned_memory() { return m_pinned_memory; }

  /// Bytes that engines may still take: those free on the device and those kept.
  std::size_t free_bytes() const;

private:
  explicit Device_context(int device);
  static void destroy(const Timed_stream& stream) noexcept;

  int m_device, m_multiprocessors = 0;
  std::string m_name;
  Free_list<Device_memory> m_memory;
  Free_list<Pinned_memory> m_pinned_memory;
  std::mutex m_mutex;
  std::vector<Timed_stream> m_streams;
};

/// A stream of a context for as long as this lives.
class Borrowed_stream {
public:
  explicit Borrowed_stream(Device_context& context)
      : m_context(context), m_stream(context.take_stream())
  {}
  ~Borrowed_stream()
  {
    cudaStreamSynchronize(m_stream.stream);
    m_context.give_back(m_stream);
  }
  Borrowed_stream(const Borrowed_stream&) = delete;
  Borrowed_stream& operator=(const Borrowed_stream&) = delete;
  const Timed_stream* operator->() const { return &m_stream; }

private:
  Device_context& m_context;
  Timed_stream m_stream;
};

/// Memory of the host that the device sees, too, for the work of one stream.
class Pinned_block {
public:
  /// \throws Cuda_error when the memory does not suffice
  Pinned_block(Free_list<Pinned_memory>& memory, cudaStream_t stream, std::size_t bytes)
      : m_memory(memory), m_stream(stream), m_bytes(bytes), m_data(memory.take(bytes))
  {
    if (!m_data) throw Cuda_error("the memory of the host that a GPU needs does not suffice");
  }
  ~Pinned_block()
  {
    cudaStreamSynchronize(m_stream);
    m_memory.give_back(m_data, m_bytes);
  }
  Pinned_block(const Pinned_block&) = delete;
  Pinned_block& operator=(const Pinned_block&) = delete;
  void* data() { return m_data; }

private:
  Free_list<Pinned_memory>& m_memory;
  cudaStream_t m_stream;
  std::size_t m_bytes;
  void* m_data;
};

/// Device memory for the work of one stream, which comes to it in order.
struct Memory_of_stream {
  Free_list<Device_memory>& memory;
  cudaStream_t stream;

  void* take(std::size_t bytes) { return memory.take(bytes); }
  /// The work is waited for: the next who has the block may be on another stream.
  void give_back(void* block, std::size_t bytes) noexcept
  {
    cudaStreamSynchronize(stream);
    memory.give_back(block, bytes);
  }
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_DEVICE_CONTEXT_H
