// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The loops of a scan, for the host's threads or a backend: the sums of chunks, the scan of these
// in the same way, then the sums inside each. The chunks are fixed, so the rounded sums are the
// same everywhere; and they are short, as one thread adds each up.
#ifndef CGAL_POWER_RTF_INTERNAL_SCAN_H
#define CGAL_POWER_RTF_INTERNAL_SCAN_H

#include <CGAL/PowerRTF/internal/host_device.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// The part of a scan's values that one thread adds up.
struct Scan_chunk {
  static constexpr int size = 64;
  int begin, end;

  /// Number c of n values; nothing for the end.
  CGAL_POWER_RTF_HD Scan_chunk(int c, int n)
      : begin(c > n / size ? n : c * size), end(n - begin < size ? n : begin + size)
  {}
  static constexpr int count(int n) { return n / size + (n % size > 0); }
};

/// For all chunks and the end, whose sum is 0.
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

template <class T>
struct Scan_in_chunk {
  int n;
  T* values;
  const T* first; ///< the sum before each chunk, and of all; null: there is one chunk

  CGAL_POWER_RTF_HD void operator()(int c) const
  {
    const Scan_chunk chunk(c, n);
    T sum = first ? first[c] : T(0);
    for (int i = chunk.begin; i < chunk.end; ++i) {
      const T value = values[i];
      values[i] = first && first[c + 1] < sum ? first[c + 1] : sum; // rounding leads no further
      sum += value;
    }
  }
};

/// How many items `sums` in `exclusive_scan()` needs room for.
inline std::size_t scan_sums(int n)
{
  std::size_t sums = 0;
  for (; n > Scan_chunk::size; sums += std::size_t(n)) n = Scan_chunk::count(n) + 1;
  return sums;
}

/// See `exclusive_scan()`; `for_each(n, f)` calls `f(i)` for all i of [0, n).
template <class For_each, class T>
void scan_by(const For_each& for_each, int n, T* values, T* sums)
{
  const int chunks = Scan_chunk::count(n);
  if (chunks > 1) {
    for_each(chunks + 1, Add_up_chunk<T>{n, values, sums});
    scan_by(for_each, chunks + 1, sums, sums + chunks + 1);
  }
  for_each(chunks, Scan_in_chunk<T>{n, values, chunks > 1 ? sums : nullptr});
}

/// Replaces each of n values, none negative, by the sum of those before it, where a backend works.
/// The sums never fall. `sums`: see `scan_sums()`.
template <class Backend, class T>
void exclusive_scan(Backend& backend, int n, T* values, T* sums)
{
  scan_by([&](int size, const auto& f) { backend.for_each(size, f); }, n, values, sums);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_SCAN_H
