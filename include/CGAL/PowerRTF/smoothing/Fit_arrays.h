// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SMOOTHING_FIT_ARRAYS_H
#define CGAL_POWER_RTF_SMOOTHING_FIT_ARRAYS_H

#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/mark_firsts.h>
#include <CGAL/PowerRTF/smoothing/Fit_equations.h>
#include <CGAL/PowerRTF/smoothing/Star_faces.h>
#include <CGAL/PowerRTF/smoothing/nearest_place.h>

#include <cstddef>
#include <cstdint>

namespace CGAL::PowerRTF::internal {

/// The places of the mesh nearest to tracked vertices, and their faces; that of no face where no
/// corner may move.
struct Find_tracked_places {
  Star_view stars;
  const Tracked_vertex* tracked;
  const int* spoke_faces;
  int number_of_faces;
  Tracked_place* places;
  int* face;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    const Tracked_vertex& w = tracked[i];
    Star_place near;
    if (w.near >= 0)
      near = nearest_place(stars, stars.surface.points[w.vertex],
                           stars.surface.vertex_normals[w.vertex], w.near);
    places[i] = {near.point, near.distance, w.vertex, w.facet, w.weight};
    face[i] = near.spoke < 0 ? number_of_faces : spoke_faces[near.spoke];
  }
};

struct Order_tracked {
  const Tracked_place* from;
  const int* order;
  Tracked_place* tracked;
  CGAL_POWER_RTF_HD void operator()(int k) const { tracked[k] = from[order[k]]; }
};

/// The arrays of `Fit_equations` where a backend works.
template <class Backend>
struct Fit_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Star_faces<Backend> mesh;
  Buffer<int> first_tracked;
  Buffer<Tracked_place> tracked;
  Buffer<unsigned char> is_wide;
  Buffer<Fit_target> centroids, middles;
  Buffer<Fit_unknown> unknowns;
  Buffer<Symmetric_matrix<float>> couplings;
  Buffer<Vec3<float>> steps;

  /// See listed_arrays.h. But for those of the mesh, and the couplings.
  template <class F>
  static void for_each_array(F&& f, const Flat_fit& fit, std::size_t vertices, std::size_t faces,
                             std::size_t edges)
  {
    using A = Fit_arrays;
    f(&A::first_tracked, faces + 1);
    f(&A::tracked, fit.tracked.size());
    f(&A::is_wide, fit.is_wide.size());
    f(&A::centroids, faces);
    f(&A::middles, edges);
    f(&A::unknowns, vertices);
    f(&A::steps, vertices);
  }

  /// `spokes`: those of all stars. \returns `false` where the memory does not suffice
  bool make(Backend& backend, const Star_view& stars, int spokes, const Flat_fit& fit,
            Fit_equations& equations)
  {
    if (!mesh.make(backend, stars, spokes)) return false;
    const std::size_t faces = mesh.number_of_faces(), edges = mesh.number_of_edges();
    const std::size_t vertices = stars.size;
    const int n = static_cast<int>(fit.tracked.size());
    if (!backend.has_room(bytes_of_listed<Fit_arrays>(fit, vertices, faces, edges) +
                          edges * item_size(&Fit_arrays::couplings) +
                          bytes_of_listed<Tracked_order>(std::size_t(n)) + Backend::sort_bytes(n)))
      return false;
    allocate_listed(backend, *this, fit, vertices, faces, edges);
    order_tracked(backend, stars, fit);
    equations.stars = stars;
    equations.spoke_edges = mesh.spoke_edges.data();
    equations.spoke_faces = mesh.spoke_faces.data();
    equations.corners = mesh.corners.data();
    equations.edges = mesh.edges.data();
    equations.first_tracked = first_tracked.data();
    equations.tracked = tracked.data();
    equations.is_wide = uploaded(backend, is_wide, fit.is_wide.data());
    equations.tangential_weight = fit.tangential_weight;
    equations.tracked_weight = fit.tracked_weight;
    equations.badness_limit = fit.badness_limit;
    equations.centroids = centroids.data();
    equations.middles = middles.data();
    equations.unknowns = unknowns.data();
    equations.steps = steps.data();
    return true;
  }

  /// The couplings get memory, and the faces at the spokes, of use to the unknowns alone, lose it.
  void make_couplings(Backend& backend, Fit_equations& equations)
  {
    mesh.spoke_faces = {};
    couplings.allocate(backend, mesh.edges.size());
    equations.spoke_faces = nullptr;
    equations.couplings = couplings.data();
  }

private:
  struct Tracked_order {
    Buffer<Tracked_vertex> given;
    Buffer<Tracked_place> places;
    Buffer<int> face, order;
    Buffer<std::uint64_t> keys;

    template <class F>
    static void for_each_array(F&& f, std::size_t n)
    {
      f(&Tracked_order::given, n);
      f(&Tracked_order::places, n);
      for (auto array : {&Tracked_order::face, &Tracked_order::order}) f(array, n);
      f(&Tracked_order::keys, n);
    }
  };

  /// By face, those of one face as they come.
  void order_tracked(Backend& backend, const Star_view& stars, const Flat_fit& fit)
  {
    const int n = static_cast<int>(fit.tracked.size()), faces = mesh.number_of_faces();
    if (n == 0) return backend.fill(first_tracked.data(), 0, first_tracked.size());
    Tracked_order a;
    allocate_listed(backend, a, std::size_t(n));
    uploaded(backend, a.given, fit.tracked.data());
    backend.for_each(n, Find_tracked_places{stars, a.given.data(), mesh.spoke_faces.data(), faces,
                                            a.places.data(), a.face.data()});
    backend.for_each(n, Set_key{a.face.data(), a.keys.data()});
    backend.sort_order(n, a.keys.data(), a.order.data());
    backend.for_each(n + 1,
                     Mark_firsts{a.face.data(), a.order.data(), n, faces, first_tracked.data()});
    backend.for_each(n, Order_tracked{a.places.data(), a.order.data(), tracked.data()});
  }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_FIT_ARRAYS_H
