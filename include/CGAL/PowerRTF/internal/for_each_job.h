// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole runs side by side: each has an arena of its own, so that a thread that waits in a loop of
// its run takes no other run up, nor the loops of one.
#ifndef CGAL_POWER_RTF_INTERNAL_FOR_EACH_JOB_H
#define CGAL_POWER_RTF_INTERNAL_FOR_EACH_JOB_H

#include <CGAL/PowerRTF/internal/parallel.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// The threads that loops on this one may use, itself included.
inline int usable_threads(Concurrency concurrency)
{
#ifdef CGAL_LINKED_WITH_TBB
  if (concurrency.is_parallel()) {
    using tbb::global_control;
    const auto allowed = global_control::active_value(global_control::max_allowed_parallelism);
    return std::min(tbb::this_task_arena::max_concurrency(), static_cast<int>(allowed));
  }
#endif
  (void)concurrency;
  return 1;
}

/// Calls `f(i)` for i in [0, n), begun in this order, on as many threads as loops may use, but at
/// most `most` at once. While more jobs wait than there are threads, each has one thread, which
/// loses no time to the others; the last ones share those that are free. As long as this thread
/// waits for others, it calls `idle()`, again and again. Neither throws.
template <class F, class Idle>
void for_each_job(Concurrency concurrency, int n, int most, F&& f, Idle&& idle)
{
#ifdef CGAL_LINKED_WITH_TBB
  const int threads = usable_threads(concurrency);
  if (threads > 1 && most > 1) {
    std::atomic<int> begun{0}, ended{0};
    const std::thread::id caller = std::this_thread::get_id();
    const auto work = [&] {
      // For all jobs of the thread: oneTBB need not free an arena, see Background_work.h.
      tbb::task_arena alone(1), shared(threads);
      for (int i = begun++; i < n; i = begun++) {
        (n - i > threads && most >= threads ? alone : shared).execute([&] { f(i); });
        ++ended;
      }
      while (std::this_thread::get_id() == caller && ended < n) {
        idle();
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    };
    using Work = decltype(work);
    for_each_task(
        concurrency, std::min({n, threads, most}),
        [](const void* w, int) { (*static_cast<Work*>(w))(); }, &work);
    return;
  }
#endif
  (void)concurrency, (void)most, (void)idle;
  for (int i = 0; i < n; ++i) f(i);
}
template <class F>
void for_each_job(Concurrency concurrency, int n, F&& f)
{
  for_each_job(concurrency, n, n, std::forward<F>(f), [] {});
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_FOR_EACH_JOB_H
