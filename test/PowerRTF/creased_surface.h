// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A shape as the remesher sees it, with its creases.
#ifndef CGAL_POWER_RTF_TEST_CREASED_SURFACE_H
#define CGAL_POWER_RTF_TEST_CREASED_SURFACE_H

#include "shapes.h"

#include <CGAL/PowerRTF/features/sample_features.h>

#include <cstddef>

namespace shapes {

/// With the creases that are found for `n` samples.
inline Surface with_creases(const Soup& soup, std::size_t n)
{
  Surface surface = make_surface(soup);
  CGAL::PowerRTF::Remeshing_options options;
  options.number_of_samples = n;
  CGAL::PowerRTF::set_creases(surface, options);
  return surface;
}

} // namespace shapes

#endif // CGAL_POWER_RTF_TEST_CREASED_SURFACE_H
