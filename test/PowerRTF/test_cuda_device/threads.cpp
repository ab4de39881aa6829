// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// CUDA engines on several threads at once.
#include "../engine_comparison.h"

#ifdef CGAL_POWER_RTF_WITH_CUDA

#include <CGAL/PowerRTF/engines/Cuda_engine.h>

#include <atomic>
#include <cstddef>
#include <deque>
#include <thread>
#include <vector>

using namespace engine_comparison;

namespace {

/// The samples of a short run, the lattice's fields on the device included.
Samples run(const Case& c, const Start& start)
{
  const Surface& surface = start.patches->surface();
  const Feature_samples& features = start.patches->features();
  Cuda_engine<float> engine(surface, c.options);
  engine.set_samples(sample_surface<CGAL::Sequential_tag>(surface, c.options, features, nullptr,
                                                          nullptr, engine.lattice_field_maker()),
                     features);
  for (int k = 0; k < 6; ++k) {
    engine.build_cells();
    if (c.options.weight_method == Weight_method::multiplicative) engine.optimize_weights(5);
    engine.move_samples(k < 2 ? Position_method::lloyd : c.options.position_method);
  }
  engine.build_cells();
  if (c.options.weight_method == Weight_method::newton) engine.newton_weights();
  return engine.samples();
}

} // namespace

TEST_CASE("engines of several threads on one GPU each give what they give alone")
{
  std::vector<Case> all = cases();
  all.push_back(
      {"large", shapes::torus(96, 48, 1, 0.3), options_of(false, Density::curvature, 20000)});
  std::deque<Start> starts;
  std::vector<Samples> alone;
  for (const Case& c : all) alone.push_back(run(c, starts.emplace_back(c)));
  std::atomic<int> others{0};
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t k = 0; k < all.size(); ++k) {
        const std::size_t at = (t * 3 + k) % all.size();
        const Samples s = run(all[at], starts[at]);
        others += s.points != alone[at].points || s.weights != alone[at].weights;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(others == 0);
}

#endif
