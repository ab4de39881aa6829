// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes to improve, as the extraction leaves them.
#ifndef CGAL_POWER_RTF_TEST_IMPROVEMENT_CASE_H
#define CGAL_POWER_RTF_TEST_IMPROVEMENT_CASE_H

#include "shapes.h"

#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/fields/smooth_normals.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <cstddef>

namespace improvement_case {

using namespace CGAL::PowerRTF;

struct Case {
  Surface surface;
  Extracted_mesh raw;
};

inline Case make_case(const shapes::Soup& soup, std::size_t n, unsigned seed,
                      Sampling sampling = Sampling::elimination)
{
  Case c{shapes::make_surface(soup), {}};
  Remeshing_options o;
  o.number_of_samples = n;
  o.random_seed = seed;
  o.sampling = sampling;
  smooth_normals(c.surface, n, o.normal_smoothing);
  c.raw = extract_by_insertion(c.surface, sample_surface(c.surface, o));
  return c;
}

} // namespace improvement_case

#endif // CGAL_POWER_RTF_TEST_IMPROVEMENT_CASE_H
