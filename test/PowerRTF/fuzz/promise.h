// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a fuzz target asserts, whatever the build type.
#ifndef CGAL_POWER_RTF_TEST_FUZZ_PROMISE_H
#define CGAL_POWER_RTF_TEST_FUZZ_PROMISE_H

#include <cstdlib>
#include <iostream>
#include <string>

namespace fuzz {

/// Ends the program, as a fuzzing engine expects it of a failure, where a promise is not kept.
inline void promise(bool is_kept, const std::string& what)
{
  if (is_kept) return;
  std::cerr << "broken: " << what << std::endl;
  std::abort();
}

} // namespace fuzz

#endif // CGAL_POWER_RTF_TEST_FUZZ_PROMISE_H
