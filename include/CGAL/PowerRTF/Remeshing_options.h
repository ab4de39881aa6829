// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every parameter of the remesher: its symbol in the paper, its unit, its default.
#ifndef CGAL_POWER_RTF_REMESHING_OPTIONS_H
#define CGAL_POWER_RTF_REMESHING_OPTIONS_H

#include <cmath>
#include <cstddef>

namespace CGAL::PowerRTF {

/// \addtogroup PkgPowerRTFOptions
/// @{

/// Of this package, or of the paper.
enum class Preset { quality, fast, paper };
/// \f$\rho = 1\f$, or \f$\rho = \kappa^p\f$.
enum class Density { uniform, curvature };
/// Parts thinner than the spacing. `refine`: the spacing follows the thickness there.
enum class Thin { keep, refine };
/// How the first samples are chosen.
enum class Sampling { lattice, stratified, elimination, random };
/// Where a sample's normal and density come from.
enum class Attributes { facet, nearest_vertices };
/// Where a sample that has moved goes back to the surface.
enum class Projection { nearest_facet, nearest_vertices };
/// How samples move to the centroids of their cells.
enum class Position_method { lbfgs, lloyd };
/// None (RTF), the paper's rule, or Newton's method.
enum class Weight_method { none, multiplicative, newton };
/// When the paper's rule ends the run: once it has brought all capacities inside the interval, or
/// once they are inside even after the samples have moved, which then are at rest.
enum class Weights_end { inside, rest };
/// Rounding of \f$\alpha\f$ in the paper's rule; `floor`: as printed.
enum class Weight_operator { ceiling, floor };
/// How the samples are triangulated.
enum class Extraction_method { cells, insertion, restricted_delaunay };
/// Of the triangles after the extraction (not in the paper).
enum class Improvement { no, yes };
/// Pairs of vertices of five and seven edges, where a row of triangles ends, in the improvement.
enum class Dislocations { keep, annihilate };
/// Of an input that is no oriented 2-manifold and can be made one without a change of its shape;
/// `no`: it is refused.
enum class Repair { no, yes };
/// Edges of more than two facets, and vertices where sheets touch. `keep`: they are in the result,
/// too, as curves and points where its sheets meet; `split`: the sheets are parted, if the facets
/// pair up; `refuse`: the input is refused.
enum class Non_manifold { keep, split, refuse };
/// Of the input with itself. `keep`: they stay, and then the result may have some, too. `resolve`:
/// facets are cut where they meet, and all sheets stay. `wrap`: the input is replaced by a closed
/// surface around it.
enum class Intersections { keep, resolve, wrap };
/// Of the result about a plane across an axis, which is looked for, or across that one.
enum class Symmetry { none, automatic, x, y, z };
/// Between a region that is remeshed and the rest, which stays. `keep`: its edges stay, too;
/// `remesh`: it gets vertices as far apart as those of the region, and the faces of the rest that
/// are beside it change with it.
enum class Region_border { keep, remesh };
/// Of the result's points.
enum class Coordinates { double_precision, single_precision };

/// Parameters of `PowerRTF_remesher`. The defaults are those of the preset `quality`;
/// `of()` gives those of another preset. Lengths are relative, so no parameter depends on the
/// input's size or position. Values out of range are refused, see `validate()`.
struct Remeshing_options {
  Preset preset = Preset::quality;      ///< whose values these are, for reports
  std::size_t number_of_samples = 3000; ///< \f$n\f$: the vertices of the output
  // Instead of n, at most one of:
  double vertex_share = 0;         ///< \f$n\f$ over the vertices of the input; 0: not asked for
  double edge_length = 0;          ///< median of the edges, in the input's unit; 0: not asked for
  double relative_edge_length = 0; ///< the same over the diagonal of the bounding box
  double size_factor = 0; ///< edge lengths over those of the sizing field; 0: not asked for
  /// Largest distance of input and output, both ways, in the input's unit; 0: not asked for. A
  /// guarantee, and a resolution for functions that look for one.
  double max_distance = 0;
  double relative_max_distance = 0; ///< the same over the diagonal of the bounding box
  // Guarantees that are asked for, about the angles of the triangles, in degrees:
  double min_angle = 0;        ///< none is smaller; 0: not asked for
  double max_angle = 180;      ///< none is larger; 180: not asked for
  unsigned random_seed = 0;    ///< of all random choices
  Repair repair = Repair::yes; ///< of the input
  /// Vertices within this distance of each other are joined, vertices within it of edges inserted
  /// into them, which closes cracks and T-junctions; in the input's unit. 0: vertices of a polygon
  /// soup at exactly the same place are one.
  double merge_distance = 0;
  Non_manifold non_manifold = Non_manifold::keep;    ///< where sheets of the input meet
  Intersections intersections = Intersections::keep; ///< of the input with itself
  /// `Intersections::wrap`: holes and gaps that are narrower than twice this are closed; in the
  /// input's unit. 0: as the spacing, from a hundredth to a twentieth of the diagonal of the
  /// bounding box.
  double wrap_radius = 0;

