// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two-sided distance between two triangulated surfaces (Metro: Cignoni, Rocchini and Scopigno,
// 1998): the paper's d_H fits its RMS. Exact nearest points at fixed, area-weighted samples, so the
// result is deterministic; its mean and RMS are estimates good to about 1 %, its maximum a lower
// bound that takes in every vertex.
#ifndef CGAL_POWER_RTF_QUALITY_SURFACE_DISTANCE_H
#define CGAL_POWER_RTF_QUALITY_SURFACE_DISTANCE_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/Area_samples.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Group_distances.h>
#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/bounding_box.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/quality/distance_bound.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// The vertices of triangles in the order of a tree.
struct Ordered_vertices {
  const std::vector<Triangle>& triangles;
  const std::vector<int>& order;

  int operator()(int corner) const { return triangles[order[corner / 3]][corner % 3]; }
};

/// Walks over a triangulated surface in spatial order: its vertices, and points spread over it.
class Surface_samples {
public:
  /// `tree`: of the triangles.
  Surface_samples(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles,
                  const Facet_tree& tree, Concurrency concurrency)
      : m_facets(tree.view().facets), m_areas(triangles.size() + 1)
  {
    const int facets = static_cast<int>(triangles.size());
    Unset_vector<int> of_vertex(points.size());
    for_each_index(concurrency, static_cast<int>(points.size()),
                   [&](int v) { of_vertex[v] = 3 * facets; });
    const Facet_areas areas{m_facets, facets, m_areas.data()};
    const First_corners<Ordered_vertices> first{{triangles, tree.order()}, of_vertex.data()};
    areas(facets);
    for_each_index(concurrency, facets, [&](int place) {
      areas(place);
      for (int c = 3 * place; c < 3 * place + 3; ++c) first(c);
    });
    exclusive_scan(concurrency, facets + 1, m_areas.data());
    const std::vector<int> corners =
        select(concurrency, 3 * facets, [&](int c) { return first.has(c); });
    m_vertices.resize(corners.size());
    for_each_index(concurrency, static_cast<int>(corners.size()),
                   [&](int v) { m_vertices[v] = points[first.vertex_of(corners[v])]; });
  }

  /// The used vertices.
  const Unset_vector<Vec3d>& vertices() const { return m_vertices; }

  Area_samples samples(int n) const
  {
    return {m_facets, m_areas.data(), static_cast<int>(m_areas.size()) - 1, n};
  }

private:
  const Facet_corners<double>* m_facets; ///< the tree's
  Unset_vector<double> m_areas;          ///< of the facets before this one, and of all
  Unset_vector<Vec3d> m_vertices;
};

/// Those of the `n` points `point(i)` from `to`. The sums are of no use where `enough` is given, a
/// squared distance up to which the largest one does not count.
template <class Point>
Sampled_distances sampled_distances(const Facet_tree& to, int n, Concurrency concurrency,
                                    const Point& point, double enough = -1)
{
  constexpr int chunk = 1024;
  const int group = Group_distances::group_size(n, to.view().facet_tree.items);
  std::vector<Sampled_distances> parts((n + chunk - 1) / chunk);
  for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
    Group_distances distances(to);
    Sampled_distances part;
    Vec3d points[Group_distances::most_points];
    double squared[Group_distances::most_points];
    for (int first = begin; first < end; first += group) {
      const int size = std::min(group, end - first);
      for (int k = 0; k < size; ++k) points[k] = point(first + k);
      distances.find(points, size, squared, enough);
      for (int k = 0; k < size; ++k) {
        part.sum += std::sqrt(squared[k]);
        part.sum_of_squares += squared[k];
        if (!(squared[k] > part.max_squared)) continue;
        part.max_squared = squared[k];
        part.farthest = points[k];
      }
    }
    parts[begin / chunk] = part;
  });
  Sampled_distances total;
  for (const Sampled_distances& part : parts) {
    total.sum += part.sum;
    total.sum_of_squares += part.sum_of_squares;
    if (!(part.max_squared > total.max_squared)) continue;
    total.max_squared = part.max_squared;
    total.farthest = part.farthest;
  }
  return total;
}

