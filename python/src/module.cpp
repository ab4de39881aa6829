// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The compiled part of the Python package: arrays in, arrays out. What is for users is in
// ../powerrtf.
#include "Python_visitor.h"
#include "arrays.h"
#include "cells.h"
#include "options.h"
#include "sources.h"

#include "html_page.h"
#include "input_fields.h"
#include "mesh_io.h"
#include "option_names.h"
#include "output_file.h"
#include "program.h"
#include "report_json.h"
#include "traits.h"

#include <CGAL/PowerRTF/Remeshed_region.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF/run_to_edge_length.h>
#include <CGAL/PowerRTF/samples_within_distance.h>
#include <CGAL/PowerRTF/transfer/Joined_mesh.h>
#include <CGAL/PowerRTF/transfer/find_corner_sources.h>
#include <CGAL/PowerRTF/transfer/keep_labels.h>
#include <CGAL/PowerRTF_remesher.h>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/task_arena.h>
#endif

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

namespace {

using namespace powerrtf;
using namespace CGAL::PowerRTF;
using nb::literals::operator""_a;

struct Input {
  Polygon_soup soup;
  Surface_fields fields;
  std::optional<internal::Remeshed_region> region; ///< none: all is remeshed
  bool wants_patches = false, has_seams = false;

  /// What is remeshed, and what is said about places there.
  Polygon_soup& remeshed_soup() { return region ? region->soup() : soup; }
  const Surface_fields& remeshed_fields() const { return region ? region->fields() : fields; }
  /// What the result comes from.
  const Polygon_soup& source_soup() const { return region ? region->own().soup : soup; }
  const Surface_fields& source_fields() const { return region ? region->own().fields : fields; }
  /// Whether the sources of the result are needed: for its labels, its corners, or of what stays.
  bool wants_sources() const { return !fields.labels.empty() || has_seams || region; }
};

/// What a dictionary of fields has: arrays or None, and regions as the program has them.
struct Given_fields {
  std::optional<Real_array> density, sizing;
  std::optional<Index_array> constrained_edges, constrained_vertices, labels;
  std::optional<Index_array> region; ///< faces
  std::optional<Real_array> uv;      ///< of all corners
  std::vector<std::string> refine;
  bool patches; ///< whether the result's are wanted

