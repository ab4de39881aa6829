// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs of the program power_rtf_remesh on shapes, and what an independent judge finds wrong with
// them. The environment variable POWER_RTF_REMESH names the program.
#ifndef CGAL_POWER_RTF_TEST_JUDGED_RUN_H
#define CGAL_POWER_RTF_TEST_JUDGED_RUN_H

#include "exact_judge.h"
#include "shapes.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace judged_run {

namespace fs = std::filesystem;

/// Seconds of one processor for a run, a guard against programs that hang: real time would also
/// count what else the machine does.
constexpr int time_limit = 30;

/// The program's path; empty: none is named.
inline std::string program()
{
  const char* const path = std::getenv("POWER_RTF_REMESH");
  return path ? path : "";
}

/// A folder that is there as long as the object.
class Scratch_folder {
  fs::path m_path;

public:
  Scratch_folder()
  {
    std::string name = (fs::temp_directory_path() / "power_rtf_XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error(name + " cannot be made");
    m_path = name;
  }
  Scratch_folder(const Scratch_folder&) = delete;
  Scratch_folder& operator=(const Scratch_folder&) = delete;
  ~Scratch_folder() { fs::remove_all(m_path); }
  std::string operator/(const std::string& name) const { return (m_path / name).string(); }
};

inline judge::Mesh mesh_of(const shapes::Soup& soup)
{
  judge::Mesh mesh;
  for (const auto& p : soup.points) mesh.points.emplace_back(p.x, p.y, p.z);
  for (const auto& t : soup.triangles)
    mesh.facets.push_back({std::size_t(t[0]), std::size_t(t[1]), std::size_t(t[2])});
  return mesh;
}

/// Writes the shape in the format that the file's name ends in, all digits of its coordinates.
inline void write(const std::string& file, const shapes::Soup& soup)
{
  if (!CGAL::IO::write_polygon_soup(file, mesh_of(soup).points, soup.triangles,
                                    CGAL::parameters::stream_precision(17)))
    throw std::runtime_error(file + " cannot be written");
}

inline std::string content(const std::string& file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

struct Settings {
  std::size_t samples;
  std::string density = "uniform";
  std::string format = "off"; ///< of input and output
  unsigned seed = 0;
  std::string intersections = "keep";
};

struct Run {
  std::string input, output; ///< files
  std::size_t samples;
  int exit_code;         ///< 128 and the number of the signal that stopped it
  std::string message;   ///< on stderr
  nlohmann::json report; ///< null: none was written
};

/// Runs the program on the shape; its files lie in `folder`.
inline Run run(const Scratch_folder& folder, const std::string& name, const shapes::Soup& soup,
               const Settings& settings)
{
  Run run;
  run.input = folder / (name + '.' + settings.format);
  run.output = folder / (name + ".out." + settings.format);
  run.samples = settings.samples;
  const std::string report = folder / (name + ".json"), messages = folder / (name + ".stderr");
  for (const std::string& file : {run.output, report}) fs::remove(file);
  write(run.input, soup);
  const auto quoted = [](const std::string& text) { return " '" + text + "'"; };
  const std::string command =
      "ulimit -t " + std::to_string(time_limit) + "; exec" + quoted(program()) + quoted(run.input) +
      quoted(run.output) + " --quiet --threads 1 --samples " + std::to_string(settings.samples) +
      " --density " + settings.density + " --seed " + std::to_string(settings.seed) +
      " --intersections " + settings.intersections + " --report" + quoted(report) + " 2>" +
      quoted(messages);
  const int status = std::system(command.c_str());
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  run.message = content(messages);
  if (fs::exists(report)) run.report = nlohmann::json::parse(content(report));
  return run;
}

/// In what the written file differs from `samples` vertices on a surface without
/// self-intersections that has the input's topology. Where the input is no 2-manifold, or has been
/// cured, what the report calls the input's topology counts; what meets there meets in the file.
inline std::vector<std::string> defects(const Run& run)
{
  const judge::Mesh input = judge::merged(judge::read(run.input)), output = judge::read(run.output);
  judge::Topology asked = judge::topology(input);
  const judge::Topology is = judge::topology(output);
  const auto& cure = run.report["cure"];
  const bool is_cured = cure["resolved_pairs"] > 0 || cure["wrap_radius"] > 0;
  if (!asked.is_manifold() || judge::degenerate_facets(input) > 0 || is_cured) {
    asked.euler_characteristic = run.report["input_euler_characteristic"];
    asked.components = run.report["input_components"];
    asked.border_loops = run.report["input_border_loops"];
  }
  std::vector<std::string> found;
  const auto expect = [&](const std::string& what, auto value, auto expected) {
    if (value == expected) return;
    std::ostringstream text;
    text << what << ": " << value << " instead of " << expected;
    found.push_back(text.str());
  };
  expect("vertices", is.vertices, run.samples);
  expect("unused vertices", is.unused_vertices, 0u);
  if (run.report["input_non_manifold_edges"] > 0) {
    expect("seams", is.non_manifold_edges > 0, true);
    expect("sheets", is.sheets, run.report["input_sheets"].get<std::size_t>());
  } else {
    expect("non-manifold edges", is.non_manifold_edges, 0u);
    expect("non-manifold vertices", is.non_manifold_vertices,
           run.report["input_non_manifold_vertices"].get<std::size_t>());
    expect("orientable", is.orientable, asked.orientable);
    if (asked.orientable) expect("consistently oriented", is.oriented, true);
  }
  expect("Euler characteristic", is.euler_characteristic, asked.euler_characteristic);
  expect("components", is.components, asked.components);
  expect("border loops", is.border_loops, asked.border_loops);
  expect("facets without area", judge::degenerate_facets(output), 0u);
  expect("self-intersections", judge::self_intersections(output), 0u);
  return found;
}

/// In what the report differs from the written file. An STL file does not tell apart vertices at
/// the same place, so that it has no figures of its own.
inline std::vector<std::string> wrong_figures(const Run& run)
{
  std::vector<std::string> wrong;
  if (fs::path(run.output).extension() == ".stl") return wrong;
  const judge::Mesh output = judge::read(run.output);
  const judge::Topology is = judge::topology(output);
  const auto expect = [&](const std::string& key, auto value) {
    if (run.report[key] != nlohmann::json(value))
      wrong.push_back("the report says " + key + " " + run.report[key].dump() + ", the file " +
                      nlohmann::json(value).dump());
  };
  expect("vertices", is.vertices);
  expect("faces", is.facets);
  expect("non_manifold_edges", is.non_manifold_edges);
  expect("non_manifold_vertices", is.non_manifold_vertices);
  expect("components", is.components);
  expect("euler_characteristic", is.euler_characteristic);
  expect("self_intersections",
         judge::self_intersections(output) + judge::degenerate_facets(output));
  return wrong;
}

/// What the run did that no run may do; empty: nothing.
///   - It ends with 0, 1 or 3 within `time_limit`; or with 5, where a binary STL's coordinates, of
///     single precision, cannot hold the result.
///   - With 0 or 3: the report's figures are the file's.
///   - With 0: the file has no defect.
///   - With 1: nothing is written, and the message names the input; with 5, the output.
///   - With 3: the message names the output and each missed guarantee of the report.
inline std::string failure(const Run& run)
{
  if (run.exit_code == 128 + SIGXCPU || run.exit_code == 128 + SIGKILL)
    return "hangs: stopped after " + std::to_string(time_limit) + " s";
  const auto says = [&](const std::string& text) {
    return run.message.find(text) != std::string::npos;
  };
  const bool is_too_far = run.exit_code == 5 && fs::path(run.output).extension() == ".stl" &&
                          says("numbers of single precision, cannot hold");
  if (run.exit_code == 1 || is_too_far) {
    if (fs::exists(run.output)) return "refused, but something is written";
    return says(is_too_far ? run.output : run.input)
               ? ""
               : "refused without the file's name: " + run.message;
  }
  if (run.exit_code != 0 && run.exit_code != 3)
    return "ends with " + std::to_string(run.exit_code) + ": " + run.message;

  if (run.report.is_null()) return "no report is written";
  std::string text;
  const auto missed = run.report["missed_guarantees"].get<std::vector<std::string>>();
  if (missed.empty() == (run.exit_code == 3))
    text += "exit code " + std::to_string(run.exit_code) + " with " +
            std::to_string(missed.size()) + " missed guarantees; ";
  for (const std::string& guarantee : missed)
    if (!says(run.output) || !says(guarantee)) text += "stderr does not say: " + guarantee + "; ";
  if (missed.empty())
    for (const std::string& defect : defects(run)) text += "silent: " + defect + "; ";
  for (const std::string& figure : wrong_figures(run)) text += figure + "; ";
  return text;
}

/// The tests, if there is a program to run.
inline int run_tests(int argc, char** argv)
{
  if (!program().empty()) return doctest::Context(argc, argv).run();
  std::cout << "SKIPPED: the environment variable POWER_RTF_REMESH names no program\n";
  return 77; // CTest's SKIP_RETURN_CODE
}

} // namespace judged_run

#endif // CGAL_POWER_RTF_TEST_JUDGED_RUN_H
