// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program's large blocks of memory on huge pages, where Linux has them: while the kernel makes
// small ones, threads wait for each other.
#ifdef __linux__

#include <cstddef>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

void* operator new(std::size_t bytes)
{
  constexpr std::size_t page = std::size_t(1) << 21, large = 4 * page;
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
