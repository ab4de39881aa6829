// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 1 on the GPU: all cells of the current samples, each with the proof of the shared
// construction that no sample was missed. The same input gives the same output bit for bit.
#ifndef CGAL_POWER_RTF_CUDA_CELL_BUILDER_H
#define CGAL_POWER_RTF_CUDA_CELL_BUILDER_H

#include "../device/Cuda_backend.h"
#include "Kept_lists.h"
#include "Large_pass_state.h"
#include "Weight_pass_state.h"
#include "cell_arrays.h"

#include <CGAL/PowerRTF/optimization/multiplicative_weights.h>

namespace CGAL {
namespace PowerRTF {
namespace device {

template <class Real>
struct Cell_targets;

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

  /// Sorts the sites and makes their tree. The arrays need not outlive the call's work.
  void set_sites(const Sites_arrays<Real>& arrays);
  /// The same sites with new weights.
  void set_weights(const Sites_arrays<Real>& arrays);

  /// Constructs the cells of the current sites.
  void build(const Cell_outputs<Real>& out);

  /// Up to `passes` passes of the paper's rule over the weights, each with the cells of the last
  /// one (Algorithm 2, lines 3 to 10), until all masses `density` * area are inside `rule`'s
  /// interval; then constructs the cells, as `build()`. `first`, `sixth`: see
  /// `neighbor_distances()`, compatible. Writes the weights to `arrays.sites`; without features
  /// their mean is 0. Waits for the device. Returns the number of passes, each of which is a
  /// construction.
  int paper_weight_passes(const Sites_arrays<Real>& arrays, Site<Real>* sites, const Real* density,
                          const Real* first, const Real* sixth,
                          const Multiplicative_weight_rule& rule, int passes,
                          const Cell_outputs<Real>& out);

  /// The same without waiting, where each site finds a warp; returns false where not, and does
  /// nothing. `first` and `sixth` may both be null: they are found on the way. `arrays` must live
  /// until the next sites or weights are set.
  bool start_weight_passes(const Sites_arrays<Real>& arrays, Site<Real>* sites, const Real* density,
                           const Real* first, const Real* sixth,
                           const Multiplicative_weight_rule& rule, int passes,
                           const Cell_outputs<Real>& out);
  /// What the passes started last have come to, on the device.
  const Weight_pass_state* weight_pass_state() const { return m_pass_state.data(); }

  /// Distances of the cells' sites to the first and to the sixth nearest site, `compatible` or of
  /// all; see `distance_to_neighbor()`. Null: not wanted.
  void neighbor_distances(bool compatible, Real* first, Real* sixth);

  /// The cells [begin, end) in full. Vertex and edge k < 64 of cell i: at [(i - begin) * 64 + k];
  /// x and y in its `Tangent_frame`; neighbours below 0 are sides of the guard square.
  void polygons(int begin, int end, int* size, Real* x, Real* y, int* neighbor,
                unsigned char* status);

  /// Device memory held.
  std::size_t bytes() const { return m_bytes; }

private:
  template <class T>
  using Buffer = Cuda_backend::Buffer<T>;

  void take(const Sites_arrays<Real>& arrays, bool positions);
  Group_view<Real> view() const;
  Kept_lists<Real> lists();
  void construct(Cell_targets<Real>& targets, bool keep_lists = false);
  void construct_by_warps(Cell_targets<Real>& targets);
  /// Sites: so few that a warp for each takes less time than one for 32 of them.
  int most_by_warps() const { return 128 * m_backend.multiprocessors(); }
  void link_features(const Sites_arrays<Real>& arrays);
  int list_weight_passes(const Sites_arrays<Real>& arrays, Site<Real>* sites, const Real* density,
                         const Real* first, const Real* sixth,
                         const Multiplicative_weight_rule& rule, int passes,
                         const Cell_outputs<Real>& out);
  int large_weight_passes(const Sites_arrays<Real>& arrays, Site<Real>* sites, const Real* density,
                          const Real* first, const Real* sixth,
                          const Multiplicative_weight_rule& rule, int passes,
                          const Cell_outputs<Real>& out);

  Cuda_backend& m_backend;
  std::size_t m_bytes = 0;
  Real m_cos_angle, m_guard_factor;
  int m_cells = 0, m_sites = 0;
  bool m_has_features = false;
  Sites_arrays<Real> m_arrays;    // of the last call
  bool m_are_weights_old = false; // they are in `m_arrays` only
  unsigned m_settings = 0;     // calls of set_sites() for these sites
  List_use m_list_use = List_use::none;
  bool m_has_lists = false;    // of the current positions, for several weights
  bool m_are_lists_in_order = false; // they name places of the current order
  bool m_are_lists_current = false;  // no search is needed
  unsigned m_list_age = 0;     // calls of set_weights() since they were made
  unsigned m_constructions = 0, m_list_constructions = 0;

  Buffer<int> m_order; // place -> the caller's index
  Buffer<Packed_site<Real>> m_packed;
  Buffer<Packed_normal<Real>> m_packed_normals;
  Buffer<Real> m_density_root;
  Buffer<Group_node<Real>> m_nodes;
  Buffer<Real> m_radius;       // the caller's order
  Buffer<Real> m_guard;        // guard radii by place; 0: not known
  Buffer<int> m_rest;          // cells for the second pass
  Buffer<int> m_rest_counts;   // 2, used in turn
  Buffer<unsigned> m_tickets;  // 2
  Buffer<int> m_list_neighbors; // see `Kept_lists`
  Buffer<unsigned short> m_list_sizes;
  Buffer<Real> m_list_radius, m_list_outside, m_group_radius;
  Buffer<int> m_groups, m_group_sizes;
  Buffer<Real> m_list_weights, m_growth, m_all_growth;
  Buffer<int> m_open_groups, m_open_counts; // see `Open_groups`
  Buffer<unsigned> m_open_lanes;
  Buffer<Real> m_area;         // paper_weight_passes() only, as what follows
  Buffer<double> m_partials;
  Buffer<List_pass_state> m_list_state;
  Buffer<Weight_pass_state> m_pass_state;
  Buffer<Pass_record<Real>> m_pass_records;
  Buffer<Pass_counters<Real>> m_pass_counters;
  Buffer<Large_pass_state> m_large_state;
  Buffer<int> m_places, m_next, m_previous; // with features only
  Buffer<std::uint64_t> m_keys;
};

extern template class Cell_builder<float>;
extern template class Cell_builder<double>;

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_CELL_BUILDER_H
