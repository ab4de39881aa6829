// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weighted sample elimination: Yuksel, "Sample Elimination for Generating Poisson Disk Sample Sets"
// (2015), with distances relative to the local spacing.
#ifndef CGAL_POWER_RTF_SAMPLING_SAMPLE_ELIMINATION_H
#define CGAL_POWER_RTF_SAMPLING_SAMPLE_ELIMINATION_H

#include <CGAL/PowerRTF/geometry/point_grid.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// Which candidates see each other: closer than the sum of their radii, normals compatible.
/// The neighbors of `i` are `neighbor[first[i]] .. neighbor[first[i + 1] - 1]`, with how much they
/// crowd each other: Yuksel's weight, from 0 (radii touch) to 1 (same place).
struct Candidate_graph {
  std::vector<std::size_t> first;
  std::vector<int> neighbor;
  std::vector<double> crowding;
};

/// Candidates are sorted into one grid per power of two of their radius. Each looks for partners of
/// its own level and of coarser ones, so its work does not grow with the contrast of the radii.
inline Candidate_graph candidate_graph(const std::vector<Vec3d>& points,
                                       const std::vector<Vec3d>& normals,
                                       const std::vector<double>& radii, double cos_normal_angle)
{
  const int n = static_cast<int>(points.size());
  const double smallest = *std::min_element(radii.begin(), radii.end());
  std::vector<int> level(n);
  std::vector<std::vector<int>> members;
  std::vector<double> largest; // radius in a level
  for (int i = 0; i < n; ++i) {
    level[i] = std::ilogb(radii[i] / smallest);
    if (level[i] >= static_cast<int>(members.size())) {
      members.resize(level[i] + 1);
      largest.resize(level[i] + 1, 0);
    }
    members[level[i]].push_back(i);
    largest[level[i]] = (std::max)(largest[level[i]], radii[i]);
  }
  std::vector<Point_grid> grids;
  for (std::size_t l = 0; l < members.size(); ++l)
    grids.emplace_back(points, members[l], 2 * largest[l]);

  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(8 * points.size());
  for (int i = 0; i < n; ++i) {
    Cancellation::poll();
    for (int l = level[i]; l < static_cast<int>(grids.size()); ++l) {
      if (members[l].empty()) continue;
      grids[l].for_each_near(points[i], radii[i] + largest[l], [&](int j, double squared_distance) {
        if (l == level[i] && j <= i) return; // every pair once
        const double reach = radii[i] + radii[j];
        if (squared_distance < reach * reach && dot(normals[i], normals[j]) >= cos_normal_angle)
          pairs.emplace_back(i, j);
      });
    }
  }

  Candidate_graph graph;
  graph.first.assign(n + 1, 0);
  for (const auto& [i, j] : pairs) {
    ++graph.first[i + 1];
    ++graph.first[j + 1];
  }
  for (int i = 0; i < n; ++i) graph.first[i + 1] += graph.first[i];
  graph.neighbor.resize(2 * pairs.size());
  graph.crowding.resize(2 * pairs.size());
  std::vector<std::size_t> end(graph.first.begin(), graph.first.end() - 1);
  for (const auto& [i, j] : pairs) {
    const double free = 1 - length(points[i] - points[j]) / (radii[i] + radii[j]);
    const double free_2 = free * free, free_4 = free_2 * free_2;
    const double crowding = free_4 * free_4; // alpha = 8
    graph.neighbor[end[i]] = j;
    graph.crowding[end[i]++] = crowding;
    graph.neighbor[end[j]] = i;
    graph.crowding[end[j]++] = crowding;
  }
  return graph;
}

} // namespace internal

/// Chooses `n` of the candidates so that they lie far from each other: the candidate with the
/// closest surroundings goes first, until `n` are left.
/// \param radii half the distance that the chosen samples would have at each candidate if they were
///   packed as densely as possible
/// \param cos_normal_angle candidates whose normals' dot product is below it do not see each other
///   (NVISPC)
/// \returns the indices of the chosen candidates, increasing
inline std::vector<int> eliminate_samples(const std::vector<Vec3d>& points,
                                          const std::vector<Vec3d>& normals,
                                          const std::vector<double>& radii, double cos_normal_angle,
                                          std::size_t n, std::size_t fixed = 0)
{
  const internal::Candidate_graph graph =
      internal::candidate_graph(points, normals, radii, cos_normal_angle);
  std::vector<char> is_alive(points.size(), 1);
  const auto weight = [&](int i) {
    double sum = 0;
    for (std::size_t e = graph.first[i]; e < graph.first[i + 1]; ++e)
      if (is_alive[graph.neighbor[e]]) sum += graph.crowding[e];
    return sum;
  };

  // Weights only fall, so the right candidate is on top of the heap as soon as the weight on top is
  // up to date. Weights are summed anew, not updated by subtraction: the last two neighbors have
  // the same weight, and rounding must not choose between them.
  using Entry = std::pair<double, int>; // weight, candidate; ties by index
  const int candidates = static_cast<int>(points.size() - fixed);
  std::vector<char> is_outdated(points.size(), 0);
  std::vector<Entry> heap;
  heap.reserve(points.size());
  for (int i = 0; i < candidates; ++i) heap.emplace_back(weight(i), i);
  std::make_heap(heap.begin(), heap.end());
  while (heap.size() > n) {
    internal::Cancellation::poll();
    std::pop_heap(heap.begin(), heap.end());
    const int i = heap.back().second;
    if (is_outdated[i]) {
      heap.back().first = weight(i);
      is_outdated[i] = 0;
      std::push_heap(heap.begin(), heap.end());
      continue;
    }
    heap.pop_back();
    is_alive[i] = 0;
    for (std::size_t e = graph.first[i]; e < graph.first[i + 1]; ++e)
      is_outdated[graph.neighbor[e]] = 1;
  }

  std::vector<int> chosen;
  chosen.reserve(n);
  for (int i = 0; i < candidates; ++i)
    if (is_alive[i]) chosen.push_back(i);
  return chosen;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_SAMPLE_ELIMINATION_H
