// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "creased_surface.h"
#include "odd_shapes.h"
#include "relative_distances.h"
#include "shapes.h"

#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/sampling/Candidate_search.h>
#include <CGAL/PowerRTF/sampling/initial_sampling.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

using namespace CGAL::PowerRTF;

namespace {

Remeshing_options options(std::size_t n, Sampling sampling, unsigned seed = 0)
{
  Remeshing_options o;
  o.number_of_samples = n;
  o.sampling = sampling;
  o.random_seed = seed;
  return o;
}

constexpr Sampling all[] = {Sampling::lattice, Sampling::stratified, Sampling::elimination,
                            Sampling::random};

void check_is_sound(const Surface& s, const Samples& samples, std::size_t n)
{
  REQUIRE(samples.points.size() == n);
  REQUIRE(samples.facets.size() == n);
  REQUIRE(samples.normals.size() == n);
  REQUIRE(samples.density.size() == n);
  CHECK(samples.weights == std::vector<double>(n, 0));
  for (std::size_t i = 0; i < n; ++i) {
    const int f = samples.facets[i];
    REQUIRE(f >= 0);
    REQUIRE(f < static_cast<int>(s.triangles.size()));
    const Triangle& t = s.triangles[f];
    const Vec3d &a = s.points[t[0]], &b = s.points[t[1]], &c = s.points[t[2]];
    const Vec3d p = samples.points[i];
    CHECK(std::abs(dot(p - a, s.facet_normals[f])) < 1e-13);
    const double areas =
        length(cross(b - p, c - p)) + length(cross(c - p, a - p)) + length(cross(a - p, b - p));
    CHECK(areas == doctest::Approx(2 * s.facet_areas[f])); // inside the facet
    CHECK(length(samples.normals[i]) == doctest::Approx(1));
    CHECK(samples.density[i] > 0);
  }
}

} // namespace

TEST_CASE("exactly n samples on their facets, for any n from 4")
{
  Surface s = shapes::make_surface(shapes::ellipsoid(3, 2, 1, 2));
  for (const Density density : {Density::uniform, Density::curvature})
    for (const Sampling sampling : all)
      for (const std::size_t n : {4u, 5u, 17u, 320u, 1500u})
        for (unsigned seed = 0; seed < 3; ++seed) {
          Remeshing_options o = options(n, sampling, seed);
          o.density = density;
          set_density(s, o);
          check_is_sound(s, sample_surface(s, o), n);
        }
}

TEST_CASE("what cannot be sampled is refused")
{
  const Surface s = shapes::make_surface(shapes::tetrahedron());
  for (const std::size_t n : {std::size_t(0), std::size_t(3), std::size_t(1) << 40})
    CHECK_THROWS_AS(sample_surface(s, options(n, Sampling::elimination)), Invalid_input_error);
  Remeshing_options o = options(10, Sampling::random);
  o.oversampling = 0.5;
  CHECK_THROWS_AS(sample_surface(s, o), Invalid_input_error);
  o.oversampling = 1;
  check_is_sound(s, sample_surface(s, o), 10);
}

TEST_CASE("more samples than the nodes of a lattice can be numbered for are refused at once")
{
  const Surface s = shapes::make_surface(shapes::icosphere(1));
  CHECK_THROWS_AS(sample_surface(s, options(140000000, Sampling::lattice)), Invalid_input_error);
}

TEST_CASE("the same seed gives the same samples, another seed others")
{
  const Surface s = shapes::make_surface(shapes::torus(20, 10, 2, 1));
  for (const Sampling sampling : all) {
    const Samples a = sample_surface(s, options(500, sampling, 7));
    const Samples b = sample_surface(s, options(500, sampling, 7));
    const Samples c = sample_surface(s, options(500, sampling, 8));
    CHECK(a.points == b.points);
    CHECK(a.facets == b.facets);
    CHECK(a.points != c.points);
  }
}

