// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Real models of CGAL's data, remeshed through the library. They are looked for in the folder that
// the environment variable POWER_RTF_DATA names; without any of them the test is skipped.
#include <CGAL/power_rtf_remeshing.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

using namespace CGAL::PowerRTF;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct Model {
  std::string name;
  std::size_t samples;
  double distance; // largest mean, times 100 / diagonal
};

const std::vector<Model> models = {{"bunny00", 2000, 0.1},
                                   {"retinal", 1500, 0.1},
                                   {"homer", 3000, 0.06},
                                   {"elk", 6000, 0.06},
                                   {"eight", 800, 0.2}};

std::string path_of(const Model& model)
{
  const char* folder = std::getenv("POWER_RTF_DATA");
  return folder ? std::string(folder) + "/" + model.name + ".off" : std::string();
}

bool is_there(const Model& model) { return std::ifstream(path_of(model)).good(); }

constexpr int skipped = 77; // CTest's SKIP_RETURN_CODE

} // namespace

TEST_CASE("cells at tips do not keep the others from equal capacities")
{
  for (const Model& model :
       {Model{"bull", 3000, 0}, Model{"dino", 3000, 0}, Model{"camel", 5000, 0}}) {
    if (!is_there(model)) {
      MESSAGE("skipped: " << path_of(model) << " is missing");
      continue;
    }
    CAPTURE(model.name);
    Mesh input, output;
    REQUIRE(CGAL::IO::read_polygon_mesh(path_of(model), input));
    Remeshing_options options;
    options.density = Density::uniform;
    const Remeshing_report report = CGAL::power_rtf_remeshing(
        input, model.samples, output, parameters::remeshing_options(options));
    CHECK(report.capacity.inside_interval >= 0.98);
    CHECK(report.capacity.left_out <= model.samples / 100);
  }
}

TEST_CASE("a cell that full steps pass by does not keep Newton's method from its end")
{
  const Model model{"hand", 8000, 0};
  if (!is_there(model)) {
    MESSAGE("skipped: " << path_of(model) << " is missing");
    return;
  }
  Mesh input, output;
  REQUIRE(CGAL::IO::read_polygon_mesh(path_of(model), input));
  Remeshing_options options;
  options.improvement = Improvement::no;
  const Remeshing_report report = CGAL::power_rtf_remeshing(input, model.samples, output,
                                                            parameters::remeshing_options(options));
  CHECK(report.capacity.inside_interval == 1);
  CHECK(report.constructions <= report.outer_iterations + 15);
}

TEST_CASE("the place where a model intersects itself does not spoil the rest")
{
  const Model model{"b9_mesh", 3000, 0};
  if (!is_there(model)) {
    MESSAGE("skipped: " << path_of(model) << " is missing");
    return;
  }
  Mesh input, output;
  REQUIRE(CGAL::IO::read_polygon_mesh(path_of(model), input));
  REQUIRE(CGAL::Polygon_mesh_processing::does_self_intersect(input));
  for (const std::size_t n : {std::size_t(1000), model.samples}) {
    CAPTURE(n);
    Remeshing_options options;
    options.density = Density::uniform;
    options.random_seed = 1;
    CGAL::power_rtf_remeshing(input, n, output, parameters::remeshing_options(options));
    CHECK(num_vertices(output) == n);
    CHECK_FALSE(CGAL::Polygon_mesh_processing::does_self_intersect(output));
  }
}

TEST_CASE("real models keep their topology and get good triangles")
{
  for (const Model& model : models) {
    if (!is_there(model)) {
      MESSAGE("skipped: " << path_of(model) << " is missing");
      continue;
    }
    Mesh input;
    REQUIRE(CGAL::IO::read_polygon_mesh(path_of(model), input));
    for (Density density : {Density::uniform, Density::curvature}) {
      const std::string name =
          model.name + (density == Density::uniform ? " uniform" : " adaptive");
      CAPTURE(name);
      Remeshing_options options;
      options.density = density;
      Mesh output;
      const Remeshing_report report = CGAL::power_rtf_remeshing(
          input, model.samples, output, parameters::remeshing_options(options));
      std::string missed;
      for (const std::string& guarantee : report.missed_guarantees()) missed += guarantee + "; ";
      CHECK(missed == "");

      // Judged again, by CGAL.
      CHECK(num_vertices(output) == model.samples);
      CHECK(CGAL::is_valid_polygon_mesh(output));
      CHECK(CGAL::is_triangle_mesh(output));
      CHECK(CGAL::is_closed(output));
      CHECK_FALSE(CGAL::Polygon_mesh_processing::does_self_intersect(output));
      const long euler =
          long(num_vertices(output)) - long(num_edges(output)) + long(num_faces(output));
      CHECK(euler == report.input_topology.euler_characteristic);
      CHECK(report.quality.q_min > 0.65);
      CHECK(report.quality.q_avg > 0.91);
      CHECK(report.quality.theta_min > 33);
      CHECK(report.distance.mean < model.distance);
      CHECK(report.distance.mean > 0);
      CHECK(report.cells.incomplete == 0);
      MESSAGE(name << ": Q_min " << report.quality.q_min << ", Q_avg " << report.quality.q_avg
                   << ", theta_min " << report.quality.theta_min << ", mean distance "
                   << report.distance.mean << ", inside " << report.capacity.inside_interval << ", "
                   << report.seconds.total << " s");
    }
  }
}

int main(int argc, char** argv)
{
  for (const Model& model : models)
    if (is_there(model)) return doctest::Context(argc, argv).run();
  std::cout << "SKIPPED: the environment variable POWER_RTF_DATA names no folder with one of";
  for (const Model& model : models) std::cout << ' ' << model.name << ".off";
  std::cout << " (data/meshes of CGAL's data; Debian: package libcgal-demo)\n";
  return skipped;
}