  explicit Given_fields(const nb::dict& fields)
      : density(nb::cast<std::optional<Real_array>>(fields["density"])),
        sizing(nb::cast<std::optional<Real_array>>(fields["sizing"])),
        constrained_edges(nb::cast<std::optional<Index_array>>(fields["constrained_edges"])),
        constrained_vertices(nb::cast<std::optional<Index_array>>(fields["constrained_vertices"])),
        labels(nb::cast<std::optional<Index_array>>(fields["labels"])),
        region(nb::cast<std::optional<Index_array>>(fields["region"])),
        uv(nb::cast<std::optional<Real_array>>(fields["uv"])),
        refine(nb::cast<std::vector<std::string>>(fields["refine"])),
        patches(nb::cast<bool>(fields["patches"]))
  {}
};

Input input_of(const Real_array& points, const Index_array& faces,
               const std::optional<Index_array>& sizes, const Given_fields& given,
               const Remeshing_options& options)
{
  Input input;
  input.soup = soup_of_arrays(points, faces, sizes);
  input.wants_patches = given.patches;
  Surface_fields& fields = input.fields;
  if (given.constrained_edges)
    fields.creases = edges_of_array(*given.constrained_edges, input.soup);
  if (given.constrained_vertices)
    for_each_index(*given.constrained_vertices,
                   [&](std::size_t, auto v) { fields.kept_vertices.push_back(int(v)); });
  if (given.density) fields.densities = numbers_of_array(*given.density);
  if (given.sizing) fields.sizes = numbers_of_array(*given.sizing);
  if (given.labels)
    for_each_index(*given.labels,
                   [&](std::size_t, auto label) { fields.labels.push_back(int(label)); });
  if (given.uv) {
    tools::Texture texture;
    texture.coordinates.resize(given.uv->shape(0));
    for_each_real(*given.uv,
                  [&](std::size_t i, double x) { texture.coordinates[i / 2][i % 2] = x; });
    for (std::size_t c = 0; c < texture.coordinates.size(); ++c)
      texture.corners.push_back(static_cast<int>(c));
    fields.lines = tools::texture_seams(input.soup, texture);
    input.has_seams = true;
  }
  for (const std::string& region : given.refine)
    fields.refinements.push_back(tools::parse_refinement(region));
  if (given.region) {
    std::vector<char> is_inside(input.soup.first.size() - 1, 0);
    for_each_index(*given.region, [&](std::size_t, auto face) { is_inside[face] = 1; });
    input.region.emplace(input.soup, is_inside, fields, options, tools::Concurrency());
  }
  return input;
}

struct Result {
  Extracted_mesh mesh;
  std::optional<Sources> sources; ///< of it, where the input wants them
  std::vector<int> patches;       ///< of its triangles, where they are wanted
  Placed_sites sites;
};

/// Adds to the result of a region what stays of the input around it.
void join(const Input& input, const Normalization& normalization, Result& result,
          Remeshing_report& report)
{
  input.region->complete(result.mesh, normalization);
  input.region->complete_sources(result.mesh, normalization, *result.sources);
  const internal::Soup_region& region = input.region->replaced();
  internal::Joined_mesh joined(input.soup, region, result.mesh, normalization);
  joined.judge(input.soup, region, report, tools::Concurrency());
  report.changed_faces = input.region->changed_faces();
  result.sources = joined.sources(region, *result.sources);
  result.mesh.points = std::move(joined.points);
  result.mesh.triangles = std::move(joined.triangles);
}

/// From the surface on, as `CGAL::power_rtf_remeshing()`. The result is empty when the visitor has
/// stopped it.
template <class Traits>
Result remesh_with(tools::Run& run, Input& input, Surface surface, Python_visitor& visitor)
{
  run.options.traits = Traits::name();
  using Remesher = CGAL::PowerRTF_remesher<Traits>;
  const auto make = [&visitor](Remesher& r) {
    Result made;
    if (r.optimize(visitor)) {
      made.mesh = r.extract(visitor);
      made.sites = sites_of(r);
    }
    return made;
  };
  auto [remesher, result] =
      run_to_edge_length<Remesher>(std::move(surface), run.options.remeshing, run.report, make);
  run.report = remesher->report();
  const Normalization& normalization = remesher->surface().normalization;
  if (input.wants_patches) result.patches = remesher->patches(result.mesh);
  if (input.wants_sources() && !run.report.cancelled) {
    result.sources = find_sources(input.source_soup(), normalization, run.report.faces_as_input(),
                                  result.mesh.points, result.mesh.triangles, tools::Concurrency());
    keep_labels(*result.sources, input.source_soup(), input.source_fields().labels, normalization,
                result.mesh, tools::Concurrency());
  }
  if (result.sources && input.has_seams)
    result.sources->corners = find_corner_sources(
        input.source_soup(), input.source_fields().lines, normalization, result.mesh.points,
        result.mesh.triangles, *result.sources, tools::Concurrency());
  if (input.region && !run.report.cancelled)
    join(input, normalization, result, run.report);
  else
    result.mesh.points = result.mesh.outside(normalization, tools::Concurrency());
  return std::move(result);
}

#ifdef CGAL_LINKED_WITH_TBB
/// The arena of this thread's calls with so many threads; 0: all. It is kept: on a busy machine TBB
/// (2021.8) does not free an arena whose workers leave late.
tbb::task_arena& own_arena(int threads)
{
  thread_local std::map<int, tbb::task_arena> arenas;
  const int concurrency = threads > 0 ? threads : tbb::task_arena::automatic;
  return arenas.try_emplace(threads, concurrency).first->second;
}
#endif

Result remesh_with_traits(tools::Run& run, Input& input, Python_visitor& visitor)
{
  const std::string name = run.options.traits;
  Result result;
  const auto remesh = [&] {
    const internal::Stopwatch total(run.report.seconds.total);
    Remeshing_options& options = run.options.remeshing;
    const bool is_search = is_distance_asked_for(options);
    const bool keeps_input = is_search || input.wants_sources();
    const auto prepare = [&](const Remeshing_options& o, Remeshing_report& report) {
      const internal::Stage stage("surface");
      Polygon_soup& soup = input.remeshed_soup();
      return prepare_surface(keeps_input ? Polygon_soup(soup) : std::move(soup),
                             input.remeshed_fields(), o, report, tools::Concurrency(),
                             tools::surface_work(name, o));
    };
    Surface surface = prepare(options, run.report);
    options.number_of_samples =
        is_search
            ? std::size_t(std::clamp(samples_of_sphere(surface, run.report.max_distance), 4., 3e8))
            : run.report.samples_asked;
    result = tools::with_traits(
        name, run.options.remeshing, [&](auto traits, const std::string& gpu_not_used, bool) {
          using Traits = typename decltype(traits)::type;
          run.gpu_not_used = gpu_not_used;
          if (is_search) {
            options.number_of_samples = samples_within_distance<Traits>(options, prepare, visitor);
            surface = prepare(options, run.report);
          }
          const bool may_fail = name == "auto" && Traits::name() == std::string("cuda");
          return remesh_with<Traits>(run, input, may_fail ? surface : std::move(surface), visitor);
        });
  };
  const auto cancellable = [&] { internal::run_unless_cancelled(visitor, remesh); };
#ifdef CGAL_LINKED_WITH_TBB
  // An arena, as the limits of the process would hold for other threads' runs, too.
  tbb::task_arena& arena = own_arena(run.options.threads);
  run.threads = arena.max_concurrency();
  arena.execute(cancellable);
#else
  cancellable();
#endif
  run.missed = run.report.missed_guarantees();
  return result;
}

nb::tuple remesh(const Real_array& points, const Index_array& faces,
                 const std::optional<Index_array>& sizes, const nb::dict& fields,
                 const nb::dict& options, const std::string& traits, int threads,
                 const nb::object& progress)
{
  tools::Run run;
  run.options.remeshing = options_of(options);
  run.options.traits = traits;
  run.options.threads = threads;
  const bool is_single = run.options.remeshing.coordinates == Coordinates::single_precision;
  Python_visitor visitor(progress);
  const Given_fields given(fields);
  Result result;
  Input input;
  {
    const nb::gil_scoped_release release;
    input = input_of(points, faces, sizes, given, run.options.remeshing);
    result = remesh_with_traits(run, input, visitor);
  }
  visitor.rethrow();
  std::ostringstream report;
  tools::write_json(report, run);
  nb::object vertices = is_single ? to_array<float>(std::move(result.mesh.points))
                                  : to_array<double>(std::move(result.mesh.points));
  return nb::make_tuple(
      vertices, to_array<int>(std::move(result.mesh.triangles)), report.str(),
      to_python(std::move(result.sites)), to_array<int>(std::move(result.patches)),
      result.sources ? nb::object(to_python(*result.sources, input.soup)) : nb::none());
}

/// The page of a run, of what went in and what came out. \param sites those of the run
nb::bytes html_page(const Real_array& points, const Index_array& faces,
                    const std::optional<Index_array>& sizes, const nb::dict& fields,
                    const nb::dict& options, const Real_array& vertices,
                    const Index_array& triangles, const nb::dict& sites, const std::string& report)
{
  const Remeshing_options remeshing = options_of(options);
  const Given_fields given(fields);
  const Placed_sites placed = sites_from_python(sites);
  std::ostringstream page;
  {
    const nb::gil_scoped_release release;
    Input input = input_of(points, faces, sizes, given, Remeshing_options());
    Remeshing_report repairs;
    const Surface surface = prepare_surface(std::move(input.soup), input.fields, remeshing, repairs,
                                            tools::Concurrency());
    Extracted_mesh mesh;
    mesh.points = points_of_array(vertices);
    for (Vec3d& p : mesh.points) p = surface.normalization.to_inside(p);
    mesh.triangles = triangles_of_array(triangles);
    std::vector<Cell_polygon> cells = whole_cells<tools::Concurrency>(placed);
    for (Cell_polygon& cell : cells)
      for (Vec3d& p : cell.vertices)
        p = surface.normalization.to_inside(placed.normalization.to_outside(p));
    tools::write_html(page, surface, mesh, cells, report);
  }
  const std::string text = page.str();
  return nb::bytes(text.data(), text.size());
}

nb::tuple read_mesh(const std::string& file)
{
  tools::Polygon_mesh mesh;
  {
    const nb::gil_scoped_release release;
    mesh = tools::read_mesh(file);
  }
  std::vector<int> sizes(mesh.soup.first.size() - 1);
  for (std::size_t k = 0; k < sizes.size(); ++k)
    sizes[k] = mesh.soup.first[k + 1] - mesh.soup.first[k];
  return nb::make_tuple(to_array<double>(std::move(mesh.soup.points)),
                        to_array<int>(std::move(mesh.soup.corners)),
                        to_array<int>(std::move(sizes)));
}

tools::Encoding encoding_of(bool ascii)
{
  return ascii ? tools::Encoding::text : tools::Encoding::binary;
}

void check_output(const std::string& file)
{
  if (tools::format_of(file) == tools::Format::unknown)
    throw tools::Output_error(file + ": cannot be written: its name does not end in " +
                              tools::written_endings);
  tools::check_writable(file);
}

void write_mesh(const std::string& file, const Real_array& points, const Index_array& faces,
                bool ascii)
{
  tools::Output_file output(file);
  tools::write_mesh(output.stream(), tools::format_of(file), encoding_of(ascii),
                    points_of_array(points), triangles_of_array(faces));
  output.close();
  output.commit();
}

int run_program(const std::vector<std::string>& arguments)
{
  std::vector<const char*> argv;
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  argv.push_back(nullptr);
  const nb::gil_scoped_release release;
  return tools::run_program(static_cast<int>(arguments.size()), argv.data());
}

} // namespace