TEST_CASE("random samples per facet are proportional to area")
{
  const Surface s = shapes::make_surface(shapes::torus(20, 10, 3, 1)); // areas differ by a factor 2
  const std::size_t n = 8000;
  for (unsigned seed = 0; seed < 4; ++seed) {
    const Samples samples = sample_surface(s, options(n, Sampling::random, seed));
    std::vector<double> count(s.triangles.size(), 0);
    for (const int f : samples.facets) ++count[f];
    double chi_2 = 0;
    for (std::size_t f = 0; f < count.size(); ++f) {
      const double expected = n * s.facet_areas[f] / s.area;
      chi_2 += (count[f] - expected) * (count[f] - expected) / expected;
    }
    CHECK(chi_2 > 280); // 399 degrees of freedom, standard deviation 28
    CHECK(chi_2 < 520);
  }
}

TEST_CASE("barycentric coordinates follow the linear density")
{
  for (unsigned seed = 0; seed < 3; ++seed) {
    Random_source random(seed);
    const std::array<double, 3> rho = {1, 4, 15};
    std::array<double, 3> mean{0, 0, 0};
    double small = 0;
    const int count = 20000;
    for (int k = 0; k < count; ++k) {
      const auto b = random.barycentric(rho);
      CHECK(b[0] + b[1] + b[2] == doctest::Approx(1));
      for (int i = 0; i < 3; ++i) {
        CHECK(b[i] >= 0);
        mean[i] += b[i] / count;
      }
      if (b[2] < 0.25) small += 1. / count;
    }
    for (int i = 0; i < 3; ++i) CHECK(std::abs(mean[i] - (0.25 + 0.25 * rho[i] / 20)) < 0.005);
    // P(b_2 < t): the integral of the density over that part, by hand for a linear function.
    const double t = 0.25, at_0 = (rho[0] + rho[1]) / 2, slope = rho[2] - at_0;
    const double share = (at_0 * (1 - (1 - t) * (1 - t)) + slope * (t * t - 2 * t * t * t / 3)) *
                         3 / (2 * at_0 + rho[2]);
    CHECK(std::abs(small - share) < 0.01);
  }
}

TEST_CASE("elimination: no two samples are close, and none is far from all")
{
  const shapes::Soup soups[] = {shapes::icosphere(3), shapes::torus(40, 20, 2, 0.8), shapes::box(1),
                                shapes::plane_patch(5, 5)};
  for (const shapes::Soup& soup : soups)
    for (unsigned seed = 0; seed < 3; ++seed) {
      const Surface s = shapes::make_surface(soup);
      const auto eliminated =
          relative_distances(s, sample_surface(s, options(1000, Sampling::elimination, seed)));
      const auto random =
          relative_distances(s, sample_surface(s, options(1000, Sampling::random, seed)));
      CHECK(eliminated.front() > 0.5);
      CHECK(eliminated[eliminated.size() / 2] > 0.68);
      CHECK(eliminated.back() < 1.3);
      CHECK(random.front() < 0.2);
    }
}

TEST_CASE("elimination follows the density")
{
  Surface s = shapes::make_surface(shapes::icosphere(4));
  Remeshing_options o = options(3000, Sampling::elimination);
  SUBCASE("two halves")
  {
    o.gradation = 0;
    std::vector<double> density;
    for (const Vec3d& p : s.points) density.push_back(p.z > 0 ? 10 : 1);
    set_density(s, o, density);
    const Samples samples = sample_surface(s, o);
    const auto upper = std::count_if(samples.points.begin(), samples.points.end(),
                                     [](const Vec3d& p) { return p.z > 0; });
    double mass = 0;
    for (std::size_t f = 0; f < s.triangles.size(); ++f)
      for (const int v : s.triangles[f])
        if (s.points[s.triangles[f][0]].z > 0) mass += s.vertex_density[v] * s.facet_areas[f] / 3;
    CHECK(upper / 3000. == doctest::Approx(mass / density_integral(s)).epsilon(0.03));
  }
  SUBCASE("spacing 1 : 30")
  {
    o.gradation = 0.3;
    std::vector<double> density;
    for (const Vec3d& p : s.points) density.push_back(p.z > 0.45 ? 900 : 1);
    set_density(s, o, density);
    const Samples samples = sample_surface(s, o);
    const auto distances = relative_distances(s, samples);
    CHECK(distances.front() > 0.4);
    CHECK(distances[distances.size() / 2] > 0.68);
    const auto [low, high] = std::minmax_element(samples.density.begin(), samples.density.end());
    CHECK(*high / *low > 20);
  }
}

