// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells of the CPU against closed forms and brute force.
#include "random_input.h"
#include "shapes.h"

#include <CGAL/PowerRTF/cells/Tree_cells.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <set>

using namespace CGAL::PowerRTF;
using doctest::Approx;

namespace {

constexpr double every_angle = -2; // cosine of Theta: all pairs are compatible

struct Sites {
  std::vector<Vec3d> points, normals;
  std::vector<double> weights;

  void add(const Vec3d& p, const Vec3d& n, double w = 0)
  {
    points.push_back(p);
    normals.push_back(normalized(n));
    weights.push_back(w);
  }
  int size() const { return int(points.size()); }
};

/// A cell in coordinates that do not depend on its frame.
struct Cell {
  Cell_status status = Cell_status::incomplete;
  double area = 0;
  Vec3d center{0, 0, 0}; ///< center of mass, relative to the site
  std::vector<Vec3d> vertices;
  std::vector<int> neighbors;

  std::set<int> neighbor_set() const { return {neighbors.begin(), neighbors.end()}; }
};

/// The cells of the sites, taken by the tree in the given order.
std::vector<Cell> cells_of(const Sites& sites, double cos_angle, double first_radius,
                           const std::vector<int>& order)
{
  Owned_sites in_order;
  for (int k = 0; k < sites.size(); ++k)
    in_order.add(sites.points[order[k]], sites.normals[order[k]], sites.weights[order[k]]);
  using Backend = Host_backend<CGAL::Sequential_tag>;
  Backend backend;
  Tree_cells<double, Backend> tree(backend, sites.size(), cos_angle, first_radius, {});
  tree.set_sites(in_order.arrays());
  std::vector<Cell> cells(sites.size());
  tree.for_each_cell([&](int i, Cell_status status, const Tangent_polygon<double>& polygon,
                         const Tangent_frame<double>& frame) {
    Cell& cell = cells[order[i]];
    const Cell_moments<double> moments = cell_moments(polygon);
    cell.status = status;
    cell.area = moments.area;
    cell.center = frame.u * moments.x + frame.v * moments.y;
    for (int k = 0; k < polygon.size; ++k) {
      cell.vertices.push_back(in_order.sites[i].point + frame.u * polygon.x[k] +
                              frame.v * polygon.y[k]);
      const int j = polygon.neighbor[k];
      cell.neighbors.push_back(j < 0 ? j : order[j]);
    }
  });
  return cells;
}

std::vector<Cell> cells_of(const Sites& sites, double cos_angle = every_angle,
                           double first_radius = 0.2)
{
  return cells_of(sites, cos_angle, first_radius,
                  CGAL::PowerRTF::internal::spatial_order(sites.points));
}

/// Rotates the plane z = 0 to somewhere that is special to no axis.
Vec3d tilted(const Vec3d& p)
{
  shapes::Soup soup;
  soup.points = {p};
  return shapes::rotated(soup, 0.7, {1, 2, -1}).points[0];
}

/// (2 k + 1)^2 sites around the origin, which is site 0; `shear` = 0: squares, 0.5: hexagons.
Sites lattice(double h, int k, double shear, double row_height)
{
  Sites sites;
  const auto add = [&](int i, int j) {
    sites.add(tilted({h * (i + shear * j), h * row_height * j, 0}), tilted({0, 0, 1}));
  };
  add(0, 0);
  for (int j = -k; j <= k; ++j)
    for (int i = -k; i <= k; ++i)
      if (i != 0 || j != 0) add(i, j);
  return sites;
}

double unit(std::mt19937& random) { return random() / 4294967296.; }

Vec3d random_direction(std::mt19937& random)
{
  for (;;) {
    const Vec3d v{2 * unit(random) - 1, 2 * unit(random) - 1, 2 * unit(random) - 1};
    if (squared_length(v) < 1 && squared_length(v) > 0.01) return normalized(v);
  }
}

/// Sites near the unit sphere with noisy normals and weights of the order of h^2.
Sites random_sites(int n, unsigned seed, double weight)
{
  std::mt19937 random(seed);
  Sites sites;
  const double h2 = 4 * shapes::pi / n;
  for (int k = 0; k < n; ++k) {
    const Vec3d d = random_direction(random);
    sites.add(d * (1 + 0.02 * unit(random)), d + 0.2 * random_direction(random),
              weight * h2 * (2 * unit(random) - 1));
  }
  return sites;
}

/// The cell of site `i`: a large square cut by all compatible sites, whatever their distance.
Cell brute_force_cell(const Sites& sites, int i, double cos_angle)
{
  struct Vertex {
    Vec3d p;      // relative to the site
    int neighbor; // of the edge that begins here
  };
  const Vec3d n = sites.normals[i],
              u = normalized(cross(n, std::abs(n.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0})),
              v = cross(n, u);
  std::vector<Vertex> polygon = {
      {u * 10 - v * 10, -1}, {u * 10 + v * 10, -1}, {v * 10 - u * 10, -1}, {-u * 10 - v * 10, -1}};
  for (int j = 0; j < sites.size(); ++j) {
    if (j == i || !(dot(n, sites.normals[j]) > cos_angle)) continue;
    const Vec3d offset = sites.points[j] - sites.points[i];
    const double c = (squared_length(offset) + sites.weights[i] - sites.weights[j]) / 2;
    std::vector<Vertex> cut;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vertex &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      const double sa = dot(offset, a.p) - c, sb = dot(offset, b.p) - c;
      if (sa <= 0) cut.push_back(a);
      if ((sa <= 0) != (sb <= 0))
        cut.push_back({a.p + (b.p - a.p) * (sa / (sa - sb)), sa <= 0 ? j : a.neighbor});
    }
    polygon = cut;
  }
  Cell cell;
  Vec3d moment{0, 0, 0};
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3d a = polygon[k].p, b = polygon[(k + 1) % polygon.size()].p;
    const double area = dot(cross(a, b), n) / 2;
    cell.area += area;
    moment += (a + b) * (area / 3);
    cell.neighbors.push_back(polygon[k].neighbor);
    cell.vertices.push_back(a);
  }
  if (cell.area > 0) cell.center = moment * (1 / cell.area);
  return cell;
}

