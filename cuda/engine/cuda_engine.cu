// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "../cells/cell_builder.h"
#include "../device/Cuda_backend.h"
#include "Device_engine.h"

namespace CGAL
{
namespace PowerRTF
{
namespace
{

template <class Real>
std::unique_ptr<Device_engine_base> make(const Device_surface_input& surface,
                                         const Remeshing_options& options)
{
  using device::Cuda_backend;
  using Cells = device::Cell_builder<Real>;
  return std::make_unique<device::Device_engine<Real, Cuda_backend, Cells>>(surface, options,
                                                                            options.device);
}

} // namespace

std::unique_ptr<Device_engine_base> make_cuda_engine(const Device_surface_input& surface,
                                                     const Remeshing_options& options,
                                                     Cuda_precision precision)
{
  return precision == Cuda_precision::single_precision ? make<float>(surface, options)
                                                       : make<double>(surface, options);
}

} // namespace PowerRTF
} // namespace CGAL