TEST_CASE("the sheets of a thin disc do not see each other")
{
  Surface s = shapes::make_surface(shapes::thin_disc(1e-4));
  const Samples samples = sample_surface(s, options(1000, Sampling::elimination));
  std::size_t upper = 0;
  for (const Vec3d& n : samples.normals) upper += n.z > 0;
  CHECK(upper > 470);
  CHECK(upper < 530);
  // Each sheet alone has the full spacing: distances within a sheet.
  for (const bool up : {true, false}) {
    Samples sheet;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if ((samples.normals[i].z > 0) == up) sheet.points.push_back(samples.points[i]);
    sheet.density.assign(sheet.points.size(), 1);
    const auto distances = relative_distances(s, sheet); // half the samples on half the area
    CHECK(distances[distances.size() / 2] * std::sqrt(2.) > 0.68);
    CHECK(distances.front() * std::sqrt(2.) > 0.5);
  }
}

TEST_CASE("the choice does not depend on the input's size and place")
{
  const shapes::Soup soups[] = {shapes::ellipsoid(3, 2, 1, 3), shapes::two_spheres(2),
                                shapes::box(4), shapes::torus(30, 12, 2, 0.5)};
  for (const shapes::Soup& soup : soups)
    for (const Sampling sampling : all)
      for (const Density density : {Density::uniform, Density::curvature}) {
        Remeshing_options o = options(801, sampling, 3);
        o.density = density;
        Surface s = shapes::make_surface(soup);
        set_density(s, o);
        const Samples reference = sample_surface(s, o);
        // The fields of a lattice are in single precision: rounded otherwise, it is another
        // lattice.
        const bool is_lattice = sampling == Sampling::lattice;
        for (const double factor :
             {is_lattice ? 1024. : 1000., is_lattice ? 0x1p-10 : 1e-3, is_lattice ? 4. : 3.}) {
          Surface other = shapes::make_surface(shapes::scaled(soup, factor));
          set_density(other, o);
          const Samples samples = sample_surface(other, o);
          CHECK(samples.facets == reference.facets);
          for (std::size_t i = 0; i < samples.size(); ++i) {
            const Vec3d expected = factor * s.normalization.to_outside(reference.points[i]);
            const Vec3d difference = other.normalization.to_outside(samples.points[i]) - expected;
            CHECK(length(difference) * s.normalization.scale < 1e-10 * factor);
          }
        }
      }
}

TEST_CASE("rotation and order change the samples, not their distribution")
{
  const shapes::Soup soup = shapes::ellipsoid(3, 2, 1, 3);
  const Remeshing_options o = options(1000, Sampling::elimination);
  for (unsigned seed = 0; seed < 3; ++seed)
    for (const shapes::Soup& other :
         {shapes::rotated(soup, 0.5 + seed), shapes::permuted(soup, seed)}) {
      const Surface s = shapes::make_surface(other);
      const Samples samples = sample_surface(s, o);
      const auto distances = relative_distances(s, samples);
      CHECK(distances.front() > 0.55);
      CHECK(distances[500] == doctest::Approx(0.74).epsilon(0.05));
    }
}

TEST_CASE("round patches with five samples around them get one in the middle")
{
  const std::size_t n = 16; // on a can as high as it is wide
  const Surface can = shapes::with_creases(shapes::can(60, 4), n);
  const Cut_surface cut = cut_along_creases(can);
  const Feature_samples features = sample_features(can, cut, n);
  REQUIRE(features.size() == 10);
  const auto topology = internal::known_topology(cut.surface, CGAL::Sequential_tag());
  std::multiset<std::size_t> samples;
  for (const Component_share& share :
       component_shares(cut.surface, n, features, *topology, CGAL::Sequential_tag()))
    samples.insert(share.samples);
  CHECK(samples == std::multiset<std::size_t>{1, 1, 4});
}

