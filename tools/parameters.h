// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The remesher's parameters as the program's options: the one list that the command line, --help
// and the JSON report are made from.
#ifndef POWER_RTF_TOOLS_PARAMETERS_H
#define POWER_RTF_TOOLS_PARAMETERS_H

#include <CGAL/PowerRTF/Remeshing_options.h>

#include <array>
#include <limits>
#include <string>
#include <utility>

namespace tools
{

/// The values of an enumeration and their names on the command line.
template <class E, std::size_t N>
using Names = std::array<std::pair<E, const char*>, N>;

// One overload per enumeration, found by the type of its unused argument.
inline auto names(CGAL::PowerRTF::Preset)
{
  using E = CGAL::PowerRTF::Preset;
  return Names<E, 2>{{{E::quality, "quality"}, {E::paper, "paper"}}};
}
inline auto names(CGAL::PowerRTF::Density)
{
  using E = CGAL::PowerRTF::Density;
  return Names<E, 2>{{{E::uniform, "uniform"}, {E::curvature, "curvature"}}};
}
inline auto names(CGAL::PowerRTF::Sampling)
{
  using E = CGAL::PowerRTF::Sampling;
  return Names<E, 2>{{{E::elimination, "elimination"}, {E::random, "random"}}};
}
inline auto names(CGAL::PowerRTF::Attributes)
{
  using E = CGAL::PowerRTF::Attributes;
  return Names<E, 2>{{{E::facet, "facet"}, {E::nearest_vertices, "nearest-vertices"}}};
}
inline auto names(CGAL::PowerRTF::Projection)
{
  using E = CGAL::PowerRTF::Projection;
  return Names<E, 2>{
      {{E::nearest_facet, "nearest-facet"}, {E::nearest_vertices, "nearest-vertices"}}};
}
inline auto names(CGAL::PowerRTF::Position_method)
{
  using E = CGAL::PowerRTF::Position_method;
  return Names<E, 2>{{{E::lbfgs, "lbfgs"}, {E::lloyd, "lloyd"}}};
}
inline auto names(CGAL::PowerRTF::Weight_method)
{
  using E = CGAL::PowerRTF::Weight_method;
  return Names<E, 3>{
      {{E::none, "none"}, {E::multiplicative, "multiplicative"}, {E::newton, "newton"}}};
}
inline auto names(CGAL::PowerRTF::Weight_operator)
{
  using E = CGAL::PowerRTF::Weight_operator;
  return Names<E, 2>{{{E::ceiling, "ceiling"}, {E::floor, "floor"}}};
}
inline auto names(CGAL::PowerRTF::Extraction_method)
{
  using E = CGAL::PowerRTF::Extraction_method;
  return Names<E, 2>{
      {{E::insertion, "insertion"}, {E::restricted_delaunay, "restricted-delaunay"}}};
}
inline auto names(CGAL::PowerRTF::Improvement)
{
  using E = CGAL::PowerRTF::Improvement;
  return Names<E, 2>{{{E::no, "no"}, {E::yes, "yes"}}};
}

inline auto names(CGAL::PowerRTF::Repair)
{
  using E = CGAL::PowerRTF::Repair;
  return Names<E, 2>{{{E::no, "no"}, {E::yes, "yes"}}};
}

template <class E>
std::string name_of(E value)
{
  for (const auto& [v, name] : names(value))
    if (v == value) return name;
  return {};
}

/// The values allowed for a number, both ends included.
struct Range {
  double lowest = 0, highest = std::numeric_limits<double>::max();
};

/// How a parameter is shown: option names (the first is the or the member's own, with
/// dashes; the second, hidden, is the other), group in --help, symbol in the paper, meaning.
struct Parameter {
  const char *name, *other_name, *group, *symbol, *help;
  Range range = {};
};

/// Calls `visit(parameter, member)` for every member of `Remeshing_options` but the preset, in the
/// order of --help; `member` is a pointer to member.
template <class Visitor>
void for_each_parameter(Visitor&& visit)
{
  using O = CGAL::PowerRTF::Remeshing_options;
  const double tiny = std::numeric_limits<double>::min(), most = std::numeric_limits<int>::max();
  const char* group = "Main";
  const auto add = [&](const char* name, auto member, const char* symbol, const char* help,
                       const Range& range = {}, const char* other_name = "") {
    visit(Parameter{name, other_name, group, symbol, help, range}, member);
  };
  // No range for n: what is too little or too much is said about the input, not the usage.
  add("samples,n", &O::number_of_samples, "n", "samples: the vertices of the output", {},
      "number-of-samples");
  add("density", &O::density, "rho", "even samples, or more of them where the surface is curved");
  add("seed", &O::random_seed, "", "seed of all random choices", {0, 4294967295.}, "random-seed");
  add("features", &O::feature_angle, "",
      "degrees: sharper edges are kept as creases where they make clean curves; 180: none",
      {tiny, 180}, "feature-angle");
  add("repair", &O::repair, "",
      "input that is no 2-manifold is made one, its shape kept; no: it is refused");

  group = "Density (Section 4.3)";
  add("density-power", &O::density_power, "p", "rho = kappa^p: 1, 2, 3 are the paper's f, f^2, f^3",
      {0, 100});
  add("gradation", &O::gradation, "", "largest growth of the spacing per unit of length; 0: any");

  group = "Initial sampling (Section 4.3)";
  add("sampling", &O::sampling, "", "weighted sample elimination, or the paper's random choice");
  add("oversampling", &O::oversampling, "m", "candidates per sample", {1, 1000});
  add("relaxation-iterations", &O::relaxation_iterations, "",
      "first steps, by Lloyd's method without weights", {0, most});

  group = "Normals and density of a sample (Section 4.1)";
  add("attributes", &O::attributes, "", "from its facet, or means over the nearest vertices");
  add("normal-neighbors", &O::normal_neighbors, "k_n", "vertices averaged for a normal", {1, most});
  add("density-neighbors", &O::density_neighbors, "k_d", "vertices averaged for a density",
      {1, most});
  add("normal-smoothing", &O::normal_smoothing, "",
      "normals are smoothed over this many times the local spacing; 0: not at all", {0, 100});

  group = "Cells (Algorithm 1)";
  add("neighbors", &O::neighbors, "k", "samples in the first neighbour search", {1, most});
  add("normal-angle", &O::normal_angle, "Theta",
      "degrees: a larger angle between their normals parts two samples", {tiny, 180});
  add("guard-factor", &O::guard_factor, "",
      "cells reaching this many distances to the 6th neighbour take all neighbours", {tiny, 1000});
  add("certified-combinatorics", &O::certified_combinatorics, "",
      "cpu: the cells' neighbours are those of --traits exact");

  group = "Positions (Algorithm 3)";
  add("position-method", &O::position_method, "", "how samples move to their cells' centroids");
  add("iterations", &O::max_iterations, "N_m", "position steps at most", {0, most},
      "max-iterations");
  add("lbfgs-memory", &O::lbfgs_memory, "", "pairs kept by L-BFGS", {1, 1000});
  add("projection", &O::projection, "",
      "onto the nearest facet, or on those at the nearest vertices");
  add("projection-neighbors", &O::projection_neighbors, "", "vertices whose facets are tried",
      {1, most});
  add("centroid-density-power", &O::centroid_density_power, "",
      "centroids are weighted by rho to this power", {0, 100});

  group = "Weights (Algorithm 2)";
  add("weight-method", &O::weight_method, "", "none (RTF), the paper's rule, or Newton's method");
  add("capacity-tolerance", &O::capacity_tolerance, "gamma",
      "half-width of the capacity interval; 0: CCCPD", {0, 1});
  add("max-weight-iterations", &O::max_weight_iterations, "N_m^w",
      "weight steps at most per position step", {0, most});
  add("weight-step", &O::weight_step, "tau",
      "step of the paper's rule: Delta s = tau gamma D_i / 4", {tiny, 1000});
  add("weight-operator", &O::weight_operator, "alpha",
      "rounding in the paper's rule; floor: as printed");

  group = "Extraction";
  add("extraction", &O::extraction, "", "how the triangles are made", {}, "extraction-method");
  add("improvement", &O::improvement, "",
      "rounder triangles, nearer to the surface; no: triangles on the samples");

  group = "GPU";
  add("device", &O::device, "", "the number of the GPU, with --traits cuda", {0, most});
}

} // namespace tools

#endif // POWER_RTF_TOOLS_PARAMETERS_H
