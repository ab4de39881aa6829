// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The neighbor search: for every cell, the list of the compatible sites that may cut it as long as
// it stays within a radius. A warp gathers for its 32 cells together.
#ifndef CGAL_POWER_RTF_CUDA_SEARCH_LISTS_CUH
#define CGAL_POWER_RTF_CUDA_SEARCH_LISTS_CUH

#include "group_cells.cuh"

namespace CGAL::PowerRTF::device {

/// Lists the groups that sites may come from which cut one of the cells of the lanes with `wants`.
template <class Real>
__device__ inline void
list_near_groups(const Group_view<Real>& view, const Verlet_lists<Real>& lists, Search_stack& stack,
                 const Lane_cell<Real>& cell, bool wants, int group, int lane)
{
  constexpr Real further = 2; // than the lists' radius
  const Real radius = further * warp_max(wants ? cell.radius : Real(0));
  int* const out = lists.groups + group * Verlet_lists<Real>::max_groups;
  int found = 0;
  for (unsigned lanes; (lanes = __ballot_sync(full_warp, wants)) != 0;) {
    const bool is_near = is_near_lane(cell, __ffs(int(lanes)) - 1);
    const Group_query<Real> query = query_of_lanes(cell, wants && is_near, radius);
    wants = wants && !is_near;
    search_groups(view, stack, query, lane, [&](bool reached, int k) {
      const unsigned reaching = __ballot_sync(full_warp, reached);
      const int at = found + __popc(reaching & ((1u << lane) - 1));
      if (reached && at < Verlet_lists<Real>::max_groups) out[at] = k;
      found += __popc(reaching);
    });
  }
  if (lane == 0) {
    lists.group_sizes[group] = found <= Verlet_lists<Real>::max_groups ? found : -1;
    lists.group_radius[group] = radius;
  }
}

/// The shared memory of a warp of the search.
template <class Real>
struct List_memory {
  static constexpr int max_candidates = 192, max_listed = 32;
  Packed_site<Real> sites[max_candidates];
  int places[max_candidates];
  unsigned char listed[max_listed * 32]; ///< numbers of candidates, one column per lane
  Search_stack stack;

  __device__ List_memory() {}
};

/// The former edges of a lane's cell, if all of them are still compatible.
template <class Real>
struct Former_edges {
  static constexpr int capacity = 8;
  int count = 0;
  int places[capacity];

  template <class Compatible>
  __device__ Former_edges(const Verlet_lists<Real>& lists, int place, bool known,
                          const Compatible& is_compatible)
  {
    const int sizes = known ? lists.sizes[place] : Verlet_lists<Real>::none;
    count = sizes == Verlet_lists<Real>::none || sizes >> 8 > capacity ? 0 : sizes >> 8;
    bool all = true;
#pragma unroll
    for (int k = 0; k < capacity; ++k)
      places[k] = k < count ? lists.neighbors[std::size_t(k) * lists.stride + place] : -1;
#pragma unroll
    for (int k = 0; k < capacity; ++k) all = all && (k >= count || is_compatible(places[k]));
    if (all) return;
    count = 0;
#pragma unroll
    for (int k = 0; k < capacity; ++k) places[k] = -1;
  }
  __device__ bool has(int place) const
  {
    bool found = false;
#pragma unroll
    for (int k = 0; k < capacity; ++k) found |= places[k] == place;
    return found;
  }
};

template <class Real>
constexpr int search_warps = 2; // of a block: it is there until the slower one is done

/// A warp's search for the lists of its 32 cells.
template <class Real>
class List_search {
  using Memory = List_memory<Real>;

public:
  /// `cell`: of the lane.
  __device__ List_search(const Group_view<Real>& view, const Verlet_lists<Real>& lists,
                         Memory& memory, Lane_cell<Real>& cell, int lane)
      : m_view(view), m_lists(lists), m_memory(memory), m_cell(cell),
        m_own(load(view.normals + cell.place)), m_lane(lane)
  {}

