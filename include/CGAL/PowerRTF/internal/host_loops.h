// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_HOST_LOOPS_H
#define CGAL_POWER_RTF_INTERNAL_HOST_LOOPS_H

#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL {
namespace PowerRTF {

/// The operations of a device as loops on the host, for what is written once for both.
template <class ConcurrencyTag>
class Host_loops {
public:
  template <class T>
  class Buffer {
  public:
    void allocate(Host_loops&, std::size_t n) { m_items.resize(n); }
    T* data() { return m_items.data(); }
    const T* data() const { return m_items.data(); }
    std::size_t size() const { return m_items.size(); }

  private:
    std::vector<T> m_items;
  };

  /// Calls `f(i)` for i in [0, n), in any order.
  template <class F>
  void for_each(int n, F f)
  { internal::for_each_index<ConcurrencyTag>(n, f); }

  /// Adds `f(i, totals)` up over [0, n) in a fixed order and calls `finish(totals)` once.
  template <int Sums, int Maxima, class F, class Finish>
  void reduce(int n, F f, Finish finish)
  {
    using T = Totals<Sums, Maxima>;
    T zero;
    zero.clear();
    finish(internal::reduce<ConcurrencyTag>(
        n, zero, [&](T& totals, int i) { f(i, totals); },
        [](T& totals, const T& part) {
          for (int k = 0; k < T::size; ++k)
            totals.values[k] = T::joined(k, totals.values[k], part.values[k]);
        }));
  }

  template <class T>
  void download(T* to, const T* from, std::size_t n)
  { std::copy(from, from + n, to); }
  template <class T>
  void fill(T* to, T value, std::size_t n)
  { std::fill(to, to + n, value); }
};

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_INTERNAL_HOST_LOOPS_H
