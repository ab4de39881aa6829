// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 1 on the GPU: all cells of the current samples, each with the proof of the shared
// construction that no sample was missed. The same input gives the same output bit for bit.
#ifndef CGAL_POWER_RTF_CUDA_CELL_BUILDER_H
#define CGAL_POWER_RTF_CUDA_CELL_BUILDER_H

#include "../backend/Cuda_backend.h"
#include "Verlet_lists.h"
#include "Weight_pass_state.h"

#include <CGAL/PowerRTF/cells/Cell_arrays.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/optimization/multiplicative_weights.h>

namespace CGAL::PowerRTF::device {

template <class Real>
struct Cell_targets;

/// How often something about the sites has changed. What is made from them notes the counts.
struct Site_stamps {
  unsigned order = 0, positions = 0, weights = 0;
};

/// Constructs cells on the backend's stream; all calls return before the work is done. Arrays are
/// in the caller's order, which should follow a space-filling curve: then memory is read in runs.
/// Coordinates lie in [-1, 1). Memory per site: 180 bytes with `float`, 241 with `double`; 12 more
/// with features; for the weight passes 4 or 8, where each site finds a warp 32 or 64.
///
/// \tparam Real `float` or `double`.
template <class Real>
class Cell_builder {
public:
  /// Takes the memory for `max_sites` sites once. `cos_angle`: cosine of Theta (-2: all sites are
  /// compatible). `guard_factor`: see `Sites_view`.
  /// \throws Cuda_error when the memory does not suffice
  Cell_builder(Cuda_backend& backend, int max_sites, Real cos_angle, Real guard_factor);

  /// But for those that only features and the weight passes need; see listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t sites)
  {
    using B = Cell_builder;
    const Group_layout tree(static_cast<int>(sites));
    const std::size_t groups = tree.nodes(0);
    f(&B::m_order, sites);
    f(&B::m_packed, sites);
    f(&B::m_packed_normals, sites);
    f(&B::m_nodes, tree.nodes());
    for (auto array : {&B::m_density_root, &B::m_radius, &B::m_guard}) f(array, sites);
    f(&B::m_deferred, sites);
    f(&B::m_deferred_counts, 2);
    f(&B::m_ticket, 1);
    f(&B::m_keys, sites);
    f(&B::m_list_neighbors, sites * Verlet_lists<Real>::capacity);
    f(&B::m_list_sizes, sites);
    for (auto array : {&B::m_list_radius, &B::m_list_outside, &B::m_list_weights}) f(array, sites);
    f(&B::m_groups, groups * Verlet_lists<Real>::max_groups);
    for (auto array : {&B::m_group_radius, &B::m_growth}) f(array, groups);
    for (auto array : {&B::m_group_sizes, &B::m_open_groups}) f(array, groups);
    f(&B::m_all_growth, 1);
    f(&B::m_open_lanes, groups);
    f(&B::m_open_counts, 2);
  }
  static std::size_t bytes(std::size_t sites, bool has_features)
  {
    return internal::bytes_of_listed<Cell_builder>(sites) +
           (has_features ? internal::bytes_of_listed<Links>(sites) : 0);
  }

  /// Sorts the sites and makes their tree. The arrays need not outlive the call's work.
  void set_sites(const Sites_arrays<Real>& arrays);
  /// The same sites with new weights.
  void set_weights(const Sites_arrays<Real>& arrays);

  /// Constructs the cells of the current sites.
  void build(const Cell_outputs<Real>& out);

  /// Starts passes of the paper's rule over the weights, each with the cells of the last one
  /// (Algorithm 2, lines 3 to 10), until all masses, density times area, are inside the rule's
  /// interval; then constructs the cells, as `build()`. All in one kernel, when each site finds a
  /// warp; else returns false and does nothing. Writes the weights to the input's sites; without
  /// features their mean is 0. Its arrays must live until the next sites or weights are set.
  bool start_weight_passes(const Weight_pass_input<Real>& in);
  /// The result of the passes started last, on the device.
  const Weight_pass_state* weight_pass_state() const { return m_pass_state.data(); }

