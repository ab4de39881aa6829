// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_of_shape.h"
#include "odd_shapes.h"
#include "remeshed_shape.h"
#include "shapes.h"
#include "with_threads.h"

#include <CGAL/PowerRTF/Resolution.h>
#include <CGAL/PowerRTF/fields/resolution.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/sampling/random_source.h>
#include <CGAL/power_rtf_remeshing.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using remeshed_shape::are_equal;
using shapes::make_mesh;
using shapes::Mesh;
using shapes::soup_of;
namespace params = CGAL::PowerRTF::parameters;

namespace {

// m rows of equilateral triangles with edges of length 1.
shapes::Soup equilateral_rows(int m)
{
  shapes::Soup soup;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i) soup.points.push_back({i + 0.5 * j, std::sqrt(0.75) * j, 0});
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i) {
      const int v = j * (m + 1) + i, w = v + m + 1;
      soup.triangles.push_back({v, v + 1, w});
      soup.triangles.push_back({v + 1, w + 1, w});
    }
  return soup;
}

double median_edge(const shapes::Soup& soup)
{
  std::vector<double> lengths;
  for (const Triangle& t : soup.triangles)
    for (int k = 0; k < 3; ++k)
      if (t[k] < t[(k + 1) % 3])
        lengths.push_back(length(soup.points[t[k]] - soup.points[t[(k + 1) % 3]]));
  const auto middle = lengths.begin() + lengths.size() / 2;
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

struct Result {
  Remeshing_report report;
  shapes::Soup soup;
};

Result remesh(const shapes::Soup& input, const Resolution& resolution,
              Density density = Density::uniform)
{
  Remeshing_options options;
  options.density = density;
  const Mesh mesh = make_mesh(input);
  Mesh output;
  Result result;
  result.report =
      CGAL::power_rtf_remeshing(mesh, resolution, output, params::remeshing_options(options));
  result.soup = soup_of(output);
  return result;
}

// \returns the number of vertices.
std::size_t check_max_distance(const shapes::Soup& soup, double distance,
                               Density density = Density::uniform)
{
  CAPTURE(distance);
  const Result result = remesh(soup, Resolution::max_distance(distance), density);
  const Remeshing_report& report = result.report;
  CHECK(report.missed_guarantees().empty());
  CHECK(report.max_distance == distance);
  CHECK(report.absolute(report.distance.bound) <= distance);
  CHECK(report.absolute(report.distance.bound) > 0.7 * distance);
  CHECK(report.distance.bound >= report.distance.max);
  // the point where it is, is on one of the surfaces and that far from the other
  const auto [x, y, z] = report.distance.farthest;
  const auto distance_to = [p = Vec3d{x, y, z}](const shapes::Soup& s) {
    const shapes::Soup small = shapes::scaled(s, 0.25);
    return 4 * std::sqrt(Facet_tree(small.points, small.triangles)
                             .nearest_anywhere(0.25 * p)
                             .squared_distance);
  };
  CHECK(std::min(distance_to(soup), distance_to(result.soup)) < 1e-12);
  CHECK(std::max(distance_to(soup), distance_to(result.soup)) ==
        Approx(report.absolute(report.distance.max)));
  CHECK(report.samples_asked == result.soup.points.size());
  return result.soup.points.size();
}

// With so many samples, uniform, 1 % of the diagonal is kept.
void check_kept(const shapes::Soup& soup, std::size_t samples)
{
  CAPTURE(samples);
  Remeshing_options options;
  options.density = Density::uniform;
  options.relative_max_distance = 0.01;
  options.number_of_samples = samples;
  Remeshing_report report;
  CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<shapes::Kernel>> remesher(
      prepare_surface(make_mesh(soup), options, params::default_values(), report), options, report);
  Remeshing_default_visitor visitor;
  REQUIRE(remesher.optimize(visitor));
  remesher.extract(visitor);
  CHECK(remesher.report().missed_guarantees().empty());
  CHECK(remesher.report().distance.bound <= 1); // in per cent
}

// Ends a run when it has been asked so many times.
struct Ending_visitor : Remeshing_default_visitor {
  explicit Ending_visitor(int times) : left(times) {}
  bool go_further() { return left-- > 0; }
  int left;
};

} // namespace

