// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine in single precision, as the CUDA traits have it, with its loops run on the host,
// against the one in double precision.
#include "engine_comparison.h"

#include <CGAL/PowerRTF/engines/Host_engine_impl.h>
#include <CGAL/PowerRTF/exact/check_cells.h>

#include <limits>

using namespace engine_comparison;

namespace {

using Single = Host_engine<float, Inexact_construction, CGAL::Sequential_tag>;

template <class Engine>
void run(Engine& engine, const Remeshing_options& o)
{
  const auto equal = [&]() { return engine.capacity().inside_interval == 1; };
  for (int k = 0; k < o.relaxation_iterations + o.max_iterations; ++k) {
    engine.build_cells();
    engine.move_samples(k < o.relaxation_iterations ? Position_method::lloyd : o.position_method);
  }
  engine.build_cells();
  engine.restore_best();
  for (int k = 0; k < o.max_weight_iterations && !equal(); ++k)
    if (!engine.newton_weights()) break;
}

} // namespace

TEST_CASE("single precision ends where double precision does")
{
  for (const Case& c : cases()) {
    if (c.options.weight_method != Weight_method::newton) continue;
    CAPTURE(c.name);
    const Start start(c);
    const Surface& surface = start.patches->surface();
    Host host(surface, c.options);
    Single single(surface, c.options);
    host.set_samples(start.samples, start.patches->features());
    single.set_samples(start.samples, start.patches->features());
    run(host, c.options);
    run(single, c.options);
    CHECK(single.displacement() < 1.25 * host.displacement() + 1e-3);
    CHECK(single.cell_counts().ok == host.cell_counts().ok);
    CHECK(single.capacity().inside_interval == host.capacity().inside_interval);
  }
}

TEST_CASE("cells at tips do not keep the others from equal capacities") { check_tips<Single>(); }

TEST_CASE("single precision's cells are the exact ones of its samples")
{
  const Case c = cases()[1];
  const Start start(c);
  Single engine(start.patches->surface(), c.options);
  engine.set_samples(start.samples, start.patches->features());
  for (int k = 0; k < 8; ++k) {
    engine.build_cells();
    engine.move_samples(Position_method::lloyd);
  }
  engine.build_cells();
  engine.newton_weights();
  const Cell_comparison r = check_cells<CGAL::Sequential_tag>(
      engine.samples(), engine.cells(), compatibility_cosine(c.options.normal_angle),
      std::numeric_limits<float>::epsilon(), c.options.guard_factor);
  CHECK(r.cells == start.samples.size());
  CHECK(r.certified_wrong == 0);
  CHECK(r.area.p99 < 2e-6);
  CHECK(r.centroid.p99 < 1e-5);
}
