// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The CUDA engine on a GPU, against the CPU engine and the oracle. Skipped where there is no GPU or
// the engine is not built.
#include "engine_comparison.h"
#include "relative_distances.h"
#include "unknown_mesh.h"

#include <CGAL/PowerRTF/engines/Cuda_engine.h>
#include <CGAL/PowerRTF/engines/close_faces.h>
#include <CGAL/PowerRTF/exact/check_cells.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Surface_arrays.h>
#include <CGAL/PowerRTF/geometry/make_surface_in_tree.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/quality/surface_distance.h>
#include <CGAL/PowerRTF/sampling/Lattice_field.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <tuple>
#include <utility>
#include <vector>

using namespace engine_comparison;

#ifdef CGAL_POWER_RTF_WITH_CUDA

namespace {

template <class Engine>
void run(Engine& engine, const Remeshing_options& o, int iterations)
{
  for (int k = 0; k < iterations; ++k) {
    engine.build_cells();
    if (o.weight_method == Weight_method::multiplicative) engine.optimize_weights(5);
    engine.move_samples(k < 3 ? Position_method::lloyd : o.position_method);
  }
  engine.build_cells();
  if (o.position_method == Position_method::lbfgs) engine.restore_best();
  if (o.weight_method == Weight_method::newton)
    for (int k = 0; k < 3; ++k) engine.newton_weights();
}

Case large_case(bool paper, Density density)
{
  return {paper ? "paper" : "quality", shapes::torus(96, 48, 1, 0.3),
          options_of(paper, density, 20000)};
}

} // namespace

TEST_CASE("in double precision the steps are those of the CPU engine")
{
  for (const Case& c : cases()) compare<Cuda_engine<double>>(c, 1e-6);
}

namespace {

using Tag = CGAL::Parallel_if_available_tag;

/// A lattice of the CPU, on a surface that differs from the true one by at most a rounding; number
/// 0 on this one itself.
Samples lattice_but_for_rounding(const Case& c, const Start& start, unsigned number)
{
  const Surface& surface = start.patches->surface();
  const Facet_tree tree(surface.points, surface.triangles, surface.facet_patches);
  Host_backend<Tag> backend;
  const Surface_arrays<double, Host_backend<Tag>> arrays(
      backend, internal::make_surface_in_tree(surface, tree));
  Surface_view<double> view = arrays.view();
  std::vector<Facet_corners<double>> facets(view.facets, view.facets + surface.triangles.size());
  std::vector<Vertex_attributes<double>> attributes(view.attributes,
                                                    view.attributes + surface.points.size());
  view.facets = facets.data();
  view.attributes = attributes.data();
  std::mt19937 random(number);
  std::uniform_real_distribution<double> ulp(-6e-8, 6e-8); // of 1, which no coordinate exceeds
  const auto move = [&](Vec3d& v) {
    if (number > 0) v += Vec3d{ulp(random), ulp(random), ulp(random)};
  };
  for (Facet_corners<double>& f : facets)
    for (Vec3d* corner : {&f.a, &f.b, &f.c}) move(*corner);
  for (Vertex_attributes<double>& a : attributes) move(a.normal);
  const auto make = [&](const Lattice_plan& plan) {
    return std::make_unique<Lattice_field<Host_backend<Tag>>>(backend, view, plan);
  };
  return sample_surface<Tag>(surface, c.options, start.patches->features(), &tree, nullptr, make);
}

/// A device's field that leaves the choice to the host, or counts those that it has made.
class Field_with_choice final : public Lattice_field_base {
public:
  Field_with_choice(std::unique_ptr<Lattice_field_base>&& field, int* choices)
      : m_field(std::move(field)), m_choices(choices)
  {}

