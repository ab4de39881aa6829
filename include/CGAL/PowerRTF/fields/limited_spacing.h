// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A spacing of the samples that keeps within limits on some facets, while the surface elsewhere
// gives way a little, so that it takes as many samples.
#ifndef CGAL_POWER_RTF_FIELDS_LIMITED_SPACING_H
#define CGAL_POWER_RTF_FIELDS_LIMITED_SPACING_H

#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/halve_edges.h>
#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/atomics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The spacing of n samples, and limits of it.
class Limited_spacing {
public:
  /// \param gradation the largest growth of the spacing around what is limited; 0: any
  Limited_spacing(const Surface& surface, std::size_t n, double gradation, Concurrency concurrency)
      : m_surface(surface), m_concurrency(concurrency),
        m_constant(spacing_constant(surface, n, concurrency)), m_gradation(gradation)
  {}

  /// By facet.
  void set_limits(std::vector<double> limits) { m_limits = std::move(limits); }

  /// As it was.
  double spacing(int f) const
  {
    const auto& rho = m_surface.vertex_density;
    const auto [a, b, c] = m_surface.triangles[f];
    return m_constant / std::sqrt((rho[a] + rho[b] + rho[c]) / 3);
  }
  double spacing_at_vertex(int v) const
  {
    return m_constant / std::sqrt(m_surface.vertex_density[v]);
  }

  /// Of the spacing on facet `f`.
  double limit(int f) const { return m_limits[f]; }

  /// Whether the spacing is too large on facet `f`.
  bool is_over(int f) const { return limit(f) < spacing(f); }
  bool is_over() const
  {
    const int facets = static_cast<int>(m_limits.size());
    for (int f = 0; f < facets; ++f)
      if (is_over(f)) return true;
    return false;
  }

  /// By vertex: `factor` times the spacing as it was, and within the limits where these are not
  /// below `floor` times the spacing; its growth limited.
  std::vector<double> lengths(const Surface_edges& edges, double factor, double floor) const
  {
    const int vertices = static_cast<int>(m_surface.points.size());
    std::vector<double> limits(vertices, std::numeric_limits<double>::infinity()), result(vertices);
    for_each_index(m_concurrency, static_cast<int>(m_limits.size()), [&](int f) {
      for (const int v : m_surface.triangles[f]) atomic_min(&limits[v], limit(f));
    });
    for_each_index(m_concurrency, vertices, [&](int v) {
      const double h = spacing_at_vertex(v);
      result[v] = (std::min)(factor * h, (std::max)(floor * h, limits[v]));
    });
    if (m_gradation > 0) limit_growth(edges, m_gradation, result, m_concurrency);
    return result;
  }

  /// How many times as many samples such lengths take.
  double samples(const std::vector<double>& lengths) const
  {
    return squares(lengths) /
           (density_integral(m_surface, m_concurrency) / (m_constant * m_constant));
  }

private:
  /// The integral of 1 / length^2, linear on facets.
  double squares(const std::vector<double>& lengths) const
  {
    return reduce(
        m_concurrency, static_cast<int>(m_surface.triangles.size()), 0.,
        [&](double& sum, int f) {
          for (const int v : m_surface.triangles[f])
            sum += m_surface.facet_areas[f] / (3 * lengths[v] * lengths[v]);
        },
        [](double& sum, double part) { sum += part; });
  }

  const Surface& m_surface;
  Concurrency m_concurrency;
  double m_constant, m_gradation;
  std::vector<double> m_limits; // by facet
};

/// What a spacing may become.
struct Spacing_bounds {
  double least_share;    ///< of the spacing as it was, which no limit is below
  double most_elsewhere; ///< times the spacing as it was
  double longest_edge;   ///< of facets on which the spacing varies, in its least there
  /// Whether facets are split for all limits, before it is known which can be met: where all
  /// vertices are at limits, as on parts in few facets, that none can be.
  bool splits_for_all = false;
  std::size_t most_facets = std::numeric_limits<std::size_t>::max(); ///< more are not made
};

