// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The diffusion of unit vectors, where a backend works.
#ifndef CGAL_POWER_RTF_FIELDS_DIRECTION_DIFFUSION_H
#define CGAL_POWER_RTF_FIELDS_DIRECTION_DIFFUSION_H

#include <CGAL/PowerRTF/fields/Diffuse_directions.h>
#include <CGAL/PowerRTF/fields/Diffusion_stage.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// Vectors that are not made unit ones again and again cancel, and point anywhere.
struct Keep_direction {
  const Vec3d* original;

  CGAL_POWER_RTF_HD Vec3d operator()(int v, const Vec3d& mean) const
  {
    return squared_length(mean) > 0 ? normalized(mean) : original[v];
  }
};

template <class Backend>
struct Direction_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> first, neighbor; // where the backend does not see the host's
  Buffer<double> times;
  Buffer<Vec3d> directions, original, others;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices, std::size_t edges)
  {
    using A = Direction_arrays;
    for (auto array : {&A::original, &A::others}) f(array, vertices);
    if (Backend::is_host) return;
    f(&A::first, vertices + 1);
    f(&A::neighbor, edges);
    f(&A::times, vertices);
    f(&A::directions, vertices);
  }
};

/// As `Diffuse_directions`: `false` where the memory does not suffice.
template <class Backend>
bool diffuse_directions(Backend& backend, Diffusion_graph graph, int steps, Vec3d* directions)
{
  using Arrays = Direction_arrays<Backend>;
  const int n = graph.vertices;
  if (!backend.has_room(bytes_of_listed<Arrays>(n, graph.edges))) return false;
  Arrays a;
  allocate_listed(backend, a, std::size_t(n), std::size_t(graph.edges));
  Vec3d* now = directions;
  if constexpr (!Backend::is_host) {
    graph.first = uploaded(backend, a.first, graph.first);
    graph.neighbor = uploaded(backend, a.neighbor, graph.neighbor);
    graph.times = uploaded(backend, a.times, graph.times);
    now = uploaded(backend, a.directions, directions);
  }
  const Keep_direction keep{uploaded(backend, a.original, directions)};
  const Vec3d* const result =
      diffuse(graph.first, graph.neighbor, graph.times, graph.longest, steps, now, a.others.data(),
              keep, [&](const auto& stage) { backend.for_each(n, stage); });
  if (result != directions) backend.download(directions, result, n);
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_FIELDS_DIRECTION_DIFFUSION_H
