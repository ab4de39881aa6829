// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wanted edge lengths: sizing fields, bounds, regions to refine.
#include "../mesh_of_shape.h"
#include "../shapes.h"

#include <CGAL/power_rtf_remeshing.h>

#include <boost/property_map/function_property_map.hpp>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using shapes::make_mesh;
using shapes::Mesh;
using shapes::soup_of;
namespace params = CGAL::PowerRTF::parameters;

namespace {

using Field = std::function<double(const Vec3d&)>;

struct Result {
  Remeshing_report report;
  shapes::Soup soup;
};

Remeshing_options uniform_options()
{
  Remeshing_options options;
  options.density = Density::uniform;
  return options;
}

/// \param options besides: uniform density
Result remesh(const shapes::Soup& input, const Resolution& resolution, const Field& field,
              const std::vector<Refinement>& regions = {}, Remeshing_options options = {})
{
  options.density = Density::uniform;
  const Mesh mesh = make_mesh(input);
  Mesh output;
  Result result;
  const auto np = params::remeshing_options(options).refinements(regions);
  const auto size = boost::make_function_property_map<Mesh::Vertex_index>(
      [&](Mesh::Vertex_index v) { return field(internal::to_vec3d(mesh.point(v))); });
  result.report = field ? CGAL::power_rtf_remeshing(mesh, resolution, output, np.sizing_map(size))
                        : CGAL::power_rtf_remeshing(mesh, resolution, output, np);
  result.soup = soup_of(output);
  CHECK(result.report.missed_guarantees().empty());
  return result;
}

/// The median over the edges with their middles in a part of space: their lengths over `wanted`.
template <class Part>
double median_ratio(const shapes::Soup& soup, const Field& wanted, const Part& is_inside)
{
  std::vector<double> ratios;
  for (const Triangle& t : soup.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3d &a = soup.points[t[k]], &b = soup.points[t[(k + 1) % 3]];
      const Vec3d middle = 0.5 * (a + b);
      if (is_inside(middle)) ratios.push_back(length(b - a) / wanted(middle));
    }
  REQUIRE(ratios.size() > 100);
  const auto middle = ratios.begin() + ratios.size() / 2;
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

double constant(const Vec3d&) { return 1; }

std::vector<double> edge_lengths_of(const shapes::Soup& soup)
{
  std::vector<double> lengths;
  for (const Triangle& t : soup.triangles)
    for (int k = 0; k < 3; ++k)
      lengths.push_back(length(soup.points[t[k]] - soup.points[t[(k + 1) % 3]]));
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

} // namespace

TEST_CASE("edges have the lengths of a sizing field")
{
  const Field field = [](const Vec3d& p) { return 0.05 + 0.04 * p.x; }; // .02 to .1
  const auto anywhere = [](const Vec3d&) { return true; };
  for (const auto& [soup, left] : // fine; flat and open; of few facets
       {std::pair{shapes::ellipsoid(0.8, 0.6, 0.4, 4), -0.8},
        std::pair{shapes::plane_patch(20, 20), 0.}, std::pair{shapes::plane_patch(1, 1), 0.},
        std::pair{shapes::scaled(shapes::box(1), 0.7), -0.7}}) {
    const Result result = remesh(soup, Resolution::size_factor(), field);
    CHECK(result.report.samples_asked == result.soup.points.size());
    CHECK(result.report.input_topology.faces == soup.triangles.size());
    CHECK(std::abs(median_ratio(result.soup, field, anywhere) - 1) < 0.02);
    for (double x = left; x < 0.4; x += 0.3) {
      CAPTURE(x);
      const auto is_inside = [x = x](const Vec3d& p) { return x <= p.x && p.x < x + 0.3; };
      CHECK(std::abs(median_ratio(result.soup, field, is_inside) - 1) < 0.05);
    }
  }
}

namespace {

/// What `PMPSizingField` asks for that matters here.
struct Sizing_field {
  double size = 0.1;

  double at(Mesh::Vertex_index v, const Mesh& mesh) const
  {
    return size + 0.04 * mesh.point(v).x();
  }
};

} // namespace

TEST_CASE("a class with a length for each vertex does as its map")
{
  const shapes::Soup soup = shapes::ellipsoid(0.8, 0.6, 0.4, 3);
  const Mesh mesh = make_mesh(soup);
  Mesh output;
  CGAL::power_rtf_remeshing(
      mesh, Resolution::size_factor(), output,
      params::sizing_field(Sizing_field()).random_seed(0).remeshing_options(uniform_options()));
  const auto by_class = soup_of(output);
  const Result by_map =
      remesh(soup, Resolution::size_factor(), [](const Vec3d& p) { return 0.1 + 0.04 * p.x; });
  CHECK(by_class.points == by_map.soup.points);
  CHECK(by_class.triangles == by_map.soup.triangles);
}

TEST_CASE("a sizing field is in the input's unit; a factor changes it, a number takes its ratios")
{
  const shapes::Soup soup = shapes::ellipsoid(0.8, 0.6, 0.4, 3);
  const auto field = [](double scale) {
    return [scale](const Vec3d& p) { return 0.05 * scale + 0.02 * p.x; };
  };
  const Result one = remesh(soup, Resolution::size_factor(), field(1));
  const double n = double(one.report.samples_asked);
  CHECK(double(remesh(soup, Resolution::size_factor(2), field(1)).report.samples_asked) ==
        Approx(n / 4).epsilon(0.02));
  for (const double scale : {std::ldexp(1., -20), std::ldexp(1., 20)}) {
    const Result other =
        remesh(shapes::scaled(soup, scale), Resolution::size_factor(), field(scale));
    CHECK(other.soup.triangles == one.soup.triangles);
    CHECK(other.soup.points == shapes::scaled(one.soup, scale).points);
  }
  const Result number = remesh(soup, 600, field(1));
  CHECK(number.report.samples_asked == 600);
  const double factor = median_ratio(number.soup, field(1), [](const Vec3d&) { return true; });
  for (const bool left : {true, false})
    CHECK(std::abs(median_ratio(number.soup, field(1),
                                [&](const Vec3d& p) { return (p.x < 0) == left; }) /
                       factor -
                   1) < 0.05);
}

TEST_CASE("regions are refined, also in the middle of a large facet")
{
  const Vec3d center{0.2, 0.1, 1};
  Remeshing_options options;
  options.gradation = 0.3;
  struct Region {
    Refinement all, core; ///< an edge away from what is outside
  };
  const double r = 0.2, h = 0.015;
  for (const int divisions : {1, 30})
    for (const Region& where :
         {Region{Refinement::sphere({center.x, center.y, center.z}, r, h),
                 Refinement::sphere({center.x, center.y, center.z}, r - h, h)},
          Region{Refinement::box({0.1, -0.1, 0.9}, {0.3, 0.3, 1.1}, h),
                 Refinement::box({0.1 + h, -0.1 + h, 0.9}, {0.3 - h, 0.3 - h, 1.1}, h)}}) {
      CAPTURE(divisions);
      const Refinement& region = where.all;
      const shapes::Soup soup = shapes::box(divisions);
      const Result result = remesh(soup, Resolution::edge_length(0.2), {}, {region}, options);
      CHECK(result.report.input_topology.faces == soup.triangles.size());
      const auto ratio_in = [&](const Refinement& part) {
        return median_ratio(result.soup, constant,
                            [&](const Vec3d& p) { return part.distance(p) < 1e-9; });
      };
      const auto far_away = [&](const Vec3d& p) { return region.distance(p) > 0.8; };
      const auto between = [&](const Vec3d& p) {
        return region.distance(p) > 0.1 && region.distance(p) < 0.4;
      };
      CHECK(std::abs(ratio_in(where.core) / h - 1) < 0.03);
      // beside longer edges; of other seeds .005 to .015 and, in the box, .026 to .036
      CHECK(std::abs(ratio_in(region) / h - 1) < 0.04);
      CHECK(std::abs(median_ratio(result.soup, constant, far_away) / 0.2 - 1) < 0.06);
      const Field grown = [&](const Vec3d& p) { return h + 0.3 * region.distance(p); };
      CHECK(std::abs(median_ratio(result.soup, grown, between) - 1) < 0.1);
    }
}

TEST_CASE("regions and bounds are in the input's unit")
{
  const auto scaled_result = [](double scale) {
    Remeshing_options options;
    options.gradation = 0.3;
    options.min_edge_length = 0.02 * scale;
    options.max_edge_length = 0.3 * scale;
    const auto x = [scale](double x0, double x1, double x2) {
      return std::array<double, 3>{scale * x0, scale * x1, scale * x2};
    };
    return remesh(shapes::scaled(shapes::box(2), scale), Resolution::relative_edge_length(0.15), {},
                  {Refinement::sphere(x(1, 1, 1), 0.2 * scale, 0.03 * scale),
                   Refinement::box(x(-1.1, -0.1, -0.1), x(-0.9, 0.2, 0.2), 0.01 * scale)},
                  options)
        .soup;
  };
  const shapes::Soup one = scaled_result(1);
  for (const double scale : {std::ldexp(1., -30), std::ldexp(1., 30)}) {
    const shapes::Soup other = scaled_result(scale);
    CHECK(other.triangles == one.triangles);
    CHECK(other.points == shapes::scaled(one, scale).points);
  }
}

TEST_CASE("a number of samples is kept: the rest is coarser for regions that are finer")
{
  const Refinement region = Refinement::sphere({0.8, 0, 0}, 0.3, 0.02);
  const shapes::Soup soup = shapes::ellipsoid(0.8, 0.6, 0.4, 4);
  const auto inside = [&](const Vec3d& p) { return region.distance(p) == 0; };
  const auto outside = [&](const Vec3d& p) { return p.x < -0.4; };
  const Result plain = remesh(soup, 2500, {}), refined = remesh(soup, 2500, {}, {region});
  CHECK(refined.soup.points.size() == 2500);
  CHECK(std::abs(median_ratio(refined.soup, constant, inside) / 0.02 - 1) < 0.03);
  CHECK(median_ratio(refined.soup, constant, outside) >
        1.1 * median_ratio(plain.soup, constant, outside));
}

TEST_CASE("edges are about as long as the bounds allow")
{
  const shapes::Soup soup = shapes::torus(120, 60, 1, 0.4);
  const Field field = [](const Vec3d& p) { return 0.14 + 0.09 * p.x; }; // .014 to .266
  Remeshing_options bounded;
  bounded.min_edge_length = 0.1;
  bounded.max_edge_length = 0.18;
  const auto range = [&](Remeshing_options options) { // means over seeds: one has its luck
    constexpr unsigned seeds = 10;
    double low = 0, high = 0;
    for (options.random_seed = 0; options.random_seed < seeds; ++options.random_seed) {
      const std::vector<double> all =
          edge_lengths_of(remesh(soup, Resolution::size_factor(), field, {}, options).soup);
      low += all[all.size() / 100] / seeds;
      high += all[all.size() * 99 / 100] / seeds;
    }
    return std::pair{low, high};
  };
  const auto [low, high] = range(bounded);
  CHECK(low > 0.8 * 0.1);
  CHECK(high < 1.2 * 0.18);
  const auto [lowest, highest] = range({});
  CHECK(lowest < 0.6 * 0.1);
  CHECK(highest > 1.2 * 0.18);
}

TEST_CASE("the same field in all threads")
{
  const shapes::Soup soup = shapes::box(2);
  Surface_fields fields;
  fields.refinements = {Refinement::sphere({1, 1, 1}, 0.3, 0.03)};
  Remeshing_options options;
  const auto surface = [&](internal::Concurrency concurrency) {
    Remeshing_report report;
    return prepare_surface(internal::soup_of_ranges(soup.points, soup.triangles), fields, options,
                           report, concurrency);
  };
  const Surface a = surface(CGAL::Sequential_tag()), b = surface(CGAL::Parallel_if_available_tag());
  CHECK(a.vertex_density == b.vertex_density);
  CHECK(a.triangles == b.triangles);
  CHECK(a.creases == b.creases);
  CHECK(a.triangles.size() > soup.triangles.size());
  CHECK(a.area == Approx(24 * a.normalization.scale * a.normalization.scale));
}

TEST_CASE("lengths that cannot be are refused, with the reason")
{
  const shapes::Soup soup = shapes::torus(40, 20, 1, 0.4);
  const Field field = [](const Vec3d&) { return 0.1; };
  const auto check_refused = [&](const std::string& reason, const Resolution& resolution,
                                 const Field& sizes, const std::vector<Refinement>& regions = {},
                                 const Remeshing_options& options = {}) {
    CAPTURE(reason);
    CHECK_THROWS_WITH_AS(remesh(soup, resolution, sizes, regions, options),
                         doctest::Contains(reason.c_str()), Invalid_input_error);
  };
  const auto zero_at_0 = [](const Vec3d& p) { return std::max(p.x, 0.); };
  check_refused("the edge length of vertex", 500, zero_at_0);
  check_refused("size_factor needs a sizing field", Resolution::size_factor(), {});
  check_refused("size_factor asks for", Resolution::size_factor(1e-6), field);
  check_refused("exclude each other", Resolution::max_distance(0.1), field);
  const Refinement fine = Refinement::sphere({1, 0, 0}, 0.5, 0.01);
  check_refused("need at least", 500, {}, {fine});
  Remeshing_options options;
  options.min_edge_length = 0.2;
  check_refused("500 samples are asked for, but min_edge_length leaves room for", 500, {}, {},
                options);
  options.max_edge_length = 0.1;
  check_refused("must be at most max_edge_length", 500, {}, {}, options);
  CHECK_THROWS_AS(Refinement::sphere({0, 0, 0}, 0, 1), Invalid_input_error);
  CHECK_THROWS_AS(Refinement::sphere({0, 0, 0}, 1, -1), Invalid_input_error);
  CHECK_THROWS_AS(Refinement::sphere({0, 0, std::nan("")}, 1, 1), Invalid_input_error);
  CHECK_THROWS_AS(Refinement::box({0, 0, 0}, {1, 1, 0}, 1), Invalid_input_error);
}