  /// The result is the same as its mirror image, vertex by vertex. The plane is that of the input's
  /// own symmetry, to which it has to come within half the spacing.
  Symmetry symmetry = Symmetry::none;
  Region_border region_border = Region_border::keep; ///< where a region of a mesh is remeshed

  /// Degrees: edges whose facets' normals differ by at least this are kept as creases where such
  /// edges make clean curves; 180: none. Creases named by the user go first.
  double feature_angle = 40;

  // Density (Section 4.3, "Initial Sampling")
  Density density = Density::curvature; ///< without one of the user's own
  double density_power =
      1; ///< \f$p\f$ of \f$\rho = \kappa^p\f$: 1, 2, 3 are \f$f, f^2, f^3\f$ (Figure 9)
  double gradation = 0.1; ///< largest growth of the spacing per unit of length; 0: not limited
  /// The density from the curvature is smoothed over this many times the local spacing (standard
  /// deviation), which leaves a lattice fewer places where its rows must end; 0: not at all.
  double density_smoothing = 3;
  Thin thin = Thin::keep; ///< parts too thin for the spacing, as fingers and the rims of plates

  // Bounds for the wanted edge lengths, in the input's unit; 0: none.
  double min_edge_length = 0;
  double max_edge_length = 0;

  // Initial sampling
  Sampling sampling = Sampling::lattice; ///< how the first samples are chosen
  double oversampling = 4;       ///< \f$m\f$: candidates per sample (`elimination`, `random`)
  int relaxation_iterations = 0; ///< first iterations without weights, by Lloyd's method

  // Samples' attributes
  Attributes attributes = Attributes::facet; ///< where normals and densities come from
  int normal_neighbors = 12;  ///< \f$k_n\f$: vertices averaged for a normal  (`nearest_vertices`)
  int density_neighbors = 12; ///< \f$k_d\f$: vertices averaged for a density (`nearest_vertices`)
  /// Normals are smoothed over this many times the local spacing (standard deviation); 0: not at
  /// all.
  double normal_smoothing = 0.7;

  // Cells (Algorithm 1)
  int neighbors = 32; ///< \f$k\f$: samples in the first neighbor search; enlarged until complete
  /// \f$\Theta\f$, degrees: larger angles make two samples incompatible (NVISPC).
  double normal_angle = 140;
  /// Cells that reach farther than this many distances to the 6th neighbor are guarded: also the
  /// incompatible neighbors bound them (NVISPC drops true neighbors at sharp tips).
  double guard_factor = 3;
  /// Fast CPU engine: cells whose neighbors the floating-point filter cannot prove are constructed
  /// again by the oracle, so that all cells have the neighbors of the exact traits.
  bool certified_combinatorics = false;

  // Positions (Algorithm 3)
  Position_method position_method = Position_method::lbfgs; ///< how samples move
  int max_iterations = 100;                                 ///< \f$N_m\f$: position steps at most
  /// Position steps end when the samples are as near as this to their cells' centroids, or come no
  /// nearer: RMS, in units of \f$h = \sqrt{\mathrm{area}/n}\f$; 0: they do not end before.
  double centroid_tolerance = 0.002;
  int lbfgs_memory = 5;                              ///< pairs kept by L-BFGS
  Projection projection = Projection::nearest_facet; ///< of moved samples
  int projection_neighbors = 16;     ///< vertices whose facets are tried (`nearest_vertices`)
  double centroid_density_power = 2; ///< centroids are weighted by \f$\rho\f$ to this power

