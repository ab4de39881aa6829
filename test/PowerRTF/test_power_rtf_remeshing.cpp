// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The free function from mesh to mesh: types, point maps, errors. The other files of this program
// call it through one instantiation, that of remesh() below.
#include "mesh_of_shape.h"
#include "remeshed_shape.h"

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/power_rtf_remeshing.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>

#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

using namespace CGAL::PowerRTF;
using namespace remeshed_shape;
using doctest::Approx;
using shapes::Kernel;
using Exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polyhedron = CGAL::Polyhedron_3<shapes::Kernel>;
using shapes::make_mesh;
using shapes::Mesh;
using shapes::soup_of;
namespace params = CGAL::PowerRTF::parameters;

remeshed_shape::Result remeshed_shape::remesh(const Soup& soup, std::size_t n,
                                              const Remeshing_options& options)
{
  const Mesh input = make_mesh(soup);
  Mesh output;
  Result result;
  result.report = CGAL::power_rtf_remeshing(input, n, output, params::remeshing_options(options));
  CHECK(CGAL::is_valid_polygon_mesh(output));
  result.soup = soup_of(output);
  return result;
}

namespace {

/// What a result is made with that single precision will hold.
Remeshing_options single_precision()
{
  Remeshing_options options;
  options.coordinates = Coordinates::single_precision;
  return options;
}

/// Points outside of any mesh, by the number of the vertex; grows when written.
struct Outside_points {
  using key_type = Mesh::Vertex_index;
  using value_type = CGAL::Simple_cartesian<float>::Point_3;
  using reference = value_type;
  using category = boost::read_write_property_map_tag;
  std::vector<value_type>* points;

  friend value_type get(const Outside_points& map, key_type v) { return (*map.points)[v]; }
  friend void put(const Outside_points& map, key_type v, const value_type& p)
  {
    if (map.points->size() <= v) map.points->resize(v + 1);
    (*map.points)[v] = p;
  }
};

} // namespace

TEST_CASE("Surface_mesh to Surface_mesh: the vertices asked for, on the surface")
{
  const Mesh input = make_mesh(ellipsoid());
  Mesh output;
  const Remeshing_report report = CGAL::power_rtf_remeshing(input, 200, output);
  CHECK(num_vertices(output) == 200);
  CHECK(num_faces(output) == 396);
  CHECK(CGAL::is_valid_polygon_mesh(output));
  CHECK(CGAL::is_closed(output));
  CHECK(CGAL::Polygon_mesh_processing::volume(output) ==
        Approx(CGAL::Polygon_mesh_processing::volume(input)).epsilon(0.1));
  check_guarantees(report);
  CHECK_FALSE(report.cancelled);
  CHECK(report.samples_asked == 200);
  CHECK(report.topology.faces == 396);
  CHECK(report.seconds.surface > 0);
  CHECK(report.seconds.total >= report.seconds.surface + report.seconds.optimization);
  const CGAL::PowerRTF::Surface surface = shapes::make_surface(ellipsoid());
  const Facet_tree tree(surface.points, surface.triangles);
  // The improvement leaves the surface by less than the height of an arc over an edge at the tips.
  const double edge2 = 2 / std::sqrt(3.) * surface.area / 200,
               tip_curvature = 1 / (0.4 * 0.4) / surface.normalization.scale,
               arc = edge2 * tip_curvature / 8;
  for (const Vec3d& p : soup_of(output).points)
    CHECK(tree.nearest(surface.normalization.to_inside(p)).squared_distance < arc * arc);

  Remeshing_options options;
  options.improvement = Improvement::no;
  CGAL::power_rtf_remeshing(input, 200, output, params::remeshing_options(options));
  for (const Vec3d& p : soup_of(output).points)
    CHECK(tree.nearest(surface.normalization.to_inside(p)).squared_distance < 1e-28);
}

