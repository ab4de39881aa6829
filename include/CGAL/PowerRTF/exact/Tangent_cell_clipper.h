// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One restricted cell F_i, clipped exactly: a cyclic list of half-planes whose consecutive pairs
// are the implicit vertices. The list starts as a square (given, or infinitely large), so that it
// is always a closed convex polygon; the symbolic perturbation leaves no vertex on a line, so that
// every clip has a plain answer. Invariant: turn(edge, next edge) > 0.
#ifndef CGAL_POWER_RTF_EXACT_TANGENT_CELL_CLIPPER_H
#define CGAL_POWER_RTF_EXACT_TANGENT_CELL_CLIPPER_H

#include <CGAL/PowerRTF/exact/Tangent_cell_predicates.h>
#include <CGAL/PowerRTF/geometry/Packed_tree.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFExact
/// A square in a tangent plane, centered at \f$s_i\f$: \f$t_1 \cdot x \le B\f$,
/// \f$t_2 \cdot x \le B\f$, \f$-t_1 \cdot x \le B\f$, \f$-t_2 \cdot x \le B\f$, whose sides have
/// the ids -1, -2, -3, -4. The directions need be neither unit nor tangent to the last bit: only
/// the traces of these half-spaces in the tangent plane count, as exact doubles.
struct Exact_square {
  Vec3d t1, t2;     ///< \f$(t_1, t_2, n_i)\f$ right-handed
  double half_size; ///< \f$B > 0\f$
};

namespace internal {

/// A box of samples and the largest weight among them.
struct Weighted_box : Box3<double> {
  double max_weight;
};

template <class Exact_nt>
class Tangent_cell_clipper {
  struct Line {
    int id;          // sample, or -1 .. -4: side of the square
    Vec3d direction; // the sample's position, or the side's outward direction
    double offset;   // the sample's weight, or the square's half-size
    Tangent_line<Filter_nt> approximate;
    std::optional<Tangent_line<Exact_nt>> exact;
  };

  struct Vertex {
    int line, next_line; // indices into m_lines, counter-clockwise
    Tangent_vertex<Filter_nt> approximate;
    Filter_nt position[3]; // s_i + position, along the frame's (axis, p, q)
    Filter_nt squared_norm;
    bool located = false;
  };

  int m_index;
  Vec3d m_point;
  double m_weight;
  Tangent_frame m_frame;
  bool m_infinite_square;
  std::vector<Line> m_lines;
  std::vector<Vertex> m_vertices, m_clipped;
  std::vector<Sign> m_sides;
  Filter_statistics m_statistics;

public:
  /// Sample `index` at `point`; `square` is null for an infinitely large one, whose sides face the
  /// two coordinate axes that the frame keeps.
  /// \throw Invalid_input_error when the normal is zero or not finite, or the square is not one.
  Tangent_cell_clipper(int index, const Vec3d& point, const Vec3d& normal, double weight,
                       const Exact_square* square)
      : m_index(index), m_point(point), m_weight(weight), m_frame(normal),
        m_infinite_square(square == nullptr)
  {
    Exact_square s{{0, 0, 0}, {0, 0, 0}, 0};
    if (square) {
      s = *square;
    } else {
      s.t1 = unit(m_frame.p);
      s.t2 = unit(m_frame.q);
    }
    if (!m_infinite_square && !(s.half_size > 0 && std::isfinite(s.half_size)))
      throw Invalid_input_error("a clipping square's size must be positive and finite");
    if (!is_finite(s.t1) || !is_finite(s.t2))
      throw Invalid_input_error("a clipping square's direction is not finite");
    if (CGAL::sign(turn(side_line<Exact_nt>(m_frame, s.t1, 1, false),
                        side_line<Exact_nt>(m_frame, s.t2, 1, false))) != POSITIVE)
      throw Invalid_input_error("a clipping square's directions and the normal are not "
                                "right-handed");
    Protect_FPU_rounding<true> upward;
    const Vec3d sides[4] = {s.t1, s.t2, -s.t1, -s.t2};
    for (int k = 0; k < 4; ++k) {
      m_lines.push_back({-1 - k, sides[k], s.half_size,
                         side_line<Filter_nt>(m_frame, sides[k], s.half_size, m_infinite_square),
                         std::nullopt});
    }
    for (int k = 0; k < 4; ++k) m_vertices.push_back(make_vertex(k, (k + 1) % 4));
  }

  bool is_empty() const { return m_vertices.empty(); }
  const Filter_statistics& statistics() const { return m_statistics; }

  /// Keeps the part where s_i has less power than the sample; returns whether the cell changed.
  /// `index` must be new. To be called, as all members, with the FPU rounding to nearest.
  bool clip(int index, const Vec3d& point, double weight)
  {
    if (is_empty()) return false;
    Protect_FPU_rounding<true> upward;
    m_lines.push_back({index, point, weight,
                       sample_line<Filter_nt>(m_frame, m_point, m_weight, point, weight),
                       std::nullopt});
    const int line = int(m_lines.size()) - 1, n = int(m_vertices.size());
    m_sides.resize(n);
    int outside = 0;
    for (int v = 0; v < n; ++v) {
      m_sides[v] = side(m_vertices[v], line);
      if (m_sides[v] == NEGATIVE) ++outside;
    }
    if (outside == 0) {
      m_lines.pop_back();
      return false;
    }
    if (outside == n) {
      m_vertices.clear();
      return true;
    }
    // Convexity: the vertices outside are consecutive, from `first` to `last`.
    int first = 0;
    while (!(m_sides[first] == NEGATIVE && m_sides[(first + n - 1) % n] == POSITIVE)) ++first;
    const int last = (first + outside - 1) % n;
    m_clipped.clear();
    for (int k = 0; k < n - outside; ++k) m_clipped.push_back(m_vertices[(last + 1 + k) % n]);
    m_clipped.push_back(make_vertex(m_vertices[first].line, line));
    m_clipped.push_back(make_vertex(line, m_vertices[last].next_line));
    m_vertices.swap(m_clipped);
    return true;
  }

