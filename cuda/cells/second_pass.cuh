// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The second pass: cells that are guarded, empty, irregular or at a feature, one warp for each. The
// steps are those of `construct_cell()`, with the polygon's vertices in the lanes' registers: cells
// with more than 32 edges are incomplete.
#ifndef CGAL_POWER_RTF_CUDA_SECOND_PASS_CUH
#define CGAL_POWER_RTF_CUDA_SECOND_PASS_CUH

#include "cell_outputs.cuh"
#include "warp_search.cuh"

#include <CGAL/PowerRTF/cells/clip_at_features.h>

namespace CGAL {
namespace PowerRTF {
namespace device {

/// A convex polygon, counter-clockwise: lane k holds vertex k and the neighbour of edge k.
template <class Real>
struct Warp_polygon {
  Real x, y;
  int neighbor;
  int size;      // the same on all lanes, as what follows
  bool overflow; // more than 32 vertices

  __device__ void set_square(Real half, int lane)
  {
    size = 4;
    overflow = false;
    x = lane == 0 || lane == 1 ? half : -half;
    y = lane == 1 || lane == 2 ? half : -half;
    neighbor = -1 - lane;
  }

  __device__ Real squared_radius(int lane) const
  { return warp_max(lane < size ? x * x + y * y : Real(0)); }

  __device__ bool touches_square(int lane) const
  { return __any_sync(full_warp, lane < size && neighbor < 0); }

  /// Keeps a x + b y <= c; see `Tangent_polygon::clip()`.
  __device__ bool clip(Real a, Real b, Real c, int j, int lane)
  {
    const bool is_vertex = lane < size;
    const Real s = is_vertex ? fma(a, x, fma(b, y, -c)) : Real(0);
    const unsigned all = size == 32 ? full_warp : (1u << size) - 1;
    const unsigned outside = __ballot_sync(full_warp, s > 0), inside = ~outside & all;
    if (outside == 0) return false;
    if (inside == 0) {
      size = 0;
      return true;
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
      return false;
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
    const int carried = __shfl_sync(full_warp, neighbor, lane == kept + 1 ? end : from);
    const bool is_new = lane == kept || lane == kept + 1;
    const Real t = is_new ? sp / (sp - sq) : Real(0);
    x = is_new ? px + t * (qx - px) : px;
    y = is_new ? py + t * (qy - py) : py;
    neighbor = lane == kept ? j : carried;
    size = kept + 2;
    return true;
  }
};

/// The shared memory of a warp of the second pass.
template <class Real>
struct Second_memory {
  static constexpr int most_lines = 256;
  Search_stack stack;
  Real distance[most_lines], a[most_lines], b[most_lines], c[most_lines];
  int neighbor[most_lines];
  alignas(8) unsigned char result[sizeof(Tangent_polygon<Real>)];

  /// The result as the shared functors read it.
  __device__ Tangent_polygon<Real>& polygon()
  { return *reinterpret_cast<Tangent_polygon<Real>*>(result); }
};

/// The warp's counterpart of `Cell_clipper` and `construct_cell()`.
template <class Real>
class Warp_clipper {
public:
  __device__ Warp_clipper(const Group_view<Real>& view, Second_memory<Real>& memory, int place,
                          int lane)
      : m_view(view), m_memory(memory), m_place(place), m_lane(lane),
        m_site(load(view.sites + place)), m_own(load(view.normals + place)), m_frame(m_own.normal)
  {}

  const __device__ Tangent_frame<Real>& frame() const { return m_frame; }
  const __device__ Warp_polygon<Real>& polygon() const { return m_polygon; }

  /// `radius`: a guess; on return one from which the next construction may start. `guard`: the
  /// guard radius if it is known, else 0; on return it is known if it was needed.
  __device__ Cell_status construct(Real& radius, Real& guard)
  {
    if (guard > 0 && radius == guard && gather_all(guard * Real(1.41421357)))
      return construct_guarded(radius);
    const auto guard_radius = [&]() {
      if (!(guard > 0)) {
        Real first, sixth;
        distances(radius, Real(-2), 6, first, sixth);
        guard = m_view.guard_factor * sixth;
      }
      return guard;
    };
    for (;;) {
      clip(radius, radius, m_view.cos_angle);
      if (m_polygon.overflow) return Cell_status::incomplete;
      if (m_polygon.size > 0 && !m_polygon.touches_square(m_lane)) {
        const Real r2 = m_polygon.squared_radius(m_lane), f = m_view.guard_factor;
        if (r2 <= radius * radius) {
          if (r2 <= f * f * m_nearest2 || r2 <= guard_radius() * guard_radius()) {
            radius = std::sqrt(r2);
            return Cell_status::ok;
          }
          break;
        }
      }
      if (radius >= guard_radius()) { // R > guard radius, or nothing within it
        if (m_polygon.size > 0) break;
        if (guard > 0) radius = guard;
        return Cell_status::empty;
      }
      radius = 2 * radius < guard_radius() ? 2 * radius : guard_radius();
    }
    const Real half = guard_radius();
    if (half > 0) radius = half;
    clip(half * Real(1.41421357), half, Real(-2));
    return m_polygon.overflow ? Cell_status::incomplete
           : m_polygon.size == 0 ? Cell_status::empty : Cell_status::guarded;
  }

