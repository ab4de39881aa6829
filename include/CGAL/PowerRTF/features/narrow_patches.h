// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Creases that the samples cannot resolve: of two that run closer together than samples do, only
// one is kept. (The rim of a thin sheet has two; between them there is room for slivers only.)
#ifndef CGAL_POWER_RTF_FEATURES_NARROW_PATCHES_H
#define CGAL_POWER_RTF_FEATURES_NARROW_PATCHES_H

#include <CGAL/PowerRTF/features/feature_curves.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// What decides which patches are joined.
struct Patch_shape {
  double area = 0, perimeter = 0;
  int loops = 0;              ///< around it
  Vec3d area_vector{0, 0, 0}; ///< sum of the facets' areas times their normals

  double width() const { return 2 * area / perimeter; }
  /// Width and length: of a band between closed curves, or else of the rectangle with this area and
  /// perimeter; infinite if there is none.
  std::array<double, 2> strip() const
  {
    if (loops > 1) return {width(), perimeter / 2};
    const double quarter = perimeter / 4, rest = quarter * quarter - area;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!(rest >= 0)) return {infinity, infinity};
    return {quarter - std::sqrt(rest), quarter + std::sqrt(rest)};
  }
  double flat_area() const
  {
    constexpr double flat = 1 - 1e-4;
    return length(area_vector) > flat * area ? area : 0;
  }
};

/// A curve of creases between two patches; no seam.
struct Crease_curve {
  std::vector<Edge> edges;
  double length = 0;
  std::array<int, 2> patches{-1, -1};
};

/// The patches, by facet, and their shapes; `sides`: of the creases, the patches to the right (seen
/// from the smaller vertex) and to the left.
struct Crease_patches {
  std::vector<int> of_facet;
  std::vector<Patch_shape> shapes;
  std::vector<std::array<int, 2>> sides;

  explicit Crease_patches(const Surface& surface) : sides(surface.creases.size(), {-1, -1})
  {
    const auto& triangles = surface.triangles;
    Facet_adjacency cut = surface.adjacency;
    std::vector<int> crease(cut.opposite.size(), -1); // of the halfedges
    for (int h = 0; h < static_cast<int>(crease.size()); ++h) {
      const Edge edge = sorted_edge(halfedge_source(triangles, h), halfedge_target(triangles, h));
      const auto found = std::lower_bound(surface.creases.begin(), surface.creases.end(), edge);
      if (found == surface.creases.end() || *found != edge) continue;
      crease[h] = static_cast<int>(found - surface.creases.begin());
      cut.opposite[h] = Facet_adjacency::none;
    }
    int count;
    std::tie(of_facet, count) = facet_components(cut);
    shapes.resize(count);
    for (std::size_t f = 0; f < of_facet.size(); ++f) {
      shapes[of_facet[f]].area += surface.facet_areas[f];
      shapes[of_facet[f]].area_vector += surface.facet_areas[f] * surface.facet_normals[f];
    }
    for (int h = 0; h < static_cast<int>(crease.size()); ++h) {
      if (cut.opposite[h] != Facet_adjacency::none) continue;
      const int a = halfedge_source(triangles, h), b = halfedge_target(triangles, h);
      shapes[of_facet[h / 3]].perimeter += length(surface.points[b] - surface.points[a]);
      if (crease[h] >= 0) sides[crease[h]][a < b] = of_facet[h / 3];
    }
    count_loops(cut);
  }

private:
  void count_loops(const Facet_adjacency& cut)
  {
    std::vector<char> seen(cut.opposite.size(), 0);
    for (int h = 0; h < static_cast<int>(seen.size()); ++h) {
      if (cut.opposite[h] != Facet_adjacency::none || seen[h]) continue;
      ++shapes[of_facet[h / 3]].loops;
      for (int g = h; !seen[g];) {
        seen[g] = 1;
        g = next_halfedge(g);
        while (cut.opposite[g] != Facet_adjacency::none) g = next_halfedge(cut.opposite[g]);
      }
    }
  }
};

inline std::vector<Crease_curve> crease_curves(const Surface& surface,
                                               const Crease_patches& patches)
{
  std::vector<Crease_curve> curves;
  for (const Feature_curve& curve : feature_curves(surface, 0)) {
    Crease_curve result;
    bool has_seam = false;
    for (std::size_t k = 0; k + 1 < curve.vertices.size(); ++k) {
      const Edge edge = sorted_edge(curve.vertices[k], curve.vertices[k + 1]);
      const auto crease = std::lower_bound(surface.creases.begin(), surface.creases.end(), edge);
      if (crease == surface.creases.end() || *crease != edge) continue; // a border
      has_seam = has_seam || std::binary_search(surface.seams.begin(), surface.seams.end(), edge);
      result.edges.push_back(edge);
      result.length += length(surface.points[edge[1]] - surface.points[edge[0]]);
      result.patches = patches.sides[crease - surface.creases.begin()];
    }
    if (!result.edges.empty() && !has_seam) curves.push_back(std::move(result));
  }
  return curves;
}

