// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_BACKGROUND_WORK_H
#define CGAL_POWER_RTF_INTERNAL_BACKGROUND_WORK_H

#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/task_arena.h>
#include <tbb/task_group.h>
#endif

#include <functional>
#include <memory>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// Work that other threads do beside the one that makes this, as while it waits for a device. Where
/// there are none, `finish()` does it, or nobody.
class Background_work {
public:
  Background_work(Concurrency concurrency, std::function<void()> work) : m_work(std::move(work))
  {
#ifdef CGAL_LINKED_WITH_TBB
    m_is_begun = concurrency.is_parallel();
    if (m_is_begun) m_arena->execute([this] { m_group.run(m_work); });
#else
    (void)concurrency;
#endif
  }
  /// Waits. What the work has thrown is lost.
  ~Background_work()
  {
    try {
      if (m_is_begun) finish();
    } catch (...) {
    }
  }
  Background_work(const Background_work&) = delete;
  Background_work& operator=(const Background_work&) = delete;

  /// Returns when the work is done. Throws what it has thrown. This thread may do a part of it, but
  /// asks no visitor then.
  void finish()
  {
    if (!m_work) return;
    const std::function<void()> work = std::exchange(m_work, nullptr);
#ifdef CGAL_LINKED_WITH_TBB
    if (m_is_begun) {
      const Uninterrupted run;
      m_arena->execute([this] { m_group.wait(); });
      return;
    }
#endif
    work();
  }

private:
#ifdef CGAL_LINKED_WITH_TBB
  /// One for all such work of a thread: its loops do not wait for what is in there. It is kept: on
  /// a busy machine oneTBB does not free an arena whose workers leave late.
  static std::shared_ptr<tbb::task_arena> arena_of_thread()
  {
    thread_local const auto arena = std::make_shared<tbb::task_arena>();
    return arena;
  }
#endif

  std::function<void()> m_work;
  bool m_is_begun = false;
#ifdef CGAL_LINKED_WITH_TBB
  std::shared_ptr<tbb::task_arena> m_arena = arena_of_thread(); // which may end before
  tbb::task_group m_group;
#endif
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_BACKGROUND_WORK_H
