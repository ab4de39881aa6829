// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "remesh_file.h"

#include "Outputs.h"
#include "Progress.h"
#include "cells_io.h"
#include "fields_io.h"
#include "html_page.h"
#include "input_fields.h"
#include "mesh_io.h"
#include "outcome.h"
#include "traits.h"
#include "transfer.h"

#include <CGAL/PowerRTF/Remeshed_region.h>
#include <CGAL/PowerRTF/cells/mirror_images.h>
#include <CGAL/PowerRTF/exact/check_cells.h>
#include <CGAL/PowerRTF/geometry/output_grid.h>
#include <CGAL/PowerRTF/internal/Stage.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF/run_to_edge_length.h>
#include <CGAL/PowerRTF/samples_within_distance.h>
#include <CGAL/PowerRTF/transfer/Joined_mesh.h>
#include <CGAL/PowerRTF/transfer/find_corner_sources.h>
#include <CGAL/PowerRTF/transfer/keep_labels.h>
#include <CGAL/PowerRTF_remesher.h>

#include <algorithm>
#include <future>
#include <limits>
#include <optional>
#include <sstream>

namespace tools {
namespace {

using namespace CGAL::PowerRTF;
using internal::Joined_mesh;
using internal::Remeshed_region;
using internal::Stage;
using internal::Stopwatch;

/// Checks before any work that all files can be written. \throws Output_error
void check_outputs(const Program_options& o)
{
  if (o.write_mesh && format_of(o.output) == Format::unknown)
    throw Output_error(o.output + ": cannot be written: its name does not end in " +
                       written_endings);
  if (o.writes_patches && !holds_numbers(format_of(o.output)))
    throw Output_error(o.output + ": cannot be written: only .ply, .vtp, .vtu and .msh hold the "
                                  "numbers of patches");
  for (const std::string& file : {o.cells_file, o.samples_file, o.provenance_file})
    if (!file.empty() && !holds_cells(format_of(file)))
      throw Output_error(file + ": cannot be written: its name does not end in .ply or .vtp");
  if (!o.fields_file.empty() && format_of(o.fields_file) != Format::vtp)
    throw Output_error(o.fields_file + ": cannot be written: its name does not end in .vtp");
  for (const std::string& file : {o.write_mesh ? o.output : "", o.cells_file, o.samples_file,
                                  o.fields_file, o.provenance_file, o.report_file, o.html_file})
    if (!file.empty()) check_writable(file);
}

/// Returns what `make` returns. \throws Invalid_input_error with the input's name before the
/// message that `make` throws
template <class Make>
auto about_input(const Program_options& options, const Make& make)
{
  try {
    return make();
  } catch (const Invalid_input_error& e) {
    throw Invalid_input_error(options.input + ": cannot be remeshed: " + e.what());
  }
}

/// \throws Invalid_input_error when n is too large for this machine
void check_number_of_samples(const Program_options& options)
{
  const double bytes_per_sample = 1000; // a low estimate: only what surely does not fit is refused
  const double memory = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGE_SIZE));
  const double most = memory / bytes_per_sample;
  if (double(options.remeshing.number_of_samples) > most)
    throw Invalid_input_error(options.input + ": cannot be remeshed: at most " +
                              std::to_string(std::size_t(most)) +
                              " samples fit into the memory of this machine");
}

/// Whether the output's coordinates are of single precision.
bool writes_floats(const Program_options& options)
{
  return options.write_mesh && holds_floats(format_of(options.output), options.encoding);
}

constexpr char more_digits[] = "; PLY, or STL as text (--ascii), holds more digits";

/// \throws Output_error when the coordinates of a binary file cannot hold the result
void check_precision(Surface& surface, const Program_options& options)
{
  if (!writes_floats(options)) return;
  try {
    set_output_grid(surface, options.remeshing);
  } catch (const Invalid_input_error& e) {
    throw Output_error(options.output + ": cannot be written: " + e.what() + more_digits);
  }
}

struct Input {
  Polygon_mesh mesh; ///< with the properties that the output will have
  Surface_fields fields;
  std::optional<Remeshed_region> region; ///< none: all is remeshed

