// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_EXTRACTION_IMPROVE_MESH_H
#define CGAL_POWER_RTF_EXTRACTION_IMPROVE_MESH_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/extraction/delaunay_flips.h>
#include <CGAL/PowerRTF/extraction/improvement/fit_to_surface.h>
#include <CGAL/PowerRTF/extraction/improvement/mend_stars.h>
#include <CGAL/PowerRTF/extraction/improvement/smooth_stars.h>

#include <cstdlib>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{

inline void improve_mesh(const Surface& surface, const Remeshing_options&, Extracted_mesh& mesh)
{
  const internal::Surface_guide guide(surface);
  const std::vector<char> locked(mesh.points.size(), 0);
  internal::Star_mesh stars(mesh, guide, locked);
  internal::Edge_flipper flipper(stars.working(), -0.7);
  internal::Star_smoother smoother(stars);
  const int rounds = getenv("ROUNDS") ? atoi(getenv("ROUNDS")) : 5;
  for (int round = 0; round < rounds; ++round) {
    for (const auto e : stars.working().mesh.edges())
      if (stars.is_free(e)) flipper.push(e);
    flipper.run(20 * stars.working().mesh.number_of_edges());
    smoother.sweep();
  }
  internal::Star_mender(stars, flipper).run(getenv("MEND")?atoi(getenv("MEND")):8);
  const int fits = getenv("FIT") ? atoi(getenv("FIT")) : 1;
  for (int i = 0; i < fits; ++i) {
    internal::Surface_fitter(stars).run();
    internal::Star_mender(stars, flipper).run(getenv("MEND")?atoi(getenv("MEND")):8);
  }
  stars.write(mesh);
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_IMPROVE_MESH_H
