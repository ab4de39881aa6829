// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The predicates of the exact cells as functors over samples, for tests of each answer: the turn
// between two edges of a restricted cell, and the side of a vertex of it.
#ifndef CGAL_POWER_RTF_TEST_TANGENT_PREDICATES_H
#define CGAL_POWER_RTF_TEST_TANGENT_PREDICATES_H

#include <CGAL/PowerRTF/exact/Tangent_cell_predicates.h>

namespace exact_test {

using namespace CGAL::PowerRTF;
using CGAL::Protect_FPU_rounding;
using CGAL::Sign;

/// A sample as the predicates take it. `index` >= 0 orders the symbolic perturbation; the samples
/// of one call must have different indices.
template <class Traits>
struct Indexed_sample_3 {
  typename Traits::Point_3 point;
  typename Traits::FT weight;
  int index;
};

/// The turn from the edge that j makes in i's restricted cell to the edge that k makes.
/// \tparam Traits a model of `TangentCellTraits_3`
template <class Traits>
class Orientation_in_tangent_plane_3 {
  Traits m_traits;

public:
  using Sample = Indexed_sample_3<Traits>;
  using result_type = CGAL::Orientation;

  explicit Orientation_in_tangent_plane_3(const Traits& traits = Traits()) : m_traits(traits) {}

  /// LEFT_TURN when, seen from the normal `n` of `i` (any length but zero), the direction to `k`
  /// lies counter-clockwise of the direction to `j` within the tangent plane, by less than half a
  /// turn; COLLINEAR when the two equal-power planes have parallel traces there, or none.
  /// \throw Invalid_input_error when `n` is zero or not finite.
  CGAL::Orientation operator()(const Sample& i, const typename Traits::Vector_3& n, const Sample& j,
                               const Sample& k) const
  {
    const internal::Tangent_frame frame(m_traits.vector(n));
    {
      Protect_FPU_rounding<true> upward;
      using NT = internal::Filter_nt;
      const Sign s =
          internal::certain_sign(internal::turn(line<NT>(frame, i, j), line<NT>(frame, i, k)));
      if (s != CGAL::ZERO) return s;
    }
    using NT = typename Traits::Exact_nt;
    return CGAL::sign(internal::turn(line<NT>(frame, i, j), line<NT>(frame, i, k)));
  }

  /// The half-plane of j in the tangent plane of i.
  template <class NT>
  internal::Tangent_line<NT> line(const internal::Tangent_frame& frame, const Sample& i,
                                  const Sample& j) const
  {
    return internal::sample_line<NT>(frame, m_traits.point(i.point), m_traits.weight(i.weight),
                                     m_traits.point(j.point), m_traits.weight(j.weight));
  }
};

/// The side of a vertex of i's restricted cell with respect to a further equal-power plane.
/// \tparam Traits a model of `TangentCellTraits_3`
template <class Traits>
class Side_of_tangent_vertex_3 {
  Traits m_traits;
  Orientation_in_tangent_plane_3<Traits> m_orientation;
  Filter_statistics* m_statistics;

public:
  using Sample = Indexed_sample_3<Traits>;
  using result_type = CGAL::Oriented_side;

  /// `statistics`, when given, counts the calls; it must outlive the functor.
  explicit Side_of_tangent_vertex_3(const Traits& traits = Traits(),
                                    Filter_statistics* statistics = nullptr)
      : m_traits(traits), m_orientation(traits), m_statistics(statistics)
  {}

  /// The vertex is where the tangent plane (s_i, n) meets the equal-power planes of `i` with `j`
  /// and with `k`. ON_POSITIVE_SIDE when it has less power with respect to `i` than to `l` (`l`
  /// does not cut it off), ON_NEGATIVE_SIDE otherwise; ties are decided by the symbolic
  /// perturbation. ON_ORIENTED_BOUNDARY only when there is no vertex (parallel traces).
  /// The order of `j` and `k` does not matter.
  /// \throw Invalid_input_error when `n` is zero or not finite.
  CGAL::Oriented_side operator()(const Sample& i, const typename Traits::Vector_3& n,
                                 const Sample& j, const Sample& k, const Sample& l) const
  {
    const CGAL::Orientation turn = m_orientation(i, n, j, k);
    if (turn == CGAL::COLLINEAR) return CGAL::ON_ORIENTED_BOUNDARY;
    const internal::Tangent_frame frame(m_traits.vector(n));
    {
      Protect_FPU_rounding<true> upward;
      using NT = internal::Filter_nt;
      const Sign s =
          internal::filtered_side(internal::crossing(m_orientation.template line<NT>(frame, i, j),
                                                     m_orientation.template line<NT>(frame, i, k)),
                                  m_orientation.template line<NT>(frame, i, l));
      if (s != CGAL::ZERO) {
        if (m_statistics) ++m_statistics->filtered;
        return s * turn;
      }
    }
    using NT = typename Traits::Exact_nt;
    const auto line_j = m_orientation.template line<NT>(frame, i, j);
    const auto line_k = m_orientation.template line<NT>(frame, i, k);
    const auto line_l = m_orientation.template line<NT>(frame, i, l);
    bool tie;
    const Sign s = internal::exact_side<NT>({&line_j, &line_k, &line_l},
                                            {j.index, k.index, l.index}, i.index, tie);
    if (m_statistics) {
      ++m_statistics->exact;
      if (tie) ++m_statistics->ties;
    }
    return s * turn;
  }
};

} // namespace exact_test

#endif // CGAL_POWER_RTF_TEST_TANGENT_PREDICATES_H