double distance_to_6th(const Sites& sites, int i)
{
  std::vector<double> distances;
  for (const Vec3d& p : sites.points) distances.push_back(length(p - sites.points[i]));
  std::nth_element(distances.begin(), distances.begin() + 6, distances.end());
  return distances[6]; // the nearest one is the site itself
}

} // namespace

TEST_CASE("lattices in a plane")
{
  for (double h : {1., 0.01, 300.}) {
    CAPTURE(h);
    const Cell square = cells_of(lattice(h, 5, 0, 1), every_angle, h)[0];
    CHECK(square.status == Cell_status::ok);
    CHECK(square.area == Approx(h * h).epsilon(1e-12));
    CHECK(length(square.center) < 1e-12 * h);

    const Cell hexagon = cells_of(lattice(h, 5, 0.5, std::sqrt(0.75)), every_angle, h)[0];
    CHECK(hexagon.status == Cell_status::ok);
    CHECK(hexagon.area == Approx(std::sqrt(0.75) * h * h).epsilon(1e-12));
    CHECK(hexagon.vertices.size() == 6);
    for (std::size_t k = 0; k < 6; ++k) {
      CHECK(length(hexagon.vertices[k]) == Approx(h / std::sqrt(3.)).epsilon(1e-12));
      CHECK(length(hexagon.vertices[(k + 1) % 6] - hexagon.vertices[k]) ==
            Approx(h / std::sqrt(3.)).epsilon(1e-12));
    }
  }
}

TEST_CASE("a weight moves the bisectors by w / 2d (equation 5)")
{
  const double h = 0.1;
  for (double w : {0., 0.3 * h * h, -0.3 * h * h, 0.9 * h * h}) {
    CAPTURE(w);
    Sites sites = lattice(h, 5, 0, 1);
    sites.weights[0] = w;
    const std::vector<Cell> cells = cells_of(sites, every_angle, h);
    const double half = (h * h + w) / (2 * h);
    const double cut = w > 0 ? w / (2 * h) : 0; // a heavy cell's corners, by the diagonal neighbors
    CHECK(cells[0].area == Approx(4 * half * half - 2 * cut * cut).epsilon(1e-12));
    // Whatever one cell wins, its neighbors lose.
    double sum = 0;
    for (int i = 0; i < sites.size(); ++i)
      if (length(sites.points[i]) < 2.5 * h) sum += cells[i].area;
    CHECK(sum == Approx(21 * h * h).epsilon(1e-12));
  }
}

