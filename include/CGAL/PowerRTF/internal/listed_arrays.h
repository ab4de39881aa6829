// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A class whose arrays may be on a device lists them once, with their sizes: what allocates them
// and what tells beforehand how much memory they will take read the same list,
//
//   template <class F>
//   static void for_each_array(F&& f, std::size_t n) { f(&Owner::m_points, n); ... }
#ifndef CGAL_POWER_RTF_INTERNAL_LISTED_ARRAYS_H
#define CGAL_POWER_RTF_INTERNAL_LISTED_ARRAYS_H

#include <cstddef>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// Allocates the arrays of `owner` for these sizes.
template <class Backend, class Owner, class... Sizes>
void allocate_listed(Backend& backend, Owner& owner, const Sizes&... sizes)
{
  Owner::for_each_array([&](auto array, std::size_t n) { (owner.*array).allocate(backend, n); },
                        sizes...);
}

/// Uploads as many items as the buffer has. \returns where they are
template <class Backend, class Buffer, class T>
T* uploaded(Backend& backend, Buffer& buffer, const T* items)
{
  backend.upload(buffer.data(), items, buffer.size());
  return buffer.data();
}

template <class Owner, class Array>
constexpr std::size_t item_size(Array Owner::*)
{
  return sizeof(*std::declval<Array&>().data());
}

/// The bytes that an owner with these sizes allocates.
template <class Owner, class... Sizes>
std::size_t bytes_of_listed(const Sizes&... sizes)
{
  std::size_t bytes = 0;
  Owner::for_each_array([&](auto array, std::size_t n) { bytes += n * item_size(array); },
                        sizes...);
  return bytes;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_LISTED_ARRAYS_H
