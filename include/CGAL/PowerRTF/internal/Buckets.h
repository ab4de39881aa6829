// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_BUCKETS_H
#define CGAL_POWER_RTF_INTERNAL_BUCKETS_H

#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// Entries by bucket, in increasing order: those of bucket `b` are `entries[first[b]]` to
/// `entries[first[b + 1] - 1]`.
template <class Entry>
struct Buckets {
  Unset_vector<int> first;
  Unset_vector<Entry> entries;

  /// Item `i` of `n` goes as `entry(i)` into the bucket `bucket(i)` of `number_of_buckets`. Time is
  /// linear in both numbers while the buckets are small.
  template <class Bucket_of, class Entry_of>
  Buckets(Concurrency concurrency, int n, std::size_t number_of_buckets, const Bucket_of& bucket,
          const Entry_of& entry)
      : first(number_of_buckets + 1), entries(n)
  {
    const int buckets = static_cast<int>(number_of_buckets);
    const auto next = [&](int& counter) {
      return concurrency.is_parallel() ? atomic_add(&counter, 1) : counter++;
    };
    for_each_index(concurrency, buckets + 1, [&](int b) { first[b] = 0; });
    for_each_index(concurrency, n, [&](int i) { next(first[bucket(i)]); });
    exclusive_scan(concurrency, buckets + 1, first.data());
    Unset_vector<int> end(number_of_buckets);
    for_each_index(concurrency, buckets, [&](int b) { end[b] = first[b]; });
    for_each_index(concurrency, n, [&](int i) { entries[next(end[bucket(i)])] = entry(i); });
    for_each_index(concurrency, buckets, [&](int b) { // threads come in any order
      std::sort(entries.begin() + first[b], entries.begin() + first[b + 1]);
    });
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_BUCKETS_H
