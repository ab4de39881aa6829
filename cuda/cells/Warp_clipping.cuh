// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Clips a warp's polygon by the lines in shared memory: all lines are tested together and the
// polygon is clipped by the nearest one that cuts it. The initial polygon has known or guessed
// edges.
#ifndef CGAL_POWER_RTF_CUDA_WARP_CLIPPING_CUH
#define CGAL_POWER_RTF_CUDA_WARP_CLIPPING_CUH

#include "Warp_cell_memory.cuh"
#include "Warp_polygon.cuh"

namespace CGAL::PowerRTF::device {

/// Cells with more than 32 edges overflow.
template <class Real>
class Warp_clipping {
public:
  __device__ Warp_clipping(Warp_cell_memory<Real>& memory, int lane)
      : m_memory(memory), m_lane(lane)
  {}

  const __device__ Warp_polygon<Real>& polygon() const { return m_polygon; }
  /// One that another object has made in the same memory.
  __device__ void set_polygon(const Warp_polygon<Real>& polygon) { m_polygon = polygon; }
  /// The neighbor of the lane's edge, or the number of a side of the square.
  __device__ int neighbor() const
  {
    const int edge = m_polygon.edge;
    if (m_lane >= m_polygon.size) return -1;
    return edge < 0 && edge >= -4 ? edge : place_of_edge(edge);
  }
  __device__ Real radius() const { return std::sqrt(m_polygon.squared_radius(m_lane)); }

protected:
  static constexpr unsigned compatible_lines = 1, other_lines = 2, all_lines = 3;

  __device__ static int place_of_line(int neighbor)
  {
    return neighbor < 0 ? -1 - neighbor : neighbor;
  }

  /// Edges carry the numbers of lines; those of lines that are forgotten carry -5 - place.
  __device__ int place_of_edge(int edge) const
  {
    return edge < 0 ? -5 - edge : place_of_line(m_memory.neighbor[edge]);
  }

  __device__ void keep_edges(int which)
  {
    __syncwarp();
    if (m_lane < m_polygon.size) m_memory.edges[which][m_lane] = short(m_polygon.edge);
    if (m_lane == 0) m_memory.sizes[which] = m_polygon.overflow ? 0 : m_polygon.size;
    __syncwarp();
  }

  /// Notes edges to begin with where none are known: the nearest line is one, and each next one is
  /// on the line that ends the last one first. `start()` sees whether they make a polygon.
  __device__ void guess_edges(int which, int lines, unsigned kinds, Real half)
  {
    const auto is_wanted = [&](int k) {
      return (kinds & (m_memory.neighbor[k] < 0 ? other_lines : compatible_lines)) != 0;
    };
    int best = 0x7fffffff, edge = 0;
    for (int k = m_lane; k < lines; k += 32) {
      const int order =
          is_wanted(k) ? order_of_line(m_memory.a[k], m_memory.b[k], m_memory.c[k]) : 0x7fffffff;
      if (!(order < best)) continue;
      best = order;
      edge = k;
    }
    const int least = warp_min(best);
    if (least < 0 || least == 0x7fffffff) return; // the site is not inside, or there is no line
    edge = __shfl_sync(full_warp, edge, lowest_bit(__ballot_sync(full_warp, best == least)));

    const int first = edge;
    Line line = line_of_edge(edge, half);
    const Real foot = quick_quotient(line.c, line.a * line.a + line.b * line.b);
    Real x = line.a * foot, y = line.b * foot; // on the line
    int size = 0;
#pragma unroll 1
    do {
      if (m_lane == 0) m_memory.edges[which][size] = short(edge);
      ++size;
      const int last = edge;
      float nearest = 1e30f;
      const auto meet = [&](int number, const Line& l) {
        const Real slope = l.b * line.a - l.a * line.b; // in the direction of the edge
        if (!(slope > 0) || number == last) return;
        const float t = fmax(float(quick_quotient(l.c - l.a * x - l.b * y, slope)), 0.0f);
        if (!(t < nearest)) return;
        nearest = t;
        edge = number;
      };
      if (m_lane < 4) meet(-1 - m_lane, line_of_edge(-1 - m_lane, half));
      for (int k = m_lane; k < lines; k += 32)
        if (is_wanted(k)) meet(k, Line{m_memory.a[k], m_memory.b[k], m_memory.c[k]});
      const float t = warp_min_nonnegative(nearest);
      edge = __shfl_sync(full_warp, edge, lowest_bit(__ballot_sync(full_warp, nearest == t)));
      x -= t * line.b;
      y += t * line.a;
      line = line_of_edge(edge, half);
    } while (edge != first && size < 32);
    __syncwarp();
    if (m_lane == 0 && edge == first) m_memory.sizes[which] = size;
    __syncwarp();
  }

