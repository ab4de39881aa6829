// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Cuda_cells.h"
#include "backend/Cuda_backend.h"
#include "surface/projection_by_lanes.cuh"
#include "surface/vertices_by_warp.cuh"

#include <CGAL/PowerRTF/engines/Cuda_engine_api.h>
#include <CGAL/PowerRTF/engines/Engine.h>

#include <string>
#include <type_traits>

namespace CGAL::PowerRTF {
namespace {

template <class Real>
using Device_engine = Engine<Real, device::Cuda_backend, device::Cuda_cells<Real>>;

/// Calls `f(engine)` with a pointer, null, to the engine of a precision.
template <class F>
auto with_precision(Cuda_precision precision, F&& f)
{
  return precision == Cuda_precision::single_precision
             ? f(static_cast<Device_engine<float>*>(nullptr))
             : f(static_cast<Device_engine<double>*>(nullptr));
}

/// The most samples with which a run fits into so many bytes; `sizes` are of one that does not.
std::size_t most_samples(Run_sizes sizes, const Remeshing_options& options,
                         Cuda_precision precision, std::size_t bytes)
{
  std::size_t fits = 0, too_many = sizes.samples;
  while (too_many - fits > 1) {
    sizes.samples = fits + (too_many - fits) / 2;
    (cuda_memory(sizes, options, precision) <= bytes ? fits : too_many) = sizes.samples;
  }
  return fits;
}

} // namespace

std::size_t cuda_memory(const Run_sizes& sizes, const Remeshing_options& options,
                        Cuda_precision precision)
{
  return with_precision(precision, [&](auto* engine) {
    return std::remove_pointer_t<decltype(engine)>::bytes(sizes, options);
  });
}

void check_cuda_device(const Run_sizes& sizes, const Remeshing_options& options,
                       Cuda_precision precision)
{
  const std::size_t free = device::Device_context::of(options.device).free_bytes();
  const std::size_t needed = cuda_memory(sizes, options, precision);
  if (needed <= free) return;
  const std::size_t most = most_samples(sizes, options, precision, free);
  throw Cuda_error("the memory of the GPU does not suffice: " + device::gibibytes(needed) +
                   " are needed for " + std::to_string(sizes.samples) + " samples and " +
                   std::to_string(sizes.facets) + " facets, " + device::gibibytes(free) +
                   " are free; " +
                   (most > 0 ? std::to_string(most) + " samples would fit"
                             : "the surface alone has too many facets"));
}

std::unique_ptr<Engine_base> make_cuda_engine(const Surface_in_tree& surface,
                                              const Remeshing_options& options,
                                              Cuda_precision precision)
{
  return with_precision(precision, [&](auto* engine) -> std::unique_ptr<Engine_base> {
    return std::make_unique<std::remove_pointer_t<decltype(engine)>>(surface, options,
                                                                     options.device);
  });
}

} // namespace CGAL::PowerRTF
