// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program on mechanical parts: flat faces stay flat, tips and corners stay where they are.
#include "cad_shapes.h"
#include "flat_faces.h"
#include "judged_run.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using judged_run::Run;

namespace {

/// A run that must meet every guarantee.
Run met_run(const judged_run::Scratch_folder& folder, const shapes::Soup& soup,
            const judged_run::Settings& settings)
{
  const Run run = judged_run::run(folder, "part", soup, settings);
  CHECK(run.exit_code == 0);
  CHECK(judged_run::failure(run) == "");
  REQUIRE(std::filesystem::exists(run.output));
  return run;
}

CGAL::Bbox_3 box_of(const judge::Mesh& mesh)
{
  return CGAL::bbox_3(mesh.points.begin(), mesh.points.end());
}

double area(const judge::Mesh& mesh)
{
  double sum = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f)
    sum += std::sqrt(mesh.triangle(f).squared_area());
  return sum;
}

/// Over the faces of the part that are wider than `least_width`, and than the spacing of the
/// samples, at most 1 % of their area is tilted, over that of the part itself. Where a part is
/// rounded, facets lie across the border of the flat face: `sharp` says that there are none.
void check_flat_faces(const shapes::Soup& soup, bool sharp, double least_width = 0)
{
  const judged_run::Scratch_folder folder;
  for (const std::size_t samples : {1500, 4000})
    for (const std::string density : {"uniform", "curvature"}) {
      CAPTURE(samples);
      CAPTURE(density);
      const Run run = met_run(folder, soup, {samples, density});
      const judge::Mesh input = judge::merged(judge::read(run.input)),
                        output = judge::read(run.output);
      const double spacing = std::sqrt(area(input) / double(samples));
      const judge::Flat_faces faces(input, std::max(least_width, spacing));
      const auto own = faces.tilted_area(input), is = faces.tilted_area(output);
      const double most = 0.01 * faces.area();
      MESSAGE("flat faces " << faces.area() << ", tilted " << is.inside << " inside, " << is.over
                            << " in all");
      CHECK(is.inside <= own.inside + most);
      if (sharp) CHECK(is.over <= own.over + most);
      // Nothing stands out at the top or the bottom.
      const CGAL::Bbox_3 box = box_of(output), asked = box_of(input);
      const double rounding = 1e-9 * asked.zmax();
      CHECK(box.zmin() >= asked.zmin() - rounding);
      CHECK(box.zmax() <= asked.zmax() + rounding);
    }
}

/// Relative to the spacing of the samples.
double largest_distance(const shapes::Soup& soup, std::size_t samples, unsigned seed = 0)
{
  const judged_run::Scratch_folder folder;
  const Run run = met_run(folder, soup, {samples, "uniform", "off", seed});
  const double percent = run.report["distance_max"], diagonal = run.report["diagonal"];
  return percent / 100 * diagonal / std::sqrt(area(judge::read(run.input)) / double(samples));
}

} // namespace

TEST_CASE("the tilted area is what it says")
{
  using judged_run::mesh_of;
  const judge::Mesh cube = mesh_of(shapes::box(2));
  const judge::Flat_faces faces(cube, 0.9);
  CHECK(faces.area() == doctest::Approx(24));
  CHECK(faces.tilted_area(cube).over == 0);
  CHECK(judge::Flat_faces(cube, 1.1).area() == 0); // squares of side 2 are 1 wide
  const auto turned = [&](double degrees) // the cube: four sides are tilted, two turn in themselves
  {
    return mesh_of(shapes::rotated(shapes::box(2), degrees * shapes::pi / 180, {0, 0, 1}));
  };
  CHECK(faces.tilted_area(turned(0.4)).over == 0);
  CHECK(faces.tilted_area(turned(0.6)).over == doctest::Approx(16).epsilon(0.02));
  shapes::Soup raised = shapes::plane_patch(10, 10);
  raised.points[5 * 11 + 5].z = 0.01; // six facets around it, of 1/200 each
  const judge::Flat_faces plane(mesh_of(shapes::plane_patch(10, 10)), 0.1);
  CHECK(plane.tilted_area(mesh_of(raised)).inside == doctest::Approx(0.03).epsilon(0.01));
  // the cube's edges cut off: those facets lie over two faces each
  const judge::Flat_faces large(mesh_of(shapes::box(1)), 0.9);
  const auto cut = large.tilted_area(mesh_of(shapes::scaled(shapes::octahedron(), 2)));
  CHECK(cut.over > 0);
  CHECK(cut.inside == 0);
}

TEST_CASE("a gear with narrow chamfers keeps its flat faces")
{
  check_flat_faces(shapes::gear(0.5), false);
}

TEST_CASE("a gear's top and bottom end at their rims, chamfered or not")
{
  for (const double chamfer : {0., 0.5}) {
    CAPTURE(chamfer);
    check_flat_faces(shapes::gear(chamfer), true, 5); // the teeth's sides are narrower
  }
}

TEST_CASE("a bracket with fillets keeps its flat faces")
{
  check_flat_faces(shapes::bracket(3, 16), false);
}

