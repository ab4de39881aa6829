// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Edge lengths that are wanted somewhere, instead of a density of which only ratios matter: a
// sizing field, bounds, regions to refine. They become the density that has them, and a number of
// samples.
#ifndef CGAL_POWER_RTF_FIELDS_SIZING_H
#define CGAL_POWER_RTF_FIELDS_SIZING_H

#include <CGAL/PowerRTF/Surface_fields.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/fields/kept_lengths.h>
#include <CGAL/PowerRTF/fields/resolution.h>
#include <CGAL/PowerRTF/geometry/halve_edges.h>
#include <CGAL/PowerRTF/geometry/split_at_centers.h>
#include <CGAL/PowerRTF/geometry/surface_edges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

constexpr double any_length = std::numeric_limits<double>::infinity();

/// The lengths that edges may have, in coordinates of the unit box.
class Length_bounds {
public:
  Length_bounds(const Normalization& normalization, const Remeshing_options& options,
                const std::vector<Refinement>& refinements)
      : m_normalization(normalization), m_refinements(refinements),
        m_shortest(options.min_edge_length * normalization.scale),
        m_longest(options.max_edge_length > 0 ? options.max_edge_length * normalization.scale
                                              : any_length),
        m_gradation(options.gradation > 0 ? options.gradation : any_length)
  {}

  /// The longest anywhere within `reach` around `p`, or a little less. Outside of a region it grows
  /// by the gradation.
  double longest(const Vec3d& p, double reach = 0) const
  {
    double result = m_longest;
    const double scale = m_normalization.scale;
    for (const Refinement& r : m_refinements) {
      const double distance = scale * r.distance(m_normalization.to_outside(p)) - reach;
      const double grown = distance > 0 ? m_gradation * distance : 0;
      result = (std::min)(result, scale * r.edge_length() + grown);
    }
    return (std::max)(result, m_shortest);
  }

  double limited(double length, const Vec3d& p) const
  {
    return std::clamp(length, m_shortest, longest(p));
  }

private:
  const Normalization m_normalization;
  const std::vector<Refinement>& m_refinements;
  double m_shortest, m_longest, m_gradation;
};

/// Lengths at the vertices: C rho^(-1/2), within the bounds.
inline std::vector<double> bounded_lengths(const Surface& surface, double C,
                                           const Length_bounds& bounds, Concurrency concurrency)
{
  std::vector<double> lengths(surface.points.size());
  for_each_index(concurrency, static_cast<int>(lengths.size()), [&](int v) {
    lengths[v] = bounds.limited(C / std::sqrt(surface.vertex_density[v]), surface.points[v]);
  });
  return lengths;
}

/// Splits facets where they are too large for the lengths that are wanted on them: with edges
/// longer than twice the shortest of these, while at the corners they differ from it by more than
/// 30 %, or do so without regard to kept edges. (The input of a part with flat sides may have no
/// vertex where it is to be refined.) Kept edges stay whole. Between the ends of an edge it is the
/// length C rho^(-1/2) that is linear.
inline void split_for_lengths(Surface& surface, double C, const Length_bounds& bounds,
                              double gradation, Concurrency concurrency)
{
  constexpr double similar = 1.3, longest_edge = 2;
  constexpr std::size_t most = 4000000; // facets
  const std::vector<int>& opposite = surface.adjacency.opposite;
  Whole_edges whole(surface);
  while (surface.triangles.size() < most / 4) {
    const std::vector<double> lengths = bounded_lengths(surface, C, bounds, concurrency);
    std::vector<double> graded = lengths;
    if (!surface.kept_edges.empty()) {
      const Surface_edges edges = surface_edges(surface, concurrency);
      Kept_lengths(surface, edges, gradation, concurrency).apply(graded);
    }
    std::vector<double> limit(surface.triangles.size()); // of the edges of a facet
    for_each_index(concurrency, static_cast<int>(limit.size()), [&](int f) {
      const auto [a, b, c] = surface.triangles[f];
      const Vec3d center = (surface.points[a] + surface.points[b] + surface.points[c]) * (1. / 3);
      double reach = 0;
      for (const int v : {a, b, c}) reach = (std::max)(reach, length(surface.points[v] - center));
      const auto [low, high] =
          std::minmax({lengths[a], lengths[b], lengths[c], graded[a], graded[b], graded[c]});
      const double shortest = (std::min)(low, bounds.longest(center, reach));
      limit[f] = high > similar * shortest ? longest_edge * shortest : any_length;
    });
    if (const std::vector<int> stuck = whole.high_facets(limit); !stuck.empty()) {
      split_at_centers(surface, stuck, concurrency);
      continue;
    }
    whole.add_low_facets(limit);
    const auto is_long = [&](int h) {
      const int o = opposite[h];
      if ((o != Facet_adjacency::none && o < h) || whole.contains(h)) return false;
      const double l = length(surface.points[halfedge_target(surface.triangles, h)] -
                              surface.points[halfedge_source(surface.triangles, h)]);
      return l > limit[h / 3] || (o != Facet_adjacency::none && l > limit[o / 3]);
    };
    const std::vector<int> edges = select(concurrency, static_cast<int>(opposite.size()), is_long);
    if (edges.empty()) return;
    const std::size_t old = surface.points.size();
    const std::vector<Edge> ends = halve_edges(surface, edges, concurrency).ends;
    std::vector<double>& rho = surface.vertex_density;
    for (std::size_t k = 0; k < ends.size(); ++k) {
      const double mean = (1 / std::sqrt(rho[ends[k][0]]) + 1 / std::sqrt(rho[ends[k][1]])) / 2;
      rho[old + k] = 1 / (mean * mean);
    }
  }
}