  /// Distances of the cells' sites to the first and to the sixth nearest site, `compatible` or of
  /// all; see `distance_to_neighbor()`. Null: not wanted.
  void neighbor_distances(bool compatible, Real* first, Real* sixth);

  /// The cells [begin, end) in full. Vertex and edge k < 64 of cell i: at [(i - begin) * 64 + k];
  /// x and y, if wanted, in its `Tangent_frame`; neighbors below 0 are sides of the guard square.
  /// `status`: of all cells.
  void polygons(int begin, int end, int* size, Real* x, Real* y, int* neighbor,
                unsigned char* status);

private:
  template <class T>
  using Buffer = Cuda_backend::Buffer<T>;

  struct Links { // of features
    Buffer<int> places, next, previous;

    template <class F>
    static void for_each_array(F&& f, std::size_t sites)
    {
      for (auto array : {&Links::places, &Links::next, &Links::previous}) f(array, sites);
    }
  };

  void sort(const Sites_arrays<Real>& arrays);
  void gather_sites(const Sites_arrays<Real>& arrays, bool positions);
  /// Gathers the weights of `m_arrays` where they are newer.
  void gather_new_weights();
  /// Whether the lists serve for the current weights, with a proof for each cell.
  bool are_lists_valid() const;
  bool have_weights_changed() const { return m_stamps.weights != m_first_weights; }
  Group_view<Real> view() const;
  Verlet_lists<Real> lists();
  void construct(Cell_targets<Real>& targets);
  void construct_by_warps(Cell_targets<Real>& targets);
  /// Sites: so few that a warp for each takes less time than one for 32 of them.
  int max_by_warps() const { return 128 * m_backend.multiprocessors(); }
  void link_features(const Sites_arrays<Real>& arrays);
  Weight_pass_state* pass_state();

  Cuda_backend& m_backend;
  Real m_cos_angle, m_guard_factor;
  int m_cells = 0, m_sites = 0;
  bool m_has_features = false;
  Sites_arrays<Real> m_arrays;     // of the last call
  Site_stamps m_stamps;            // the caller's sites
  Site_stamps m_listed;            // those that the lists were made for
  unsigned m_first_weights = 0;    // when the positions were set
  unsigned m_gathered_weights = 0; // those of `m_packed`
  unsigned m_sorted_positions = 0;
  unsigned m_constructions = 0, m_list_constructions = 0;

  Buffer<int> m_order; // place -> the caller's index
  Buffer<Packed_site<Real>> m_packed;
  Buffer<Packed_normal<Real>> m_packed_normals;
  Buffer<Real> m_density_root;
  Buffer<Group_node<Real>> m_nodes;
  Buffer<Real> m_radius;         // the caller's order
  Buffer<Real> m_guard;          // guard radii by place; 0: not known
  Buffer<int> m_deferred;        // cells that warps make
  Buffer<int> m_deferred_counts; // 2, used in turn
  Buffer<unsigned> m_ticket;
  Buffer<int> m_list_neighbors; // see `Verlet_lists`
  Buffer<unsigned short> m_list_sizes;
  Buffer<Real> m_list_radius, m_list_outside, m_group_radius;
  Buffer<int> m_groups, m_group_sizes;
  Buffer<Real> m_list_weights, m_growth, m_all_growth;
  Buffer<int> m_open_groups, m_open_counts; // see `Open_groups`
  Buffer<unsigned> m_open_lanes;
  Buffer<double> m_partials; // of the weight passes, as what follows
  Buffer<Weight_pass_state> m_pass_state;
  Buffer<Pass_record<Real>> m_pass_records;
  Buffer<Pass_counters<Real>> m_pass_counters;
  Links m_links;
  Buffer<std::uint64_t> m_keys;
};

extern template class Cell_builder<float>;
extern template class Cell_builder<double>;

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_CELL_BUILDER_H