  void solve(float factor) override { m_field->solve(factor); }
  std::size_t find_points() override { return m_field->find_points(); }
  Sample_candidates candidates() override { return m_field->candidates(); }
  std::optional<Sample_candidates> choose_candidates(std::size_t n) override
  {
    if (!m_choices) return std::nullopt;
    std::optional<Sample_candidates> chosen = m_field->choose_candidates(n);
    *m_choices += chosen.has_value();
    return chosen;
  }
  Sample_candidates nodes_of(const std::vector<unsigned char>& is_wanted) override
  {
    return m_field->nodes_of(is_wanted);
  }

private:
  std::unique_ptr<Lattice_field_base> m_field;
  int* m_choices;
};

/// How many of `a` are not among `b`.
std::size_t number_of_others(std::vector<Vec3d> a, std::vector<Vec3d> b)
{
  const auto less = [](const Vec3d& p, const Vec3d& q) {
    return std::tie(p.x, p.y, p.z) < std::tie(q.x, q.y, q.z);
  };
  std::sort(a.begin(), a.end(), less);
  std::sort(b.begin(), b.end(), less);
  std::vector<Vec3d> others;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(others), less);
  return others.size();
}

/// Whether most samples are at the same places, and both arrangements as regular.
bool are_alike(const Surface& surface, const Samples& a, const Samples& b)
{
  if (a.size() != b.size()) return false;
  const double C = spacing_constant(surface, a.size());
  std::vector<double> distances; // of samples to the other lattice, by the spacing
  for (std::size_t i = 0; i < a.size(); ++i) {
    double nearest = 4;
    for (const Vec3d& p : b.points) nearest = std::min(nearest, squared_length(p - a.points[i]));
    distances.push_back(std::sqrt(nearest * a.density[i]) / C);
  }
  std::sort(distances.begin(), distances.end());
  bool result = distances[distances.size() / 2] < 0.05;
  const auto of_a = relative_distances(surface, a), of_b = relative_distances(surface, b);
  for (const double share : {0.2, 0.5, 0.8}) {
    const std::size_t k = std::size_t(share * double(of_a.size()));
    result = result && std::abs(of_a[k] - of_b[k]) < 0.02;
  }
  return result;
}

} // namespace

// Rounding decides between points that fit as well, and where a lattice stays that may slide at
// nearly no cost. So the CPU's lattice is not one, but those that it makes of nodes that differ by
// a rounding: on a torus with 60 samples they have two arrangements.
TEST_CASE("a lattice made on the device is one that rounding lets the CPU make")
{
  constexpr unsigned most = 32; // lattices of the CPU that are compared
  const shapes::Soup torus = shapes::torus(96, 48, 1, 0.3);
  const Case shapes[] = {
      {"torus", torus, options_of(false, Density::uniform, 0)},
      {"torus, adaptive", torus, options_of(false, Density::curvature, 0)},
      {"box with creases", shapes::box(4), options_of(false, Density::uniform, 0)}};
  for (Case c : shapes)
    for (const std::size_t n : {60u, 900u, 6000u})
      for (unsigned seed = 0; seed < 3; ++seed) {
        CAPTURE(c.name);
        CAPTURE(n);
        CAPTURE(seed);
        c.options.number_of_samples = n;
        c.options.random_seed = seed;
        const Start start(c);
        const Surface& surface = start.patches->surface();
        const auto sample_on_device = [&] {
          return sample_surface<Tag>(surface, c.options, start.patches->features(), nullptr,
                                     nullptr,
                                     Cuda_engine<float>(surface, c.options).lattice_field_maker());
        };
        const Samples device = sample_on_device();
        CHECK(device.points == sample_on_device().points);
        bool is_found = false;
        for (unsigned number = 0; number < most && !is_found; ++number)
          is_found = are_alike(surface, lattice_but_for_rounding(c, start, number), device);
        CHECK(is_found);
      }
}

