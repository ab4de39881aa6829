// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SMOOTHING_STAR_SWEEPS_H
#define CGAL_POWER_RTF_SMOOTHING_STAR_SWEEPS_H

#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/smoothing/Star_sweeps_base.h>
#include <CGAL/PowerRTF/smoothing/color_vertices.h>
#include <CGAL/PowerRTF/smoothing/doubtful_stars.h>
#include <CGAL/PowerRTF/smoothing/faces_at_vertices.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

/// The arrays of `Flat_stars` where a backend works, and the order of the vertices.
template <class Backend>
struct Star_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> first, neighbors, facets;
  Buffer<unsigned char> kinds;
  Buffer<Vec3d> points, normals;
  Buffer<int> order, flag;
  Buffer<unsigned char> flags;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices, std::size_t spokes)
  {
    using A = Star_arrays;
    f(&A::first, vertices + 1);
    f(&A::neighbors, spokes);
    for (auto array : {&A::facets, &A::order}) f(array, vertices);
    for (auto array : {&A::kinds, &A::flags}) f(array, vertices);
    for (auto array : {&A::points, &A::normals}) f(array, vertices);
    f(&A::flag, std::size_t(1));
  }

  Star_view upload(Backend& backend, const Flat_stars& stars)
  {
    allocate_listed(backend, *this, stars.points.size(), stars.neighbors.size());
    Star_view view;
    view.size = stars.size();
    view.first = uploaded(backend, first, stars.first.data());
    view.neighbors = uploaded(backend, neighbors, stars.neighbors.data());
    view.kinds = uploaded(backend, kinds, stars.kinds.data());
    view.points = uploaded(backend, points, stars.points.data());
    view.normals = uploaded(backend, normals, stars.normals.data());
    view.facets = uploaded(backend, facets, stars.facets.data());
    return view;
  }
};

/// The arrays of `Fit_equations` where a backend works.
template <class Backend>
struct Fit_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<double> heights;
  Buffer<int> spoke_edges, spoke_faces, corners, first_tracked;
  Buffer<Mesh_edge> edges;
  Buffer<Tracked_place> tracked;
  Buffer<unsigned char> is_wide;
  Buffer<Fit_target> centroids, middles;
  Buffer<Fit_unknown> unknowns;
  Buffer<Symmetric_matrix<float>> couplings;
  Buffer<Vec3<float>> steps;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, const Flat_fit& fit)
  {
    using A = Fit_arrays;
    const std::size_t vertices = fit.heights.size(), faces = fit.faces(), edges = fit.edges.size();
    f(&A::heights, vertices);
    for (auto array : {&A::spoke_edges, &A::spoke_faces}) f(array, fit.spoke_edges.size());
    f(&A::corners, 3 * faces);
    f(&A::first_tracked, faces + 1);
    f(&A::edges, edges);
    f(&A::tracked, fit.tracked.size());
    f(&A::is_wide, fit.is_wide.size());
    f(&A::centroids, faces);
    f(&A::middles, edges);
    f(&A::unknowns, vertices);
    f(&A::couplings, edges);
    f(&A::steps, vertices);
  }

  Fit_equations upload(Backend& backend, const Star_view& stars, const Flat_fit& fit)
  {
    allocate_listed(backend, *this, fit);
    Fit_equations equations;
    equations.stars = stars;
    equations.stars.heights = uploaded(backend, heights, fit.heights.data());
    equations.spoke_edges = uploaded(backend, spoke_edges, fit.spoke_edges.data());
    equations.spoke_faces = uploaded(backend, spoke_faces, fit.spoke_faces.data());
    equations.corners = uploaded(backend, corners, fit.corners.data());
    equations.edges = uploaded(backend, edges, fit.edges.data());
    equations.first_tracked = uploaded(backend, first_tracked, fit.first_tracked.data());
    equations.tracked = uploaded(backend, tracked, fit.tracked.data());
    equations.is_wide = uploaded(backend, is_wide, fit.is_wide.data());
    equations.tangential_weight = fit.tangential_weight;
    equations.tracked_weight = fit.tracked_weight;
    equations.badness_limit = fit.badness_limit;
    equations.centroids = centroids.data();
    equations.middles = middles.data();
    equations.unknowns = unknowns.data();
    equations.couplings = couplings.data();
    equations.steps = steps.data();
    return equations;
  }
};

struct Smooth_vertices {
  Star_view stars;
  CGAL_POWER_RTF_HD void operator()(int v) const { smooth_vertex(stars, v); }
};

enum class Fit_part { centroid, middle, unknown, coupling, step, move };

/// What `Fit_equations` does to a face, an edge or a vertex.
template <Fit_part part>
struct Fit_rule {
  Fit_equations equations;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    if constexpr (part == Fit_part::centroid) equations.set_centroid(i);
    if constexpr (part == Fit_part::middle) equations.set_middle(i);
    if constexpr (part == Fit_part::unknown) equations.set_unknown(i);
    if constexpr (part == Fit_part::coupling) equations.set_coupling(i);
    if constexpr (part == Fit_part::step) equations.relax(i);
    if constexpr (part == Fit_part::move) equations.move(i);
  }
};

