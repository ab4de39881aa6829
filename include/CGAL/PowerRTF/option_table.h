// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All parameters of the remesher in one table: name, symbol in the paper, meaning and allowed
// values. Options are validated by it; the program's command line, --help and report are made
// from it.
#ifndef CGAL_POWER_RTF_OPTION_TABLE_H
#define CGAL_POWER_RTF_OPTION_TABLE_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF {

/// \cond SKIP_IN_MANUAL

/// The names of the values of an enumeration, which count from 0.
using Value_names = std::vector<const char*>;

// One overload per enumeration, found by the type of its unused argument.
inline Value_names value_names(Preset) { return {"quality", "fast", "paper"}; }
inline Value_names value_names(Density) { return {"uniform", "curvature"}; }
inline Value_names value_names(Thin) { return {"keep", "refine"}; }
inline Value_names value_names(Sampling)
{
  return {"lattice", "stratified", "elimination", "random"};
}
inline Value_names value_names(Attributes) { return {"facet", "nearest-vertices"}; }
inline Value_names value_names(Projection) { return {"nearest-facet", "nearest-vertices"}; }
inline Value_names value_names(Position_method) { return {"lbfgs", "lloyd"}; }
inline Value_names value_names(Weight_method) { return {"none", "multiplicative", "newton"}; }
inline Value_names value_names(Weight_operator) { return {"ceiling", "floor"}; }
inline Value_names value_names(Weights_end) { return {"inside", "rest"}; }
inline Value_names value_names(Extraction_method)
{
  return {"cells", "insertion", "restricted-delaunay"};
}
inline Value_names value_names(Improvement) { return {"no", "yes"}; }
inline Value_names value_names(Dislocations) { return {"keep", "annihilate"}; }
inline Value_names value_names(Repair) { return {"no", "yes"}; }
inline Value_names value_names(Non_manifold) { return {"keep", "split", "refuse"}; }
inline Value_names value_names(Intersections) { return {"keep", "resolve", "wrap"}; }
inline Value_names value_names(Symmetry) { return {"none", "auto", "x", "y", "z"}; }
inline Value_names value_names(Region_border) { return {"keep", "remesh"}; }
inline Value_names value_names(Coordinates) { return {"double", "single"}; }

/// \endcond

/// \addtogroup PkgPowerRTFOptions
/// @{

/// The name of a value; empty when `value` is none of the enumeration's.
template <class E>
std::string name_of(E value)
{
  const Value_names names = value_names(value);
  const auto number = static_cast<std::size_t>(value);
  return number < names.size() ? names[number] : "";
}

/// The values allowed for a number, both ends included.
struct Option_range {
  double lowest, highest;

  /// The lowest of a range that excludes 0 and nothing above it.
  static constexpr double above_zero = std::numeric_limits<double>::min();
};

/// A row of the table.
struct Option {
  const char* group;  ///< heading of this and the following rows
  const char* name;   ///< of the member of `Remeshing_options`
  const char* symbol; ///< in the paper; empty: it has none
  const char* meaning;
  Option_range range; ///< of a number
};

