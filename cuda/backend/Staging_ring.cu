// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Staging_ring.h"

#include <CGAL/PowerRTF/internal/parallel.h>

#include <CGAL/tags.h>

#include <algorithm>
#include <cstring>
#include <memory>

namespace CGAL::PowerRTF::device {

namespace {

/// Copies in the host's memory.
void copy_in_parallel(char* to, const char* from, std::size_t bytes)
{
  constexpr std::size_t piece = std::size_t(1) << 17;
  internal::for_each_chunk(Parallel_if_available_tag(), int((bytes + piece - 1) / piece), 1,
                           [&](int k, int) {
                             const std::size_t begin = k * piece;
                             std::memcpy(to + begin, from + begin, std::min(piece, bytes - begin));
                           });
}

} // namespace

Staging_ring::Events::~Events()
{
  for (const cudaEvent_t e : all)
    if (e) cudaEventDestroy(e);
}

Staging_ring::Staging_ring(Free_list<Pinned_memory>& memory, cudaStream_t stream)
    : m_memory(memory), m_stream(stream)
{
  for (cudaEvent_t& e : m_events.all)
    check(cudaEventCreateWithFlags(&e, cudaEventDisableTiming), "making an event");
  take_parts(small_part);
}

void Staging_ring::take_parts(std::size_t bytes)
{
  m_block = std::make_unique<Pinned_block>(m_memory, m_stream, parts * bytes);
  m_part_bytes = bytes;
  m_part = 0;
  m_used = 0;
}

void Staging_ring::adapt(std::size_t bytes)
{
  if (bytes > parts * small_part && m_part_bytes < large_part) take_parts(large_part);
}

char* Staging_ring::stage(std::size_t bytes)
{
  constexpr std::size_t alignment = 64;
  if (m_used + bytes > m_part_bytes) {
    check(cudaEventRecord(event(m_part), m_stream), "upload");
    m_part = (m_part + 1) % parts;
    check(cudaEventSynchronize(event(m_part)), "upload");
    m_used = 0;
  }
  char* const place = part(m_part) + m_used;
  m_used += (bytes + alignment - 1) / alignment * alignment;
  return place;
}

void Staging_ring::upload(void* to, const void* from, std::size_t bytes)
{
  adapt(bytes);
  for (std::size_t begin = 0; begin < bytes; begin += m_part_bytes) {
    const std::size_t size = std::min(m_part_bytes, bytes - begin);
    char* const place = stage(size);
    copy_in_parallel(place, static_cast<const char*>(from) + begin, size);
    check(cudaMemcpyAsync(static_cast<char*>(to) + begin, place, size, cudaMemcpyHostToDevice,
                          m_stream),
          "upload");
  }
}

void Staging_ring::download(void* to, const void* from, std::size_t bytes)
{
  adapt(bytes);
  const std::size_t count = (bytes + m_part_bytes - 1) / m_part_bytes;
  const auto size = [&](std::size_t k) { return std::min(m_part_bytes, bytes - k * m_part_bytes); };
  // The device reads what is to go up before it writes there.
  const auto start = [&](std::size_t k) {
    if (k >= count) return;
    check(cudaMemcpyAsync(part(k), static_cast<const char*>(from) + k * m_part_bytes, size(k),
                          cudaMemcpyDeviceToHost, m_stream),
          "download");
    if (count > 1) check(cudaEventRecord(event(k), m_stream), "download");
  };
  try {
    for (std::size_t k = 0; k < parts; ++k) start(k);
    for (std::size_t k = 0; k < count; ++k) {
      check(k + 1 < count ? cudaEventSynchronize(event(k)) : cudaStreamSynchronize(m_stream),
            "download");
      copy_in_parallel(static_cast<char*>(to) + k * m_part_bytes, part(k), size(k));
      start(k + parts);
    }
  } catch (...) { // a run that was cancelled, too: nothing may write to the parts from now on
    cudaStreamSynchronize(m_stream);
    clear();
    throw;
  }
  clear();
}

} // namespace CGAL::PowerRTF::device
