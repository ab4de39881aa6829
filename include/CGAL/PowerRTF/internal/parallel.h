// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loops and reductions for CGAL's concurrency tags. The chunks of a reduction are fixed and joined
// in order, so every result is the same bit for bit for any number of threads, or none.
#ifndef CGAL_POWER_RTF_INTERNAL_PARALLEL_H
#define CGAL_POWER_RTF_INTERNAL_PARALLEL_H

#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <CGAL/tags.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#endif

#include <algorithm>
#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Calls `f(c)` for c in [0, n). A function pointer and no template: one instance of TBB's loop,
/// which takes long to compile, serves all.
template <class ConcurrencyTag>
void for_each_task(int n, void (*f)(const void* data, int c), const void* data)
{
#ifdef CGAL_LINKED_WITH_TBB
  if constexpr (std::is_convertible<ConcurrencyTag, Parallel_tag>::value) {
    tbb::parallel_for(tbb::blocked_range<int>(0, n, 1), [&](const tbb::blocked_range<int>& range) {
      for (int c = range.begin(); c != range.end(); ++c) f(data, c);
    });
    return;
  }
#endif
  for (int c = 0; c < n; ++c) f(data, c);
}

/// Calls `f(begin, end)` for consecutive chunks of [0, n) of at most `chunk` items.
template <class ConcurrencyTag, class F>
void for_each_chunk(int n, int chunk, F&& f)
{
  const auto run = [&](int c) {
    Cancellation::poll();
    f(c * chunk, std::min(n, (c + 1) * chunk));
  };
  using Run = decltype(run);
  for_each_task<ConcurrencyTag>((n + chunk - 1) / chunk,
                                [](const void* r, int c) { (*static_cast<Run*>(r))(c); }, &run);
}

/// Calls `f(i)` for i in [0, n).
template <class ConcurrencyTag, class F>
void for_each_index(int n, F&& f)
{
  for_each_chunk<ConcurrencyTag>(n, 256, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) f(i);
  });
}

/// Folds `accumulate(partial, i)` over the indices of each chunk, then `join(total, partial)` over
/// the chunks in order.
template <class ConcurrencyTag, class T, class Accumulate, class Join>
T reduce(int n, const T& zero, Accumulate&& accumulate, Join&& join)
{
  constexpr int chunk = 1024;
  std::vector<T> partial((n + chunk - 1) / chunk, zero);
  for_each_chunk<ConcurrencyTag>(n, chunk, [&](int begin, int end) {
    T t = zero;
    for (int i = begin; i < end; ++i) accumulate(t, i);
    partial[begin / chunk] = t;
  });
  T total = zero;
  for (const T& p : partial) join(total, p);
  return total;
}

/// Sorts items that all differ.
template <class ConcurrencyTag, class Iterator>
void sort(Iterator begin, Iterator end)
{
#ifdef CGAL_LINKED_WITH_TBB
  if constexpr (std::is_convertible<ConcurrencyTag, Parallel_tag>::value)
    return tbb::parallel_sort(begin, end);
#endif
  std::sort(begin, end);
}

/// Sum of `f(i)` over [0, n).
template <class ConcurrencyTag, class F>
double sum(int n, F&& f)
{
  return reduce<ConcurrencyTag>(
      n, 0.0, [&](double& s, int i) { s += f(i); }, [](double& s, double p) { s += p; });
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_PARALLEL_H
