// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A facet of the surface, clipped exactly by the power cell of a sample: a piece of the restricted
// power diagram. As in Tangent_cell_clipper.h, vertices are implicit (pairs of lines in the facet's
// plane) and ties are decided by perturbed weights. The facet's edges are not perturbed, so that
// the two facets at an edge, and all facets at a vertex, agree about it.
#ifndef CGAL_POWER_RTF_TEST_FACET_CELL_CLIPPER_H
#define CGAL_POWER_RTF_TEST_FACET_CELL_CLIPPER_H

#include <CGAL/PowerRTF/exact/Tangent_cell_clipper.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The facet's plane, projected along the axis in which its normal is largest; the origin is the
/// facet's first corner. Keeps the orientation seen from the facet's normal.
template <class NT>
struct Facet_plane {
  NT n_axis, n_p, n_q;                      // a normal (or its opposite), n_axis > 0
  std::array<std::array<NT, 2>, 3> corners; // projected

  Facet_plane(const std::array<Vec3d, 3>& facet, int axis, int p, int q, bool flipped)
  {
    const auto edge = [&](int corner, int k) {
      return NT(NT(coordinate(facet[corner], k)) - NT(coordinate(facet[0], k)));
    };
    const auto minor = [&](int k, int l) {
      const NT m = edge(1, k) * edge(2, l) - edge(1, l) * edge(2, k);
      return flipped ? NT(-m) : m;
    };
    n_axis = minor((axis + 1) % 3, (axis + 2) % 3);
    n_p = minor((p + 1) % 3, (p + 2) % 3);
    n_q = minor((q + 1) % 3, (q + 2) % 3);
    for (int c = 0; c < 3; ++c) corners[c] = {edge(c, p), edge(c, q)};
  }

  /// Edge `e`, from corner e to e + 1.
  Tangent_line<NT> edge_line(int e) const
  {
    const auto &from = corners[e], &to = corners[(e + 1) % 3];
    const NT a = to[1] - from[1], b = from[0] - to[0];
    return {a, b, a * from[0] + b * from[1], false};
  }
};

/// One facet, against the cells of several samples in turn.
template <class Exact_nt>
class Facet_cell_clipper {
  struct Line {
    int id; // sample, or -1 .. -3: edge of the facet
    Tangent_line<Filter_nt> approximate;
    std::optional<Tangent_line<Exact_nt>> exact;
  };
  struct Vertex {
    int line, next_line; // indices into m_lines, counter-clockwise
    Tangent_vertex<Filter_nt> approximate;
    Filter_nt position[3]; // relative to the first corner
    bool located = false;
  };

  const std::vector<Vec3d>& m_points;
  const std::vector<double>& m_weights;
  std::array<Vec3d, 3> m_facet;
  std::array<int, 3> m_axes; // axis, p, q
  bool m_flipped = false, m_degenerate;
  std::optional<Facet_plane<Filter_nt>> m_approximate_plane;
  std::optional<Facet_plane<Exact_nt>> m_exact_plane;
  int m_index = -1;
  std::vector<Line> m_lines;
  std::vector<Vertex> m_vertices, m_clipped;
  std::vector<Sign> m_sides;

public:
  /// Keeps references to the samples' `points` and `weights`.
  Facet_cell_clipper(const std::vector<Vec3d>& points, const std::vector<double>& weights,
                     const std::array<Vec3d, 3>& facet)
      : m_points(points), m_weights(weights), m_facet(facet)
  {
    const Vec3d n = cross(facet[1] - facet[0], facet[2] - facet[0]);
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (std::fabs(coordinate(n, k)) > std::fabs(coordinate(n, axis))) axis = k;
    m_axes = {axis, (axis + 1) % 3, (axis + 2) % 3};
    const Sign s =
        CGAL::sign(Facet_plane<Exact_nt>(facet, m_axes[0], m_axes[1], m_axes[2], false).n_axis);
    m_degenerate = s == ZERO;
    if (s == NEGATIVE) {
      m_flipped = true;
      std::swap(m_axes[1], m_axes[2]);
    }
    m_exact_plane.emplace(facet, m_axes[0], m_axes[1], m_axes[2], m_flipped);
    Protect_FPU_rounding<true> upward;
    m_approximate_plane.emplace(facet, m_axes[0], m_axes[1], m_axes[2], m_flipped);
  }

