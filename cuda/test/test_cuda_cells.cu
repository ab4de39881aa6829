// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The tuned cells on a GPU against the shared construction in double precision on the host. Without
// a GPU: skipped (return code 77).
#include <doctest/doctest.h>

#include "device_case.h"
#include "plain_weight_passes.h"

#include <CGAL/PowerRTF/internal/label_trees.h>

#include <cstdio>
#include <memory>

using namespace CGAL::PowerRTF;
using namespace CGAL::PowerRTF::device;

namespace {

/// The passes of the paper's rule with densities of 1, in one kernel where that is possible and
/// wanted, else in steps. Returns their number.
int run_weight_passes(Device_case<float>& d, bool in_one_kernel,
                      const Multiplicative_weight_rule& rule, int passes)
{
  const int n = d.sites.size();
  Cuda_backend::Buffer<float> first, sixth, density;
  for (auto* b : {&first, &sixth, &density}) b->allocate(*backend, n);
  backend->fill(density.data(), 1.0f, n);
  d.cells.neighbor_distances(true, first.data(), sixth.data());
  const auto arrays = d.arrays();
  Site<float>* const sites = d.sites.sites.data();
  if (in_one_kernel && d.cells.start_weight_passes(
                           {arrays, sites, density.data(), rule, passes, d.sites.outputs()})) {
    Weight_pass_state state;
    backend->download(&state, d.cells.weight_pass_state(), 1);
    return state.done;
  }
  return plain_weight_passes(*backend, d.cells, d.sites, density.data(), first.data(), sixth.data(),
                             rule, passes);
}

template <class Real>
void check_errors(const Cell_comparison& c)
{
  CHECK(c.area_p99 <= (sizeof(Real) == 4 ? 2e-6 : 1e-13));
  CHECK(c.centroid_p99 <= (sizeof(Real) == 4 ? 1e-5 : 1e-13));
}

} // namespace

TEST_CASE_TEMPLATE("random, relaxed and moving sites", Real, float, double)
{
  for (const double contrast : {1.0, 30.0}) {
    Torus<Real> torus;
    torus.contrast = contrast;
    Device_case<Real> d(torus_case<Real>(5000, contrast));
    d.cells.set_sites(d.arrays());
    check_errors<Real>(d.compare("random"));
    for (int k = 0; k < 3; ++k) {
      d.sites.relax(d.cells, torus, 12);
      d.cells.set_sites(d.arrays());
      check_errors<Real>(d.compare("relaxed"));
    }
  }
}

TEST_CASE("weights that change from construction to construction")
{
  const int n = 5000;
  Torus<float> torus;
  Device_case<float> d(torus_case<float>(n));
  d.sites.relax(d.cells, torus, 30);
  d.cells.set_sites(d.arrays());
  Host_sites<float> s = d.sites.download();
  std::mt19937 random(3);
  const float h2 = float(spacing(n) * spacing(n));
  for (int k = 0; k < 14; ++k) {
    for (auto& q : s.sites) q.weight += h2 * 0.06f * (float(random() % 1000) / 1000 - 0.5f);
    if (k == 5) s.sites[77].weight += 2 * h2;     // a cell that swallows its neighbors
    if (k == 8) s.sites[99].weight -= 2 * h2;     // one that vanishes
    if (k == 9) s.sites[1999].weight += 400 * h2; // one that covers the whole surface
    if (k == 11) s.sites[1999].weight -= 400 * h2;
    backend->upload(d.sites.sites.data(), s.sites.data(), n);
    d.cells.set_weights(d.arrays());
    const Cell_comparison c = d.compare("weights");
    if (k < 9) check_errors<float>(c);
  }
}

TEST_CASE("many sites: from lists")
{
  const int n = 70000;
  Torus<float> torus;
  Device_case<float> d(torus_case<float>(n));
  d.sites.sort(); // for the host
  d.cells.set_sites(d.arrays());
  check_errors<float>(d.compare("many, random"));
  d.sites.relax(d.cells, torus, 3);
  d.cells.set_sites(d.arrays());
  check_errors<float>(d.compare("many, moving"));
  d.sites.relax(d.cells, torus, 22);
  d.cells.set_sites(d.arrays());
  check_errors<float>(d.compare("many, relaxed"));
  Host_sites<float> s = d.sites.download();
  std::mt19937 random(3);
  const float h2 = float(spacing(n) * spacing(n));
  for (int k = 0; k < 3; ++k) {
    for (auto& q : s.sites) q.weight += h2 * 0.06f * (float(random() % 1000) / 1000 - 0.5f);
    if (k == 1) s.sites[77].weight += 2 * h2; // a cell that swallows its neighbors
    backend->upload(d.sites.sites.data(), s.sites.data(), n);
    d.cells.set_weights(d.arrays());
    check_errors<float>(d.compare("many, weights"));
  }
}