TEST_CASE("strips with room for one row of triangles, and less than one sample, get none")
{
  const std::size_t n = 260; // a little farther apart than the bar is wide
  const shapes::Soup bar = translated(shapes::long_box(10, 1, 1), {20, 0, 0});
  const Surface parts = shapes::with_creases(joined(scaled(shapes::box(3), 3), bar), n);
  const Cut_surface cut = cut_along_creases(parts);
  const Feature_samples features = sample_features(parts, cut, n);
  const auto topology = internal::known_topology(cut.surface, CGAL::Sequential_tag());
  const std::vector<char> is_narrow = internal::narrow_components(cut.surface, features, *topology);
  const auto shares = component_shares(cut.surface, n, features, *topology, CGAL::Sequential_tag());
  CHECK(std::count(is_narrow.begin(), is_narrow.end(), 1) == 4); // the long sides
  const std::vector<int>& patches = features.sites.patches;
  double room = 0;
  for (int c = 0; c < topology->size(); ++c) {
    if (!is_narrow[c]) continue;
    CHECK(shares[c].samples == 0);
    const auto sites = static_cast<double>(std::count(patches.begin(), patches.end(), c));
    room += std::max(0., shares[c].mass / shares[c].cell_mass - sites / 2 + 1);
  }
  CHECK(room > 1);
  CHECK(room < 4);

  std::vector<double> rooms{-1, 0.4, 0.8, 10}, small{0.4, 0.4, 1};
  internal::empty_small_rooms({1, 0, 1, 0}, rooms);
  CHECK(rooms == std::vector<double>{0, 0.4, 0, 10});
  internal::empty_small_rooms({1, 1, 0}, small); // where would all go?
  CHECK(small == std::vector<double>{0.4, 0.4, 1});
}

TEST_CASE("components share the samples by mass, at least four each")
{
  using Counts = std::vector<std::size_t>;
  const auto allocate = [](const std::vector<double>& masses, std::size_t n) {
    return internal::allocate_samples(masses, Counts(masses.size(), 4), n);
  };
  CHECK(allocate({1, 1}, 10) == Counts{5, 5});
  CHECK(allocate({1, 1}, 11) == Counts{6, 5});
  CHECK(allocate({1, 1 + 1e-14}, 11) == Counts{6, 5});
  CHECK(allocate({3, 1}, 100) == Counts{75, 25});
  CHECK(allocate({1, 1e-9, 2}, 34) == Counts{10, 4, 20});
  CHECK(allocate({1, 1, 1}, 12) == Counts{4, 4, 4});
  CHECK(allocate({5, 3, 2}, 7) == Counts{4, 2, 1}); // too few for four each
  CHECK(allocate({1, 0}, 9) == Counts{9, 0});
  CHECK(internal::allocate_samples({1, 1, 1}, {0, 9, 0}, 12) == Counts{2, 9, 1});
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<double> masses(1 + random() % 30);
    for (double& m : masses) m = std::pow(10., -static_cast<double>(random() % 6)) + 1e-3;
    const std::size_t n = 4 * masses.size() + random() % 1000;
    const Counts counts = allocate(masses, n);
    CHECK(std::accumulate(counts.begin(), counts.end(), std::size_t(0)) == n);
    CHECK(*std::min_element(counts.begin(), counts.end()) >= 4);
  }

  const shapes::Soup small = shapes::scaled(shapes::icosphere(1), 1e-4);
  const shapes::Soup far_and_small =
      shapes::joined(shapes::icosphere(3), shapes::translated(small, {2, 0, 0}));
  const Surface s = shapes::make_surface(far_and_small);
  for (const Sampling sampling : all) {
    const Samples samples = sample_surface(s, options(500, sampling));
    check_is_sound(s, samples, 500);
    const auto on_small = std::count_if(samples.facets.begin(), samples.facets.end(),
                                        [](int f) { return f >= 1280; });
    CHECK(on_small == 4);
  }
}

