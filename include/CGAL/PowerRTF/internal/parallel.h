// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loops and reductions for CGAL's concurrency tags. The chunks of a reduction are fixed and joined
// in order, so every result is the same bit for bit for any number of threads, or none.
#ifndef CGAL_POWER_RTF_INTERNAL_PARALLEL_H
#define CGAL_POWER_RTF_INTERNAL_PARALLEL_H

#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/huge_pages.h>
#include <CGAL/PowerRTF/internal/scan.h>

#include <CGAL/tags.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#endif

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A concurrency tag as a value: what is compiled only once runs with the tag that it is given.
class Concurrency {
public:
  /// From a tag.
  template <class ConcurrencyTag>
  Concurrency(ConcurrencyTag)
      : m_is_parallel(std::is_convertible<ConcurrencyTag, Parallel_tag>::value)
  {}

  bool is_parallel() const { return m_is_parallel; }

private:
  bool m_is_parallel;
};

/// Calls `f(c)` for c in [0, n). A function pointer and no template: one instance of TBB's loop,
/// which takes long to compile, serves all.
inline void for_each_task(Concurrency concurrency, int n, void (*f)(const void* data, int c),
                          const void* data)
{
#ifdef CGAL_LINKED_WITH_TBB
  if (concurrency.is_parallel() && n > 1) {
    tbb::parallel_for(tbb::blocked_range<int>(0, n, 1), [&](const tbb::blocked_range<int>& range) {
      for (int c = range.begin(); c != range.end(); ++c) f(data, c);
    });
    return;
  }
#else
  (void)concurrency;
#endif
  for (int c = 0; c < n; ++c) f(data, c);
}

/// Calls `f(begin, end)` for consecutive chunks of [0, n) of at most `chunk` items.
template <class F>
void for_each_chunk(Concurrency concurrency, int n, int chunk, F&& f)
{
  const int chunks = (n + chunk - 1) / chunk;
  const Progress_part part;
  const int stride = 1 + chunks / 256; // threads that all count would wait for each other
  std::atomic<int> begun{0};
  const auto run = [&](int c) {
    constexpr auto relaxed = std::memory_order_relaxed;
    Cancellation::poll(c % stride == 0 ? begun.fetch_add(stride, relaxed) : begun.load(relaxed),
                       chunks);
    f(c * chunk, std::min(n, (c + 1) * chunk));
  };
  using Run = decltype(run);
  for_each_task(
      concurrency, chunks, [](const void* r, int c) { (*static_cast<Run*>(r))(c); }, &run);
}
template <class ConcurrencyTag, class F>
void for_each_chunk(int n, int chunk, F&& f)
{
  for_each_chunk(ConcurrencyTag(), n, chunk, f);
}

/// Calls `f(i)` for i in [0, n).
template <class F>
void for_each_index(Concurrency concurrency, int n, F&& f)
{
  for_each_chunk(concurrency, n, 256, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) f(i);
  });
}
template <class ConcurrencyTag, class F>
void for_each_index(int n, F&& f)
{
  for_each_index(ConcurrencyTag(), n, f);
}

/// Calls all of `f()`, at the same time where there are threads.
template <class... F>
void call_at_once(Concurrency concurrency, F&&... f)
{
  for_each_chunk(concurrency, static_cast<int>(sizeof...(F)), 1, [&](int task, int) {
    int k = 0;
    ((k++ == task ? f() : void()), ...);
  });
}

/// Makes n new items of a vector. All threads touch new memory first: the kernel clears its pages,
/// which takes longer than to fill them, and would have one thread do it.
template <class T>
void resize_in_parallel(Concurrency concurrency, std::vector<T>& v, std::size_t n,
                        const T& item = T())
{
  constexpr std::size_t page = 4096, pages_per_chunk = 512;
  v.clear();
  if (concurrency.is_parallel() && n > v.capacity()) {
    v.reserve(n);
    const auto memory = reinterpret_cast<char*>(v.data());
    prefer_huge_pages(memory, n * sizeof(T));
    const int pages = static_cast<int>(n * sizeof(T) / page);
    for_each_chunk(concurrency, pages, pages_per_chunk, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) memory[k * page] = 0;
    });
  }
  v.assign(n, item); // where the items are arrays, `resize()` takes many times as long
}

/// A vector of n times the item, which all threads fill.
template <class T>
Unset_vector<T> filled(Concurrency concurrency, std::size_t n, const T& item)
{
  constexpr std::size_t chunk = 1 << 14;
  Unset_vector<T> v(n);
  for_each_chunk(concurrency, static_cast<int>((n + chunk - 1) / chunk), 1, [&](int k, int) {
    std::fill(v.begin() + k * chunk, v.begin() + std::min(n, (k + 1) * chunk), item);
  });
  return v;
}