/// Applies a rule to some vertices.
template <class Rule>
struct In_order {
  Rule rule;
  const int* order;
  CGAL_POWER_RTF_HD void operator()(int k) const { rule(order[k]); }
};

} // namespace internal

/// The result is the same for any number of threads.
template <class Backend>
class Star_sweeps : public Star_sweeps_base {
public:
  /// `surface`: where the backend works. Keeps a reference to `backend`.
  Star_sweeps(Backend& backend, const Surface_descent& surface, double grid)
      : m_backend(backend), m_surface(surface), m_grid(grid)
  {}

  bool smooth(internal::Flat_stars& stars, int steps) override
  {
    if (!m_backend.has_room(bytes(stars))) return false;
    Arrays arrays;
    const internal::Star_view view = upload(stars, arrays);
    const std::vector<int> first = order(view, arrays);
    for (int step = 0; step < steps; ++step)
      for_each_vertex(first, arrays, internal::Smooth_vertices{view});
    download(view, arrays, stars);
    return true;
  }

  bool fit(internal::Flat_stars& stars, internal::Flat_fit& fit) override
  {
    using Part = internal::Fit_part;
    using internal::Fit_rule;
    if (!m_backend.has_room(bytes(stars) + internal::bytes_of_listed<Fit_arrays>(fit)))
      return false;
    Arrays arrays;
    Fit_arrays fit_arrays;
    const internal::Fit_equations equations =
        fit_arrays.upload(m_backend, upload(stars, arrays), fit);
    const int edges = static_cast<int>(fit.edges.size());
    m_backend.for_each(fit.faces(), Fit_rule<Part::centroid>{equations});
    m_backend.for_each(edges, Fit_rule<Part::middle>{equations});
    m_backend.for_each(stars.size(), Fit_rule<Part::unknown>{equations});
    m_backend.for_each(edges, Fit_rule<Part::coupling>{equations});
    const std::vector<int> first = order(equations.stars, arrays);
    for (int sweep = 0; sweep < internal::Fitting_parameters::sweeps; ++sweep)
      for_each_vertex(first, arrays, Fit_rule<Part::step>{equations});
    for_each_vertex(first, arrays, Fit_rule<Part::move>{equations});
    download(equations.stars, arrays, stars);
    m_backend.download(fit.heights.data(), fit_arrays.heights.data(), fit.heights.size());
    return true;
  }

  bool find_faces(const Mesh_arrays& mesh, int n, const int* vertices, int* faces) override
  {
    if (!m_backend.has_room(internal::faces_at_vertices_bytes<Backend>(mesh, n))) return false;
    internal::find_faces_at_vertices(m_backend, m_surface, mesh, n, vertices, faces);
    return true;
  }

private:
  using Arrays = internal::Star_arrays<Backend>;
  using Fit_arrays = internal::Fit_arrays<Backend>;

  static std::size_t bytes(const internal::Flat_stars& stars)
  {
    return internal::bytes_of_listed<Arrays>(stars.points.size(), stars.neighbors.size());
  }

  internal::Star_view upload(const internal::Flat_stars& stars, Arrays& arrays)
  {
    internal::Star_view view = arrays.upload(m_backend, stars);
    view.surface = m_surface;
    view.grid = m_grid;
    return view;
  }

  /// Where in the arrays' order each color begins.
  std::vector<int> order(const internal::Star_view& view, Arrays& arrays)
  {
    if (static_cast<int>(m_colors.size()) != view.size) {
      m_colors.allocate(m_backend, view.size);
      m_backend.fill(m_colors.data(), internal::Color_vertices::none, m_colors.size());
    }
    return internal::order_by_colors(m_backend, view, m_colors.data(), arrays.flag.data(),
                                     arrays.flags.data(), arrays.order.data());
  }

  /// Applies a rule to all vertices that may move, neighbors one after the other.
  template <class Rule>
  void for_each_vertex(const std::vector<int>& first, const Arrays& arrays, const Rule& rule)
  {
    for (std::size_t c = 0; c + 1 < first.size(); ++c)
      m_backend.for_each(first[c + 1] - first[c],
                         internal::In_order<Rule>{rule, arrays.order.data() + first[c]});
  }

  /// What has become of the stars, and which of them are doubtful.
  void download(const internal::Star_view& view, Arrays& arrays, internal::Flat_stars& stars)
  {
    m_backend.for_each(view.size, internal::Find_doubtful_stars{view, arrays.flags.data()});
    stars.doubtful.resize(m_backend.select(view.size, arrays.flags.data(), arrays.order.data()));
    m_backend.download(stars.doubtful.data(), arrays.order.data(), stars.doubtful.size());
    m_backend.download(stars.points.data(), arrays.points.data(), stars.points.size());
    m_backend.download(stars.normals.data(), arrays.normals.data(), stars.normals.size());
    m_backend.download(stars.facets.data(), arrays.facets.data(), stars.facets.size());
  }

  Backend& m_backend;
  Surface_descent m_surface;
  double m_grid;
  typename Backend::template Buffer<int> m_colors; // of the vertices, as they were last
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SMOOTHING_STAR_SWEEPS_H
