// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The neighbors of candidates for samples, found in a tree whenever they are asked for: where the
// backend has many threads, that is faster than to keep them (candidate_graph.h).
#ifndef CGAL_POWER_RTF_SAMPLING_CANDIDATE_SEARCH_H
#define CGAL_POWER_RTF_SAMPLING_CANDIDATE_SEARCH_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/hilbert_code.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/internal/host_device.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/sampling/crowding.h>

#include <cstddef>
#include <cstdint>

namespace CGAL::PowerRTF::internal {

/// The box around a candidate's ball. The balls of neighbors meet, so each meets the other's box.
struct Box_of_ball {
  const Elimination_candidate* candidates;
  CGAL_POWER_RTF_HD Box3<double> operator()(int k) const
  {
    const Elimination_candidate& c = candidates[k];
    const Vec3d r{c.radius, c.radius, c.radius};
    return {c.point - r, c.point + r};
  }
};

/// Non-owning.
struct Candidate_search_view {
  const Elimination_candidate* candidates; ///< at their places
  Packed_tree_layout tree;
  const Child_boxes* nodes;
  double cos_normal_angle;

  /// Calls `f(neighbor)` for the neighbors of place `k`.
  template <class F>
  CGAL_POWER_RTF_HD void for_each_neighbor(int k, F f) const
  {
    const Elimination_candidate a = candidates[k];
    const float bound = bound_of(a.radius * a.radius);
    visit_near(
        tree, nodes, Point_query(a.point), [=] { return bound; },
        [&](int l) {
          const Elimination_candidate& b = candidates[l];
          const double reach = a.radius + b.radius, squared = squared_length(a.point - b.point);
          if (l != k && squared < reach * reach && dot(a.normal, b.normal) >= cos_normal_angle)
            f(Crowding_neighbor{l, crowding(squared, reach)});
        });
  }
};

template <class Candidate_of>
struct Code_candidates {
  Candidate_of candidate_of;
  std::uint64_t* codes;
  CGAL_POWER_RTF_HD void operator()(int i) const { codes[i] = hilbert_code(candidate_of(i).point); }
};

template <class Candidate_of>
struct Sort_candidates {
  Candidate_of candidate_of;
  const int* order;
  Elimination_candidate* result;
  CGAL_POWER_RTF_HD void operator()(int k) const { result[k] = candidate_of(order[k]); }
};

template <class Backend>
class Candidate_search {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  /// The candidates `candidate_of(i)`, i in [0, size), in the unit box.
  /// \param cos_normal_angle candidates whose normals' dot product is below it do not see each
  ///   other (NVISPC)
  template <class Candidate_of>
  Candidate_search(Backend& backend, int size, const Candidate_of& candidate_of,
                   double cos_normal_angle)
      : m_tree(size), m_cos_normal_angle(cos_normal_angle)
  {
    allocate_listed(backend, *this, std::size_t(size));
    backend.for_each(size, Code_candidates<Candidate_of>{candidate_of, m_codes.data()});
    backend.sort_order(size, m_codes.data(), m_order.data());
    backend.for_each(
        size, Sort_candidates<Candidate_of>{candidate_of, m_order.data(), m_candidates.data()});
    fit_tree(backend, m_tree, Box_of_ball{m_candidates.data()}, m_boxes.data(), m_nodes.data());
  }

  Candidate_search_view view() const
  {
    return {m_candidates.data(), m_tree, m_nodes.data(), m_cos_normal_angle};
  }
  /// The candidate at each place.
  const int* order() const { return m_order.data(); }

  /// What `n` candidates take.
  static std::size_t bytes(std::size_t n)
  {
    return bytes_of_listed<Candidate_search>(n) + Backend::sort_bytes(static_cast<int>(n));
  }

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t n)
  {
    const std::size_t nodes = Packed_tree_layout(static_cast<int>(n)).nodes();
    f(&Candidate_search::m_candidates, n);
    f(&Candidate_search::m_codes, n);
    f(&Candidate_search::m_order, n);
    f(&Candidate_search::m_boxes, nodes);
    f(&Candidate_search::m_nodes, nodes);
  }

private:
  Packed_tree_layout m_tree;
  double m_cos_normal_angle;
  Buffer<Elimination_candidate> m_candidates;
  Buffer<std::uint64_t> m_codes;
  Buffer<int> m_order;
  Buffer<Box3<double>> m_boxes;
  Buffer<Child_boxes> m_nodes;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SAMPLING_CANDIDATE_SEARCH_H
