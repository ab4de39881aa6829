// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgPowerRTFConcepts
\cgalConcept

Constructs the cells of an engine (Algorithm 1). Arrays are those of the engine's backend.

\cgalHasModelsBegin
\cgalHasModels{`CGAL::PowerRTF::Tree_cells<Real, Backend, Construction>`}
\cgalHasModels{`CGAL::PowerRTF::device::Cuda_cells<Real>`}
\cgalHasModelsEnd
*/
template <class Real, class Backend>
class PowerRTFCells {
public:
  /// For up to `max_sites` sites. `cos_angle`: the cosine of \f$\Theta\f$; -2: all sites are
  /// compatible. `radius`: the first guess of the cells' radii.
  PowerRTFCells(Backend& backend, int max_sites, Real cos_angle, Real radius,
                const CGAL::PowerRTF::Remeshing_options& options);

  /// The memory that it takes for so many sites, and `neighbors()` beside that; of a device.
  static std::size_t bytes(int max_sites, bool has_features);
  static std::size_t neighbors_bytes(int cells);

  /// New sites. The arrays must live until the next call.
  void set_sites(const CGAL::PowerRTF::Sites_arrays<Real>& sites);
  /// The same sites with new weights.
  void set_weights(const CGAL::PowerRTF::Sites_arrays<Real>& sites);

  /// Constructs all cells.
  void build(const CGAL::PowerRTF::Cell_outputs<Real>& outputs);

  /// Constructs all cells and makes up to `passes` passes of `rule` over the weights, which are
  /// written to `weighted_sites`, as `PowerRTFEngine::optimize_weights()`. Returns where the number
  /// of constructions will stand; null, and does nothing, where the engine shall do it.
  const int* start_weight_passes(const CGAL::PowerRTF::Sites_arrays<Real>& sites,
                                 CGAL::PowerRTF::Site<Real>* weighted_sites, const Real* density,
                                 const CGAL::PowerRTF::Multiplicative_weight_rule& rule, int passes,
                                 const CGAL::PowerRTF::Cell_outputs<Real>& outputs);

  /// Distances of each cell's site to the first and to the sixth nearest compatible site.
  void neighbor_distances(Real* first, Real* sixth);
  /// The same among all sites; those of cells that are not empty may be left as they are.
  void empty_cells_distances(const unsigned char* status, Real* first, Real* sixth);

  /// Calls `sink(i, status, polygon, frame)` on the host for all cells, possibly at the same time.
  /// `polygon` is a `Tangent_polygon` or has its members.
  template <class Sink>
  void for_each_cell(Sink&& sink);
  /// The neighbors of all cells.
  CGAL::PowerRTF::Neighbor_cycles neighbors();
};
