// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A spacing that follows the width of narrow strips between creases: chamfers, ribs, rims of
// plates. Triangles are round there if whole rows of them fit in; where there is room for one row
// only, if they are not much longer than it is wide.
#ifndef CGAL_POWER_RTF_FEATURES_REFINE_NARROW_PATCHES_H
#define CGAL_POWER_RTF_FEATURES_REFINE_NARROW_PATCHES_H

#include <CGAL/PowerRTF/features/narrow_patches.h>
#include <CGAL/PowerRTF/fields/limited_spacing.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

/// The largest spacing on a patch where that would be `spacing`.
/// \param most_rows of triangles, to which their height is fitted
inline double strip_limit(const Patch_shape& patch, double spacing, int most_rows)
{
  // In one row triangles are equilateral at 2 / sqrt(3) = 1.15 times the width. But finer curves
  // take samples from their other sides, and rows of another spacing end there: on a gear with
  // chamfers the mean Q over all is best at 1.4 (1.15: .902, 1.3: .924, 1.4: .924, 1.5: .921).
  constexpr double spacing_over_width = 1.4, row = 0.8660254037844386; // height over spacing
  constexpr double least_rows = 3, least_aspect = 3;
  const auto [width, length] = patch.strip();
  const double rows = std::round(width / (row * spacing));
  if (rows <= 1) return spacing_over_width * width;
  // of about the same width everywhere, as far as that is known
  const bool is_strip =
      length >= least_aspect * width && (patch.loops == 2 || patch.flat_area() > 0);
  if (!is_strip || rows < least_rows || rows > most_rows)
    return std::numeric_limits<double>::infinity();
  return width / (row * rows);
}

/// \returns whether the spacing is within the limits
inline bool refine_strips(Surface& surface, std::size_t n, double gradation,
                          const Crease_patches& patches, int most_rows, Concurrency concurrency)
{
  constexpr std::size_t facets_per_sample = 16; // slivers between creases would take any number
  const Spacing_bounds bounds{0.25, most_rows > 1 ? 1.12 : 2, 1.5, true,
                              surface.triangles.size() + facets_per_sample * n};
  std::vector<int> patch_of = patches.of_facet;
  return refine_within_limits(
      surface, bounds,
      [&] {
        Limited_spacing result(surface, n, gradation, concurrency);
        std::vector<double> limits(patch_of.size());
        for (std::size_t f = 0; f < limits.size(); ++f) {
          const double spacing = result.spacing(static_cast<int>(f));
          limits[f] = (std::max)(strip_limit(patches.shapes[patch_of[f]], spacing, most_rows),
                                 bounds.least_share * spacing);
        }
        result.set_limits(std::move(limits));
        return result;
      },
      [&](const std::vector<int>& parents) {
        std::vector<int> of_pieces(parents.size());
        for (std::size_t f = 0; f < parents.size(); ++f) of_pieces[f] = patch_of[parents[f]];
        patch_of.swap(of_pieces);
      },
      concurrency);
}

} // namespace internal

/// Brings the spacing of `n` samples by `surface.vertex_density` within 1.4 times the width of the
/// patches between creases, and, where these are bands, or flat strips, with room for three or four
/// rows of triangles, so far down that the nearest whole number of rows fits in. The spacing
/// elsewhere becomes up to 1.12 times as large for that, and facets that are too large are split.
/// Where that does not suffice, those with several rows stay, and it may become twice as large;
/// where that does not, all stay. A surface without such patches stays, too.
/// \param gradation the largest growth of the spacing around such patches; 0: any
inline void refine_narrow_patches(Surface& surface, std::size_t n, double gradation,
                                  internal::Concurrency concurrency = Sequential_tag())
{
  if (surface.creases.empty()) return;
  const internal::Crease_patches patches(surface);
  for (const int most_rows : {4, 1}) {
    Surface refined = surface;
    if (!internal::refine_strips(refined, n, gradation, patches, most_rows, concurrency)) continue;
    surface = std::move(refined);
    return;
  }
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_REFINE_NARROW_PATCHES_H
