// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "flat_lattice.h"
#include "packed.h"
#include "relative_distances.h"
#include "shapes.h"
#include "sweeps.h"

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/sampling/Lattice_field.h>
#include <CGAL/PowerRTF/sampling/plan_lattice.h>
#include <CGAL/PowerRTF/sampling/random_source.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <vector>

using namespace CGAL::PowerRTF;

namespace {

constexpr double pi = 3.14159265358979323846;

Remeshing_options options(std::size_t n, Sampling sampling, unsigned seed)
{
  Remeshing_options o;
  o.number_of_samples = n;
  o.sampling = sampling;
  o.random_seed = seed;
  return o;
}

double distance_of(Phasor a, Phasor b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Distance of `p` to the nearest point of the lattice, relative to its spacing.
double distance_to_lattice(const Vec3d& p, double angle, double h, const Vec3d& origin)
{
  const Vec3d d = (p - origin) * (1 / h);
  const double x = std::cos(angle) * d.x + std::sin(angle) * d.y;
  const double y = std::cos(angle) * d.y - std::sin(angle) * d.x;
  const double row = std::round(y / std::sqrt(0.75));
  const double at = x - 0.5 * row;
  return std::hypot(at - std::round(at), y - std::sqrt(0.75) * row);
}

} // namespace

TEST_CASE("phasors are those of the library, counted numbers are uniform")
{
  for (int k = -4000; k <= 4000; ++k) {
    const float turns = float(k) / 1000.f;
    const Phasor exact{float(std::cos(2 * pi * turns)), float(std::sin(2 * pi * turns))};
    CHECK(distance_of(phasor_at(turns), exact) < 5e-5);
    CHECK(std::abs(std::remainder(turns_of(exact) - turns, 1.f)) < 1e-6);
  }
  for (const float turns : {4e6f, 5e10f, -5e10f, std::numeric_limits<float>::infinity(),
                            std::numeric_limits<float>::quiet_NaN()})
    CHECK(distance_of(phasor_at(turns), Phasor{1, 0}) == 0);
  std::vector<int> counts(64, 0);
  for (int i = 0; i < 64000; ++i) ++counts[int(64 * counted_random(7, i, i % 3))];
  double chi_2 = 0;
  for (const int c : counts) chi_2 += (c - 1000.) * (c - 1000.) / 1000;
  CHECK(chi_2 > 25); // 63 degrees of freedom, standard deviation 11
  CHECK(chi_2 < 110);
}

TEST_CASE("a product of stored phasors can be stored")
{
  const Phasor a = Short_phasor(Phasor{1, 0}), near_a = Short_phasor(phasor_at(0.0009f));
  for (const Phasor turn : {Phasor{1, 0}, Phasor{0, 1}, Phasor{-1, 0}, Phasor{0, -1}})
    for (const Phasor p : {a, near_a}) {
      const Phasor longer = Phasor{1.00006f, 0} * p * turn; // the most by three factors' rounding
      CHECK(distance_of(Short_phasor(longer), longer) < 1e-4);
    }
}

TEST_CASE("a turn by the tangent of a quarter of its angle")
{
  double worst = 0, worst_short = 0;
  for (int k = -100000; k <= 100000; ++k) {
    const float turns = float(k) / 50000;
    const Phasor exact{float(std::cos(2 * pi * turns)), float(std::sin(2 * pi * turns))};
    worst = std::max(worst, distance_of(phasor_of_quarter(quarter_tangent(exact)), exact));
    worst_short = std::max(worst_short, distance_of(Short_turn(turns), exact));
  }
  CHECK(worst < 1e-6);
  CHECK(worst_short < 1e-4);
  CHECK(distance_of(Short_turn(4e6f), Phasor{1, 0}) == 0);
}

TEST_CASE("a perfect lattice is a fixed point, whatever the nodes' axes")
{
  for (unsigned seed = 0; seed < 5; ++seed) {
    const double angle = 0.3 + seed;
    const Vec3d origin{0.01 * seed, 0.02, 0};
    Flat_lattice flat(300, seed, angle, 0.11f, origin);
    const Lattice_view view = flat.view();
    double worst_wave = 0, worst_direction = 0, worst_point = 0, farthest = 0;
    for (int i = 0; i < view.size; ++i) {
      float distance;
      const Vec3d p = to_double(nearest_lattice_point(view, i, distance));
      worst_point = std::max(worst_point, distance_to_lattice(p, angle, 0.11, origin));
      farthest = std::max(farthest, double(distance));
      const int j = (7 * i + 1) % view.size;
      const Waves arrived = carried(wave_edge(view, j, view, i, view.frame(i)), view.waves[j]);
      for (int k = 0; k < Waves::size; ++k)
        worst_wave = std::max(worst_wave, distance_of(arrived.wave[k], view.waves[i].wave[k]));
      const Phasor direction = direction_turn(view, j, view, i) * axis_direction(view, j);
      worst_direction = std::max(worst_direction, distance_of(direction, axis_direction(view, i)));
    }
    CHECK(worst_wave < 1e-3);
    CHECK(worst_direction < 1e-3);
    CHECK(worst_point < 1e-3);
    CHECK(farthest < 0.578); // of a triangle's center: 1 / sqrt 3
  }
}

TEST_CASE("a lattice whose spacing grows like the radius turns with the angle")
{
  // w = log z maps such a lattice to a uniform one.
  Flat_lattice flat(3000, 3, 0, 0.1f, {0, 0, 0});
  std::vector<Lattice_edge> edges(flat.points.size() * Lattice_view::degree);
  for (std::size_t i = 0; i < flat.points.size(); ++i) {
    flat.points[i].x += 1; // away from the pole
    flat.spacing[i] = 0.1f * length(flat.points[i]);
  }
  Host_backend<CGAL::Sequential_tag> backend;
  const Point_tree tree(backend, flat.points.data(), static_cast<int>(flat.points.size()));
  Lattice_view view = flat.view();
  view.edges = edges.data();
  for (int leaf = 0; leaf < tree.view().leaves(); ++leaf)
    Find_neighbors_of_leaf{{view, tree.view(), 0, 0.85f}}(leaf);
  std::vector<Lattice_edge> edges_by_node(edges.size()); // as a GPU looks for them
  Lattice_view by_node = view;
  by_node.edges = edges_by_node.data();
  for (int i = 0; i < view.size; ++i) Find_neighbors_of_node{{by_node, tree.view(), 0, 0.85f}}(i);
  CHECK(std::equal(edges.begin(), edges.end(), edges_by_node.begin(),
                   [](const Lattice_edge& a, const Lattice_edge& b) { return a.node == b.node; }));
  std::vector<double> errors;
  for (int i = 0; i < view.size; ++i) {
    Set_turning{view}(i);
    const Vec3d p = to_double(flat.points[i]);
    const double r_2 = squared_length(p);
    errors.push_back(std::hypot(view.turning[i].x + p.y / r_2, view.turning[i].y - p.x / r_2));
  }
  std::sort(errors.begin(), errors.end());
  CHECK(errors[errors.size() / 2] < 0.02);
  CHECK(errors[errors.size() * 99 / 100] < 0.1);
}

namespace {

using Backend = Host_backend<CGAL::Sequential_tag>;

/// Of each node of a flat piece, whether no point is nearer than 0.7 of the spacing.
std::vector<unsigned char> gaps_without(const std::vector<Seen_point>& points,
                                        const Lattice_view& view)
{
  std::vector<unsigned char> gaps(view.free);
  for (int i = 0; i < view.free; ++i)
    gaps[i] = std::none_of(points.begin(), points.end(), [&](const Seen_point& p) {
      return length(to_double(p.point) - to_double(view.points[i])) <=
             0.7 * double(view.spacing(i));
    });
  return gaps;
}

template <class Buffer>
auto items_of(const Buffer& buffer)
{
  return std::vector(buffer.data(), buffer.data() + buffer.size());
}

Chosen_points<Backend> chosen(Backend& backend, const std::vector<int>& nodes,
                              const std::vector<Seen_point>& points)
{
  Chosen_points<Backend> result;
  result.nodes.allocate(backend, nodes.size());
  result.points.allocate(backend, points.size());
  std::copy(nodes.begin(), nodes.end(), result.nodes.data());
  std::copy(points.begin(), points.end(), result.points.data());
  return result;
}

} // namespace

TEST_CASE("a flat piece gets one lattice, whatever it begins from")
{
  const Surface surface = shapes::make_surface(shapes::plane_patch(7, 7));
  const Packed<double> packed(surface);
  const std::vector<int> component(surface.triangles.size(), 0);
  Lattice_plan plan =
      lattice_plan(surface, {{0, 0, 0}, 1}, packed.tree, {}, component,
                   {{450, surface.area, surface.area / 450}}, 0, CGAL::Sequential_tag());
  plan.free.clear();
  for (std::size_t count = 2700; count > 32; count /= 2) plan.free.push_back(count);
  plan.sites.resize(plan.free.size());
  Backend backend;
  for (unsigned seed = 0; seed < 3; ++seed) {
    plan.seed = seed;
    Lattice_field<Backend> field(backend, packed.view(), plan);
    field.solve(1);
    const Lattice_view view = field.view();
    double worst = 0;
    for (int i = 1; i < view.size; ++i) {
      const Phasor direction = axis_direction(view, i);
      worst = std::max(worst, distance_of(direction, axis_direction(view, 0)));
      worst = std::max(worst, std::abs(std::hypot(direction.x, direction.y) - 1.));
    }
    CHECK(worst < 0.05); // 0.5 degrees of the axes
    int agree = 0, edges = 0;
    for (int i = 0; i < view.size; ++i)
      for_each_edge(view, i, [&](const Lattice_edge& edge) {
        const Waves waves = carried(edge, view.waves[edge.node]);
        agree += distance_of(waves.wave[0], view.waves[i].wave[0]) < 0.5;
        ++edges;
      });
    CHECK(agree > 0.97 * edges); // but for some dislocations
    const std::size_t count = field.find_points();
    std::vector<int> nodes = items_of(field.points().nodes);
    std::vector<Seen_point> points = items_of(field.points().points);
    CHECK(field.count_twins(field.points()) < nodes.size() / 20);
    CHECK(count + field.count_twins(field.points()) == nodes.size());
    CHECK(gaps_without(points, view) == items_of(field.gaps(field.points())));
    nodes.resize(nodes.size() / 2);
    points.resize(nodes.size());
    const std::size_t twins = field.count_twins(chosen(backend, nodes, points));
    for (const int k : {0, 5, 9}) { // again, seen by others from farther away
      nodes.push_back(nodes[k] + 1);
      points.push_back({points[k].point, points[k].distance + 0.1f});
    }
    const Chosen_points<Backend> more = chosen(backend, nodes, points);
    CHECK(gaps_without(points, view) == items_of(field.gaps(more)));
    CHECK(field.count_twins(more) == twins + 3);
  }
}

TEST_CASE("small components have no lattice, and the report says so")
{
  Remeshing_options o;
  o.number_of_samples = 1000;
  o.sampling = Sampling::lattice;
  std::size_t off_lattice = 1;
  sample_surface(shapes::make_surface(shapes::torus(40, 20, 2, 1)), o, {}, nullptr, &off_lattice);
  CHECK(off_lattice < 20);
  const shapes::Soup both =
      shapes::joined(shapes::icosphere(3),
                     shapes::translated(shapes::scaled(shapes::icosphere(3), 0.2), {3, 0, 0}));
  const Surface surface = shapes::make_surface(both);
  const Samples samples = sample_surface(surface, o, {}, nullptr, &off_lattice);
  std::size_t small = 0;
  for (const Vec3d& p : samples.points) small += surface.normalization.to_outside(p).x > 2;
  CHECK(small > 20);
  CHECK(small < 50);
  CHECK(off_lattice >= small);
  CHECK(off_lattice < small + 20);
  o.sampling = Sampling::stratified;
  sample_surface(surface, o, {}, nullptr, &off_lattice);
  CHECK(off_lattice == 0);
}

TEST_CASE("the number of threads and who makes the facets' tree change nothing")
{
  for (const shapes::Soup& soup : {shapes::torus(20, 10, 2, 1), shapes::two_spheres(3)})
    for (const Sampling sampling :
         {Sampling::lattice, Sampling::stratified, Sampling::elimination}) {
      const Surface s = shapes::make_surface(soup);
      const Facet_tree tree(s.points, s.triangles);
      const Remeshing_options o = options(900, sampling, 7);
      const Samples a = sample_surface<CGAL::Sequential_tag>(s, o);
      const Samples b = sample_surface<CGAL::Parallel_if_available_tag>(s, o, {}, &tree);
      CHECK(a.points == b.points);
      CHECK(a.facets == b.facets);
      CHECK(a.patches == b.patches);
    }
}

TEST_CASE("stratified samples: one in each part of equal mass")
{
  // On a square of two triangles each part is a right triangle of its area, or near it: any disc
  // has nearly its share, which independent samples miss by the root of their number.
  const Surface s = shapes::make_surface(shapes::plane_patch(1, 1));
  const std::size_t n = 4096;
  double stratified = 0, random = 0; // squared errors
  for (unsigned seed = 0; seed < 8; ++seed)
    for (const Sampling sampling : {Sampling::stratified, Sampling::random}) {
      Remeshing_options o = options(n, sampling, seed);
      o.oversampling = 1;
      const Samples samples = sample_surface(s, o);
      Vec3d low = samples.points[0], high = low;
      for (const Vec3d& p : s.points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
      }
      const Vec3d center = 0.5 * (low + high);
      const double radius = 0.3 * (high.x - low.x);
      double inside = 0;
      for (const Vec3d& p : samples.points)
        inside += std::hypot(p.x - center.x, p.y - center.y) < radius;
      const double error = inside - n * pi * radius * radius / s.area;
      (sampling == Sampling::random ? random : stratified) += error * error / 8;
    }
  CHECK(stratified < 0.2 * random);
}

TEST_CASE("a lattice: most samples have their neighbors at its spacing")
{
  const shapes::Soup soups[] = {shapes::icosphere(4), shapes::torus(60, 30, 2, 0.8),
                                shapes::ellipsoid(3, 2, 1, 4)};
  const int runs = 9;
  int wide = 0; // one in 40 has a sample that is a little farther from all others
  double sum = 0;
  for (const shapes::Soup& soup : soups)
    for (unsigned seed = 0; seed < 3; ++seed) {
      const Surface s = shapes::make_surface(soup);
      const auto lattice =
          relative_distances(s, sample_surface(s, options(1000, Sampling::lattice, seed)));
      CHECK(lattice.front() > 0.45);
      CHECK(lattice[200] > 0.85);
      CHECK(lattice[500] > 0.92);
      CHECK(lattice.back() < 1.12);
      wide += !(lattice.back() < 1.1);
      sum += lattice.back();
    }
  CHECK(wide <= 1);
  CHECK(sum < 1.05 * runs);
}

TEST_CASE("on a surface thinner than the spacing samples are distinct, and everywhere")
{
  for (const unsigned seed : {0u, 1u})
    for (const shapes::Soup& soup :
         {shapes::ellipsoid(1, 1e-4, 1e-4, 3), shapes::cone(32, 1, 1e4, 1)}) {
      const Surface s = shapes::make_surface(soup);
      const Samples samples = sample_surface(s, options(3000, Sampling::lattice, seed));
      CHECK(samples.size() == 3000);
      Box3<double> box{s.points[0], s.points[0]};
      for (const Vec3d& p : s.points) box.add(p);
      const Vec3d size = box.hi - box.lo;
      const bool is_along_x = size.x > size.z;
      std::vector<double> along{is_along_x ? box.lo.x : box.lo.z, is_along_x ? box.hi.x : box.hi.z};
      std::set<std::array<double, 3>> distinct;
      for (const Vec3d& p : samples.points) {
        along.push_back(is_along_x ? p.x : p.z);
        distinct.insert({p.x, p.y, p.z});
      }
      CHECK(distinct.size() == 3000);
      std::sort(along.begin(), along.end());
      double largest = 0;
      for (std::size_t k = 1; k < along.size(); ++k)
        largest = (std::max)(largest, along[k] - along[k - 1]);
      CHECK(largest < 0.03); // the tips are thin: few samples have so much area
    }
}
