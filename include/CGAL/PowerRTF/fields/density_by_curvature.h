// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The density that follows the curvature, where a backend works: the steps of `set_density()` for a
// surface without creases whose edges are not much shorter than the samples' spacing.
#ifndef CGAL_POWER_RTF_FIELDS_DENSITY_BY_CURVATURE_H
#define CGAL_POWER_RTF_FIELDS_DENSITY_BY_CURVATURE_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/fields/Compute_density.h>
#include <CGAL/PowerRTF/fields/Diffusion_stage.h>
#include <CGAL/PowerRTF/fields/Edge_lists.h>
#include <CGAL/PowerRTF/fields/Vertex_clusters.h>
#include <CGAL/PowerRTF/fields/density_steps.h>
#include <CGAL/PowerRTF/fields/diffusion.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/fields/growth_rounds.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Keys in the order of numbers, of which none is negative.
struct Make_keys {
  const double* values;
  std::uint64_t* keys;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    std::memcpy(keys + v, values + v, sizeof(double));
  }
};

struct Find_largest {
  const double* values;
  CGAL_POWER_RTF_HD void operator()(int v, Totals<0, 1>& most) const { most.raise(0, values[v]); }
};

/// The steps of `density_by_curvature()`. What they read and write stays where the backend works;
/// the host knows totals only.
template <class Backend>
class Density_by_curvature {
public:
  Density_by_curvature(Backend& backend, const Surface& surface, const Remeshing_options& options)
      : m_backend(backend), m_surface(surface), m_options(options), m_total(backend),
        m_vertices(static_cast<int>(surface.points.size())), m_edges(backend, surface)
  {
    allocate_listed(backend, *this, surface);
    m_density = m_values.data();
    m_spare = m_others.data();
  }

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, const Surface& surface)
  {
    using D = Density_by_curvature;
    const std::size_t vertices = surface.points.size();
    f(&D::m_normals, vertices);
    for (auto array : {&D::m_values, &D::m_others, &D::m_relative, &D::m_spacing, &D::m_times})
      f(array, vertices);
    for (auto array : {&D::m_order, &D::m_lowered}) f(array, vertices);
    f(&D::m_last, 1);
    f(&D::m_keys, vertices);
  }

  void set_to_curvature()
  {
    using Normalize = Normalize_curvature;
    const Vec3d* const normals = uploaded(m_backend, m_normals, m_surface.vertex_normals.data());
    m_backend.for_each(m_vertices, Find_curvature{edges(), facets().points, normals, m_density});
    for (int pass = 0; pass < Normalize::smoothing_passes; ++pass) {
      m_backend.for_each(m_vertices, Smooth_over_edges{edges(), m_density, m_spare});
      std::swap(m_density, m_spare);
    }
    double unit = nth_value(Normalize::rank(m_surface.points.size()));
    if (Normalize::is_flat(unit, m_surface.area)) unit = largest_value(); // almost everywhere
    if (Normalize::is_flat(unit, m_surface.area))
      m_backend.fill(m_density, 1., m_vertices);
    else
      m_backend.for_each(m_vertices, Normalize{unit, m_density});
  }

  void raise_to_power()
  {
    m_backend.for_each(m_vertices, Raise_to_power{m_options.density_power, m_density});
    m_backend.for_each(m_vertices, Normalize_density{largest_value(), m_density});
  }

  double spacing_constant()
  {
    return PowerRTF::spacing_constant(integral(), m_options.number_of_samples);
  }

  /// Whether `near_vertices()` may find clusters, where the largest density is 1. A vertex with no
  /// near neighbor is a center: with so many of them there is one level of clusters, and too many.
  bool may_have_clusters(double C)
  {
    const double near = total<1>(m_vertices, Count_near{edges(), Count_near::distance * C});
    return m_vertices - near < largest_share_of_centers * m_vertices;
  }

  void limit_gradation(double first_constant)
  {
    double *const relative = m_relative.data(), *const h = m_spacing.data();
    m_backend.for_each(m_vertices, Find_relative_spacing{m_density, relative});
    limit_repeatedly(first_constant, [&](double C) {
      m_backend.for_each(m_vertices, Scale_spacing{C, relative, h});
      limit_growth(m_backend, m_vertices, edges(), m_options.gradation, h, m_lowered.data(),
                   m_last.data());
      m_backend.for_each(m_vertices, Find_density_of_spacing{C, h, m_density});
      return spacing_constant();
    });
  }

  void smooth()
  {
    const double variance =
        diffusion_variance(integral(), m_options.number_of_samples, m_options.density_smoothing);
    const double longest =
        total<0>(m_vertices, Set_diffusion_times{edges(), variance, m_density,
                                                 Density_diffusion::longest, m_times.data()});
    m_backend.for_each(m_vertices, Take_logarithm{m_density});
    m_density = diffuse(edges().first, edges().neighbor, m_times.data(), longest,
                        Density_diffusion::steps, m_density, m_spare, Keep_value(),
                        [&](const auto& stage) { m_backend.for_each(m_vertices, stage); });
    m_backend.for_each(m_vertices, Take_exponential{m_density});
  }

  void download(std::vector<double>& density)
  {
    density.resize(m_vertices);
    m_backend.download(density.data(), m_density, m_vertices);
  }

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Edges_view edges() const { return m_edges.view(); }
  const Surface_facets& facets() const { return m_edges.facets(); }

  /// What `f(i, totals)` gathers over [0, n): a sum, or a maximum.
  template <int Sums, class F>
  double total(int n, const F& f)
  {
    m_backend.template reduce<Sums, 1 - Sums>(n, f, Keep_totals{m_total.data()});
    m_backend.synchronize();
    return *m_total.data();
  }
  double largest_value() { return total<0>(m_vertices, Find_largest{m_density}); }
  double integral()
  {
    return total<1>(facets().facets,
                    Density_integral{facets().corners, facets().facet_areas, m_density});
  }

  double nth_value(std::size_t n)
  {
    m_backend.for_each(m_vertices, Make_keys{m_density, m_keys.data()});
    m_backend.sort_order(m_vertices, m_keys.data(), m_order.data());
    int v;
    double value;
    m_backend.download(&v, m_order.data() + n, 1);
    m_backend.download(&value, m_density + v, 1);
    return value;
  }

  Backend& m_backend;
  const Surface& m_surface;
  const Remeshing_options& m_options;
  typename Backend::template Shared_item<double> m_total;
  int m_vertices;
  double *m_density, *m_spare; // the values and the others, or the other way round
  Edge_lists<Backend> m_edges;
  Buffer<Vec3d> m_normals;
  Buffer<double> m_values, m_others, m_relative, m_spacing, m_times;
  Buffer<std::uint64_t> m_keys;
  Buffer<int> m_order, m_lowered, m_last;
};

/// As `Compute_density`: `false` where the memory does not suffice, and where there are creases or
/// may be clusters of near vertices.
template <class Backend>
bool density_by_curvature(Backend& backend, const Surface& surface,
                          const Remeshing_options& options, std::vector<double>& density)
{
  using Field = Density_by_curvature<Backend>;
  if (!surface.creases.empty() || surface.adjacency.non_manifold_edges > 0) return false;
  if (!backend.has_room(Edge_lists<Backend>::bytes(backend, surface) +
                        bytes_of_listed<Field>(surface) +
                        Backend::sort_bytes(static_cast<int>(surface.points.size()))))
    return false;
  Field field(backend, surface, options);
  field.set_to_curvature();
  field.raise_to_power();
  const double C = field.spacing_constant();
  if (field.may_have_clusters(C)) return false;
  if (options.gradation > 0) field.limit_gradation(C);
  if (options.density_smoothing > 0) field.smooth();
  field.download(density);
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_FIELDS_DENSITY_BY_CURVATURE_H
