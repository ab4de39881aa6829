// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A run's progress for Python, and Python's interrupts (Ctrl-C) for the run.
#ifndef POWER_RTF_PYTHON_PYTHON_VISITOR_H
#define POWER_RTF_PYTHON_PYTHON_VISITOR_H

#include <CGAL/PowerRTF/Remeshing_visitor.h>

#include <nanobind/nanobind.h>

#include <exception>
#include <string>

namespace powerrtf {

namespace nb = nanobind;

/// Is called on the thread that began the run, without the GIL. An exception of Python's stops the
/// run and is kept.
class Python_visitor : public CGAL::PowerRTF::Remeshing_default_visitor {
public:
  /// \param progress is called with the share of the stage that is done and its name; or `None`
  explicit Python_visitor(nb::object progress) : m_progress(std::move(progress)) {}

  void on_stage(const char* name) { m_stage = name; }
  void on_progress(double done)
  {
    if (m_progress.is_none()) return;
    guarded([&] { m_progress(done, m_stage); });
  }
  bool go_further()
  {
    guarded([] {
      if (PyErr_CheckSignals() != 0) throw nb::python_error();
    });
    return !m_error;
  }
  /// Throws what has stopped the run.
  void rethrow() const
  {
    if (m_error) std::rethrow_exception(m_error);
  }

private:
  template <class Call>
  void guarded(const Call& call)
  {
    if (m_error) return;
    const nb::gil_scoped_acquire acquire;
    try {
      call();
    } catch (const nb::python_error&) {
      m_error = std::current_exception();
    }
  }

  nb::object m_progress;
  std::string m_stage;
  std::exception_ptr m_error;
};

} // namespace powerrtf

#endif // POWER_RTF_PYTHON_PYTHON_VISITOR_H