TEST_CASE("few sites")
{
  for (const int n : {1, 2, 3, 31, 32, 33, 65}) {
    Device_case<float> d(torus_case<float>(n));
    d.cells.set_sites(d.arrays());
    d.compare("few");
  }
}

void compare_adversarial_sites(int n)
{
  Case<float> c = torus_case<float>(n);
  auto& sites = c.host.sites;
  const float h = float(spacing(n));
  std::mt19937 random(3);
  SUBCASE("large random weights, a small guard")
  {
    c.guard_factor = 1.5;
    c.cos_angle = 0.5;
    for (auto& q : sites) q.weight = h * h * 6 * (float(random() % 1000) / 1000 - 0.5f);
  }
  SUBCASE("huge smooth weights")
  {
    for (auto& q : sites) q.weight = h * h * 100 * (std::sin(7 * q.point.x) + q.point.y);
  }
  SUBCASE("two sheets, duplicates")
  {
    for (int i = 0; i < n; ++i) {
      if (i % 2) {
        sites[i].point = sites[i].point * 0.99f;
        c.host.normals[i] = -c.host.normals[i];
      }
      if (i % 50 == 0) sites[i] = sites[(i + 20) % n];
    }
  }
  SUBCASE("patches")
  {
    for (int i = 0; i < n; ++i) c.patches.push_back(sites[i].point.x > 0);
  }
  SUBCASE("cocircular")
  {
    const int side = int(std::ceil(std::sqrt(n)));
    for (int i = 0; i < n; ++i) {
      sites[i].point = {(i % side) / (2.0f * side), (i / side) / (2.0f * side), 0};
      c.host.normals[i] = {0, 0, 1};
    }
  }
  if (n < 5000) { // each site sees all others
    SUBCASE("all at one point")
    {
      for (auto& q : sites) q.point = sites[0].point;
    }
  }
  Device_case<float> d(c);
  for (int k = 0; k < 2; ++k) { // the second time from the first one's radii
    d.cells.set_sites(d.arrays());
    d.compare("adversarial");
  }
}

TEST_CASE("adversarial sites: by warps") { compare_adversarial_sites(4000); }
TEST_CASE("adversarial sites: from lists") { compare_adversarial_sites(20000); }

TEST_CASE("the same input gives the same output bit for bit")
{
  const Case<float> c = torus_case<float>(20000);
  Torus<float> torus;
  std::vector<float> areas[2];
  std::vector<Vec3<float>> offsets[2];
  for (int k = 0; k < 2; ++k) {
    Device_case<float> d(c);
    d.sites.relax(d.cells, torus, 20);
    areas[k].resize(d.sites.size());
    offsets[k].resize(d.sites.size());
    backend->download(areas[k].data(), d.sites.area.data(), d.sites.size());
    backend->download(offsets[k].data(), d.sites.offset.data(), d.sites.size());
  }
  CHECK(areas[0] == areas[1]);
  CHECK(offsets[0] == offsets[1]);
}

TEST_CASE("the paper's passes with guarded and empty cells")
{
  const int n = 3000, passes = 12;
  bool in_one_kernel = true;
  SUBCASE("in one kernel") {}
  SUBCASE("in steps") { in_one_kernel = false; }
  Case<float> c = torus_case<float>(n);
  c.guard_factor = 1.2;
  c.cos_angle = 0.5;
  Device_case<float> d(c);
  const auto arrays = d.arrays();
  d.cells.set_sites(arrays);
  d.compare("before the passes");
  CHECK(run_weight_passes(d, in_one_kernel, {0.04, 1, false, 0}, passes) == passes);
  // All areas of the last pass are those of the cells.
  std::vector<float> areas(n);
  backend->download(areas.data(), d.sites.area.data(), n);
  const std::vector<Plain_cell> cells = d.download();
  double error = 0;
  for (int i = 0; i < n; ++i)
    error = std::max(error, std::fabs(areas[i] - cells[i].area) / (spacing(n) * spacing(n)));
  CHECK(error < 1e-5);
  d.compare("after the passes");
  d.cells.set_sites(arrays); // without what is known of the last construction
  d.compare("again");
}