/// Lengths on a surface that differ by a factor, and how many vertices they give.
class Length_scaling {
public:
  Length_scaling(const Surface& surface, const Length_bounds& bounds, double gradation,
                 Concurrency concurrency)
      : m_surface(surface), m_bounds(bounds), m_concurrency(concurrency),
        m_edges(surface_edges(surface, concurrency)),
        m_kept(surface, m_edges, gradation, concurrency)
  {}
  Length_scaling(const Length_scaling&) = delete;

  /// C rho^(-1/2) within the bounds and near to the lengths of kept edges, its growth limited.
  std::vector<double> lengths(double C) const
  {
    std::vector<double> result = bounded_lengths(m_surface, C, m_bounds, m_concurrency);
    m_kept.apply(result);
    return result;
  }

  double vertices(double C) const
  {
    return vertices_by_lengths(m_surface, lengths(C), m_concurrency);
  }

  /// Whether there is a C of which there are `n` vertices. \param C any
  bool has_room(double n, double C) const
  {
    constexpr double far = 1e9;
    return vertices(C / far) >= n && vertices(C * far) <= n;
  }

  /// The C of which there are `n` vertices. The search begins with `C`.
  /// \throws Invalid_input_error there is none
  double for_vertices(double n, double C) const
  {
    constexpr double step = 4, near_enough = 5e-4;
    constexpr int steps = 20; // from far below the surface's size to far above it
    double low = C, high = C;
    double most = vertices(low), least = most;
    for (int k = 0; k < steps && most < n; ++k) most = vertices(low /= step);
    for (int k = 0; k < steps && least > n; ++k) least = vertices(high *= step);
    const std::string asked = to_text(n) + " samples are asked for, but ";
    if (most < (1 - near_enough) * n)
      throw Invalid_input_error(asked + "min_edge_length leaves room for " +
                                to_text(std::floor(most)));
    if (least > (1 + near_enough) * n)
      throw Invalid_input_error(asked + "the edge lengths wanted need at least " +
                                to_text(std::ceil(least)));
    for (;;) {
      const double middle = std::sqrt(low * high), found = vertices(middle);
      if (std::abs(found - n) <= near_enough * n || !(low < middle && middle < high)) return middle;
      (found > n ? low : high) = middle;
    }
  }

private:
  const Surface& m_surface;
  const Length_bounds& m_bounds;
  Concurrency m_concurrency;
  Surface_edges m_edges;
  Kept_lengths m_kept;
};

} // namespace internal

/// Whether edge lengths are wanted somewhere, beside one for all or a density.
inline bool has_wanted_lengths(const Remeshing_options& options, const Surface_fields& fields)
{
  return options.min_edge_length > 0 || options.max_edge_length > 0 || fields.sizes ||
         !fields.refinements.empty();
}

/// Sets `surface.vertex_density` to the inverse square of the lengths `sizes` in the unit box.
/// \param sizes one per vertex of the *input*, in its unit
/// \throws Invalid_input_error a length is missing, not positive or not finite
inline void set_density_by_sizes(Surface& surface, const std::vector<double>& sizes)
{
  constexpr double longest = 1e6; // in a box of size 1; longer ones are all the same
  surface.vertex_density = internal::surface_values(surface, sizes, "edge length");
  for (double& x : surface.vertex_density) {
    const double size = (std::min)(x * surface.normalization.scale, longest);
    x = 1 / (size * size);
  }
}

/// Brings the spacing by `surface.vertex_density` within the bounds and regions that `options` and
/// `fields` ask for, and to the lengths of kept edges at these, its growth limited by
/// `options.gradation`, and splits facets that are too large for that. Where a number of samples is
/// asked for, the spacing elsewhere gives way to it, and the growth from kept edges on.
///
/// \pre `surface.vertex_density` is set, by `set_density_by_sizes()` if there are sizes
/// \param n that number, or that without the bounds and regions
/// \returns the number of samples
/// \throws Invalid_input_error so many samples cannot have such edges, or there would be more than
///   can be
inline std::size_t set_wanted_lengths(Surface& surface, const Remeshing_options& options,
                                      const Surface_fields& fields, std::size_t n,
                                      internal::Concurrency concurrency = Sequential_tag())
{
  constexpr double steepest = 3; // there is hardly a limit then
  validate(options);
  const internal::Length_bounds bounds(surface.normalization, options, fields.refinements);
  double C = options.size_factor > 0 ? options.size_factor
                                     : spacing_by_edge_length(surface, options, n, concurrency);
  const bool has_kept = !surface.kept_edges.empty();
  double gradation = options.gradation;
  if (fields.sizes || !fields.refinements.empty() || has_kept)
    internal::split_for_lengths(surface, C, bounds, gradation, concurrency);
  std::optional<internal::Length_scaling> scaling(std::in_place, surface, bounds, gradation,
                                                  concurrency);
  const bool is_length_asked_for =
      options.size_factor > 0 || options.edge_length > 0 || options.relative_edge_length > 0;
  if (!is_length_asked_for) {
    const double asked = static_cast<double>(n);
    bool has_room = !has_kept || scaling->has_room(asked, C);
    while (!has_room && gradation > 0 && gradation < steepest) {
      scaling.emplace(surface, bounds, gradation *= 2, concurrency);
      has_room = scaling->has_room(asked, C);
    }
    if (has_room) C = scaling->for_vertices(asked, C); // else only ratios matter
  }
  std::vector<double> lengths = scaling->lengths(C);
  if (is_length_asked_for)
    n = internal::possible_number(vertices_by_lengths(surface, lengths, concurrency),
                                  "the edge length that is wanted");
  for (double& l : lengths) l = 1 / (l * l);
  surface.vertex_density = std::move(lengths);
  internal::normalize_density(surface.vertex_density);
  return n;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FIELDS_SIZING_H
