// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The progress bar and the signals that end a run: the program's visitor of a remeshing run.
#ifndef POWER_RTF_TOOLS_PROGRESS_H
#define POWER_RTF_TOOLS_PROGRESS_H

#include <CGAL/PowerRTF/Remeshing_visitor.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <string>
#include <unistd.h>

namespace tools {

/// The signal received, SIGINT (Ctrl-C) or SIGTERM, or 0. The run ends at the next poll; those of a
/// batch poll on several threads.
inline std::atomic<int> interrupted{0};
static_assert(std::atomic<int>::is_always_lock_free, "a handler of signals writes it");

/// The user cancelled the run, in one of the library's loops or elsewhere; the program ends with
/// exit code 128 + `interrupted`, as is usual in shells.
using Cancelled = CGAL::PowerRTF::internal::Run_cancelled;

/// Lets the first of each signal set `interrupted` and the second end the program at once.
inline void handle_interrupts()
{
  struct sigaction action = {};
  action.sa_handler = [](int signal) { interrupted = signal; };
  action.sa_flags = SA_RESETHAND;
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

inline void stop_if_interrupted()
{
  if (interrupted) throw Cancelled();
}

class Progress : public CGAL::PowerRTF::Remeshing_default_visitor {
public:
  /// Draws on stderr when that is a terminal, unless `quiet`.
  explicit Progress(bool quiet) : m_draws(!quiet && ::isatty(STDERR_FILENO)) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void on_stage(const char* name) { m_stage = name; }
  void on_progress(double done) const { draw(done); }
  bool go_further() const { return !interrupted; }
  void clear() const
  {
    if (m_draws) std::fputs("\r\033[K", stderr);
  }

private:
  void draw(double done) const
  {
    if (!m_draws) return;
    constexpr int width = 40;
    const auto full = static_cast<std::size_t>(width * done);
    const std::string bar = std::string(full, '#') + std::string(width - full, '.');
    std::fprintf(stderr, "\r\033[K%-12s [%s] %3d %%", m_stage.c_str(), bar.c_str(),
                 static_cast<int>(100 * done));
    std::fflush(stderr);
  }

  bool m_draws;
  std::string m_stage;
};

} // namespace tools

#endif // POWER_RTF_TOOLS_PROGRESS_H
