// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef POWER_RTF_TEST_WITH_THREADS_H
#define POWER_RTF_TEST_WITH_THREADS_H

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

/// Calls `f()` where loops may use so many threads, whatever the machine has.
template <class F>
void with_threads(int threads, const F& f)
{
#ifdef CGAL_LINKED_WITH_TBB
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, threads);
  tbb::task_arena arena(threads);
  arena.execute(f);
#else
  (void)threads;
  f();
#endif
}

#endif // POWER_RTF_TEST_WITH_THREADS_H
