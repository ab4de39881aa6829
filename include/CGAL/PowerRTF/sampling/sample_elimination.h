// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weighted sample elimination: Yuksel, "Sample Elimination for Generating Poisson Disk Sample Sets"
// (2015), with distances relative to the local spacing.
#ifndef CGAL_POWER_RTF_SAMPLING_SAMPLE_ELIMINATION_H
#define CGAL_POWER_RTF_SAMPLING_SAMPLE_ELIMINATION_H

#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/sampling/candidate_graph.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// The candidate with the largest weight goes first, of equal ones the last.
///
/// Weights only fall. So a candidate that comes before all its neighbors goes before them, with the
/// weight that it has, whatever happens elsewhere: many go at once, and each with the weight that
/// it has when one goes after the other. Down to a threshold, it is the same candidates that go.
class Sample_elimination {
  using Entry = std::pair<double, int>; ///< weight, candidate

public:
  /// The last `fixed` candidates stay.
  Sample_elimination(Candidate_graph&& graph, std::size_t fixed, Concurrency concurrency)
      : m_graph(std::move(graph)), m_concurrency(concurrency),
        m_size(static_cast<int>(m_graph.order.size())), m_free(m_size - static_cast<int>(fixed)),
        m_is_alive(m_size), m_weight(m_size)
  {
    for_each_index(concurrency, m_size, [&](int k) { m_is_alive[k] = 1; });
  }

  /// The free candidates that are left, increasing: `n`, or more that do not see each other.
  std::vector<int> run(std::size_t n)
  {
    constexpr double seen = std::numeric_limits<double>::min(); // the least weight
    const std::size_t excess = m_free > static_cast<int>(n) ? m_free - n : 0;
    for (bool progress = true; progress && m_gone.size() < excess;) {
      const std::size_t before = m_gone.size();
      for_each_index(m_concurrency, m_size, [&](int k) { update_weight(k); });
      eliminate_down_to(std::max(threshold(excess - before), seen));
      progress = m_gone.size() > before;
    }
    // The last ones stay, after all.
    const auto end = m_gone.begin() + std::min(excess, m_gone.size());
    std::nth_element(m_gone.begin(), end, m_gone.end(),
                     [&](int j, int k) { return comes_before(j, k); });
    for (auto k = end; k != m_gone.end(); ++k) m_is_alive[*k] = 1;
    Unset_vector<char> is_left(m_size);
    for_each_index(m_concurrency, m_size,
                   [&](int k) { is_left[m_graph.order[k]] = m_is_alive[k] && is_free(k); });
    return select(m_concurrency, m_size, [&](int i) { return is_left[i]; });
  }

private:
  bool is_free(int k) const { return m_graph.order[k] < m_free; }
  Entry entry(int k) const { return {m_weight[k], m_graph.order[k]}; }
  bool comes_before(int j, int k) const { return entry(j) > entry(k); }

  template <class F>
  void for_each_alive_neighbor(int k, F&& f) const
  {
    m_graph.for_each_neighbor(k, [&](const auto& neighbor) {
      if (m_is_alive[neighbor.place]) f(neighbor);
    });
  }

  /// Weights are summed anew, not updated by subtraction: the last two neighbors have the same
  /// weight, and rounding must not choose between them.
  void update_weight(int k)
  {
    if (!m_is_alive[k]) return;
    double sum = 0;
    for_each_alive_neighbor(k, [&](const auto& neighbor) { sum += neighbor.crowding; });
    m_weight[k] = sum;
  }

  bool is_first(int k) const
  {
    bool result = true;
    for_each_alive_neighbor(k, [&](const auto& neighbor) {
      result = result && (!is_free(neighbor.place) || comes_before(k, neighbor.place));
    });
    return result;
  }

  /// The items with `is_wanted(item)`.
  template <class Is_wanted>
  std::vector<int> selected(const std::vector<int>& items, const Is_wanted& is_wanted) const
  {
    std::vector<int> result = select(m_concurrency, static_cast<int>(items.size()),
                                     [&](int a) { return is_wanted(items[a]); });
    for_each_index(m_concurrency, static_cast<int>(result.size()),
                   [&](int b) { result[b] = items[result[b]]; });
    return result;
  }

  /// A weight that some more than `count` of the candidates have, as far as a part of them shows.
  double threshold(std::size_t count) const
  {
    constexpr int largest_part = 1 << 16;
    const int stride = m_size / largest_part + 1;
    std::vector<double> weights;
    for (int k = 0; k < m_size; k += stride)
      if (m_is_alive[k] && is_free(k)) weights.push_back(m_weight[k]);
    if (weights.empty()) return 0;
    const std::size_t rank = count / stride, rest = weights.size() - std::min(weights.size(), rank);
    const std::size_t place =
        std::min(rank + std::min(rank, rest / 2) + rest / 1024, weights.size() - 1);
    std::nth_element(weights.begin(), weights.begin() + place, weights.end(),
                     std::greater<double>());
    return weights[place];
  }

  /// Eliminates the candidates that have at least the weight `least` when their turn comes.
  void eliminate_down_to(double least)
  {
    constexpr int max_rounds = 32;
    std::vector<int> active = select(m_concurrency, m_size, [&](int k) {
      return m_is_alive[k] && is_free(k) && m_weight[k] >= least;
    });
    for (int round = 0; round < max_rounds && !active.empty(); ++round) {
      const std::vector<int> first = selected(active, [&](int k) { return is_first(k); });
      for_each_index(m_concurrency, static_cast<int>(first.size()),
                     [&](int a) { m_is_alive[first[a]] = 0; });
      m_gone.insert(m_gone.end(), first.begin(), first.end());
      for_each_index(m_concurrency, static_cast<int>(active.size()),
                     [&](int a) { update_weight(active[a]); });
      active = selected(active, [&](int k) { return m_is_alive[k] && m_weight[k] >= least; });
    }
    eliminate_in_turn(active, least);
  }

  /// The same among `active`, one after the other: the first one is on top of a heap as soon as the
  /// weight on top is up to date.
  void eliminate_in_turn(const std::vector<int>& active, double least)
  {
    std::vector<std::pair<Entry, int>> heap; // with the place
    for (const int k : active) heap.emplace_back(entry(k), k);
    std::make_heap(heap.begin(), heap.end());
    while (!heap.empty()) {
      Cancellation::poll();
      std::pop_heap(heap.begin(), heap.end());
      const auto [before, k] = heap.back();
      heap.pop_back();
      update_weight(k);
      if (m_weight[k] < least) continue;
      if (entry(k) == before) {
        m_is_alive[k] = 0;
        m_gone.push_back(k);
      } else {
        heap.emplace_back(entry(k), k);
        std::push_heap(heap.begin(), heap.end());
      }
    }
  }

  Candidate_graph m_graph;
  Concurrency m_concurrency;
  int m_size, m_free;
  Unset_vector<char> m_is_alive;
  Unset_vector<double> m_weight; // of those that have gone, the last one
  std::vector<int> m_gone;
};

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
    return internal::Sample_elimination(internal::candidate_graph(among, cos_angle, concurrency),
                                        fixed, concurrency)
        .run(n);
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