  /// What is remeshed, and what is said about places there.
  Polygon_soup& remeshed_soup() { return region ? region->soup() : mesh.soup; }
  const Surface_fields& remeshed_fields() const { return region ? region->fields() : fields; }
  /// What the result comes from, and what is said about places there.
  const Polygon_soup& source_soup() const { return region ? region->own().soup : mesh.soup; }
  const Surface_fields& source_fields() const { return region ? region->own().fields : fields; }
};

/// `run` receives the seconds and what is lost.
Input load(Run& run)
{
  Input input;
  Polygon_mesh& mesh = input.mesh;
  {
    const Stage stage("load", run.report.seconds.load);
    const internal::Progress_part part(1);
    mesh = read_mesh(run.options.input);
    about_input(run.options, [&] {
      input.fields = fields_of(run.options, mesh);
      if (!run.options.region_name.empty())
        input.region.emplace(mesh.soup, region_of(run.options, mesh), input.fields,
                             run.options.remeshing, Concurrency());
    });
  }
  const Format output = format_of(run.options.output);
  choose_names(run.options, mesh);
  for (const Side_file& file : mesh.properties.side_files) check_writable(file.name);
  mesh.attributes.merge(not_held_by(output, mesh.properties));
  run.not_carried_over.assign(mesh.attributes.begin(), mesh.attributes.end());
  mesh.properties = run.options.write_mesh ? held_by(output, mesh.properties) : Mesh_properties();
  stop_if_interrupted();
  return input;
}

/// The surface of the input. `run` receives the number of samples, the repairs and the seconds.
Surface prepare(Polygon_soup&& soup, const Surface_fields& fields, Run& run)
{
  Program_options& options = run.options;
  const Stage stage("surface");
  Surface surface = about_input(options, [&] {
    return prepare_surface(std::move(soup), fields, options.remeshing, run.report, Concurrency(),
                           surface_work(options.traits, options.remeshing, options.meshes));
  });
  options.remeshing.number_of_samples = run.report.samples_asked;
  check_number_of_samples(options);
  check_precision(surface, options);
  return surface;
}

/// Compares the cells of a remesher with the exact ones (--check).
template <class Remesher>
Check check(Remesher& remesher, std::size_t iterations)
{
  const double cos_angle = compatibility_cosine(remesher.options().normal_angle);
  return {iterations,
          check_cells<Concurrency>(remesher.sites(), remesher.cells(), cos_angle,
                                   remesher.epsilon(), remesher.options().guard_factor)};
}

/// The progress of a run that compares its cells every so many iterations (--check-every).
template <class Remesher>
class Checking_progress : public Progress {
public:
  Checking_progress(const Program_options& options, Remesher& remesher, std::vector<Check>& checks)
      : Progress(options.quiet), m_every(options.check_every), m_remesher(remesher),
        m_checks(checks)
  {}
  void on_iteration(const Iteration_report&, double)
  {
    const std::size_t done = m_remesher.report().iterations.size();
    if (m_every > 0 && (done - 1) % std::size_t(m_every) == 0)
      m_checks.push_back(check(m_remesher, done - 1));
  }

private:
  int m_every;
  Remesher& m_remesher;
  std::vector<Check>& m_checks;
};

struct Checked_mesh {
  Extracted_mesh mesh;
  std::vector<Check> checks;
};

/// Distributes the samples and triangulates them, and checks the cells where that is asked for.
/// \throws Cancelled
template <class Remesher>
Checked_mesh make_mesh(Remesher& remesher, const Program_options& options)
{
  Checked_mesh result;
  Checking_progress<Remesher> progress(options, remesher, result.checks);
  if (!remesher.optimize(progress)) throw Cancelled();
  if (options.write_mesh || remesher.report().median_edge_length > 0)
    result.mesh = remesher.extract(progress);
  stop_if_interrupted();
  if (options.check) {
    const internal::Cancellation cancellation(progress);
    const Stage stage("check");
    result.checks.push_back(check(remesher, remesher.report().outer_iterations));
  }
  return result;
}

/// Whether it matters to the output where its vertices come from.
bool has_sources(const Polygon_mesh& input, const Program_options& options)
{
  return !input.properties.empty() || !options.provenance_file.empty();
}

