// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_CUDA_STAGING_RING_H
#define CGAL_POWER_RTF_CUDA_STAGING_RING_H

#include "Device_context.h"

#include <cuda_runtime.h>

#include <array>
#include <cstddef>
#include <memory>

namespace CGAL::PowerRTF::device {

/// Copies between the host's memory and a device's, in the order of a stream and through pinned
/// memory, part by part: the bus has some parts while the host's threads copy others.
class Staging_ring {
public:
  /// \throws Cuda_error when the device fails
  Staging_ring(Free_list<Pinned_memory>& memory, cudaStream_t stream);

  /// Returns once `from` is no longer needed. \throws Cuda_error when the device fails
  void upload(void* to, const void* from, std::size_t bytes);
  /// Returns once all is there: the stream has nothing left to do. \throws Cuda_error when the
  /// device fails
  void download(void* to, const void* from, std::size_t bytes);
  /// The stream has been waited for.
  void clear() { m_used = 0; }

private:
  static constexpr int parts = 4;
  /// What of an array goes at a time, of a small one and of a large one.
  static constexpr std::size_t small_part = std::size_t(1) << 21, large_part = std::size_t(1) << 23;

  /// When the stream is done with each part.
  struct Events {
    std::array<cudaEvent_t, parts> all{};
    Events() = default;
    Events(const Events&) = delete;
    Events& operator=(const Events&) = delete;
    ~Events();
  };

  void take_parts(std::size_t bytes);
  /// Has larger parts from now on, if an array is large.
  void adapt(std::size_t bytes);
  char* part(std::size_t k)
  {
    return static_cast<char*>(m_block->data()) + k % parts * m_part_bytes;
  }
  cudaEvent_t event(std::size_t k) const { return m_events.all[k % parts]; }
  /// Memory that the host may write to. \pre `bytes` is at most that of a part
  char* stage(std::size_t bytes);

  Free_list<Pinned_memory>& m_memory;
  cudaStream_t m_stream;
  Events m_events;
  std::unique_ptr<Pinned_block> m_block; // all parts
  std::size_t m_part_bytes = 0;
  int m_part = 0;         // that the host writes to
  std::size_t m_used = 0; // bytes of it
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_STAGING_RING_H
