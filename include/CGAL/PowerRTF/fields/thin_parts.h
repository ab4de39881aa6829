// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a surface is too thin for its samples, and a spacing that follows the thickness there. On a
// finger thinner than 0.8 times the spacing triangles have too little room to be round.
#ifndef CGAL_POWER_RTF_FIELDS_THIN_PARTS_H
#define CGAL_POWER_RTF_FIELDS_THIN_PARTS_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/fields/limited_spacing.h>
#include <CGAL/PowerRTF/fields/thickness.h>
#include <CGAL/PowerRTF/geometry/cut_surface.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// The largest spacing over the thickness with which triangles are round (measured on tubes: with
/// five seeds always at 1.25, not at 1.33), and the spacing's largest growth around thin parts.
constexpr double spacing_over_thickness = 1.25, thin_gradation = 0.5;

/// The surface elsewhere gives way by at most so much. Pointed tips have no thickness.
constexpr Spacing_bounds thin_bounds{0.25, 1.6, 0.7};

/// The spacing of n samples, limited where a surface is thin.
/// \param thickness of the facets; negative: not known yet
inline Limited_spacing thin_spacing(const Surface& surface, std::size_t n,
                                    std::vector<double>& thickness, Concurrency concurrency)
{
  Limited_spacing result(surface, n, thin_gradation, concurrency);
  const auto find = [&](const Surface& patches) {
    constexpr double most = thin_bounds.most_elsewhere / spacing_over_thickness;
    find_thickness(
        patches, n, [&](int f) { return most * result.spacing(f); }, thickness, concurrency);
  };
  surface.creases.empty() ? find(surface) : find(cut_along_creases(surface).surface);
  std::vector<double> limits(thickness.size());
  for_each_index(concurrency, static_cast<int>(limits.size()), [&](int f) {
    limits[f] = (std::max)(spacing_over_thickness * thickness[f],
                           thin_bounds.least_share * result.spacing(f));
  });
  result.set_limits(std::move(limits));
  return result;
}

/// Of the facets that have been cut the thickness is no longer known.
/// \param parents the facets, now, lie in these
inline void forget_thickness(std::vector<double>& thickness, const std::vector<int>& parents)
{
  std::vector<int> parts(thickness.size(), 0);
  for (const int f : parents) ++parts[f];
  std::vector<double> of_pieces(parents.size());
  for (std::size_t f = 0; f < parents.size(); ++f)
    of_pieces[f] = parts[parents[f]] == 1 ? thickness[parents[f]] : -1;
  thickness.swap(of_pieces);
}

} // namespace internal

/// Brings the spacing of `n` samples by `surface.vertex_density` within 1.25 times the thickness of
/// the surface, as far as the spacing elsewhere need not become more than 1.6 times as large, and
/// splits facets that are too large for that. A surface that is nowhere thin stays as it is.
inline void refine_thin_parts(Surface& surface, std::size_t n,
                              internal::Concurrency concurrency = Sequential_tag())
{
  std::vector<double> thickness(surface.triangles.size(), -1);
  internal::refine_within_limits(
      surface, internal::thin_bounds,
      [&] { return internal::thin_spacing(surface, n, thickness, concurrency); },
      [&](const std::vector<int>& parents) { internal::forget_thickness(thickness, parents); },
      concurrency);
}

/// Where `patches`, a surface cut along its creases, is too thin for `n` samples.
inline Thin_parts thin_parts(const Surface& patches, std::size_t n,
                             internal::Concurrency concurrency = Sequential_tag())
{
  std::vector<double> thickness(patches.triangles.size(), -1);
  const internal::Limited_spacing spacing =
      internal::thin_spacing(patches, n, thickness, concurrency);
  Facet_adjacency within = patches.adjacency;
  Thin_parts result;
  double thinnest = std::numeric_limits<double>::infinity(), area = 0;
  int other = 0; // facets
  for (int f = 0; f < static_cast<int>(patches.triangles.size()); ++f) {
    if (!spacing.is_over(f)) {
      ++other;
      for (int h = 3 * f; h < 3 * f + 3; ++h) {
        const int o = within.opposite[h];
        if (o == Facet_adjacency::none) continue;
        within.opposite[h] = within.opposite[o] = Facet_adjacency::none;
      }
      continue;
    }
    area += patches.facet_areas[f];
    if (!(thickness[f] < thinnest)) continue;
    thinnest = thickness[f];
    const auto [a, b, c] = patches.triangles[f];
    const Vec3d p = patches.normalization.to_outside(
        (patches.points[a] + patches.points[b] + patches.points[c]) * (1. / 3));
    result.thickness = thinnest / patches.normalization.scale;
    std::tie(result.thinnest[0], result.thinnest[1], result.thinnest[2]) = std::tie(p.x, p.y, p.z);
  }
  result.places = static_cast<std::size_t>(facet_components(within, concurrency).second - other);
  if (result.places == 0) return result;
  result.area_share = area / patches.area;
  const Surface_edges edges = surface_edges(patches, concurrency);
  result.samples = static_cast<std::size_t>(
      std::ceil(double(n) * spacing.samples(spacing.lengths(edges, 1, 0))));
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_THIN_PARTS_H
