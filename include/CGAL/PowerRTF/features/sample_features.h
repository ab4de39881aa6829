// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples on corners, creases and borders, spaced by the density along each curve, and at single
// vertices: there they stay. To the cells they are sites, one copy for each patch that they are on.
#ifndef CGAL_POWER_RTF_FEATURES_SAMPLE_FEATURES_H
#define CGAL_POWER_RTF_FEATURES_SAMPLE_FEATURES_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/features/curve_samples.h>
#include <CGAL/PowerRTF/features/feature_curves.h>
#include <CGAL/PowerRTF/features/narrow_patches.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/cut_surface.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/option_table.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

/// Makes the samples and sites of places on curves.
class Feature_site_builder {
public:
  /// `cut`: `surface`, cut along its creases.
  Feature_site_builder(const Surface& surface, const Cut_surface& cut, Curve_samples&& curves)
      : m_surface(surface), m_cut(cut)
  {
    m_result.places = std::move(curves.places);
    m_result.edges = std::move(curves.edges);
    for (const Edge_place& place : m_result.places) {
      const Vec3d &a = surface.points[place.from], &b = surface.points[place.to];
      const double ra = surface.vertex_density[place.from], rb = surface.vertex_density[place.to];
      m_result.samples.points.push_back(a + (b - a) * place.at);
      m_result.samples.density.push_back(ra + (rb - ra) * place.at);
    }
    add_sites();
  }

  Feature_samples release() { return std::move(m_result); }

private:
  /// Walks along the borders of the cut surface, which are its patches' boundaries.
  void add_sites()
  {
    const Surface& cut = m_cut.surface;
    const auto& triangles = cut.triangles;
    std::vector<int> at_vertex(m_surface.points.size(), -1);
    std::vector<std::pair<Edge, int>> on_edges; // by edge, then along it from the smaller vertex
    for (std::size_t s = 0; s < m_result.places.size(); ++s) {
      const Edge_place& p = m_result.places[s];
      if (p.from == p.to)
        at_vertex[p.from] = static_cast<int>(s);
      else
        on_edges.emplace_back(sorted_edge(p.from, p.to), static_cast<int>(s));
    }
    const auto along = [&](int s) { // from the smaller vertex
      const Edge_place& p = m_result.places[s];
      return p.from < p.to ? p.at : 1 - p.at;
    };
    std::sort(on_edges.begin(), on_edges.end(), [&](const auto& a, const auto& b) {
      return a.first != b.first ? a.first < b.first : along(a.second) < along(b.second);
    });

    const std::vector<int>& opposite = cut.adjacency.opposite;
    const int halfedges = static_cast<int>(opposite.size());
    std::vector<int> outgoing(cut.points.size(), -1);
    for (int h = 0; h < halfedges; ++h)
      if (opposite[h] == Facet_adjacency::none) outgoing[halfedge_source(triangles, h)] = h;

    std::vector<char> seen(halfedges, 0);
    for (int start = 0; start < halfedges; ++start) {
      if (opposite[start] != Facet_adjacency::none || seen[start]) continue;
      const std::size_t first = m_result.sites.size();
      for (int h = start; !seen[h]; h = outgoing[halfedge_target(triangles, h)]) {
        seen[h] = 1;
        const int a = halfedge_source(triangles, h), b = halfedge_target(triangles, h);
        const int from = m_cut.originals[a], to = m_cut.originals[b];
        if (at_vertex[from] >= 0) add_site(at_vertex[from], h, 0);
        const Edge edge = sorted_edge(from, to);
        const auto begin =
            std::lower_bound(on_edges.begin(), on_edges.end(), std::make_pair(edge, -1),
                             [](const auto& x, const auto& y) { return x.first < y.first; });
        const auto end =
            std::find_if(begin, on_edges.end(), [&](const auto& x) { return x.first != edge; });
        if (from < to)
          for (auto it = begin; it != end; ++it) add_site(it->second, h, along(it->second));
        else
          for (auto it = end; it != begin;) {
            --it;
            add_site(it->second, h, 1 - along(it->second));
          }
      }
      const std::size_t last = m_result.sites.size();
      for (std::size_t s = first; s < last; ++s)
        m_result.next.push_back(static_cast<int>(s + 1 < last ? s + 1 : first));
    }
    add_sites_inside(at_vertex, std::move(outgoing));
    finish_samples();
  }