  /// Distances to the nearest and to the sixth site of the patch, compatible by `cos_angle`; see
  /// `distance_to_neighbor()`. `guess` > 0 is where the search begins; `wanted`: how many are
  /// needed.
  __device__ void distances(Real guess, Real cos_angle, int wanted, Real& first, Real& sixth)
  {
    constexpr Real infinity = Real(1e30);
    Group_query<Real> query;
    query.lo = query.hi = m_site.point;
    query.min_weight = m_site.weight;
    for (query.radius = guess;; query.radius *= 2) {
      Real nearest[6] = {infinity, infinity, infinity, infinity, infinity, infinity};
      int seen = 0;
      search_sites(m_view, m_memory.stack, query, m_lane,
                   [&](bool reached, const Packed_site<Real>& site, int place) {
                     seen += __popc(__ballot_sync(full_warp, reached));
                     if (!reached || place == m_place) return;
                     Real d2 = squared_length(site.point - m_site.point);
                     if (!(d2 < nearest[5])) return;
                     const Packed_normal<Real> normal = load(m_view.normals + place);
                     if (normal.patch != m_own.patch ||
                         (cos_angle > -1 && !(dot(normal.normal, m_own.normal) > cos_angle)))
                       return;
#pragma unroll
                     for (int k = 0; k < 6; ++k) {
                       const Real nearer = fmin(nearest[k], d2);
                       d2 = fmax(nearest[k], d2);
                       nearest[k] = nearer;
                     }
                   });
      Real last = 0, needed = infinity;
#pragma unroll
      for (int k = 0; k < 6; ++k) { // the least of all lanes, six times
        const Real least = warp_min(nearest[0]);
        const unsigned lanes = __ballot_sync(full_warp, nearest[0] == least);
        if (m_lane == __ffs(int(lanes)) - 1) {
#pragma unroll
          for (int l = 0; l < 5; ++l) nearest[l] = nearest[l + 1];
          nearest[5] = infinity;
        }
        if (least < infinity) last = least;
        if (k + 1 == wanted) needed = least;
        if (k == 0) first = std::sqrt(last);
      }
      sixth = std::sqrt(last);
      // Within the query's radius nothing is missed.
      if (needed <= query.radius * query.radius || seen == m_view.tree.items) return;
    }
  }

private:
  /// Construction where the last one ended at the guard radius, from the gathered lines.
  __device__ Cell_status construct_guarded(Real& guard)
  {
    m_polygon.set_square(guard, m_lane);
    clip_lines(true);
    if (m_polygon.overflow) return Cell_status::incomplete;
    if (m_polygon.size == 0) return Cell_status::empty;
    const Real r2 = m_polygon.squared_radius(m_lane);
    if (r2 <= guard * guard && !m_polygon.touches_square(m_lane)) {
      guard = std::sqrt(r2);
      return Cell_status::ok;
    }
    m_polygon.set_square(guard, m_lane);
    clip_lines(false);
    return m_polygon.overflow ? Cell_status::incomplete
           : m_polygon.size == 0 ? Cell_status::empty : Cell_status::guarded;
  }

  /// Gathers the lines of all sites that can cut a cell of the given radius, compatible or not.
  /// Returns false where that is not simple.
  __device__ bool gather_all(Real radius)
  {
    bool is_simple = true;
    m_lines = 0;
    Group_query<Real> query;
    query.lo = query.hi = m_site.point;
    query.radius = radius;
    query.min_weight = m_site.weight;
    search_sites(m_view, m_memory.stack, query, m_lane,
                 [&](bool reached, const Packed_site<Real>& site, int place) {
                   if (is_simple)
                     is_simple = add_any(reached && place != m_place, site, place, radius);
                 });
    __syncwarp();
    return is_simple;
  }

