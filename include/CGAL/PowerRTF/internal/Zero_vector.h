// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_ZERO_VECTOR_H
#define CGAL_POWER_RTF_INTERNAL_ZERO_VECTOR_H

#include <CGAL/PowerRTF/internal/Unset_vector.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace CGAL::PowerRTF::internal {

template <class T>
struct Zero_allocator : Unset_allocator<T> {
  template <class U>
  struct rebind {
    using other = Zero_allocator<U>;
  };

  T* allocate(std::size_t n)
  {
    if (void* const memory = std::calloc(n, sizeof(T))) return static_cast<T*>(memory);
    throw std::bad_alloc();
  }
  void deallocate(T* memory, std::size_t) { std::free(memory); }
};

/// A vector of fixed size whose items begin as zero, which is what their bytes are. Of one that is
/// large, only the pages that are touched cost anything.
template <class T>
using Zero_vector = std::vector<T, Zero_allocator<T>>;

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_ZERO_VECTOR_H
