// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The passes of the paper's rule one by one, as `Engine::optimize_weights()` makes them where the
// cells do not.
#ifndef CGAL_POWER_RTF_CUDA_PLAIN_WEIGHT_PASSES_H
#define CGAL_POWER_RTF_CUDA_PLAIN_WEIGHT_PASSES_H

#include "../cells/cell_builder.h"
#include "torus_sites.h"

#include <CGAL/PowerRTF/optimization/weight_steps.h>

namespace CGAL::PowerRTF::device {

/// `first`, `sixth`: see `Cell_builder::neighbor_distances()`, compatible. Returns the number of
/// passes.
template <class Real>
int plain_weight_passes(Cuda_backend& backend, Cell_builder<Real>& cells, Device_sites<Real>& sites,
                        const Real* density, const Real* first, const Real* sixth,
                        const Multiplicative_weight_rule& rule, int passes)
{
  const int n = sites.size();
  Cuda_backend::Buffer<Cell_summary> summary;
  Cuda_backend::Buffer<double> scalar;
  summary.allocate(backend, 1);
  scalar.allocate(backend, 1);
  Cuda_backend::Shared_item<Cell_summary> shared(backend);
  const Usable_cells<Real> usable{sites.area.data(), sites.mass.data(), density,
                                  sites.status.data(), 0};
  const Summary_rule<Real> sum{usable,  sites.offset.data(), rule.tolerance, nullptr, n,
                               nullptr, summary.data(),      shared.data()};
  int done = 0;
  for (;; ++done) {
    cells.build(sites.outputs());
    backend.reduce_twice(n, sum);
    backend.synchronize();
    if (done == passes || shared.data()->capacity.inside_interval == 1) break;
    apply_weight_rule(backend, n, sites.sites.data(), usable, first, sixth, summary.data(), rule);
    cells.set_weights(sites.arrays());
  }
  center_weights(backend, n, sites.sites.data(), scalar.data());
  cells.set_weights(sites.arrays());
  return done;
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_PLAIN_WEIGHT_PASSES_H
