// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a surface is too thin for its samples, and a spacing that follows the thickness there. On a
// finger thinner than 0.8 times the spacing triangles have too little room to be round.
#ifndef CGAL_POWER_RTF_FIELDS_THIN_PARTS_H
#define CGAL_POWER_RTF_FIELDS_THIN_PARTS_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/fields/thickness.h>
#include <CGAL/PowerRTF/geometry/cut_surface.h>
#include <CGAL/PowerRTF/geometry/halve_edges.h>
#include <CGAL/PowerRTF/geometry/surface_edges.h>
#include <CGAL/PowerRTF/internal/atomics.h>

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

/// The spacing of n samples where a surface is thin. The surface elsewhere gives way, to at most
/// this many times its spacing.
class Thin_spacing {
public:
  static constexpr double most_elsewhere = 1.6;
  /// Of the spacing, which no limit is below: pointed tips have no thickness.
  static constexpr double least_share = 0.25;

  /// \param thickness of the facets; negative: not known yet
  Thin_spacing(const Surface& surface, std::size_t n, std::vector<double>& thickness,
               Concurrency concurrency)
      : m_surface(surface), m_concurrency(concurrency),
        m_constant(spacing_constant(surface, n, concurrency)), m_thickness(thickness)
  {
    const auto find = [&](const Surface& patches) {
      const double most = most_elsewhere / spacing_over_thickness;
      find_thickness(
          patches, n, [&](int f) { return most * spacing(f); }, thickness, concurrency);
    };
    surface.creases.empty() ? find(surface) : find(cut_along_creases(surface).surface);
  }

  /// As it was.
  double spacing(int f) const
  {
    const auto& rho = m_surface.vertex_density;
    const auto [a, b, c] = m_surface.triangles[f];
    return m_constant / std::sqrt((rho[a] + rho[b] + rho[c]) / 3);
  }

  /// Of the spacing on facet `f`.
  double limit(int f) const
  {
    return (std::max)(spacing_over_thickness * m_thickness[f], least_share * spacing(f));
  }

  /// Whether the spacing is too large on facet `f`.
  bool is_over(int f) const { return limit(f) < spacing(f); }
  bool is_over() const
  {
    const int facets = static_cast<int>(m_thickness.size());
    for (int f = 0; f < facets; ++f)
      if (is_over(f)) return true;
    return false;
  }

  /// By vertex: `factor` times the spacing as it was, and within the limits where these are not
  /// below `floor` times the spacing; its growth limited.
  std::vector<double> lengths(const Surface_edges& edges, double factor, double floor) const
  {
    const int vertices = static_cast<int>(m_surface.points.size());
    std::vector<double> limits(vertices, any), result(vertices);
    for_each_index(m_concurrency, static_cast<int>(m_thickness.size()), [&](int f) {
      for (const int v : m_surface.triangles[f]) atomic_min(&limits[v], limit(f));
    });
    for_each_index(m_concurrency, vertices, [&](int v) {
      const double h = m_constant / std::sqrt(m_surface.vertex_density[v]);
      result[v] = (std::min)(factor * h, (std::max)(floor * h, limits[v]));
    });
    limit_growth(edges, thin_gradation, result, m_concurrency);
    return result;
  }

  /// How many times as many samples such lengths take.
  double samples(const std::vector<double>& lengths) const
  {
    return squares(lengths) /
           (density_integral(m_surface, m_concurrency) / (m_constant * m_constant));
  }

private:
  static constexpr double any = std::numeric_limits<double>::infinity();

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
  double m_constant;
  const std::vector<double>& m_thickness; // by facet
};

/// The edges, by a halfedge of each, that are longer than 0.7 times the lengths at a facet, where
/// the spacing is too large, or where its corners differ by more than 20 %. The density is linear
/// on facets: lengths grow too steeply near the far end of a facet that is too large.
inline std::vector<int> edges_to_halve(const Surface& surface, const Thin_spacing& spacing,
                                       double floor, const std::vector<double>& lengths,
                                       Concurrency concurrency)
{
  constexpr double similar = 1.2, longest_edge = 0.7;
  const std::vector<int>& opposite = surface.adjacency.opposite;
  const auto is_long_for = [&](double l, int f) {
    const auto [a, b, c] = surface.triangles[f];
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

/// Halves edges; of the facets that are cut the thickness is no longer known.
inline void halve_edges(Surface& surface, const std::vector<int>& halfedges,
                        std::vector<double>& thickness, Concurrency concurrency)
{
  const std::vector<int> parents = PowerRTF::halve_edges(surface, halfedges, concurrency).parents;
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
  constexpr double least = internal::Thin_spacing::least_share,
                   most = internal::Thin_spacing::most_elsewhere;
  std::vector<double> thickness(surface.triangles.size(), -1);
  for (;;) {
    const internal::Thin_spacing spacing(surface, n, thickness, concurrency);
    if (!spacing.is_over()) return;
    const Surface_edges edges = surface_edges(surface, concurrency);
    const auto is_enough = [&](double factor, double floor) {
      return spacing.samples(spacing.lengths(edges, factor, floor)) <= 1;
    };
    const double floor = is_enough(most, 0) ? 0 : internal::least_enough(least, 1, [&](double x) {
      return is_enough(most, x);
    });
    const std::vector<int> halves = internal::edges_to_halve(
        surface, spacing, floor, spacing.lengths(edges, 1, floor), concurrency);
    if (!halves.empty()) {
      internal::halve_edges(surface, halves, thickness, concurrency);
      continue;
    }
    const double factor =
        internal::least_enough(1, most, [&](double x) { return is_enough(x, floor); });
    std::vector<double> lengths = spacing.lengths(edges, factor, floor);
    for (double& l : lengths) l = 1 / (l * l);
    surface.vertex_density = std::move(lengths);
    internal::normalize_density(surface.vertex_density);
    return;
  }
}

/// Where `patches`, a surface cut along its creases, is too thin for `n` samples.
inline Thin_parts thin_parts(const Surface& patches, std::size_t n,
                             internal::Concurrency concurrency = Sequential_tag())
{
  std::vector<double> thickness(patches.triangles.size(), -1);
  const internal::Thin_spacing spacing(patches, n, thickness, concurrency);
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