TEST_CASE("grid: points within a radius, compared with all pairs")
{
  for (unsigned seed = 0; seed < 4; ++seed) {
    Random_source random(seed);
    std::vector<Vec3d> points;
    std::vector<int> even;
    for (int i = 0; i < 600; ++i) {
      points.push_back({random() - 0.5, random() - 0.5, seed % 2 ? 0 : random() - 0.5});
      if (i % 2 == 0) even.push_back(i);
    }
    for (const double radius : {1e-9, 0.03, 0.2, 2.}) {
      const Point_grid grid(points, even, 0.1);
      for (int q = 0; q < 50; ++q) {
        std::set<int> found, expected;
        grid.for_each_near(points[q], radius,
                           [&](int i, double) { CHECK(found.insert(i).second); });
        for (const int i : even)
          if (length(points[i] - points[q]) <= radius) expected.insert(i);
        CHECK(found == expected);
      }
    }
  }
  const Point_grid empty({}, {}, 0.1);
  empty.for_each_near({0, 0, 0}, 1, [](int, double) { FAIL("there is no point"); });
}

namespace {

using Candidates = internal::Elimination_candidates;

/// The heaviest candidate goes, of equal ones the last, until n are left. When all are weightless,
/// they look farther, and after some time to all sides.
std::vector<int> eliminated_in_turn(const Candidates& candidates, std::size_t n)
{
  double reach = 1;
  int round = 0;
  const auto weight = [&](int i, const std::vector<int>& alive) {
    double w = 0;
    for (const int j : alive) {
      const auto &a = candidates[i], &b = candidates[j];
      const double x = 1 - length(a.point - b.point) / (reach * (a.radius + b.radius));
      const bool is_seen = round >= 16 || dot(a.normal, b.normal) > 0;
      if (j != i && x > 0 && is_seen) w += std::pow(x, 8);
    }
    return w;
  };
  std::vector<int> alive(candidates.size());
  std::iota(alive.begin(), alive.end(), 0);
  while (alive.size() > n) {
    const auto heaviest = std::max_element(alive.begin(), alive.end(), [&](int a, int b) {
      return std::pair(weight(a, alive), a) < std::pair(weight(b, alive), b);
    });
    if (n == 0 || weight(*heaviest, alive) > 0) {
      alive.erase(heaviest);
    } else {
      reach *= 1.25;
      ++round;
    }
  }
  return alive;
}

} // namespace

TEST_CASE("the graph has all that see each other, in order")
{
  Random_source random(3);
  Candidates candidates;
  for (int i = 0; i < 1700; ++i) { // several parts of the graph
    const Vec3d point{2 * random() - 1, 2 * random() - 1, 0.1 * random()};
    const double radius = i % 100 == 0 ? 0.3 : 0.01 + 0.02 * random();
    candidates.push_back({point, {0, 0, i % 5 == 0 ? -1. : 1.}, radius});
  }
  for (const double cos_angle : {0.5, -2.}) {
    const internal::Candidate_graph graph =
        internal::candidate_graph(candidates, cos_angle, CGAL::Parallel_if_available_tag());
    std::vector<int> order(graph.order.begin(), graph.order.end());
    std::sort(order.begin(), order.end());
    for (int i = 0; i < int(candidates.size()); ++i) CHECK(order[i] == i);
    for (int k = 0; k < int(candidates.size()); ++k) {
      std::vector<int> expected, found;
      for (int l = 0; l < int(candidates.size()); ++l) {
        const auto &a = candidates[graph.order[k]], &b = candidates[graph.order[l]];
        if (l != k && length(a.point - b.point) < a.radius + b.radius &&
            dot(a.normal, b.normal) >= cos_angle)
          expected.push_back(l);
      }
      graph.for_each_neighbor(k, [&](const auto& neighbor) { found.push_back(neighbor.place); });
      CHECK(found == expected);
    }
  }
}

TEST_CASE("elimination against its definition")
{
  for (unsigned seed = 0; seed < 3; ++seed) {
    Random_source random(seed);
    Candidates candidates;
    for (int i = 0; i < 200; ++i) {
      const Vec3d point{random(), random(), 0};
      candidates.push_back({point, {0, 0, i % 5 == 0 ? -1. : 1.}, 0.02 * (1 + 9 * random())});
    }
    for (const std::size_t n : {0, 1, 60, 190, 199, 200, 300}) {
      const std::vector<int> expected = eliminated_in_turn(candidates, n);
      CHECK(eliminate_samples(candidates, 0.5, n) == expected);
      CHECK(eliminate_samples(candidates, 0.5, n, 0, CGAL::Parallel_if_available_tag()) ==
            expected);
    }
  }
  CHECK(eliminate_samples({}, 0.5, 0).empty());
}

