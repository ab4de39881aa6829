// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The named parameters of this package, and those of CGAL's that it takes, in chains of any order:
// `PowerRTF::parameters::random_seed(3).density_map(map).number_of_iterations(50)`. CGAL's own
// chains are closed to parameters that CGAL does not have; `combine()` adds these.
#ifndef CGAL_POWER_RTF_NAMED_PARAMETERS_H
#define CGAL_POWER_RTF_NAMED_PARAMETERS_H

#include <CGAL/PowerRTF/Refinement.h>
#include <CGAL/PowerRTF/Remeshing_options.h>

#include <CGAL/Named_function_parameters.h>

#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

enum density_map_t { density_map };
enum sizing_map_t { sizing_map };
enum sizing_field_t { sizing_field };
enum refinements_t { refinements };
enum remeshing_options_t { remeshing_options };
enum repair_t { repair };
enum symmetry_t { symmetry };
enum region_border_t { region_border };
enum vertex_source_map_t { vertex_source_map };
enum face_source_map_t { face_source_map };
enum corner_source_map_t { corner_source_map };

/// A chain of named parameters that goes on with our own and with those of CGAL's that we take.
template <class T, class Tag, class Base = internal_np::No_property>
struct Named_parameters : Named_function_parameters<T, Tag, Base> {
  using Named_function_parameters<T, Tag, Base>::Named_function_parameters;

  /// The chain with one more parameter.
  template <class Other_tag, class Value>
  Named_parameters<Value, Other_tag, Named_parameters> with(const Value& value) const
  {
    return {value, *this};
  }

  template <class Map>
  auto density_map(const Map& map) const
  {
    return with<density_map_t>(map);
  }
  template <class Map>
  auto sizing_map(const Map& map) const
  {
    return with<sizing_map_t>(map);
  }
  template <class Field>
  auto sizing_field(const Field& field) const
  {
    return with<sizing_field_t>(field);
  }
  auto refinements(const std::vector<Refinement>& regions) const
  {
    return with<refinements_t>(regions);
  }
  auto remeshing_options(const Remeshing_options& options) const
  {
    return with<remeshing_options_t>(options);
  }
  auto repair(bool wanted) const { return with<repair_t>(wanted ? Repair::yes : Repair::no); }
  auto symmetry(Symmetry plane) const { return with<symmetry_t>(plane); }
  auto region_border(Region_border what) const { return with<region_border_t>(what); }
  template <class Map>
  auto vertex_source_map(const Map& map) const
  {
    return with<vertex_source_map_t>(map);
  }
  template <class Map>
  auto face_source_map(const Map& map) const
  {
    return with<face_source_map_t>(map);
  }
  template <class Map>
  auto corner_source_map(const Map& map) const
  {
    return with<corner_source_map_t>(map);
  }

  template <class Map>
  auto vertex_point_map(const Map& map) const
  {
    return with<internal_np::vertex_point_t>(map);
  }
  template <class Map>
  auto edge_is_constrained_map(const Map& map) const
  {
    return with<internal_np::edge_is_constrained_t>(map);
  }
  template <class Map>
  auto vertex_is_constrained_map(const Map& map) const
  {
    return with<internal_np::vertex_is_constrained_t>(map);
  }
  template <class Map>
  auto face_patch_map(const Map& map) const
  {
    return with<internal_np::face_patch_t>(map);
  }
  template <class Traits>
  auto geom_traits(const Traits& traits) const
  {
    return with<internal_np::geom_traits_t>(traits);
  }
  template <class Visitor>
  auto visitor(const Visitor& visitor) const
  {
    return with<internal_np::visitor_t>(visitor);
  }
  auto random_seed(unsigned seed) const { return with<internal_np::random_seed_t>(seed); }
  auto number_of_iterations(int n) const { return with<internal_np::number_of_iterations_t>(n); }
};

/// A chain of one parameter.
template <class Tag, class Value>
Named_parameters<Value, Tag> named_parameter(const Value& value)
{
  return {value};
}

/// Whether a chain has a parameter.
template <class NamedParameters, class Tag>
constexpr bool has_parameter()
{
  using Base = typename NamedParameters::base;
  return !std::is_same<typename internal_np::Get_param<Base, Tag>::type,
                       internal_np::Param_not_found>::value;
}

/// Whether a chain has one of our own parameters about the input.
template <class NamedParameters>
constexpr bool has_input_parameter()
{
  return has_parameter<NamedParameters, density_map_t>() ||
         has_parameter<NamedParameters, sizing_map_t>() ||
         has_parameter<NamedParameters, sizing_field_t>() ||
         has_parameter<NamedParameters, refinements_t>() ||
         has_parameter<NamedParameters, remeshing_options_t>() ||
         has_parameter<NamedParameters, repair_t>() ||
         has_parameter<NamedParameters, symmetry_t>() ||
         has_parameter<NamedParameters, region_border_t>();
}

/// Whether a chain has one of our own parameters about the output.
template <class NamedParameters>
constexpr bool has_output_parameter()
{
  return has_parameter<NamedParameters, vertex_source_map_t>() ||
         has_parameter<NamedParameters, face_source_map_t>() ||
         has_parameter<NamedParameters, corner_source_map_t>();
}

} // namespace internal