  /// Those of samples at vertices that are on no border. \param outgoing >= 0: it is on a border
  void add_sites_inside(const std::vector<int>& at_vertex, std::vector<int> outgoing)
  {
    const auto& triangles = m_cut.surface.triangles;
    for (int h = 0; h < static_cast<int>(3 * triangles.size()); ++h) {
      const int v = halfedge_source(triangles, h), sample = at_vertex[m_cut.originals[v]];
      if (sample < 0 || outgoing[v] >= 0) continue;
      outgoing[v] = h;
      add_site(sample, h, 0);
      m_result.next.push_back(-1);
    }
  }

  void add_site(int sample, int h, double at)
  {
    const Surface& cut = m_cut.surface;
    std::array<double, 3> weights{0, 0, 0};
    weights[h % 3] = 1 - at;
    weights[(h + 1) % 3] = at;
    Samples& sites = m_result.sites;
    sites.points.push_back(m_result.samples.points[sample]);
    sites.facets.push_back(h / 3);
    sites.normals.push_back(interpolated_normal(cut, h / 3, weights));
    sites.density.push_back(m_result.samples.density[sample]);
    sites.weights.push_back(0);
    sites.patches.push_back(cut.facet_patches[h / 3]);
    m_result.samples_of_sites.push_back(sample);
  }

  /// The samples' facets, patches and normals from those of their sites.
  void finish_samples()
  {
    Samples& samples = m_result.samples;
    samples.facets.assign(samples.points.size(), -1);
    samples.patches.assign(samples.points.size(), -1);
    samples.normals.assign(samples.points.size(), {0, 0, 0});
    samples.weights.assign(samples.points.size(), 0);
    for (std::size_t k = 0; k < m_result.samples_of_sites.size(); ++k) {
      const int s = m_result.samples_of_sites[k];
      samples.normals[s] += m_result.sites.normals[k];
      if (samples.facets[s] >= 0) continue;
      samples.facets[s] = m_result.sites.facets[k];
      samples.patches[s] = m_result.sites.patches[k];
    }
    // A crease of one edge that ends at both ends inside a patch bounds nothing: it has no sites.
    std::multimap<Edge, int> lonely; // by the edge, or twice the vertex
    for (std::size_t s = 0; s < samples.points.size(); ++s)
      if (samples.facets[s] < 0)
        lonely.insert({sorted_edge(m_result.places[s].from, m_result.places[s].to), int(s)});
    for (std::size_t f = 0; f < m_surface.triangles.size() && !lonely.empty(); ++f)
      for (const int a : m_surface.triangles[f])
        for (const int b : m_surface.triangles[f]) {
          const auto [first, last] = lonely.equal_range({a, b});
          for (auto it = first; it != last; ++it) {
            samples.facets[it->second] = static_cast<int>(f);
            samples.patches[it->second] = m_cut.surface.facet_patches[f];
          }
          lonely.erase(first, last);
        }
    for (std::size_t s = 0; s < samples.points.size(); ++s) {
      const Vec3d n = normalized(samples.normals[s]);
      samples.normals[s] = squared_length(n) > 0 ? n : m_surface.facet_normals[samples.facets[s]];
    }
  }

  const Surface& m_surface;
  const Cut_surface& m_cut;
  Feature_samples m_result;
};

} // namespace internal

/// Fewest samples that keep the creases and borders of `surface`.
inline std::size_t min_feature_samples(const Surface& surface)
{
  return internal::Curve_sampler(surface, feature_curves(surface, 0))
      .count(std::numeric_limits<double>::infinity());
}

