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
#include <CGAL/PowerRTF/Surface_fields.h>
#include <CGAL/PowerRTF/fields/Surface_work.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/input/read_mesh.h>
#include <CGAL/PowerRTF/internal/Stopwatch.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/named_parameters.h>

#include <CGAL/number_utils.h>

#include <map>
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

/// The vertices that the named parameter `vertex_is_constrained_map` marks, as places in
/// `vertices(mesh)`; none if `np` has no such map.
template <class FaceGraph, class NamedParameters>
std::vector<int> constrained_vertices(const FaceGraph& mesh, const NamedParameters& np)
{
  std::vector<int> constrained;
  if constexpr (has_parameter<NamedParameters, internal_np::vertex_is_constrained_t>()) {
    const auto map = CGAL::parameters::get_parameter(np, internal_np::vertex_is_constrained);
    int place = 0;
    for (const auto v : vertices(mesh)) {
      if (get(map, v)) constrained.push_back(place);
      ++place;
    }
  }
  return constrained;
}

/// The values of the named parameter `Tag`, in the order of `vertices(mesh)`; none if `np` has no
/// such map.
template <class Tag, class FaceGraph, class NamedParameters>
std::optional<std::vector<double>> vertex_values(const FaceGraph& mesh, const NamedParameters& np)
{
  const auto map = CGAL::parameters::get_parameter(np, Tag());
  if constexpr (std::is_same<std::decay_t<decltype(map)>, internal_np::Param_not_found>::value) {
    return std::nullopt;
  } else {
    std::vector<double> values;
    values.reserve(num_vertices(mesh));
    for (const auto v : vertices(mesh)) values.push_back(CGAL::to_double(get(map, v)));
    return values;
  }
}

/// The lengths that the named parameter `sizing_map` or `sizing_field` wants, in the order of
/// `vertices(mesh)`; none if `np` has neither.
template <class FaceGraph, class NamedParameters>
std::optional<std::vector<double>> wanted_sizes(const FaceGraph& mesh, const NamedParameters& np)
{
  if constexpr (has_parameter<NamedParameters, sizing_field_t>()) {
    static_assert(!has_parameter<NamedParameters, sizing_map_t>(),
                  "sizing_map and sizing_field exclude each other");
    const auto field = CGAL::parameters::get_parameter(np, sizing_field_t());
    std::vector<double> values;
    values.reserve(num_vertices(mesh));
    for (const auto v : vertices(mesh)) values.push_back(CGAL::to_double(field.at(v, mesh)));
    return values;
  } else {
    return vertex_values<sizing_map_t>(mesh, np);
  }
}

/// The values of the named parameter `face_patch_map`, numbered, in the order of `faces(mesh)`;
/// none if `np` has no such map.
template <class FaceGraph, class NamedParameters>
std::vector<int> face_labels(const FaceGraph& mesh, const NamedParameters& np)
{
  std::vector<int> labels;
  if constexpr (has_parameter<NamedParameters, internal_np::face_patch_t>()) {
    const auto map = CGAL::parameters::get_parameter(np, internal_np::face_patch);
    using Value = typename boost::property_traits<std::decay_t<decltype(map)>>::value_type;
    std::map<Value, int> numbers;
    for (const auto f : faces(mesh))
      labels.push_back(
          numbers.emplace(get(map, f), static_cast<int>(numbers.size())).first->second);
  }
  return labels;
}

/// What the named parameters say about places of the mesh.
template <class FaceGraph, class NamedParameters>
Surface_fields surface_fields(const FaceGraph& mesh, const NamedParameters& np)
{
  Surface_fields fields;
  fields.creases = constrained_edges(mesh, np);
  fields.densities = vertex_values<density_map_t>(mesh, np);
  fields.sizes = wanted_sizes(mesh, np);
  fields.refinements = CGAL::parameters::choose_parameter(
      CGAL::parameters::get_parameter(np, refinements_t()), std::vector<Refinement>());
  fields.labels = face_labels(mesh, np);
  fields.kept_vertices = constrained_vertices(mesh, np);
  return fields;
}

} // namespace internal

/// The surface of a soup, repaired, with creases and density.
///
/// \param report gets the repairs, the seconds, and the number of samples that `options` asks for;
///   and the topology, where facets are split as `set_wanted_lengths()` does
/// \param concurrency one of CGAL's concurrency tags; the result is the same with all of them
/// \param work what is done elsewhere: `PowerRTFEngine::surface_work()`
/// \throws Invalid_input_error as `import_surface()`, `set_density()`, `number_of_samples()` and
///   `set_wanted_lengths()`
Surface prepare_surface(Polygon_soup&& soup, const Surface_fields& fields,
                        const Remeshing_options& options, Remeshing_report& report,
                        internal::Concurrency concurrency = Sequential_tag(),
                        const Surface_work& work = {});

/// \ingroup PkgPowerRTFSurface
/// The surface of any model of `FaceListGraph` as the remesher wants it: imported by
/// `import_surface()`, with the creases and the density that `options` or `np` asks for.
///
/// \param np may contain `vertex_point_map` (default: the mesh's own), `edge_is_constrained_map`
///   (default: what `set_creases()` finds), `vertex_is_constrained_map` (default: none),
///   `density_map` (default: what `set_density()` sets) or `sizing_map` or `sizing_field`,
///   `refinements` and `face_patch_map`, whose values are labels
/// \param report gets the repairs, the seconds, and the number of samples that `options` asks for
/// \param concurrency one of CGAL's concurrency tags; the result is the same with all of them
/// \param work what is done elsewhere: `PowerRTFEngine::surface_work()`
/// \throws Invalid_input_error as `import_surface()`, `set_density()`, `number_of_samples()` and
///   `set_wanted_lengths()`
template <class FaceGraph, class NamedParameters>
Surface prepare_surface(const FaceGraph& mesh, const Remeshing_options& options,
                        const NamedParameters& np, Remeshing_report& report,
                        internal::Concurrency concurrency = Sequential_tag(),
                        const Surface_work& work = {})
{
  Polygon_soup soup;
  Surface_fields fields;
  {
    const internal::Stopwatch watch(report.seconds.surface);
    soup = internal::soup_of_mesh(mesh, np, concurrency);
    fields = internal::surface_fields(mesh, np);
  }
  return prepare_surface(std::move(soup), fields, options, report, concurrency, work);
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
                        internal::Concurrency concurrency = Sequential_tag(),
                        const Surface_work& work = {})
{
  Polygon_soup soup;
  {
    const internal::Stopwatch watch(report.seconds.surface);
    soup = internal::soup_of_ranges(points, polygons);
  }
  return prepare_surface(std::move(soup), Surface_fields(), options, report, concurrency, work);
}

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/prepare_surface_impl.h>
#endif

#endif // CGAL_POWER_RTF_PREPARE_SURFACE_H
