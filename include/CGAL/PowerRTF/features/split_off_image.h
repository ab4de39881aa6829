// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A symmetric surface is remeshed by its half, with so many samples that they and their images,
// those on the plane counted once, are as many as are asked for.
#ifndef CGAL_POWER_RTF_FEATURES_SPLIT_OFF_IMAGE_H
#define CGAL_POWER_RTF_FEATURES_SPLIT_OFF_IMAGE_H

#include <CGAL/PowerRTF/features/find_mirror.h>
#include <CGAL/PowerRTF/features/half_surface.h>
#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/geometry/component_topology.h>
#include <CGAL/PowerRTF/geometry/output_grid.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace CGAL::PowerRTF {

namespace internal {

/// How many of `n` samples of the whole lie on the plane of `half`, as their spacing gives it.
/// \throws Invalid_input_error those that its half gets are too few
inline std::size_t samples_at_mirror(const Surface& half, std::size_t n, Concurrency concurrency)
{
  constexpr int rounds = 3; // they depend on how many the half gets, and that on them, a little
  try {
    const Cut_surface cut = cut_along_creases(half);
    std::size_t count = n;
    for (int round = 0; round < rounds; ++round) {
      const Feature_samples features = sample_features(half, cut, (n + count) / 2);
      count = std::count_if(features.samples.points.begin(), features.samples.points.end(),
                            [&](const Vec3d& p) { return half.is_at_mirror(p); });
    }
    require_enough_samples(half, (n + count) / 2, concurrency);
    return count;
  } catch (const Invalid_input_error& e) {
    throw Invalid_input_error(std::string("of one half: ") + e.what());
  }
}

} // namespace internal

/// If a symmetry is asked for, makes `surface` its half, and the number of samples in `options`
/// that of the half.
/// \param report gets the plane, and the number of samples of the whole
/// \returns the whole; none if no symmetry is asked for
/// \throws Invalid_input_error as `find_mirror()` and `half_surface()`; sheets of the surface meet;
///   there are too few samples; or an odd number, and none of them can lie on the plane
inline std::optional<Surface> split_off_image(Surface& surface, Remeshing_options& options,
                                              Remeshing_report& report,
                                              internal::Concurrency concurrency = Sequential_tag())
{
  if (options.symmetry == Symmetry::none) return std::nullopt;
  if (surface.is_closed_up())
    throw Invalid_input_error("symmetry is for surfaces whose sheets do not meet each other");
  std::size_t& n = options.number_of_samples;
  set_output_grid(surface, options);
  const double spacing = std::sqrt(surface.area / static_cast<double>(n));
  const Mirror_plane mirror =
      find_mirror(surface, options.symmetry, spacing, report.symmetry, concurrency);
  Surface half = half_surface(surface, mirror, concurrency);
  std::size_t on_plane = internal::samples_at_mirror(half, n, concurrency);
  if ((n + on_plane) % 2 == 1) {
    if (on_plane > 0)
      ++on_plane;
    else if (is_number_of_samples_open(options) || is_distance_asked_for(options))
      ++n;
    else
      throw Invalid_input_error("the surface does not meet its plane of symmetry, so that the "
                                "number of samples has to be even, but it is " +
                                std::to_string(n));
  }
  report.samples_asked = n;
  half.mirror_samples = on_plane;
  n = (n + on_plane) / 2;
  return std::exchange(surface, std::move(half));
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_SPLIT_OFF_IMAGE_H
