// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole runs side by side, of which the first that succeeds is wanted.
#ifndef CGAL_POWER_RTF_INTERNAL_FIND_FIRST_H
#define CGAL_POWER_RTF_INTERNAL_FIND_FIRST_H

#include <CGAL/PowerRTF/internal/for_each_job.h>

#include <atomic>
#include <exception>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The first i in [0, n) of which `holds(i, is_needed)`, or n; at most `most` of them at once. As
/// soon as `is_needed()` is false, for one of the others holds before it, what it returns does not
/// matter. What is thrown is thrown by this, unless one before it holds: the outcome is that of a
/// loop. `idle()`: see `for_each_job()`.
template <class Holds, class Idle>
int find_first(Concurrency concurrency, int n, int most, const Holds& holds, const Idle& idle)
{
  std::atomic<int> first{n};
  std::vector<std::exception_ptr> errors(n);
  const auto job = [&](int i) {
    const auto is_needed = [&first, i] { return i < first; };
    if (!is_needed()) return;
    try {
      if (!holds(i, is_needed)) return;
    } catch (...) {
      errors[i] = std::current_exception();
    }
    for (int before = first; i < before && !first.compare_exchange_weak(before, i);) {
    }
  };
  for_each_job(concurrency, n, most, job, idle);
  if (first < n && errors[first]) std::rethrow_exception(errors[first]);
  return first;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_FIND_FIRST_H
