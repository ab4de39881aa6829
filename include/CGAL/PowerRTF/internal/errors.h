// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_ERRORS_H
#define CGAL_POWER_RTF_INTERNAL_ERRORS_H

#include <stdexcept>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFRef
/// The input mesh or a parameter cannot be used; `what()` says why.
class Invalid_input_error : public std::invalid_argument {
public:
  using std::invalid_argument::invalid_argument;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INTERNAL_ERRORS_H