  /// Notes the polygon's farthest vertex.
  __device__ void keep_corner()
  {
    const bool is_vertex = m_lane < m_polygon.size;
    const Real r2 = is_vertex ? m_polygon.x * m_polygon.x + m_polygon.y * m_polygon.y : Real(0);
    const Real most = warp_max_nonnegative(r2);
    const int vertex = lowest_bit(__ballot_sync(full_warp, is_vertex && r2 == most));
    const int before = vertex > 0 ? vertex - 1 : m_polygon.size - 1;
    const int first = __shfl_sync(full_warp, m_polygon.edge, before);
    const int second = __shfl_sync(full_warp, m_polygon.edge, vertex);
    __syncwarp();
    if (m_lane < 2) m_memory.corner[m_lane] = m_lane == 0 ? first : second;
    __syncwarp();
  }

  /// Whether the vertex noted last still belongs to the polygon by compatible lines, and lies
  /// farther away than `guard`: then the cell is guarded.
  __device__ bool has_corner_beyond(int lines, Real guard) const
  {
    const int edges[2] = {m_memory.corner[0], m_memory.corner[1]};
    if (edges[0] == edges[1]) return false; // none
    const Line p = line_of_edge(edges[0], guard), q = line_of_edge(edges[1], guard);
    const Corner corner = corner_of(p, q);
    const Real x = corner.x, y = corner.y, most = guard * (1 + 8 * internal::epsilon<Real>());
    if (!corner.is_left_turn || !(x * x + y * y > guard * guard) || !(std::fabs(x) <= most) ||
        !(std::fabs(y) <= most))
      return false;
    bool is_cut = false;
    for (int k = m_lane; k < lines; k += 32)
      is_cut |= m_memory.neighbor[k] >= 0 && k != edges[0] && k != edges[1] &&
                fma(m_memory.a[k], x, fma(m_memory.b[k], y, -m_memory.c[k])) > 0;
    return !__any_sync(full_warp, is_cut);
  }

  struct Line {
    Real a, b, c;
  };
  /// `edge`: a line in memory, or a side of the square.
  __device__ Line line_of_edge(int edge, Real half) const
  {
    if (edge >= 0) return {m_memory.a[edge], m_memory.b[edge], m_memory.c[edge]};
    const Side_normal normal = normal_of_side(-1 - edge);
    return {normal.a, normal.b, half};
  }

  struct Corner {
    Real x, y;
    bool is_left_turn; ///< and not nearly straight
  };
  /// Between edges on the lines p and q.
  __device__ static Corner corner_of(const Line& p, const Line& q)
  {
    const Real turn = p.a * q.b - p.b * q.a;
    const Real squares = (p.a * p.a + p.b * p.b) * (q.a * q.a + q.b * q.b);
    const Real inverse = quick_quotient(Real(1), turn);
    return {(p.c * q.b - p.b * q.c) * inverse, (p.a * q.c - p.c * q.a) * inverse,
            turn > 0 && turn * turn > Real(0.01) * squares};
  }

  /// The polygon to begin with: that of the last time's edges, where these still make one, or the
  /// square.
  __device__ void start(int which, Real guard)
  {
    m_polygon.set_square(guard, m_lane);
    int size = m_memory.sizes[which], edge = 0;
    bool is_edge = false;
    Real x = 0, y = 0;
    constexpr int tries = 3;
#pragma unroll 1
    for (int k = 0;; ++k) {
      if (size < 3 || k == tries) return;
      is_edge = m_lane < size;
      edge = is_edge ? m_memory.edges[which][m_lane] : 0;
      const Line own = is_edge ? line_of_edge(edge, guard) : Line{1, 0, 1};
      const int before = m_lane > 0 ? m_lane - 1 : size - 1;
      const int after = m_lane + 1 < size ? m_lane + 1 : 0;
      const Line previous{__shfl_sync(full_warp, own.a, before),
                          __shfl_sync(full_warp, own.b, before),
                          __shfl_sync(full_warp, own.c, before)};
      const Corner corner = corner_of(previous, own);
      x = corner.x;
      y = corner.y;
      const Real dx = __shfl_sync(full_warp, x, after) - x;
      const Real dy = __shfl_sync(full_warp, y, after) - y;
      // Left turns that go round once, each edge in its line's direction.
      const bool is_good = corner.is_left_turn && own.a * dy - own.b * dx > 0;
      const int rounds = __popc(__ballot_sync(full_warp, is_edge && previous.b < 0 && own.b >= 0));
      const unsigned good = __ballot_sync(full_warp, is_edge && is_good);
      if (__popc(good) == size) {
        if (rounds != 1) return;
        break;
      }
      // Without the edges that have vanished.
      __syncwarp();
      if (is_edge && is_good)
        m_memory.edges[which][__popc(good & ((1u << m_lane) - 1))] = short(edge);
      __syncwarp();
      size = __popc(good);
    }
    m_polygon.x = x;
    m_polygon.y = y;
    m_polygon.edge = edge;
    m_polygon.size = size;
    if (!__any_sync(full_warp, is_edge && (std::fabs(x) > guard || std::fabs(y) > guard))) return;
#pragma unroll 1
    for (int side = 0; side < 4; ++side) { // the other sides of the square
      if (__any_sync(full_warp, is_edge && edge == -1 - side)) continue;
      const Side_normal normal = normal_of_side(side);
      m_polygon.clip(normal.a, normal.b, guard, -1 - side, m_lane);
    }
  }