/// The vectors one after the other.
template <class T>
std::vector<T> concatenated(Concurrency concurrency, const std::vector<std::vector<T>>& parts)
{
  std::vector<std::size_t> first(parts.size() + 1, 0);
  for (std::size_t k = 0; k < parts.size(); ++k) first[k + 1] = first[k] + parts[k].size();
  std::vector<T> all;
  resize_in_parallel(concurrency, all, first.back());
  for_each_chunk(concurrency, static_cast<int>(parts.size()), 1, [&](int k, int) {
    std::copy(parts[k].begin(), parts[k].end(), all.begin() + first[k]);
  });
  return all;
}

/// The items i of [0, n) with `is_wanted(i)`, in order.
template <class F>
std::vector<int> select(Concurrency concurrency, int n, F&& is_wanted)
{
  const int chunk = std::clamp(n / 128, 256, 4096);
  std::vector<std::vector<int>> parts((n + chunk - 1) / chunk);
  for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
    for (int i = begin; i < end; ++i)
      if (is_wanted(i)) parts[begin / chunk].push_back(i);
  });
  return concatenated(concurrency, parts);
}

/// Replaces each of n values, none negative, by the sum of those before it. The sums never fall.
/// \returns the sum of all
template <class T>
T exclusive_scan(Concurrency concurrency, int n, T* values)
{
  if (n == 0) return T(0);
  const T last = values[n - 1];
  std::vector<T> sums(scan_sums(n));
  const auto for_each = [&](int size, const auto& f) { for_each_index(concurrency, size, f); };
  scan_by(for_each, n, values, sums.data());
  return values[n - 1] + last;
}

/// Calls `make_room(count)` with the number of the items i of [0, n) with `is_wanted(i)`, then
/// `take(k, i)` for each, where k counts them in order. Asks twice: for what takes no time.
template <class Is_wanted, class Make_room, class Take>
void select(Concurrency concurrency, int n, Is_wanted&& is_wanted, Make_room&& make_room,
            Take&& take)
{
  constexpr int chunk = 4096;
  std::vector<int> first((n + chunk - 1) / chunk + 1, 0);
  for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
    int count = 0;
    for (int i = begin; i < end; ++i) count += bool(is_wanted(i));
    first[begin / chunk] = count;
  });
  make_room(exclusive_scan(concurrency, static_cast<int>(first.size()), first.data()));
  for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
    int k = first[begin / chunk];
    for (int i = begin; i < end; ++i)
      if (is_wanted(i)) take(k++, i);
  });
}

/// Folds `accumulate(partial, i)` over the indices of each chunk, then `join(total, partial)` over
/// the chunks in order.
template <class T, class Accumulate, class Join>
T reduce(Concurrency concurrency, int n, const T& zero, Accumulate&& accumulate, Join&& join,
         int chunk = 1024)
{
  std::vector<T> partial((n + chunk - 1) / chunk, zero);
  for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
    T t = zero;
    for (int i = begin; i < end; ++i) accumulate(t, i);
    partial[begin / chunk] = t;
  });
  T total = zero;
  for (const T& p : partial) join(total, p);
  return total;
}
template <class ConcurrencyTag, class T, class Accumulate, class Join>
T reduce(int n, const T& zero, Accumulate&& accumulate, Join&& join)
{
  return reduce(ConcurrencyTag(), n, zero, accumulate, join);
}

/// Sorts items; equal ones cannot be told apart.
template <class Iterator>
void sort(Concurrency concurrency, Iterator begin, Iterator end)
{
  const auto is_less = [](const auto& a, const auto& b) {
    Cancellation::poll_now_and_then();
    return a < b;
  };
#ifdef CGAL_LINKED_WITH_TBB
  if (concurrency.is_parallel()) return tbb::parallel_sort(begin, end, is_less);
#else
  (void)concurrency;
#endif
  std::sort(begin, end, is_less);
}
template <class ConcurrencyTag, class Iterator>
void sort(Iterator begin, Iterator end)
{
  sort(ConcurrencyTag(), begin, end);
}

/// What `find(i, add)` passes to `add` for i in [0, n): sorted, each once.
template <class T, class Find>
std::vector<T> gather_uniquely(Concurrency concurrency, int n, Find&& find)
{
  constexpr int chunk = 256;
  const auto drop_repeated = [](std::vector<T>& items) {
    items.erase(std::unique(items.begin(), items.end()), items.end());
  };
  std::vector<std::vector<T>> parts((n + chunk - 1) / chunk);
  for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
    std::vector<T>& part = parts[begin / chunk];
    for (int i = begin; i < end; ++i) find(i, [&](const T& item) { part.push_back(item); });
    std::sort(part.begin(), part.end());
    drop_repeated(part);
  });
  if (parts.size() == 1) return std::move(parts.front());
  std::vector<T> all = concatenated(concurrency, parts);
  sort(concurrency, all.begin(), all.end());
  drop_repeated(all);
  return all;
}

/// Sum of `f(i)` over [0, n).
template <class F>
double sum(Concurrency concurrency, int n, F&& f)
{
  return reduce(
      concurrency, n, 0., [&](double& s, int i) { s += f(i); },
      [](double& s, double p) { s += p; });
}
template <class ConcurrencyTag, class F>
double sum(int n, F&& f)
{
  return sum(ConcurrencyTag(), n, f);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_PARALLEL_H
