// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program's memory, where Linux can do better: large blocks on huge pages, as threads wait for
// each other while the kernel makes small ones; and pages that are freed stay the program's, as the
// kernel would clear new ones for each block. The C library gives those of other threads than the
// first one back in any case, so large blocks are kept here. Clang's thread sanitizer has operators
// of its own, and does not link with others; the address sanitizer has some of its own, which do
// not go with these.
#ifdef __has_feature
#define POWER_RTF_HAS_FEATURE(feature) __has_feature(feature)
#else
#define POWER_RTF_HAS_FEATURE(feature) 0
#endif
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) &&                                        \
    !POWER_RTF_HAS_FEATURE(address_sanitizer) && !POWER_RTF_HAS_FEATURE(thread_sanitizer)
#define POWER_RTF_KEEPS_LARGE_BLOCKS

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <new>
#include <utility>

#include <malloc.h>
#include <sys/mman.h>

namespace {

constexpr std::size_t page = std::size_t(1) << 21, large = 2 * page;

#ifdef M_MMAP_MAX // not in every C library
[[maybe_unused]] const bool keeps_pages =
    mallopt(M_MMAP_MAX, 0) + mallopt(M_TRIM_THRESHOLD, -1) + mallopt(M_TOP_PAD, 16 * large) > 0;
#endif

/// Straight from the C library: the operators below may ask for the lock that is held.
template <class T>
struct Plain_allocator {
  using value_type = T;
  Plain_allocator() = default;
  template <class U>
  Plain_allocator(const Plain_allocator<U>&)
  {}
  T* allocate(std::size_t n)
  {
    if (void* const block = std::malloc(n * sizeof(T))) return static_cast<T*>(block);
    throw std::bad_alloc();
  }
  void deallocate(T* block, std::size_t) { std::free(block); }
  friend bool operator==(const Plain_allocator&, const Plain_allocator&) { return true; }
  friend bool operator!=(const Plain_allocator&, const Plain_allocator&) { return false; }
};

/// Blocks of whole huge pages. Those that are freed are one with their neighbors.
class Large_blocks {
public:
  /// Null: there is no memory.
  void* allocate(std::size_t bytes)
  {
    const std::size_t size = (bytes + page - 1) / page * page;
    if (size < bytes) return nullptr;
    const std::lock_guard<std::mutex> lock(m_mutex);
    char* const block = take(size);
    if (block) m_used[block] = size;
    return block;
  }
  /// Whether the block is one of these, and was freed.
  bool free(void* block)
  {
    if (reinterpret_cast<std::uintptr_t>(block) % page != 0) return false;
    const std::lock_guard<std::mutex> lock(m_mutex);
    const auto used = m_used.find(static_cast<char*>(block));
    if (used == m_used.end()) return false;
    add_free(used->first, used->second);
    m_used.erase(used);
    return true;
  }

private:
  /// Sizes by beginning.
  using Blocks = std::map<char*, std::size_t, std::less<char*>,
                          Plain_allocator<std::pair<char* const, std::size_t>>>;

  char* take(std::size_t size)
  {
    auto best = m_free.end();
    for (auto it = m_free.begin(); it != m_free.end(); ++it)
      if (it->second >= size && (best == m_free.end() || it->second < best->second)) best = it;
    if (best == m_free.end()) {
      char* block = map(size);
      if (block) return block;
      for (const auto& [begin, free_size] : m_free) munmap(begin, free_size);
      m_free.clear();
      return map(size);
    }
    const auto [begin, free_size] = *best;
    m_free.erase(best);
    if (free_size > size) m_free[begin + size] = free_size - size;
    return begin;
  }

  void add_free(char* begin, std::size_t size)
  {
    auto next = m_free.lower_bound(begin);
    if (next != m_free.end() && begin + size == next->first) {
      size += next->second;
      next = m_free.erase(next);
    }
    if (next != m_free.begin())
      if (const auto before = std::prev(next); before->first + before->second == begin) {
        before->second += size;
        return;
      }
    m_free[begin] = size;
  }

  static char* map(std::size_t size)
  {
    void* const all =
        mmap(nullptr, size + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (all == MAP_FAILED) return nullptr;
    char* const begin = static_cast<char*>(all);
    const std::size_t before = -reinterpret_cast<std::uintptr_t>(begin) % page;
    if (before > 0) munmap(begin, before);
    if (before < page) munmap(begin + before + size, page - before);
    madvise(begin + before, size, MADV_HUGEPAGE); // advice: what it returns does not matter
    return begin + before;
  }

  std::mutex m_mutex;
  Blocks m_used, m_free;
};

Large_blocks& large_blocks()
{
  static Large_blocks* const blocks = new Large_blocks; // outlives what is static
  return *blocks;
}

} // namespace

void* operator new(std::size_t bytes)
{
  void* const block =
      bytes < large ? std::malloc(bytes > 0 ? bytes : 1) : large_blocks().allocate(bytes);
  if (!block) throw std::bad_alloc();
  return block;
}

void operator delete(void* block) noexcept
{
  if (!large_blocks().free(block)) std::free(block);
}
void operator delete(void* block, std::size_t) noexcept { operator delete(block); }

#endif
