// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The diffusion of a surface's normals, where a backend works.
#ifndef CGAL_POWER_RTF_FIELDS_NORMAL_DIFFUSION_H
#define CGAL_POWER_RTF_FIELDS_NORMAL_DIFFUSION_H

#include <CGAL/PowerRTF/fields/Diffuse_normals.h>
#include <CGAL/PowerRTF/fields/Diffusion_stage.h>
#include <CGAL/PowerRTF/fields/Edge_lists.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

struct Normal_diffusion {
  static constexpr double longest = 32; ///< of the times
  static constexpr int steps = 4;
};

/// Vectors that are not made unit ones again and again cancel, and point anywhere.
struct Keep_direction {
  const Vec3d* original;

  CGAL_POWER_RTF_HD Vec3d operator()(int v, const Vec3d& mean) const
  {
    return squared_length(mean) > 0 ? normalized(mean) : original[v];
  }
};

template <class Backend>
struct Normal_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<double> density, times, longest;
  Buffer<Vec3d> normals, original, others;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices)
  {
    using A = Normal_arrays;
    for (auto array : {&A::density, &A::times}) f(array, vertices);
    f(&A::longest, std::size_t(1));
    for (auto array : {&A::normals, &A::original, &A::others}) f(array, vertices);
  }
};

/// As `Diffuse_normals`: `false` where the memory does not suffice or more than two facets meet.
template <class Backend>
bool diffuse_normals(Backend& backend, const Surface& surface, double variance, Vec3d* normals)
{
  using Arrays = Normal_arrays<Backend>;
  const int n = static_cast<int>(surface.points.size());
  if (surface.adjacency.non_manifold_edges > 0) return false;
  if (!backend.has_room(Edge_lists<Backend>::bytes(backend, surface) +
                        bytes_of_listed<Arrays>(surface.points.size())))
    return false;
  const Edge_lists<Backend> lists(backend, surface);
  const Edges_view edges = lists.view();
  Arrays a;
  allocate_listed(backend, a, surface.points.size());
  const double* const density = uploaded(backend, a.density, surface.vertex_density.data());
  backend.template reduce<0, 1>(
      n, Set_diffusion_times{edges, variance, density, Normal_diffusion::longest, a.times.data()},
      Keep_totals{a.longest.data()});
  double longest;
  backend.download(&longest, a.longest.data(), 1);
  const Keep_direction keep{uploaded(backend, a.original, normals)};
  const Vec3d* const result =
      diffuse(edges.first, edges.neighbor, a.times.data(), longest, Normal_diffusion::steps,
              uploaded(backend, a.normals, normals), a.others.data(), keep,
              [&](const auto& stage) { backend.for_each(n, stage); });
  Unset_vector<Vec3d> diffused(n); // a download that fails leaves the normals as they were
  backend.download(diffused.data(), result, n);
  for_each_index(Backend::concurrency(), n, [&](int v) { normals[v] = diffused[v]; });
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_FIELDS_NORMAL_DIFFUSION_H
