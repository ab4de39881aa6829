// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Weighted sample elimination: Yuksel, "Sample Elimination for Generating Poisson Disk Sample Sets"
// (2015), where a backend works.
#ifndef CGAL_POWER_RTF_SAMPLING_CANDIDATE_ELIMINATION_H
#define CGAL_POWER_RTF_SAMPLING_CANDIDATE_ELIMINATION_H

#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/host_device.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/sampling/crowding.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// What an elimination knows of the candidates at their places. Non-owning.
template <class Neighbors>
struct Elimination_view {
  Neighbors neighbors;
  const int* order; ///< the candidate at each place
  int free;         ///< those before it may go, the others stay
  unsigned char* is_alive;
  double* weights; ///< of those that have gone, the last ones

  CGAL_POWER_RTF_HD bool is_free(int k) const { return order[k] < free; }
  /// The candidate with the largest weight goes first, of equal ones the last.
  CGAL_POWER_RTF_HD bool comes_before(int j, int k) const
  {
    return weights[j] > weights[k] || (weights[j] == weights[k] && order[j] > order[k]);
  }
  CGAL_POWER_RTF_HD bool is_active(int k, double least) const
  {
    return is_alive[k] && is_free(k) && weights[k] >= least;
  }

  template <class F>
  CGAL_POWER_RTF_HD void for_each_alive_neighbor(int k, F f) const
  {
    neighbors.for_each_neighbor(k, [&](const Crowding_neighbor& neighbor) {
      if (is_alive[neighbor.place]) f(neighbor);
    });
  }

  /// Weights are summed anew, not updated by subtraction: the last two neighbors have the same
  /// weight, and rounding must not choose between them.
  CGAL_POWER_RTF_HD void update_weight(int k) const
  {
    if (!is_alive[k]) return;
    double sum = 0;
    for_each_alive_neighbor(k, [&](const Crowding_neighbor& n) { sum += n.crowding; });
    weights[k] = sum;
  }

  /// Whether it goes before all its neighbors.
  CGAL_POWER_RTF_HD bool is_first(int k) const
  {
    bool result = true;
    for_each_alive_neighbor(k, [&](const Crowding_neighbor& n) {
      result = result && (!is_free(n.place) || comes_before(k, n.place));
    });
    return result;
  }
};

/// The weights of all places, or of those in `places`.
template <class View>
struct Update_weights {
  View view;
  const int* places = nullptr;
  CGAL_POWER_RTF_HD void operator()(int a) const { view.update_weight(places ? places[a] : a); }
};

/// Those that have at least a weight. `places`: as above.
template <class View>
struct Mark_active {
  View view;
  double least;
  unsigned char* result;
  const int* places = nullptr;
  CGAL_POWER_RTF_HD void operator()(int a) const
  {
    result[a] = view.is_active(places ? places[a] : a, least);
  }
};

template <class View>
struct Mark_first {
  View view;
  const int* places;
  unsigned char* result;
  CGAL_POWER_RTF_HD void operator()(int a) const { result[a] = view.is_first(places[a]); }
};

/// Of some of the places.
template <class View>
struct Set_alive {
  View view;
  const int* places;
  unsigned char value;
  CGAL_POWER_RTF_HD void operator()(int a) const { view.is_alive[places[a]] = value; }
};

template <class T>
struct Gather_chosen {
  const T* items;
  const int* chosen;
  T* result;
  CGAL_POWER_RTF_HD void operator()(int k) const { result[k] = items[chosen[k]]; }
};

/// The weights of every `stride`-th place; -1 where nothing can go.
template <class View>
struct Pick_weights {
  View view;
  int stride;
  double* result;
  CGAL_POWER_RTF_HD void operator()(int a) const
  {
    const int k = a * stride;
    result[a] = view.is_alive[k] && view.is_free(k) ? view.weights[k] : -1;
  }
};

template <class View>
struct Mark_gone {
  View view;
  unsigned char* result;
  CGAL_POWER_RTF_HD void operator()(int k) const { result[k] = !view.is_alive[k]; }
};

/// A place that something has gone from.
struct Gone_candidate {
  double weight;
  int candidate, place;

  bool comes_before(const Gone_candidate& other) const
  {
    return std::pair(weight, candidate) > std::pair(other.weight, other.candidate);
  }
};

template <class View>
struct Describe_gone {
  View view;
  const int* places;
  Gone_candidate* result;
  CGAL_POWER_RTF_HD void operator()(int a) const
  {
    const int k = places[a];
    result[a] = {view.weights[k], view.order[k], k};
  }
};

/// By candidate: the free ones that are left.
template <class View>
struct Mark_left {
  View view;
  unsigned char* result;
  CGAL_POWER_RTF_HD void operator()(int k) const
  {
    if (view.is_free(k)) result[view.order[k]] = view.is_alive[k];
  }
};

/// Weights only fall. So a candidate that comes before all its neighbors goes before them, with the
/// weight that it has, whatever happens elsewhere: many go at once, and each with the weight that
/// it has when one goes after the other. Down to a threshold, it is the same candidates that go.
template <class Backend, class Neighbors>
class Candidate_elimination {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  using View = Elimination_view<Neighbors>;

  /// Of `size` candidates, of which the first `free` may go. `order`: see `Elimination_view`.
  Candidate_elimination(Backend& backend, const Neighbors& neighbors, const int* order, int size,
                        int free)
      : m_backend(backend), m_size(size), m_free(free)
  {
    allocate_listed(backend, *this, std::size_t(size));
    m_view = {neighbors, order, free, m_is_alive.data(), m_weights.data()};
    m_backend.fill(m_is_alive.data(), (unsigned char)(1), size);
  }

