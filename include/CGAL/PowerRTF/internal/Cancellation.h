// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a visitor stops a run in the middle of a stage.
#ifndef CGAL_POWER_RTF_INTERNAL_CANCELLATION_H
#define CGAL_POWER_RTF_INTERNAL_CANCELLATION_H

#include <chrono>
#include <functional>

namespace CGAL::PowerRTF::internal {

/// A visitor has stopped the run; thrown by `Cancellation::poll()` and, before the run, by the
/// program's readers.
struct Run_cancelled {};

/// While it lives, loops that may take long, on the thread that made it, ask the visitor whether
/// the run goes on. Loops on other threads do not ask.
class Cancellation {
public:
  /// \param visitor is asked by `go_further()`
  template <class Visitor>
  explicit Cancellation(Visitor& visitor)
      : m_go_further([&visitor] { return bool(visitor.go_further()); }), m_outer(current())
  {
    current() = this;
  }
  ~Cancellation() { current() = m_outer; }
  Cancellation(const Cancellation&) = delete;
  Cancellation& operator=(const Cancellation&) = delete;

  /// To be called about every microsecond or less often. \throws Run_cancelled
  static void poll()
  {
    if (Cancellation* const cancellation = current()) cancellation->ask();
  }

private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds interval{50};

  static Cancellation*& current()
  {
    thread_local Cancellation* innermost = nullptr;
    return innermost;
  }

  void ask()
  {
    const Clock::time_point now = Clock::now();
    if (now - m_last < interval) return;
    m_last = now;
    if (!m_go_further()) throw Run_cancelled();
  }

  std::function<bool()> m_go_further;
  Cancellation* m_outer;
  Clock::time_point m_last = Clock::now();
};

/// Calls `stage()`. Returns whether it came to its end: `visitor` did not stop it.
template <class Visitor, class Stage>
bool run_unless_cancelled(Visitor& visitor, Stage&& stage)
{
  try {
    const Cancellation cancellation(visitor);
    stage();
    return true;
  } catch (const Run_cancelled&) {
    return false;
  }
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_CANCELLATION_H