/// Where the vertices of `mesh`, in the unit box, come from.
Sources find_sources(const Input& input, const Normalization& normalization,
                     const Extracted_mesh& mesh, Run& run)
{
  if (!has_sources(input.mesh, run.options)) return {};
  const Stage stage("transfer", run.report.seconds.transfer);
  const Polygon_soup& soup = input.source_soup();
  const std::vector<Mesh_property>& of_faces = input.mesh.properties.faces;
  const bool has_others = // than labels, which do not change between their lines
      std::any_of(of_faces.begin(), of_faces.end(),
                  [&](const Mesh_property& p) { return p.name != run.options.labels; });
  Sources sources = find_sources(soup, normalization, run.report.faces_as_input(), mesh.points,
                                 mesh.triangles, Concurrency(), has_others);
  keep_labels(sources, soup, input.source_fields().labels, normalization, mesh, Concurrency());
  if (!input.mesh.properties.texture.empty())
    sources.corners = find_corner_sources(soup, input.source_fields().lines, normalization,
                                          mesh.points, mesh.triangles, sources, Concurrency());
  return sources;
}

/// What a region has become, `mesh`, with what stays of the input around it. The report gets what
/// that is worth. \throws Output_error the output cannot hold what stays as it is
Joined_mesh join(const Input& input, const Normalization& normalization, const Extracted_mesh& mesh,
                 Run& run)
{
  const Stage stage("transfer", run.report.seconds.transfer);
  const internal::Soup_region& region = input.region->replaced();
  Joined_mesh joined(input.mesh.soup, region, mesh, normalization);
  joined.judge(input.mesh.soup, region, run.report, Concurrency());
  run.report.changed_faces = input.region->changed_faces();
  if (!writes_floats(run.options)) return joined;
  for (const int v : joined.input_points) {
    const Vec3d& p = input.mesh.soup.points[v];
    for (const double x : {p.x, p.y, p.z})
      if (double(float(x)) != x)
        throw Output_error(run.options.output +
                           ": cannot be written: its coordinates, numbers of single precision, "
                           "cannot hold vertex " +
                           std::to_string(v) + " as it is" + more_digits);
  }
  return joined;
}

/// Writes all files but the report. \param joined the mesh as it is written; null: it is `mesh`
template <class Remesher>
void write_results(Remesher& remesher, Extracted_mesh& mesh, const Joined_mesh* joined,
                   const Sources& sources, const Polygon_mesh& input, const Run& run,
                   Outputs& outputs)
{
  const Program_options& options = run.options;
  const Normalization& normalization = remesher.surface().normalization;
  outputs.add(options.html_file, [&](std::ostream& out) {
    std::ostringstream report;
    write_json(report, run);
    write_html(out, remesher.surface(), mesh, with_images(remesher.cells(), remesher.mirror()),
               report.str());
  });
  Mesh_properties values = transferred(input, sources);
  if (options.writes_patches) set_patches(remesher.patches(mesh), values);
  mesh.points = mesh.outside(normalization, Concurrency());
  const std::vector<Vec3d>& points = joined ? joined->points : mesh.points;
  const std::vector<Triangle>& triangles = joined ? joined->triangles : mesh.triangles;
  if (options.write_mesh)
    outputs.add(options.output, [&](std::ostream& out) {
      write_mesh(out, format_of(options.output), options.encoding, points, triangles, values);
    });
  for (const Side_file& file : values.side_files)
    outputs.add(file.name, [&](std::ostream& out) { out << file.bytes; });
  outputs.add(options.provenance_file, [&](std::ostream& out) {
    write_sources(out, format_of(options.provenance_file), options.encoding, points, triangles,
                  sources);
  });
  outputs.add(options.cells_file, [&](std::ostream& out) {
    write_cells(out, format_of(options.cells_file), options.encoding,
                with_images(remesher.cells(), remesher.mirror()), normalization,
                remesher.mirror() ? remesher.options().number_of_samples : 0);
  });
  outputs.add(options.samples_file, [&](std::ostream& out) {
    const std::size_t with_cells =
        remesher.options().number_of_samples - remesher.features().size();
    write_samples(out, format_of(options.samples_file), options.encoding,
                  with_images(remesher.samples(), with_cells, remesher.mirror()), normalization);
  });
  outputs.add(options.fields_file, [&](std::ostream& out) {
    write_fields(out, remesher.lattice_fields(), normalization);
  });
}

