// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many samples a run has that is asked for edges of some length, or for a share of the input's
// vertices.
#ifndef CGAL_POWER_RTF_FIELDS_RESOLUTION_H
#define CGAL_POWER_RTF_FIELDS_RESOLUTION_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/bounding_box.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/option_table.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

/// Over the edges of a mesh with the density of `surface`: the root mean square of their lengths,
/// over their median.
inline double rms_over_median_length(const Surface& surface, Concurrency concurrency)
{
  if (has_uniform_density(surface)) return 1;
  struct Part { // of the surface: its edges' length, and in proportion to how many they are
    double length, share;
    bool operator<(const Part& other) const { return length < other.length; }
  };
  const int facets = static_cast<int>(surface.triangles.size());
  std::vector<Part> parts(facets);
  for_each_index(concurrency, facets, [&](int f) {
    double density = 0;
    for (const int v : surface.triangles[f]) density += surface.vertex_density[v] / 3;
    parts[f] = {1 / std::sqrt(density), density * surface.facet_areas[f]};
  });
  sort(concurrency, parts.begin(), parts.end());
  double all = 0, squares = 0;
  for (const Part& p : parts) {
    all += p.share;
    squares += p.share * p.length * p.length;
  }
  double shorter = 0;
  for (const Part& p : parts)
    if ((shorter += p.share) >= all / 2) return std::sqrt(squares / all) / p.length;
  return 1;
}

inline double border_length(const Surface& surface)
{
  double sum = 0;
  for (int h = 0; h < static_cast<int>(3 * surface.triangles.size()); ++h)
    if (surface.adjacency.opposite[h] == Facet_adjacency::none)
      sum += length(surface.points[halfedge_target(surface.triangles, h)] -
                    surface.points[halfedge_source(surface.triangles, h)]);
  return sum;
}

} // namespace internal

/// The number of vertices of a mesh of `surface` with its density, whose edges have the median
/// length `edge_length`, in coordinates of the unit box. By Euler's formula, from F triangles with
/// the area sqrt(3) / 4 h^2 and B edges with the length h on the border: V = F / 2 + B / 2 + chi.
inline double vertices_by_edge_length(const Surface& surface, double edge_length,
                                      internal::Concurrency concurrency = Sequential_tag())
{
  const double h = edge_length * internal::rms_over_median_length(surface, concurrency);
  const double faces = 4 / std::sqrt(3.) * surface.area / (h * h);
  const double border_edges = internal::border_length(surface) / h;
  const double facets = static_cast<double>(surface.triangles.size()),
               own_border = static_cast<double>(surface.adjacency.border_edges);
  const double characteristic =
      static_cast<double>(surface.points.size()) - (facets + own_border) / 2;
  return faces / 2 + border_edges / 2 + characteristic;
}

/// The diagonal of the bounding box, in coordinates of the unit box.
inline double diagonal_of(const Surface& surface,
                          internal::Concurrency concurrency = Sequential_tag())
{
  const Box3<double> box = internal::bounding_box(surface.points, surface.triangles, concurrency);
  return length(box.hi - box.lo);
}

/// The largest distance that `options` allows, in the input's unit; 0: any.
inline double max_distance(const Surface& surface, const Remeshing_options& options,
                           internal::Concurrency concurrency = Sequential_tag())
{
  return options.relative_max_distance > 0
             ? options.relative_max_distance * diagonal_of(surface, concurrency) /
                   surface.normalization.scale
             : options.max_distance;
}

/// About as many samples as bring a sphere of the surface's size within `distance`, in the input's
/// unit.
inline double samples_of_sphere(const Surface& surface, double distance)
{
  return surface.area /
         (std::sqrt(3.) * diagonal_of(surface) * distance * surface.normalization.scale);
}

/// The number of samples that `options` asks for.
/// \throws Invalid_input_error there would be more than can be
inline std::size_t number_of_samples(const Surface& surface, const Remeshing_options& options,
                                     internal::Concurrency concurrency = Sequential_tag())
{
  if (!is_number_of_samples_open(options)) return options.number_of_samples;
  constexpr double least = 4, most = 3e8; // as validate() has them
  double n;
  std::string what;
  if (options.vertex_share > 0) {
    n = options.vertex_share * static_cast<double>(surface.points.size());
    what = "vertex_share";
  } else {
    const bool is_relative = options.relative_edge_length > 0;
    n = vertices_by_edge_length(surface,
                                is_relative ? options.relative_edge_length *
                                                  diagonal_of(surface, concurrency)
                                            : options.edge_length * surface.normalization.scale,
                                concurrency);
    what = is_relative ? "relative_edge_length" : "edge_length";
  }
  if (!(n <= most))
    throw Invalid_input_error(what + " asks for " + to_text(n) + " samples, but at most " +
                              to_text(most) + " are possible");
  return static_cast<std::size_t>(std::lround((std::max)(n, least)));
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_RESOLUTION_H