  // Weights (Algorithm 2)
  Weight_method weight_method = Weight_method::newton; ///< how capacities are made equal
  double capacity_tolerance = 0.04; ///< \f$\gamma\f$: half-width of the capacity interval; 0: CCCPD
  int max_weight_iterations = 30;   ///< \f$N_m^w\f$: weight steps at most per position step
  double weight_step = 1;           ///< \f$\tau\f$ of \f$\Delta s = \tau \gamma D_i / 4\f$
  Weight_operator weight_operator = Weight_operator::ceiling; ///< rounding in the paper's rule
  Weights_end weights_end = Weights_end::inside; ///< when the paper's rule ends the run

  int device = 0; ///< CUDA traits: the number of the GPU

  // Extraction
  Extraction_method extraction = Extraction_method::cells; ///< of the triangles
  Improvement improvement = Improvement::yes; ///< of the triangles; `no`: they stay on the samples
  Dislocations dislocations = Dislocations::annihilate; ///< in the improvement
  /// What will hold the result's points: its guarantees are those of the rounded points.
  Coordinates coordinates = Coordinates::double_precision;

  /// The guarantees of the preset `quality` sooner: position steps end earlier, dislocations stay,
  /// and capacities, which the triangles do not depend on, are not made equal.
  static Remeshing_options fast_preset()
  {
    Remeshing_options o;
    o.preset = Preset::fast;
    o.centroid_tolerance = 0.05;
    o.weight_method = Weight_method::none;
    o.dislocations = Dislocations::keep;
    return o;
  }

  /// The paper's own algorithms and parameter values (Section 5), but for three that its own
  /// numbers speak against (benchmark/PowerRTF/Quality/readings.py): \f$\Theta\f$ is 100 degrees,
  /// not 60; 100 iterations without weights come first, not ten; \f$N_m\f$ is 200, not 100. Its
  /// initial drawing, `Sampling::random`, is "replaced by other curvature-adapted sampling
  /// methods", as it allows: a random start needs more constructions.
  static Remeshing_options paper_preset()
  {
    Remeshing_options o;
    o.preset = Preset::paper;
    o.feature_angle = 180; // the paper has no creases
    o.gradation = 0.2;     // not in the paper: without it the weights hardly converge
    o.density_smoothing = 0;
    o.sampling = Sampling::elimination;
    o.oversampling = 2;
    o.relaxation_iterations = 100;
    o.attributes = Attributes::nearest_vertices;
    o.normal_smoothing = 0;
    o.normal_angle = 100;
    o.position_method = Position_method::lloyd;
    o.projection = Projection::nearest_vertices;
    o.centroid_density_power = 0;
    o.centroid_tolerance = 0;
    o.max_iterations = 200;
    o.weight_method = Weight_method::multiplicative;
    o.extraction = Extraction_method::insertion;
    o.improvement = Improvement::no;
    return o;
  }

  /// The values of a preset.
  static Remeshing_options of(Preset preset)
  {
    return preset == Preset::paper  ? paper_preset()
           : preset == Preset::fast ? fast_preset()
                                    : Remeshing_options();
  }
};

/// @}

/// Whether the number of samples is found from the input.
inline bool is_number_of_samples_open(const Remeshing_options& options)
{
  return options.vertex_share > 0 || options.edge_length > 0 || options.relative_edge_length > 0 ||
         options.size_factor > 0;
}

/// Whether the number of samples is to be looked for.
inline bool is_distance_asked_for(const Remeshing_options& options)
{
  return options.max_distance > 0 || options.relative_max_distance > 0;
}

/// Cosine of the compatibility angle Theta (degrees); -2 when every pair is compatible. A number of
/// single precision, so that all engines have the same one.
inline double compatibility_cosine(double normal_angle)
{
  return normal_angle >= 180 ? -2 : float(std::cos(normal_angle * 3.14159265358979323846 / 180));
}

/// The largest values of options for which engines keep arrays of a fixed size.
constexpr int max_lbfgs_memory = 10, max_vertex_neighbors = 32;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_REMESHING_OPTIONS_H