/// Goes from the surface to the files, which are not yet in their places; the report is not
/// written.
template <class Traits>
void make_results(Run& run, Input& input, Surface surface, Outputs& outputs)
{
  using Remesher = CGAL::PowerRTF_remesher<Traits>;
  const Program_options& options = run.options;
  run.options.traits = Traits::name();
  auto [remesher, checked] = about_input(options, [&] {
    return run_to_edge_length<Remesher>(std::move(surface), options.remeshing, run.report,
                                        [&](Remesher& r) { return make_mesh(r, options); });
  });
  Extracted_mesh& mesh = checked.mesh;
  run.checks = std::move(checked.checks);
  run.report = remesher->report();
  const Normalization& normalization = remesher->surface().normalization;
  std::optional<Joined_mesh> joined;
  Sources sources = find_sources(input, normalization, mesh, run);
  if (input.region && options.write_mesh) {
    Extracted_mesh part = mesh;
    input.region->complete(part, normalization);
    joined = join(input, normalization, part, run);
    if (has_sources(input.mesh, options)) {
      input.region->complete_sources(part, normalization, sources);
      sources = joined->sources(input.region->replaced(), sources);
    }
  }
  if (options.write_mesh) run.missed = run.report.missed_guarantees();
  const Stage stage("write", run.report.seconds.write);
  write_results(*remesher, mesh, joined ? &*joined : nullptr, sources, input.mesh, run, outputs);
}

/// Sets the number of samples to what a sphere would need for the distance asked for.
void guess_samples(const Surface& surface, Run& run)
{
  const double n = samples_of_sphere(surface, run.report.max_distance);
  run.options.remeshing.number_of_samples = static_cast<std::size_t>(std::clamp(n, 4., 3e8));
}

/// The surface with the number of samples that keep the distance asked for.
template <class Traits>
Surface surface_within_distance(Input& input, Run& run, Progress& progress)
{
  const auto prepare_for = [&](const Remeshing_options& options, Remeshing_report& report) {
    Run trial = run;
    trial.options.remeshing = options;
    Surface surface = prepare(Polygon_soup(input.remeshed_soup()), input.remeshed_fields(), trial);
    report = trial.report;
    return surface;
  };
  Remeshing_options& options = run.options.remeshing;
  options.number_of_samples = samples_within_distance<Traits>(options, prepare_for, progress);
  return prepare_for(options, run.report);
}

/// Goes from the input to the files, which are not yet in their places; the report is not written.
void make_results(Run& run, std::optional<Outputs>& outputs)
{
  const Program_options options = run.options;
  const Stopwatch total(run.report.seconds.total);
  about_input(options, [&] { return validate(options.remeshing); });
  check_outputs(options);
  const std::future<void> gpu = start_gpu(options.traits, options.remeshing, options.meshes);
  Progress progress(options.quiet);
  const internal::Cancellation cancellation(progress);
  Input input = load(run);
  Polygon_soup& soup = input.remeshed_soup();
  const bool is_search = is_distance_asked_for(options.remeshing);
  const bool keeps_input = is_search || has_sources(input.mesh, options);
  Surface surface =
      prepare(keeps_input ? Polygon_soup(soup) : std::move(soup), input.remeshed_fields(), run);
  if (is_search) guess_samples(surface, run);
  const Run prepared = run;
  const auto remesh = [&](auto traits, const std::string& why, bool has_gpu_failed) {
    using Traits = typename decltype(traits)::type;
    run = prepared; // without what a GPU that has failed has left, as the outputs
    run.gpu_not_used = why;
    run.has_gpu_failed = has_gpu_failed;
    if (has_gpu_failed && !options.quiet) {
      progress.clear();
      tell_of_gpu(run);
    }
    if (is_search) surface = surface_within_distance<Traits>(input, run, progress);
    outputs.emplace();
    const bool may_fail = options.traits == "auto" && Traits::name() == std::string("cuda");
    make_results<Traits>(run, input, may_fail ? surface : std::move(surface), *outputs);
  };
  with_traits(options.traits, prepared.options.remeshing, remesh, options.meshes);
}

} // namespace

Run remesh_file(const Program_options& options, int threads)
{
  Run run;
  run.options = options;
  run.threads = threads;
  if (writes_floats(options)) run.options.remeshing.coordinates = Coordinates::single_precision;
  std::optional<Outputs> outputs;
  make_results(run, outputs);
  outputs->add(options.report_file, [&](std::ostream& out) { write_json(out, run); });
  stop_if_interrupted();
  outputs->commit();
  return run;
}

} // namespace tools
