// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory that was given back, kept for who asks next: taking and freeing it by CUDA's runtime costs
// more than a small mesh's work on a GPU, and waits for all that others do there. (A pool of the
// runtime, cudaMallocAsync(), would do the same, but not on every GPU, and without one its
// book-keeping cannot be tested.)
#ifndef CGAL_POWER_RTF_CUDA_FREE_LIST_H
#define CGAL_POWER_RTF_CUDA_FREE_LIST_H

#include <algorithm>
#include <cstddef>
#include <map>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::device {

/// The size of the block that holds so many bytes: at most an eighth more, so that arrays of nearly
/// the same size may have the same block in turn. At least 512.
inline std::size_t block_size(std::size_t bytes)
{
  constexpr std::size_t least = 512, steps = 8;
  std::size_t step = least;
  while (step * 2 * steps <= bytes) step *= 2;
  return (std::max(bytes, std::size_t(1)) + step - 1) / step * step;
}

/// Its members may be called by several threads at once.
///
/// \tparam Source where blocks come from: `take(bytes)` returns null where there is none,
/// `give_back(block, bytes)` throws nothing
template <class Source>
class Free_list {
public:
  explicit Free_list(Source source = {}) : m_source(std::move(source)) {}
  Free_list(const Free_list&) = delete;
  Free_list& operator=(const Free_list&) = delete;
  ~Free_list() { release(); }

  /// A block of `block_size(bytes)`. Null: there is none, not even where all that was kept has gone
  /// back to the source.
  void* take(std::size_t bytes)
  {
    const std::size_t size = block_size(bytes);
    if (void* const kept = take_kept(size)) return kept;
    if (void* const block = m_source.take(size)) return block;
    release();
    return m_source.take(size);
  }

  /// Keeps a block that was taken for so many bytes. Nothing may use it any more.
  void give_back(void* block, std::size_t bytes) noexcept
  {
    const std::size_t size = block_size(bytes);
    try {
      const std::lock_guard<std::mutex> lock(m_mutex);
      m_blocks[size].push_back(block);
      m_kept += size;
    } catch (const std::bad_alloc&) {
      m_source.give_back(block, size);
    }
  }

  /// Gives all that is kept back to the source.
  void release() noexcept
  {
    std::map<std::size_t, std::vector<void*>> blocks;
    {
      const std::lock_guard<std::mutex> lock(m_mutex);
      std::swap(blocks, m_blocks);
      m_kept = 0;
    }
    for (const auto& [size, of_size] : blocks)
      for (void* const block : of_size) m_source.give_back(block, size);
  }

  /// Bytes of the blocks that are kept.
  std::size_t kept() const
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_kept;
  }

private:
  void* take_kept(std::size_t size)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    const auto found = m_blocks.find(size);
    if (found == m_blocks.end() || found->second.empty()) return nullptr;
    void* const block = found->second.back();
    found->second.pop_back();
    m_kept -= size;
    return block;
  }

  Source m_source;
  mutable std::mutex m_mutex;
  std::map<std::size_t, std::vector<void*>> m_blocks; // by size
  std::size_t m_kept = 0;
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_FREE_LIST_H
