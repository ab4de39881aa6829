// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_MEANWHILE_H
#define CGAL_POWER_RTF_INTERNAL_MEANWHILE_H

#include <functional>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// Work for the time in which the thread that made it waits for a device; of several, that made
/// last comes first. Where none is waited for, `finish()` does it, or nobody.
class Meanwhile {
public:
  explicit Meanwhile(std::function<void()> work)
      : m_work(std::move(work)), m_outer(std::exchange(innermost(), this))
  {}
  ~Meanwhile() { innermost() = m_outer; }
  Meanwhile(const Meanwhile&) = delete;
  Meanwhile& operator=(const Meanwhile&) = delete;

  /// Does the work unless it is done.
  void finish()
  {
    if (m_work) std::exchange(m_work, nullptr)();
  }

  /// To be called where a device has been given what takes long, before it is waited for.
  static void run()
  {
    Meanwhile* some = innermost();
    while (some && !some->m_work) some = some->m_outer;
    if (some) some->finish();
  }

private:
  static Meanwhile*& innermost()
  {
    thread_local Meanwhile* some = nullptr;
    return some;
  }

  std::function<void()> m_work;
  Meanwhile* m_outer;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_MEANWHILE_H
