// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for change_border.h.
#ifndef CGAL_POWER_RTF_CHANGE_BORDER_IMPL_H
#define CGAL_POWER_RTF_CHANGE_BORDER_IMPL_H

#include <CGAL/PowerRTF/change_border.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/fields/sizing.h>
#include <CGAL/PowerRTF/prepare_surface.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// By point of the whole, the edge length that a region, remeshed alone, would have there; 0: none
/// is known. In the unit of the input.
inline std::vector<double> lengths_in_region(const Soup_region& region,
                                             const std::vector<int>& places,
                                             const Remeshing_options& options,
                                             Concurrency concurrency)
{
  Surface_fields fields = region.fields;
  fields.kept_edges.clear();
  Remeshing_report report;
  const Surface surface =
      prepare_surface(Polygon_soup(region.soup), fields, options, report, concurrency);
  const Remeshing_options without_bounds; // the density has them
  const std::vector<Refinement> none;     // the same
  const Length_bounds bounds(surface.normalization, without_bounds, none);
  const Length_scaling scaling(surface, bounds, 0, concurrency);
  const double n = static_cast<double>(report.samples_asked);
  double C = spacing_constant(surface, report.samples_asked, concurrency);
  if (scaling.has_room(n, C)) C = scaling.for_vertices(n, C);
  const std::vector<double> lengths = scaling.lengths(C);
  std::vector<double> result(places.size(), 0);
  for (std::size_t v = 0; v < lengths.size(); ++v) {
    double& l = result[places[region.points[surface.input_vertices[v]]]];
    if (l == 0) l = lengths[v] / surface.normalization.scale; // those of the input come first
  }
  return result;
}

} // namespace internal

CGAL_POWER_RTF_INLINE internal::Changed_soup
internal::change_border(const Polygon_soup& whole, const Surface_fields& fields,
                        const Soup_region& region, const Remeshing_options& options,
                        Concurrency concurrency)
{
  if (is_distance_asked_for(options))
    throw Invalid_input_error("region_border = remesh needs a number of samples or an edge length: "
                              "the spacing on the border does not follow from a largest distance");
  Border_change change(whole, fields, region, options.feature_angle);
  const std::vector<double> known =
      lengths_in_region(region, change.places(), options, concurrency);
  std::vector<double> lengths;
  for (const int v : change.vertices()) lengths.push_back(known[v]);
  // Of facets without area the surface has nothing; there, edges are no matter.
  const double longest = *std::max_element(lengths.begin(), lengths.end());
  for (double& l : lengths)
    if (l == 0) l = longest;
  return change.run(lengths, options.coordinates == Coordinates::single_precision);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CHANGE_BORDER_IMPL_H