  /// Searches for the lanes with `wants`. `former`: see `search_lists_kernel`.
  __device__ void search(bool wants, bool former)
  {
    // Along the curve there are jumps, of any length: the lanes near the first one go first.
    for (unsigned lanes; (lanes = __ballot_sync(full_warp, wants)) != 0;) {
      const bool is_near = is_near_lane(m_cell, lowest_bit(lanes)), now = wants && is_near;
      wants = wants && !is_near;
      const auto compatible = [&](int j) { return is_compatible(j); };
      const Former_edges<Real> first(m_lists, m_cell.place, former && now, compatible);
      if (now) m_size = m_edges = first.count;
      int gathered = 0;
      const Real max_radius = warp_max(now ? m_cell.radius : Real(0));
      search_sites(m_view, m_memory.stack, query_of_lanes(m_cell, now, max_radius), m_lane,
                   [&](bool reached, const Packed_site<Real>& site, int j) {
                     const unsigned reaching = __ballot_sync(full_warp, reached);
                     if (gathered + __popc(reaching) > Memory::max_candidates) {
                       list(gathered, now, first);
                       gathered = 0;
                     }
                     const int k = gathered + __popc(reaching & ((1u << m_lane) - 1));
                     if (reached) {
                       m_memory.sites[k] = site;
                       m_memory.places[k] = j;
                     }
                     gathered += __popc(reaching);
                   });
      list(gathered, now, first);
    }
  }

  /// Entries found, which may be too many to list; and how many of them are former edges.
  __device__ int size() const { return m_size; }
  __device__ int edges() const { return m_edges; }

private:
  __device__ bool is_compatible(int j) const
  {
    const Packed_normal<Real> other = load(m_view.normals + j);
    return other.patch == m_own.patch &&
           are_compatible(m_own.normal, other.normal, m_view.cos_angle);
  }

  /// Lists those of the gathered sites that may cut the lane's cell, if it is searched for `now`.
  __device__ void list(int gathered, bool now, const Former_edges<Real>& first)
  {
    __syncwarp();
    unsigned char* const column = m_memory.listed + m_lane;
    const int before = m_cell.listed;
    if (now)
      m_cell.list(m_memory, gathered, m_view.guard_factor, 0, 1, [&](int number, int k) {
        if (number - before < Memory::max_listed)
          column[(number - before) * 32] = static_cast<unsigned char>(k);
      });
    const int listed = m_cell.listed - before;
    if (listed > Memory::max_listed) m_size = Verlet_lists<Real>::capacity + 1;
    for (int k = 0; k < listed && k < Memory::max_listed; ++k) {
      const int j = m_memory.places[column[k * 32]];
      if (first.has(j) || !is_compatible(j)) continue;
      if (m_size < Verlet_lists<Real>::capacity)
        m_lists.neighbors[std::size_t(m_size) * m_lists.stride + m_cell.place] = j;
      ++m_size;
    }
    __syncwarp();
  }

  const Group_view<Real>& m_view;
  const Verlet_lists<Real>& m_lists;
  Memory& m_memory;
  Lane_cell<Real>& m_cell;
  Packed_normal<Real> m_own;
  int m_lane, m_size = 0, m_edges = 0;
};

/// Lists for radii of `growth` times the last ones; one warp per 32 sites. `former`: the lists'
/// places are those of the present order. `groups`: also the groups near each group.
template <class Real>
__global__ void __launch_bounds__(32 * search_warps<Real>, sizeof(Real) == 4 ? 12 : 8)
    search_lists_kernel(const __grid_constant__ Group_view<Real> view,
                        const __grid_constant__ Verlet_lists<Real> lists, const Real* radius,
                        Real growth, bool former, bool groups)
{
  __shared__ List_memory<Real> memories[search_warps<Real>];
  List_memory<Real>& memory = memories[threadIdx.x / 32];
  const int lane = threadIdx.x % 32;
  const int place = blockIdx.x * blockDim.x + threadIdx.x, group = place / 32;
  if (group * 32 >= view.tree.items) return;
  const bool exists = place < view.tree.items;
  Lane_cell<Real> cell;
  cell.place = exists ? place : view.tree.items - 1;
  cell.site = load(view.sites + cell.place);
  const int id = view.caller[cell.place];
  const Real last_radius = exists && id < view.cells ? radius[id] : Real(-1);
  cell.radius = last_radius * growth;
  const bool wants = last_radius > 0; // else no list could be complete, or none is known

  List_search<Real> search(view, lists, memory, cell, lane);
  search.search(wants, former);
  if (groups) list_near_groups(view, lists, memory.stack, cell, wants, group, lane);
  if (!exists) return;
  const bool is_listed = wants && search.size() <= Verlet_lists<Real>::capacity && cell.near <= 6 &&
                         view.guard_factor >= 1;
  lists.sizes[place] = is_listed ? static_cast<unsigned short>(search.size() + 256 * search.edges())
                                 : Verlet_lists<Real>::none;
  lists.radius[place] = cell.radius;
  lists.outside[place] = std::fmin(cell.radius, std::sqrt(cell.outside2));
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_SEARCH_LISTS_CUH
