// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The free function from mesh to mesh: types, named parameters, errors, invariance, guarantees.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include "shapes.h"

#include <CGAL/power_rtf_remeshing.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <doctest/doctest.h>

#include <chrono>
#include <functional>
#include <limits>
#include <string>
#include <thread>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using shapes::Soup;
namespace params = CGAL::PowerRTF::parameters;

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;

template <class Mesh, class Polygons>
Mesh make_mesh(const std::vector<Vec3d>& points, const Polygons& polygons)
{
  using Map = typename boost::property_map<Mesh, CGAL::vertex_point_t>::type;
  using Point = typename boost::property_traits<Map>::value_type;
  std::vector<Point> converted;
  for (const Vec3d& p : points) converted.emplace_back(p.x, p.y, p.z);
  Mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(converted, polygons, mesh);
  return mesh;
}

template <class Mesh = ::Mesh>
Mesh make_mesh(const Soup& soup)
{
  return make_mesh<Mesh>(soup.points, soup.triangles);
}

/// The mesh in the order of its vertices and facets.
template <class Mesh, class PointMap>
Soup soup_of(const Mesh& mesh, const PointMap& point_map)
{
  Soup soup;
  std::map<typename boost::graph_traits<Mesh>::vertex_descriptor, int> index;
  for (const auto v : vertices(mesh)) {
    index[v] = int(soup.points.size());
    soup.points.push_back(internal::to_vec3d(get(point_map, v)));
  }
  for (const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    soup.triangles.push_back({index.at(source(h, mesh)), index.at(target(h, mesh)),
                              index.at(target(next(h, mesh), mesh))});
  }
  return soup;
}

template <class Mesh>
Soup soup_of(const Mesh& mesh)
{
  return soup_of(mesh, get(CGAL::vertex_point, mesh));
}

bool are_equal(const Soup& a, const Soup& b)
{
  return a.points == b.points && a.triangles == b.triangles;
}

double largest_distance(const Soup& a, const Soup& b)
{
  REQUIRE(a.points.size() == b.points.size());
  double largest = 0;
  for (std::size_t v = 0; v < a.points.size(); ++v)
    largest = std::max(largest, length(a.points[v] - b.points[v]));
  return largest;
}

double diagonal(const Soup& s)
{
  Vec3d lo = s.points[0], hi = lo;
  for (const Vec3d& p : s.points) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
  }
  return length(hi - lo);
}

Remeshing_options uniform()
{
  Remeshing_options options;
  options.density = Density::uniform;
  return options;
}

struct Result {
  Soup soup;
  Remeshing_report report;
};

Result remesh(const Soup& soup, std::size_t n, const Remeshing_options& options = {})
{
  const Mesh input = make_mesh(soup);
  Mesh output;
  Result result;
  result.report =
      CGAL::power_rtf_remeshing(input, n, output, params::remeshing_options(options));
  CHECK(CGAL::is_valid_polygon_mesh(output));
  result.soup = soup_of(output);
  return result;
}

const Soup& torus()
{
  static const Soup soup = shapes::torus(60, 30, 1, 0.4);
  return soup;
}

const Soup& ellipsoid()
{
  static const Soup soup = shapes::ellipsoid(1, 0.7, 0.4, 3);
  return soup;
}

/// All that is promised is met; the message of a failure names what is not.
void check_guarantees(const Remeshing_report& report)
{
  std::string missed;
  for (const std::string& guarantee : report.missed_guarantees()) missed += guarantee + "; ";
  CHECK(missed == "");
}

struct Counting_visitor : Remeshing_default_visitor {
  std::vector<std::string> stages;
  int iterations = 0, stop_after = std::numeric_limits<int>::max();
  double last_progress = 0;
  bool grows = true;

  void on_stage(const char* name) { stages.push_back(name); }
  void on_iteration(const Iteration_report& iteration, double progress)
  {
    ++iterations;
    grows = grows && progress > last_progress && iteration.constructions >= std::size_t(iterations);
    last_progress = progress;
  }
  bool go_further() { return iterations < stop_after; }
};

