// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes.h"

#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/fields/smooth_normals.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <utility>
#include <vector>

using namespace CGAL::PowerRTF;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Remeshing_options curvature_options(double power = 1, double gradation = 0)
{
  Remeshing_options o;
  o.density = Density::curvature;
  o.density_power = power;
  o.gradation = gradation;
  o.density_smoothing = 0;
  return o;
}

std::vector<double> spacing(const Surface& s, std::size_t n)
{
  std::vector<double> h;
  const double C = spacing_constant(s, n);
  for (const double rho : s.vertex_density) h.push_back(C / std::sqrt(rho));
  return h;
}

/// The largest |h_v - h_u| / |uv|.
double steepest_growth(const Surface& s, std::size_t n)
{
  const Surface_edges edges = surface_edges(s);
  const std::vector<double> h = spacing(s, n);
  double steepest = 0;
  for (std::size_t v = 0; v < h.size(); ++v)
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
      steepest = std::max(steepest, (h[v] - h[edges.neighbor[e]]) / edges.length[e]);
  return steepest;
}

double ratio(const Surface& s)
{
  const auto [low, high] = std::minmax_element(s.vertex_density.begin(), s.vertex_density.end());
  return *high / *low;
}

} // namespace

TEST_CASE("edges: every neighbor once, on closed and open surfaces")
{
  for (const shapes::Soup& soup : {shapes::octahedron(), shapes::plane_patch(3, 2),
                                   shapes::torus(8, 6, 2, 1), shapes::open_cylinder(7, 3, 1, 1)}) {
    const Surface s = shapes::make_surface(soup);
    std::map<std::pair<int, int>, int> expected;
    for (const Triangle& t : s.triangles)
      for (int i = 0; i < 3; ++i) {
        expected[{t[i], t[(i + 1) % 3]}] = 1;
        expected[{t[(i + 1) % 3], t[i]}] = 1;
      }
    const Surface_edges edges = surface_edges(s);
    CHECK(edges.neighbor.size() == expected.size());
    for (int v = 0; v < static_cast<int>(s.points.size()); ++v)
      for (int e = edges.first[v]; e < edges.first[v + 1]; ++e) {
        CHECK(expected[{v, edges.neighbor[e]}]-- == 1);
        CHECK(edges.length[e] ==
              doctest::Approx(length(s.points[v] - s.points[edges.neighbor[e]])));
      }
  }
}

TEST_CASE("curvature of a sphere of radius r is 1/r")
{
  for (const double r : {1e-3, 1., 50.}) {
    const Surface s = shapes::make_surface(shapes::scaled(shapes::icosphere(3), r));
    for (const double k : vertex_curvature(s, surface_edges(s)))
      CHECK(k * s.normalization.scale * r == doctest::Approx(1).epsilon(0.03));
  }
}

TEST_CASE("curvature of a cylinder away from its borders")
{
  const double r = 2;
  const Surface s = shapes::make_surface(shapes::open_cylinder(60, 40, r, 8));
  const std::vector<double> k = vertex_curvature(s, surface_edges(s));
  for (int j = 2; j < 38; ++j)
    for (int i = 0; i < 60; ++i) {
      // Two edges along the axis (0), two around it (1/r), two diagonals (in between).
      CHECK(k[j * 60 + i] * s.normalization.scale * r < 1);
      CHECK(k[j * 60 + i] * s.normalization.scale * r > std::sqrt(1. / 3) * 0.99);
    }
}

TEST_CASE("torus: the inner side has the curvature of a saddle, the largest lies on the tube")
{
  const double R = 3, r = 1;
  const int nu = 120, nv = 40;
  const Surface s = shapes::make_surface(shapes::torus(nu, nv, R, r));
  const std::vector<double> k = vertex_curvature(s, surface_edges(s));
  for (int i = 0; i < nu; i += 7)
    for (int j = 0; j < nv; ++j) {
      const double at = k[i * nv + j] * s.normalization.scale;
      CHECK(at <= 1 / r * 1.01);
      CHECK(at >= 0.4 / r);
    }
}

