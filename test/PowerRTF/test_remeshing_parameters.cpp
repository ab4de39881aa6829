// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The named parameters of the free function: seeds, options, densities, creases, visitors.
#include "mesh_of_shape.h"
#include "remeshed_shape.h"

#include <CGAL/power_rtf_remeshing.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

using namespace CGAL::PowerRTF;
using namespace remeshed_shape;
using doctest::Approx;
using shapes::Kernel;
using Polyhedron = CGAL::Polyhedron_3<shapes::Kernel>;
using shapes::make_mesh;
using shapes::Mesh;
using shapes::soup_of;
namespace params = CGAL::PowerRTF::parameters;

namespace {

struct Counting_visitor : Remeshing_default_visitor {
  std::vector<std::string> stages;
  int iterations = 0, stop_after = std::numeric_limits<int>::max();
  double last_progress = 0;
  bool grows = true;

  void on_stage(const char* name) { stages.push_back(name); }
  void on_iteration(const Iteration_report& iteration, double progress)
  {
    ++iterations;
    grows = grows && progress > last_progress && iteration.constructions >= std::size_t(iterations);
    last_progress = progress;
  }
  bool go_further() { return iterations < stop_after; }
};

/// Stops in the middle of a stage: the 50 ms after which it is asked have passed when it begins.
struct Stopping_visitor : Remeshing_default_visitor {
  std::string stage;
  bool stops = false;

  void on_stage(const char* name)
  {
    if (name != stage) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    stops = true;
  }
  bool go_further() const { return !stops; }
};

} // namespace

TEST_CASE("seeds, threads and chains")
{
  const Mesh input = make_mesh(torus());
  const auto remeshed = [&](auto tag, const auto& np) {
    Mesh output;
    CGAL::power_rtf_remeshing<decltype(tag)>(input, 200, output, np);
    return soup_of(output);
  };
  for (unsigned seed : {0u, 7u, 4294967295u}) {
    CAPTURE(seed);
    const auto np = CGAL::parameters::random_seed(seed);
    const Soup sequential = remeshed(CGAL::Sequential_tag(), np);
    CHECK(are_equal(sequential, remeshed(CGAL::Sequential_tag(), np)));
    CHECK(are_equal(sequential, remeshed(CGAL::Parallel_tag(), np)));
    CHECK(are_equal(sequential, remeshed(CGAL::Parallel_if_available_tag(), np)));
    Remeshing_options options;
    options.random_seed = seed;
    CHECK(are_equal(sequential,
                    remeshed(CGAL::Sequential_tag(), params::remeshing_options(options))));
    options.random_seed = 99; // the parameter's own name wins
    CHECK(are_equal(sequential, remeshed(CGAL::Sequential_tag(),
                                         params::remeshing_options(options).random_seed(seed))));
    CHECK_FALSE(are_equal(
        sequential, remeshed(CGAL::Sequential_tag(), CGAL::parameters::random_seed(seed + 1))));
  }
}

TEST_CASE("number_of_samples of the options is not used; number_of_iterations is a name of its own")
{
  const Mesh input = make_mesh(torus());
  Mesh output;
  Remeshing_options options;
  options.number_of_samples = 5000;
  options.relaxation_iterations = 3;
  const Remeshing_report report = CGAL::power_rtf_remeshing(
      input, 120, output, params::remeshing_options(options).number_of_iterations(4));
  CHECK(num_vertices(output) == 120);
  CHECK(report.outer_iterations == 7);
  CHECK(report.iterations.size() == 7);
}

TEST_CASE("steps end when the samples are near their centroids, or come no nearer")
{
  const Mesh input = make_mesh(torus());
  Remeshing_options options;
  options.density = Density::uniform;
  options.max_iterations = 1000;
  const auto displacements = [&](double tolerance) {
    options.centroid_tolerance = tolerance;
    Mesh output;
    std::vector<double> result;
    for (const auto& iteration :
         CGAL::power_rtf_remeshing(input, 400, output, params::remeshing_options(options))
             .iterations)
      result.push_back(iteration.displacement);
    return result;
  };
  for (const double tolerance : {0.02, 0.005}) {
    const std::vector<double> steps = displacements(tolerance);
    REQUIRE(steps.size() > 1);
    CHECK(steps.back() <= tolerance);
    CHECK(*std::min_element(steps.begin(), steps.end() - 1) > tolerance);
  }
  const std::vector<double> steps = displacements(1e-12); // out of reach
  REQUIRE(steps.size() > 20);
  CHECK(steps.size() < 1000);
  CHECK(*std::min_element(steps.end() - 20, steps.end()) >
        0.9 * *std::min_element(steps.begin(), steps.end() - 20));
  options.max_iterations = 60;
  CHECK(displacements(0).size() == 60);
}

