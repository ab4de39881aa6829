// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_json.h"

#include <cstdio>
#include <ostream>

namespace tools {
namespace {

using namespace CGAL::PowerRTF;

std::string number(double x, int digits)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, x);
  return text;
}

/// A length in the input's unit, of any magnitude.
std::string figure(double x)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.5g", x);
  return text;
}

std::string percent(double share) { return number(100 * share, 2) + " %"; }

void row(std::ostream& out, const std::string& name, const std::string& value,
         const std::string& of_input = {})
{
  char text[256];
  std::snprintf(text, sizeof(text), "  %-34s %14s %14s", name.c_str(), value.c_str(),
                of_input.c_str());
  std::string line = text;
  line.erase(line.find_last_not_of(' ') + 1);
  out << line << '\n';
}

template <class T>
void counts(std::ostream& out, const std::string& name, T value, T of_input)
{
  row(out, name, std::to_string(value), std::to_string(of_input));
}

void print_mesh(std::ostream& out, const Remeshing_report& r)
{
  const Topology_statistics &a = r.topology, &b = r.input_topology;
  row(out, "", "output", "input");
  counts(out, "vertices", a.vertices, b.vertices);
  counts(out, "triangles", a.faces, b.faces);
  counts(out, "Euler characteristic", a.euler_characteristic, b.euler_characteristic);
  counts(out, "components", a.components, b.components);
  counts(out, "borders", a.border_loops, b.border_loops);
  if (b.non_manifold_edges > 0) {
    counts(out, "sheets of the network", a.sheets, b.sheets);
    counts(out, "curves where they meet", a.junctions, b.junctions);
  }
  if (!r.symmetry.axis.empty()) {
    row(out, "plane of symmetry", r.symmetry.axis + " = " + figure(r.symmetry.at));
    row(out, "vertices on it", std::to_string(r.symmetry.vertices));
    row(out, "deviation from symmetry", "", figure(r.symmetry.deviation));
  }
  if (r.kept_faces > 0) row(out, "triangles kept around the region", std::to_string(r.kept_faces));
  if (r.changed_faces > 0) row(out, "triangles changed beside it", std::to_string(r.changed_faces));
  row(out, "self-intersections", std::to_string(r.self_intersections));
  if (r.feature_edges > 0)
    row(out, "creases and borders",
        std::to_string(r.feature_edges - r.lost_feature_edges) + " of " +
            std::to_string(r.feature_edges) + " edges kept");
  if (r.constrained_vertices > 0)
    row(out, "vertices that stay",
        std::to_string(r.constrained_vertices - r.lost_constrained_vertices) + " of " +
            std::to_string(r.constrained_vertices));
  const Quality_statistics& q = r.quality;
  row(out, "triangle quality, least", number(q.q_min, 4));
  row(out, "triangle quality, mean", number(q.q_avg, 4));
  row(out, "smallest angle, least", number(q.theta_min, 2));
  row(out, "smallest angle, mean", number(q.theta_min_avg, 2));
  row(out, "largest angle", number(q.theta_max, 2));
  row(out, "triangles with an angle below 30", percent(q.below_30));
  row(out, "triangles with an angle above 90", percent(q.above_90));
  if (r.thin.places > 0) {
    row(out, "too thin for the spacing: places", std::to_string(r.thin.places));
    row(out, "their share of the area", percent(r.thin.area_share));
    row(out, "least thickness", figure(r.thin.thickness));
    row(out, "samples that do with --thin refine", std::to_string(r.thin.samples));
  }
  row(out, "edge length, mean", figure(r.edge_length.mean));
  row(out, "edge length, median", figure(r.edge_length.median));
  row(out, "edge length, least", figure(r.edge_length.min));
  row(out, "edge length, largest", figure(r.edge_length.max));
  row(out, "", "% of diagonal", "absolute");
  const auto distance = [&](const std::string& name, double x) {
    row(out, "distance to the input, " + name, number(x, 4), figure(r.absolute(x)));
  };
  distance("RMS", r.distance.rms);
  distance("mean", r.distance.mean);
  distance("largest", r.distance.max);
  if (r.max_distance > 0) distance("at most", r.distance.bound);
}

