// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a remeshing run did and what its result is worth.
#ifndef CGAL_POWER_RTF_REMESHING_REPORT_H
#define CGAL_POWER_RTF_REMESHING_REPORT_H

#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

namespace CGAL::PowerRTF {

/// \addtogroup PkgPowerRTFReport
/// @{

/// Counts of the cells by status, after one construction (Algorithm 1).
struct Cell_counts {
  std::size_t ok = 0;
  std::size_t guarded = 0;    ///< bounded by the guard square (NVISPC left too few neighbors)
  std::size_t empty = 0;      ///< the power cell does not meet the tangent plane
  std::size_t incomplete = 0; ///< not certified: more polygon vertices than a cell can hold
};

/// How equal the capacities \f$m_i = \rho_i A(F_i)\f$ are (Section 4.2). Where Newton's method has
/// made the weights, cells that no weights make equal to the others are left out, of the mean, too:
/// at tips that are narrower than the spacing, guarded cells, those outside .3 to 2.5 times the
/// mean and those that would vanish.
struct Capacity_statistics {
  std::size_t left_out = 0; ///< number of cells
  double mean = 0;          ///< \f$\bar m\f$, in the units of the unit box
  double least = 0;         ///< smallest \f$m_i\f$
  /// Share of cells with \f$|m_i - \bar m| \le \gamma \bar m\f$.
  double inside_interval = 0;
  double rms = 0;               ///< RMS of \f$m_i / \bar m - 1\f$
  double largest_deviation = 0; ///< largest \f$|m_i / \bar m - 1|\f$
};

/// Triangle quality (Khan et al. 2020; the columns of the paper's Tables 1 and 2).
struct Quality_statistics {
  double q_min = 0, q_avg = 0;             ///< of \f$Q_t = \frac{6}{\sqrt 3} \frac{A_t}{S_t E_t}\f$
  double theta_min = 0, theta_min_avg = 0; ///< degrees
  double theta_max = 0;                    ///< degrees, the largest angle
  double below_30 = 0, above_90 = 0;       ///< share of triangles with such an angle
};

/// Lengths of the edges, every one counted once.
struct Edge_length_statistics {
  double mean = 0, median = 0, min = 0, max = 0;
};

/// Combinatorics of a triangle mesh given as a soup of triangles.
struct Topology_statistics {
  std::size_t vertices = 0, edges = 0, faces = 0;
  std::size_t components = 0, border_edges = 0, border_loops = 0;
  std::size_t non_manifold_edges = 0, non_manifold_vertices = 0;
  long euler_characteristic = 0;
  bool oriented = true; ///< no edge is traversed twice in the same direction
  // Of a network, which has non-manifold edges:
  std::size_t sheets = 0;         ///< the parts that it falls into when it is cut along these edges
  long sheets_characteristic = 0; ///< Euler characteristic of the sheets, cut apart
  /// Their connected parts; those of edges with different numbers of facets count apart.
  std::size_t junctions = 0;
};

/// Two-sided distance between input and output, times 100 / bounding-box diagonal of the input.
struct Distance_statistics {
  double rms = 0, mean = 0;
  double max = 0;                 ///< over all vertices and many other points of both
  double farthest[3] = {0, 0, 0}; ///< the point of one of them where it is, in its coordinates
  /// An upper bound for all points of both, at most 1 % above the largest distance but where that
  /// would take too long; 0: not wanted.
  double bound = 0;
};

/// What was mended in the input before it was used.
struct Repair_counts {
  std::size_t duplicate_vertices = 0; ///< merged: at the same place, up to rounding at a border
  std::size_t inserted_vertices = 0;  ///< into edges that they were on: once for each
  std::size_t unused_vertices = 0;    ///< dropped
  std::size_t degenerate_facets = 0;  ///< without area: removed
  std::size_t triangulated_polygons = 0;
  std::size_t duplicate_facets = 0;      ///< dropped
  std::size_t reoriented_facets = 0;     ///< turned to agree with their neighbors
  std::size_t non_manifold_edges = 0;    ///< of more than two facets: parted into sheets
  std::size_t non_manifold_vertices = 0; ///< where sheets touched: copied, one for each sheet
};

/// What was done about the input's intersections with itself (`Remeshing_options::intersections`).
struct Intersection_cure {
  std::size_t resolved_pairs = 0; ///< `resolve`: pairs of facets that intersected
  double wrap_radius = 0; ///< `wrap`, in the input's unit: closes what is narrower than twice
  double wrap_offset = 0; ///< `wrap`, in the input's unit: how far from the input it lies
};

/// The plane that the result is symmetric about (`Remeshing_options::symmetry`).
struct Symmetry_report {
  std::string axis;            ///< across the plane: "x", "y" or "z"; empty: none was asked for
  double at = 0;               ///< its coordinate, in the input's
  double deviation = 0;        ///< of the input, in its unit: how far an image is from it at most
  std::size_t vertices = 0;    ///< of the result on the plane
  std::size_t lone_facets = 0; ///< of the result, whose mirror image is none of its facets
};

/// Where the surface is too thin for the spacing of the samples: nearer to its other side than 0.8
/// times that, around a finger, a plate's rim, a groove.
struct Thin_parts {
  std::size_t places = 0;         ///< that do not touch
  double area_share = 0;          ///< of the surface
  double thickness = 0;           ///< the least, in the input's unit
  double thinnest[3] = {0, 0, 0}; ///< the point where it is, in the input's coordinates
  /// That would do with `Thin::refine`: elsewhere they are as far apart as now.
  std::size_t samples = 0;
};

/// Times of the stages.
struct Stage_seconds {
  double load = 0, surface = 0, sampling = 0, optimization = 0, extraction = 0, improvement = 0,
         quality = 0, transfer = 0, write = 0, total = 0;
};

/// What ran the optimization, when it was no CPU.
struct Device_report {
  std::string name;      ///< of the GPU; empty: the CPU
  double seconds = 0;    ///< on the device, from the upload of the first samples to the last cells
  std::size_t bytes = 0; ///< the most that was held on the device at a time
};

/// One outer iteration (one pass of Algorithm 3's loop).
struct Iteration_report {
  std::size_t constructions = 0; ///< so far
  Cell_counts cells;
  Capacity_statistics capacity;
  double displacement =
      0; ///< RMS of \f$|s_i - c_i|\f$, in units of \f$h = \sqrt{\mathrm{area}/n}\f$
};

/// The result of `power_rtf_remeshing()` beside the mesh.
struct Remeshing_report {
  std::size_t samples_asked = 0; ///< \f$n\f$, less the vertices that a distance can spare
  double median_edge_length = 0; ///< asked for, in the input's unit of length; 0: none was
  double max_distance = 0;       ///< the same of the distance
  double min_angle = 0;          ///< asked for, in degrees; 0: none was
  double max_angle = 180;        ///< asked for, in degrees; 180: none was
  bool cancelled = false;        ///< the visitor stopped the run
  std::size_t constructions = 0; ///< of all cells, in all (Algorithm 1)
  std::size_t outer_iterations = 0;
  std::vector<Iteration_report> iterations;
  std::size_t feature_samples = 0; ///< that stay where they are: they have no cells
  /// `Sampling::lattice`: first samples where it does not fit, as in gaps and on small components.
  std::size_t off_lattice_samples = 0;
  /// Samples whose cells' triangles do not fit together or lie badly, so that they were made by
  /// insertion, on the host; all of them where that made all triangles.
  std::size_t mended_samples = 0;
  /// Vertices that the improvement has changed, or their edges, one place at a time, on the host:
  /// in sum before, between and after its sweeps over all vertices.
  std::size_t retouched_vertices = 0;
  Cell_counts cells;            ///< at the end
  Capacity_statistics capacity; ///< at the end
  Repair_counts repairs;
  Intersection_cure cure;
  /// With a symmetry, samples and cells, and what was done about them, are those of one half.
  Symmetry_report symmetry;
  Topology_statistics input_topology, topology;
  std::size_t self_intersections = 0;       ///< pairs of facets
  std::size_t input_self_intersections = 0; ///< counted only when the result has some
  std::size_t crease_edges = 0;             ///< of the input
  std::size_t feature_edges = 0;            ///< of the output's creases and borders
  std::size_t lost_feature_edges = 0;       ///< of those, how many the output's triangles lack
  /// Of the input, which the output is to have; and how many it lacks.
  std::size_t constrained_vertices = 0, lost_constrained_vertices = 0;
  Quality_statistics quality;
  /// None are looked for where all triangles have \f$Q_t \ge 0.6\f$ and no angle below 30 degrees.
  Thin_parts thin;
  Edge_length_statistics edge_length; ///< in the input's unit of length
  /// Of a region's surroundings, which stay as they are, and how many triangles beside its border
  /// are new (`Region_border::remesh`). The rest of the report is about the region.
  std::size_t kept_vertices = 0, kept_faces = 0, changed_faces = 0;
  double diagonal = 0; ///< of the input's bounding box, in the input's unit of length
  Distance_statistics distance;
  Stage_seconds seconds;
  Device_report device;