TEST_CASE("density: range, powers, uniform, flat")
{
  Surface s = shapes::make_surface(shapes::ellipsoid(4, 1, 1, 3));
  set_density(s, curvature_options());
  const std::vector<double> kappa = s.vertex_density;
  CHECK(*std::min_element(kappa.begin(), kappa.end()) >= 0.05);
  CHECK(*std::max_element(kappa.begin(), kappa.end()) == 1);
  CHECK(std::count(kappa.begin(), kappa.end(), 1.) >= static_cast<long>(0.015 * kappa.size()));
  CHECK(std::count(kappa.begin(), kappa.end(), 1.) <= static_cast<long>(0.05 * kappa.size()));
  const auto tip = std::max_element(s.points.begin(), s.points.end(),
                                    [](const Vec3d& a, const Vec3d& b) { return a.x < b.x; });
  CHECK(kappa[tip - s.points.begin()] == 1);
  for (const int p : {2, 3}) {
    set_density(s, curvature_options(p));
    for (std::size_t v = 0; v < kappa.size(); ++v)
      CHECK(s.vertex_density[v] == doctest::Approx(std::pow(kappa[v], p)));
  }
  Remeshing_options uniform;
  uniform.density = Density::uniform;
  set_density(s, uniform);
  CHECK(s.vertex_density == std::vector<double>(s.points.size(), 1));

  Surface flat = shapes::make_surface(shapes::rotated(shapes::plane_patch(20, 20), 0.7));
  set_density(flat, curvature_options(1, 0.2));
  CHECK(ratio(flat) == doctest::Approx(1));
  Surface fine_box = shapes::make_surface(shapes::box(60)); // more than 98 % of it flat
  set_density(fine_box, curvature_options());
  CHECK(ratio(fine_box) == doctest::Approx(20));
}

TEST_CASE("gradation bounds the growth of the spacing on every edge")
{
  const shapes::Soup soups[] = {shapes::box(30), shapes::ellipsoid(5, 1, 0.3, 4),
                                shapes::thin_disc(0.02), shapes::two_spheres(2)};
  for (const shapes::Soup& soup : soups)
    for (const double g : {0.1, 0.2, 0.5})
      for (const std::size_t n : {500u, 3000u}) {
        Surface s = shapes::make_surface(soup);
        Remeshing_options o = curvature_options(3, 0);
        o.number_of_samples = n;
        set_density(s, o);
        const std::vector<double> before = spacing(s, n);
        const double steep_before = steepest_growth(s, n);
        o.gradation = g;
        set_density(s, o);
        // The last of the four passes changes the constant a little.
        CHECK(steepest_growth(s, n) <= 1.1 * g);
        if (steep_before > 2 * g) CHECK(steepest_growth(s, n) < 0.6 * steep_before);
        CHECK(*std::min_element(s.vertex_density.begin(), s.vertex_density.end()) > 0);
      }
}

TEST_CASE("limit_growth finds the largest function below the bound")
{
  const Surface s = shapes::make_surface(shapes::plane_patch(40, 30));
  const Surface_edges edges = surface_edges(s);
  for (unsigned seed = 0; seed < 5; ++seed)
    for (const double gradation : {0.3, 0.01, 1e-9}) {
      std::mt19937_64 random(seed);
      std::vector<double> h(s.points.size());
      for (double& x : h) x = 0.01 + static_cast<double>(random() % 1000) / 500;
      std::vector<double> expected = h, in_parallel = h;
      for (bool changes = true; changes;) { // Bellman and Ford
        changes = false;
        for (std::size_t v = 0; v < h.size(); ++v)
          for (int e = edges.first[v]; e < edges.first[v + 1]; ++e) {
            const double bound = expected[edges.neighbor[e]] + gradation * edges.length[e];
            if (!(bound < expected[v])) continue;
            expected[v] = bound;
            changes = true;
          }
      }
      limit_growth(edges, gradation, h);
      limit_growth(edges, gradation, in_parallel, CGAL::Parallel_if_available_tag());
      CHECK(h == expected);
      CHECK(in_parallel == expected);
      limit_growth(edges, gradation, h); // nothing is left to do
      CHECK(h == expected);
    }
}

TEST_CASE("diffusion spreads a value as far as is asked for")
{
  const int side = 80;
  const Surface s = shapes::make_surface(shapes::plane_patch(side, side));
  const Surface_edges edges = surface_edges(s);
  std::size_t center = 0; // the vertex nearest to the middle
  Vec3d middle{0, 0, 0};
  for (const Vec3d& p : s.points) middle += p * (1. / double(s.points.size()));
  for (std::size_t v = 0; v < s.points.size(); ++v)
    if (squared_length(s.points[v] - middle) < squared_length(s.points[center] - middle))
      center = v;
  for (const double width : {0.1, 0.7, 2., 4.}) {
    const std::size_t n = s.points.size() / 2; // spacing: 1.4 edges
    const double sigma = width * std::sqrt(s.area / double(n));
    std::vector<double> values(s.points.size(), 0);
    values[center] = 1;
    diffuse(edges,
            diffusion_times(
                edges, [&](int) { return sigma * sigma; }, infinity),
            4, values);
    double sum = 0, moment = 0, fourth = 0;
    for (std::size_t v = 0; v < values.size(); ++v) {
      sum += values[v];
      const double r2 = squared_length(s.points[v] - s.points[center]);
      moment += values[v] * r2;
      fourth += values[v] * r2 * r2;
    }
    CHECK(sum == doctest::Approx(1).epsilon(1e-12));
    CHECK(moment == doctest::Approx(2 * sigma * sigma).epsilon(1e-9));
    // Gaussian: 8 sigma^4; four rings: 7 sigma^4; one: 4 sigma^4.
    if (width > 1) CHECK(fourth / std::pow(sigma, 4) == doctest::Approx(7.4).epsilon(0.1));
  }
}

