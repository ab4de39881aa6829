// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A spacing that follows the width of narrow strips between creases: chamfers, ribs, flanks of
// teeth. There is room for one row of triangles only, and where they are much longer than it is
// wide none is round.
#ifndef CGAL_POWER_RTF_FEATURES_REFINE_NARROW_PATCHES_H
#define CGAL_POWER_RTF_FEATURES_REFINE_NARROW_PATCHES_H

#include <CGAL/PowerRTF/features/narrow_patches.h>
#include <CGAL/PowerRTF/fields/limited_spacing.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// Brings the spacing of `n` samples by `surface.vertex_density` within 1.4 times the width of the
/// patches between creases, as far as the spacing elsewhere need not become more than 1.1 times as
/// large, and splits facets that are too large for that. A surface without such patches stays.
inline void refine_narrow_patches(Surface& surface, std::size_t n,
                                  internal::Concurrency concurrency = Sequential_tag())
{
  // In one row triangles are equilateral at 2 / sqrt(3) = 1.15 times the width. But finer curves
  // take samples from their other sides, and rows of another spacing end there: on a gear with
  // chamfers the mean Q over all is best at 1.4 (1.15: .902, 1.3: .924, 1.4: .924, 1.5: .921).
  constexpr double spacing_over_width = 1.4, gradation = 0.15;
  constexpr internal::Spacing_bounds bounds{0.25, 1.1, 1.5};
  if (surface.creases.empty()) return;
  const internal::Crease_patches patches(surface);
  std::vector<int> patch_of = patches.of_facet;
  internal::refine_within_limits(
      surface, bounds,
      [&] {
        internal::Limited_spacing result(surface, n, gradation, concurrency);
        std::vector<double> limits(patch_of.size());
        for (std::size_t f = 0; f < limits.size(); ++f)
          limits[f] = (std::max)(spacing_over_width * patches.shapes[patch_of[f]].strip_width(),
                                 bounds.least_share * result.spacing(static_cast<int>(f)));
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

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_REFINE_NARROW_PATCHES_H
