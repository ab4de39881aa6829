// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The loops of a scan, for the host's threads or a backend: the sums of the chunks, which are added
// up, then those inside each. The chunks are fixed, so the rounded sums are the same everywhere.
#ifndef CGAL_POWER_RTF_INTERNAL_SCAN_H
#define CGAL_POWER_RTF_INTERNAL_SCAN_H

#include <CGAL/PowerRTF/internal/host_device.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// The part of a scan's values that one thread adds up.
struct Scan_chunk {
  static constexpr int size = 4096;
  int begin, end;

  /// Number c of n values.
  CGAL_POWER_RTF_HD Scan_chunk(int c, int n)
      : begin(c * size), end(n - begin < size ? n : begin + size)
  {}
  static constexpr int count(int n) { return n / size + (n % size > 0); }
};

template <class T>
struct Add_up_chunk {
  int n;
  const T* values;
  T* sums; ///< of the chunks

  CGAL_POWER_RTF_HD void operator()(int c) const
  {
    const Scan_chunk chunk(c, n);
    T sum(0);
    for (int i = chunk.begin; i < chunk.end; ++i) sum += values[i];
    sums[c] = sum;
  }
};

/// Makes each of the values the sum of those up to it. For one thread.
template <class T>
struct Add_up {
  int n;
  T* values;

  CGAL_POWER_RTF_HD void operator()(int) const
  {
    for (int i = 1; i < n; ++i) values[i] += values[i - 1];
  }
};

template <class T>
struct Scan_in_chunk {
  int n;
  T* values;
  const T* first; ///< the sum before each chunk, and of all

  CGAL_POWER_RTF_HD void operator()(int c) const
  {
    const Scan_chunk chunk(c, n);
    const T end = first[c + 1];
    T sum = first[c];
    for (int i = chunk.begin; i < chunk.end; ++i) {
      const T value = values[i];
      values[i] = end < sum ? end : sum; // rounding leads no further
      sum += value;
    }
  }
};

/// How many items `first` in `exclusive_scan()` needs room for.
inline std::size_t scan_sums(int n) { return std::size_t(Scan_chunk::count(n)) + 1; }

/// Replaces each of n values, none negative, by the sum of those before it, where a backend works.
/// The sums never fall. `first`: see `scan_sums()`.
template <class Backend, class T>
void exclusive_scan(Backend& backend, int n, T* values, T* first)
{
  const int chunks = Scan_chunk::count(n);
  backend.fill(first, T(0), 1);
  backend.for_each(chunks, Add_up_chunk<T>{n, values, first + 1});
  backend.for_each(1, Add_up<T>{chunks + 1, first});
  backend.for_each(chunks, Scan_in_chunk<T>{n, values, first});
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_SCAN_H