/// The number of cells of the mean size that `cut`, a surface cut along its creases, has room for
/// when `n` samples are spread over it, `features` among them: half as many as triangles. By
/// Euler's formula a mesh with k vertices inside and b on its border has 2 k + b - 2 chi of these.
inline double equivalent_cells(const Surface& cut, std::size_t n, const Feature_samples& features)
{
  const double facets = static_cast<double>(cut.triangles.size()),
               border = static_cast<double>(cut.adjacency.border_edges);
  const double characteristic = static_cast<double>(cut.points.size()) - (facets + border) / 2;
  const double inside = static_cast<double>(n) - static_cast<double>(features.size()) +
                        static_cast<double>(features.sites_inside()) / 2;
  return (std::max)(1., inside + static_cast<double>(features.sites.size()) / 2 - characteristic);
}

/// Samples on the corners, creases, borders and single vertices of `surface` that are to stay,
/// spaced like `n` samples in all.
/// \param cut `surface`, cut along its creases
/// \throws Invalid_input_error when `n` samples are too few
inline Feature_samples sample_features(const Surface& surface, const Cut_surface& cut,
                                       std::size_t n)
{
  const double h = std::sqrt(surface.area / static_cast<double>(n));
  std::vector<Feature_curve> curves = feature_curves(surface, 0.5 * h);
  if (curves.empty()) return {};
  const auto count = [&](double spacing) {
    return internal::Curve_sampler(surface, curves).count(spacing);
  };
  const auto samples = [&](double spacing) {
    internal::Curve_sampler sampler(surface, curves);
    if (surface.mirror_samples > 0) sampler.set_count_at_mirror(surface.mirror_samples, spacing);
    return internal::Feature_site_builder(surface, cut, sampler.run(spacing)).release();
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (2 * count(infinity) > n) curves = feature_curves(surface, 0); // turns are dispensable
  if (count(infinity) > n)
    throw Invalid_input_error(std::to_string(n) +
                              " samples are too few: the borders, creases and vertices that are "
                              "to stay need " +
                              std::to_string(count(infinity)));
  double spacing = spacing_constant(surface, n);
  while (count(spacing) > 16 * n) spacing *= 1.05; // a density may be large on the curves alone
  spacing *= std::sqrt(static_cast<double>(n) / equivalent_cells(cut.surface, n, samples(spacing)));
  // On slender surfaces there may be more border than n samples can line.
  while (count(spacing) > n) spacing *= 1.05;
  return samples(spacing);
}

/// \ingroup PkgPowerRTFSurface
/// Sets the creases that `options` asks for. Of those closer together than \f$h/2\f$,
/// \f$h = \sqrt{\mathrm{area}/n}\f$, only one is kept. They are left out when they need more than
/// half of the samples: so few samples show the shape better without; but not where nothing else is
/// needed, as all that they bound is flat.
/// \throws Invalid_input_error an option has a value that is not allowed
inline void set_creases(Surface& surface, const Remeshing_options& options,
                        internal::Concurrency concurrency = Sequential_tag())
{
  validate(options);
  surface.creases = surface.seams;
  if (options.feature_angle == 180) return;
  const std::vector<Edge> found =
      find_creases(surface, options.feature_angle, options.number_of_samples, concurrency);
  surface.creases.insert(surface.creases.end(), found.begin(), found.end());
  sort_uniquely(surface.creases);
  const double h = std::sqrt(surface.area / static_cast<double>(options.number_of_samples));
  join_narrow_patches(surface, 0.5 * h);
  const std::size_t kept = surface.kept_vertices.size(), // whatever the creases are
      needed = min_feature_samples(surface), n = options.number_of_samples;
  if (2 * needed > n + kept && !(needed <= n && is_polyhedral(surface)))
    surface.creases = surface.seams;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_SAMPLE_FEATURES_H
