// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_FIELDS_SURFACE_WORK_H
#define CGAL_POWER_RTF_FIELDS_SURFACE_WORK_H

#include <CGAL/PowerRTF/fields/Compute_density.h>
#include <CGAL/PowerRTF/fields/Diffuse_normals.h>
#include <CGAL/PowerRTF/geometry/Arrange_facets.h>
#include <CGAL/PowerRTF/geometry/Bring_facets.h>
#include <CGAL/PowerRTF/geometry/Build_surface.h>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFSurface
/// What is done to a surface before there is an engine, where such an engine works. What is empty
/// is done by the host.
struct Surface_work {
  Build_surface build;
  Bring_facets bring_facets;
  Arrange_facets arrange_facets;
  Compute_density compute_density;
  Diffuse_normals diffuse_normals;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_SURFACE_WORK_H
