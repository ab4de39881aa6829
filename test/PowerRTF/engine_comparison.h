// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps of an engine on a device, or on the host with a device's layouts, against the CPU
// engine's, on surfaces of all kinds.
#ifndef POWER_RTF_TEST_ENGINE_COMPARISON_H
#define POWER_RTF_TEST_ENGINE_COMPARISON_H

#include "shapes.h"

#include <CGAL/PowerRTF/PowerRTF_traits_3.h>
#include <CGAL/PowerRTF/features/Surface_patches.h>
#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <vector>

namespace engine_comparison {

using namespace CGAL::PowerRTF;
using doctest::Approx;
using Host = Cpu_engine<CGAL::Sequential_tag>;

struct Case {
  std::string name;
  shapes::Soup soup;
  Remeshing_options options;
  std::vector<int> kept_vertices{};
};

inline Remeshing_options options_of(bool paper, Density density, std::size_t n)
{
  Remeshing_options o = paper ? Remeshing_options::paper_preset() : Remeshing_options();
  o.density = density;
  o.number_of_samples = n;
  return o;
}

inline std::vector<Case> cases()
{
  const shapes::Soup egg = shapes::ellipsoid(1, 0.7, 0.5, 4);
  return {
      {"even, quality", egg, options_of(false, Density::uniform, 400)},
      {"adaptive, quality", egg, options_of(false, Density::curvature, 400)},
      {"even, paper", egg, options_of(true, Density::uniform, 300)},
      {"adaptive, paper", shapes::torus(48, 24, 1, 0.3), options_of(true, Density::curvature, 300)},
      {"two components", shapes::two_spheres(3), options_of(false, Density::uniform, 300)},
      {"creases", shapes::box(8), options_of(false, Density::uniform, 500)},
      {"borders", shapes::open_cylinder(40, 20, 0.4, 1), options_of(false, Density::uniform, 400)},
      {"vertices that stay", egg, options_of(false, Density::uniform, 400), {7, 8, 300, 1000}}};
}

/// A surface as the remesher prepares it, and its first samples.
struct Start {
  Surface surface;
  std::unique_ptr<Surface_patches> patches;
  Samples samples;