/// Joins narrow patches to their neighbors, the narrowest first.
class Patch_joiner {
public:
  Patch_joiner(std::vector<Patch_shape> shapes, std::vector<Crease_curve> curves, double width)
      : m_shapes(std::move(shapes)), m_curves(std::move(curves)), m_width(width),
        m_joined_to(m_shapes.size()), m_curves_of(m_shapes.size())
  {
    std::iota(m_joined_to.begin(), m_joined_to.end(), 0);
    for (int c = 0; c < static_cast<int>(m_curves.size()); ++c)
      for (const int p : m_curves[c].patches) m_curves_of[p].push_back(c);
  }

  /// \returns the edges of the curves that are taken out, sorted
  std::vector<Edge> run()
  {
    std::set<std::pair<double, int>> narrow; // width, patch
    const auto look_at = [&](int p) {
      if (m_shapes[p].width() < m_width) narrow.insert({m_shapes[p].width(), p});
    };
    for (int p = 0; p < static_cast<int>(m_shapes.size()); ++p) look_at(p);
    std::vector<Edge> dropped;
    while (!narrow.empty()) {
      const int p = narrow.begin()->second;
      narrow.erase(narrow.begin());
      const int c = dispensable_curve(p);
      if (c < 0) continue;
      const int q = other_side(c, p);
      narrow.erase({m_shapes[q].width(), q});
      dropped.insert(dropped.end(), m_curves[c].edges.begin(), m_curves[c].edges.end());
      look_at(join(p, q, c));
    }
    std::sort(dropped.begin(), dropped.end());
    return dropped;
  }

private:
  int root(int p)
  {
    while (m_joined_to[p] != p) p = m_joined_to[p] = m_joined_to[m_joined_to[p]];
    return p;
  }

  /// `p`: where both sides are one patch.
  int other_side(int c, int p)
  {
    const int a = root(m_curves[c].patches[0]), b = root(m_curves[c].patches[1]);
    return a == p ? b : a;
  }

  /// The curve around `p` that is least needed, or -1. Of those at least half as long as the
  /// longest, which make it narrow: one to a patch that is not narrow rather than to one that is,
  /// then to the patch of the smallest flat area, then the longest, the first of equal ones.
  int dispensable_curve(int p)
  {
    constexpr double clearly = 1 + 1e-9;
    double longest = 0;
    for (const int c : m_curves_of[p])
      if (other_side(c, p) != p) longest = (std::max)(longest, m_curves[c].length);
    int best = -1;
    const auto is_less_needed = [&](int c) {
      const Patch_shape &now = m_shapes[other_side(best, p)], &then = m_shapes[other_side(c, p)];
      const bool is_now_narrow = now.width() < m_width, is_then_narrow = then.width() < m_width;
      if (is_now_narrow != is_then_narrow) return is_now_narrow;
      if (then.flat_area() * clearly < now.flat_area()) return true;
      if (now.flat_area() * clearly < then.flat_area()) return false;
      return m_curves[c].length > m_curves[best].length * clearly;
    };
    for (const int c : m_curves_of[p])
      if (other_side(c, p) != p && m_curves[c].length >= 0.5 * longest &&
          (best < 0 || is_less_needed(c)))
        best = c;
    return best;
  }

  /// \returns the number of the patch that both become
  int join(int p, int q, int c)
  {
    if (m_curves_of[p].size() < m_curves_of[q].size()) std::swap(p, q);
    m_joined_to[q] = p;
    m_shapes[p].area += m_shapes[q].area;
    m_shapes[p].area_vector += m_shapes[q].area_vector;
    m_shapes[p].perimeter += m_shapes[q].perimeter - 2 * m_curves[c].length;
    auto& curves = m_curves_of[p];
    const auto middle = curves.insert(curves.end(), m_curves_of[q].begin(), m_curves_of[q].end());
    std::inplace_merge(curves.begin(), middle, curves.end());
    curves.erase(std::unique(curves.begin(), curves.end()), curves.end());
    curves.erase(std::find(curves.begin(), curves.end(), c));
    return p;
  }

  std::vector<Patch_shape> m_shapes;
  std::vector<Crease_curve> m_curves;
  double m_width;
  std::vector<int> m_joined_to;              // by patch
  std::vector<std::vector<int>> m_curves_of; // by patch, increasing
};

} // namespace internal

/// Whether all patches between the creases and borders are flat.
inline bool is_polyhedral(const Surface& surface)
{
  const internal::Crease_patches patches(surface);
  return std::all_of(patches.shapes.begin(), patches.shapes.end(),
                     [](const internal::Patch_shape& p) { return p.flat_area() > 0; });
}

/// Joins each patch narrower than `width` (twice its area over its perimeter) to a neighbor: of
/// the crease curves around it the one that is least needed is taken out of `surface.creases`.
/// Those of large flat patches stay: there everybody sees what is not flat.
inline void join_narrow_patches(Surface& surface, double width)
{
  if (surface.creases.empty()) return;
  internal::Crease_patches patches(surface);
  auto curves = internal::crease_curves(surface, patches);
  const std::vector<Edge> dropped =
      internal::Patch_joiner(std::move(patches.shapes), std::move(curves), width).run();
  std::vector<Edge> kept;
  std::set_difference(surface.creases.begin(), surface.creases.end(), dropped.begin(),
                      dropped.end(), std::back_inserter(kept));
  surface.creases.swap(kept);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_NARROW_PATCHES_H
