// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_BUCKETS_H
#define CGAL_POWER_RTF_INTERNAL_BUCKETS_H

#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Entries by bucket, in increasing order: those of bucket `b` are `entries[first[b]]` to
/// `entries[first[b + 1] - 1]`.
template <class Entry>
struct Buckets {
  Unset_vector<int> first;
  Unset_vector<Entry> entries;

  Buckets() = default;

  /// Item `i` of `n` goes as `entry(i)` into the bucket `bucket(i)` of `number_of_buckets`. Time is
  /// linear in both numbers while the buckets are small.
  template <class Bucket_of, class Entry_of>
  Buckets(Concurrency concurrency, int n, std::size_t number_of_buckets, const Bucket_of& bucket,
          const Entry_of& entry)
      : first(number_of_buckets + 1), entries(n)
  {
    const int buckets = static_cast<int>(number_of_buckets);
    struct Item {
      int item, bucket;
    };
    // Fills buckets `begin` to `end - 1` with `item(k)` for k in [k_begin, k_end).
    const auto fill = [&](int begin, int end, int k_begin, int k_end, const auto& item) {
      std::vector<int> next(end - begin + 1, 0);
      for (int k = k_begin; k < k_end; ++k) ++next[item(k).bucket - begin + 1];
      next[0] = k_begin;
      std::partial_sum(next.begin(), next.end(), next.begin());
      for (int b = begin; b < end; ++b) first[b] = next[b - begin];
      for (int k = k_begin; k < k_end; ++k) {
        const Item i = item(k);
        entries[next[i.bucket - begin]++] = entry(i.item);
      }
      for (int b = begin; b < end; ++b)
        std::sort(entries.begin() + first[b], entries.begin() + next[b - begin]);
    };
    first[buckets] = n;
    const int most = concurrency.is_parallel() ? std::clamp(n / 1024, 1, 128) : 1;
    if (most == 1) {
      fill(0, buckets, 0, n, [&](int i) { return Item{i, bucket(i)}; });
      return;
    }
    // Items come into parts of consecutive buckets first: no two threads count in the same memory.
    int shift = 0;
    while (buckets > most << shift) ++shift;
    const int parts = (buckets + (1 << shift) - 1) >> shift;
    const int chunk = 1 + n / most, chunks = (n + chunk - 1) / chunk;
    std::vector<int> places(parts * chunks + 1, 0); // of the items of a chunk in a part
    const auto place = [&](int part, int c) { return places.begin() + part * chunks + c; };
    for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
      std::vector<int> counts(parts, 0);
      for (int i = begin; i < end; ++i) ++counts[bucket(i) >> shift];
      for (int p = 0; p < parts; ++p) *place(p, begin / chunk) = counts[p];
    });
    exclusive_scan(concurrency, static_cast<int>(places.size()), places.data());
    Unset_vector<Item> items(n);
    for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
      std::vector<int> next(parts);
      for (int p = 0; p < parts; ++p) next[p] = *place(p, begin / chunk);
      for (int i = begin; i < end; ++i) {
        const int b = bucket(i);
        items[next[b >> shift]++] = {i, b};
      }
    });
    for_each_chunk(concurrency, buckets, 1 << shift, [&](int begin, int end) {
      const int part = begin >> shift;
      fill(begin, end, *place(part, 0), *place(part + 1, 0), [&](int k) { return items[k]; });
    });
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_BUCKETS_H
