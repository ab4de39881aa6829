// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report_json.h"

#include "option_names.h"

#include <nlohmann/json.hpp>

#include <ostream>
#include <type_traits>
#include <utility>

namespace tools {
namespace {

using Json = nlohmann::ordered_json;
using namespace CGAL::PowerRTF;

Json to_json(const Cell_counts& c)
{
  return {{"ok", c.ok}, {"guarded", c.guarded}, {"empty", c.empty}, {"incomplete", c.incomplete}};
}

Json to_json(const Stage_seconds& s)
{
  return {{"load", s.load},
          {"surface", s.surface},
          {"sampling", s.sampling},
          {"optimization", s.optimization},
          {"extraction", s.extraction},
          {"improvement", s.improvement},
          {"quality", s.quality},
          {"transfer", s.transfer},
          {"write", s.write},
          {"total", s.total}};
}

Json to_json(const Repair_counts& r)
{
  return {{"duplicate_vertices", r.duplicate_vertices},
          {"inserted_vertices", r.inserted_vertices},
          {"unused_vertices", r.unused_vertices},
          {"degenerate_facets", r.degenerate_facets},
          {"triangulated_polygons", r.triangulated_polygons},
          {"duplicate_facets", r.duplicate_facets},
          {"reoriented_facets", r.reoriented_facets},
          {"non_manifold_edges", r.non_manifold_edges},
          {"non_manifold_vertices", r.non_manifold_vertices}};
}

Json to_json(const Intersection_cure& c)
{
  return {{"resolved_pairs", c.resolved_pairs},
          {"wrap_radius", c.wrap_radius},
          {"wrap_offset", c.wrap_offset}};
}

Json to_json(const Symmetry_report& s)
{
  return {{"axis", s.axis},
          {"at", s.at},
          {"deviation", s.deviation},
          {"vertices", s.vertices},
          {"lone_facets", s.lone_facets}};
}

Json to_json(const Thin_parts& t)
{
  return {{"places", t.places},
          {"area_share", t.area_share},
          {"thickness", t.thickness},
          {"thinnest_point", t.thinnest},
          {"samples", t.samples}};
}

Json parameters(const Remeshing_options& o)
{
  Json json;
  for_each_option([&](const Option& option, auto member) {
    const std::string name = option_name(option);
    if constexpr (std::is_enum<std::decay_t<decltype(o.*member)>>::value)
      json[name] = to_text(o.*member);
    else
      json[name] = o.*member;
  });
  return json;
}

Json to_json(const Error_distribution& d)
{
  return {{"p50", d.p50}, {"p99", d.p99}, {"max", d.max}};
}

Json to_json(const Check& check)
{
  const Cell_comparison& r = check.result;
  return {{"after_iterations", check.iterations},
          {"cells", r.cells},
          {"equal_cycles", r.equal_cycles},
          {"certified_wrong", r.certified_wrong},
          {"uncertified_right", r.uncertified_right},
          {"uncertified_wrong", r.uncertified_wrong},
          {"differing_edges", r.differing_edges},
          {"worst_edge_over_bound", r.worst_edge},
          {"area_error", to_json(r.area)},
          {"centroid_error", to_json(r.centroid)},
          {"predicates_filtered", r.predicates.filtered},
          {"predicates_exact", r.predicates.exact}};
}

Json checks(const std::vector<Check>& list)
{
  Json json = Json::array();
  for (const Check& check : list) json.push_back(to_json(check));
  return json;
}

Json iterations(const Remeshing_report& report)
{
  Json json = Json::array();
  for (const Iteration_report& i : report.iterations)
    json.push_back({{"constructions", i.constructions},
                    {"inside_capacity_interval", i.capacity.inside_interval},
                    {"capacity_rms", i.capacity.rms},
                    {"displacement", i.displacement},
                    {"cells", to_json(i.cells)}});
  return json;
}

void add_mesh(Json& json, const Run& run)
{
  const Remeshing_report& r = run.report;
  json["vertices"] = r.topology.vertices;
  json["faces"] = r.topology.faces;
  json["euler_characteristic"] = r.topology.euler_characteristic;
  json["components"] = r.topology.components;
  json["border_edges"] = r.topology.border_edges;
  json["border_loops"] = r.topology.border_loops;
  json["non_manifold_edges"] = r.topology.non_manifold_edges;
  json["non_manifold_vertices"] = r.topology.non_manifold_vertices;
  json["oriented"] = r.topology.oriented;
  json["input_non_manifold_edges"] = r.input_topology.non_manifold_edges;
  json["input_non_manifold_vertices"] = r.input_topology.non_manifold_vertices;
  if (r.input_topology.non_manifold_edges > 0) {
    json["sheets"] = r.topology.sheets;
    json["junctions"] = r.topology.junctions;
    json["input_sheets"] = r.input_topology.sheets;
    json["input_junctions"] = r.input_topology.junctions;
  }
  if (r.kept_faces > 0 || r.changed_faces > 0) {
    json["kept_vertices"] = r.kept_vertices;
    json["kept_faces"] = r.kept_faces;
    json["changed_faces"] = r.changed_faces;
  }
  json["self_intersections"] = r.self_intersections;
  json["feature_samples"] = r.feature_samples;
  json["off_lattice_samples"] = r.off_lattice_samples;
  json["mended_samples"] = r.mended_samples;
  json["retouched_vertices"] = r.retouched_vertices;
  json["crease_edges"] = r.crease_edges;
  json["feature_edges"] = r.feature_edges;
  json["lost_feature_edges"] = r.lost_feature_edges;
  json["constrained_vertices"] = r.constrained_vertices;
  json["lost_constrained_vertices"] = r.lost_constrained_vertices;
  json["input_self_intersections"] = r.input_self_intersections;
  json["input_vertices"] = r.input_topology.vertices;
  json["input_faces"] = r.input_topology.faces;
  json["input_euler_characteristic"] = r.input_topology.euler_characteristic;
  json["input_components"] = r.input_topology.components;
  json["input_border_edges"] = r.input_topology.border_edges;
  json["input_border_loops"] = r.input_topology.border_loops;
  json["q_min"] = r.quality.q_min;
  json["q_avg"] = r.quality.q_avg;
  json["theta_min"] = r.quality.theta_min;
  json["theta_min_avg"] = r.quality.theta_min_avg;
  json["theta_max"] = r.quality.theta_max;
  json["below_30"] = r.quality.below_30;
  json["above_90"] = r.quality.above_90;
  json["thin_parts"] = to_json(r.thin);
  json["edge_length_mean"] = r.edge_length.mean;
  json["edge_length_median"] = r.edge_length.median;
  json["edge_length_min"] = r.edge_length.min;
  json["edge_length_max"] = r.edge_length.max;
  json["diagonal"] = r.diagonal;
  json["distance_rms"] = r.distance.rms;
  json["distance_mean"] = r.distance.mean;
  json["distance_max"] = r.distance.max;
  if (r.max_distance > 0) json["distance_bound"] = r.distance.bound;
  json["absolute_distance_rms"] = r.absolute(r.distance.rms);
  json["absolute_distance_mean"] = r.absolute(r.distance.mean);
  json["absolute_distance_max"] = r.absolute(r.distance.max);
  if (r.max_distance > 0) json["absolute_distance_bound"] = r.absolute(r.distance.bound);
  json["farthest_point"] = r.distance.farthest;
  json["not_carried_over"] = run.not_carried_over;
  json["missed_guarantees"] = run.missed;
}

/// What was asked for at places of the input; only what there is.
Json fields(const Program_options& o)
{
  Json json = Json::object();
  for (const auto& [name, value] :
       {std::pair{"size-field", &o.size_field}, std::pair{"density-field", &o.density_field},
        std::pair{"creases", &o.creases}, std::pair{"corners", &o.corners},
        std::pair{"labels", &o.labels}})
    if (!value->empty()) json[name] = *value;
  if (!o.region_name.empty()) json["region"] = o.region_name + "=" + o.region_value;
  if (!o.refine.empty()) json["refine"] = o.refine;
  if (o.keeps_lines) json["lines"] = true;
  if (o.keeps_points) json["points"] = true;
  if (o.keeps_texture) json["texture"] = true;
  return json;
}

Json to_json(const Run& run)
{
  const Remeshing_report& r = run.report;
  Json json;
  json["program"] = "power_rtf_remesh " POWER_RTF_VERSION;
  if (!run.options.input.empty()) json["input"] = run.options.input;
  if (!run.error.empty()) {
    json["error"] = run.error;
    return json;
  }
  if (run.options.write_mesh && !run.options.output.empty()) json["output"] = run.options.output;
  json["samples"] = r.samples_asked;
  json["traits"] = run.options.traits;
  if (!run.gpu_not_used.empty()) json["gpu_not_used"] = run.gpu_not_used;
  json["preset"] = to_text(run.options.remeshing.preset);
  json["seed"] = run.options.remeshing.random_seed;
  json["threads"] = run.threads;
  if (run.options.write_mesh) add_mesh(json, run);
  json["inside_capacity_interval"] = r.capacity.inside_interval;
  json["capacity_left_out"] = r.capacity.left_out;
  json["capacity_rms"] = r.capacity.rms;
  json["capacity_largest_deviation"] = r.capacity.largest_deviation;
  json["constructions"] = r.constructions;
  json["outer_iterations"] = r.outer_iterations;
  json["cells"] = to_json(r.cells);
  json["repairs"] = to_json(r.repairs);
  json["cure"] = to_json(r.cure);
  if (!r.symmetry.axis.empty()) json["symmetry"] = to_json(r.symmetry);
  json["seconds"] = to_json(r.seconds);
  if (!r.device.name.empty())
    json["device"] = {
        {"name", r.device.name}, {"seconds", r.device.seconds}, {"bytes", r.device.bytes}};
  if (run.options.check) json["checks"] = checks(run.checks);
  json["parameters"] = parameters(run.options.remeshing);
  const Json asked = fields(run.options);
  if (!asked.empty()) json["fields"] = asked;
  json["iterations"] = iterations(r);
  return json;
}

/// \param indent -1: all in one line
void write(std::ostream& out, const Json& json, int indent = 2)
{
  // a file's name need not be valid UTF-8
  out << json.dump(indent, ' ', false, Json::error_handler_t::replace) << '\n';
}

} // namespace

void write_json(std::ostream& out, const Run& run) { write(out, to_json(run)); }

void write_json_line(std::ostream& out, const Run& run) { write(out, to_json(run), -1); }

} // namespace tools
