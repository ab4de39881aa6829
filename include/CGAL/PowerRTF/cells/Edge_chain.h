// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A cell whose edges are known, in their order: its vertices are where consecutive lines meet. This
// needs no search and no sorting; whether the edges are still the right ones is decided on the way
// round, and by the other neighbors' lines, which have to pass outside.
#ifndef CGAL_POWER_RTF_CELLS_EDGE_CHAIN_H
#define CGAL_POWER_RTF_CELLS_EDGE_CHAIN_H

#include <CGAL/PowerRTF/cells/cell_moments.h>

#include <cmath>

namespace CGAL::PowerRTF {

/// A neighbor's line a x + b y <= c in the tangent frame.
template <class Real>
struct Edge_line {
  Real a, b, c;
};

/// What a chain of edges tells about its cell on the way round; `moments` as `cell_moments()`.
template <class Real>
struct Chain_result {
  Real radius2 = 0;
  Cell_moments<Real> moments;
};

/// The corners of a cell between the lines of its edges, one after another. `Polygon` has the
/// members `begin_chain()`, `set_chain_vertex()`, `end_chain()` and `quotient()`.
template <class Polygon, bool WithMoments>
class Edge_chain {
public:
  using Real = typename Polygon::Number;

  /// `own`: the cube root of the density at the site.
  CGAL_POWER_RTF_HD Edge_chain(Polygon& polygon, Real own) : m_polygon(polygon), m_own(own)
  {
    polygon.begin_chain();
  }

  /// Edge k; `root`: of its neighbor, as `own`.
  CGAL_POWER_RTF_HD void add(int k, const Edge_line<Real>& l, Real root)
  {
    if (k == 0) {
      m_first_line = l;
      m_first_root = root;
    } else {
      add_vertex(k, l, root);
      if (k == 1) m_first = m_here;
    }
    m_line = l;
    m_root = root;
  }

  /// After all `edges`. A closed chain of left turns that goes round once, each edge in its line's
  /// direction, bounds the intersection of its half-planes; returns whether it is one.
  CGAL_POWER_RTF_HD bool close(int edges)
  {
    add_vertex(edges, m_first_line, m_first_root); // at the place of vertex 0
    const Vertex last = m_here;
    m_polygon.set_chain_vertex(0, last.x, last.y);
    m_line = m_first_line;
    m_is_chain = m_is_chain && is_forward(last, m_first);
    add_triangle(last, m_first);
    m_polygon.end_chain(edges);
    m_result.moments.area /= 2;
    if (WithMoments) {
      Cell_moments<Real>& m = m_result.moments;
      m.mass /= 6;
      const Real scale = m.mass > 0 ? 1 / (24 * m.mass) : Real(0);
      m.x *= scale;
      m.y *= scale;
    }
    return m_is_chain && m_rounds == 1;
  }
  CGAL_POWER_RTF_HD const Chain_result<Real>& result() const { return m_result; }

private:
  struct Vertex {
    Real x, y, density;
  };

  CGAL_POWER_RTF_HD void add_vertex(int k, const Edge_line<Real>& l, Real root)
  {
    const Real turn = m_line.a * l.b - m_line.b * l.a;
    const Real squares = (m_line.a * m_line.a + m_line.b * m_line.b) * (l.a * l.a + l.b * l.b);
    m_is_chain = m_is_chain && turn > 0 && turn * turn > Real(0.01) * squares;
    m_rounds += m_line.b < 0 && l.b >= 0;
    const Real inverse = Polygon::quotient(Real(1), turn);
    const Vertex v{(m_line.c * l.b - m_line.b * l.c) * inverse,
                   (m_line.a * l.c - m_line.c * l.a) * inverse, m_own * m_root * root};
    m_result.radius2 = std::fmax(m_result.radius2, v.x * v.x + v.y * v.y);
    if (k > 1) {
      m_is_chain = m_is_chain && is_forward(m_here, v);
      add_triangle(m_here, v);
    }
    m_polygon.set_chain_vertex(k, v.x, v.y);
    m_here = v;
  }
  CGAL_POWER_RTF_HD bool is_forward(const Vertex& from, const Vertex& to) const
  {
    return m_line.a * (to.y - from.y) - m_line.b * (to.x - from.x) > 0;
  }

  /// Sums that `close()` divides.
  CGAL_POWER_RTF_HD void add_triangle(const Vertex& p, const Vertex& q)
  {
    Cell_moments<Real>& m = m_result.moments;
    const Real area = p.x * q.y - q.x * p.y;
    m.area += area;
    if (!WithMoments) return;
    const Real sum = m_own * m_own * m_own + p.density + q.density;
    m.mass += area * sum;
    m.x += area * ((sum + p.density) * p.x + (sum + q.density) * q.x);
    m.y += area * ((sum + p.density) * p.y + (sum + q.density) * q.y);
  }

  Polygon& m_polygon;
  Real m_own;
  Edge_line<Real> m_first_line{}, m_line{};
  Real m_first_root = 1, m_root = 1;
  Vertex m_first{}, m_here{}; // vertices 1 and k
  bool m_is_chain = true;
  int m_rounds = 0;
  Chain_result<Real> m_result;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_EDGE_CHAIN_H