/// Stops in the middle of a stage: the 50 ms after which it is asked have passed when it begins.
struct Stopping_visitor : Remeshing_default_visitor {
  std::string stage;
  bool stops = false;

  void on_stage(const char* name)
  {
    if (name != stage) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    stops = true;
  }
  bool go_further() const { return !stops; }
};

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

// --- types ---------------------------------------------------------------------------------------

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
  const double h = std::sqrt(surface.area / 200);
  for (const Vec3d& p : soup_of(output).points) // the improvement leaves the surface a little
    CHECK(tree.nearest(surface.normalization.to_inside(p)).squared_distance < 0.01 * h * h);

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
    CHECK(largest_distance(soup_of(output), soup) < 1e-6);
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
    for (const auto v : expected_input.vertices()) {
      const auto p = expected_input.point(v);
      points_in.emplace_back(float(p.x()), float(p.y()), float(p.z()));
    }
    Mesh input = expected_input, output;
    for (const auto v : input.vertices()) input.point(v) = Kernel::Point_3(0, 0, 0);
    const Remeshing_report report = CGAL::power_rtf_remeshing(
        input, 150, output, CGAL::parameters::vertex_point_map(Outside_points{&points_in}),
        CGAL::parameters::vertex_point_map(Outside_points{&points_out}));
    CHECK(points_out.size() == 150);
    check_guarantees(report);
    CHECK(largest_distance(soup_of(output, Outside_points{&points_out}), soup_of(expected)) <
          0.05); // single precision may lead elsewhere, but not far
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

// --- named parameters ----------------------------------------------------------------------------

TEST_CASE("seeds, threads and chains")
{
  const Mesh input = make_mesh(torus());
  const auto remeshed = [&](auto tag, const auto& np)
  {
    Mesh output;
    CGAL::power_rtf_remeshing<decltype(tag)>(input, 200, output, np);
    return soup_of(output);
  };
  for (unsigned seed : {0u, 7u, 4294967295u}) {
    CAPTURE(seed);
    const auto np = CGAL::parameters::random_seed(seed);
    const Soup sequential = remeshed(CGAL::Sequential_tag(), np);
    CHECK(are_equal(sequential, remeshed(CGAL::Sequential_tag(), np)));
    CHECK(are_equal(sequential, remeshed(CGAL::Parallel_tag(), np)));
    CHECK(are_equal(sequential, remeshed(CGAL::Parallel_if_available_tag(), np)));
    Remeshing_options options;
    options.random_seed = seed;
    CHECK(are_equal(sequential,
                         remeshed(CGAL::Sequential_tag(), params::remeshing_options(options))));
    options.random_seed = 99; // the parameter's own name wins
    CHECK(are_equal(sequential,
                         remeshed(CGAL::Sequential_tag(),
                                  params::remeshing_options(options).random_seed(seed))));
    CHECK_FALSE(are_equal(
        sequential, remeshed(CGAL::Sequential_tag(), CGAL::parameters::random_seed(seed + 1))));
  }
}

TEST_CASE("number_of_samples of the options is not used; number_of_iterations is a name of its own")
{
  const Mesh input = make_mesh(torus());
  Mesh output;
  Remeshing_options options;
  options.number_of_samples = 5000;
  options.relaxation_iterations = 3;
  const Remeshing_report report = CGAL::power_rtf_remeshing(
      input, 120, output, params::remeshing_options(options).number_of_iterations(4));
  CHECK(num_vertices(output) == 120);
  CHECK(report.outer_iterations == 7);
  CHECK(report.iterations.size() == 7);
}