/// Distances from `from` to `to`: sums over `n` samples; the maximum over them and the vertices.
inline Sampled_distances one_sided_distance(const Surface_samples& from, const Facet_tree& to,
                                            int n, Concurrency concurrency)
{
  Sampled_distances result = sampled_distances(to, n, concurrency, from.samples(n));
  const Unset_vector<Vec3d>& vertices = from.vertices();
  const Sampled_distances of_vertices = sampled_distances(
      to, static_cast<int>(vertices.size()), concurrency, [&](int v) { return vertices[v]; },
      result.max_squared);
  if (of_vertices.max_squared > result.max_squared) {
    result.max_squared = of_vertices.max_squared;
    result.farthest = of_vertices.farthest;
  }
  return result;
}

} // namespace internal

/// Distance between the surfaces `input` and `output` (points, and #F indices into them), in per
/// cent of the diagonal of the input's bounding box. Mean and RMS are those of the worse direction,
/// from 20000 samples each way; the maximum takes in all vertices of both. All zero when one of the
/// surfaces has no facet or the input no extent.
///
/// \param input_tree of the input's triangles
/// \param is_bound_wanted find the upper bound, too
/// \param there where an engine, whose surface is `input`, has `output`; or null
inline Distance_statistics surface_distance(const std::vector<Vec3d>& input_points,
                                            const std::vector<Triangle>& input_triangles,
                                            const Facet_tree& input_tree,
                                            const std::vector<Vec3d>& output_points,
                                            const std::vector<Triangle>& output_triangles,
                                            internal::Concurrency concurrency = Sequential_tag(),
                                            bool is_bound_wanted = false,
                                            Resident_mesh* there = nullptr)
{
  Distance_statistics result;
  if (input_triangles.empty() || output_triangles.empty()) return result;
  const Box3<double> box = internal::bounding_box(input_points, input_triangles, concurrency);
  const double diagonal = length(box.hi - box.lo);
  if (!(diagonal > 0)) return result;

  const int n = 20000;
  Two_sided_distances sides;
  const bool is_found = there && there->find_distances(n, sides);
  std::optional<Facet_tree> output_tree;
  if (!is_found || is_bound_wanted)
    output_tree.emplace(output_points, output_triangles, std::vector<int>(), concurrency);
  if (!is_found) {
    using Samples = internal::Surface_samples;
    sides.from_surface = internal::one_sided_distance(
        Samples(input_points, input_triangles, input_tree, concurrency), *output_tree, n,
        concurrency);
    sides.from_mesh = internal::one_sided_distance(
        Samples(output_points, output_triangles, *output_tree, concurrency), input_tree, n,
        concurrency);
  }
  const auto& [a, b] = sides;
  const double percent = 100 / diagonal;
  result.mean = percent * std::max(a.sum, b.sum) / n;
  result.rms = percent * std::sqrt(std::max(a.sum_of_squares, b.sum_of_squares) / n);
  const auto& farther = a.max_squared > b.max_squared ? a : b;
  const double max = std::sqrt(farther.max_squared);
  result.max = percent * max;
  const Vec3d& farthest = farther.farthest;
  std::tie(result.farthest[0], result.farthest[1], result.farthest[2]) =
      std::tie(farthest.x, farthest.y, farthest.z);
  if (is_bound_wanted)
    result.bound =
        percent * std::max(internal::distance_bound(input_tree, *output_tree, max, concurrency),
                           internal::distance_bound(*output_tree, input_tree, max, concurrency));
  return result;
}

/// The same with a tree of its own.
inline Distance_statistics surface_distance(const std::vector<Vec3d>& input_points,
                                            const std::vector<Triangle>& input_triangles,
                                            const std::vector<Vec3d>& output_points,
                                            const std::vector<Triangle>& output_triangles,
                                            internal::Concurrency concurrency = Sequential_tag())
{
  return surface_distance(input_points, input_triangles,
                          Facet_tree(input_points, input_triangles, {}, concurrency), output_points,
                          output_triangles, concurrency);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_QUALITY_SURFACE_DISTANCE_H
