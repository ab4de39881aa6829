// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Inputs that intersect themselves, cured: their facets cut where they meet, or all of them
// wrapped. That takes much of CGAL, which takes long to compile: PowerRTF::core has it, and other
// programs have it where one of their files includes <CGAL/PowerRTF/intersections.h>.
#ifndef CGAL_POWER_RTF_INPUT_CURED_SOUP_H
#define CGAL_POWER_RTF_INPUT_CURED_SOUP_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/input/Polygon_soup.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>

namespace CGAL::PowerRTF::internal {

#ifdef CGAL_POWER_RTF_COMPILED

/// What `options.intersections`, which is not `keep`, makes of a soup. `cure` tells what that was.
/// \throws Invalid_input_error the soup has no area; or its intersections cannot be resolved
Polygon_soup cured_soup(const Polygon_soup& soup, const Remeshing_options& options,
                        Intersection_cure& cure, Concurrency concurrency);

#else

using Soup_curer = Polygon_soup (*)(const Polygon_soup&, const Remeshing_options&,
                                    Intersection_cure&, Concurrency);
/// Set by <CGAL/PowerRTF/intersections.h>.
inline Soup_curer soup_curer = nullptr;

inline Polygon_soup cured_soup(const Polygon_soup& soup, const Remeshing_options& options,
                               Intersection_cure& cure, Concurrency concurrency)
{
  if (soup_curer == nullptr)
    throw Invalid_input_error("intersections can be resolved or wrapped only in programs that "
                              "link PowerRTF::core or include <CGAL/PowerRTF/intersections.h>");
  return soup_curer(soup, options, cure, concurrency);
}

#endif

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INPUT_CURED_SOUP_H