  /// Leaves `n` free candidates, or more that do not see each other. If they have to wait for each
  /// other too often, `in_turn(active, least)` lets the active ones go one by one, those that have
  /// at least the weight `least` when their turn comes.
  /// \returns `false` if `in_turn` has: it cannot.
  template <class In_turn>
  bool run(std::size_t n, const In_turn& in_turn)
  {
    constexpr double seen = std::numeric_limits<double>::min(); // the least weight
    const std::size_t excess = std::size_t(m_free) > n ? m_free - n : 0;
    std::size_t gone = 0;
    for (bool progress = true; progress && gone < excess;) {
      m_backend.for_each(m_size, Update_weights<View>{m_view});
      const double least = (std::max)(threshold(excess - gone), seen);
      if (!eliminate_down_to(least, in_turn)) return false;
      const std::size_t before = std::exchange(gone, find_gone());
      progress = gone > before;
    }
    if (gone > excess) bring_back(gone, excess);
    return true;
  }

  /// Writes the free candidates that are left, increasing. \returns their number
  int write_left(int* candidates)
  {
    m_backend.for_each(m_size, Mark_left<View>{m_view, m_marks.data()});
    return m_backend.select(m_free, m_marks.data(), candidates);
  }

  const View& view() const { return m_view; }

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t n)
  {
    f(&Candidate_elimination::m_is_alive, n);
    f(&Candidate_elimination::m_marks, n);
    f(&Candidate_elimination::m_weights, n);
    for (const auto items : {&Candidate_elimination::m_active, &Candidate_elimination::m_chosen,
                             &Candidate_elimination::m_next})
      f(items, n);
  }

private:
  /// A weight that some more than `count` of the candidates have, as far as a part of them shows.
  double threshold(std::size_t count)
  {
    constexpr int largest_part = 1 << 16;
    const int stride = m_size / largest_part + 1, part = (m_size + stride - 1) / stride;
    Buffer<double> picked;
    picked.allocate(m_backend, part);
    m_backend.for_each(part, Pick_weights<View>{m_view, stride, picked.data()});
    Unset_vector<double> weights(part);
    m_backend.download(weights.data(), picked.data(), part);
    weights.erase(std::remove(weights.begin(), weights.end(), -1.), weights.end());
    if (weights.empty()) return 0;
    const std::size_t rank = count / stride, rest = weights.size() - std::min(weights.size(), rank);
    const std::size_t place =
        std::min(rank + std::min(rank, rest / 2) + rest / 1024, weights.size() - 1);
    std::nth_element(weights.begin(), weights.begin() + place, weights.end(),
                     std::greater<double>());
    return weights[place];
  }

  /// Eliminates the candidates that have at least the weight `least` when their turn comes.
  template <class In_turn>
  bool eliminate_down_to(double least, const In_turn& in_turn)
  {
    constexpr int max_rounds = 32; // 3 to 8, mostly
    m_backend.for_each(m_size, Mark_active<View>{m_view, least, m_marks.data()});
    int active = m_backend.select(m_size, m_marks.data(), m_active.data());
    for (int round = 0; round < max_rounds && active > 0; ++round) {
      m_backend.for_each(active, Mark_first<View>{m_view, m_active.data(), m_marks.data()});
      const int first = select_active(active);
      m_backend.for_each(first, Set_alive<View>{m_view, m_next.data(), 0});
      m_backend.for_each(active, Update_weights<View>{m_view, m_active.data()});
      m_backend.for_each(active, Mark_active<View>{m_view, least, m_marks.data(), m_active.data()});
      active = select_active(active);
      std::swap(m_active, m_next);
    }
    return active == 0 || in_turn(m_active.data(), active, least);
  }

  /// Writes those of the `active` ones that are marked to `m_next`. \returns their number
  int select_active(int active)
  {
    const int count = m_backend.select(active, m_marks.data(), m_chosen.data());
    m_backend.for_each(count, Gather_chosen<int>{m_active.data(), m_chosen.data(), m_next.data()});
    return count;
  }

  /// Writes the places that something has gone from to `m_active`. \returns their number
  int find_gone()
  {
    m_backend.for_each(m_size, Mark_gone<View>{m_view, m_marks.data()});
    return m_backend.select(m_size, m_marks.data(), m_active.data());
  }

  /// Those that have gone last, after `excess` others, stay after all. \pre `find_gone()`
  void bring_back(std::size_t gone, std::size_t excess)
  {
    Buffer<Gone_candidate> described;
    described.allocate(m_backend, gone);
    m_backend.for_each(static_cast<int>(gone),
                       Describe_gone<View>{m_view, m_active.data(), described.data()});
    Unset_vector<Gone_candidate> all(gone);
    m_backend.download(all.data(), described.data(), gone);
    std::nth_element(
        all.begin(), all.begin() + excess, all.end(),
        [](const Gone_candidate& a, const Gone_candidate& b) { return a.comes_before(b); });
    std::vector<int> back;
    for (std::size_t a = excess; a < gone; ++a) back.push_back(all[a].place);
    m_backend.upload(m_chosen.data(), back.data(), back.size());
    m_backend.for_each(static_cast<int>(back.size()), Set_alive<View>{m_view, m_chosen.data(), 1});
  }

  Backend& m_backend;
  int m_size, m_free;
  View m_view;
  Buffer<unsigned char> m_is_alive, m_marks;
  Buffer<double> m_weights;
  Buffer<int> m_active, m_chosen, m_next;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SAMPLING_CANDIDATE_ELIMINATION_H