TEST_CASE("every edge lies in the plane of equal power of its two sites")
{
  for (unsigned seed : {1u, 2u, 3u}) {
    const Sites sites = random_sites(300, seed, 0.3);
    const std::vector<Cell> cells = cells_of(sites);
    for (int i = 0; i < sites.size(); ++i)
      for (std::size_t k = 0; k < cells[i].vertices.size(); ++k)
        for (std::size_t end : {k, (k + 1) % cells[i].vertices.size()}) {
          const Vec3d p = cells[i].vertices[end];
          CHECK(std::abs(dot(p - sites.points[i], sites.normals[i])) < 1e-12);
          const int j = cells[i].neighbors[k];
          if (j < 0) continue;
          const auto power = [&](int s) {
            return squared_length(p - sites.points[s]) - sites.weights[s];
          };
          CHECK(std::abs(power(i) - power(j)) < 1e-12);
        }
  }
}

TEST_CASE("cells against brute force over all sites")
{
  for (double cos_angle : {every_angle, std::cos(shapes::pi / 3)})
    for (double weight : {0., 0.1, 0.5, 2.})
      for (int n : {20, 100, 400})
        for (unsigned seed : {1u, 2u}) {
          CAPTURE(cos_angle);
          CAPTURE(weight);
          CAPTURE(n);
          CAPTURE(seed);
          const Sites sites = random_sites(n, seed, weight);
          const std::vector<Cell> cells = cells_of(sites, cos_angle);
          int compared = 0;
          for (int i = 0; i < n; ++i) {
            CHECK(cells[i].status != Cell_status::incomplete);
            const Cell expected = brute_force_cell(sites, i, cos_angle);
            double radius = 0;
            for (const Vec3d& p : expected.vertices) radius = std::max(radius, length(p));
            if (radius > 3 * distance_to_6th(sites, i)) {
              CHECK((cells[i].status == Cell_status::guarded ||
                     cells[i].status == Cell_status::empty));
              continue;
            }
            ++compared;
            CHECK(cells[i].area == Approx(expected.area).epsilon(1e-9));
            CHECK(cells[i].neighbor_set() == expected.neighbor_set());
            CHECK(length(cells[i].center - expected.center) < 1e-9);
            CHECK(cells[i].status ==
                  (expected.neighbors.empty() ? Cell_status::empty : Cell_status::ok));
          }
          if (n > 20) CHECK(compared > 0.9 * n);
        }
}

TEST_CASE("NVISPC: a close sheet does not cut")
{
  const double h = 0.1, gap = 0.02;
  Sites sites;
  for (int side = 0; side < 2; ++side) // the lattice of the other sheet lies between this one's
    for (int j = -6; j <= 6; ++j)
      for (int i = -6; i <= 6; ++i)
        sites.add({h * (i + 0.5 * side), h * (j + 0.5 * side), gap * side},
                  {0, 0, side == 0 ? 1. : -1.});
  const int middle = 13 * 6 + 6;
  const Cell alone = cells_of(sites, std::cos(shapes::pi / 2), h)[middle];
  CHECK(alone.status == Cell_status::ok);
  CHECK(alone.area == Approx(h * h).epsilon(1e-12));
  for (int j : alone.neighbors) CHECK(j < 169);

  const Cell cut = cells_of(sites, every_angle, h)[middle]; // the other sheet cuts the corners
  const double corner = h / 2 - gap * gap / h;
  CHECK(cut.area == Approx(h * h - 2 * corner * corner).epsilon(1e-12));
}

TEST_CASE("NVISPC: a sample without compatible neighbors is guarded")
{
  const double h = 0.1;
  Sites sites = lattice(h, 5, 0, 1);
  sites.normals[0] = tilted(normalized(Vec3d{1, 0, 0.2})); // far from the others' normals
  const std::vector<Cell> cells = cells_of(sites, std::cos(shapes::pi / 3), h);
  CHECK(cells[0].status == Cell_status::guarded);
  CHECK(cells[0].area > 0);
  const double guard = 3 * std::sqrt(2.) * h; // the 6th neighbor is a diagonal one
  for (const Vec3d& p : cells[0].vertices) CHECK(length(p) <= 1.0001 * std::sqrt(2.) * guard);
  // It takes its neighbors' place nevertheless where they do not see it.
  int ok = 0, guarded = 0;
  for (int i = 1; i < sites.size(); ++i) {
    ok += cells[i].status == Cell_status::ok;
    guarded += cells[i].status == Cell_status::guarded; // at the rim of the patch
  }
  CHECK(ok + guarded == sites.size() - 1);
  CHECK(guarded >= 36);
  CHECK(ok >= 8);
}