TEST_CASE("equilateral triangles: an edge length gives the vertices there are")
{
  for (const shapes::Soup& soup :
       {shapes::tetrahedron(), shapes::octahedron(), shapes::icosahedron(), equilateral_rows(1),
        equilateral_rows(7)}) {
    const Surface surface = shapes::make_surface(soup);
    const double edge =
        length(soup.points[soup.triangles[0][0]] - soup.points[soup.triangles[0][1]]);
    const double inside = edge * surface.normalization.scale;
    CHECK(vertices_by_edge_length(surface, inside) ==
          Approx(double(soup.points.size())).epsilon(1e-12));
  }
}

TEST_CASE("the median edge has the length asked for")
{
  for (const shapes::Soup& soup :
       {shapes::ellipsoid(1, 0.6, 0.4, 4), shapes::torus(60, 30, 1, 0.4), shapes::box(6),
        shapes::open_cylinder(40, 20, 1, 2), shapes::plane_patch(10, 10)})
    for (const Density density : {Density::uniform, Density::curvature})
      for (const double edge : {0.05, 0.11}) {
        CAPTURE(edge);
        CAPTURE(int(density));
        const Result result = remesh(soup, Resolution::edge_length(edge), density);
        CHECK(result.report.missed_guarantees().empty());
        CHECK(result.report.samples_asked == result.soup.points.size());
        const double median = median_edge(result.soup);
        CHECK(std::abs(median / edge - 1) < 0.02);
        CHECK(result.report.edge_length.median == Approx(median).epsilon(0.01)); // the border twice
      }
}

TEST_CASE(
    "the median edge has the length asked for where the mesh has another area than the surface")
{
  for (const shapes::Soup& soup : {shapes::thin_disc(0.1), shapes::torus(60, 30, 1, 0.15)})
    for (const double edge : {0.15, 0.2, 0.25}) {
      CAPTURE(edge);
      const Result result = remesh(soup, Resolution::edge_length(edge));
      CHECK(std::abs(result.report.edge_length.median / edge - 1) < 0.02);
      CHECK(result.report.median_edge_length == Approx(edge));
      CHECK(result.report.samples_asked == result.soup.points.size());
    }
}

TEST_CASE("an edge length is in the input's unit, or relative to its diagonal")
{
  const shapes::Soup soup = shapes::torus(40, 20, 1, 0.4);
  const std::size_t n = remesh(soup, Resolution::edge_length(0.1)).report.samples_asked;
  CHECK(n > 500);
  const double diagonal = length(Vec3d{2.8, 2.8, 0.8}); // its vertices come near it
  for (const double scale : {1e-9, 1., 3e7}) {
    const shapes::Soup scaled = shapes::translated(shapes::scaled(soup, scale), {scale, 0, 0});
    CHECK(remesh(scaled, Resolution::edge_length(0.1 * scale)).report.samples_asked == n);
    const Remeshing_report relative =
        remesh(scaled, Resolution::relative_edge_length(0.1 / diagonal)).report;
    CHECK(double(relative.samples_asked) == Approx(double(n)).epsilon(0.02));
  }
}

TEST_CASE("a share of the input's vertices")
{
  const shapes::Soup soup = shapes::torus(40, 20, 1, 0.4);
  CHECK(remesh(soup, Resolution::vertex_share(0.5)).report.samples_asked == 400);
  CHECK(remesh(soup, Resolution::vertex_share(1.25)).report.samples_asked == 1000);
  CHECK(remesh(soup, 300).report.samples_asked == 300);
}

