// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The package's free function: a mesh and its resolution in, a mesh of well-distributed vertices
// out.
#ifndef CGAL_POWER_RTF_REMESHING_H
#define CGAL_POWER_RTF_REMESHING_H

#include <CGAL/PowerRTF/Resolution.h>
#include <CGAL/PowerRTF/named_parameters.h>
#include <CGAL/PowerRTF/option_table.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF/run_to_edge_length.h>
#include <CGAL/PowerRTF/samples_within_distance.h>
#include <CGAL/PowerRTF/transfer/export_with_sources.h>
#include <CGAL/PowerRTF/transfer/replace_faces.h>
#include <CGAL/PowerRTF_remesher.h>

#include <CGAL/Kernel_traits.h>

#include <cstddef>
#include <type_traits>
#include <utility>

namespace CGAL {

namespace PowerRTF::internal {

/// Whether the coordinates of a point are of type `float`.
template <class Point, class = void>
struct Has_float_coordinates : std::false_type {};
template <class Point>
struct Has_float_coordinates<Point, std::void_t<decltype(std::declval<const Point&>().x())>>
    : std::is_same<std::decay_t<decltype(std::declval<const Point&>().x())>, float> {};

/// What named parameters say about the options; a parameter of its own wins over `options`.
/// \tparam Point of the output
/// \throws Invalid_input_error an option has a value that is not allowed
template <class Point, class NamedParameters>
Remeshing_options options_of(const Resolution& resolution, const NamedParameters& np)
{
  using CGAL::parameters::choose_parameter;
  using CGAL::parameters::get_parameter;
  Remeshing_options options =
      choose_parameter(get_parameter(np, remeshing_options_t()), Remeshing_options());
  resolution.set(options);
  if (Has_float_coordinates<Point>::value) options.coordinates = Coordinates::single_precision;
  options.repair = choose_parameter(get_parameter(np, repair_t()), options.repair);
  options.symmetry = choose_parameter(get_parameter(np, symmetry_t()), options.symmetry);
  options.region_border =
      choose_parameter(get_parameter(np, region_border_t()), options.region_border);
  options.random_seed =
      choose_parameter(get_parameter(np, internal_np::random_seed), options.random_seed);
  options.max_iterations = choose_parameter(get_parameter(np, internal_np::number_of_iterations),
                                            options.max_iterations);
  return validate(options);
}

/// What the named parameters `np` of a run on a mesh of type `InputMesh` choose.
template <class ConcurrencyTag, class InputMesh, class NamedParameters>
struct Run_types {
  using Point_map = typename GetVertexPointMap<InputMesh, NamedParameters>::const_type;
  using Kernel =
      typename Kernel_traits<typename boost::property_traits<Point_map>::value_type>::Kernel;
  using Traits =
      typename internal_np::Lookup_named_param_def<internal_np::geom_traits_t, NamedParameters,
                                                   PowerRTF_traits_3<Kernel, ConcurrencyTag>>::type;
  /// A reference.
  using Visitor =
      typename internal_np::Lookup_named_param_def<internal_np::visitor_t, NamedParameters,
                                                   Remeshing_default_visitor>::reference;
};

/// A run, but for what is made of its result: `use(remesher, mesh, report)` gets that, unless the
/// visitor stops the run. \param prepare `prepare(options, report)` returns the surface
template <class Traits, class Prepare, class Visitor, class Use>
Remeshing_report run(Remeshing_options options, const Prepare& prepare, Visitor& visitor,
                     const Use& use)
{
  Remeshing_report report;
  const auto run = [&] {
    const Stopwatch total(report.seconds.total);
    if (is_distance_asked_for(options))
      options.number_of_samples = samples_within_distance<Traits>(options, prepare, visitor);
    using Remesher = PowerRTF_remesher<Traits>;
    Surface surface = prepare(options, report);
    const auto [remesher, mesh] =
        run_to_edge_length<Remesher>(std::move(surface), options, report, [&visitor](Remesher& r) {
          return r.optimize(visitor) ? r.extract(visitor) : Extracted_mesh();
        });
    report = remesher->report();
    if (!report.cancelled) use(*remesher, mesh, report);
  };
  if (!run_unless_cancelled(visitor, run)) report.cancelled = true;
  return report;
}

} // namespace PowerRTF::internal

/*!
 * \ingroup PkgPowerRTFRef
 *
 * \brief remeshes a surface with well-distributed vertices.
 *
 * The samples are distributed by the power diagram restricted to their tangent planes, as dense as
 * the curvature of the input (or a density of the user's own, or uniformly), and triangulated with
 * the topology of the input.
 *
 * \tparam ConcurrencyTag enables sequential versus parallel algorithm. Possible values are
 *                        `Sequential_tag`, `Parallel_tag`, and `Parallel_if_available_tag`. The
 *                        result is the same bit for bit.
 * \tparam InputMesh a model of `FaceListGraph`
 * \tparam OutputMesh a model of `MutableFaceGraph`
 * \tparam NamedParametersIn a sequence of \ref bgl_namedparameters "Named Parameters"
 * \tparam NamedParametersOut a sequence of \ref bgl_namedparameters "Named Parameters"
 *
 * \param input the surface: a 2-manifold, with or without borders, of one or several components.
 *              Facets with more than three sides are triangulated; facets without area and
 *              isolated vertices are ignored.
 * \param resolution the number of vertices asked for, from 4 to 3e8; or what gives it:
 *                   `PowerRTF::Resolution::edge_length(0.1)`
 * \param output the result. What it held before is removed; property maps added to a
 *               `Surface_mesh` stay. Its vertices come in the order of the samples; should the
 *               samples' triangles form no 2-manifold, some appear again after that. It may be the
 *               same object as `input`.
 * \param np_in an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones
 *              listed below, in any order. The namespace `PowerRTF::parameters` has them all:
 *              `PowerRTF::parameters::random_seed(3).density_map(map)`. To a sequence from
 *              `CGAL::parameters`, which knows \cgal's only, `PowerRTF::parameters::combine()` adds
 *              those of this package.
 *
 * \cgalNamedParamsBegin
 *   \cgalParamNBegin{vertex_point_map}
 *     \cgalParamDescription{a property map associating points to the vertices of `input`}
 *     \cgalParamType{a class model of `ReadablePropertyMap` with
 *                    `boost::graph_traits<InputMesh>::%vertex_descriptor` as key type and a point
 *                    type with members `x()`, `y()` and `z()` as value type}
 *     \cgalParamDefault{`boost::get(CGAL::vertex_point, input)`}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{PowerRTF::parameters::density_map}
 *     \cgalParamDescription{a property map associating densities to the vertices of `input`. Only
 *                           their ratios matter: where the density is 4 times as high, the samples
 *                           are twice as close.}
 *     \cgalParamType{a class model of `ReadablePropertyMap` with
 *                    `boost::graph_traits<InputMesh>::%vertex_descriptor` as key type and a
 *                    positive number as value type}
 *     \cgalParamDefault{the density that `PowerRTF::Remeshing_options::density` names}
 *     \cgalParamExtra{Its growth is limited by `PowerRTF::Remeshing_options::gradation`.}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{PowerRTF::parameters::sizing_map}
 *     \cgalParamDescription{a sizing field, instead of a density: a property map associating to the
 *                           vertices of `input` the lengths that edges shall have there. With
 *                           `PowerRTF::Resolution::size_factor()` they give the number of vertices,
 *                           too; with another resolution only their ratios matter.}
 *     \cgalParamType{a class model of `ReadablePropertyMap` with
 *                    `boost::graph_traits<InputMesh>::%vertex_descriptor` as key type and a
 *                    positive number as value type}
 *     \cgalParamDefault{none: densities say where edges are shorter}
 *     \cgalParamExtra{The growth of the lengths is limited by
 *                     `PowerRTF::Remeshing_options::gradation`. They are linear on the facets of
 *                     `input`.}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{PowerRTF::parameters::sizing_field}
 *     \cgalParamDescription{the same, instead of `sizing_map`, by an object whose `at(v, input)` is
 *                           the length at a vertex: of any model of `PMPSizingField` of \cgal 6, as
 *                           `CGAL::Polygon_mesh_processing::Adaptive_sizing_field`}
 *     \cgalParamType{a copyable class with such a function, `v` being a
 *                    `boost::graph_traits<InputMesh>::%vertex_descriptor`}
 *     \cgalParamDefault{none}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{PowerRTF::parameters::refinements}
 *     \cgalParamDescription{regions where edges are to be no longer than a given length. If
 *                           `resolution` is an edge length, it is that of the rest; if it is a
 *                           number, that is kept, and the rest is coarser.}
 *     \cgalParamType{`std::vector<PowerRTF::Refinement>`}
 *     \cgalParamDefault{none}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{PowerRTF::parameters::remeshing_options}
 *     \cgalParamDescription{all parameters of the method;
 *                           `PowerRTF::Remeshing_options::of()` gives those of a preset}
 *     \cgalParamType{`PowerRTF::Remeshing_options`}
 *     \cgalParamDefault{`PowerRTF::Remeshing_options()`, the preset `quality`}
 *     \cgalParamExtra{Its members that ask for a resolution are not used.}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{PowerRTF::parameters::repair}
 *     \cgalParamDescription{if `true`, an input that is no 2-manifold is made one where that does
 *                           not change its shape: sheets that touch in a vertex are parted, facets
 *                           without area removed. If `false`, it is refused.}
 *     \cgalParamType{Boolean}
 *     \cgalParamDefault{`true`}
 *     \cgalParamExtra{What was repaired is counted in `PowerRTF::Remeshing_report::repairs`.}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{PowerRTF::parameters::symmetry}
 *     \cgalParamDescription{a plane across an axis, that one or the one that fits best: the result
 *                           is its own mirror image about it, vertex by vertex, and the plane's
 *                           curve is a line of vertices}
 *     \cgalParamType{`PowerRTF::Symmetry`}
 *     \cgalParamDefault{`PowerRTF::Remeshing_options::symmetry`, none}
 *     \cgalParamExtra{`input` has to be symmetric within half the spacing of the vertices.}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{PowerRTF::parameters::region_border}
 *     \cgalParamDescription{for the second function, which remeshes a part: whether its border
 *                           stays as it is, or gets vertices as far apart as those of the part}
 *     \cgalParamType{`PowerRTF::Region_border`}
 *     \cgalParamDefault{`PowerRTF::Remeshing_options::region_border`, `keep`}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{edge_is_constrained_map}
 *     \cgalParamDescription{a property map that names the creases: the result keeps them as chains
 *                           of edges, and their ends and corners as vertices}
 *     \cgalParamType{a class model of `ReadablePropertyMap` with
 *                    `boost::graph_traits<InputMesh>::%edge_descriptor` as key type and `bool` as
 *                    value type}
 *     \cgalParamDefault{the edges that `PowerRTF::Remeshing_options::feature_angle` finds}
 *     \cgalParamExtra{Borders are always kept.}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{vertex_is_constrained_map}
 *     \cgalParamDescription{a property map that names vertices that stay: the result has vertices
 *                           at exactly these points, on creases and borders or off them. They
 *                           count among those asked for.}
 *     \cgalParamType{a class model of `ReadablePropertyMap` with
 *                    `boost::graph_traits<InputMesh>::%vertex_descriptor` as key type and `bool` as
 *                    value type}
 *     \cgalParamDefault{none: only corners of creases and borders stay}
 *     \cgalParamExtra{Not with `symmetry`.}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{face_patch_map}
 *     \cgalParamDescription{labels of the faces, of any kind: between different ones the result
 *                           keeps creases, beside those that are found or constrained}
 *     \cgalParamType{a class model of `ReadablePropertyMap` with
 *                    `boost::graph_traits<InputMesh>::%face_descriptor` as key type and a value
 *                    type with `operator<`}
 *     \cgalParamDefault{none: all faces are alike}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{random_seed}
 *     \cgalParamDescription{the seed of the initial sampling. The same seed gives the same result.}
 *     \cgalParamType{`unsigned int`}
 *     \cgalParamDefault{`PowerRTF::Remeshing_options::random_seed`, 0}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{number_of_iterations}
 *     \cgalParamDescription{the largest number of position steps}
 *     \cgalParamType{`int`}
 *     \cgalParamDefault{`PowerRTF::Remeshing_options::max_iterations`, 100}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{visitor}
 *     \cgalParamDescription{is told about stages and iterations, and may stop the run}
 *     \cgalParamType{a class with the members of `PowerRTF::Remeshing_default_visitor`, or a
 *                    `std::reference_wrapper` to one: it keeps what it has seen}
 *     \cgalParamDefault{`PowerRTF::Remeshing_default_visitor`}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{geom_traits}
 *     \cgalParamDescription{an instance of a geometric traits class; it names the engine}
 *     \cgalParamType{a class model of `PowerRTFTraits_3`}
 *     \cgalParamDefault{`PowerRTF_traits_3<Kernel, ConcurrencyTag>`, with a \cgal kernel deduced
 *                       from the point type of `input`}
 *   \cgalParamNEnd
 * \cgalNamedParamsEnd
 *
 * \param np_out an optional sequence of \ref bgl_namedparameters "Named Parameters" among the ones
 *               listed below
 *
 * \cgalNamedParamsBegin
 *   \cgalParamNBegin{vertex_point_map}
 *     \cgalParamDescription{a property map associating points to the vertices of `output`}
 *     \cgalParamType{a class model of `WritablePropertyMap` with
 *                    `boost::graph_traits<OutputMesh>::%vertex_descriptor` as key type and a point
 *                    type that is constructible from three coordinates as value type}
 *     \cgalParamDefault{`boost::get(CGAL::vertex_point, output)`}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{PowerRTF::parameters::vertex_source_map}
 *     \cgalParamDescription{a property map that gets where the vertices of `output` come from: the
 *                           nearest place of `input`, on which they lie but for the improvement,
 *                           which moves them a little off it. With it
 *                           `PowerRTF::transfer_vertex_values()` interpolates any values of the
 *                           vertices of `input`.}
 *     \cgalParamType{a class model of `WritablePropertyMap` with
 *                    `boost::graph_traits<OutputMesh>::%vertex_descriptor` as key type and
 *                    `PowerRTF::Mesh_source<InputMesh>` as value type}
 *     \cgalParamDefault{none: nothing is looked for}
 *     \cgalParamExtra{If `output` is the same object as `input`, the sources have the descriptors
 *                     of elements that are no more.}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{PowerRTF::parameters::face_source_map}
 *     \cgalParamDescription{the same for the centers of the faces of `output`, with the faces under
 *                           other points of them, for `PowerRTF::transfer_face_values()`}
 *     \cgalParamType{a class model of `WritablePropertyMap` with
 *                    `boost::graph_traits<OutputMesh>::%face_descriptor` as key type and
 *                    `PowerRTF::Mesh_source<InputMesh>` as value type}
 *     \cgalParamDefault{none: nothing is looked for}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{PowerRTF::parameters::corner_source_map}
 *     \cgalParamDescription{the same for the corners of the faces of `output`, as halfedges that
 *                           end there, each on its face's side of the constrained edges of
 *                           `input`; for `PowerRTF::transfer_corner_values()`, as of texture
 *                           coordinates}
 *     \cgalParamType{a class model of `WritablePropertyMap` with
 *                    `boost::graph_traits<OutputMesh>::%halfedge_descriptor` as key type and
 *                    `PowerRTF::Mesh_source<InputMesh>` as value type}
 *     \cgalParamDefault{none: nothing is looked for}
 *   \cgalParamNEnd
 *
 *   \cgalParamNBegin{face_patch_map}
 *     \cgalParamDescription{a property map that gets the labels of the faces of `output`: those of
 *                           `input`, if the parameter of the same name is in `np_in`; else the
 *                           number of the patch, between creases and borders, that a face is on}
 *     \cgalParamType{a class model of `WritablePropertyMap` with
 *                    `boost::graph_traits<OutputMesh>::%face_descriptor` as key type and such
 *                    labels, or `int`, as value type}
 *     \cgalParamDefault{none}
 *   \cgalParamNEnd
 * \cgalNamedParamsEnd
 *
 * \returns what was done and what the result is worth. `missed_guarantees()` is empty when the
 *          result has exactly the vertices asked for, is a 2-manifold with the components, borders
 *          and Euler characteristic of the input, keeps its creases and borders as edges, does
 *          not intersect itself, and keeps the bounds and the symmetry that are asked for.
 *          When the visitor stopped the run, `cancelled` is `true` and `output` is as it was.
 *
 * \throws PowerRTF::Invalid_input_error the input has no facet, no area, a coordinate that is not
 *         finite or is no 2-manifold; a density or a wanted edge length is not a positive, finite
 *         number; the samples are too few for the surface, or for the lengths; the surface is not
 *         as symmetric as it has to be; `resolution` or an option has a value that is not allowed
 *         (the message says what is). `output` is as it was.
 */
template <class ConcurrencyTag = Parallel_if_available_tag, class InputMesh, class OutputMesh,
          class NamedParametersIn = parameters::Default_named_parameters,
          class NamedParametersOut = parameters::Default_named_parameters>
PowerRTF::Remeshing_report
power_rtf_remeshing(const InputMesh& input, const PowerRTF::Resolution& resolution,
                    OutputMesh& output,
                    const NamedParametersIn& np_in = parameters::default_values(),
                    const NamedParametersOut& np_out = parameters::default_values())
{
  static_assert(!PowerRTF::internal::has_output_parameter<NamedParametersIn>(),
                "vertex_source_map, face_source_map and corner_source_map belong into the second "
                "chain of named parameters");
  static_assert(
      !PowerRTF::internal::has_input_parameter<NamedParametersOut>(),
      "density_map, sizing_map, sizing_field, refinements, remeshing_options, repair, symmetry and "
      "region_border belong into the first chain of named parameters; one that began in "
      "CGAL::parameters takes them by PowerRTF::parameters::combine(chain, density_map(map))");
  using Types = PowerRTF::internal::Run_types<ConcurrencyTag, InputMesh, NamedParametersIn>;
  using Output_map = typename GetVertexPointMap<OutputMesh, NamedParametersOut>::type;
  using Output_point = typename boost::property_traits<Output_map>::value_type;
  const PowerRTF::Remeshing_options options =
      PowerRTF::internal::options_of<Output_point>(resolution, np_in);
  PowerRTF::Remeshing_default_visitor default_visitor;
  typename Types::Visitor visitor = parameters::choose_parameter(
      parameters::get_parameter_reference(np_in, internal_np::visitor), default_visitor);
  const auto prepare = [&](const PowerRTF::Remeshing_options& o, PowerRTF::Remeshing_report& r) {
    const PowerRTF::internal::Stage stage("surface");
    return PowerRTF::prepare_surface(input, o, np_in, r, ConcurrencyTag(),
                                     Types::Traits::Engine::surface_work(o));
  };
  return PowerRTF::internal::run<typename Types::Traits>(
      options, prepare, visitor,
      [&](auto& remesher, const PowerRTF::Extracted_mesh& mesh,
          PowerRTF::Remeshing_report& report) {
        PowerRTF::internal::export_with_sources(
            input, np_in, mesh, remesher.surface().normalization,
            [&] { return remesher.patches(mesh); }, output, np_out, report, ConcurrencyTag(),
            [&](PowerRTF::Triangle_links& links) {
              const auto there = mesh.there(remesher.mesh_bringer());
              return there && there->topology(&links);
            });
      });
}

/*!
 * \ingroup PkgPowerRTFRef
 *
 * \brief remeshes a part of a mesh in place; the rest stays as it is.
 *
 * The edges between the part and the rest stay, too, and the new faces are joined to them; with
 * `PowerRTF::Region_border::remesh` they give way to edges as long as those of the part, and the
 * faces of the rest at the vertices that come and go to others. From there the lengths of the new
 * edges grow or shrink to those elsewhere, by no more than
 * `PowerRTF::Remeshing_options::gradation`, or as slowly as the number of vertices allows. What is
 * border of the mesh in the part is remeshed with it.
 *
 * \tparam ConcurrencyTag as of the function above
 * \tparam FaceRange a range of `boost::graph_traits<PolygonMesh>::%face_descriptor`, whose
 *                   iterator type is a model of `ForwardIterator`
 * \tparam PolygonMesh a model of `MutableFaceGraph`
 * \tparam NamedParameters a sequence of \ref bgl_namedparameters "Named Parameters"
 *
 * \param faces those to be remeshed, in any order. All of `mesh` are allowed, too.
 * \param mesh the whole mesh. The other faces, their vertices and edges remain the same elements
 *             with the same points and values of property maps; but for those that change with the
 *             border.
 * \param resolution the number of vertices that the part shall have, those on its border
 *                   included; or what gives it
 * \param np those of the first sequence of the function above, with the same defaults. The map
 *           `face_patch_map` has to be writable, too: the new faces get the labels of the old ones
 *           that they lie on. `vertex_point_map` gets the points of the new vertices.
 *
 * \returns what was done and what the new faces are worth: `report.topology` and all other figures
 *          are those of the part alone; `kept_faces` and `kept_vertices` tell of the rest. Among
 *          the self-intersections are those of new faces with old ones. When the visitor stopped
 *          the run, `cancelled` is `true` and `mesh` is as it was.
 *
 * \throws PowerRTF::Invalid_input_error `faces` is empty; and as the function above, of the part.
 *         The samples are too few for the vertices on its border. The border is to be remeshed,
 *         and `resolution` is a largest distance. `mesh` is as it was.
 */
template <class ConcurrencyTag = Parallel_if_available_tag, class FaceRange, class PolygonMesh,
          class NamedParameters = parameters::Default_named_parameters>
PowerRTF::Remeshing_report
power_rtf_remeshing(const FaceRange& faces, PolygonMesh& mesh,
                    const PowerRTF::Resolution& resolution,
                    const NamedParameters& np = parameters::default_values())
{
  static_assert(!PowerRTF::internal::has_output_parameter<NamedParameters>(),
                "there are no maps of sources here: they would have the descriptors of elements "
                "that are no more");
  using Types = PowerRTF::internal::Run_types<ConcurrencyTag, PolygonMesh, NamedParameters>;
  using Point_map = typename GetVertexPointMap<PolygonMesh, NamedParameters>::type;
  using Point = typename boost::property_traits<Point_map>::value_type;
  const PowerRTF::Remeshing_options options = PowerRTF::internal::options_of<Point>(resolution, np);
  PowerRTF::Remeshing_default_visitor default_visitor;
  typename Types::Visitor visitor = parameters::choose_parameter(
      parameters::get_parameter_reference(np, internal_np::visitor), default_visitor);

  const PowerRTF::Polygon_soup whole = PowerRTF::internal::soup_of_mesh(mesh, np, ConcurrencyTag());
  const PowerRTF::internal::Remeshed_region region(
      whole, PowerRTF::internal::marks_of_faces(mesh, faces),
      PowerRTF::internal::surface_fields(mesh, np), options, ConcurrencyTag());
  const auto prepare = [&](const PowerRTF::Remeshing_options& o, PowerRTF::Remeshing_report& r) {
    const PowerRTF::internal::Stage stage("surface");
    return PowerRTF::prepare_surface(PowerRTF::Polygon_soup(region.soup()), region.fields(), o, r,
                                     ConcurrencyTag(), Types::Traits::Engine::surface_work(o));
  };
  return PowerRTF::internal::run<typename Types::Traits>(
      options, prepare, visitor,
      [&](const auto& remesher, const PowerRTF::Extracted_mesh& part,
          PowerRTF::Remeshing_report& report) {
        PowerRTF::internal::replace_region(mesh, np, whole, region, part,
                                           remesher.surface().normalization, report,
                                           ConcurrencyTag());
      });
}

} // namespace CGAL

#endif // CGAL_POWER_RTF_REMESHING_H
