// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_UNSET_VECTOR_H
#define CGAL_POWER_RTF_INTERNAL_UNSET_VECTOR_H

#include <CGAL/PowerRTF/internal/huge_pages.h>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF::internal {

template <class T>
struct Unset_allocator : std::allocator<T> {
  static_assert(std::is_trivially_copy_constructible<T>::value &&
                    std::is_trivially_destructible<T>::value,
                "what is not set must need no constructor");
  template <class U>
  struct rebind {
    using other = Unset_allocator<U>;
  };

  Unset_allocator() = default;
  template <class U>
  Unset_allocator(const Unset_allocator<U>&)
  {}

  T* allocate(std::size_t n)
  {
    T* const memory = std::allocator<T>::allocate(n);
    prefer_huge_pages(memory, n * sizeof(T));
    return memory;
  }
  template <class U>
  void construct(U*)
  {}
  template <class U>
  void construct(U* p, const U& value)
  {
    ::new (static_cast<void*>(p)) U(value);
  }
};

/// A vector whose `resize()` does not set the new items: threads set them, each its own, and so the
/// memory comes in parallel, too.
template <class T>
using Unset_vector = std::vector<T, Unset_allocator<T>>;

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_UNSET_VECTOR_H