TEST_CASE("diffusion keeps constants as they are and is stable")
{
  for (const shapes::Soup& soup : {shapes::box(10), shapes::ellipsoid(5, 1, 0.3, 3),
                                   shapes::plane_patch(20, 3), shapes::two_spheres(2)}) {
    const Surface s = shapes::make_surface(soup);
    const Surface_edges edges = surface_edges(s);
    for (const double width : {0.3, 1., 3., 100.}) {
      const double variance = diffusion_variance(s, 500, width);
      const std::vector<double> times = diffusion_times(
          edges, [&](int) { return variance; }, 4000);
      std::vector<double> values(s.points.size(), 0.1);
      diffuse(edges, times, 4, values);
      CHECK(values == std::vector<double>(s.points.size(), 0.1));
      std::mt19937_64 random(7);
      for (double& x : values) x = double(random() % 2);
      diffuse(edges, times, 4, values);
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      CHECK(*low > -0.05);
      CHECK(*high < 1.05);
    }
  }
}

TEST_CASE("clusters: centers of their own, in the order of no thread, edges both ways")
{
  const Surface s = shapes::make_surface(shapes::two_spheres(5));
  const Surface_edges edges = surface_edges(s);
  const double mean = std::accumulate(edges.length.begin(), edges.length.end(), 0.) /
                      static_cast<double>(edges.length.size());
  for (const double longest : {0., 1.5 * mean, 4 * mean}) {
    const Vertex_clusters clusters = vertex_clusters(s.points, edges, longest);
    const Vertex_clusters in_parallel =
        vertex_clusters(s.points, edges, longest, CGAL::Parallel_if_available_tag());
    CHECK(clusters.cluster_of == in_parallel.cluster_of);
    CHECK(clusters.edges.neighbor == in_parallel.edges.neighbor);
    CHECK(clusters.edges.length == in_parallel.edges.length);
    const std::size_t size = clusters.centers.size();
    if (longest == 0) CHECK(size == s.points.size());
    if (longest > mean) CHECK(size < s.points.size() / 3);
    if (longest > 3 * mean) CHECK(size < s.points.size() / 8);
    for (std::size_t c = 0; c < size; ++c)
      CHECK(clusters.cluster_of[clusters.centers[c]] == int(c));
    std::map<std::pair<int, int>, double> lengths;
    for (int c = 0; c < int(size); ++c)
      for (int e = clusters.edges.first[c]; e < clusters.edges.first[c + 1]; ++e) {
        lengths[{c, clusters.edges.neighbor[e]}] = clusters.edges.length[e];
        CHECK(clusters.edges.length[e] ==
              length(s.points[clusters.centers[c]] -
                     s.points[clusters.centers[clusters.edges.neighbor[e]]]));
      }
    for (const auto& [ends, l] : lengths) CHECK(lengths.at({ends.second, ends.first}) == l);
    for (int v = 0; v < int(s.points.size()); ++v) // neighbors in space and on the surface
      for (int e = edges.first[v]; e < edges.first[v + 1]; ++e) {
        const int c = clusters.cluster_of[v], d = clusters.cluster_of[edges.neighbor[e]];
        CHECK((c == d || lengths.count({c, d}) == 1));
      }
  }
}

TEST_CASE("fine input: clusters change the density by little, and no bound of its growth")
{
  const std::size_t n = 300;
  Remeshing_options o = curvature_options();
  o.number_of_samples = n;
  Surface s = shapes::make_surface(shapes::ellipsoid(2, 1.5, 1, 6));
  const Surface_edges edges = surface_edges(s);
  set_density(s, o);
  const std::vector<double> raw = s.vertex_density;
  REQUIRE(internal::near_vertices(s, edges, n, CGAL::Sequential_tag()));
  for (const double width : {0., 2.}) {
    s.vertex_density = raw;
    limit_gradation(s, edges, std::nullopt, 0.1, n);
    if (width > 0)
      internal::smooth_density(s, edges, std::nullopt, n, width, CGAL::Sequential_tag());
    const std::vector<double> expected = s.vertex_density;
    o.gradation = 0.1;
    o.density_smoothing = width;
    set_density(s, o);
    CHECK(steepest_growth(s, n) <= (width > 0 ? 1.3 : 1.1) * o.gradation);
    for (std::size_t v = 0; v < raw.size(); ++v)
      CHECK(s.vertex_density[v] == doctest::Approx(expected[v]).epsilon(0.05));
    const std::vector<double> sequential = s.vertex_density;
    set_density(s, o, CGAL::Parallel_if_available_tag());
    CHECK(s.vertex_density == sequential);
  }
}

