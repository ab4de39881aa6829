// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The largest amount of memory that the process holds, above what it held before.
#ifndef POWER_RTF_BENCHMARK_PEAK_MEMORY_H
#define POWER_RTF_BENCHMARK_PEAK_MEMORY_H

#include <fstream>
#include <string>

#if defined(__GLIBC__) // from here on it is known
#include <malloc.h>
#endif

/// From its construction on. Linux only (/proc); elsewhere not `known()`.
class Peak_memory {
public:
  Peak_memory()
  {
#if defined(__GLIBC__)
    malloc_trim(0); // what was freed before would hide what comes
#endif
    std::ofstream reset("/proc/self/clear_refs");
    reset << "5" << std::flush; // the peak becomes what is held now
    m_known = bool(reset);
    m_before = status("VmRSS:");
  }

  bool known() const { return m_known && m_before > 0; }
  double bytes() const { return status("VmHWM:") - m_before; }

private:
  static double status(const std::string& key)
  {
    std::ifstream file("/proc/self/status");
    std::string word;
    double kilobytes = 0;
    while (file >> word)
      if (word == key) file >> kilobytes;
    return 1024 * kilobytes;
  }

  bool m_known;
  double m_before;
};

#endif // POWER_RTF_BENCHMARK_PEAK_MEMORY_H