void print_repairs(std::ostream& out, const Repair_counts& r)
{
  const auto repair = [&out](std::size_t count, const char* what) {
    if (count > 0) row(out, what, std::to_string(count));
  };
  repair(r.duplicate_vertices, "duplicate vertices merged");
  repair(r.inserted_vertices, "vertices inserted into edges");
  repair(r.unused_vertices, "unused vertices dropped");
  repair(r.degenerate_facets, "degenerate facets removed");
  repair(r.triangulated_polygons, "polygons triangulated");
  repair(r.duplicate_facets, "duplicate facets dropped");
  repair(r.reoriented_facets, "facets turned");
  repair(r.non_manifold_edges, "edges of touching sheets parted");
  repair(r.non_manifold_vertices, "vertices of touching sheets parted");
}

void print_cure(std::ostream& out, const Intersection_cure& c)
{
  if (c.resolved_pairs > 0)
    row(out, "intersecting pairs of facets cut", std::to_string(c.resolved_pairs));
  if (c.wrap_radius > 0) {
    row(out, "wrapped by a ball of radius", figure(c.wrap_radius));
    row(out, "at this distance from the input", figure(c.wrap_offset));
  }
}

std::string error(double x)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.1e", x);
  return text;
}

void print_check(std::ostream& out, const Check& check)
{
  const Cell_comparison& r = check.result;
  out << "  compared with the exact cells after " << check.iterations << " iterations\n";
  const auto count = [&out](const char* what, std::size_t n) { row(out, what, std::to_string(n)); };
  count("  cells with the same neighbors", r.equal_cycles);
  count("  certified and wrong", r.certified_wrong);
  count("  not certified, right", r.uncertified_right);
  count("  not certified, wrong", r.uncertified_wrong);
  count("  edges below rounding that differ", r.differing_edges);
  row(out, "  area error, 99 %, largest", error(r.area.p99), error(r.area.max));
  row(out, "  centroid error, 99 %, largest", error(r.centroid.p99), error(r.centroid.max));
}

} // namespace

void print_table(std::ostream& out, const Run& run)
{
  const Remeshing_report& r = run.report;
  const Program_options& o = run.options;
  out << o.input
      << (o.write_mesh ? " -> " + o.output : ": " + std::to_string(r.samples_asked) + " samples")
      << '\n';
  if (o.write_mesh) print_mesh(out, r);
  const std::string tolerance = number(100 * o.remeshing.capacity_tolerance, 1);
  row(out, "cells inside the mean capacity +-" + tolerance + " %",
      percent(r.capacity.inside_interval));
  if (r.capacity.left_out > 0)
    row(out, "left out of that: no weights suffice", std::to_string(r.capacity.left_out));
  row(out, "capacity, RMS deviation", percent(r.capacity.rms));
  if (r.cells.guarded > 0)
    row(out, "cells with too few neighbors", std::to_string(r.cells.guarded));
  if (r.cells.empty > 0) row(out, "empty cells", std::to_string(r.cells.empty));
  if (r.cells.incomplete > 0) row(out, "incomplete cells", std::to_string(r.cells.incomplete));
  print_repairs(out, r.repairs);
  print_cure(out, r.cure);
  for (const Check& check : run.checks) print_check(out, check);
  row(out, "constructions of all cells", std::to_string(r.constructions));
  row(out, "seconds", number(r.seconds.total, 2));
  if (!r.device.name.empty()) row(out, "seconds on " + r.device.name, number(r.device.seconds, 4));
  for (const auto& [name, file] :
       {std::pair{"cells", &o.cells_file}, std::pair{"samples", &o.samples_file},
        std::pair{"report", &o.report_file}})
    if (!file->empty()) out << "  " << name << ": " << *file << '\n';
}

} // namespace tools
