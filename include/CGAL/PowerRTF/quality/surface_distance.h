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
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Find_distances.h>
#include <CGAL/PowerRTF/geometry/Group_distances.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/bounding_box.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/quality/distance_bound.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// Walks over a triangulated surface in spatial order: its vertices, and points spread over it.
class Surface_samples {
public:
  /// `tree`: of the triangles.
  Surface_samples(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles,
                  const Facet_tree& tree, Concurrency concurrency)
      : m_facets(tree.view().facets), m_areas(triangles.size() + 1)
  {
    const int facets = static_cast<int>(triangles.size());
    Unset_vector<int> first_corner(points.size()); // in the order of the tree
    for_each_index(concurrency, static_cast<int>(points.size()),
                   [&](int v) { first_corner[v] = 3 * facets; });
    m_areas.back() = 0;
    const auto vertex = [&](int corner) { return triangles[tree.order()[corner / 3]][corner % 3]; };
    for_each_index(concurrency, facets, [&](int place) {
      const auto& f = m_facets[place];
      m_areas[place] = length(cross(f.b - f.a, f.c - f.a)) / 2;
      for (int c = 3 * place; c < 3 * place + 3; ++c) atomic_min(&first_corner[vertex(c)], c);
    });
    exclusive_scan(concurrency, facets + 1, m_areas.data());
    const std::vector<int> first =
        select(concurrency, 3 * facets, [&](int c) { return first_corner[vertex(c)] == c; });
    m_vertices.resize(first.size());
    for_each_index(concurrency, static_cast<int>(first.size()),
                   [&](int v) { m_vertices[v] = points[vertex(first[v])]; });
  }

  /// The used vertices.
  const Unset_vector<Vec3d>& vertices() const { return m_vertices; }

  /// Writes the `size` points from the i-th on, of `n` that are spread evenly by area: every facet
  /// gets its share of them rounded up or down, and they fill the facets as the R2 sequence fills a
  /// square.
  void samples(int begin, int size, int n, Vec3d* points) const
  {
    const auto area_before = [&](int i) { return (i + 0.5) / n * m_areas.back(); };
    auto after = std::upper_bound(m_areas.begin(), m_areas.end() - 1, area_before(begin));
    for (int i = begin; i < begin + size; ++i) {
      while (after != m_areas.end() - 1 && !(area_before(i) < *after)) ++after;
      const auto& f = m_facets[after - m_areas.begin() - 1];
      const auto fraction = [](double x) { return x - std::floor(x); };
      double s = fraction(0.5 + i * 0.7548776662466927), t = fraction(0.5 + i * 0.5698402909980532);
      if (s + t > 1) s = 1 - s, t = 1 - t;
      points[i - begin] = f.a + s * (f.b - f.a) + t * (f.c - f.a);
    }
  }

private:
  const Facet_corners<double>* m_facets; ///< the tree's
  Unset_vector<double> m_areas;          ///< of the facets before this one, and of all
  Unset_vector<Vec3d> m_vertices;
};

struct Squared_distances {
  double sum = 0, sum_of_squares = 0, max_squared = 0;
  Vec3d farthest{0, 0, 0};
};

/// Those of `n` points, of which `write(begin, size, points)` writes some, from `to`. The sums are
/// of no use where `enough` is given, a squared distance up to which the largest one does not
/// count. `found`: the squared distances, where they are known.
template <class Write>
Squared_distances squared_distances(const Facet_tree& to, int n, Concurrency concurrency,
                                    const Write& write, const double* found, double enough = -1)
{
  constexpr int chunk = 1024;
  const int group = Group_distances::group_size(n, to.view().facet_tree.items);
  std::vector<Squared_distances> parts((n + chunk - 1) / chunk);
  for_each_chunk(concurrency, n, chunk, [&](int begin, int end) {
    Group_distances distances(to);
    Squared_distances part;
    Vec3d points[Group_distances::most_points];
    double squared[Group_distances::most_points];
    for (int first = begin; first < end; first += group) {
      const int size = std::min(group, end - first);
      write(first, size, points);
      if (found)
        std::copy_n(found + first, size, squared);
      else
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
  Squared_distances total;
  for (const Squared_distances& part : parts) {
    total.sum += part.sum;
    total.sum_of_squares += part.sum_of_squares;
    if (!(part.max_squared > total.max_squared)) continue;
    total.max_squared = part.max_squared;
    total.farthest = part.farthest;
  }
  return total;
}

/// The squared distances of `n` samples and then of the vertices by `find`; empty where it finds
/// none.
inline Unset_vector<double> found_distances(const Surface_samples& from, const Facet_tree& to,
                                            int n, Concurrency concurrency,
                                            const Find_distances& find)
{
  if (!find) return {};
  constexpr int chunk = 1024;
  Unset_vector<Vec3d> points(n + from.vertices().size());
  for_each_chunk(concurrency, n, chunk,
                 [&](int begin, int end) { from.samples(begin, end - begin, n, &points[begin]); });
  for_each_index(concurrency, int(from.vertices().size()),
                 [&](int v) { points[n + v] = from.vertices()[v]; });
  Unset_vector<double> squared(points.size());
  if (!find(to.all_patches(), int(points.size()), points.data(), squared.data())) return {};
  return squared;
}

/// Distances from `from` to `to`: sums over `n` samples; the maximum over them and the vertices.
inline Squared_distances one_sided_distance(const Surface_samples& from, const Facet_tree& to,
                                            int n, Concurrency concurrency,
                                            const Find_distances& find)
{
  const Unset_vector<double> found = found_distances(from, to, n, concurrency, find);
  Squared_distances result = squared_distances(
      to, n, concurrency,
      [&](int begin, int size, Vec3d* points) { from.samples(begin, size, n, points); },
      found.empty() ? nullptr : found.data());
  const Squared_distances of_vertices = squared_distances(
      to, static_cast<int>(from.vertices().size()), concurrency,
      [&](int begin, int size, Vec3d* points) {
        std::copy_n(from.vertices().begin() + begin, size, points);
      },
      found.empty() ? nullptr : found.data() + n, result.max_squared);
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
/// \param find what finds distances instead, where it does
inline Distance_statistics surface_distance(const std::vector<Vec3d>& input_points,
                                            const std::vector<Triangle>& input_triangles,
                                            const Facet_tree& input_tree,
                                            const std::vector<Vec3d>& output_points,
                                            const std::vector<Triangle>& output_triangles,
                                            internal::Concurrency concurrency = Sequential_tag(),
                                            bool is_bound_wanted = false,
                                            const Find_distances& find = {})
{
  Distance_statistics result;
  if (input_triangles.empty() || output_triangles.empty()) return result;
  const Box3<double> box = internal::bounding_box(input_points, input_triangles, concurrency);
  const double diagonal = length(box.hi - box.lo);
  if (!(diagonal > 0)) return result;

  const int n = 20000;
  const Facet_tree output_tree(output_points, output_triangles, {}, concurrency);
  const auto a = internal::one_sided_distance(
      internal::Surface_samples(input_points, input_triangles, input_tree, concurrency),
      output_tree, n, concurrency, find);
  const auto b = internal::one_sided_distance(
      internal::Surface_samples(output_points, output_triangles, output_tree, concurrency),
      input_tree, n, concurrency, find);
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
        percent * std::max(internal::distance_bound(input_tree, output_tree, max, concurrency),
                           internal::distance_bound(output_tree, input_tree, max, concurrency));
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