TEST_CASE("the device chooses the same points of its lattice as the host does")
{
  const shapes::Soup torus = shapes::torus(96, 48, 1, 0.3);
  Case cases[] = {
      {"torus", torus, options_of(false, Density::uniform, 20000)},
      {"torus, adaptive", torus, options_of(false, Density::curvature, 60000)},
      {"with a border", shapes::plane_patch(40, 40), options_of(false, Density::uniform, 30000)}};
  for (Case& c : cases)
    for (unsigned seed = 0; seed < 3; ++seed) {
      CAPTURE(c.name);
      CAPTURE(seed);
      c.options.random_seed = seed;
      const Start start(c);
      const Surface& surface = start.patches->surface();
      Cuda_engine<float> engine(surface, c.options);
      int choices = 0;
      const auto sample = [&](int* count) {
        const auto make = [&](const Lattice_plan& plan) {
          return std::make_unique<Field_with_choice>(engine.lattice_field_maker()(plan), count);
        };
        return sample_surface<Tag>(surface, c.options, start.patches->features(), nullptr, nullptr,
                                   make);
      };
      const std::vector<Vec3d> device = sample(&choices).points, host = sample(nullptr).points;
      CHECK(choices == 1);
      CHECK(device == sample(&choices).points);
      // Rounding decides between those that are crowded alike.
      CHECK(number_of_others(device, host) < device.size() / 1000);
    }
}

TEST_CASE("points of a lattice that the device places are those that would go up")
{
  for (const Case& c : lattice_cases()) {
    CAPTURE(c.name);
    const Start start(c);
    const auto given = lattice_start<Cuda_engine<float>>(c, start, false),
               placed = lattice_start<Cuda_engine<float>>(c, start, true);
    CHECK(placed.off_lattice == given.off_lattice);
    const double area = start.patches->surface().area;
    const Pairing pairing = paired(given.samples, placed.samples, area);
    const double spacing = std::sqrt(area / double(given.samples.size()));
    std::size_t apart = 0;
    for (std::size_t i = 0; i < given.samples.size(); ++i)
      apart += length(given.samples.points[i] - placed.samples.points[pairing.of_first[i]]) >
               1e-4 * spacing;
    CHECK(apart < given.samples.size() / 1000);
    // Rounding decides which of two facets at a concave edge is nearer: the feet on them are as far
    // apart as the angle between these times the height of the point, some hundredths of both.
    CHECK(pairing.distance < 0.01);
    CHECK(placed.samples.points ==
          lattice_start<Cuda_engine<float>>(c, start, true).samples.points);
  }
}

TEST_CASE("the same input gives the same samples bit for bit")
{
  for (bool paper : {false, true}) {
    const Case c = large_case(paper, Density::curvature);
    const Start start(c);
    Samples first;
    for (int repeat = 0; repeat < 3; ++repeat) {
      Cuda_engine<float> engine(start.patches->surface(), c.options);
      engine.set_samples(start.samples, start.patches->features());
      run(engine, c.options, 20);
      const Samples s = engine.samples();
      if (repeat == 0) first = s;
      CHECK(s.points == first.points);
      CHECK(s.weights == first.weights);
      CHECK(s.normals == first.normals);
      CHECK(s.facets == first.facets);
    }
  }
}

TEST_CASE("more cells than a GPU has threads: Newton's steps equal them, the same bit for bit")
{
  Case c = large_case(false, Density::uniform);
  c.options.number_of_samples = 400000;
  c.options.sampling = Sampling::stratified;
  const Start start(c);
  Samples first;
  for (int repeat = 0; repeat < 2; ++repeat) {
    Cuda_engine<float> engine(start.patches->surface(), c.options);
    engine.set_samples(start.samples, start.patches->features());
    for (int k = 0; k < 5; ++k) {
      engine.build_cells();
      engine.move_samples(Position_method::lloyd);
    }
    engine.build_cells();
    const double before = engine.capacity().rms;
    CHECK(engine.newton_weights());
    for (int k = 0; k < 3; ++k) engine.newton_weights(); // until none makes them more equal
    CHECK(engine.capacity().rms < 0.1 * before);
    const Samples s = engine.samples();
    if (repeat == 0) first = s;
    CHECK(s.weights == first.weights);
    CHECK(s.points == first.points);
  }
}

