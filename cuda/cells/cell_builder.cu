// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cell_builder.h"

#include "Cell_builder_passes.h"
#include "clip_lists.cuh"
#include "search_lists.cuh"
#include "sort_sites.cuh"
#include "warp_cells.cuh"

#include <algorithm>

namespace CGAL::PowerRTF::device {

namespace {
// Calls of set_sites() between two sorts: samples move by less than a spacing, so that their order
// remains good for a while.
constexpr unsigned sort_every = 8;
} // namespace

template <class Real>
Cell_builder<Real>::Cell_builder(Cuda_backend& backend, int max_sites, Real cos_angle,
                                 Real guard_factor)
    : m_backend(backend), m_cos_angle(cos_angle), m_guard_factor(guard_factor)
{
  internal::allocate_listed(backend, *this, max_sites);
  backend.fill(m_open_counts.data(), 0, 2);
  backend.fill(m_deferred_counts.data(), 0, 2);
  backend.fill(m_ticket.data(), 0u, 1);
}

template <class Real>
Group_view<Real> Cell_builder<Real>::view() const
{
  Group_view<Real> v;
  v.sites = m_packed.data();
  v.normals = m_packed_normals.data();
  v.density_root = m_density_root.data();
  v.caller = m_order.data();
  v.nodes = m_nodes.data();
  v.tree = Group_layout(m_sites);
  v.cells = m_cells;
  v.has_features = m_has_features;
  v.cos_angle = m_cos_angle;
  v.guard_factor = m_guard_factor;
  return v;
}

template <class Real>
Verlet_lists<Real> Cell_builder<Real>::lists()
{
  Verlet_lists<Real> l;
  l.neighbors = m_list_neighbors.data();
  l.sizes = m_list_sizes.data();
  l.radius = m_list_radius.data();
  l.outside = m_list_outside.data();
  l.weights = m_list_weights.data();
  l.groups = m_groups.data();
  l.group_sizes = m_group_sizes.data();
  l.group_radius = m_group_radius.data();
  l.growth = m_growth.data();
  l.all_growth = m_all_growth.data();
  l.stride = m_sites;
  return l;
}

template <class Real>
void Cell_builder<Real>::gather_sites(const Sites_arrays<Real>& arrays, bool positions)
{
  if (m_sites == 0) return;
  if (!positions) m_backend.fill(m_all_growth.data(), Real(0), 1);
  gather_sites_kernel<<<blocks(m_sites, gather_threads), gather_threads, 0, m_backend.stream()>>>(
      arrays, positions, m_order.data(), m_packed.data(), m_packed_normals.data(),
      m_density_root.data(), m_nodes.data(), Group_layout(m_sites), lists(), are_lists_valid(),
      m_guard.data(), m_ticket.data());
  check(cudaGetLastError(), "sorting the sites");
  m_gathered_weights = m_stamps.weights;
}

template <class Real>
void Cell_builder<Real>::gather_new_weights()
{
  if (m_gathered_weights != m_stamps.weights) gather_sites(m_arrays, false);
}

template <class Real>
bool Cell_builder<Real>::are_lists_valid() const
{
  if (m_listed.positions != m_stamps.positions) return false;
  const unsigned changes = m_stamps.weights - m_listed.weights;
  // The first lists of positions are not made to outlive a change.
  return changes == 0 ||
         (m_listed.weights != m_first_weights && changes < Verlet_lists<Real>::max_changes);
}

template <class Real>
void Cell_builder<Real>::set_sites(const Sites_arrays<Real>& arrays)
{
  const bool others = arrays.sites_size != m_sites || arrays.cells != m_cells;
  m_sites = arrays.sites_size;
  m_cells = arrays.cells;
  m_has_features = arrays.next != nullptr;
  ++m_stamps.positions;
  m_first_weights = ++m_stamps.weights;
  if (others) m_backend.fill(m_radius.data(), Real(0), m_cells);
  if (others || m_stamps.positions - m_sorted_positions >= sort_every) sort(arrays);
  m_arrays = arrays;
  gather_sites(arrays, true);
}

template <class Real>
void Cell_builder<Real>::sort(const Sites_arrays<Real>& arrays)
{
  if (m_sites == 0) return;
  find_hilbert_keys(m_backend, m_sites, arrays.sites, m_keys.data());
  m_backend.sort_order(m_sites, m_keys.data(), m_order.data(), true);
  if (m_has_features) link_features(arrays);
  ++m_stamps.order;
  m_sorted_positions = m_stamps.positions;
}

template <class Real>
void Cell_builder<Real>::link_features(const Sites_arrays<Real>& arrays)
{
  internal::allocate_listed(m_backend, m_links, m_order.size());
  const int *const order = m_order.data(), *const places = m_links.places.data();
  invert_order(m_backend, m_sites, order, m_links.places.data());
  link_places(m_backend, m_sites, order, places, arrays.next, m_links.next.data());
  link_places(m_backend, m_sites, order, places, arrays.previous, m_links.previous.data());
}

template <class Real>
void Cell_builder<Real>::set_weights(const Sites_arrays<Real>& arrays)
{
  ++m_stamps.weights;
  m_arrays = arrays;
  gather_sites(arrays, false);
}

template <class Real>
void Cell_builder<Real>::construct(Cell_targets<Real>& targets)
{
  if (m_cells == 0) return;
  if (m_sites <= max_by_warps()) return construct_by_warps(targets);
  const unsigned turn = m_constructions++ % 2;
  targets.radius = m_radius.data();
  targets.guard = m_guard.data();
  targets.deferred = m_deferred.data();
  targets.deferred_count = m_deferred_counts.data() + turn;
  const Group_view<Real> v = view();
  const cudaStream_t stream = m_backend.stream();

  // Few cells: several lanes each.
  const int groups = blocks(m_sites, 32), processors = m_backend.multiprocessors();
  if (groups <= 8 * processors) {
    constexpr int lanes = 4, warps = group_warps<Real>;
    group_cells_kernel<Real, lanes>
        <<<blocks(groups * lanes, warps), 32 * warps, 0, stream>>>(v, targets);
  } else {
    constexpr int warps = group_warps<Real>;
    const int grid = blocks(groups, warps), threads = 32 * warps;
    const unsigned now = m_list_constructions++ % 2;
    const Open_groups open{m_open_groups.data(), m_open_lanes.data(), m_open_counts.data() + now,
                           m_open_counts.data() + (1 - now)};
    if (!are_lists_valid()) {
      // What a list should outlive: a step of the sites, or several changes of the weights.
      const int search_grid = blocks(groups, search_warps<Real>);
      search_lists_kernel<<<search_grid, 32 * search_warps<Real>, 0, stream>>>(
          v, lists(), m_radius.data(), Real(have_weights_changed() ? 1.4 : 1.15),
          m_listed.order == m_stamps.order, have_weights_changed());
      check(cudaGetLastError(), "searching neighbors");
      m_listed = m_stamps;
    }
    const bool have_grown = m_listed.weights != m_stamps.weights;
    const bool moments = targets.out.mass || targets.out.offset;
    const auto clip = have_grown ? moments ? clip_lists_kernel<Real, true, true>
                                           : clip_lists_kernel<Real, true, false>
                      : moments ? clip_lists_kernel<Real, false, true>
                                 : clip_lists_kernel<Real, false, false>;
    clip<<<grid, threads, 0, stream>>>(v, targets, lists(), open);
    open_groups_kernel<<<std::min(grid, 4 * processors), threads, 0, stream>>>(v, targets, open);
  }
  check(cudaGetLastError(), "constructing cells");
  const int grid = std::min(blocks(m_cells, cell_warps<Real>), 4 * processors);
  const Feature_links links{m_links.next.data(), m_links.previous.data()};
  deferred_cells_kernel<<<grid, 32 * cell_warps<Real>, 0, stream>>>(
      v, targets, links, m_deferred_counts.data() + (1 - turn));
  check(cudaGetLastError(), "constructing cells");
}

template <class Real>
void Cell_builder<Real>::construct_by_warps(Cell_targets<Real>& targets)
{
  targets.radius = m_radius.data();
  targets.guard = m_guard.data();
  const Feature_links links{m_links.next.data(), m_links.previous.data()};
  warp_cells_kernel<<<blocks(m_sites, cell_warps<Real>), 32 * cell_warps<Real>, 0,
                      m_backend.stream()>>>(view(), targets, links);
  check(cudaGetLastError(), "constructing cells");
}

template <class Real>
void Cell_builder<Real>::build(const Cell_outputs<Real>& out)
{
  gather_new_weights();
  Cell_targets<Real> targets;
  targets.out = out;
  construct(targets);
}

template <class Real>
void Cell_builder<Real>::polygons(int begin, int end, int* size, Real* x, Real* y, int* neighbor,
                                  unsigned char* status)
{
  gather_new_weights();
  Cell_targets<Real> targets;
  targets.out.status = status;
  targets.polygons = {begin, end, size, x, y, neighbor};
  construct(targets);
}

template <class Real>
void Cell_builder<Real>::neighbor_distances(bool compatible, Real* first, Real* sixth)
{
  if (m_cells == 0) return;
  neighbor_distances_kernel<<<blocks(m_sites, cell_warps<Real>), 32 * cell_warps<Real>, 0,
                              m_backend.stream()>>>(view(), compatible ? m_cos_angle : Real(-2),
                                                    m_radius.data(), first, sixth);
  check(cudaGetLastError(), "distances of sites");
}

template class Cell_builder<float>;
template class Cell_builder<double>;

} // namespace CGAL::PowerRTF::device
