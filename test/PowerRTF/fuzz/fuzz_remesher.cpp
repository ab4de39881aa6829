// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The whole remesher on any polygons with any options: it refuses them with the reason, or its
// report is true, by a judge that shares no code with it, and what the report promises holds.
#include "../exact_judge.h"
#include "engine.h"
#include "mutate_polygons.h"
#include "options_of.h"
#include "promise.h"

#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF_remesher.h>

#include <cstddef>
#include <string>

namespace {

using namespace CGAL::PowerRTF;

constexpr std::size_t max_samples = 300; // more only take longer

template <class T>
void expect(const std::string& what, T value, T expected)
{
  fuzz::promise(value == expected,
                what + ": " + std::to_string(value) + " instead of " + std::to_string(expected));
}

judge::Mesh mesh_of(const Extracted_mesh& extracted)
{
  judge::Mesh mesh;
  for (const Vec3d& p : extracted.points) mesh.points.emplace_back(p.x, p.y, p.z);
  for (const Triangle& t : extracted.triangles)
    mesh.facets.push_back({std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2])});
  return mesh;
}

/// The input, if it is a 2-manifold of triangles with areas that do not even touch (else vertices
/// on edges may be joined with them); else nothing.
judge::Mesh clean_input(const fuzz::Polygons& input)
{
  judge::Mesh mesh;
  for (const Vec3d& p : input.points) mesh.points.emplace_back(p.x, p.y, p.z);
  for (const auto& p : input.polygons) {
    if (p.size() != 3) return {};
    mesh.facets.push_back({std::size_t(p[0]), std::size_t(p[1]), std::size_t(p[2])});
  }
  mesh = judge::merged(mesh);
  const bool is_clean = judge::topology(mesh).is_manifold() &&
                        judge::degenerate_facets(mesh) == 0 && judge::self_intersections(mesh) == 0;
  return is_clean ? mesh : judge::Mesh();
}

void check_figures(const judge::Topology& is, std::size_t crossings, const Remeshing_report& report)
{
  const Topology_statistics& said = report.topology;
  expect("vertices, says the report", said.vertices, is.vertices);
  expect("faces, says the report", said.faces, is.facets);
  expect("non-manifold edges, says the report", said.non_manifold_edges, is.non_manifold_edges);
  expect("non-manifold vertices, says the report", said.non_manifold_vertices,
         is.non_manifold_vertices);
  expect("components, says the report", said.components, is.components);
  expect("Euler characteristic, says the report", said.euler_characteristic,
         is.euler_characteristic);
  expect("self-intersections, says the report", report.self_intersections, crossings);
}

void check_guarantees(const judge::Topology& is, const Remeshing_report& report)
{
  const Topology_statistics& asked = report.input_topology;
  expect("vertices", is.vertices, report.samples_asked);
  if (asked.non_manifold_edges > 0) {
    expect("sheets", is.sheets, asked.sheets);
  } else {
    expect("non-manifold edges", is.non_manifold_edges, std::size_t(0));
    expect("non-manifold vertices", is.non_manifold_vertices, asked.non_manifold_vertices);
    fuzz::promise(is.oriented || !asked.oriented, "the facets are consistently oriented");
  }
  expect("Euler characteristic", is.euler_characteristic, asked.euler_characteristic);
  expect("components", is.components, asked.components);
  expect("border loops", is.border_loops, asked.border_loops);
}

/// That the report's topology of the input is the input's.
void check_input(const fuzz::Polygons& input, const Remeshing_report& report)
{
  if (report.cure.resolved_pairs > 0 || report.cure.wrap_radius > 0) return;
  const judge::Mesh mesh = clean_input(input);
  if (mesh.facets.empty()) return;
  const judge::Topology is = judge::topology(mesh);
  expect("Euler characteristic of the input", report.input_topology.euler_characteristic,
         is.euler_characteristic);
  expect("components of the input", report.input_topology.components, is.components);
  expect("border loops of the input", report.input_topology.border_loops, is.border_loops);
}

void remesh(const fuzz::Polygons& input)
{
  using Traits = CGAL::PowerRTF_traits_3<judge::Kernel, CGAL::Sequential_tag>;
  const Remeshing_options options = validate(fuzz::options_of(input));
  Remeshing_report report;
  Surface surface = prepare_surface(input.points, input.polygons, options, report);
  if (report.samples_asked > max_samples) return;
  CGAL::PowerRTF_remesher<Traits> remesher(std::move(surface), options, report);
  Remeshing_default_visitor visitor;
  fuzz::promise(remesher.optimize(visitor), "nothing stops the run");
  const Extracted_mesh extracted = remesher.extract(visitor);
  const judge::Mesh mesh = mesh_of(extracted);
  const judge::Topology topology = judge::topology(mesh);
  const std::size_t crossings = judge::self_intersections(mesh) + judge::degenerate_facets(mesh);
  check_figures(topology, crossings, remesher.report());
  if (!remesher.report().missed_guarantees().empty()) return;
  check_guarantees(topology, remesher.report());
  expect("unused vertices", topology.unused_vertices, std::size_t(0));
  expect("self-intersections", crossings, std::size_t(0));
  if (options.merge_distance == 0) check_input(input, remesher.report());
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const auto input = fuzz::polygons_of(fuzz::text_of(data, size));
  if (!input) return -1;
  try {
    remesh(*input);
  } catch (const Invalid_input_error& e) {
    fuzz::promise(e.what()[0] != 0, "a refusal has a reason");
  }
  return 0;
}