/// The named parameters of `power_rtf_remeshing()`. Each begins a chain, in which the others may
/// follow in any order.
namespace parameters {

using CGAL::parameters::default_values;

/// \addtogroup PkgPowerRTFParameters
/// @{

/// The user's own density: a readable property map from the input's vertices to numbers > 0.
template <class DensityMap>
auto density_map(const DensityMap& map)
{
  return internal::named_parameter<internal::density_map_t>(map);
}

/// A sizing field: a readable property map from the input's vertices to the lengths > 0 that edges
/// shall have there, in the input's unit.
template <class SizingMap>
auto sizing_map(const SizingMap& map)
{
  return internal::named_parameter<internal::sizing_map_t>(map);
}

/// The same by a class: a model of `PMPSizingField` of \cgal 6, as `Adaptive_sizing_field`, or any
/// with `at(v, mesh)`.
template <class SizingField>
auto sizing_field(const SizingField& field)
{
  return internal::named_parameter<internal::sizing_field_t>(field);
}

/// Regions where edges shall be shorter.
inline auto refinements(const std::vector<Refinement>& regions)
{
  return internal::named_parameter<internal::refinements_t>(regions);
}

/// All parameters of the method, see `Remeshing_options`.
inline auto remeshing_options(const Remeshing_options& options)
{
  return internal::named_parameter<internal::remeshing_options_t>(options);
}

/// Whether an input that is no 2-manifold is made one (default) or refused.
inline auto repair(bool wanted)
{
  return internal::named_parameter<internal::repair_t>(wanted ? Repair::yes : Repair::no);
}

/// The plane that the output is symmetric about, vertex by vertex: none (default), or across an
/// axis.
inline auto symmetry(Symmetry plane)
{
  return internal::named_parameter<internal::symmetry_t>(plane);
}

/// Whether the border of a region that is remeshed alone stays as it is (default), or gets vertices
/// as far apart as those of the region.
inline auto region_border(Region_border what)
{
  return internal::named_parameter<internal::region_border_t>(what);
}

/// Gets where the vertices of the output come from: a writable property map from them to
/// `Mesh_source` of the input.
template <class VertexSourceMap>
auto vertex_source_map(const VertexSourceMap& map)
{
  return internal::named_parameter<internal::vertex_source_map_t>(map);
}

/// Gets where the faces of the output, their centers, come from: a writable property map from them
/// to `Mesh_source` of the input.
template <class FaceSourceMap>
auto face_source_map(const FaceSourceMap& map)
{
  return internal::named_parameter<internal::face_source_map_t>(map);
}

/// Gets where the corners of the output's faces come from, for values that jump at the constrained
/// edges of the input: a writable property map from the output's halfedges, which stand for the
/// corners at their targets, to `Mesh_source` of the input.
template <class CornerSourceMap>
auto corner_source_map(const CornerSourceMap& map)
{
  return internal::named_parameter<internal::corner_source_map_t>(map);
}

/// The points of the vertices, as in `CGAL::parameters`.
template <class VertexPointMap>
auto vertex_point_map(const VertexPointMap& map)
{
  return internal::named_parameter<internal_np::vertex_point_t>(map);
}

/// The creases of the user's own, as in `CGAL::parameters`.
template <class EdgeIsConstrainedMap>
auto edge_is_constrained_map(const EdgeIsConstrainedMap& map)
{
  return internal::named_parameter<internal_np::edge_is_constrained_t>(map);
}

/// The vertices that stay, as in `CGAL::parameters`.
template <class VertexIsConstrainedMap>
auto vertex_is_constrained_map(const VertexIsConstrainedMap& map)
{
  return internal::named_parameter<internal_np::vertex_is_constrained_t>(map);
}

/// Labels of faces, as in `CGAL::parameters`: those of the input, between which creases are kept;
/// of the output, those, or else the numbers of its patches between creases.
template <class FacePatchMap>
auto face_patch_map(const FacePatchMap& map)
{
  return internal::named_parameter<internal_np::face_patch_t>(map);
}

/// The traits, which name the engine; as in `CGAL::parameters`.
template <class Traits>
auto geom_traits(const Traits& traits)
{
  return internal::named_parameter<internal_np::geom_traits_t>(traits);
}

/// What is told about stages and iterations, and may stop the run; as in `CGAL::parameters`.
template <class Visitor>
auto visitor(const Visitor& visitor)
{
  return internal::named_parameter<internal_np::visitor_t>(visitor);
}

/// The seed of all random choices, as in `CGAL::parameters`.
inline auto random_seed(unsigned seed)
{
  return internal::named_parameter<internal_np::random_seed_t>(seed);
}

/// The largest number of position steps, as in `CGAL::parameters`.
inline auto number_of_iterations(int n)
{
  return internal::named_parameter<internal_np::number_of_iterations_t>(n);
}

/// One chain of two, of CGAL's or of this package. What comes from elsewhere as CGAL's chain gets
/// parameters of this package by `combine(chain, density_map(map))`. Of a parameter that both have,
/// that of `more` counts.
template <class NamedParameters, class T, class Tag, class Base>
auto combine(const NamedParameters& chain, const Named_function_parameters<T, Tag, Base>& more)
{
  if constexpr (std::is_same<Base, internal_np::No_property>::value) {
    return internal::Named_parameters<T, Tag, NamedParameters>(more.v, chain);
  } else {
    const auto longer = combine(chain, static_cast<const Base&>(more));
    return internal::Named_parameters<T, Tag, std::decay_t<decltype(longer)>>(more.v, longer);
  }
}

/// @}

} // namespace parameters
} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_NAMED_PARAMETERS_H
