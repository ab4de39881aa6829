// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_STAGE_H
#define CGAL_POWER_RTF_INTERNAL_STAGE_H

#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/Stopwatch.h>

#include <exception>
#include <optional>

namespace CGAL::PowerRTF::internal {

/// A stage of a run, as long as it lives. The visitor of the innermost `Cancellation` hears of it
/// and of its progress, which ends at 1 unless an exception ends it.
class Stage {
public:
  explicit Stage(const char* name) : m_run(Cancellation::current())
  {
    if (!m_run) return;
    m_run->m_on_stage(name);
    tell(0);
  }
  /// The same, which adds its seconds to a total.
  Stage(const char* name, double& seconds) : Stage(name) { m_watch.emplace(seconds); }
  ~Stage() noexcept(false)
  {
    if (m_run && std::uncaught_exceptions() == m_exceptions) tell(1);
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

private:
  void tell(double done)
  {
    m_run->m_done = done;
    m_run->m_on_progress(done);
  }

  Cancellation* m_run;
  std::optional<Stopwatch> m_watch;
  int m_exceptions = std::uncaught_exceptions();
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_STAGE_H
