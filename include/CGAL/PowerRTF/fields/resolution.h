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

/// The vertices of a mesh of `surface`, by Euler's formula: V = F / 2 + B / 2 + chi.
inline double vertices_by_euler(const Surface& surface, double faces, double border_edges)
{
  const double facets = static_cast<double>(surface.triangles.size()),
               own_border = static_cast<double>(surface.adjacency.border_edges);
  const double characteristic =
      static_cast<double>(surface.points.size()) - (facets + own_border) / 2;
  return faces / 2 + border_edges / 2 + characteristic;
}

/// `n`, rounded, if there can be so many samples. \param what asks for them
/// \throws Invalid_input_error there would be more than can be
inline std::size_t possible_number(double n, const std::string& what)
{
  constexpr double least = 4, most = 3e8; // as validate() has them
  if (!(n <= most))
    throw Invalid_input_error(what + " asks for " + to_text(n) + " samples, but at most " +
                              to_text(most) + " are possible");
  return static_cast<std::size_t>(std::lround((std::max)(n, least)));
}

} // namespace internal

/// The number of vertices of a mesh of `surface` whose edges have the length `lengths[v]` at its
/// vertices, in coordinates of the unit box; 1 / length^2 is linear on facets.
inline double vertices_by_lengths(const Surface& surface, const std::vector<double>& lengths,
                                  internal::Concurrency concurrency = Sequential_tag())
{
  const double squares = internal::reduce(
      concurrency, static_cast<int>(surface.triangles.size()), 0.,
      [&](double& sum, int f) {
        for (const int v : surface.triangles[f])
          sum += surface.facet_areas[f] / (3 * lengths[v] * lengths[v]);
      },
      [](double& sum, double part) { sum += part; });
  double border_edges = 0;
  for (int h = 0; h < static_cast<int>(3 * surface.triangles.size()); ++h) {
    if (surface.adjacency.opposite[h] != Facet_adjacency::none) continue;
    const int a = halfedge_source(surface.triangles, h), b = halfedge_target(surface.triangles, h);
    border_edges +=
        length(surface.points[b] - surface.points[a]) * (1 / lengths[a] + 1 / lengths[b]) / 2;
  }
  return internal::vertices_by_euler(surface, 4 / std::sqrt(3.) * squares, border_edges);
}

/// The number of vertices of a mesh of `surface` with its density, whose edges have the median
/// length `edge_length`, in coordinates of the unit box: F triangles with the area sqrt(3) / 4 h^2
/// and B edges with the length h on the border.
inline double vertices_by_edge_length(const Surface& surface, double edge_length,
                                      internal::Concurrency concurrency = Sequential_tag())
{
  const double h = edge_length * internal::rms_over_median_length(surface, concurrency);
  const double faces = 4 / std::sqrt(3.) * surface.area / (h * h);
  return internal::vertices_by_euler(surface, faces, internal::border_length(surface) / h);
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

/// The edges' median length that `options` asks for, in coordinates of the unit box; 0: none.
inline double median_length(const Surface& surface, const Remeshing_options& options,
                            internal::Concurrency concurrency = Sequential_tag())
{
  return options.relative_edge_length > 0
             ? options.relative_edge_length * diagonal_of(surface, concurrency)
             : options.edge_length * surface.normalization.scale;
}

/// C of the spacing C rho^(-1/2) with the edge length that `options` asks for, or else of `n`
/// samples.
inline double spacing_by_edge_length(const Surface& surface, const Remeshing_options& options,
                                     std::size_t n,
                                     internal::Concurrency concurrency = Sequential_tag())
{
  const double median = median_length(surface, options, concurrency);
  if (!(median > 0)) return spacing_constant(surface, n, concurrency);
  return median * internal::rms_over_median_length(surface, concurrency) *
         std::sqrt(density_integral(surface, concurrency) / surface.area);
}

/// The number of samples that `options` asks for. \pre Where that is by `size_factor`, the density
/// of the surface is that of its sizes.
/// \throws Invalid_input_error there would be more than can be
inline std::size_t number_of_samples(const Surface& surface, const Remeshing_options& options,
                                     internal::Concurrency concurrency = Sequential_tag())
{
  if (!is_number_of_samples_open(options)) return options.number_of_samples;
  if (options.vertex_share > 0)
    return internal::possible_number(
        options.vertex_share * static_cast<double>(surface.points.size()), "vertex_share");
  if (options.size_factor > 0) {
    std::vector<double> lengths = surface.vertex_density;
    for (double& x : lengths) x = options.size_factor / std::sqrt(x);
    return internal::possible_number(vertices_by_lengths(surface, lengths, concurrency),
                                     "size_factor");
  }
  return internal::possible_number(
      vertices_by_edge_length(surface, median_length(surface, options, concurrency), concurrency),
      options.relative_edge_length > 0 ? "relative_edge_length" : "edge_length");
}

/// Whether vertices are taken out that the distance asked for can spare: where the user has not
/// said how dense they are to be.
inline bool is_coarsened(const Remeshing_options& options, const Surface& surface)
{
  return is_distance_asked_for(options) && options.density == Density::curvature &&
         !surface.has_own_density && options.thin == Thin::keep &&
         options.improvement == Improvement::yes;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_RESOLUTION_H
