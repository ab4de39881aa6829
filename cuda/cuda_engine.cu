// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Cuda_cells.h"
#include "backend/Cuda_backend.h"
#include "surface/projection_by_lanes.cuh"
#include "surface/vertices_by_warp.cuh"

#include <CGAL/PowerRTF/engines/Cuda_engine_api.h>
#include <CGAL/PowerRTF/engines/Engine.h>

namespace CGAL::PowerRTF {
namespace {

template <class Real>
std::unique_ptr<Engine_base> make(const Packed_surface& surface, const Remeshing_options& options)
{
  using device::Cuda_backend;
  return std::make_unique<Engine<Real, Cuda_backend, device::Cuda_cells<Real>>>(surface, options,
                                                                                options.device);
}

} // namespace

std::unique_ptr<Engine_base> make_cuda_engine(const Packed_surface& surface,
                                              const Remeshing_options& options,
                                              Cuda_precision precision)
{
  return precision == Cuda_precision::single_precision ? make<float>(surface, options)
                                                       : make<double>(surface, options);
}

} // namespace CGAL::PowerRTF