  /// Whether the facet has no inside.
  bool is_degenerate() const { return m_degenerate; }

  /// Starts the piece of sample `i`: the whole facet.
  void start(int i)
  {
    m_index = i;
    m_lines.clear();
    m_vertices.clear();
    Protect_FPU_rounding<true> upward;
    for (int e = 0; e < 3; ++e)
      m_lines.push_back({-1 - e, m_approximate_plane->edge_line(e), std::nullopt});
    for (int e = 0; e < 3; ++e) m_vertices.push_back(make_vertex(e, (e + 1) % 3));
  }

  bool is_empty() const { return m_vertices.empty(); }

  /// Keeps the part where the piece's sample has less power than sample `j`.
  void clip(int j)
  {
    if (is_empty() || j == m_index) return;
    Protect_FPU_rounding<true> upward;
    m_lines.push_back({j, sample_line(*m_approximate_plane, j), std::nullopt});
    const int line = int(m_lines.size()) - 1, n = int(m_vertices.size());
    m_sides.resize(n);
    int outside = 0;
    for (int v = 0; v < n; ++v) {
      m_sides[v] = side(m_vertices[v], line);
      outside += m_sides[v] == NEGATIVE;
    }
    if (outside == 0) {
      m_lines.pop_back();
      return;
    }
    if (outside == n) return m_vertices.clear();
    int first = 0;
    while (!(m_sides[first] == NEGATIVE && m_sides[(first + n - 1) % n] == POSITIVE)) ++first;
    const int last = (first + outside - 1) % n;
    m_clipped.clear();
    for (int k = 0; k < n - outside; ++k) m_clipped.push_back(m_vertices[(last + 1 + k) % n]);
    m_clipped.push_back(make_vertex(m_vertices[first].line, line));
    m_clipped.push_back(make_vertex(line, m_vertices[last].next_line));
    m_vertices.swap(m_clipped);
  }

  /// False when it is proved that no sample of the box cuts the piece (see Tangent_cell_clipper).
  bool may_be_cut_by(const Weighted_box& box)
  {
    if (is_empty()) return false;
    Protect_FPU_rounding<true> upward;
    const Filter_nt weight_gap = Filter_nt(m_weights[m_index]) - Filter_nt(box.max_weight);
    for (Vertex& v : m_vertices) {
      if (!locate(v)) return true;
      Filter_nt difference = weight_gap;
      for (int k = 0; k < 3; ++k) {
        const int axis = m_axes[k];
        const Filter_nt q = v.position[k] + Filter_nt(coordinate(m_facet[0], axis));
        const double below = (Filter_nt(coordinate(box.lo, axis)) - q).inf();
        const double above = (q - Filter_nt(coordinate(box.hi, axis))).inf();
        difference += CGAL::square(Filter_nt((std::max)({0., below, above}))) -
                      CGAL::square(q - Filter_nt(coordinate(m_points[m_index], axis)));
      }
      if (!(difference.inf() > 0)) return true;
    }
    return false;
  }

  /// Whether sample j has less power than sample i at the facet's first corner (perturbed).
  bool is_nearer_to_corner(int j, int i) const
  {
    const auto difference = [&](auto zero) {
      using NT = decltype(zero);
      NT d = NT(m_weights[j]) - NT(m_weights[i]); // power to i - power to j
      for (int k = 0; k < 3; ++k) {
        const NT c(coordinate(m_facet[0], k));
        d = d + CGAL::square(NT(coordinate(m_points[i], k)) - c) -
            CGAL::square(NT(coordinate(m_points[j], k)) - c);
      }
      return d;
    };
    Sign s;
    {
      Protect_FPU_rounding<true> upward;
      s = certain_sign(difference(Filter_nt(0)));
    }
    if (s == ZERO) s = CGAL::sign(difference(Exact_nt(0)));
    return s == ZERO ? j < i : s == POSITIVE;
  }