TEST_CASE("the user's own density")
{
  const Mesh input = make_mesh(shapes::icosphere(4));
  Mesh mesh = input, output;
  auto density = mesh.add_property_map<Mesh::Vertex_index, double>("v:density", 1).first;
  for (const auto v : mesh.vertices())
    if (mesh.point(v).z() > 0) density[v] = 9;
  const auto share_above = [](const Mesh& m)
  {
    double above = 0;
    for (const auto v : m.vertices()) above += m.point(v).z() > 0;
    return above / num_vertices(m);
  };
  Remeshing_options options;
  options.gradation = 0;

  // The masses above and below are as 9 to 1.
  const Remeshing_report report = CGAL::power_rtf_remeshing(
      mesh, 500, output, params::density_map(density).remeshing_options(options).random_seed(1));
  CHECK(share_above(output) == Approx(0.9).epsilon(0.03));
  check_guarantees(report);
  const Soup expected = soup_of(output);

  // Any order of the parameters, any number type, and only ratios matter.
  const auto check_same = [&](const auto& np) {
    CGAL::power_rtf_remeshing(mesh, 500, output, np);
    CHECK(are_equal(soup_of(output), expected));
  };
  check_same(params::remeshing_options(options).density_map(density).random_seed(1));
  check_same(params::random_seed(1).remeshing_options(options).density_map(density));
  check_same(params::combine(CGAL::parameters::random_seed(1),
                             params::density_map(density).remeshing_options(options)));
  auto exact = mesh.add_property_map<Mesh::Vertex_index, Exact_kernel::FT>("v:exact").first;
  for (const auto v : mesh.vertices()) exact[v] = 1024 * density[v];
  CGAL::power_rtf_remeshing(
      mesh, 500, output, params::density_map(exact).remeshing_options(options).random_seed(1));
  CHECK(are_equal(soup_of(output), expected));

  // Gradation spreads the step; without a map the sphere is uniform.
  CGAL::power_rtf_remeshing(mesh, 500, output, params::density_map(density));
  CHECK(share_above(output) < 0.88);
  CHECK(share_above(output) > 0.6);
  CGAL::power_rtf_remeshing(mesh, 500, output);
  CHECK(share_above(output) == Approx(0.5).epsilon(0.06));

  // On a Polyhedron_3.
  const auto polyhedron = make_mesh<Polyhedron>(shapes::icosphere(4));
  auto on_polyhedron = get(CGAL::dynamic_vertex_property_t<double>(), polyhedron);
  for (const auto v : vertices(polyhedron)) put(on_polyhedron, v, v->point().z() > 0 ? 9 : 1);
  CGAL::power_rtf_remeshing(
      polyhedron, 500, output,
      params::density_map(on_polyhedron).remeshing_options(options).random_seed(1));
  CHECK(are_equal(soup_of(output), expected));
}

TEST_CASE("the visitor sees stages and iterations")
{
  const Mesh input = make_mesh(torus());
  Mesh output;
  Counting_visitor visitor;
  const Remeshing_report report = CGAL::power_rtf_remeshing(
      input, 120, output, CGAL::parameters::visitor(std::ref(visitor)).number_of_iterations(20));
  CHECK(visitor.stages == std::vector<std::string>{"surface", "sampling", "optimization",
                                                   "extraction", "improvement", "quality"});
  CHECK(visitor.iterations == int(report.outer_iterations));
  CHECK(visitor.grows);
  CHECK(visitor.last_progress == Approx(1));

  Counting_visitor copied; // by value: the copy counts
  CGAL::power_rtf_remeshing(input, 120, output, CGAL::parameters::visitor(copied));
  CHECK(copied.iterations == 0);
}

TEST_CASE("cancellation leaves the output as it was")
{
  const Mesh input = make_mesh(torus());
  for (int stop_after : {0, 1, 13}) {
    CAPTURE(stop_after);
    Mesh output = make_mesh(shapes::box(2));
    const Soup before = soup_of(output);
    Counting_visitor visitor;
    visitor.stop_after = stop_after;
    const Remeshing_report report = CGAL::power_rtf_remeshing(
        input, 120, output, params::remeshing_options(uniform()).visitor(std::ref(visitor)));
    CHECK(report.cancelled);
    CHECK(int(report.outer_iterations) == visitor.iterations);
    if (stop_after == 0) { // asked after the first iteration at the latest
      CHECK(visitor.iterations <= 1);
    } else {
      CHECK(visitor.iterations == stop_after);
      CHECK(visitor.stages.back() == "optimization");
    }
    CHECK(are_equal(soup_of(output), before));
  }
}

