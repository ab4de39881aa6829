// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The one way in: from the user's mesh or polygon soup to the surface that is remeshed, with
// creases and density. What depends on the user's types only reads them; the rest is one function
// of plain arrays.
#ifndef CGAL_POWER_RTF_PREPARE_SURFACE_H
#define CGAL_POWER_RTF_PREPARE_SURFACE_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/input/read_mesh.h>
#include <CGAL/PowerRTF/internal/Stopwatch.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/named_parameters.h>

#include <CGAL/number_utils.h>

#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// The edges that the named parameter `edge_is_constrained_map` marks, as pairs of places in
/// `vertices(mesh)`; none if `np` has no such map.
template <class FaceGraph, class NamedParameters>
std::optional<std::vector<Edge>> constrained_edges(const FaceGraph& mesh, const NamedParameters& np)
{
  const auto map = CGAL::parameters::get_parameter(np, internal_np::edge_is_constrained);
  if constexpr (std::is_same<std::decay_t<decltype(map)>, internal_np::Param_not_found>::value) {
    return std::nullopt;
  } else {
    const auto places = vertex_places(mesh);
    std::vector<Edge> constrained;
    for (const auto e : edges(mesh))
      if (get(map, e))
        constrained.push_back({get(places, source(e, mesh)), get(places, target(e, mesh))});
    return constrained;
  }
}

/// The values of the named parameter `density_map`, in the order of `vertices(mesh)`; none if `np`
/// has no such map.
template <class FaceGraph, class NamedParameters>
std::optional<std::vector<double>> vertex_densities(const FaceGraph& mesh,
                                                    const NamedParameters& np)
{
  const auto map = CGAL::parameters::get_parameter(np, density_map_t());
  if constexpr (std::is_same<std::decay_t<decltype(map)>, internal_np::Param_not_found>::value) {
    return std::nullopt;
  } else {
    std::vector<double> densities;
    densities.reserve(num_vertices(mesh));
    for (const auto v : vertices(mesh)) densities.push_back(CGAL::to_double(get(map, v)));
    return densities;
  }
}

} // namespace internal

/// The surface of a soup, repaired, with creases and density.
///
/// \param creases pairs of points of the soup (see `set_creases()`); none: those that `options`
///   asks for
/// \param densities one per point of the soup; none: those that `options` asks for
/// \param report gets the repairs, the seconds, and the number of samples that `options` asks for
/// \param concurrency one of CGAL's concurrency tags; the result is the same with all of them
/// \throws Invalid_input_error as `import_surface()`, `set_density()` and `number_of_samples()`
Surface prepare_surface(Polygon_soup&& soup, const std::optional<std::vector<Edge>>& creases,
                        const std::optional<std::vector<double>>& densities,
                        const Remeshing_options& options, Remeshing_report& report,
                        internal::Concurrency concurrency = Sequential_tag());

/// \ingroup PkgPowerRTFSurface
/// The surface of any model of `FaceListGraph` as the remesher wants it: imported by
/// `import_surface()`, with the creases and the density that `options` or `np` asks for.
///
/// \param np may contain `vertex_point_map` (default: the mesh's own), `edge_is_constrained_map`
///   (default: what `set_creases()` finds) and `density_map` (default: what `set_density()` sets)
/// \param report gets the repairs, the seconds, and the number of samples that `options` asks for
/// \param concurrency one of CGAL's concurrency tags; the result is the same with all of them
/// \throws Invalid_input_error as `import_surface()`, `set_density()` and `number_of_samples()`
template <class FaceGraph, class NamedParameters>
Surface prepare_surface(const FaceGraph& mesh, const Remeshing_options& options,
                        const NamedParameters& np, Remeshing_report& report,
                        internal::Concurrency concurrency = Sequential_tag())
{
  Polygon_soup soup;
  std::optional<std::vector<Edge>> creases;
  std::optional<std::vector<double>> densities;
  {
    const internal::Stopwatch watch(report.seconds.surface);
    soup = internal::soup_of_mesh(mesh, np);
    creases = internal::constrained_edges(mesh, np);
    densities = internal::vertex_densities(mesh, np);
  }
  return prepare_surface(std::move(soup), creases, densities, options, report, concurrency);
}

/// \ingroup PkgPowerRTFSurface
/// The same of a polygon soup, imported by `import_soup()`.
///
/// \param points range of `Vec3d` or of points with `x()`, `y()`, `z()`
/// \param polygons range of ranges of indices into `points`
/// \throws Invalid_input_error as `import_soup()` and `set_density()`
template <class PointRange, class PolygonRange>
Surface prepare_surface(const PointRange& points, const PolygonRange& polygons,
                        const Remeshing_options& options, Remeshing_report& report,
                        internal::Concurrency concurrency = Sequential_tag())
{
  Polygon_soup soup;
  {
    const internal::Stopwatch watch(report.seconds.surface);
    soup = internal::soup_of_ranges(points, polygons);
  }
  return prepare_surface(std::move(soup), {}, {}, options, report, concurrency);
}

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/prepare_surface_impl.h>
#endif

#endif // CGAL_POWER_RTF_PREPARE_SURFACE_H