  /// The ids of the piece's edges, counter-clockwise seen from the facet's normal.
  std::vector<int> cycle() const
  {
    std::vector<int> ids;
    for (const Vertex& v : m_vertices) ids.push_back(m_lines[v.line].id);
    return ids;
  }

  /// The piece's corners, rounded; corner k ends edge k.
  std::vector<Vec3d> corners() const
  {
    std::vector<Vec3d> result;
    for (const Vertex& v : m_vertices) {
      const auto c = crossing(exact(m_lines[v.line]), exact(m_lines[v.next_line]));
      const double p = CGAL::to_double(c.x) / CGAL::to_double(c.w);
      const double q = CGAL::to_double(c.y) / CGAL::to_double(c.w);
      double x[3];
      x[m_axes[1]] = p;
      x[m_axes[2]] = q;
      x[m_axes[0]] =
          -(CGAL::to_double(m_exact_plane->n_p) * p + CGAL::to_double(m_exact_plane->n_q) * q) /
          CGAL::to_double(m_exact_plane->n_axis);
      result.push_back(m_facet[0] + Vec3d{x[0], x[1], x[2]});
    }
    return result;
  }

private:
  /// 2 v.(x - s_i) <= |v|^2 + w_i - w_j for points x of the plane, times n_axis.
  template <class NT>
  Tangent_line<NT> sample_line(const Facet_plane<NT>& plane, int j) const
  {
    NT v[3], c = NT(m_weights[m_index]) - NT(m_weights[j]);
    for (int k = 0; k < 3; ++k) {
      const NT s_i(coordinate(m_points[m_index], m_axes[k]));
      v[k] = NT(coordinate(m_points[j], m_axes[k])) - s_i;
      c = c + v[k] * (v[k] + NT(2) * (s_i - NT(coordinate(m_facet[0], m_axes[k]))));
    }
    return {NT(2) * (plane.n_axis * v[1] - plane.n_p * v[0]),
            NT(2) * (plane.n_axis * v[2] - plane.n_q * v[0]), plane.n_axis * c, false};
  }

  Tangent_line<Exact_nt> exact(const Line& l) const
  {
    if (l.exact) return *l.exact;
    return l.id < 0 ? m_exact_plane->edge_line(-1 - l.id) : sample_line(*m_exact_plane, l.id);
  }

  const Tangent_line<Exact_nt>& cached(Line& l) const
  {
    if (!l.exact) l.exact = exact(l);
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
    if (s != ZERO) return s;
    Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
    Line &j = m_lines[v.line], &k = m_lines[v.next_line], &l = m_lines[line];
    bool tie;
    // l is a sample: its perturbation decides before those of the facet's edges would.
    return exact_side<Exact_nt>({&cached(j), &cached(k), &cached(l)}, {j.id, k.id, l.id}, m_index,
                                tie);
  }

  /// Intervals for the position; false when there is none.
  bool locate(Vertex& v) const
  {
    if (v.located) return true;
    if (!(v.approximate.w.inf() > 0 && m_approximate_plane->n_axis.inf() > 0)) return false;
    v.position[1] = v.approximate.x / v.approximate.w;
    v.position[2] = v.approximate.y / v.approximate.w;
    v.position[0] =
        -(m_approximate_plane->n_p * v.position[1] + m_approximate_plane->n_q * v.position[2]) /
        m_approximate_plane->n_axis;
    v.located = true;
    return true;
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_TEST_FACET_CELL_CLIPPER_H