// --- errors --------------------------------------------------------------------------------------

TEST_CASE("a visitor stops the run in the middle of every stage; the output stays as it was")
{
  const Mesh input = make_mesh(ellipsoid());
  for (const char* stage :
       {"surface", "sampling", "optimization", "extraction", "improvement", "quality"}) {
    CAPTURE(stage);
    Stopping_visitor visitor;
    visitor.stage = stage;
    Mesh output = make_mesh(shapes::tetrahedron());
    const Remeshing_report report = CGAL::power_rtf_remeshing(
        input, 500, output, CGAL::parameters::visitor(std::ref(visitor)));
    CHECK(visitor.stops);
    CHECK(report.cancelled);
    CHECK(num_vertices(output) == 4);
  }
}

TEST_CASE("unusable input is refused; the output stays as it was")
{
  Mesh output = make_mesh(shapes::box(2));
  const Soup before = soup_of(output);
  const auto refuse = [&](const Mesh& input, std::size_t n, const auto& np)
  {
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
  for (double bad : {std::numeric_limits<double>::quiet_NaN(),
                     std::numeric_limits<double>::infinity()}) {
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

TEST_CASE("the smallest numbers of samples")
{
  for (std::size_t n : {4, 5, 6, 12}) {
    CAPTURE(n);
    const Result result = remesh(shapes::icosphere(3), n, uniform());
    CHECK(result.soup.points.size() == n);
    CHECK(result.soup.triangles.size() == 2 * n - 4);
  }
}

// --- invariance ----------------------------------------------------------------------------------

namespace
{

/// How far rounding may move a vertex, in units of the input: the improvement decides by
/// comparisons, which amplify it.
double rounding(Improvement improvement) { return improvement == Improvement::no ? 1e-5 : 0.01; }

Remeshing_options with(Density density, Improvement improvement)
{
  Remeshing_options options;
  options.density = density;
  options.improvement = improvement;
  return options;
}

} // namespace

TEST_CASE("scaling the input changes no triangle")
{
  for (const Soup& soup : {torus(), ellipsoid()})
    for (Density density : {Density::uniform, Density::curvature})
      for (Improvement improvement : {Improvement::no, Improvement::yes}) {
        const Remeshing_options options = with(density, improvement);
        const Soup expected = remesh(soup, 300, options).soup;
        for (double factor : {1000., 0.001}) {
          CAPTURE(factor);
          const Soup scaled = remesh(shapes::scaled(soup, factor), 300, options).soup;
          CHECK(shapes::sorted(scaled.triangles) == shapes::sorted(expected.triangles));
          CHECK(largest_distance(scaled, shapes::scaled(expected, factor)) <
                rounding(improvement) * factor);
        }
        for (double factor : {1024., 1 / 4096.}) { // a power of two rounds nothing
          CAPTURE(factor);
          CHECK(are_equal(remesh(shapes::scaled(soup, factor), 300, options).soup,
                          shapes::scaled(expected, factor)));
        }
      }
}

TEST_CASE("moving the input by 1000 diagonals changes the result by rounding only")
{
  for (const Soup& soup : {torus(), ellipsoid()})
    for (Improvement improvement : {Improvement::no, Improvement::yes}) {
      const Remeshing_options options = with(Density::curvature, improvement);
      const Soup expected = remesh(soup, 300, options).soup;
      const Vec3d far = 1000 * diagonal(soup) * normalized(Vec3d{1, -2, 0.5});
      const Soup moved = remesh(shapes::translated(soup, far), 300, options).soup;
      CHECK(shapes::sorted(moved.triangles) == shapes::sorted(expected.triangles));
      CHECK(largest_distance(moved, shapes::translated(expected, far)) < rounding(improvement));
    }
}

TEST_CASE("turning the input or renumbering it leaves the quality as it is")
{
  for (const Soup& soup : {torus(), ellipsoid()}) {
    const Remeshing_report expected = remesh(soup, 300).report;
    for (const Soup& other :
         {shapes::rotated(soup, 1), shapes::rotated(soup, 2, {1, 0, 0}), shapes::permuted(soup, 5)}) {
      const Remeshing_report report = remesh(other, 300).report;
      check_guarantees(report);
      CHECK(report.quality.q_avg == Approx(expected.quality.q_avg).epsilon(0.02));
      CHECK(report.quality.q_min > 0.58);
      CHECK(report.distance.mean == Approx(expected.distance.mean).epsilon(0.1));
      CHECK(report.capacity.inside_interval == 1);
    }
  }
}

// --- what the result is worth --------------------------------------------------------------------

TEST_CASE("closed shapes: guarantees, quality and equal capacities")
{
  struct Case {
    const char* name;
    Soup soup;
    double q_min, q_avg, theta_min;
  };
  const Case cases[] = {{"sphere", shapes::icosphere(4), 0.6, 0.91, 34},
                        {"torus", torus(), 0.58, 0.91, 33},
                        {"ellipsoid", ellipsoid(), 0.58, 0.9, 32},
                        {"two spheres", shapes::two_spheres(3), 0.58, 0.9, 33},
                        {"box", shapes::box(8), 0.4, 0.85, 22}};
  for (const Case& c : cases)
    for (Density density : {Density::uniform, Density::curvature})
      for (unsigned seed : {0u, 1u}) {
        CAPTURE(c.name);
        CAPTURE(int(density));
        CAPTURE(seed);
        Remeshing_options options;
        options.density = density;
        options.random_seed = seed;
        const Remeshing_report report = remesh(c.soup, 400, options).report;
        check_guarantees(report);
        CHECK(report.quality.q_min > c.q_min);
        CHECK(report.quality.q_avg > c.q_avg);
        CHECK(report.quality.theta_min > c.theta_min);
        CHECK(report.capacity.inside_interval == 1);
        CHECK(report.capacity.largest_deviation <= 0.04);
        CHECK(report.cells.ok + report.cells.guarded + report.feature_samples == 400);
        CHECK(report.distance.mean < 0.4);
      }
}

TEST_CASE("surfaces with borders keep them")
{
  for (const Soup& soup : {shapes::plane_patch(10, 10), shapes::open_cylinder(40, 20, 1, 2)})
    for (const Preset preset : {Preset::quality, Preset::paper}) {
      Remeshing_options options;
      if (preset == Preset::paper) options = Remeshing_options::paper_preset();
      options.density = Density::uniform;
      const Result result = remesh(soup, 300, options);
      check_guarantees(result.report);
      CHECK(result.report.topology.border_loops == result.report.input_topology.border_loops);
      CHECK(result.report.feature_edges > 40);
      CHECK(result.report.quality.q_avg > (preset == Preset::paper ? 0.8 : 0.9));
      CHECK(result.report.quality.q_min > 0.5);
      CHECK(result.report.distance.max < 1); // of a diagonal's hundredths; the border is where it was
    }
  CHECK(remesh(shapes::plane_patch(10, 10), 300).report.distance.max < 1e-10);
}

TEST_CASE("creases are found and kept: polyhedra stay the same shape")
{
  const Soup cubes = shapes::joined(shapes::box(6), shapes::translated(shapes::box(2), {3, 0.5, 0.1}));
  const Remeshing_report report = remesh(cubes, 600).report;
  check_guarantees(report);
  CHECK(report.crease_edges == 12 * 6 + 12 * 2);
  CHECK(report.feature_edges >= 2 * 12 * 5);
  CHECK(report.lost_feature_edges == 0);
  CHECK(report.distance.max < 1e-10);
  CHECK(report.quality.q_min > 0.5);
  Remeshing_options without;
  without.feature_angle = 180;
  const Remeshing_report smooth = remesh(cubes, 600, without).report;
  CHECK(smooth.crease_edges == 0);
  CHECK(smooth.distance.max > 1);
}

TEST_CASE("creases of the user's own")
{
  Mesh mesh = make_mesh(shapes::plane_patch(10, 10));
  auto is_constrained = mesh.add_property_map<Mesh::Edge_index, bool>("e:constrained", false).first;
  const auto is_on_line = [&](Mesh::Vertex_index v) { return mesh.point(v).x() == 0.5; };
  for (const auto e : mesh.edges())
    is_constrained[e] = is_on_line(mesh.vertex(e, 0)) && is_on_line(mesh.vertex(e, 1));
  Mesh output;
  const Remeshing_report report = CGAL::power_rtf_remeshing(
      mesh, 300, output,
      params::remeshing_options(Remeshing_options()).edge_is_constrained_map(is_constrained));
  check_guarantees(report);
  CHECK(report.crease_edges == 10);
  double on_line = 0;
  for (const auto e : output.edges()) {
    const auto a = output.point(output.vertex(e, 0)), b = output.point(output.vertex(e, 1));
    if (std::abs(a.x() - 0.5) < 1e-12 && std::abs(b.x() - 0.5) < 1e-12)
      on_line += std::sqrt(CGAL::squared_distance(a, b));
  }
  CHECK(on_line == Approx(1));
}

TEST_CASE("the paper's preset ends with every cell inside the interval")
{
  for (Density density : {Density::uniform, Density::curvature})
    for (unsigned seed : {0u, 1u, 2u}) {
      CAPTURE(seed);
      Remeshing_options options = Remeshing_options::paper_preset();
      options.density = density;
      options.random_seed = seed;
      const Remeshing_report report = remesh(torus(), 300, options).report;
      check_guarantees(report);
      CHECK(report.capacity.inside_interval == 1);
      CHECK(report.capacity.largest_deviation <= 0.04);
      CHECK(report.constructions <= 700);
      CHECK(report.outer_iterations < 110); // it stops when it is done
      CHECK(report.quality.q_avg > 0.82);
    }
}

TEST_CASE("the paper's preset: weights that diverge begin anew")
{
  Remeshing_options options = Remeshing_options::paper_preset();
  options.max_iterations = 6;
  options.weight_step = 8; // the rule diverges beyond 2
  const Remeshing_report report = remesh(shapes::icosphere(4), 300, options).report;
  check_guarantees(report);
  const std::size_t without = 10 + 6 * (1 + 30) + 1; // constructions
  CHECK(report.constructions > without);
  for (std::size_t k = 10; k < report.iterations.size(); ++k) {
    CHECK(report.iterations[k].cells.empty == 0);
    CHECK(report.iterations[k].capacity.rms < 1.5 * report.iterations[9].capacity.rms);
  }
}

TEST_CASE("modes: RTF without weights, CCCPD with exactly equal capacities")
{
  Remeshing_options options = Remeshing_options::paper_preset();
  options.density = Density::uniform;
  options.max_iterations = 20;
  options.weight_method = Weight_method::none;
  const Remeshing_report rtf = remesh(torus(), 300, options).report;
  check_guarantees(rtf);
  CHECK(rtf.outer_iterations == 30);
  CHECK(rtf.constructions == 31);
  CHECK(rtf.capacity.inside_interval < 0.9);

  options.weight_method = Weight_method::multiplicative;
  const Remeshing_report paper = remesh(torus(), 300, options).report;
  options.capacity_tolerance = 0;
  const Remeshing_report cccpd = remesh(torus(), 300, options).report;
  check_guarantees(cccpd);
  CHECK(cccpd.outer_iterations == 30);
  CHECK(paper.capacity.rms < 0.04);
  CHECK(cccpd.capacity.rms < 0.25 * paper.capacity.rms);
  CHECK(cccpd.capacity.rms < 0.1 * rtf.capacity.rms);
  // At the first iteration with weights nothing is equal yet.
  CHECK(cccpd.capacity.rms < 0.1 * cccpd.iterations[9].capacity.rms);

  options.weight_operator = Weight_operator::floor; // as printed: cells park below two intervals
  options.capacity_tolerance = 0.04;
  const Remeshing_report printed = remesh(torus(), 300, options).report;
  check_guarantees(printed);
  CHECK(printed.capacity.inside_interval < 1);
}
