// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A result that is its own mirror image is so in the numbers of its file.
#include "cad_shapes.h"
#include "mirror_image.h"

#include "mesh_io.h"
#include "remesh_file.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using shapes::Soup;

namespace {

namespace fs = std::filesystem;

/// Remeshes a file as the program does, and reads the result.
std::pair<Soup, Remeshing_report> remesh(const fs::path& input, const fs::path& output,
                                         tools::Encoding encoding)
{
  tools::Program_options options;
  options.input = input.string();
  options.output = output.string();
  options.traits = "cpu";
  options.quiet = true;
  options.encoding = encoding;
  options.remeshing.number_of_samples = 1500;
  options.remeshing.symmetry = Symmetry::automatic;
  const tools::Run run = tools::remesh_file(options, 0);
  std::string missed;
  for (const std::string& guarantee : run.missed) missed += guarantee + "; ";
  CHECK(missed == "");
  const Polygon_soup written = tools::read_mesh(output.string()).soup;
  Soup soup{written.points, {}};
  for (std::size_t k = 0; k + 1 < written.first.size(); ++k) {
    const int* const corners = written.corners.data() + written.first[k];
    soup.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return {soup, run.report};
}

} // namespace

TEST_CASE("mirrored, the file is the same in every number")
{
  // Far from the origin, where numbers are coarse, and of lengths that no number has exactly.
  const std::vector<std::pair<const char*, Soup>> models = {
      {"ellipsoid", shapes::translated(shapes::ellipsoid(1, 0.7, 0.4, 4), {100.1, 3.3, -7})},
      {"torus", shapes::scaled(shapes::torus(40, 20, 1, 0.4), 1. / 3)},
      {"gear", shapes::gear(0.5)},
      {"bracket", shapes::scaled(shapes::bracket(6, 8), 0.1)},
      {"pipe", shapes::translated(shapes::open_cylinder(40, 10, 1, 2), {-1e4 / 3, 0.7, 0.1})}};
  const fs::path folder = fs::temp_directory_path() / "power_rtf_test_symmetry_files";
  fs::create_directories(folder);
  for (const auto& [name, model] : models) {
    CAPTURE(name);
    const fs::path input = folder / (std::string(name) + "_in.ply");
    {
      std::ofstream out(input, std::ios::binary);
      tools::write_mesh(out, tools::Format::ply, tools::Encoding::text, model.points,
                        model.triangles);
    }
    for (const auto& [file, encoding] : {std::pair{"_text.ply", tools::Encoding::text},
                                         std::pair{"_binary.ply", tools::Encoding::binary},
                                         std::pair{".off", tools::Encoding::text}}) {
      CAPTURE(file);
      const auto [result, report] = remesh(input, folder / (name + std::string(file)), encoding);
      REQUIRE(report.symmetry.axis.size() == 1);
      CHECK(result.points.size() == 1500);
      CHECK(mirror_image::differences(result, report.symmetry.axis[0] - 'x', report.symmetry.at) ==
            0);
    }
  }
  fs::remove_all(folder);
}