/// Calls `visit(option, member)` for every member of `Remeshing_options` but the preset; `member`
/// is a pointer to member. (Long because it is the table, with a row for each.)
template <class Visitor>
void for_each_option(Visitor&& visit)
{
  using O = Remeshing_options;
  constexpr double above_zero = Option_range::above_zero;
  const Option_range no_number{0, 0}, share{0, 1}, angle{above_zero, 180}, power{0, 100},
      iterations{0, 1e6}, nearest_vertices{1, max_vertex_neighbors};
  const char* group = "Main";
  const auto add = [&](const char* name, auto member, const char* symbol, const char* meaning,
                       const Option_range& range) {
    visit(Option{group, name, symbol, meaning, range}, member);
  };
  // Halfedges are numbered by int: 6 n and those of the input.
  add("number_of_samples", &O::number_of_samples, "n", "samples: the vertices of the output",
      {4, 3e8});
  add("vertex_share", &O::vertex_share, "",
      "instead of samples: their number over that of the input's vertices; 0: not asked for",
      {0, 3e8});
  add("edge_length", &O::edge_length, "",
      "instead of samples: the edges' median length, in the input's unit; 0: not asked for",
      {0, 1e300});
  add("relative_edge_length", &O::relative_edge_length, "",
      "the same over the diagonal of the bounding box", {0, 1});
  add("size_factor", &O::size_factor, "",
      "instead of samples: edges of so many times the lengths of the sizing field; 0: not asked "
      "for",
      {0, 1e300});
  add("max_distance", &O::max_distance, "",
      "instead of samples: so many that no point of input or output is farther from the other than "
      "this, in the input's unit; 0: not asked for",
      {0, 1e300});
  add("relative_max_distance", &O::relative_max_distance, "",
      "that distance over the diagonal of the bounding box", {0, 1});
  add("min_angle", &O::min_angle, "",
      "degrees: a guarantee, no angle of a triangle is smaller; 0: not asked for", {0, 60});
  add("max_angle", &O::max_angle, "",
      "degrees: a guarantee, no angle of a triangle is larger; 180: not asked for", {60, 180});
  add("density", &O::density, "rho", "even samples, or more of them where the surface is curved",
      no_number);
  add("random_seed", &O::random_seed, "", "seed of all random choices",
      {0, std::numeric_limits<unsigned>::max()});
  add("feature_angle", &O::feature_angle, "",
      "degrees: sharper edges are kept as creases where they make clean curves; 180: none", angle);
  add("repair", &O::repair, "",
      "input that is no 2-manifold is made one, its shape kept; no: it is refused", no_number);
  add("merge_distance", &O::merge_distance, "",
      "vertices this near to each other or to edges are joined with them, in the input's unit; 0: "
      "vertices at the same place",
      {0, 1e300});
  add("non_manifold", &O::non_manifold, "",
      "edges of more than two facets, vertices where sheets touch: they are kept in the result, or "
      "the sheets are parted, or the input is refused",
      no_number);
  add("intersections", &O::intersections, "",
      "of the input with itself: they stay, facets are cut where they meet, or the input is "
      "replaced by a closed surface around it",
      no_number);
  add("wrap_radius", &O::wrap_radius, "",
      "wrap: closes holes and gaps narrower than twice this, in the input's unit; 0: as the "
      "spacing",
      {0, 1e300});
  add("symmetry", &O::symmetry, "",
      "the result is its own mirror image, exactly, about a plane across that axis, or the one "
      "that fits best; the input has to be, within half the spacing",
      no_number);
  add("region_border", &O::region_border, "",
      "of a region that is remeshed alone: its edges stay; or it has the region's spacing, and the "
      "faces beside it change with it",
      no_number);

  group = "Density (Section 4.3)";
  add("density_power", &O::density_power, "p", "rho = kappa^p: 1, 2, 3 are the paper's f, f^2, f^3",
      power);
  add("gradation", &O::gradation, "", "largest growth of the spacing per unit of length; 0: any",
      {0, 1000});
  add("density_smoothing", &O::density_smoothing, "",
      "curvature's density is smoothed over this many times the local spacing; 0: not at all",
      {0, 100});
  add("thin", &O::thin, "",
      "where fingers, rims of plates, grooves are too thin for the spacing: it stays, or follows "
      "the "
      "thickness",
      no_number);
  add("min_edge_length", &O::min_edge_length, "",
      "no edges shorter than about this are wanted, in the input's unit; 0: any", {0, 1e300});
  add("max_edge_length", &O::max_edge_length, "",
      "no edges longer than about this are wanted, in the input's unit; 0: any", {0, 1e300});

  group = "Initial sampling (Section 4.3)";
  add("sampling", &O::sampling, "",
      "a hexagonal lattice, random points of parts of equal mass, weighted sample elimination, or "
      "the paper's random choice",
      no_number);
  // The elimination's time and memory are proportional to n m^2.
  add("oversampling", &O::oversampling, "m", "candidates per sample (elimination, random)",
      {1, 32});
  add("relaxation_iterations", &O::relaxation_iterations, "",
      "first steps, by Lloyd's method without weights", iterations);

  group = "Normals and density of a sample (Section 4.1)";
  add("attributes", &O::attributes, "", "from its facet, or means over the nearest vertices",
      no_number);
  add("normal_neighbors", &O::normal_neighbors, "k_n", "vertices averaged for a normal",
      nearest_vertices);
  add("density_neighbors", &O::density_neighbors, "k_d", "vertices averaged for a density",
      nearest_vertices);
  add("normal_smoothing", &O::normal_smoothing, "",
      "normals are smoothed over this many times the local spacing; 0: not at all", {0, 100});

  group = "Cells (Algorithm 1)";
  add("neighbors", &O::neighbors, "k", "samples in the first neighbor search", {1, 1000});
  add("normal_angle", &O::normal_angle, "Theta",
      "degrees: a larger angle between their normals parts two samples", angle);
  add("guard_factor", &O::guard_factor, "",
      "cells reaching this many distances to the 6th neighbor take all neighbors", {1, 1000});
  add("certified_combinatorics", &O::certified_combinatorics, "",
      "CPU: the cells' neighbors are those of the exact traits", no_number);

  group = "Positions (Algorithm 3)";
  add("position_method", &O::position_method, "", "how samples move to their cells' centroids",
      no_number);
  add("max_iterations", &O::max_iterations, "N_m", "position steps at most", iterations);
  add("centroid_tolerance", &O::centroid_tolerance, "",
      "they end when the samples are as near as this to the centroids (rms, in h)", {0, 1});
  add("lbfgs_memory", &O::lbfgs_memory, "", "pairs kept by L-BFGS", {1, max_lbfgs_memory});
  add("projection", &O::projection, "",
      "onto the nearest facet, or on those at the nearest vertices", no_number);
  add("projection_neighbors", &O::projection_neighbors, "", "vertices whose facets are tried",
      nearest_vertices);
  add("centroid_density_power", &O::centroid_density_power, "",
      "centroids are weighted by rho to this power", power);

  group = "Weights (Algorithm 2)";
  add("weight_method", &O::weight_method, "", "none (RTF), the paper's rule, or Newton's method",
      no_number);
  add("capacity_tolerance", &O::capacity_tolerance, "gamma",
      "half-width of the capacity interval; 0: CCCPD", share);
  add("max_weight_iterations", &O::max_weight_iterations, "N_m^w",
      "weight steps at most per position step", iterations);
  add("weight_step", &O::weight_step, "tau",
      "step of the paper's rule: Delta s = tau gamma D_i / 4", {above_zero, 1000});
  add("weight_operator", &O::weight_operator, "alpha",
      "rounding in the paper's rule; floor: as printed", no_number);
  add("weights_end", &O::weights_end, "",
      "when the paper's rule ends the run: all capacities are inside the interval, or "
      "still are after the samples have moved",
      no_number);

  group = "Extraction";
  add("extraction", &O::extraction, "", "how the triangles are made", no_number);
  add("improvement", &O::improvement, "",
      "rounder triangles, nearer to the surface; no: triangles on the samples", no_number);
  add("dislocations", &O::dislocations, "",
      "where a row of triangles ends; annihilate: the improvement looks for pairs that cancel out",
      no_number);
  add("coordinates", &O::coordinates, "", "precision of what will hold the result's points",
      no_number);

  group = "GPU";
  add("device", &O::device, "", "the number of the GPU of the CUDA traits",
      {0, std::numeric_limits<int>::max()});
}

