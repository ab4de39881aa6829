// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weighted sample elimination on the host, with distances relative to the local spacing.
#ifndef CGAL_POWER_RTF_SAMPLING_SAMPLE_ELIMINATION_H
#define CGAL_POWER_RTF_SAMPLING_SAMPLE_ELIMINATION_H

#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/sampling/Candidate_elimination.h>
#include <CGAL/PowerRTF/sampling/candidate_graph.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// As neighbors of a `Candidate_elimination`.
struct Candidate_graph_view {
  const Candidate_graph* graph;
  template <class F>
  void for_each_neighbor(int k, F f) const
  {
    graph->for_each_neighbor(k, f);
  }
};

/// Lets active candidates go one after the other: the first one is on top of a heap as soon as the
/// weight on top is up to date.
struct Eliminate_in_turn {
  Elimination_view<Candidate_graph_view> view;

  bool operator()(const int* active, int size, double least) const
  {
    using Entry = std::pair<std::pair<double, int>, int>; // weight, candidate; place
    const auto entry = [&](int k) { return Entry{{view.weights[k], view.order[k]}, k}; };
    std::vector<Entry> heap;
    for (int a = 0; a < size; ++a) heap.push_back(entry(active[a]));
    std::make_heap(heap.begin(), heap.end());
    while (!heap.empty()) {
      Cancellation::poll();
      std::pop_heap(heap.begin(), heap.end());
      const Entry before = heap.back();
      const int k = before.second;
      heap.pop_back();
      view.update_weight(k);
      if (view.weights[k] < least) continue;
      if (entry(k) == before) {
        view.is_alive[k] = 0;
      } else {
        heap.push_back(entry(k));
        std::push_heap(heap.begin(), heap.end());
      }
    }
    return true;
  }
};

/// See `eliminate_samples()`.
template <class ConcurrencyTag>
std::vector<int> eliminated_once(const Elimination_candidates& candidates, double cos_normal_angle,
                                 std::size_t n, std::size_t fixed)
{
  using Backend = Host_backend<ConcurrencyTag>;
  const Candidate_graph graph = candidate_graph(candidates, cos_normal_angle, ConcurrencyTag());
  const int size = static_cast<int>(candidates.size()), free = size - static_cast<int>(fixed);
  Backend backend;
  Candidate_elimination<Backend, Candidate_graph_view> elimination(backend, {&graph},
                                                                   graph.order.data(), size, free);
  elimination.run(n, Eliminate_in_turn{elimination.view()});
  std::vector<int> left(free);
  left.resize(elimination.write_left(left.data()));
  return left;
}

} // namespace internal

/// Chooses `n` of the candidates so that they lie far from each other: the candidate with the
/// closest surroundings goes first, until `n` are left. If so many more are left that do not see
/// each other, they look farther.
/// \param cos_normal_angle candidates whose normals' dot product is below it do not see each other
///   (NVISPC)
/// \param fixed so many candidates, the last ones, crowd the others, but are not among the `n`
/// \returns the indices of the chosen candidates, increasing
inline std::vector<int> eliminate_samples(const internal::Elimination_candidates& candidates,
                                          double cos_normal_angle, std::size_t n,
                                          std::size_t fixed = 0,
                                          internal::Concurrency concurrency = Sequential_tag())
{
  constexpr int patience = 16; // then those with other normals see each other, too
  constexpr double any_normal = -2, farther = 1.25;
  const auto chosen = [&](const internal::Elimination_candidates& among, double cos_angle) {
    return concurrency.is_parallel()
               ? internal::eliminated_once<Parallel_if_available_tag>(among, cos_angle, n, fixed)
               : internal::eliminated_once<Sequential_tag>(among, cos_angle, n, fixed);
  };
  if (n == 0) return {}; // a last one sees no other
  std::vector<int> left = chosen(candidates, cos_normal_angle);
  double reach = 1;
  for (int round = 1; left.size() > n; ++round) {
    reach *= farther;
    internal::Elimination_candidates rest;
    for (const int i : left) rest.push_back(candidates[i]);
    rest.insert(rest.end(), candidates.end() - fixed, candidates.end());
    for (auto& candidate : rest) candidate.radius *= reach;
    std::vector<int> next = chosen(rest, round < patience ? cos_normal_angle : any_normal);
    for (int& k : next) k = left[k];
    left.swap(next);
  }
  return left;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_SAMPLE_ELIMINATION_H
