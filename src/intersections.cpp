// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: inputs that intersect themselves.
#include <CGAL/PowerRTF/input/cured_soup_impl.h>

namespace CGAL::PowerRTF::internal {

Polygon_soup cured_soup(const Polygon_soup& soup, const Remeshing_options& options,
                        Intersection_cure& cure, Concurrency concurrency)
{
  return make_cured_soup(soup, options, cure, concurrency);
}

} // namespace CGAL::PowerRTF::internal
