// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The predicate of the exact cells: the side of a vertex with respect to a third equal-power plane.
// A vertex is implicit: the tangent plane of s_i and the equal-power planes of i with two
// neighbors.
//
// The answers are exact for inputs taken as exact doubles: interval arithmetic first, an exact ring
// (CGAL::Exact_kernel_selector: Mpzf or GMP) where an interval holds zero. Three lines through one
// point, parallel and coincident planes get the answer of perturbed weights: w_i becomes
// w_i + eps_i, eps_0 >> eps_1 >> ... > 0, all infinitely small (of two equal claims the smaller
// index wins). Offsets are linear in the weights, so that the determinant's expansion has at most
// four terms, and its last one, the minor of the two lines of the vertex, is not zero.
// Symbolic perturbation: Edelsbrunner and Muecke, "Simulation of simplicity", ACM TOG 9(1), 1990.
#ifndef CGAL_POWER_RTF_EXACT_TANGENT_CELL_PREDICATES_H
#define CGAL_POWER_RTF_EXACT_TANGENT_CELL_PREDICATES_H

#include <CGAL/PowerRTF/exact/Filter_statistics.h>
#include <CGAL/PowerRTF/exact/Tangent_lines.h>

#include <CGAL/Exact_kernel_selector.h>
#include <CGAL/Interval_nt.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFExact
/// Model of the concept `TangentCellTraits_3` for any CGAL kernel. The oracle's inputs are
/// doubles; a kernel gives only its point, vector and number types and the way to doubles. For
/// `Exact_predicates_inexact_constructions_kernel` the conversion is the identity; for
/// `Exact_predicates_exact_constructions_kernel` it is `to_double()`, so the answers hold for the
/// rounded inputs (the inputs themselves when their coordinates are doubles).
template <class Kernel>
struct Tangent_cell_traits_3 {
  using FT = typename Kernel::FT;
  using Point_3 = typename Kernel::Point_3;
  using Vector_3 = typename Kernel::Vector_3;
  /// An exact ring constructible from double: used where the interval filter cannot decide.
  using Exact_nt = typename Exact_kernel_selector<Simple_cartesian<double>>::Exact_rt;

  Vec3d point(const Point_3& p) const
  {
    return {CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z())};
  }
  Vec3d vector(const Vector_3& v) const
  {
    return {CGAL::to_double(v.x()), CGAL::to_double(v.y()), CGAL::to_double(v.z())};
  }
  double weight(const FT& w) const { return CGAL::to_double(w); }
};

namespace internal {

/// Needs the FPU to round upward (`Protect_FPU_rounding`).
using Filter_nt = Interval_nt_advanced;

/// Order of the perturbations, largest first: samples by index, then the sides -1, -2, ...
inline unsigned perturbation_rank(int id)
{
  const unsigned first_side = unsigned((std::numeric_limits<int>::max)()) + 1u;
  return id >= 0 ? unsigned(id) : first_side + unsigned(-(id + 1));
}

/// Sign of the interval when it is certain and not zero, else ZERO.
inline Sign certain_sign(const Filter_nt& x)
{
  return x.inf() > 0 ? POSITIVE : x.sup() < 0 ? NEGATIVE : ZERO;
}

/// Filtered side of vertex v with respect to l's half-plane: POSITIVE inside, NEGATIVE outside,
/// ZERO unknown. Holds for w > 0, which the caller knows.
inline Sign filtered_side(const Tangent_vertex<Filter_nt>& v, const Tangent_line<Filter_nt>& l)
{
  if (v.at_infinity) return certain_sign(-(l.a * v.ox + l.b * v.oy));
  return certain_sign(l.c * v.w - l.a * v.x - l.b * v.y);
}

/// Sign of the determinant | a b c | of the lines j, k, l of sample i in an exact ring; with
/// turn(j, k) > 0 it is the side of the vertex (j, k) with respect to l. `ids` are the samples'
/// indices, or -1, -2, ... for sides of the clipping square. Powers of Omega (lines at infinity)
/// come first, then the finite part, then the perturbations. Zero only when j and k are parallel.
/// `tie` tells that the finite part was zero, too.
template <class NT>
Sign exact_side(const std::array<const Tangent_line<NT>*, 3>& lines, const std::array<int, 3>& ids,
                int i, bool& tie)
{
  const std::array<NT, 3> minors{turn(*lines[1], *lines[2]), turn(*lines[2], *lines[0]),
                                 turn(*lines[0], *lines[1])};
  NT infinite(0), finite(0), of_i(0);
  for (int r = 0; r < 3; ++r) {
    if (lines[r]->at_infinity) infinite = infinite + minors[r];
    finite = finite + lines[r]->c * minors[r];
    if (ids[r] >= 0) of_i = of_i + minors[r];
  }
  tie = false;
  if (const Sign s = CGAL::sign(infinite); s != ZERO) return s;
  if (const Sign s = CGAL::sign(finite); s != ZERO) return s;
  tie = true;

  // c_r of a sample moves by eps_i - eps_r, c_r of a side by eps_r.
  std::array<std::pair<unsigned, Sign>, 4> terms;
  for (int r = 0; r < 3; ++r) {
    const Sign s = CGAL::sign(minors[r]);
    terms[r] = {perturbation_rank(ids[r]), ids[r] >= 0 ? -s : s};
  }
  terms[3] = {perturbation_rank(i), CGAL::sign(of_i)};
  std::sort(terms.begin(), terms.end());
  for (const auto& term : terms)
    if (term.second != ZERO) return term.second;
  return ZERO;
}

} // namespace internal

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXACT_TANGENT_CELL_PREDICATES_H
