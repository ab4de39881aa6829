// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The convex polygon of a cell, clipped in place in a ring of 16 vertices. The same cuts as
// `Tangent_polygon`, in a form that suits one lane of a warp: the vertices lie in memory that is
// handed in (shared memory, one column per lane), one bit per vertex says what a line removes, and
// at most a few vertices move. Polygons with more vertices go to `Tangent_polygon`.
#ifndef CGAL_POWER_RTF_CUDA_RING_POLYGON_H
#define CGAL_POWER_RTF_CUDA_RING_POLYGON_H

#include "quick_math.h"

namespace CGAL::PowerRTF::device {

/// The memory of the polygons of `Columns` lanes; vertex `slot` of a lane is at [slot * Columns].
template <class Real, int Columns>
struct Ring_memory {
  static constexpr int capacity = 16;
  struct alignas(2 * sizeof(Real)) Point {
    Real x, y;
  };
  Point points[capacity * Columns];
  unsigned char edges[capacity * Columns];
};

/// A convex polygon, counter-clockwise; edge k runs from vertex k to vertex k + 1 and carries a
/// number below 252, or 252 .. 255 for a side of the initial square.
template <class Real, int Columns>
class Ring_polygon {
public:
  using Number = Real;
  using Memory = Ring_memory<Real, Columns>;
  static constexpr int capacity = Memory::capacity;
  static constexpr int square_side = 252;

  int size = 0;
  bool overflow = false; ///< a cut was lost because the polygon was full

  CGAL_POWER_RTF_HD Ring_polygon(Memory& memory, int column)
      : m_points(memory.points + column), m_edges(memory.edges + column)
  {}

  /// The square [-half, half]^2.
  CGAL_POWER_RTF_HD void set_square(Real half)
  {
    m_head = 0;
    size = 4;
    overflow = false;
    set(0, half, -half, square_side);
    set(1, half, half, square_side + 1);
    set(2, -half, half, square_side + 2);
    set(3, -half, -half, square_side + 3);
  }

  /// Vertex by vertex: edge k is number k.
  CGAL_POWER_RTF_HD void begin_chain()
  {
    m_head = 0;
    overflow = false;
  }
  CGAL_POWER_RTF_HD void set_chain_vertex(int k, Real x, Real y)
  {
    m_points[(k & (capacity - 1)) * Columns] = {x, y};
    m_edges[(k & (capacity - 1)) * Columns] = static_cast<unsigned char>(k);
  }
  CGAL_POWER_RTF_HD void end_chain(int vertices) { size = vertices; }
  CGAL_POWER_RTF_HD static Real quotient(Real a, Real b) { return quick_quotient(a, b); }
  /// Whether a x + b y <= c for all vertices of a chain that has just been made.
  CGAL_POWER_RTF_HD bool is_chain_inside(Real a, Real b, Real c) const
  {
    Real most = side(a, b, c, m_points[0]);
    for (int k = 1; k < size; ++k) most = std::fmax(most, side(a, b, c, m_points[k * Columns]));
    return !(most > 0);
  }

  /// The empty polygon.
  CGAL_POWER_RTF_HD void clear() { size = 0; }

  CGAL_POWER_RTF_HD Real x(int k) const { return m_points[place(k)].x; }
  CGAL_POWER_RTF_HD Real y(int k) const { return m_points[place(k)].y; }
  CGAL_POWER_RTF_HD int edge(int k) const { return m_edges[place(k)]; }
  CGAL_POWER_RTF_HD int next(int k) const { return k + 1 < size ? k + 1 : 0; }

  CGAL_POWER_RTF_HD Real squared_radius() const
  {
    Real r = 0;
    for (int k = 0; k < size; ++k) {
      const auto p = m_points[place(k)];
      const Real d = p.x * p.x + p.y * p.y;
      if (d > r) r = d;
    }
    return r;
  }

  CGAL_POWER_RTF_HD bool touches_square() const
  {
    bool touches = false;
    for (int k = 0; k < size; ++k) touches |= edge(k) >= square_side;
    return touches;
  }

  /// Keeps a x + b y <= c; the new edge carries `number`.
  CGAL_POWER_RTF_HD void clip(Real a, Real b, Real c, int number)
  {
    unsigned outside = 0;
    Real largest = 0;
    int worst = 0;
    for (int k = 0; k < size; ++k) {
      const Real s = side(a, b, c, m_points[place(k)]);
      if (s > 0) outside |= 1u << k;
      if (s > largest) {
        largest = s;
        worst = k;
      }
    }
    if (outside == 0) return;

    // The removed vertices form one chain around the worst one (taken so even where rounding says
    // otherwise); the kept ones run from `out` to `in`.
    const unsigned inside = ~outside & ((1u << size) - 1);
    if (inside == 0) {
      size = 0;
      return;
    }
    const unsigned after = inside >> worst, before = inside & ((1u << worst) - 1);
    const int out = after ? worst + lowest_bit(after) : lowest_bit(inside);
    const int in = highest_bit(before ? before : inside);
    const int kept = in >= out ? in - out + 1 : in + size - out + 1;
    if (kept + 2 > capacity) {
      overflow = true;
      return;
    }

    const int begin = next(in), end = out > 0 ? out - 1 : size - 1;
    const auto p_in = m_points[place(in)], p_begin = m_points[place(begin)];
    const auto p_out = m_points[place(out)], p_end = m_points[place(end)];
    const int exit_edge = edge(end);
    const Real s_in = side(a, b, c, p_in), s_begin = side(a, b, c, p_begin);
    const Real s_out = side(a, b, c, p_out), s_end = side(a, b, c, p_end);
    const Real ti = quick_quotient(s_in, s_in - s_begin), to = quick_quotient(s_out, s_out - s_end);
    const Real px = p_in.x + ti * (p_begin.x - p_in.x), py = p_in.y + ti * (p_begin.y - p_in.y);
    const Real qx = p_out.x + to * (p_end.x - p_out.x), qy = p_out.y + to * (p_end.y - p_out.y);

    int last = in;   // of the kept vertices, counted from the old first vertex
    if (in >= out) { // the kept chain does not wrap around: it becomes the front
      m_head += out;
      last -= out;
    } else { // the removed chain lies inside: move the front to leave a gap of two places
      const int shift = out - in - 3;
      if (shift < 0)
        for (int k = 0; k <= in; ++k) copy(k, k + shift);
      else if (shift > 0)
        for (int k = in; k >= 0; --k) copy(k, k + shift);
      m_head += shift;
    }
    size = kept + 2;
    set(last + 1, px, py, number);
    set(last + 2, qx, qy, exit_edge);
  }

private:
  CGAL_POWER_RTF_HD int place(int k) const { return ((m_head + k) & (capacity - 1)) * Columns; }
  CGAL_POWER_RTF_HD void set(int k, Real x, Real y, int edge)
  {
    m_points[place(k)] = {x, y};
    m_edges[place(k)] = static_cast<unsigned char>(edge);
  }
  CGAL_POWER_RTF_HD void copy(int from, int to)
  {
    m_points[place(to)] = m_points[place(from)];
    m_edges[place(to)] = m_edges[place(from)];
  }
  /// Explicit: a compiler that contracted it in one place only would make the signs disagree.
  CGAL_POWER_RTF_HD static Real side(Real a, Real b, Real c, const typename Memory::Point& p)
  {
    return std::fma(a, p.x, std::fma(b, p.y, -c));
  }

  typename Memory::Point* m_points;
  unsigned char* m_edges;
  int m_head = 0; // m_head & (capacity - 1): where vertex 0 lies
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_RING_POLYGON_H
