// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The backend of the CPU: memory and loops, sequential or with TBB. Models `PowerRTFBackend`.
#ifndef CGAL_POWER_RTF_INTERNAL_HOST_BACKEND_H
#define CGAL_POWER_RTF_INTERNAL_HOST_BACKEND_H

#include <CGAL/PowerRTF/internal/Single_lane.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/order_by_key.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace CGAL::PowerRTF {

/// Every result is the same bit for bit for any number of threads, or none.
///
/// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`
template <class ConcurrencyTag>
class Host_backend {
public:
  static constexpr bool is_host = true; ///< it works in the memory of the host
  static constexpr bool works_by_warps = false;
  static constexpr int max_resident = 0;
  static internal::Concurrency concurrency() { return ConcurrencyTag(); }

  /// Memory that is freed with it. Its contents are lost when it grows.
  template <class T>
  class Buffer {
  public:
    void allocate(Host_backend&, std::size_t n)
    {
      if (n > m_items.capacity()) m_items = {};
      m_items.resize(n);
    }
    T* data() { return m_items.data(); }
    const T* data() const { return m_items.data(); }
    std::size_t size() const { return m_items.size(); }

  private:
    internal::Unset_vector<T> m_items;
  };

  /// One item that both sides see.
  template <class T>
  class Shared_item {
  public:
    explicit Shared_item(Host_backend&) {}
    T* data() { return &m_item; }

  private:
    T m_item{};
  };

  /// Calls `f(i)` for i in [0, n), in any order.
  template <class F>
  void for_each(int n, F f)
  {
    internal::for_each_index<ConcurrencyTag>(n, f);
  }

  /// Calls `f(i, lanes)` for i in [0, n), in any order; lanes would work on i together.
  template <class F>
  void for_each_by_lanes(int n, F f)
  {
    internal::for_each_index<ConcurrencyTag>(n, [&](int i) { f(i, Single_lane()); });
  }
  template <class F>
  void for_each_by_warps(int n, F f)
  {
    for_each_by_lanes(n, f);
  }

  /// Calls `f(begin, end)` for consecutive chunks of [0, n). Of this backend alone.
  template <class F>
  void for_each_chunk(int n, int chunk, F f)
  {
    internal::for_each_chunk<ConcurrencyTag>(n, chunk, f);
  }

  /// Adds `f(i, totals)` up over [0, n) in a fixed order and calls `finish(totals)` once.
  template <int Sums, int Maxima, class F, class Finish>
  void reduce(int n, F f, Finish finish)
  {
    finish(total<Totals<Sums, Maxima>>(n, f));
  }

  /// Two reductions, of which the second knows the result of the first; see `Summary_rule`.
  template <class Rule>
  void reduce_twice(int n, const Rule& rule)
  {
    auto result = rule.middle(
        total<typename Rule::First>(n, [&](int i, auto& totals) { rule.add_first(i, totals); }));
    rule.finish(result, total<typename Rule::Second>(
                            n, [&](int i, auto& totals) { rule.add_second(i, result, totals); }));
  }

  /// Runs `f(team)` by a thread for each of n items at once. \returns `false`: not here
  template <class F>
  bool run_resident_team(int, const F&)
  {
    return false;
  }

  /// Calls `f(sweep, i)` for i in [0, n), one sweep after the other. \returns `false`: not here
  template <class F>
  bool run_sweeps(int, int, const F&)
  {
    return false;
  }

  /// The order of n items by their keys, equal ones by index. It is never coarse.
  void sort_order(int n, std::uint64_t* keys, int* order, bool = false)
  {
    order_by_key(
        concurrency(), n, [&](int i) { return keys[i]; }, order);
  }

  /// Writes the items i of [0, n) with `is_wanted[i]` in order. \returns their number
  int select(int n, const unsigned char* is_wanted, int* items)
  {
    const std::vector<int> found =
        internal::select(concurrency(), n, [=](int i) { return is_wanted[i] != 0; });
    upload(items, found.data(), found.size());
    return static_cast<int>(found.size());
  }

  template <class T>
  void upload(T* to, const T* from, std::size_t n)
  {
    for_each_part(n, [=](std::size_t begin, std::size_t end) {
      std::copy(from + begin, from + end, to + begin);
    });
  }
  template <class T>
  void download(T* to, const T* from, std::size_t n)
  {
    upload(to, from, n);
  }
  template <class T>
  void fill(T* to, T value, std::size_t n)
  {
    for_each_part(
        n, [=](std::size_t begin, std::size_t end) { std::fill(to + begin, to + end, value); });
  }

  static constexpr bool has_room(std::size_t) { return true; }
  static constexpr std::size_t sort_bytes(int) { return 0; }
  void synchronize() {}
  void start_clock() {}
  void stop_clock() {}
  double seconds() const { return 0; }
  std::size_t bytes() const { return 0; }
  std::string name() const { return {}; }

private:
  template <class F>
  static void for_each_part(std::size_t n, F f)
  {
    constexpr std::size_t part = 1 << 14;
    internal::for_each_chunk<ConcurrencyTag>(int((n + part - 1) / part), 1, [&](int k, int) {
      f(k * part, (std::min)(n, (k + 1) * part));
    });
  }

  template <class T, class F>
  static T total(int n, F f)
  {
    T zero;
    zero.clear();
    return internal::reduce<ConcurrencyTag>(
        n, zero, [&](T& totals, int i) { f(i, totals); },
        [](T& totals, const T& part) {
          for (int k = 0; k < T::size; ++k)
            totals.values[k] = T::joined(k, totals.values[k], part.values[k]);
        });
  }
};

namespace internal {

/// Calls `f(backend)` with the one that `concurrency` asks for.
template <class F>
auto with_host_backend(Concurrency concurrency, F&& f)
{
  return concurrency.is_parallel() ? f(Host_backend<Parallel_if_available_tag>())
                                   : f(Host_backend<Sequential_tag>());
}

} // namespace internal
} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INTERNAL_HOST_BACKEND_H
