// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples along curves: on their corners, and between them as far apart as the density says.
#ifndef CGAL_POWER_RTF_FEATURES_CURVE_SAMPLES_H
#define CGAL_POWER_RTF_FEATURES_CURVE_SAMPLES_H

#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/features/feature_curves.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

struct Curve_samples {
  std::vector<Edge_place> places;
  std::vector<Edge> edges; ///< pairs of neighbors on a curve
};

namespace internal {

class Curve_sampler {
public:
  Curve_sampler(const Surface& surface, const std::vector<Feature_curve>& curves)
      : m_surface(surface), m_curves(curves)
  {
    for (const Feature_curve& curve : curves) {
      std::vector<double> sums(1, 0);
      for (std::size_t k = 0; k + 1 < curve.vertices.size(); ++k)
        sums.push_back(sums.back() + weighted_length(curve.vertices[k], curve.vertices[k + 1]));
      m_sums.push_back(std::move(sums));
    }
  }

  /// The number of samples that `run()` makes.
  std::size_t count(double spacing) const
  {
    return count(spacing, [](const Feature_curve&) { return true; });
  }
  /// The same of those at the mirror.
  std::size_t count_at_mirror(double spacing) const
  {
    return count(spacing, [](const Feature_curve& c) { return c.is_mirror; });
  }
  /// Makes so many at the mirror: spaced wider where there would be more, and the longest curve
  /// gets what is missing.
  void set_count_at_mirror(std::size_t wanted, double spacing)
  {
    const std::size_t most =
        (std::max)(wanted, count_at_mirror(std::numeric_limits<double>::infinity()));
    while (count_at_mirror(spacing) > most) m_stretch *= 1.05;
    for (std::size_t c = 0; c < m_curves.size(); ++c)
      if (m_curves[c].is_mirror &&
          (m_adapted == none || m_sums[c].back() > m_sums[m_adapted].back()))
        m_adapted = c;
    m_added = static_cast<double>(wanted) - static_cast<double>(count_at_mirror(spacing));
  }

  /// `spacing`: the constant C of the spacing C / sqrt(rho).
  Curve_samples run(double spacing) const
  {
    Curve_samples result;
    std::map<int, int> corners; // vertex -> sample
    const auto corner_sample = [&](int v) {
      const auto [it, is_new] = corners.insert({v, static_cast<int>(result.places.size())});
      if (is_new) result.places.push_back({v, v, 0});
      return it->second;
    };
    for (std::size_t c = 0; c < m_curves.size(); ++c) {
      const Feature_curve& curve = m_curves[c];
      int last = curve.has_corners ? corner_sample(curve.vertices.front()) : -1;
      const int first = static_cast<int>(result.places.size());
      const std::size_t n = segments(c, spacing);
      for (std::size_t s = curve.has_corners ? 1 : 0; s < n; ++s) {
        const int now = static_cast<int>(result.places.size());
        result.places.push_back(place(c, static_cast<double>(s) / static_cast<double>(n)));
        if (last >= 0) result.edges.push_back({last, now});
        last = now;
      }
      if (curve.vertices.size() > 1)
        result.edges.push_back(
            {last, curve.has_corners ? corner_sample(curve.vertices.back()) : first});
    }
    return result;
  }

private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Of the curves that are wanted.
  template <class IsWanted>
  std::size_t count(double spacing, const IsWanted& is_wanted) const
  {
    std::size_t count = 0;
    std::vector<int> corners;
    for (std::size_t c = 0; c < m_curves.size(); ++c) {
      if (!is_wanted(m_curves[c])) continue;
      count += segments(c, spacing);
      if (!m_curves[c].has_corners) continue;
      --count;
      corners.push_back(m_curves[c].vertices.front());
      corners.push_back(m_curves[c].vertices.back());
    }
    sort_uniquely(corners);
    return count + corners.size();
  }

  /// Length of edge `ab` times sqrt(rho), integrated over the linear density.
  double weighted_length(int a, int b) const
  {
    const double ra = std::sqrt(m_surface.vertex_density[a]);
    const double rb = std::sqrt(m_surface.vertex_density[b]);
    const double mean = 2. / 3 * (ra * ra + ra * rb + rb * rb) / (ra + rb);
    return mean * length(m_surface.points[b] - m_surface.points[a]);
  }

  /// Whether a curve leads from the mirror to the mirror, and would be its own image as one edge.
  bool is_bow(const Feature_curve& curve) const
  {
    const std::vector<Vec3d>& points = m_surface.points;
    return !curve.is_mirror && m_surface.is_at_mirror(points[curve.vertices.front()]) &&
           m_surface.is_at_mirror(points[curve.vertices.back()]);
  }

  std::size_t segments(std::size_t c, double spacing) const
  {
    const Feature_curve& curve = m_curves[c];
    if (curve.vertices.size() == 1 || curve.is_kept) return 1;
    const bool is_closed = curve.vertices.front() == curve.vertices.back();
    const double least = is_closed ? 3 : curve.parallels > 1 || is_bow(curve) ? 2 : 1;
    constexpr double most = 1e9; // more than memory holds
    if (curve.is_mirror) spacing *= m_stretch;
    const double fitting = std::floor(m_sums[c].back() / spacing + 0.5);
    const double segments = std::clamp(fitting, least, most);
    return static_cast<std::size_t>(c == m_adapted ? (std::max)(least, segments + m_added)
                                                   : segments);
  }

  /// The place on curve `c` with the given share of its weighted length before it.
  Edge_place place(std::size_t c, double share) const
  {
    constexpr double near = 1e-5; // so near an end that it is taken for the end
    const std::vector<double>& sums = m_sums[c];
    const std::vector<int>& vertices = m_curves[c].vertices;
    const double sum = share * sums.back();
    const std::size_t k =
        std::upper_bound(sums.begin() + 1, sums.end() - 1, sum) - sums.begin() - 1;
    const double length = sums[k + 1] - sums[k];
    const double at = length > 0 ? (sum - sums[k]) / length : 0.5; // two vertices at one point
    if (at < near) return {vertices[k], vertices[k], 0};
    if (at > 1 - near) return {vertices[k + 1], vertices[k + 1], 0};
    return {vertices[k], vertices[k + 1], at};
  }

  const Surface& m_surface;
  const std::vector<Feature_curve>& m_curves;
  std::vector<std::vector<double>> m_sums; // of each curve: weighted length up to each vertex
  std::size_t m_adapted = none;            // the curve that gets `m_added` segments more
  double m_added = 0;
  double m_stretch = 1; // of the spacing at the mirror
};

} // namespace internal
} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_CURVE_SAMPLES_H