  explicit Start(const Case& c) : surface(shapes::make_surface(c.soup))
  {
    surface.kept_vertices = c.kept_vertices;
    set_creases(surface, c.options);
    set_density(surface, c.options);
    patches = std::make_unique<Surface_patches>(surface, c.options);
    samples = sample_surface(patches->surface(), c.options, patches->features());
  }
};

/// What decides how much memory a run takes.
inline Run_sizes sizes_of(const Case& c, const Start& start)
{
  return Surface_engine_base::run_sizes(start.patches->surface(), c.options);
}

/// The most memory that an engine on a device holds in a run with all kinds of steps.
template <class Engine>
std::size_t memory_of_run(const Case& c, const Start& start)
{
  const Remeshing_options& o = c.options;
  const Surface& surface = start.patches->surface();
  const Feature_samples& features = start.patches->features();
  Engine engine(surface, o);
  engine.set_samples(sample_surface<CGAL::Parallel_if_available_tag>(
                         surface, o, features, nullptr, nullptr, engine.lattice_field_maker(), {},
                         engine.candidate_placer()),
                     features);
  for (int k = 0; k < 4; ++k) {
    engine.build_cells();
    if (o.weight_method == Weight_method::multiplicative) engine.optimize_weights(2);
    engine.move_samples(k < 2 ? Position_method::lloyd : o.position_method);
  }
  engine.build_cells();
  if (o.weight_method == Weight_method::newton) engine.newton_weights();
  if (o.extraction == Extraction_method::cells) engine.neighbors();
  return engine.device_report().bytes;
}

/// The samples of an engine as a lattice begins, and how many are no points of it.
struct Lattice_start {
  Samples samples;
  std::size_t off_lattice = 0;
};

inline std::vector<Case> lattice_cases()
{
  const shapes::Soup torus = shapes::torus(48, 24, 1, 0.3);
  return {
      {"torus", torus, options_of(false, Density::uniform, 20000)},
      {"torus, adaptive", torus, options_of(false, Density::curvature, 20000)},
      {"with a border", shapes::plane_patch(40, 40), options_of(false, Density::uniform, 20000)}};
}

/// `is_placed`: the lattice's points become samples where the engine works.
template <class Engine>
Lattice_start lattice_start(const Case& c, const Start& start, bool is_placed)
{
  Engine engine(start.patches->surface(), c.options);
  Lattice_start result;
  const Samples samples = sample_surface<CGAL::Parallel_if_available_tag>(
      start.patches->surface(), c.options, start.patches->features(), nullptr, &result.off_lattice,
      engine.lattice_field_maker(), {}, is_placed ? engine.candidate_placer() : Place_candidates());
  CHECK((samples.size() == 0) == is_placed);
  engine.set_samples(samples, start.patches->features());
  result.samples = engine.samples();
  return result;
}

/// The samples of both engines in one order.
struct Pairing {
  std::vector<int> of_first; ///< the second one's sample nearest to each of the first
  double distance = 0;       ///< largest, over the mean spacing
};

inline Pairing paired(const Samples& a, const Samples& b, double area)
{
  REQUIRE(a.size() == b.size());
  Pairing p;
  for (const Vec3d& x : a.points) {
    int nearest = 0;
    for (int j = 0; j < int(b.size()); ++j)
      if (squared_length(b.points[j] - x) < squared_length(b.points[nearest] - x)) nearest = j;
    p.of_first.push_back(nearest);
    p.distance = std::max(p.distance, length(b.points[nearest] - x));
  }
  p.distance /= std::sqrt(area / double(a.size()));
  return p;
}

/// Runs `Engine` and the CPU engine side by side for some steps of every kind and compares them.
/// `tolerance`: of positions over the spacing, and of normals, densities and weights.
template <class Engine>
void compare(const Case& c, double tolerance)
{
  CAPTURE(c.name);
  const Start start(c);
  const Surface& surface = start.patches->surface();
  Host host(surface, c.options);
  Engine other(surface, c.options);
  host.set_samples(start.samples, start.patches->features());
  other.set_samples(start.samples, start.patches->features());
  host.build_cells();
  other.build_cells();

  const auto check = [&](const std::string& after) {
    CAPTURE(after);
    const Samples a = host.samples(), b = other.samples();
    const Pairing p = paired(a, b, surface.area);
    CHECK(p.distance < tolerance);
    const double h2 = surface.area / double(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      const int j = p.of_first[i];
      CHECK(std::abs(a.weights[i] - b.weights[j]) < tolerance * h2);
      CHECK(length(a.normals[i] - b.normals[j]) < tolerance);
      CHECK(b.density[j] == Approx(a.density[i]).epsilon(tolerance));
    }
    const Capacity_statistics x = host.capacity(), y = other.capacity();
    CHECK(y.rms == Approx(x.rms).epsilon(100 * tolerance));
    CHECK(y.largest_deviation == Approx(x.largest_deviation).epsilon(100 * tolerance));
    CHECK(other.displacement() == Approx(host.displacement()).epsilon(100 * tolerance));
    const Cell_counts m = host.cell_counts(), n = other.cell_counts();
    CHECK(n.ok == m.ok);
    CHECK(n.guarded == m.guarded);
    CHECK(n.empty == m.empty);
    CHECK(host.constructions() == other.constructions());
  };
  const auto both = [&](auto&& step) {
    step(host);
    step(other);
  };
  const auto move = [&](Position_method method) {
    both([&](auto& engine) {
      engine.move_samples(method);
      engine.build_cells();
    });
  };
  check("the start");
  move(Position_method::lloyd);
  check("a step of Lloyd's method");
  if (c.options.weight_method == Weight_method::multiplicative) {
    both([](auto& engine) { engine.optimize_weights(3); });
    check("three passes of the paper's rule");
    move(Position_method::lloyd);
    check("another step");
    both([](auto& engine) { engine.clear_weights(); });
    check("no weights");
    return;
  }
  for (int k = 0; k < 9; ++k) move(Position_method::lbfgs); // the memory fills
  check("nine steps of L-BFGS");
  bool was_step = false, is_step = false;
  was_step = host.newton_weights();
  is_step = other.newton_weights();
  CHECK(was_step == is_step);
  // The linear system is solved to a thousandth.
  const Capacity_statistics x = host.capacity(), y = other.capacity();
  CHECK(y.left_out == x.left_out);
  CHECK(y.rms == Approx(x.rms).epsilon(0.05));
}

/// Cells at tips that are narrower than the spacing do not keep the others from equal capacities.
template <class Engine>
void check_tips()
{
  const Surface surface = shapes::make_surface(shapes::ball_with_needles());
  for (const unsigned seed : {0u, 1u, 2u}) {
    CAPTURE(seed);
    Remeshing_options options = options_of(false, Density::uniform, 1000);
    options.random_seed = seed;
    Engine engine(surface, options);
    engine.set_samples(sample_surface(surface, options));
    for (int k = 0; k < 30; ++k) {
      engine.build_cells();
      engine.move_samples(Position_method::lloyd);
    }
    engine.build_cells();
    CHECK(engine.capacity().left_out == 0);
    int passes = 0;
    while (passes < 30 && engine.capacity().inside_interval < 1 && engine.newton_weights())
      ++passes;
    CHECK(passes > 0);
    CHECK(engine.capacity().inside_interval >= 0.98);
    CHECK(engine.capacity().left_out > 0);
    CHECK(engine.capacity().left_out <= 10);
    engine.move_samples(Position_method::lloyd);
    engine.build_cells();
    CHECK(engine.capacity().left_out == 0);
  }
}

} // namespace engine_comparison

#endif // POWER_RTF_TEST_ENGINE_COMPARISON_H