TEST_CASE("normals: those of a sphere stay, noise does not")
{
  const Surface sphere = shapes::make_surface(shapes::icosphere(5));
  std::mt19937_64 random(3);
  const auto noise = [&] { return 0.2 * (double(random() % 1001) / 500 - 1); };
  for (const std::size_t n : {300u, 3000u}) {
    Surface smooth = sphere, noisy = sphere;
    for (Vec3d& m : noisy.vertex_normals) m = normalized(m + Vec3d{noise(), noise(), noise()});
    const std::vector<Vec3d> before = noisy.vertex_normals;
    for (Surface* s : {&smooth, &noisy}) smooth_normals(*s, n, 0.7);
    double noise_before = 0, noise_after = 0;
    for (std::size_t v = 0; v < before.size(); ++v) {
      CHECK(length(smooth.vertex_normals[v] - sphere.vertex_normals[v]) < 0.03);
      CHECK(length(noisy.vertex_normals[v]) == doctest::Approx(1).epsilon(1e-14));
      noise_before += squared_length(before[v] - sphere.vertex_normals[v]);
      noise_after += squared_length(noisy.vertex_normals[v] - sphere.vertex_normals[v]);
    }
    CHECK(noise_after < 0.1 * noise_before);
  }
}

TEST_CASE("smoothing lowers the growth of the spacing")
{
  Surface s = shapes::make_surface(shapes::box(30));
  Remeshing_options o = curvature_options(1, 0.2);
  o.number_of_samples = 1000;
  set_density(s, o);
  const double before = steepest_growth(s, 1000);
  for (const double width : {2., 4.}) {
    o.density_smoothing = width;
    set_density(s, o);
    CHECK(steepest_growth(s, 1000) < 0.6 * before);
  }
}

TEST_CASE("density does not depend on size, place, direction or order")
{
  const shapes::Soup soup = shapes::ellipsoid(3, 2, 0.5, 3);
  Remeshing_options o = curvature_options(2, 0.2);
  o.density_smoothing = 1;
  Surface reference = shapes::make_surface(soup);
  set_density(reference, o);
  const auto check_same = [&](const shapes::Soup& other, double tolerance) {
    Surface s = shapes::make_surface(other);
    set_density(s, o);
    for (std::size_t v = 0; v < s.points.size(); ++v)
      CHECK(s.vertex_density[v] == doctest::Approx(reference.vertex_density[v]).epsilon(tolerance));
  };
  check_same(shapes::scaled(soup, 1000), 1e-9);
  check_same(shapes::scaled(soup, 1e-3), 1e-9);
  check_same(shapes::translated(soup, {5000, -3000, 1000}), 1e-6);
  check_same(shapes::rotated(soup, 1), 1e-9);

  for (unsigned seed = 0; seed < 3; ++seed) {
    Surface s = shapes::make_surface(shapes::permuted(soup, seed));
    set_density(s, o);
    std::vector<double> a = s.vertex_density, b = reference.vertex_density;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    for (std::size_t v = 0; v < a.size(); ++v) CHECK(a[v] == doctest::Approx(b[v]).epsilon(1e-9));
  }
}

TEST_CASE("the user's own density, in the order of the input's vertices")
{
  shapes::Soup soup = shapes::octahedron();
  soup.points.insert(soup.points.begin(), {9, 9, 9}); // unused
  for (Triangle& t : soup.triangles)
    for (int& v : t) ++v;
  Surface s = shapes::make_surface(soup);
  Remeshing_options o;
  o.gradation = 0;
  set_density(s, o, {-1, 2, 4, 6, 8, 10, 20}); // that of the unused vertex does not matter
  CHECK(s.vertex_density == std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 1});
  o.gradation = 0.1;
  o.number_of_samples = 100;
  set_density(s, o, {1, 1, 1, 1, 1, 1, 1e6});
  CHECK(steepest_growth(s, 100) < 0.11);

  CHECK_THROWS_AS(set_density(s, o, {1, 1, 1, 1, 1, 1}), Invalid_input_error);
  for (const double bad : {0., -1., std::nan(""), infinity})
    CHECK_THROWS_AS(set_density(s, o, {1, 1, 1, bad, 1, 1, 1}), Invalid_input_error);
  o.gradation = -1;
  CHECK_THROWS_AS(set_density(s, o, {1, 1, 1, 1, 1, 1, 1}), Invalid_input_error);
  CHECK_THROWS_AS(set_density(s, o), Invalid_input_error);
  CHECK_THROWS_AS(set_density(s, curvature_options(std::nan(""))), Invalid_input_error);
}
