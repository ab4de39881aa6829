// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_STOPWATCH_H
#define CGAL_POWER_RTF_INTERNAL_STOPWATCH_H

#include <chrono>

namespace CGAL::PowerRTF::internal {

/// Adds the wall-clock seconds of its own lifetime to a total.
class Stopwatch {
public:
  explicit Stopwatch(double& total) : m_total(total), m_start(Clock::now()) {}
  ~Stopwatch() { m_total += std::chrono::duration<double>(Clock::now() - m_start).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

private:
  using Clock = std::chrono::steady_clock;
  double& m_total;
  Clock::time_point m_start;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_STOPWATCH_H