TEST_CASE("neighbors of more cells than are brought to the host at a time are mutual")
{
  Case c = large_case(false, Density::uniform);
  c.options.number_of_samples = 1100000;
  c.options.sampling = Sampling::stratified;
  const Start start(c);
  Cuda_engine<float> engine(start.patches->surface(), c.options);
  engine.set_samples(start.samples, start.patches->features());
  engine.build_cells();
  const Neighbor_cycles neighbors = engine.neighbors();
  REQUIRE(neighbors.size() == c.options.number_of_samples);
  std::size_t pairs = 0, mutual = 0;
  for (std::size_t i = 0; i < neighbors.size(); ++i)
    for (const int j : neighbors[i]) {
      if (j < 0) continue;
      ++pairs;
      mutual += std::count(neighbors[j].begin(), neighbors[j].end(), int(i));
    }
  CHECK(pairs > 5 * neighbors.size());
  CHECK(mutual > 0.99 * pairs); // tangent planes differ a little
}

TEST_CASE("corners and points on creases alone have no cells")
{
  Case c = cases()[5];
  for (const std::size_t n : {8, 20}) {
    CAPTURE(n);
    c.options.number_of_samples = n;
    const Start start(c);
    Cuda_engine<float> engine(start.patches->surface(), c.options);
    engine.set_samples(start.samples, start.patches->features());
    CHECK(engine.cells().empty());
    CHECK(engine.neighbors().size() == 0);
    CHECK(engine.sites().size() > n);
  }
}

TEST_CASE("distances are those that the CPU finds")
{
  const Case c = cases()[0];
  const Start start(c);
  const Surface& surface = start.patches->surface();
  const shapes::Soup single = {{{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}}, {{0, 1, 2}}};
  const auto check = [&](auto&& engine) {
    engine.set_samples(start.samples, start.patches->features());
    for (const shapes::Soup& s : {c.soup, shapes::torus(200, 100, 0.6, 0.2), single,
                                  shapes::torus(800, 400, 0.6, 0.2)}) { // a thread for each vertex
      CAPTURE(s.triangles.size());
      const auto distance = [&](Resident_mesh* there) {
        return surface_distance(surface.points, surface.triangles, engine.facet_tree(), s.points,
                                s.triangles, CGAL::Parallel_if_available_tag(), false, there);
      };
      struct : unknown::Mesh {
        std::shared_ptr<Resident_mesh> on_device;
        int found = 0;
        bool find_distances(int samples, Two_sided_distances& result) override
        {
          const bool is_found = on_device->find_distances(samples, result);
          found += is_found;
          return is_found;
        }
      } there;
      there.on_device = engine.mesh_bringer()(shapes::arrays(s));
      const Distance_statistics expected = distance(nullptr), d = distance(&there);
      CHECK(there.found == 1);
      constexpr double rounding = 1e-5; // per cent; it may take a sample to the next facet
      CHECK(std::fabs(d.mean - expected.mean) < rounding);
      CHECK(std::fabs(d.rms - expected.rms) < rounding);
      CHECK(std::fabs(d.max - expected.max) < rounding);
    }
  };
  check(Cuda_engine<float>(surface, c.options));
  check(Cuda_engine<double>(surface, c.options));
}