TEST_CASE("a largest distance is kept by about as few vertices as can be")
{
  check_max_distance(shapes::ellipsoid(1, 0.6, 0.4, 4), 0.01);
  check_max_distance(shapes::torus(60, 30, 1, 0.4), 0.03);
}

TEST_CASE("a largest distance alone says where vertices are needed, unless a density does")
{
  const shapes::Soup ellipsoid = shapes::ellipsoid(1, 0.6, 0.2, 4);
  const std::size_t uniform = check_max_distance(ellipsoid, 0.01),
                    coarse = check_max_distance(ellipsoid, 0.01, Density::curvature);
  CHECK(double(coarse) < 0.8 * double(uniform));
}

TEST_CASE("a largest distance is kept by about as few vertices as can be: more" *
          doctest::test_suite("long") * doctest::skip())
{
  check_max_distance(shapes::ellipsoid(1, 0.6, 0.4, 4), 0.03);
  check_max_distance(shapes::torus(60, 30, 1, 0.4), 0.01);
}

TEST_CASE("the search for a largest distance is that of one thread, and a visitor ends it")
{
  const Mesh mesh = make_mesh(shapes::ellipsoid(1, 0.6, 0.4, 3));
  const auto search = [&mesh](auto tag, auto&& visitor, Mesh& output) {
    Remeshing_options options;
    options.density = Density::uniform;
    return CGAL::power_rtf_remeshing<decltype(tag)>(
        mesh, Resolution::max_distance(0.05), output,
        params::remeshing_options(options).visitor(std::ref(visitor)));
  };
  Mesh expected;
  Ending_visitor never{1 << 30};
  const Remeshing_report report = search(CGAL::Sequential_tag(), never, expected);
  CHECK(report.missed_guarantees().empty());
  for (const int threads : {2, 5}) {
    Mesh output;
    with_threads(threads, [&] { search(CGAL::Parallel_if_available_tag(), never, output); });
    CHECK(are_equal(soup_of(output), soup_of(expected)));
    for (const int asked : {0, 20, 60}) {
      Mesh none;
      Ending_visitor visitor{asked};
      with_threads(threads, [&] {
        CHECK(search(CGAL::Parallel_if_available_tag(), visitor, none).cancelled);
      });
      CHECK(num_vertices(none) == 0);
    }
  }
}

TEST_CASE("where nothing is flat, far places get vertices of bent parts")
{
  check_kept(shapes::mapped(shapes::icosphere(5),
                            [](const Vec3d& p) {
                              return (1 + 0.15 * std::sin(10 * p.x) * std::sin(10 * p.y + 1) *
                                              std::sin(10 * p.z + 2)) *
                                     p;
                            }),
             600);
}

TEST_CASE("spikes get vertices of the sphere that they are on")
{
  const shapes::Soup soup = shapes::mapped(shapes::icosphere(5), [](const Vec3d& p) {
    const auto spike = [](double cosine) { return 0.3 * std::exp((cosine - 1) / 0.015); };
    return (1 + spike(p.x) + spike(-p.x) + spike(p.y) + spike(-p.y) + spike(p.z) + spike(-p.z)) * p;
  });
  for (const std::size_t samples : {160, 180}) check_kept(soup, samples);
}

TEST_CASE("a largest distance that cannot be kept is a guarantee that is missed")
{
  Remeshing_options options;
  options.feature_angle = 180;
  options.density = Density::uniform;
  const Mesh mesh = make_mesh(shapes::box(1)); // its edges are cut off
  Mesh output;
  const Remeshing_report report = CGAL::power_rtf_remeshing(
      mesh, Resolution::max_distance(0.001), output, params::remeshing_options(options));
  REQUIRE(report.missed_guarantees().size() == 1);
  CHECK(report.missed_guarantees()[0].find("largest distance: up to 0.0") == 0);
  CHECK(report.absolute(report.distance.bound) > 0.001);
}

