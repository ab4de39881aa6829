// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cell of one lane of a warp: lists the gathered sites that may cut it. Also for the host,
// where the tests run the lanes one after another.
#ifndef CGAL_POWER_RTF_CUDA_LANE_CELL_H
#define CGAL_POWER_RTF_CUDA_LANE_CELL_H

#include "Group_tree.h"
#include "Ring_polygon.h"

#include <CGAL/PowerRTF/cells/Tangent_polygon.h>

namespace CGAL::PowerRTF::device {

#ifdef __CUDACC__
/// By loads of 16 bytes, each made by `load_word(address)`.
template <class T, class Load_word>
__device__ inline T load_words(const T* p, const Load_word& load_word)
{
  static_assert(sizeof(T) % 16 == 0 && alignof(T) % 16 == 0, "loads of 16 bytes");
  union Bits {
    int4 words[sizeof(T) / 16];
    T value;
    __device__ Bits() {}
  } bits;
#pragma unroll
  for (int k = 0; k < int(sizeof(T) / 16); ++k)
    bits.words[k] = load_word(reinterpret_cast<const int4*>(p) + k);
  return bits.value;
}
#endif

/// By loads of 16 bytes where there are such.
template <class T>
CGAL_POWER_RTF_HD inline T load(const T* p)
{
#ifdef __CUDA_ARCH__
  return load_words(p, [](const int4* word) { return *word; });
#else
  return *p;
#endif
}

/// The shared memory of a warp. The candidates of a group are no longer needed when the polygons
/// are clipped.
template <class Real>
struct Warp_memory {
  static constexpr int max_candidates = 224, max_listed = 32;
  struct Candidates {
    Packed_site<Real> sites[max_candidates];
    int places[max_candidates];
  };
  union {
    Candidates candidates;
    Ring_memory<Real, 32> polygons;
  };
  int listed[max_listed * 32]; ///< places of the sites that may cut a lane's cell, one column each
  Search_stack stack;

  CGAL_POWER_RTF_HD Warp_memory() {}
};

/// One lane's cell and what is known about its neighbors.
template <class Real>
struct Lane_cell {
  int place;
  Packed_site<Real> site;
  Real radius;
  int listed = 0, near = 0;   ///< sites listed; sites within radius / guard_factor, itself too
  Real outside2 = Real(1e30); ///< least squared distance of the gathered sites that are not listed

  CGAL_POWER_RTF_HD void clear()
  {
    listed = near = 0;
    outside2 = Real(1e30);
  }

  /// Lists those of the gathered sites `begin`, `begin + step`, .. that may cut this cell.
  CGAL_POWER_RTF_HD void list(Warp_memory<Real>& memory, int count, Real guard_factor, int lane,
                              int begin = 0, int step = 1)
  {
    int* const column = memory.listed + lane;
    list(memory.candidates, count, guard_factor, begin, step, [&](int number, int k) {
      if (number < Warp_memory<Real>::max_listed) column[number * 32] = memory.candidates.places[k];
    });
  }

  /// The same; `put(number, k)` lists the gathered site `k`.
  template <class Candidates, class Put>
  CGAL_POWER_RTF_HD void list(const Candidates& candidates, int count, Real guard_factor, int begin,
                              int step, Put&& put)
  {
    const Real four_r2 = 4 * radius * radius;
    const Real near2 = radius * radius / (guard_factor * guard_factor);
    for (int k = begin; k < count; k += step) {
      const Packed_site<Real> other = candidates.sites[k];
      const Vec3<Real> offset = other.point - site.point;
      const Real d2 = squared_length(offset), power = d2 + (site.weight - other.weight);
      near += d2 <= near2;
      if (power * std::fabs(power) > four_r2 * d2) {
        outside2 = std::fmin(outside2, d2);
        continue;
      }
      if (candidates.places[k] == place) continue;
      put(listed++, k);
    }
  }
};

/// A `Ring_polygon` whose edges carry positions in a list, as `cell_moments()` reads polygons.
template <class Real>
struct Listed_polygon {
  using Number = Real;
  using Ring = Ring_polygon<Real, 32>;
  struct X {
    const Ring& ring;
    CGAL_POWER_RTF_HD Real operator[](int k) const { return ring.x(k); }
  };
  struct Y {
    const Ring& ring;
    CGAL_POWER_RTF_HD Real operator[](int k) const { return ring.y(k); }
  };
  struct Neighbor {
    const Ring& ring;
    const int* column;
    int stride;
    CGAL_POWER_RTF_HD int operator[](int k) const
    {
      return column[std::size_t(ring.edge(k)) * stride];
    }
  };
  int size;
  X x;
  Y y;
  Neighbor neighbor;

  /// Entry k of the list is at `column[k * stride]`.
  CGAL_POWER_RTF_HD Listed_polygon(const Ring& ring, const int* column, int stride)
      : size(ring.size), x{ring}, y{ring}, neighbor{ring, column, stride}
  {}
  CGAL_POWER_RTF_HD int next(int k) const { return k + 1 < size ? k + 1 : 0; }
};

/// Clips the cell by the listed sites that are compatible. Returns whether that is the proved cell;
/// `hopeless`: it is not, and will not be for any radius.
template <class Real>
CGAL_POWER_RTF_HD inline bool clip_listed(const Group_view<Real>& view, Lane_cell<Real>& cell,
                                          const Packed_normal<Real>& own,
                                          const Tangent_frame<Real>& frame, const int* column,
                                          Ring_polygon<Real, 32>& polygon, bool& hopeless)
{
  polygon.set_square(cell.radius);
  hopeless = false;
  if (cell.listed > Warp_memory<Real>::max_listed) return false;
  for (int k = 0; k < cell.listed; ++k) {
    const int j = column[k * 32];
    const Packed_site<Real> other = load(view.sites + j);
    const Packed_normal<Real> normal = load(view.normals + j);
    if (normal.patch != own.patch) continue;
    if (!are_compatible(own.normal, normal.normal, view.cos_angle)) continue;
    const Vec3<Real> offset = other.point - cell.site.point;
    const Real d2 = squared_length(offset), power = d2 + (cell.site.weight - other.weight);
    const auto [a, b] = frame.components(offset, d2);
    if (a * a + b * b > 0)
      polygon.clip(a, b, power / 2, k);
    else if (!(power > 0))
      polygon.size = 0; // a duplicate or a plane parallel to the tangent plane
  }
  hopeless = polygon.size == 0 || polygon.overflow;
  return !hopeless && !polygon.touches_square() &&
         polygon.squared_radius() <= cell.radius * cell.radius;
}

/// Whether an edge is that of a site without a cell.
template <class Real>
CGAL_POWER_RTF_HD inline bool touches_fixed(const Group_view<Real>& view,
                                            const Listed_polygon<Real>& polygon)
{
  for (int k = 0; k < polygon.size; ++k)
    if (view.caller[polygon.neighbor[k]] >= view.cells) return true;
  return false;
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_LANE_CELL_H
