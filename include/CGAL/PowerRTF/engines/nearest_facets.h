// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The facets of a surface that are nearest to points, where a backend works.
#ifndef CGAL_POWER_RTF_ENGINES_NEAREST_FACETS_H
#define CGAL_POWER_RTF_ENGINES_NEAREST_FACETS_H

#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// A point of a surface, nearly, and the surface's normal there.
template <class Real>
struct Directed_point {
  Vec3<Real> point, normal;
};

template <class Real>
struct Nearest_facet_rule {
  Surface_view<Real> surface;
  const Directed_point<Real>* points;
  Real cos_angle;
  int* places;

  template <class Lanes>
  CGAL_POWER_RTF_HD void operator()(int i, Lanes lanes) const
  {
    const Surface_point<Real> nearest = project_to_nearest_facet(
        surface, points[i].point, points[i].normal, cos_angle, places[i], lanes);
    if (lanes.leads()) places[i] = nearest.facet;
  }
};

template <class Real, class Backend>
struct Nearest_facet_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Directed_point<Real>> points;
  Buffer<int> places;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t n)
  {
    f(&Nearest_facet_arrays::points, n);
    f(&Nearest_facet_arrays::places, n);
  }
};

/// As `Find_facets`: `false` where the memory does not suffice.
template <class Real, class Backend>
bool nearest_facets(Backend& backend, const Surface_view<Real>& surface, int n, const Vec3d* points,
                    const Vec3d* normals, double cos_angle, int* places)
{
  using Arrays = Nearest_facet_arrays<Real, Backend>;
  if (!backend.has_room(bytes_of_listed<Arrays>(std::size_t(n)))) return false;
  Unset_vector<Directed_point<Real>> directed(n);
  for_each_index(Backend::concurrency(), n, [&](int i) {
    directed[i] = {to_real<Real>(points[i]), to_real<Real>(normals[i])};
  });
  Arrays arrays;
  allocate_listed(backend, arrays, std::size_t(n));
  backend.upload(arrays.points.data(), directed.data(), directed.size());
  backend.upload(arrays.places.data(), places, std::size_t(n));
  backend.for_each_by_lanes(n, Nearest_facet_rule<Real>{surface, arrays.points.data(),
                                                        Real(cos_angle), arrays.places.data()});
  backend.download(places, arrays.places.data(), std::size_t(n));
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_NEAREST_FACETS_H