TEST_CASE("every model of FaceListGraph and MutableFaceGraph gives the same result")
{
  const Mesh input = make_mesh(ellipsoid());
  Mesh expected;
  CGAL::power_rtf_remeshing(input, 150, expected);
  const Soup soup = soup_of(expected);

  SUBCASE("Polyhedron_3 to Polyhedron_3")
  {
    const auto polyhedron = make_mesh<Polyhedron>(ellipsoid());
    Polyhedron output;
    CGAL::power_rtf_remeshing(polyhedron, 150, output);
    CHECK(output.is_valid());
    CHECK(are_equal(soup_of(output), soup));
  }
  SUBCASE("Surface_mesh to Polyhedron_3 of another kernel")
  {
    CGAL::Polyhedron_3<CGAL::Simple_cartesian<double>> output;
    CGAL::power_rtf_remeshing(input, 150, output);
    CHECK(are_equal(soup_of(output), soup));
  }
  SUBCASE("exact constructions")
  {
    using Exact_mesh = CGAL::Surface_mesh<Exact_kernel::Point_3>;
    const auto exact = make_mesh<Exact_mesh>(ellipsoid());
    Exact_mesh output;
    CGAL::power_rtf_remeshing(exact, 150, output);
    CHECK(are_equal(soup_of(output), soup));
  }
  SUBCASE("single precision out")
  {
    CGAL::Surface_mesh<CGAL::Simple_cartesian<float>::Point_3> output;
    CGAL::power_rtf_remeshing(input, 150, output);
    CHECK(soup_of(output).triangles == soup.triangles);
    CHECK(are_equal(soup_of(output), remesh(ellipsoid(), 150, single_precision()).soup));
  }
  SUBCASE("traits by name")
  {
    Mesh output;
    CGAL::power_rtf_remeshing(
        input, 150, output,
        CGAL::parameters::geom_traits(CGAL::PowerRTF_traits_3<Kernel, CGAL::Sequential_tag>()));
    CHECK(are_equal(soup_of(output), soup));
  }
  SUBCASE("into the input itself")
  {
    Mesh mesh = input;
    CGAL::power_rtf_remeshing(mesh, 150, mesh);
    CHECK(are_equal(soup_of(mesh), soup));
  }
  SUBCASE("what the output held is removed, its property maps are not")
  {
    Mesh output = make_mesh(shapes::box(2));
    output.add_property_map<Mesh::Vertex_index, int>("v:own", 7);
    output.remove_face(*faces(output).begin()); // garbage
    CGAL::power_rtf_remeshing(input, 150, output);
    CHECK(are_equal(soup_of(output), soup));
    CHECK(output.properties<Mesh::Vertex_index>().size() ==
          Mesh(output).properties<Mesh::Vertex_index>().size());
    const auto names = output.properties<Mesh::Vertex_index>();
    CHECK(std::find(names.begin(), names.end(), "v:own") != names.end());
  }
}

TEST_CASE("foreign vertex point maps are read and written")
{
  const Mesh expected_input = make_mesh(ellipsoid());
  Mesh expected;
  CGAL::power_rtf_remeshing(expected_input, 150, expected);

  SUBCASE("property maps of the mesh; its own points do not count")
  {
    Mesh input = expected_input;
    auto read = input.add_property_map<Mesh::Vertex_index, Kernel::Point_3>("v:read").first;
    for (const auto v : input.vertices()) {
      read[v] = input.point(v);
      input.point(v) = Kernel::Point_3(0, 0, 0);
    }
    Mesh output;
    auto write = output.add_property_map<Mesh::Vertex_index, Kernel::Point_3>("v:write").first;
    CGAL::power_rtf_remeshing(input, 150, output, CGAL::parameters::vertex_point_map(read),
                              CGAL::parameters::vertex_point_map(write));
    CHECK(are_equal(soup_of(output, write), soup_of(expected)));
  }
  SUBCASE("points outside of the mesh, of another type")
  {
    std::vector<CGAL::Simple_cartesian<float>::Point_3> points_in, points_out;
    Mesh rounded = expected_input;
    for (const auto v : expected_input.vertices()) {
      const auto p = expected_input.point(v);
      points_in.emplace_back(float(p.x()), float(p.y()), float(p.z()));
      const auto& q = points_in.back();
      rounded.point(v) = Kernel::Point_3(q.x(), q.y(), q.z());
    }
    CGAL::power_rtf_remeshing(rounded, 150, expected,
                              params::remeshing_options(single_precision()));
    Mesh input = expected_input, output;
    for (const auto v : input.vertices()) input.point(v) = Kernel::Point_3(0, 0, 0);
    const Remeshing_report report = CGAL::power_rtf_remeshing(
        input, 150, output, CGAL::parameters::vertex_point_map(Outside_points{&points_in}),
        CGAL::parameters::vertex_point_map(Outside_points{&points_out}));
    CHECK(points_out.size() == 150);
    check_guarantees(report);
    CHECK(are_equal(soup_of(output, Outside_points{&points_out}), soup_of(expected)));
  }
}

