// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_HUGE_PAGES_H
#define CGAL_POWER_RTF_INTERNAL_HUGE_PAGES_H

#include <cstddef>
#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace CGAL::PowerRTF::internal {

/// Asks for huge pages for memory that has not been touched yet, if there is much of it: to come by
/// memory in pages of 4 kB takes longer than to fill it. Elsewhere than on Linux does nothing.
inline void prefer_huge_pages(void* memory, std::size_t bytes)
{
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t page = std::uintptr_t(1) << 21;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = (begin + page - 1) / page * page,
                       last = (begin + bytes) / page * page;
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
#else
  (void)memory, (void)bytes;
#endif
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_HUGE_PAGES_H
