// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A radix sort by the leading half of the keys, digit by digit from the last one on. Few keys are
// alike in it, those along a curve through a surface for one; the runs of these are sorted then.
#ifndef CGAL_POWER_RTF_INTERNAL_ORDER_BY_KEY_H
#define CGAL_POWER_RTF_INTERNAL_ORDER_BY_KEY_H

#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace CGAL::PowerRTF::internal {

using Keyed_items = Unset_vector<std::pair<std::uint64_t, int>>;

/// Writes the items to `sorted`, by 8 bits of their keys from `shift` on; those that are alike
/// there in the order in which they come.
inline void sort_by_digit(Concurrency concurrency, const Keyed_items& items, int shift,
                          Keyed_items& sorted)
{
  constexpr int digits = 256, min_chunk = 1 << 12;
  const int n = static_cast<int>(items.size()), chunk = (std::max)(min_chunk, n / 64 + 1),
            chunks = (n + chunk - 1) / chunk;
  const auto digit = [&](int i) { return items[i].first >> shift & (digits - 1); };
  Unset_vector<int> first(std::size_t(digits) * chunks); // by digit and chunk
  for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
    int counts[digits] = {};
    for (int i = begin; i < end; ++i) ++counts[digit(i)];
    for (int d = 0; d < digits; ++d) first[d * chunks + begin / chunk] = counts[d];
  });
  exclusive_scan(concurrency, digits * chunks, first.data());
  for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
    int place[digits];
    for (int d = 0; d < digits; ++d) place[d] = first[d * chunks + begin / chunk];
    for (int i = begin; i < end; ++i) sorted[place[digit(i)]++] = items[i];
  });
}

/// Writes the numbers in [0, n) to `order`, by their keys; those of the same key in order.
template <class Key>
void order_by_key(Concurrency concurrency, int n, Key&& key, int* order)
{
  constexpr int begin_bit = 32, end_bit = 64;
  Keyed_items items(n), sorted(n);
  for_each_index(concurrency, n, [&](int i) { items[i] = {key(i), i}; });
  for (int shift = begin_bit; shift < end_bit; shift += 8) {
    sort_by_digit(concurrency, items, shift, sorted);
    items.swap(sorted);
  }
  const auto are_alike = [&](int i, int j) {
    return items[i].first >> begin_bit == items[j].first >> begin_bit;
  };
  for_each_index(concurrency, n, [&](int begin) {
    if (begin > 0 && are_alike(begin - 1, begin)) return; // in a run that begins before
    int end = begin + 1;
    while (end < n && are_alike(begin, end)) ++end;
    std::copy(items.begin() + begin, items.begin() + end, sorted.begin() + begin);
    sort(concurrency, sorted.begin() + begin, sorted.begin() + end);
    for (int k = begin; k < end; ++k) order[k] = sorted[k].second;
  });
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_ORDER_BY_KEY_H