// The search that makes one trial at a time.
template <class Ratio>
std::size_t smallest_number(double first, double most, const Ratio& ratio)
{
  most = std::floor(most);
  const double best = internal::smallest_of_falling(first, most, ratio);
  if (best == internal::infinity) return std::size_t(most);
  return std::size_t(internal::smallest_by_luck(best, [&](const std::vector<std::size_t>& numbers) {
    const auto does = [&](std::size_t n) { return ratio(n) <= 1; };
    return std::size_t(std::find_if(numbers.begin(), numbers.end(), does) - numbers.begin());
  }));
}

TEST_CASE("the search for the smallest number")
{
  int runs = 0;
  const auto search = [&](double first, double most, double needed) {
    return smallest_number(first, most, [&](std::size_t n) {
      ++runs;
      return needed / double(n);
    });
  };
  for (const double needed : {7., 100., 5432., 1e6})
    for (const double first : {4., 3000., 1e7}) {
      runs = 0;
      const double n = double(search(first, 1e8, needed));
      CHECK(n >= needed);
      CHECK(n <= 1.02 * needed + 2);
      CHECK(runs <= 35);
    }
  runs = 0;
  CHECK(search(100, 1000.7, 5000) == 1000);
  CHECK(runs <= 3);
  CHECK(search(100, 1000, 1) == 4);
}

TEST_CASE("the search for the smallest number where what is wanted scatters")
{
  constexpr int seeds = 200;
  struct Scattered {
    double needed, least, width; // at `needed` the ratio is `least` to 2 `width` more
    double work;                 // at most, in runs with `needed`
  };
  for (const Scattered& s : {Scattered{10000, 0.75, 0.3, 16}, Scattered{1000, 0.6, 0.5, 25}}) {
    CAPTURE(s.needed);
    int far_off = 0;
    double work = 0;
    for (int seed = 0; seed < seeds; ++seed) {
      const auto ratio = [&](std::size_t n) {
        const double random = counted_random(seed, int(n), 0) + counted_random(seed, int(n), 1);
        return s.needed / double(n) * (s.least + s.width * random);
      };
      const std::size_t n = smallest_number(3000, 1e8, [&](std::size_t m) {
        work += double(m) / s.needed;
        return ratio(m);
      });
      CHECK(ratio(n) <= 1);
      std::size_t fewest = n; // by brute force
      for (double share = 0.98; share > 0.49; share -= 0.02)
        if (const auto m = std::size_t(std::lround(share * double(n))); ratio(m) <= 1) fewest = m;
      if (double(n) > 1.15 * double(fewest)) ++far_off;
    }
    CHECK(far_off == 0);
    CHECK(work < s.work * seeds);
  }
}

TEST_CASE("resolutions that cannot be are refused, with the reason")
{
  const shapes::Soup soup = shapes::torus(40, 20, 1, 0.4);
  const auto check_refused = [&](const Resolution& resolution, const std::string& reason) {
    CAPTURE(reason);
    std::string message;
    try {
      remesh(soup, resolution);
    } catch (const Invalid_input_error& e) {
      message = e.what();
    }
    CHECK(message.find(reason) != std::string::npos);
  };
  check_refused(Resolution::edge_length(1e-9), "edge_length asks for 1.");
  check_refused(Resolution::edge_length(-1), "edge_length is -1, but must be");
  check_refused(Resolution::edge_length(std::nan("")), "edge_length is nan");
  check_refused(Resolution::edge_length(50), "samples are too few");
  check_refused(Resolution::relative_edge_length(2), "relative_edge_length is 2, but must be");
  check_refused(Resolution::vertex_share(1e6), "vertex_share asks for 800000000 samples");
  Remeshing_options options;
  options.edge_length = options.vertex_share = 0.5;
  CHECK_THROWS_WITH_AS(validate(options), doctest::Contains("only one"), Invalid_input_error);
}
