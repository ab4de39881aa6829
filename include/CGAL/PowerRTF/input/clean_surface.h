// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a polygon soup to the surface that is remeshed.
#ifndef CGAL_POWER_RTF_INPUT_CLEAN_SURFACE_H
#define CGAL_POWER_RTF_INPUT_CLEAN_SURFACE_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/Build_surface.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/input/Polygon_soup.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>

namespace CGAL::PowerRTF::internal {

/// What `import_surface()` and `import_soup()` share: the surface of the first attempt to repair
/// the soup that succeeds. `build`: what makes it where nothing has to be repaired; or empty.
/// \throws Invalid_input_error there is none
Surface clean_surface(const Polygon_soup& soup, Repair repair, Non_manifold non_manifold,
                      Repair_counts& repairs, Concurrency concurrency = Sequential_tag(),
                      const Build_surface& build = {});

} // namespace CGAL::PowerRTF::internal

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/input/clean_surface_impl.h>
#endif

#endif // CGAL_POWER_RTF_INPUT_CLEAN_SURFACE_H
