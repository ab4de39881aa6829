// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is done to a surface before there is an engine. Compiled without fused operations: sums and
// products round as on the host.
#include "backend/Cuda_backend.h"

#include <CGAL/PowerRTF/engines/Cuda_engine_api.h>
#include <CGAL/PowerRTF/engines/arrange_facets.h>
#include <CGAL/PowerRTF/engines/build_surface.h>
#include <CGAL/PowerRTF/fields/density_by_curvature.h>
#include <CGAL/PowerRTF/fields/normal_diffusion.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace {

/// Returns `work(backend)`, or `false` where the GPU fails: who makes an engine is told so.
template <class Work>
bool done_on(int device, const Work& work)
{
  try {
    device::Cuda_backend backend(device);
    return work(backend);
  } catch (const Cuda_error&) {
    return false;
  }
}

/// Has what stays when the backend that has made it goes.
struct Device_surface final : Resident_surface {
  std::vector<device::Cuda_backend::Kept_memory> memory;

  Device_surface(int device_number, internal::Facet_buffers<device::Cuda_backend>&& buffers)
  {
    facets = buffers.view();
    device = device_number;
    memory.reserve(7);
    internal::Facet_buffers<device::Cuda_backend>::for_each_array(
        [&](auto array, std::size_t) { memory.push_back((buffers.*array).keep()); }, 0, 0);
    for (const auto& block : memory) bytes += block.bytes();
  }
};

} // namespace

Surface_work cuda_surface_work(int device)
{
  Surface_work work;
  work.build = [device](const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles,
                        Surface& surface) {
    return done_on(device, [&](device::Cuda_backend& backend) {
      internal::Facet_buffers<device::Cuda_backend> there;
      if (!build_surface(backend, points, triangles, surface, there)) return false;
      surface.resident.value = std::make_shared<Device_surface>(device, std::move(there));
      return true;
    });
  };
  work.bring_facets = [device](Surface& surface) {
    return done_on(device, [&](device::Cuda_backend& backend) {
      if (internal::are_facets_there(backend, surface.resident.value.get())) return true;
      internal::Facet_buffers<device::Cuda_backend> there;
      if (!backend.has_room(internal::bytes_of_facets(backend, surface, nullptr))) return false;
      there.upload(backend, surface);
      backend.synchronize(); // other streams read it
      surface.resident.value = std::make_shared<Device_surface>(device, std::move(there));
      return true;
    });
  };
  work.arrange_facets = [device](const Surface& surface, int* order, Child_boxes* nodes) {
    return done_on(device, [&](device::Cuda_backend& backend) {
      return arrange_facets(backend, surface, order, nodes);
    });
  };
  work.compute_density = [device](const Surface& surface, const Remeshing_options& options,
                                  std::vector<double>& density) {
    return done_on(device, [&](device::Cuda_backend& backend) {
      return internal::density_by_curvature(backend, surface, options, density);
    });
  };
  work.diffuse_normals = [device](const Surface& surface, double variance, Vec3d* normals) {
    return done_on(device, [&](device::Cuda_backend& backend) {
      return internal::diffuse_normals(backend, surface, variance, normals);
    });
  };
  return work;
}

} // namespace CGAL::PowerRTF