TEST_CASE("facets are as near as those that the CPU finds")
{
  constexpr double cosine = 0.2;
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const Start start(c);
    const Surface& surface = start.patches->surface();
    Cuda_engine<float> engine(surface, c.options);
    const Facet_tree& tree = engine.facet_tree();
    for (const int n : {1, 5000, 300000}) { // by lanes, and a thread for each
      std::mt19937 random(n);
      std::vector<Vec3d> points, normals;
      std::vector<int> hints, places;
      for (int i = 0; i < n; ++i) {
        const int f = int(random() % surface.triangles.size());
        hints.push_back(f);
        places.push_back(tree.place(f));
        points.push_back(surface.points[surface.triangles[f][i % 3]]);
        normals.push_back((i % 2 == 0 ? 1. : -1.) * surface.facet_normals[f]); // of the other side
      }
      REQUIRE(engine.facet_finder()(n, points.data(), normals.data(), cosine, places.data()));
      int differ = 0; // by rounding, whether normals agree
      for (int i = 0; i < n; ++i) {
        const auto nearest = tree.nearest(points[i], normals[i], cosine, hints[i]);
        const auto found = places[i] < 0 ? -1. : [&] {
          const Facet_corners<double>& f = tree.view().facets[places[i]];
          return length(points[i] - nearest_point_on_triangle(points[i], f.a, f.b, f.c));
        }();
        differ += nearest.facet < 0
                      ? found >= 0
                      : !(std::fabs(found - std::sqrt(nearest.squared_distance)) < 1e-5);
      }
      CHECK(differ <= n / 1000);
    }
  }
}

TEST_CASE("faces that may intersect are those that the host's loops find")
{
  const Case c = cases()[0];
  const Start start(c);
  Cuda_engine<float> engine(start.patches->surface(), c.options);
  engine.set_samples(start.samples, start.patches->features());
  for (const shapes::Soup& s : {c.soup, shapes::torus(400, 200, 0.6, 0.2),
                                shapes::two_spheres(2, 1.3), shapes::two_spheres(5, 1.3)}) {
    CAPTURE(s.triangles.size());
    const auto sorted = [](Face_pairs pairs) {
      for (auto& [f, g] : pairs)
        if (f > g) std::swap(f, g);
      std::sort(pairs.begin(), pairs.end());
      return pairs;
    };
    Host_backend<CGAL::Parallel_if_available_tag> host;
    Face_pairs pairs, expected;
    const Mesh_arrays mesh = shapes::arrays(s);
    REQUIRE(engine.mesh_bringer()(mesh)->find_close_faces(pairs));
    REQUIRE(internal::close_faces(host, mesh, expected));
    CHECK(sorted(pairs) == sorted(expected));
  }
}

TEST_CASE("cells at tips do not keep the others from equal capacities")
{
  check_tips<Cuda_engine<float>>();
}

TEST_CASE("the cells are the exact ones of their samples")
{
  std::vector<Case> all = cases();
  all.push_back(large_case(false, Density::uniform));
  all.push_back(large_case(true, Density::curvature));
  for (const Case& c : all) {
    CAPTURE(c.name);
    const Start start(c);
    Cuda_engine<float> engine(start.patches->surface(), c.options);
    for (int iterations : {0, 10, 30}) { // start, middle, end
      engine.set_samples(start.samples, start.patches->features());
      run(engine, c.options, iterations);
      const Cell_comparison r = check_cells<CGAL::Parallel_if_available_tag>(
          engine.sites(), engine.cells(), compatibility_cosine(c.options.normal_angle),
          std::numeric_limits<float>::epsilon(), c.options.guard_factor);
      CHECK(r.certified_wrong == 0);
      CHECK(r.uncertified_right + r.uncertified_wrong <= r.cells / 10000);
      CHECK(r.area.p99 <= 2e-6);
      CHECK(r.centroid.p99 <= 1e-5);
    }
  }
}

TEST_CASE("a GPU that is not there is refused in words")
{
  Case c = cases()[0];
  const Start start(c);
  c.options.device = 1000;
  CHECK_THROWS_WITH_AS(Cuda_engine<float>(start.patches->surface(), c.options),
                       doctest::Contains("no GPU number 1000"), Cuda_error);
}

int main(int argc, char** argv)
{
  try {
    for (const Cuda_device& d : cuda_devices()) std::cout << d.name << '\n';
  } catch (const Cuda_error& e) {
    std::cout << "skipped: " << e.what() << '\n';
    return 77;
  }
  return doctest::Context(argc, argv).run();
}

#else

int main()
{
  std::cout << "skipped: the CUDA engine is not built\n";
  return 77;
}

#endif