  /// False when it is proved that no sample of the box cuts the cell, now or after further clips,
  /// and that none touches it: the proof is that at every vertex every such sample has more power
  /// than s_i.
  bool may_be_cut_by(const Weighted_box& box)
  {
    if (is_empty()) return false;
    Protect_FPU_rounding<true> upward;
    const int axes[3] = {m_frame.axis, m_frame.p, m_frame.q};
    Filter_nt lower[3], upper[3];
    for (int k = 0; k < 3; ++k) {
      const Filter_nt s(coordinate(m_point, axes[k]));
      lower[k] = Filter_nt(coordinate(box.lo, axes[k])) - s;
      upper[k] = Filter_nt(coordinate(box.hi, axes[k])) - s;
    }
    const Filter_nt weight_gap = Filter_nt(m_weight) - Filter_nt(box.max_weight);
    for (Vertex& v : m_vertices) {
      if (v.approximate.at_infinity) return true;
      locate(v);
      Filter_nt distance2(0);
      for (int k = 0; k < 3; ++k) {
        const double below = (lower[k] - v.position[k]).inf();
        const double above = (v.position[k] - upper[k]).inf();
        distance2 += CGAL::square(Filter_nt((std::max)({0., below, above})));
      }
      if (!((distance2 - v.squared_norm + weight_gap).inf() > 0)) return true;
    }
    return false;
  }

  /// Whether s_i lies inside the cell (perturbed: never on its boundary).
  bool contains_site()
  {
    if (is_empty()) return false;
    for (const Vertex& v : m_vertices) {
      Line& l = m_lines[v.line];
      if (l.id < 0) continue;
      Sign s = certain_sign(l.approximate.c);
      if (s == ZERO) s = CGAL::sign(exact(l).c);
      if (s == ZERO) s = m_index < l.id ? POSITIVE : NEGATIVE;
      if (s == NEGATIVE) return false;
    }
    return true;
  }

  /// The ids of the edges, counter-clockwise seen from the normal, the smallest first.
  std::vector<int> cycle() const
  {
    std::vector<int> ids;
    ids.reserve(m_vertices.size());
    for (const Vertex& v : m_vertices) ids.push_back(m_lines[v.line].id);
    std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
    return ids;
  }

private:
  static Vec3d unit(int k) { return {k == 0 ? 1. : 0., k == 1 ? 1. : 0., k == 2 ? 1. : 0.}; }

  const Tangent_line<Exact_nt>& exact(Line& l) const
  {
    if (!l.exact)
      l.exact = l.id >= 0 ? sample_line<Exact_nt>(m_frame, m_point, m_weight, l.direction, l.offset)
                          : side_line<Exact_nt>(m_frame, l.direction, l.offset, m_infinite_square);
    return *l.exact;
  }

  Vertex make_vertex(int line, int next_line) const
  {
    Vertex v;
    v.line = line;
    v.next_line = next_line;
    v.approximate = crossing(m_lines[line].approximate, m_lines[next_line].approximate);
    return v;
  }

  Sign side(const Vertex& v, int line)
  {
    const Sign s = filtered_side(v.approximate, m_lines[line].approximate);
    if (s != ZERO) {
      ++m_statistics.filtered;
      return s;
    }
    Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
    Line &j = m_lines[v.line], &k = m_lines[v.next_line], &l = m_lines[line];
    bool tie;
    const Sign e =
        exact_side<Exact_nt>({&exact(j), &exact(k), &exact(l)}, {j.id, k.id, l.id}, m_index, tie);
    ++m_statistics.exact;
    if (tie) ++m_statistics.ties;
    return e;
  }

  /// Intervals for a finite vertex's position; from exact values when the filter's w holds zero.
  void locate(Vertex& v)
  {
    if (v.located) return;
    v.located = true;
    Filter_nt x = v.approximate.x, y = v.approximate.y, w = v.approximate.w;
    if (!(w.inf() > 0)) {
      std::pair<double, double> ix, iy, iw;
      {
        Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
        const Tangent_vertex<Exact_nt> e =
            crossing(exact(m_lines[v.line]), exact(m_lines[v.next_line]));
        ix = CGAL::to_interval(e.x);
        iy = CGAL::to_interval(e.y);
        iw = CGAL::to_interval(e.w);
      }
      x = Filter_nt(ix);
      y = Filter_nt(iy);
      w = Filter_nt(iw);
    }
    v.position[1] = x / w;
    v.position[2] = y / w;
    v.position[0] =
        -(Filter_nt(m_frame.n_p) * v.position[1] + Filter_nt(m_frame.n_q) * v.position[2]) /
        Filter_nt(m_frame.n_axis);
    v.squared_norm =
        CGAL::square(v.position[0]) + CGAL::square(v.position[1]) + CGAL::square(v.position[2]);
  }
};

} // namespace internal
} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXACT_TANGENT_CELL_CLIPPER_H