TEST_CASE("the user's own density")
{
  const Mesh input = make_mesh(shapes::icosphere(4));
  Mesh mesh = input, output;
  auto density = mesh.add_property_map<Mesh::Vertex_index, double>("v:density", 1).first;
  for (const auto v : mesh.vertices())
    if (mesh.point(v).z() > 0) density[v] = 9;
  const auto share_above = [](const Mesh& m) {
    double above = 0;
    for (const auto v : m.vertices()) above += m.point(v).z() > 0;
    return above / num_vertices(m);
  };
  Remeshing_options options;
  options.gradation = 0;

  // The masses above and below are as 9 to 1.
  const Remeshing_report report = CGAL::power_rtf_remeshing(
      mesh, 500, output, params::density_map(density).remeshing_options(options).random_seed(1));
  CHECK(share_above(output) == Approx(0.9).epsilon(0.03));
  check_guarantees(report);
  const Soup expected = soup_of(output);

  // Any order of the parameters, any number type, and only ratios matter.
  const auto check_same = [&](const auto& np) {
    CGAL::power_rtf_remeshing(mesh, 500, output, np);
    CHECK(are_equal(soup_of(output), expected));
  };
  check_same(params::remeshing_options(options).density_map(density).random_seed(1));
  check_same(params::random_seed(1).remeshing_options(options).density_map(density));
  check_same(params::combine(CGAL::parameters::random_seed(1),
                             params::density_map(density).remeshing_options(options)));
  auto exact =
      mesh.add_property_map<Mesh::Vertex_index,
                            CGAL::Exact_predicates_exact_constructions_kernel::FT>("v:exact")
          .first;
  for (const auto v : mesh.vertices()) exact[v] = 1024 * density[v];
  CGAL::power_rtf_remeshing(mesh, 500, output,
                            params::density_map(exact).remeshing_options(options).random_seed(1));
  CHECK(are_equal(soup_of(output), expected));

  // Gradation spreads the step; without a map the sphere is uniform.
  CGAL::power_rtf_remeshing(mesh, 500, output, params::density_map(density));
  CHECK(share_above(output) < 0.88);
  CHECK(share_above(output) > 0.6);
  CGAL::power_rtf_remeshing(mesh, 500, output);
  CHECK(share_above(output) == Approx(0.5).epsilon(0.06));

  // On a Polyhedron_3.
  const auto polyhedron = make_mesh<Polyhedron>(shapes::icosphere(4));
  auto on_polyhedron = get(CGAL::dynamic_vertex_property_t<double>(), polyhedron);
  for (const auto v : vertices(polyhedron)) put(on_polyhedron, v, v->point().z() > 0 ? 9 : 1);
  CGAL::power_rtf_remeshing(
      polyhedron, 500, output,
      params::density_map(on_polyhedron).remeshing_options(options).random_seed(1));
  CHECK(are_equal(soup_of(output), expected));
}

TEST_CASE("the visitor sees stages and iterations")
{
  const Mesh input = make_mesh(torus());
  Mesh output;
  Counting_visitor visitor;
  const Remeshing_report report = CGAL::power_rtf_remeshing(
      input, 120, output, CGAL::parameters::visitor(std::ref(visitor)).number_of_iterations(20));
  CHECK(visitor.stages == std::vector<std::string>{"surface", "sampling", "optimization",
                                                   "extraction", "improvement", "quality",
                                                   "write"});
  CHECK(visitor.iterations == int(report.outer_iterations));
  CHECK(visitor.grows);
  CHECK(visitor.last_progress == Approx(1));

  Counting_visitor copied; // by value: the copy counts
  CGAL::power_rtf_remeshing(input, 120, output, CGAL::parameters::visitor(copied));
  CHECK(copied.iterations == 0);
}

TEST_CASE("cancellation leaves the output as it was")
{
  const Mesh input = make_mesh(torus());
  for (int stop_after : {0, 1, 13}) {
    CAPTURE(stop_after);
    Mesh output = make_mesh(shapes::box(2));
    const Soup before = soup_of(output);
    Counting_visitor visitor;
    visitor.stop_after = stop_after;
    const Remeshing_report report = CGAL::power_rtf_remeshing(
        input, 120, output, params::remeshing_options(uniform()).visitor(std::ref(visitor)));
    CHECK(report.cancelled);
    CHECK(int(report.outer_iterations) == visitor.iterations);
    if (stop_after == 0) { // asked after the first iteration at the latest
      CHECK(visitor.iterations <= 1);
    } else {
      CHECK(visitor.iterations == stop_after);
      CHECK(visitor.stages.back() == "optimization");
    }
    CHECK(are_equal(soup_of(output), before));
  }
}

TEST_CASE("a visitor stops the run in the middle of every stage; the output stays as it was")
{
  const Mesh input = make_mesh(ellipsoid());
  for (const char* stage :
       {"surface", "sampling", "optimization", "extraction", "improvement", "quality"}) {
    CAPTURE(stage);
    Stopping_visitor visitor;
    visitor.stage = stage;
    Mesh output = make_mesh(shapes::tetrahedron());
    const Remeshing_report report =
        CGAL::power_rtf_remeshing(input, 500, output, CGAL::parameters::visitor(std::ref(visitor)));
    CHECK(visitor.stops);
    CHECK(report.cancelled);
    CHECK(num_vertices(output) == 4);
  }
}

TEST_CASE("creases of the user's own")
{
  Mesh mesh = make_mesh(shapes::plane_patch(10, 10));
  auto is_constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:constrained", false).first;
  const auto is_on_line = [&](Mesh::Vertex_index v) { return mesh.point(v).x() == 0.5; };
  for (const auto e : mesh.edges())
    is_constrained[e] = is_on_line(mesh.vertex(e, 0)) && is_on_line(mesh.vertex(e, 1));
  Mesh output;
  const Remeshing_report report = CGAL::power_rtf_remeshing(
      mesh, 300, output,
      params::remeshing_options(Remeshing_options()).edge_is_constrained_map(is_constrained));
  check_guarantees(report);
  CHECK(report.crease_edges == 10);
  double on_line = 0;
  for (const auto e : output.edges()) {
    const auto a = output.point(output.vertex(e, 0)), b = output.point(output.vertex(e, 1));
    if (std::abs(a.x() - 0.5) < 1e-12 && std::abs(b.x() - 0.5) < 1e-12)
      on_line += std::sqrt(CGAL::squared_distance(a, b));
  }
  CHECK(on_line == Approx(1));
}
