// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// power_rtf_remesh INPUT OUTPUT [options]: remeshes a surface from file to file.
#include "Progress.h"
#include "cells_io.h"
#include "fields_io.h"
#include "mesh_io.h"
#include "options.h"
#include "output_file.h"
#include "program.h"
#include "report_json.h"
#include "traits.h"

#include <CGAL/PowerRTF/exact/check_cells.h>
#include <CGAL/PowerRTF/geometry/output_grid.h>
#include <CGAL/PowerRTF/internal/Stage.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF/samples_within_distance.h>
#include <CGAL/PowerRTF_remesher.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/info.h>
#endif

#include <algorithm>
#include <iostream>
#include <limits>
#include <list>
#include <new>
#include <optional>

namespace {

using namespace CGAL::PowerRTF;
using namespace tools;
using internal::Stage;
using internal::Stopwatch;

enum Exit_code {
  done = 0,
  unusable_input = 1,
  wrong_usage = 2,
  missed_guarantee = 3,
  wrong_cell = 4,
  unwritable_output = 5,
  cancelled = 128 // and the number of the signal
};

/// Checks before any work that all files can be written. \throws Output_error
void check_outputs(const Program_options& o)
{
  if (o.write_mesh && format_of(o.output) == Format::unknown)
    throw Output_error(o.output + ": cannot be written: its name does not end in .off, .obj, .ply, "
                                  ".stl or .vtp");
  for (const std::string& file : {o.cells_file, o.samples_file})
    if (!file.empty() && format_of(file) != Format::ply && format_of(file) != Format::vtp)
      throw Output_error(file + ": cannot be written: its name does not end in .ply or .vtp");
  if (!o.fields_file.empty() && format_of(o.fields_file) != Format::vtp)
    throw Output_error(o.fields_file + ": cannot be written: its name does not end in .vtp");
  for (const std::string& file :
       {o.write_mesh ? o.output : "", o.cells_file, o.samples_file, o.fields_file, o.report_file})
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

/// \throws Output_error when the coordinates of a binary file cannot hold the result
void check_precision(Surface& surface, const Program_options& options)
{
  if (!writes_floats(options)) return;
  try {
    set_output_grid(surface, options.remeshing);
  } catch (const Invalid_input_error& e) {
    throw Output_error(options.output + ": cannot be written: " + e.what() +
                       "; text (--ascii) holds more digits");
  }
}

/// The polygons of the input. `run` receives the seconds and what is lost.
Polygon_soup load(Run& run)
{
  Polygon_mesh mesh;
  {
    const Stage stage("load", run.report.seconds.load);
    const internal::Progress_part part(1);
    mesh = read_mesh(run.options.input);
  }
  run.not_carried_over.assign(mesh.attributes.begin(), mesh.attributes.end());
  stop_if_interrupted();
  return std::move(mesh.soup);
}

/// The surface of the input. `run` receives the number of samples, the repairs and the seconds.
Surface prepare(Polygon_soup&& soup, Run& run)
{
  Program_options& options = run.options;
  const Stage stage("surface");
  Surface surface = about_input(options, [&] {
    return prepare_surface(std::move(soup), {}, {}, options.remeshing, run.report, Concurrency());
  });
  options.remeshing.number_of_samples = run.report.samples_asked;
  check_number_of_samples(options);
  check_precision(surface, options);
  return surface;
}

/// The files of one run. All of them appear at the end, or none.
class Outputs {
public:
  template <class Write>
  void add(const std::string& file, Write&& write)
  {
    if (file.empty()) return;
    m_files.emplace_back(file);
    try {
      write(m_files.back().stream());
    } catch (const Output_error& e) {
      throw Output_error(file + ": cannot be written: " + e.what());
    }
    stop_if_interrupted();
    m_files.back().close();
  }
  void commit()
  {
    for (Output_file& file : m_files) file.commit();
  }

private:
  std::list<Output_file> m_files;
};

Exit_code fail(Exit_code code, const std::string& message)
{
  std::cerr << "power_rtf_remesh: " << message << '\n';
  return code;
}

/// Tells what the input has that the output does not have.
void print_losses(const Run& run)
{
  if (!run.options.write_mesh || run.not_carried_over.empty()) return;
  std::string list;
  for (const std::string& name : run.not_carried_over) list += (list.empty() ? "" : ", ") + name;
  std::cerr << "power_rtf_remesh: " << run.options.input
            << ": not carried over to the output: " << list << '\n';
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

/// Distributes the samples and triangulates them, and checks the cells where that is asked for.
/// \throws Cancelled
template <class Remesher>
Extracted_mesh make_mesh(Remesher& remesher, Run& run)
{
  const Program_options& options = run.options;
  Checking_progress<Remesher> progress(options, remesher, run.checks);
  if (!about_input(options, [&] { return remesher.optimize(progress); })) throw Cancelled();
  Extracted_mesh mesh;
  if (options.write_mesh) mesh = about_input(options, [&] { return remesher.extract(progress); });
  stop_if_interrupted();
  if (options.check) {
    const internal::Cancellation cancellation(progress);
    const Stage stage("check");
    run.checks.push_back(check(remesher, remesher.report().outer_iterations));
  }
  return mesh;
}

/// Writes all files but the report.
template <class Remesher>
void write_results(Remesher& remesher, Extracted_mesh& mesh, const Program_options& options,
                   Outputs& outputs)
{
  const Normalization& normalization = remesher.surface().normalization;
  for (Vec3d& p : mesh.points) p = normalization.to_outside(p);
  if (options.write_mesh)
    outputs.add(options.output, [&](std::ostream& out) {
      write_mesh(out, format_of(options.output), options.encoding, mesh.points, mesh.triangles);
    });
  outputs.add(options.cells_file, [&](std::ostream& out) {
    write_cells(out, format_of(options.cells_file), options.encoding, remesher.cells(),
                normalization);
  });
  outputs.add(options.samples_file, [&](std::ostream& out) {
    write_samples(out, format_of(options.samples_file), options.encoding, remesher.samples(),
                  normalization);
  });
  outputs.add(options.fields_file, [&](std::ostream& out) {
    write_fields(out, remesher.lattice_fields(), normalization);
  });
}

/// Goes from the surface to the files, which are not yet in their places; the report is not
/// written.
template <class Traits>
void make_results(Run& run, Surface surface, Outputs& outputs)
{
  using Remesher = CGAL::PowerRTF_remesher<Traits>;
  const Program_options& options = run.options;
  run.options.traits = Traits::name();
  Remesher remesher = about_input(
      options, [&] { return Remesher(std::move(surface), options.remeshing, run.report); });
  Extracted_mesh mesh = make_mesh(remesher, run);
  run.report = remesher.report();
  const Stage stage("write", run.report.seconds.write);
  write_results(remesher, mesh, options, outputs);
}

/// Tells the user how the run ended.
Exit_code conclude(const Run& run)
{
  const Program_options& options = run.options;
  if (!options.quiet) {
    print_table(std::cout, run);
    print_losses(run);
  }
  for (const std::string& missed : run.missed)
    std::cerr << "power_rtf_remesh: " << options.output << ": a guarantee is missed: " << missed
              << '\n';
  for (const Check& c : run.checks)
    if (!c.result.passed())
      return fail(wrong_cell, options.input + ": after " + std::to_string(c.iterations) +
                                  " iterations " + std::to_string(c.result.certified_wrong) +
                                  " cells are wrong that were certified: a bug of this program");
  return run.missed.empty() ? done : missed_guarantee;
}

/// Sets the number of samples to what a sphere would need for the distance asked for.
void guess_samples(const Surface& surface, Run& run)
{
  const double n = samples_of_sphere(surface, run.report.max_distance);
  run.options.remeshing.number_of_samples = static_cast<std::size_t>(std::clamp(n, 4., 3e8));
}

/// The surface with the number of samples that keep the distance asked for.
template <class Traits>
Surface surface_within_distance(const Polygon_soup& soup, Run& run, Progress& progress)
{
  const auto prepare_for = [&](const Remeshing_options& options, Remeshing_report& report) {
    Run trial = run;
    trial.options.remeshing = options;
    Surface surface = prepare(Polygon_soup(soup), trial);
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
  Progress progress(options.quiet);
  const internal::Cancellation cancellation(progress);
  Polygon_soup soup = load(run);
  const bool is_search = is_distance_asked_for(options.remeshing);
  Surface surface = prepare(is_search ? Polygon_soup(soup) : std::move(soup), run);
  if (is_search) guess_samples(surface, run);
  with_traits(options.traits, run.options.remeshing, [&](auto traits, const std::string& why) {
    using Traits = typename decltype(traits)::type;
    run.gpu_not_used = why;
    if (is_search) surface = surface_within_distance<Traits>(soup, run, progress);
    outputs.emplace(); // without those of a GPU that has failed
    const bool may_fail = options.traits == "auto" && Traits::name() == std::string("cuda");
    make_results<Traits>(run, may_fail ? surface : std::move(surface), *outputs);
  });
}

Exit_code remesh(const Program_options& options)
{
  Run run;
  run.options = options;
  if (writes_floats(options)) run.options.remeshing.coordinates = Coordinates::single_precision;
#ifdef CGAL_LINKED_WITH_TBB
  run.threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(run.threads));
#endif
  std::optional<Outputs> outputs;
  make_results(run, outputs);
  if (options.write_mesh) run.missed = run.report.missed_guarantees();
  outputs->add(options.report_file, [&](std::ostream& out) { write_json(out, run); });
  stop_if_interrupted();
  outputs->commit();
  return conclude(run);
}

} // namespace

int tools::run_program(int argc, const char* const* argv)
{
  handle_interrupts();
  std::string input;
  try {
    std::string information;
    const Program_options options = parse_command_line(argc, argv, information);
    if (!information.empty()) return std::cout << information, done;
    input = options.input;
    return remesh(options);
  } catch (const Usage_error& e) {
    return fail(wrong_usage, e.what() + std::string("\npower_rtf_remesh --help shows the options"));
  } catch (const Cancelled&) {
    return fail(Exit_code(cancelled + interrupted), "cancelled; nothing was written");
  } catch (const std::bad_alloc&) {
    return fail(unusable_input, input + ": cannot be remeshed: the memory does not suffice");
  } catch (const Invalid_input_error& e) {
    return fail(unusable_input, e.what());
  } catch (const Output_error& e) {
    return fail(unwritable_output, e.what());
  } catch (const std::exception& e) {
    return fail(unusable_input, input + ": cannot be remeshed: " + e.what());
  }
}