TEST_CASE("triangles between creases are round on average")
{
  // without rounding and a spacing that follows the strips: .899, .941 and .929, and 1.6, .6 and
  // 1.2 % above 90 degrees; without another connectivity: .921, .950 and .944, and .4, .2 and .4 %
  const auto check = [](const shapes::Soup& soup, const std::string& density, double least_mean,
                        double most_above_90) {
    CAPTURE(density);
    const judged_run::Scratch_folder folder;
    constexpr unsigned starts = 6; // the share above 90 degrees is chance: from .001 to .004
    double mean = 0, above_90 = 0;
    for (unsigned seed = 0; seed < starts; ++seed) {
      const Run run = met_run(folder, soup, {3000, density, "off", seed});
      mean += double(run.report["q_avg"]) / starts;
      above_90 += double(run.report["above_90"]) / starts;
      if (seed > 0) continue;
      CHECK(double(run.report["q_min"]) >= (density == "uniform" ? 0.69 : 0.6));
      CHECK(double(run.report["theta_min"]) >= (density == "uniform" ? 38 : 30));
    }
    CHECK(mean >= least_mean);
    CHECK(above_90 <= most_above_90);
  };
  check(shapes::gear(0.5), "uniform", 0.93, 0.003);
  check(shapes::bracket(3, 16), "uniform", 0.956, 0.002);
  check(shapes::drilled_plate(3, 2), "uniform", 0.952, 0.003);
  check(shapes::gear(0.5), "curvature", 0.93, 0.003);
  check(shapes::bracket(3, 16), "curvature", 0.955, 0.003);
  check(shapes::drilled_plate(3, 2), "curvature", 0.937, 0.003);
}

TEST_CASE("in strips with room for one row, triangles are round without samples inside")
{
  const judged_run::Scratch_folder folder; // with such samples .925, 2.4 % and 26 degrees
  const Run run = met_run(folder, shapes::gear(1.2), {3000, "curvature"});
  CHECK(double(run.report["q_avg"]) >= 0.935);
  CHECK(double(run.report["above_90"]) <= 0.014);
  CHECK(double(run.report["theta_min"]) >= 29);
}

TEST_CASE("a plate with holes keeps its flat faces")
{
  check_flat_faces(shapes::drilled_plate(3, 2), true, 6); // as thick as 5
}

TEST_CASE("along a round rim, edges are as far from it in their middles as at their ends")
{
  const judged_run::Scratch_folder folder;
  const Run run = met_run(folder, shapes::can(360, 4), {600}); // of radius 1, from z = 0 to z = 2
  const judge::Mesh output = judge::read(run.output);
  for (const double z : {0., 2.}) {
    std::vector<std::pair<double, double>> rim; // angle and radius
    for (const auto& p : output.points)
      if (std::abs(p.z() - z) < 1e-9 && std::hypot(p.x(), p.y()) > 0.95)
        rim.emplace_back(std::atan2(p.y(), p.x()), std::hypot(p.x(), p.y()));
    std::sort(rim.begin(), rim.end());
    REQUIRE(rim.size() > 20);
    rim.emplace_back(rim.front().first + 2 * shapes::pi, rim.front().second);
    for (std::size_t k = 0; k + 1 < rim.size(); ++k) {
      const double cut = 1 - std::cos((rim[k + 1].first - rim[k].first) / 2); // by a chord
      CHECK(std::abs(rim[k].second - 1) < 0.7 * cut);
      const double middle = (rim[k].second + rim[k + 1].second) / 2 * (1 - cut);
      CHECK(std::abs(middle - 1) < 0.7 * cut); // 1: with the ends on the rim
    }
  }
}

TEST_CASE("no part is far from its mesh")
{
  // in the spacing; with vertices that stay on creases, and no search for near places, .053, .044
  // and .110
  const auto check = [](const shapes::Soup& soup, double most) {
    constexpr unsigned starts = 3;
    double mean = 0;
    for (unsigned seed = 0; seed < starts; ++seed)
      mean += largest_distance(soup, 3000, seed) / starts;
    CHECK(mean < most);
  };
  check(shapes::drilled_plate(3, 2), 0.04);
  check(shapes::gear(0.5), 0.034);
  check(shapes::bracket(3, 16), 0.095);
}

TEST_CASE("a cone keeps its tip, in few long facets and in many")
{
  for (const int rows : {1, 40})
    for (const std::size_t samples : {1000, 3000, 10000}) {
      CAPTURE(rows);
      CAPTURE(samples);
      // Three triangles at the tip have angles of 38 degrees there: whether a vertex is on it is a
      // matter of the start, so the mean of a few says little.
      constexpr unsigned starts = 16;
      double mean = 0;
      for (unsigned seed = 0; seed < starts; ++seed)
        mean += largest_distance(shapes::cone(64, 1, 3, rows), samples, seed) / starts;
      CHECK(mean <= 0.5);
    }
}

TEST_CASE("a cube on 8 samples is that cube")
{
  CHECK(largest_distance(shapes::box(1), 8) < 1e-6);
  CHECK(largest_distance(shapes::rotated(shapes::box(1), 1), 8) < 1e-6);
}

int main(int argc, char** argv) { return judged_run::run_tests(argc, argv); }