NB_MODULE(_core, m)
{
  m.attr("__version__") = POWER_RTF_VERSION;
  nb::exception<Invalid_input_error>(m, "InvalidInputError", PyExc_ValueError);
  nb::exception<tools::Output_error>(m, "OutputError", PyExc_OSError);
#ifdef CGAL_POWER_RTF_WITH_CUDA
  m.attr("traits") = nb::make_tuple("auto", "cpu", "exact", "cuda");
#else
  m.attr("traits") = nb::make_tuple("auto", "cpu", "exact");
#endif
  m.def("options", &option_rows);
  m.def("check_options", [](const nb::dict& values) { validate(options_of(values)); });
  m.def("remesh", &remesh, "points"_a, "faces"_a, "sizes"_a.none(), "fields"_a, "options"_a,
        "traits"_a, "threads"_a, "progress"_a.none());
  m.def("cells", &cells<tools::Concurrency>, "sites"_a);
  m.def("sources", &sources<tools::Concurrency>, "points"_a, "faces"_a, "sizes"_a.none(),
        "vertices"_a, "triangles"_a, "sites"_a);
  m.def("face_shares", &face_shares<tools::Concurrency>, "points"_a, "faces"_a, "sizes"_a.none(),
        "vertices"_a, "triangles"_a, "sites"_a);
  m.def("html_page", &html_page, "points"_a, "faces"_a, "sizes"_a.none(), "fields"_a, "options"_a,
        "vertices"_a, "triangles"_a, "sites"_a, "report"_a);
  m.def("read_mesh", &read_mesh, "file"_a);
  m.def("check_output", &check_output, "file"_a);
  m.def("holds_floats", [](const std::string& file, bool ascii) {
    return tools::holds_floats(tools::format_of(file), encoding_of(ascii));
  });
  m.def("write_mesh", &write_mesh, "file"_a, "points"_a, "faces"_a, "ascii"_a);
  m.def("run_program", &run_program, "arguments"_a);
}
