// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for prepare_surface.h.
#ifndef CGAL_POWER_RTF_PREPARE_SURFACE_IMPL_H
#define CGAL_POWER_RTF_PREPARE_SURFACE_IMPL_H

#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/fields/resolution.h>
#include <CGAL/PowerRTF/input/clean_surface.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/prepare_surface.h>

#include <optional>
#include <vector>

namespace CGAL::PowerRTF {

CGAL_POWER_RTF_INLINE Surface prepare_surface(Polygon_soup&& soup,
                                              const std::optional<std::vector<Edge>>& creases,
                                              const std::optional<std::vector<double>>& densities,
                                              const Remeshing_options& options,
                                              Remeshing_report& report,
                                              internal::Concurrency concurrency)
{
  const internal::Stopwatch watch(report.seconds.surface);
  internal::Progress_part part(0.1);
  Surface surface = internal::clean_surface(soup, options.repair, report.repairs, concurrency);
  soup = {}; // its memory
  part.next(0.2);
  Remeshing_options with_number = options;
  const auto set_fields = [&] {
    with_number.number_of_samples = number_of_samples(surface, options, concurrency);
    creases ? set_creases(surface, *creases, concurrency)
            : set_creases(surface, with_number, concurrency);
    densities ? set_density(surface, with_number, *densities, concurrency)
              : set_density(surface, with_number, concurrency);
  };
  part.next(0.75);
  set_fields(); // the density is still uniform
  if (is_number_of_samples_open(options) && !has_uniform_density(surface)) set_fields();
  report.max_distance = max_distance(surface, options, concurrency);
  report.samples_asked = number_of_samples(surface, options, concurrency);
  return surface;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_PREPARE_SURFACE_IMPL_H
