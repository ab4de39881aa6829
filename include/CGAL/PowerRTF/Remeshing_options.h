// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every parameter of the remesher: its symbol in the paper, its unit, its default.
#ifndef CGAL_POWER_RTF_REMESHING_OPTIONS_H
#define CGAL_POWER_RTF_REMESHING_OPTIONS_H

#include <cstddef>

namespace CGAL {
namespace PowerRTF {

enum class Preset { quality, paper };
enum class Density { uniform, curvature };             ///< rho = 1, or rho = kappa^p
enum class Sampling { elimination, random };           ///< how the first samples are chosen
enum class Attributes { facet, nearest_vertices };     ///< where a sample's normal and density come from
enum class Projection { nearest_facet, nearest_vertices };
enum class Position_method { lbfgs, lloyd };
enum class Weight_method { none, multiplicative, newton }; ///< none: RTF, the paper's rule, Newton
enum class Weight_operator { ceiling, floor };         ///< rounding of alpha; floor: as printed
enum class Extraction_method { insertion, restricted_delaunay };
enum class Improvement { no, yes };
enum class Repair { no, yes };
enum class Coordinates { double_precision, single_precision };

/// Parameters of `PowerRTF_remesher`. The defaults are those of the preset `quality`;
/// `paper_preset()` gives those of the paper. Lengths are relative, so no parameter depends on the
/// input's size or position. The ranges that values are allowed in stand in `option_table.h`.
struct Remeshing_options {
  Preset preset = Preset::quality;
  std::size_t number_of_samples = 3000; ///< n
  unsigned random_seed = 0;
  /// Of the input, where it is no oriented 2-manifold and can be made one without a change of its
  /// shape; no: such an input is refused.
  Repair repair = Repair::yes;

  /// Degrees: edges whose facets' normals differ by at least this are kept as creases where such
  /// edges make clean curves (`find_creases()`); 180: none. Creases named by the user go first.
  double feature_angle = 40;

  // Density (Section 4.3, "Initial Sampling")
  Density density = Density::curvature;
  double density_power = 1; ///< p of rho = kappa^p: 1, 2, 3 are f, f^2, f^3 (Figure 9)
  double gradation = 0.1;   ///< largest growth of the spacing per unit of length; 0: not limited

  // Initial sampling
  Sampling sampling = Sampling::elimination;
  double oversampling = 4;       ///< m: candidates per sample
  int relaxation_iterations = 10; ///< first iterations without weights, by Lloyd's method

  // Samples' attributes
  Attributes attributes = Attributes::facet;
  int normal_neighbors = 12;  ///< k_n: vertices averaged for a normal  (Attributes::nearest_vertices)
  int density_neighbors = 12; ///< k_d: vertices averaged for a density (Attributes::nearest_vertices)
  /// Normals are smoothed over this many times the local spacing (standard deviation); 0: not at all.
  double normal_smoothing = 0.7;

  // Cells (Algorithm 1)
  int neighbors = 32;        ///< k: samples in the first neighbour search; enlarged until complete
  double normal_angle = 140; ///< Theta, degrees: larger angles make two samples incompatible (NVISPC)
  /// Cells that reach farther than this many distances to the 6th neighbour are guarded: also the
  /// incompatible neighbours bound them (NVISPC drops true neighbours at sharp tips).
  double guard_factor = 3;
  /// Fast CPU engine: cells whose neighbours the floating-point filter cannot prove are constructed
  /// again by the oracle, so that all cells have the neighbours of the exact traits.
  bool certified_combinatorics = false;

  // Positions (Algorithm 3)
  Position_method position_method = Position_method::lbfgs;
  int max_iterations = 100; ///< N_m: position steps
  int lbfgs_memory = 5;     ///< pairs kept by L-BFGS
  Projection projection = Projection::nearest_facet;
  int projection_neighbors = 16; ///< vertices whose facets are tried (Projection::nearest_vertices)
  double centroid_density_power = 2; ///< centroids are weighted by rho to this power

  // Weights (Algorithm 2)
  Weight_method weight_method = Weight_method::newton;
  double capacity_tolerance = 0.04; ///< gamma: half-width of the capacity interval; 0: CCCPD
  int max_weight_iterations = 30;   ///< N_m^w
  double weight_step = 1;           ///< tau: Delta s = tau * gamma * D_i / 4
  Weight_operator weight_operator = Weight_operator::ceiling;

  int device = 0; ///< CUDA traits: the number of the GPU

  // Extraction
  Extraction_method extraction = Extraction_method::insertion;
  /// Of the triangles after the extraction (not in the paper); no: triangles on the samples.
  Improvement improvement = Improvement::yes;
  /// What will hold the result's coordinates: its guarantees are those of the rounded points.
  Coordinates coordinates = Coordinates::double_precision;

  /// The paper's own algorithms and parameter values (Section 5). Its initial drawing,
  /// `Sampling::random`, is "replaced by other curvature-adapted sampling methods", as it allows:
  /// a random start needs two to four times as many constructions.
  static Remeshing_options paper_preset()
  {
    Remeshing_options o;
    o.preset = Preset::paper;
    o.feature_angle = 180; // the paper has no creases
    o.gradation = 0.2; // not in the paper: without it the weights hardly converge
    o.oversampling = 2;
    o.attributes = Attributes::nearest_vertices;
    o.normal_smoothing = 0;
    o.normal_angle = 60;
    o.guard_factor = 1.5; // so small an angle drops many true neighbours
    o.position_method = Position_method::lloyd;
    o.projection = Projection::nearest_vertices;
    o.centroid_density_power = 0;
    o.weight_method = Weight_method::multiplicative;
    o.improvement = Improvement::no;
    return o;
  }
};

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_REMESHING_OPTIONS_H
