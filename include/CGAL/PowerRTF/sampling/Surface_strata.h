// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Stratified points of a surface: one in each of many parts of equal mass.
#ifndef CGAL_POWER_RTF_SAMPLING_SURFACE_STRATA_H
#define CGAL_POWER_RTF_SAMPLING_SURFACE_STRATA_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/hilbert_code.h>
#include <CGAL/PowerRTF/geometry/surface_geometry.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/sampling/component_shares.h>
#include <CGAL/PowerRTF/sampling/initial_sampling.h>
#include <CGAL/PowerRTF/sampling/random_source.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// Maps a surface to the cube [-1, 1]^3 around it, where neither its size nor its position decides
/// anything.
struct Surface_cube {
  Vec3d middle;
  double scale;

  explicit Surface_cube(const Surface& surface)
  {
    Box3<double> box{surface.points[0], surface.points[0]};
    for (const Vec3d& p : surface.points) box.add(p);
    const Vec3d size = box.hi - box.lo;
    middle = 0.5 * (box.lo + box.hi);
    scale = 2 / (std::max)({size.x, size.y, size.z});
  }
  Vec3d to_inside(const Vec3d& p) const { return (p - middle) * scale; }
  Vec3d to_outside(const Vec3d& p) const { return p * (1 / scale) + middle; }
};

/// A surface unrolled: its facets component by component, in spatial order, and each facet along
/// the curve that bisects it again and again (Sierpinski's). Where parts of equal mass follow each
/// other along that curve, each is in one piece and about as wide as it is long.
class Surface_strata {
public:
  /// Keeps a reference to `surface`. The mass of a component, over all parts of it, is its number
  /// of samples, spread like the density.
  /// \param component of each facet
  Surface_strata(const Surface& surface, const std::vector<int>& component,
                 const std::vector<Component_share>& shares, internal::Concurrency concurrency)
      : m_surface(surface)
  {
    const Surface_cube cube(surface);
    m_facets = internal::select(concurrency, static_cast<int>(component.size()),
                                [&](int f) { return shares[component[f]].samples > 0; });
    const int size = static_cast<int>(m_facets.size());
    internal::Unset_vector<std::tuple<int, std::uint64_t, int>> order(size);
    internal::for_each_index(concurrency, size, [&](int k) {
      const int f = m_facets[k];
      const Triangle& t = surface.triangles[f];
      const auto& p = surface.points;
      const Vec3d center = (p[t[0]] + p[t[1]] + p[t[2]]) * (1. / 3);
      order[k] = {component[f], hilbert_code(cube.to_inside(center)), f};
    });
    internal::sort(concurrency, order.begin(), order.end());
    m_sums.resize(size + 1);
    m_sums[size] = 0;
    internal::for_each_index(concurrency, size, [&](int k) {
      const int f = m_facets[k] = std::get<2>(order[k]);
      const Component_share& share = shares[component[f]];
      const double per_mass = static_cast<double>(share.samples) / share.mass;
      m_sums[k] = per_mass * internal::density_mass(surface, f);
    });
    internal::exclusive_scan(concurrency, size + 1, m_sums.data());
  }

  double mass() const { return m_sums.back(); }

  /// A point at random in the `index`-th of `count` parts of equal mass.
  Facet_place place(std::size_t index, std::size_t count, std::uint64_t seed) const
  {
    const double part = mass() / static_cast<double>(count);
    const double sum = part * (static_cast<double>(index) + counted_random(seed, index, 0));
    const auto above = std::upper_bound(m_sums.begin() + 1, m_sums.end() - 1, sum);
    const std::size_t k = above - m_sums.begin() - 1;
    const int f = m_facets[k];
    double share = (sum - m_sums[k]) / (m_sums[k + 1] - m_sums[k]);
    double left = (m_sums[k + 1] - m_sums[k]) / part; // parts in what is left of the facet
    Corners corners = longest_edge_first(f);
    for (; left > 1; left /= 2) {
      const double first = share_of_first_half(f, corners);
      const bool goes_first = share < first;
      share = goes_first ? share / first : (share - first) / (1 - first);
      corners = half(corners, goes_first);
    }
    // Uniform in the triangle that is left.
    double a = counted_random(seed, index, 1), b = counted_random(seed, index, 2);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    Facet_place result{f, {0, 0, 0}};
    for (int i = 0; i < 3; ++i)
      result.weights[i] = (1 - a - b) * corners[0][i] + a * corners[1][i] + b * corners[2][i];
    return result;
  }

private:
  using Corners = std::array<std::array<double, 3>, 3>; ///< base, base, apex

  Corners longest_edge_first(int f) const
  {
    const Triangle& t = m_surface.triangles[f];
    const auto& p = m_surface.points;
    int longest = 0;
    double length_2 = 0;
    constexpr double clearly = 1 + 1e-9; // rounding must not decide between equal edges
    for (int i = 0; i < 3; ++i) {
      const double l = squared_length(p[t[(i + 1) % 3]] - p[t[i]]);
      if (l > clearly * length_2) longest = i, length_2 = l;
    }
    Corners corners{};
    for (int i = 0; i < 3; ++i) corners[i][(longest + i) % 3] = 1;
    return corners;
  }

  /// The curve through a triangle runs from the base's first end to its second; halved at the
  /// middle of the base, it passes the apex.
  static Corners half(const Corners& c, bool first)
  {
    std::array<double, 3> middle;
    for (int i = 0; i < 3; ++i) middle[i] = (c[0][i] + c[1][i]) / 2;
    return first ? Corners{c[0], c[2], middle} : Corners{c[2], c[1], middle};
  }

  double share_of_first_half(int f, const Corners& c) const
  {
    const Triangle& t = m_surface.triangles[f];
    const auto density = [&](const std::array<double, 3>& w) {
      const auto& rho = m_surface.vertex_density;
      return w[0] * rho[t[0]] + w[1] * rho[t[1]] + w[2] * rho[t[2]];
    };
    const double a = density(c[0]), b = density(c[1]), apex = density(c[2]), m = (a + b) / 2;
    return (a + m + apex) / (a + b + 2 * (m + apex));
  }

  const Surface& m_surface;
  std::vector<int> m_facets;
  internal::Unset_vector<double> m_sums; // of the masses of the facets before
};

/// A random point in each of as many parts of equal mass as there are samples.
template <class Backend>
Samples stratified_samples(Backend& backend, const Surface& surface,
                           const std::vector<int>& component,
                           const std::vector<Component_share>& shares, std::uint64_t seed)
{
  const Surface_strata strata(surface, component, shares, backend.concurrency());
  const int n = static_cast<int>(std::lround(strata.mass()));
  std::vector<Facet_place> places(n);
  backend.for_each(n, [&](int i) { places[i] = strata.place(i, n, seed); });
  Samples samples;
  internal::add_samples(surface, places, samples, backend.concurrency());
  return samples;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_SURFACE_STRATA_H
