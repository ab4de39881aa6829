// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A convex polygon whose vertices are the registers of a warp: every step of a cut is one
// instruction for all of them. At most 32 vertices.
#ifndef CGAL_POWER_RTF_CUDA_WARP_POLYGON_CUH
#define CGAL_POWER_RTF_CUDA_WARP_POLYGON_CUH

#include "warp_search.cuh"

namespace CGAL::PowerRTF::device {

/// Counter-clockwise: lane k holds vertex k and the number of edge k, which runs to vertex k + 1;
/// the sides of the initial square have the numbers -1 .. -4. `size` and `overflow` are the same on
/// all lanes.
template <class Real>
struct Warp_polygon {
  Real x, y;
  int edge;
  int size;
  bool overflow; // a cut was lost: more than 32 vertices

  __device__ void set_square(Real half, int lane)
  {
    size = 4;
    overflow = false;
    x = lane == 0 || lane == 1 ? half : -half;
    y = lane == 1 || lane == 2 ? half : -half;
    edge = -1 - lane;
  }

  __device__ Real squared_radius(int lane) const
  {
    return warp_max_nonnegative(lane < size ? x * x + y * y : Real(0));
  }

  __device__ bool touches_square(int lane) const
  {
    return __any_sync(full_warp, lane < size && edge < 0 && edge >= -4);
  }

  __device__ Real area(int lane) const
  {
    const int next = lane + 1 < size ? lane + 1 : 0;
    const Real nx = __shfl_sync(full_warp, x, next), ny = __shfl_sync(full_warp, y, next);
    return warp_sum(lane < size ? x * ny - nx * y : Real(0)) / 2;
  }

  /// Keeps a x + b y <= c; see `Tangent_polygon::clip()`.
  __device__ void clip(Real a, Real b, Real c, int number, int lane)
  {
    const bool is_vertex = lane < size;
    const Real s = is_vertex ? fma(a, x, fma(b, y, -c)) : Real(0);
    const unsigned all = size == 32 ? full_warp : (1u << size) - 1;
    const unsigned outside = __ballot_sync(full_warp, s > 0), inside = ~outside & all;
    if (outside == 0) return;
    if (inside == 0) {
      size = 0;
      return;
    }
    int worst = lowest_bit(outside);
    const unsigned begins = outside & ~(outside << 1 | outside >> (size - 1));
    if ((begins & (begins - 1)) != 0) { // by rounding they are not one chain
      const Real largest = warp_max(s);
      worst = __ffs(int(__ballot_sync(full_warp, is_vertex && s == largest))) - 1;
    }
    const unsigned after = inside >> worst, before = inside & ((1u << worst) - 1);
    const int out = after ? worst + lowest_bit(after) : lowest_bit(inside);
    const int in = highest_bit(before ? before : inside);
    const int kept = in >= out ? in - out + 1 : in + size - out + 1;
    if (kept + 2 > 32) {
      overflow = true;
      return;
    }
    const int begin = in + 1 < size ? in + 1 : 0, end = out > 0 ? out - 1 : size - 1;
    // Lane `kept` makes the vertex between `in` and `begin`, the next one that of `end` and `out`.
    int from = out + lane, other = from;
    if (from >= size) from -= size;
    if (lane == kept) {
      from = in;
      other = begin;
    } else if (lane == kept + 1) {
      from = out;
      other = end;
    } else {
      other = from;
    }
    const Real px = __shfl_sync(full_warp, x, from), py = __shfl_sync(full_warp, y, from);
    const Real qx = __shfl_sync(full_warp, x, other), qy = __shfl_sync(full_warp, y, other);
    const Real sp = __shfl_sync(full_warp, s, from), sq = __shfl_sync(full_warp, s, other);
    const int carried = __shfl_sync(full_warp, edge, lane == kept + 1 ? end : from);
    const bool is_new = lane == kept || lane == kept + 1;
    const Real t = is_new ? quick_quotient(sp, sp - sq) : Real(0);
    x = is_new ? px + t * (qx - px) : px;
    y = is_new ? py + t * (qy - py) : py;
    edge = lane == kept ? number : carried;
    size = kept + 2;
  }
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_WARP_POLYGON_CUH
