// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How a visitor stops a run in the middle of a stage.
#ifndef CGAL_POWER_RTF_INTERNAL_CANCELLATION_H
#define CGAL_POWER_RTF_INTERNAL_CANCELLATION_H

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// A visitor has stopped the run; thrown by `Cancellation::poll()` and, before the run, by the
/// program's readers.
struct Run_cancelled {};

/// Whether a visitor has the member `on_progress()`, which is optional.
template <class Visitor, class = void>
struct Hears_of_progress : std::false_type {};
template <class Visitor>
struct Hears_of_progress<Visitor, std::void_t<decltype(std::declval<Visitor&>().on_progress(0.))>>
    : std::true_type {};

/// While it lives, loops that may take long, on the thread that made it, tell the visitor how far
/// the stage is and ask it whether the run goes on. Loops on other threads do neither.
class Cancellation {
public:
  template <class Visitor>
  explicit Cancellation(Visitor& visitor)
      : m_on_stage([&visitor](const char* name) { visitor.on_stage(name); }),
        m_on_progress([&visitor](double done) {
          if constexpr (Hears_of_progress<Visitor>::value) visitor.on_progress(done);
          (void)visitor, (void)done;
        }),
        m_go_further([&visitor] { return bool(visitor.go_further()); }), m_outer(current())
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
  /// The same for what takes a few nanoseconds, as comparisons do.
  static void poll_now_and_then()
  {
    thread_local unsigned calls = 0;
    if (++calls % 4096 == 0) poll();
  }
  /// The same as `poll()` when `done` of `all` steps of the innermost `Progress_part` are done.
  static void poll(std::size_t done, std::size_t all)
  {
    Cancellation* const cancellation = current();
    if (!cancellation) return;
    if (cancellation->m_is_in_part)
      cancellation->advance(static_cast<double>(done) / static_cast<double>(all));
    cancellation->ask();
  }

private:
  friend class Progress_part;
  friend class Stage;
  friend class Uninterrupted;

  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds interval{50};

  static Cancellation*& current()
  {
    thread_local Cancellation* innermost = nullptr;
    return innermost;
  }

  /// `done`: of the innermost part. Progress never falls.
  void advance(double done)
  {
    m_done = (std::max)(m_done, m_begin + (m_end - m_begin) * (std::min)(done, 1.));
  }

  void ask()
  {
    const Clock::time_point now = Clock::now();
    if (now - m_last < interval) return;
    m_last = now;
    m_on_progress(m_done);
    if (!m_go_further()) throw Run_cancelled();
  }

  std::function<void(const char*)> m_on_stage;
  std::function<void(double)> m_on_progress;
  std::function<bool()> m_go_further;
  Cancellation* m_outer;
  Clock::time_point m_last = Clock::now();
  double m_done = 0;             // of the stage
  double m_begin = 0, m_end = 1; // of the innermost part
  bool m_is_in_part = false;
};

/// While it lives, loops on the thread that made it ask nobody: what has begun comes to its end.
class Uninterrupted {
public:
  Uninterrupted() : m_run(std::exchange(Cancellation::current(), nullptr)) {}
  ~Uninterrupted() { Cancellation::current() = m_run; }
  Uninterrupted(const Uninterrupted&) = delete;
  Uninterrupted& operator=(const Uninterrupted&) = delete;

private:
  Cancellation* m_run;
};

/// While it lives, loops lead the progress of the stage on to `end`, a share of the part around it,
/// or of the stage. The loops of chunks in parallel.h do so by themselves: each goes half of the
/// way that is left, as nobody knows how many there are. Parts end in the order in which they
/// began, the last one first; each polls as it begins.
class Progress_part {
public:
  explicit Progress_part(double end) : m_run(Cancellation::current())
  {
    if (!m_run) return;
    m_run->ask();
    m_was_in_part = std::exchange(m_run->m_is_in_part, true);
    begin(end);
  }
  /// That of a loop in a part; outside of all parts, where nobody knows how far it leads, nothing.
  Progress_part() : m_run(Cancellation::current())
  {
    if (m_run && !m_run->m_is_in_part) m_run = nullptr;
    if (!m_run) return;
    m_run->m_begin = m_run->m_done;
    m_run->m_end = (m_run->m_done + m_outer_end) / 2;
  }
  ~Progress_part()
  {
    if (!m_run) return;
    m_run->advance(1);
    m_run->m_begin = m_outer_begin;
    m_run->m_end = m_outer_end;
    m_run->m_is_in_part = m_was_in_part;
  }
  Progress_part(const Progress_part&) = delete;
  Progress_part& operator=(const Progress_part&) = delete;

  /// Ends the part and begins another one, up to `end`.
  void next(double end)
  {
    if (!m_run) return;
    m_run->advance(1);
    m_run->ask();
    begin(end);
  }

private:
  void begin(double end)
  {
    m_run->m_begin = m_run->m_done;
    m_run->m_end = m_outer_begin + (m_outer_end - m_outer_begin) * (std::min)(end, 1.);
  }

  Cancellation* m_run;
  double m_outer_begin = m_run ? m_run->m_begin : 0, m_outer_end = m_run ? m_run->m_end : 1;
  bool m_was_in_part = true;
};

/// Calls `run()`. Returns whether it came to its end: `visitor` did not stop it.
template <class Visitor, class Run>
bool run_unless_cancelled(Visitor& visitor, Run&& run)
{
  try {
    const Cancellation cancellation(visitor);
    run();
    return true;
  } catch (const Run_cancelled&) {
    return false;
  }
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_CANCELLATION_H