/// A value of an option as a user writes it.
template <class T>
std::string to_text(const T& value)
{
  if constexpr (std::is_enum<T>::value) {
    const std::string name = name_of(value);
    return name.empty() ? std::to_string(static_cast<int>(value)) : name;
  } else {
    std::ostringstream text;
    text.precision(10);
    text << value;
    return text.str();
  }
}

/// The names of all values: "uniform|curvature".
template <class E>
std::string choices(E)
{
  std::string text;
  for (const std::string name : value_names(E())) text += (text.empty() ? "" : "|") + name;
  return text;
}

/// "from 1 to 64"
inline std::string to_text(const Option_range& range)
{
  return (range.lowest == Option_range::above_zero ? "above 0, at most "
                                                   : "from " + to_text(range.lowest) + " to ") +
         to_text(range.highest);
}

/// What a value of type `T` has to be, for messages.
template <class T>
std::string allowed_values(const Option_range& range)
{
  if constexpr (std::is_enum<T>::value)
    return "one of " + choices(T());
  else
    return "a number " + to_text(range);
}

/// Whether an option may have that value; NaN is in no range.
template <class T>
bool is_allowed(const T& value, const Option_range& range)
{
  if constexpr (std::is_same<T, bool>::value)
    return true;
  else if constexpr (std::is_enum<T>::value)
    return !name_of(value).empty();
  else
    return double(value) >= range.lowest && double(value) <= range.highest;
}

/// Checks all options.
/// \returns `options`
/// \throws Invalid_input_error an option has a value that is not allowed; more than one resolution
///   is asked for instead of `number_of_samples`; a largest distance is asked for from a wrap; or
///   the samplings with candidates would have more
///   than 1e9, `number_of_samples` times `oversampling`; the message names the option, its value
///   and what is allowed
inline const Remeshing_options& validate(const Remeshing_options& options)
{
  for_each_option([&](const Option& option, auto member) {
    const auto& value = options.*member;
    if (!is_allowed(value, option.range))
      throw Invalid_input_error(std::string(option.name) + " is " + to_text(value) +
                                ", but must be " +
                                allowed_values<std::decay_t<decltype(value)>>(option.range));
  });
  const int resolutions = (options.vertex_share > 0) + (options.edge_length > 0) +
                          (options.relative_edge_length > 0) + (options.size_factor > 0) +
                          (options.max_distance > 0) + (options.relative_max_distance > 0);
  if (resolutions > 1)
    throw Invalid_input_error(
        "of vertex_share, edge_length, relative_edge_length, size_factor, max_distance and "
        "relative_max_distance only one may be above 0");
  if (options.max_edge_length > 0 && options.min_edge_length > options.max_edge_length)
    throw Invalid_input_error("min_edge_length is " + to_text(options.min_edge_length) +
                              ", but must be at most max_edge_length, " +
                              to_text(options.max_edge_length));
  if (options.intersections == Intersections::wrap &&
      (options.max_distance > 0 || options.relative_max_distance > 0))
    throw Invalid_input_error("max_distance cannot be kept where intersections is wrap: the wrap, "
                              "not the input, is remeshed");
  const bool has_candidates =
      options.sampling == Sampling::elimination || options.sampling == Sampling::random;
  constexpr double max_candidates = 1e9; // they are numbered by int
  const double n = static_cast<double>(options.number_of_samples);
  if (has_candidates && n * options.oversampling > max_candidates)
    throw Invalid_input_error("samples times oversampling are " +
                              to_text(n * options.oversampling) + ", but must be at most " +
                              to_text(max_candidates));
  return options;
}

/// @}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_OPTION_TABLE_H