  __device__ bool add_any(bool offered, const Packed_site<Real>& other, int place, Real radius)
  {
    const Vec3<Real> offset = other.point - m_site.point;
    const Real d2 = squared_length(offset), power = d2 + (m_site.weight - other.weight);
    const Real a = dot(offset, m_frame.u), b = dot(offset, m_frame.v), t2 = a * a + b * b;
    offered = offered && !(power > 0 && power * power > 4 * d2 * radius * radius);
    bool is_compatible = false;
    if (offered) {
      const Packed_normal<Real> normal = load(m_view.normals + place);
      offered = normal.patch == m_own.patch;
      is_compatible =
          !(m_view.cos_angle > -1 && !(dot(m_own.normal, normal.normal) > m_view.cos_angle));
    }
    const unsigned lanes = __ballot_sync(full_warp, offered);
    if (m_lines + __popc(lanes) > Second_memory<Real>::most_lines ||
        __any_sync(full_warp, offered && !(t2 > 0)))
      return false;
    if (offered) {
      const int k = m_lines + __popc(lanes & ((1u << m_lane) - 1));
      m_memory.distance[k] = power / (2 * std::sqrt(t2));
      m_memory.a[k] = a;
      m_memory.b[k] = b;
      m_memory.c[k] = power / 2;
      m_memory.neighbor[k] = is_compatible ? place : -1 - place;
    }
    m_lines += __popc(lanes);
    return true;
  }

  /// Clips the square of half-size `half` by all sites that can cut a cell of the given radius.
  __device__ void clip(Real radius, Real half, Real cos_angle)
  {
    m_polygon.set_square(half, m_lane);
    m_nearest2 = Real(1e30);
    m_lines = 0;
    Group_query<Real> query;
    query.lo = query.hi = m_site.point;
    query.radius = radius;
    query.min_weight = m_site.weight;
    search_sites(m_view, m_memory.stack, query, m_lane,
                 [&](bool reached, const Packed_site<Real>& site, int place) {
                   add(reached && place != m_place, site, place, radius, cos_angle);
                 });
    flush();
    m_nearest2 = warp_min(m_nearest2);
  }

  __device__ void add(bool offered, const Packed_site<Real>& other, int place, Real radius,
                      Real cos_angle)
  {
    Real power = 0, a = 0, b = 0, t2 = 0;
    bool cuts_all = false;
    if (offered) {
      const Packed_normal<Real> normal = load(m_view.normals + place);
      const Vec3<Real> offset = other.point - m_site.point;
      const Real d2 = squared_length(offset);
      power = d2 + (m_site.weight - other.weight);
      offered = normal.patch == m_own.patch;
      if (offered) m_nearest2 = fmin(m_nearest2, d2);
      offered = offered && !(power > 0 && power * power > 4 * d2 * radius * radius) &&
                !(cos_angle > -1 && !(dot(m_own.normal, normal.normal) > cos_angle));
      if (offered) {
        a = dot(offset, m_frame.u);
        b = dot(offset, m_frame.v);
        t2 = a * a + b * b;
        if (!(t2 > 0)) { // parallel to the tangent plane, or a duplicate: the first one stays
          offered = false;
          cuts_all = power < 0 || (power == 0 && d2 == 0 &&
                                   m_view.caller[place] < m_view.caller[m_place]);
        }
      }
    }
    if (__any_sync(full_warp, cuts_all)) m_polygon.size = 0;
    const unsigned lanes = __ballot_sync(full_warp, offered);
    if (m_lines + __popc(lanes) > Second_memory<Real>::most_lines) flush();
    if (offered) {
      const int k = m_lines + __popc(lanes & ((1u << m_lane) - 1));
      m_memory.distance[k] = power / (2 * std::sqrt(t2));
      m_memory.a[k] = a;
      m_memory.b[k] = b;
      m_memory.c[k] = power / 2;
      m_memory.neighbor[k] = place;
    }
    m_lines += __popc(lanes);
  }

  /// Clips by the waiting lines and forgets them.
  __device__ void flush()
  {
    clip_lines(false);
    m_lines = 0;
    __syncwarp();
  }

  /// Clips by the waiting lines, or the compatible ones, by increasing distance from the site.
  __device__ void clip_lines(bool only_compatible)
  {
    constexpr Real infinity = Real(1e30);
    constexpr int per_lane = Second_memory<Real>::most_lines / 32;
    __syncwarp();
    Real distance[per_lane];
#pragma unroll
    for (int k = 0; k < per_lane; ++k) {
      const int line = k * 32 + m_lane;
      const bool counts = line < m_lines && !(only_compatible && m_memory.neighbor[line] < 0);
      distance[k] = counts ? m_memory.distance[line] : infinity;
    }
    Real radius2 = m_polygon.squared_radius(m_lane);
    for (int left = m_lines; left > 0 && m_polygon.size > 0; --left) {
      Real least = distance[0];
#pragma unroll
      for (int k = 1; k < per_lane; ++k) least = fmin(least, distance[k]);
      const Real d = warp_min(least);
      if (d == infinity || (d > 0 && d * d > radius2)) break;
      const int owner = __ffs(int(__ballot_sync(full_warp, least == d))) - 1;
      int line = -1;
#pragma unroll
      for (int k = 0; k < per_lane; ++k)
        if (m_lane == owner && line < 0 && distance[k] == d) {
          line = k * 32 + m_lane;
          distance[k] = infinity;
        }
      line = __shfl_sync(full_warp, line, owner);
      const int j = m_memory.neighbor[line];
      if (m_polygon.clip(m_memory.a[line], m_memory.b[line], m_memory.c[line], j < 0 ? -1 - j : j,
                         m_lane))
        radius2 = m_polygon.squared_radius(m_lane);
    }
  }