  /// A distance in % of the diagonal, in the input's unit of length.
  double absolute(double percent) const { return percent / 100 * diagonal; }

  /// Whether all facets of the surface face the way that the input's do there.
  bool faces_as_input() const { return repairs.reoriented_facets == 0 && cure.wrap_offset == 0; }

  /// The guarantees that the result misses, in words; empty: all are met.
  std::vector<std::string> missed_guarantees() const;
};

/// @}

inline std::vector<std::string> Remeshing_report::missed_guarantees() const
{
  std::vector<std::string> missed;
  const auto expect = [&missed](bool met, const std::string& text) {
    if (!met) missed.push_back(text);
  };
  const auto same = [&expect](auto is, auto asked, const std::string& what) {
    expect(is == asked, what + ": " + std::to_string(is) + " instead of " + std::to_string(asked));
  };
  expect(topology.vertices == samples_asked,
         "vertices: " + std::to_string(topology.vertices) + " instead of " +
             std::to_string(samples_asked) +
             (topology.vertices > samples_asked ? " (so many are needed for the topology)" : ""));
  if (input_topology.non_manifold_edges > 0) { // sheets meet there as they do in the input
    same(topology.sheets, input_topology.sheets, "sheets");
    same(topology.sheets_characteristic, input_topology.sheets_characteristic,
         "Euler characteristic of the sheets");
    same(topology.junctions, input_topology.junctions, "curves where sheets meet");
  } else {
    same(topology.non_manifold_edges, std::size_t(0), "non-manifold edges");
    same(topology.non_manifold_vertices, input_topology.non_manifold_vertices,
         "non-manifold vertices");
  }
  expect(topology.oriented || !input_topology.oriented, "the facets are not consistently oriented");
  same(topology.euler_characteristic, input_topology.euler_characteristic, "Euler characteristic");
  same(topology.components, input_topology.components, "components");
  same(topology.border_loops, input_topology.border_loops, "border loops");
  expect(self_intersections == 0,
         "self-intersecting pairs of facets: " + std::to_string(self_intersections) +
             " instead of 0" +
             (input_self_intersections > 0
                  ? " (the input has " + std::to_string(input_self_intersections) +
                        ": the option intersections is about them)"
                  : std::string()));
  same(lost_feature_edges, std::size_t(0), "lost edges of creases and borders");
  same(lost_constrained_vertices, std::size_t(0), "lost vertices that are to stay");
  same(symmetry.lone_facets, std::size_t(0), "facets without a mirror image");
  const auto bounded = [&expect](bool met, const char* what, double is, double asked) {
    std::ostringstream text;
    text << what << is << " instead of " << asked;
    expect(met, text.str());
  };
  const double bound = absolute(distance.bound);
  bounded(max_distance == 0 || bound <= max_distance, "largest distance: up to ", bound,
          max_distance);
  bounded(quality.theta_min >= min_angle, "smallest angle: ", quality.theta_min, min_angle);
  bounded(quality.theta_max <= max_angle, "largest angle: ", quality.theta_max, max_angle);
  return missed;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_REMESHING_REPORT_H