/// The paper's passes, plainly. Returns their number.
int run_on_host(Host_cells& host, const Multiplicative_weight_rule& rule, int passes)
{
  const int n = int(host.sites.size());
  const Sites_view<double> v = host.view();
  for (int done = 0;; ++done) {
    const std::vector<Plain_cell> cells = host.construct();
    Multiplicative_weight_rule r = rule;
    for (const Plain_cell& c : cells) r.mean_mass += c.area / n;
    int outside = 0;
    for (const Plain_cell& c : cells) outside += std::fabs(c.area / r.mean_mass - 1) > 0.04;
    if (outside == 0 || done == passes) return done;
    double mean = 0;
    for (int i = 0; i < n; ++i) {
      const int k = cells[i].area > 0 ? 1 : 6;
      host.sites[i].weight += r(cells[i].area, distance_to_neighbor(v, i, k, -0.766));
      mean += host.sites[i].weight / n;
    }
    for (Site<double>& s : host.sites) s.weight -= mean;
  }
}

TEST_CASE("the paper's passes are those of the host")
{
  int n = 3000, passes = 40;
  bool in_one_kernel = true;
  SUBCASE("few sites: in one kernel") {}
  SUBCASE("few sites: in steps") { in_one_kernel = false; }
  SUBCASE("many sites")
  {
    n = 70000;
    passes = 12;
  }
  Torus<float> torus;
  Device_case<float> d(torus_case<float>(n));
  d.sites.sort(); // for the host
  d.sites.relax(d.cells, torus, 20);
  const auto arrays = d.arrays();
  d.cells.set_sites(arrays);
  d.cells.build(d.sites.outputs());
  Cuda_backend::Buffer<float> first;
  first.allocate(*backend, n);
  d.cells.neighbor_distances(true, first.data(), nullptr);
  Host_cells host(d.sites.download(), {}, -0.766, 3);
  const Sites_view<double> v = host.view();
  std::vector<float> nearest(n);
  backend->download(nearest.data(), first.data(), n);
  double distance_error = 0;
  for (int i = 0; i < n; ++i) {
    const double exact = distance_to_neighbor(v, i, 1, -0.766);
    distance_error = std::max(distance_error, std::fabs(nearest[i] - exact) / spacing(n));
  }
  CHECK(distance_error < 1e-5);

  const Multiplicative_weight_rule rule{0.04, 1, false, 0};
  const int done = run_weight_passes(d, in_one_kernel, rule, passes);
  const int host_done = run_on_host(host, rule, passes);
  const Host_sites<float> after = d.sites.download();
  double squares = 0, mean = 0;
  for (int i = 0; i < n; ++i) {
    const double difference = after.sites[i].weight - host.sites[i].weight;
    squares += difference * difference / n;
    mean += after.sites[i].weight / n;
  }
  const double h2 = spacing(n) * spacing(n);
  std::printf("paper's passes: %d (host %d), weights differ by %.1e h^2 (rms)\n", done, host_done,
              std::sqrt(squares) / h2);
  CHECK(std::sqrt(squares) < 1e-3 * h2); // alpha is rounded: some changes differ by a step
  CHECK(std::abs(done - host_done) <= 2);
  CHECK(std::fabs(mean) < 1e-6 * h2);
  d.compare("after the paper's passes");
}

TEST_CASE("items are hung under their root while others halve the way there")
{
  constexpr int size = 1 << 18;
  Cuda_backend::Buffer<int> labels;
  labels.allocate(*backend, size);
  int* const label = labels.data();
  std::vector<int> found(size);
  for (int run = 0; run < 20; ++run) {
    backend->for_each(size, [=] __device__(int i) { // trees of long ways
      label[i] = i % 4096 < 4 ? i - i % 4096 : i - 1 - i * 7919 % 3;
    });
    backend->for_each(size, [=] __device__(int i) { atomic_store(label + i, root_of(label, i)); });
    backend->download(found.data(), label, size);
    int wrong = 0;
    for (int i = 0; i < size; ++i) wrong += found[i] != i - i % 4096;
    REQUIRE(wrong == 0);
  }
}

int main(int argc, char** argv)
{
  try {
    backend = std::make_unique<Cuda_backend>(0);
  } catch (const Cuda_error& error) {
    std::printf("skipped: %s\n", error.what());
    return 77;
  }
  const int result = doctest::Context(argc, argv).run();
  backend.reset();
  return result;
}