  const Group_view<Real>& m_view;
  Second_memory<Real>& m_memory;
  int m_place, m_lane;
  Packed_site<Real> m_site;
  Packed_normal<Real> m_own;
  Tangent_frame<Real> m_frame;
  Warp_polygon<Real> m_polygon;
  Real m_nearest2;
  int m_lines;
};

/// The links of the patches' boundaries, as places; null: no features.
struct Feature_links {
  const int *next = nullptr, *previous = nullptr;
};

template <class Real>
constexpr int second_warps = sizeof(Real) == 4 ? 4 : 2; // of a block: 48 KB of shared memory

/// Makes the cell of the site at `place` by all lanes together.
template <class Real>
__device__ inline void second_pass_cell(const Group_view<Real>& view,
                                        const Cell_targets<Real>& targets,
                                        const Feature_links& links, Second_memory<Real>& memory,
                                        int place, int lane)
{
  const int id = view.caller[place];
  Real radius = std::fabs(targets.radius[id]);
  Warp_clipper<Real> clipper(view, memory, place, lane);
  Real guard = targets.guard[place];
  const Cell_status status = clipper.construct(radius, guard);
  const Warp_polygon<Real>& polygon = clipper.polygon();
  __syncwarp();
  Tangent_polygon<Real>& result = memory.polygon();
  if (lane < polygon.size) {
    result.x[lane] = polygon.x;
    result.y[lane] = polygon.y;
    result.neighbor[lane] = polygon.neighbor;
  }
  __syncwarp();
  if (lane == 0) {
    result.size = polygon.size;
    result.overflow = polygon.overflow;
    targets.radius[id] = status == Cell_status::ok ? radius : -radius;
    targets.guard[place] = guard;
    if (targets.polygons.size) write_polygon(view, targets.polygons, id, result);
    if (view.has_features) {
      Sites_view<Real> sites;
      sites.sites = reinterpret_cast<const Site<Real>*>(view.sites);
      clip_at_features(sites, place, links.next, links.previous, clipper.frame(), result);
    }
    write_cell(view, targets.out, place, id, status, result, clipper.frame());
  }
  __syncwarp();
}

/// One warp per cell. `next_count`: the counter of the next construction, to be cleared.
template <class Real>
__global__ void __launch_bounds__(32 * second_warps<Real>)
second_pass_kernel(const __grid_constant__ Group_view<Real> view,
                   const __grid_constant__ Cell_targets<Real> targets,
                   const __grid_constant__ Feature_links links, int* next_count)
{
  __shared__ Second_memory<Real> memories[second_warps<Real>];
  if (blockIdx.x == 0 && threadIdx.x == 0) *next_count = 0;
  const int count = *targets.rest_count, warps = gridDim.x * second_warps<Real>;
  for (int k = blockIdx.x * second_warps<Real> + threadIdx.x / 32; k < count; k += warps)
    second_pass_cell(view, targets, links, memories[threadIdx.x / 32], targets.rest[k],
                     threadIdx.x % 32);
}

/// Distances of the cells' sites to their first and sixth neighbours, one warp each.
template <class Real>
__global__ void __launch_bounds__(32 * second_warps<Real>)
neighbor_distances_kernel(const __grid_constant__ Group_view<Real> view, Real cos_angle,
                          const Real* radius, Real* first, Real* sixth)
{
  __shared__ Second_memory<Real> memories[second_warps<Real>];
  const int lane = threadIdx.x % 32, place = (blockIdx.x * blockDim.x + threadIdx.x) / 32;
  if (place >= view.tree.items) return;
  const int id = view.caller[place];
  if (id >= view.cells) return;
  Warp_clipper<Real> clipper(view, memories[threadIdx.x / 32], place, lane);
  const Real last = std::fabs(radius[id]);
  Real d1, d6;
  clipper.distances(last > 0 ? 2 * last : Real(1), cos_angle, sixth ? 6 : 1, d1, d6);
  if (lane != 0) return;
  if (first) first[id] = d1;
  if (sixth) sixth[id] = d6;
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_SECOND_PASS_CUH