/// The edges, by a halfedge of each, that are too long for the lengths at a facet, where the
/// spacing is too large, or where its corners differ by more than 20 %, and not all of them are as
/// they were. The density is linear on facets: lengths grow too steeply near the far end of a facet
/// that is too large.
inline std::vector<int> edges_to_halve(const Surface& surface, const Limited_spacing& spacing,
                                       double longest_edge, double floor,
                                       const std::vector<double>& lengths, Concurrency concurrency)
{
  constexpr double similar = 1.2;
  const std::vector<int>& opposite = surface.adjacency.opposite;
  const auto is_lowered = [&](int v) { return lengths[v] < spacing.spacing_at_vertex(v); };
  const auto is_long_for = [&](double l, int f) {
    const auto [a, b, c] = surface.triangles[f];
    if (!is_lowered(a) && !is_lowered(b) && !is_lowered(c)) return false;
    const auto [low, high] = std::minmax({lengths[a], lengths[b], lengths[c]});
    const double h = spacing.spacing(f),
                 shortest = (std::min)(low, (std::max)(floor * h, spacing.limit(f)));
    return l > longest_edge * shortest && (high > similar * shortest || shortest < h);
  };
  return select(concurrency, static_cast<int>(opposite.size()), [&](int h) {
    const int o = opposite[h];
    if (o != Facet_adjacency::none && o < h) return false;
    const double l = length(surface.points[halfedge_target(surface.triangles, h)] -
                            surface.points[halfedge_source(surface.triangles, h)]);
    return is_long_for(l, h / 3) || (o != Facet_adjacency::none && is_long_for(l, o / 3));
  });
}

/// The least x between `low` and `high` that is enough, to less than 1 % of their ratio's
/// logarithm; `high` is taken for enough.
template <class IsEnough>
double least_enough(double low, double high, const IsEnough& is_enough)
{
  constexpr int steps = 7;
  for (int k = 0; k < steps; ++k) {
    const double middle = std::sqrt(low * high);
    (is_enough(middle) ? high : low) = middle;
  }
  return high;
}

/// Sets `surface.vertex_density` to that of the limited spacing, as far as the bounds allow, and
/// splits facets that are too large for that. A surface that is nowhere over the limits stays.
/// \param limited_spacing gives the `Limited_spacing` of the surface as it is
/// \param split is told of the facets that are there now in which ones before they lie
/// \returns whether it is within all limits; `false`, too, with only facets split, where these
/// would be too many
template <class LimitedSpacing, class Split>
bool refine_within_limits(Surface& surface, const Spacing_bounds& bounds,
                          const LimitedSpacing& limited_spacing, const Split& split,
                          Concurrency concurrency)
{
  const double most = bounds.most_elsewhere;
  for (;;) {
    const Limited_spacing spacing = limited_spacing();
    if (!spacing.is_over()) return true;
    const Surface_edges edges = surface_edges(surface, concurrency);
    const auto is_enough = [&](double factor, double floor) {
      return spacing.samples(spacing.lengths(edges, factor, floor)) <= 1;
    };
    const double floor =
        is_enough(most, 0)
            ? 0
            : least_enough(bounds.least_share, 1, [&](double x) { return is_enough(most, x); });
    if (surface.triangles.size() > bounds.most_facets) return false;
    const double split_floor = bounds.splits_for_all ? 0 : floor;
    const std::vector<int> halves =
        edges_to_halve(surface, spacing, bounds.longest_edge, split_floor,
                       spacing.lengths(edges, 1, split_floor), concurrency);
    if (!halves.empty()) {
      split(PowerRTF::halve_edges(surface, halves, concurrency).parents);
      continue;
    }
    const double factor = least_enough(1, most, [&](double x) { return is_enough(x, floor); });
    std::vector<double> lengths = spacing.lengths(edges, factor, floor);
    for (double& l : lengths) l = 1 / (l * l);
    surface.vertex_density = std::move(lengths);
    normalize_density(surface.vertex_density);
    return floor == 0;
  }
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_FIELDS_LIMITED_SPACING_H