TEST_CASE("elimination by searches chooses the same candidates, or leaves them to the host")
{
  using Backend = Host_backend<CGAL::Parallel_if_available_tag>;
  const auto chosen_by_search = [](const Candidates& candidates, std::size_t n, std::size_t fixed) {
    Backend backend;
    const int size = int(candidates.size()), free = size - int(fixed);
    const internal::Candidate_search<Backend> search(
        backend, size, [&](int i) { return candidates[i]; }, 0.5);
    internal::Candidate_elimination<Backend, internal::Candidate_search_view> elimination(
        backend, search.view(), search.order(), size, free);
    std::vector<int> left;
    if (!elimination.run(n, [](const int*, int, double) { return false; })) return left;
    left.resize(free);
    left.resize(elimination.write_left(left.data()));
    return left;
  };
  for (unsigned seed = 0; seed < 3; ++seed) {
    Random_source random(seed);
    Candidates candidates;
    for (int i = 0; i < 2000; ++i) {
      const Vec3d point{random(), random(), 0.1 * random()};
      candidates.push_back(
          {point, {0, 0, i % 5 == 0 ? -1. : 1.}, i % 100 == 0 ? 0.2 : 0.02 * (1 + random())});
    }
    for (const std::size_t fixed : {0, 100})
      for (const std::size_t n : {1000, 1500, 1890}) {
        const std::vector<int> expected = eliminate_samples(candidates, 0.5, n, fixed);
        CHECK(expected.size() == n);
        CHECK(chosen_by_search(candidates, n, fixed) == expected);
      }
  }
  Candidates line; // closer and closer together: each waits for the next one
  for (int i = 0; i < 300; ++i) line.push_back({{-1 + std::pow(0.99, i), 0, 0}, {0, 0, 1}, 0.1});
  CHECK(chosen_by_search(line, 100, 0).empty());
}

TEST_CASE("elimination where each candidate waits for the next one")
{
  Candidates line; // closer and closer together
  for (int i = 0; i < 300; ++i) line.push_back({{-1 + std::pow(0.99, i), 0, 0}, {0, 0, 1}, 0.1});
  for (const std::size_t n : {5, 100, 250})
    CHECK(eliminate_samples(line, 0.5, n) == eliminated_in_turn(line, n));
}

TEST_CASE("elimination leaves no part out where candidates are too far apart to see each other")
{
  Candidates line;
  for (int i = 0; i < 300; ++i)
    line.push_back({{0.01 * i, 0, 0}, {0, 0, i % 2 == 0 ? 1. : -1.}, 0.001});
  for (const std::size_t n : {40, 100, 200}) {
    const std::vector<int> chosen = eliminate_samples(line, 0.5, n);
    CHECK(chosen.size() == n);
    CHECK(chosen == eliminated_in_turn(line, n));
    int largest = (std::max)(chosen.front(), 299 - chosen.back());
    for (std::size_t k = 1; k < n; ++k) largest = (std::max)(largest, chosen[k] - chosen[k - 1]);
    CHECK(largest <= 3 * 300 / static_cast<int>(n));
  }
}

TEST_CASE("fixed candidates crowd the others, and stay")
{
  Random_source random(1);
  Candidates candidates;
  for (int i = 0; i < 400; ++i) candidates.push_back({{random(), random(), 0}, {0, 0, 1}, 0.05});
  for (int i = 0; i < 100; ++i) candidates.push_back({{0.01 * i, 0.5, 0}, {0, 0, 1}, 0.05});
  const std::vector<int> chosen = eliminate_samples(candidates, 0.5, 60, 100);
  CHECK(chosen.size() == 60);
  CHECK(chosen.back() < 400);
  for (const int i : chosen) CHECK(std::fabs(candidates[i].point.y - 0.5) > 0.02);
}
