// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_UNSET_VECTOR_H
#define CGAL_POWER_RTF_INTERNAL_UNSET_VECTOR_H

#include <CGAL/PowerRTF/internal/huge_pages.h>

#include <algorithm>
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
/// memory comes in parallel, too. It is copied from and to a `std::vector<T>`.
template <class T>
class Unset_vector : public std::vector<T, Unset_allocator<T>> {
  using Base = std::vector<T, Unset_allocator<T>>;

public:
  using Base::Base;
  Unset_vector() = default;
  explicit Unset_vector(const std::vector<T>& v) : Base(v.begin(), v.end()) {}
  template <class Vector, class = std::enable_if_t<std::is_same_v<Vector, std::vector<T>>>>
  Unset_vector& operator=(const Vector& v) // of no type that `= {}` could mean
  {
    this->assign(v.begin(), v.end());
    return *this;
  }
  operator std::vector<T>() const { return std::vector<T>(this->begin(), this->end()); }

  friend bool operator==(const Unset_vector& a, const std::vector<T>& b)
  {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }
  friend bool operator==(const std::vector<T>& a, const Unset_vector& b) { return b == a; }
  friend bool operator!=(const Unset_vector& a, const std::vector<T>& b) { return !(a == b); }
  friend bool operator!=(const std::vector<T>& a, const Unset_vector& b) { return !(a == b); }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_UNSET_VECTOR_H
