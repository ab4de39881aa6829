// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The files that a run writes.
#ifndef POWER_RTF_TOOLS_OUTPUTS_H
#define POWER_RTF_TOOLS_OUTPUTS_H

#include "Progress.h"
#include "output_file.h"

#include <list>
#include <string>

namespace tools {

/// The files of one run. All of them appear at the end, or none.
class Outputs {
public:
  template <class Write>
  void add(const std::string& file, Write&& write)
  {
    if (file.empty()) return;
    m_files.emplace_back(file);
    try {
      write(m_files.back().stream());
    } catch (const Output_error& e) {
      throw Output_error(file + ": cannot be written: " + e.what());
    }
    stop_if_interrupted();
    m_files.back().close();
  }
  void commit()
  {
    for (Output_file& file : m_files) file.commit();
  }

private:
  std::list<Output_file> m_files;
};

} // namespace tools

#endif // POWER_RTF_TOOLS_OUTPUTS_H
