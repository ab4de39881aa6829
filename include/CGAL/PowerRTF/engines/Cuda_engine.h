// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine of the CUDA traits.
#ifndef CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_H
#define CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_H

#include <CGAL/PowerRTF/engines/Cuda_engine_api.h>
#include <CGAL/PowerRTF/engines/Surface_engine.h>

#include <CGAL/tags.h>

#include <memory>

namespace CGAL::PowerRTF {

/// Engines on a GPU that compute their cells in `Real`: `float` or `double`.
template <class Real>
struct Make_cuda_engine {
  using Concurrency_tag = Parallel_if_available_tag;
  static constexpr Cuda_precision precision = sizeof(Real) == sizeof(float)
                                                  ? Cuda_precision::single_precision
                                                  : Cuda_precision::double_precision;
  static void check(const Run_sizes& sizes, const Remeshing_options& options)
  {
    check_cuda_device(sizes, options, precision);
  }
  static Surface_work surface_work(const Remeshing_options& options)
  {
    return cuda_surface_work(options.device);
  }
  static std::unique_ptr<Engine_base> make(const Surface_in_tree& surface,
                                           const Remeshing_options& options)
  {
    return make_cuda_engine(surface, options, precision);
  }
};

/// \ingroup PkgPowerRTFTraits
/// Cells on an NVIDIA GPU, in the precision `Real`.
///
/// \cgalModels `PowerRTFEngine`
template <class Real = float>
using Cuda_engine = Surface_engine<Make_cuda_engine<Real>>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_H