TEST_CASE("polygons with more than three sides")
{
  std::vector<std::vector<std::size_t>> quads;
  const int nu = 40, nv = 20;
  const auto at = [=](int i, int j) { return std::size_t((i % nu) * nv + j % nv); };
  for (int i = 0; i < nu; ++i)
    for (int j = 0; j < nv; ++j)
      quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  const auto input = make_mesh<Mesh>(shapes::torus(nu, nv, 1, 0.4).points, quads);
  Mesh output;
  const Remeshing_report report = CGAL::power_rtf_remeshing(input, 200, output);
  CHECK(report.repairs.triangulated_polygons == quads.size());
  CHECK(num_vertices(output) == 200);
  CHECK(report.topology.euler_characteristic == 0);
  check_guarantees(report);
}

TEST_CASE("a result that is no 2-manifold is cut up into one")
{
  Remeshing_options options = uniform();
  options.extraction = Extraction_method::restricted_delaunay;
  const Mesh input = make_mesh(shapes::thin_disc(0.02, 10));
  Mesh output;
  const Remeshing_report report = CGAL::power_rtf_remeshing(
      input, 200, output, params::remeshing_options(options).number_of_iterations(10));
  CHECK(CGAL::is_valid_polygon_mesh(output));
  CHECK_FALSE(report.missed_guarantees().empty());
  CHECK(report.topology.non_manifold_edges > 0);
  CHECK(num_faces(output) == report.topology.faces);
  CHECK(num_vertices(output) > report.topology.vertices); // some more than once
}

TEST_CASE("unusable input is refused; the output stays as it was")
{
  Mesh output = make_mesh(shapes::box(2));
  const Soup before = soup_of(output);
  const auto refuse = [&](const Mesh& input, std::size_t n, const auto& np) {
    CHECK_THROWS_AS(CGAL::power_rtf_remeshing(input, n, output, np), Invalid_input_error);
    CHECK(are_equal(soup_of(output), before));
  };
  const auto defaults = CGAL::parameters::default_values();
  const Mesh sphere = make_mesh(shapes::icosphere(2));

  refuse(Mesh(), 100, defaults);
  for (std::size_t n : {0, 1, 3}) refuse(sphere, n, defaults);
  refuse(sphere, std::numeric_limits<std::size_t>::max(), defaults);

  Mesh isolated;
  for (int k = 0; k < 5; ++k) isolated.add_vertex(Kernel::Point_3(k, 0, 0));
  refuse(isolated, 100, defaults);
  for (double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Mesh broken = sphere;
    broken.point(Mesh::Vertex_index(3)) = Kernel::Point_3(0, bad, 0);
    refuse(broken, 100, defaults);
  }
  Mesh flat = sphere;
  for (const auto v : flat.vertices()) flat.point(v) = Kernel::Point_3(flat.point(v).x(), 0, 0);
  refuse(flat, 100, defaults);

  Mesh mesh = sphere;
  auto density = mesh.add_property_map<Mesh::Vertex_index, double>("v:density", 1).first;
  for (double bad : {0., -1., std::numeric_limits<double>::quiet_NaN(),
                     std::numeric_limits<double>::infinity()}) {
    density[Mesh::Vertex_index(5)] = bad;
    refuse(mesh, 100, params::density_map(density));
  }
  Remeshing_options options;
  options.gradation = -1;
  refuse(sphere, 100, params::remeshing_options(options));
}

TEST_CASE("the report tells how many samples were mended, as the cells did not fit")
{
  Remeshing_options options;
  options.density = Density::uniform;
  CHECK(remesh(shapes::icosphere(4), 1000, options).report.mended_samples < 10);
  const Soup thin = shapes::torus(60, 40, 1, 0.1);
  CHECK(remesh(thin, 60, options).report.mended_samples == 60); // all
  std::size_t some = 0;
  for (options.random_seed = 0; options.random_seed < 8; ++options.random_seed)
    some += remesh(thin, 200, options).report.mended_samples;
  CHECK(some > 8 * 2);
  CHECK(some < 8 * 50);
}

TEST_CASE("the report tells how many vertices were changed one place at a time")
{
  Remeshing_options options;
  const std::size_t n = 1000,
                    retouched = remesh(shapes::icosphere(4), n, options).report.retouched_vertices;
  CHECK(retouched > 0);
  CHECK(retouched < n);
  options.improvement = Improvement::no;
  CHECK(remesh(shapes::icosphere(4), n, options).report.retouched_vertices == 0);
}
