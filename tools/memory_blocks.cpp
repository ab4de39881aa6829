// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program's memory, where Linux can do better: large blocks on huge pages, as threads wait for
// each other while the kernel makes small ones; and pages that are freed stay the program's, as the
// kernel would clear new ones for each block. Clang's thread sanitizer has operators of its own,
// and does not link with others; the address sanitizer has some of its own, which do not go with
// these.
#ifdef __has_feature
#define POWER_RTF_HAS_FEATURE(feature) __has_feature(feature)
#else
#define POWER_RTF_HAS_FEATURE(feature) 0
#endif
#if defined(__linux__) && !defined(__SANITIZE_ADDRESS__) &&                                        \
    !POWER_RTF_HAS_FEATURE(address_sanitizer) && !POWER_RTF_HAS_FEATURE(thread_sanitizer)

#include <cstddef>
#include <cstdlib>
#include <new>

#include <malloc.h>
#include <sys/mman.h>

namespace {

constexpr std::size_t page = std::size_t(1) << 21, large = 4 * page;

#ifdef M_MMAP_MAX // not in every C library
[[maybe_unused]] const bool keeps_pages =
    mallopt(M_MMAP_MAX, 0) + mallopt(M_TRIM_THRESHOLD, -1) + mallopt(M_TOP_PAD, 8 * large) > 0;
#endif

} // namespace

void* operator new(std::size_t bytes)
{
  void* block = nullptr;
  if (bytes < large)
    block = std::malloc(bytes > 0 ? bytes : 1);
  else if (posix_memalign(&block, page, bytes) != 0)
    block = nullptr;
  else
    madvise(block, bytes, MADV_HUGEPAGE); // advice: what it returns does not matter
  if (!block) throw std::bad_alloc();
  return block;
}

void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }

#endif