TEST_CASE("NVISPC: single precision finds the same normals compatible as double precision")
{
  const float cosine = 0.5f; // mechanical parts have many pairs of facets at just 60 degrees
  random_input::Random random(1);
  int by_rounding = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3d n = random.direction(), across = normalized(cross(n, random.direction()));
    const Vec3<float> a = to_real<float>(n);
    const Vec3<float> b = to_real<float>(n * 0.5 + across * std::sqrt(0.75));
    const bool exact = dot(to_double(a), to_double(b)) > cosine;
    CHECK(are_compatible(a, b, cosine) == exact);
    by_rounding += (dot(a, b) > cosine) != exact;
  }
  CHECK(by_rounding > 100);
  CHECK(are_compatible(Vec3<float>{0, 0, 1}, Vec3<float>{0, 0, -1}, -2.f));
}

TEST_CASE("NVISPC: below 180 degrees opposite normals are not compatible")
{
  const Vec3d up{0, 0, 1}, down{0, 0, -1};
  CHECK_FALSE(are_compatible(up, down, compatibility_cosine(179.999))); // its cosine rounds to -1
  CHECK(are_compatible(up, down, compatibility_cosine(180)));
}

TEST_CASE("a power cell that does not meet its tangent plane is empty")
{
  const double h = 0.1;
  Sites sites = lattice(h, 5, 0, 1);
  sites.weights[0] = -1.5 * h * h;
  const std::vector<Cell> cells = cells_of(sites, every_angle, h);
  CHECK(cells[0].status == Cell_status::empty);
  CHECK(cells[0].area == 0);
  for (int i = 1; i < sites.size(); ++i) CHECK(cells[i].neighbor_set().count(0) == 0);
}

TEST_CASE("duplicate sites: the first one keeps the cell")
{
  Sites sites = lattice(0.1, 5, 0, 1);
  sites.add(sites.points[0], sites.normals[0]);
  std::vector<int> order(sites.size());
  std::iota(order.begin(), order.end(), 0);
  const std::vector<Cell> cells = cells_of(sites, every_angle, 0.1, order);
  CHECK(cells.front().area == Approx(0.01).epsilon(1e-12));
  CHECK(cells.back().status == Cell_status::empty);
}

TEST_CASE("neither the first radius nor the order of the sites changes a cell")
{
  for (unsigned seed : {1u, 2u}) {
    const Sites sites = random_sites(500, seed, 0.3);
    const double cos_angle = std::cos(shapes::pi / 3);
    const std::vector<Cell> expected = cells_of(sites, cos_angle);
    std::vector<int> order(sites.size());
    std::iota(order.begin(), order.end(), 0);
    for (double radius : {0., 1e-4, 0.01, 0.1, 1., 5.}) {
      CAPTURE(radius);
      const std::vector<Cell> cells = cells_of(sites, cos_angle, radius, order);
      for (int i = 0; i < sites.size(); ++i) {
        CHECK(cells[i].status == expected[i].status);
        CHECK(cells[i].neighbor_set() == expected[i].neighbor_set());
        CHECK(cells[i].area == Approx(expected[i].area).epsilon(1e-9));
      }
      std::mt19937 random(seed);
      for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random() % k]);
    }
  }
}

TEST_CASE("few sites")
{
  for (int n : {0, 1, 2, 3, 7, 8, 9}) {
    CAPTURE(n);
    const Sites sites = random_sites(n, 4, 0);
    for (const Cell& cell : cells_of(sites)) CHECK(cell.status != Cell_status::incomplete);
  }
}

TEST_CASE("moments of a polygon")
{
  Tangent_polygon<double> square;
  square.set_square(2);
  CHECK(cell_moments(square).area == Approx(16));
  CHECK(cell_moments(square).mass == Approx(16));
  CHECK(cell_moments(square).x == Approx(0));
  CHECK(square.clip(1, 0, 1, 0)); // x <= 1
  CHECK_FALSE(square.clip(1, 0, 1.5, 1));
  const auto moments = cell_moments(square, 0, [](int) { return std::cbrt(3.); });
  CHECK(moments.area == Approx(12));
  CHECK(moments.mass == Approx(36));
  CHECK(moments.x == Approx(-0.5));
  CHECK(moments.y == Approx(0));
  // A denser neighbor pulls the center toward itself.
  const auto pulled = cell_moments(square, 1, [](int j) { return j == 0 ? 2. : 1.; });
  CHECK(pulled.x > -0.4);
  CHECK(square.clip(1, 0, -3, 2)); // nothing is left
  CHECK(square.size == 0);
  CHECK(cell_moments(square).area == 0);
}