  struct Side_normal {
    Real a, b;
  };
  /// The right one is side 0 of the square, the upper one side 1.
  __device__ static Side_normal normal_of_side(int side)
  {
    return {side == 0   ? Real(1)
            : side == 2 ? Real(-1)
                        : Real(0),
            side == 1   ? Real(1)
            : side == 3 ? Real(-1)
                        : Real(0)};
  }

  /// Which of the lane's lines `left` cut the polygon: bit k for line k * 32 + lane.
  __device__ unsigned cutting_lines(unsigned left) const
  {
    constexpr int at_once = 4; // the values wait together
    unsigned cutting = 0;
    for (int first = 0; first < m_polygon.size; first += at_once) {
      Real x[at_once], y[at_once];
#pragma unroll
      for (int l = 0; l < at_once; ++l) {
        const int v = first + l < m_polygon.size ? first + l : 0;
        x[l] = __shfl_sync(full_warp, m_polygon.x, v);
        y[l] = __shfl_sync(full_warp, m_polygon.y, v);
      }
      for (unsigned rest = left & ~cutting; rest != 0; rest &= rest - 1) {
        const int k = lowest_bit(rest), line = k * 32 + m_lane;
        const Real a = m_memory.a[line], b = m_memory.b[line], c = m_memory.c[line];
        bool cuts = false;
#pragma unroll
        for (int l = 0; l < at_once; ++l) cuts |= fma(a, x[l], fma(b, y[l], -c)) > 0;
        if (cuts) cutting |= 1u << k;
      }
    }
    return cutting;
  }

  /// Those of `left` that pass within the radius.
  __device__ unsigned lines_within(Real radius2, unsigned left) const
  {
    unsigned within = left;
    for (unsigned rest = left; rest != 0; rest &= rest - 1) {
      const int k = lowest_bit(rest), line = k * 32 + m_lane;
      const Real a = m_memory.a[line], b = m_memory.b[line], c = m_memory.c[line];
      if (c > 0 && c * c > radius2 * (a * a + b * b) * (1 + 16 * internal::epsilon<Real>()))
        within &= ~(1u << k);
    }
    return within;
  }

  /// Increases with a line's distance from the site.
  __device__ static int order_of_line(Real a, Real b, Real c)
  {
    const float length = quick_sqrt(float(a * a + b * b));
    const int bits = __float_as_int(quick_quotient(float(c), length));
    return bits ^ ((bits >> 31) & 0x7fffffff);
  }

  /// Cuts the polygon by the first `lines` lines in memory that are of the wanted `kinds`.
  __device__ void clip(int lines, unsigned kinds)
  {
    constexpr int last = 0x7fffffff;
    Warp_polygon<Real>& polygon = m_polygon;
    unsigned left = 0; // bit k: line k * 32 + lane may cut
    for (int k = 0; k * 32 < lines; ++k) {
      const int line = k * 32 + m_lane;
      if (line < lines &&
          (kinds & (m_memory.neighbor[line] < 0 ? other_lines : compatible_lines)) != 0)
        left |= 1u << k;
    }
    for (int v = 0; v < polygon.size; ++v) { // its edges would cut it by rounding only
      const int line = __shfl_sync(full_warp, polygon.edge, v);
      if (line >= 0 && line % 32 == m_lane) left &= ~(1u << line / 32);
    }
    if (lines > 64) left = lines_within(polygon.squared_radius(m_lane), left);
    while (polygon.size > 0 && !polygon.overflow) {
      left = cutting_lines(left); // what does not cut the polygon does not cut a part of it
      if (!__any_sync(full_warp, left != 0)) break;
      int nearest = last, number = 0;
      Real a = 0, b = 0, c = 0;
      for (unsigned rest = left; rest != 0; rest &= rest - 1) {
        const int line = lowest_bit(rest) * 32 + m_lane;
        const Real la = m_memory.a[line], lb = m_memory.b[line], lc = m_memory.c[line];
        const int order = order_of_line(la, lb, lc);
        if (!(order < nearest)) continue;
        nearest = order;
        number = line;
        a = la;
        b = lb;
        c = lc;
      }
      const int least = warp_min(nearest);
      const int owner = lowest_bit(__ballot_sync(full_warp, nearest == least));
      if (m_lane == owner) left &= ~(1u << number / 32);
      polygon.clip(__shfl_sync(full_warp, a, owner), __shfl_sync(full_warp, b, owner),
                   __shfl_sync(full_warp, c, owner), __shfl_sync(full_warp, number, owner), m_lane);
    }
  }

  Warp_cell_memory<Real>& m_memory;
  int m_lane;
  Warp_polygon<Real> m_polygon; // by compatible lines; at the end the cell
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WARP_CLIPPING_CUH
