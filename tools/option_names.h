// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The names of the remesher's parameters on the command line and in the JSON report.
#ifndef POWER_RTF_TOOLS_OPTION_NAMES_H
#define POWER_RTF_TOOLS_OPTION_NAMES_H

#include <CGAL/PowerRTF/option_table.h>

#include <algorithm>
#include <map>
#include <string>

namespace tools {

/// The member's name, with dashes.
inline std::string member_name(const CGAL::PowerRTF::Option& option)
{
  std::string name = option.name;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

/// The option's name: the member's, or a shorter one.
inline std::string option_name(const CGAL::PowerRTF::Option& option)
{
  static const std::map<std::string, std::string> shorter{{"number-of-samples", "samples"},
                                                          {"random-seed", "seed"},
                                                          {"feature-angle", "features"},
                                                          {"merge-distance", "merge"},
                                                          {"max-iterations", "iterations"}};
  const std::string name = member_name(option);
  const auto found = shorter.find(name);
  return found == shorter.end() ? name : found->second;
}

} // namespace tools

#endif // POWER_RTF_TOOLS_OPTION_NAMES_H
