// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cells, searches, weights and positions of the CPU engine against closed forms and brute force.
#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include "engine_comparison.h"

#include <CGAL/PowerRTF/engines/Cpu_engine.h>
#include <CGAL/PowerRTF/engines/Site_tree.h>
#include <CGAL/PowerRTF/surface/initial_sampling.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/squared_distance_3.h>

#include <doctest/doctest.h>

#include <limits>
#include <set>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using CGAL::Sequential_tag;

namespace
{

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
  Vec3d center{0, 0, 0}; ///< centre of mass, relative to the site
  std::vector<Vec3d> vertices;
  std::vector<int> neighbors;

  std::set<int> neighbor_set() const { return {neighbors.begin(), neighbors.end()}; }
};

/// The cells of the sites, taken by the tree in the given order.
std::vector<Cell> cells_of(const Sites& sites, double cos_angle, double first_radius,
                           const std::vector<int>& order)
{
  Site_tree<Sequential_tag> tree;
  tree.resize(sites.size(), first_radius);
  for (int k = 0; k < sites.size(); ++k) {
    tree.sites[k] = {sites.points[order[k]], sites.weights[order[k]]};
    tree.normals[k] = sites.normals[order[k]];
  }
  tree.refit();
  std::vector<Cell> cells(sites.size());
  tree.construct_cells(cos_angle,
                       [&](int i, Cell_status status, const Tangent_polygon<double>& polygon,
                           const Tangent_frame<double>& frame) {
                         Cell& cell = cells[order[i]];
                         const Cell_moments<double> moments = cell_moments(polygon);
                         cell.status = status;
                         cell.area = moments.area;
                         cell.center = frame.u * moments.x + frame.v * moments.y;
                         for (int k = 0; k < polygon.size; ++k) {
                           cell.vertices.push_back(tree.sites[i].point + frame.u * polygon.x[k] +
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
    Vec3d p; // relative to the site
    int neighbor; // of the edge that begins here
  };
  const Vec3d n = sites.normals[i], u = normalized(cross(n, std::abs(n.x) < 0.5 ? Vec3d{1, 0, 0}
                                                                              : Vec3d{0, 1, 0})),
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

Remeshing_options options_for(std::size_t n)
{
  Remeshing_options options;
  options.number_of_samples = n;
  return options;
}

} // namespace

// --- cells ---------------------------------------------------------------------------------------

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
    const double cut = w > 0 ? w / (2 * h) : 0; // a heavy cell's corners, by the diagonal neighbours
    CHECK(cells[0].area == Approx(4 * half * half - 2 * cut * cut).epsilon(1e-12));
    // Whatever one cell wins, its neighbours lose.
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
          const auto power = [&](int s)
          { return squared_length(p - sites.points[s]) - sites.weights[s]; };
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

TEST_CASE("NVISPC: a sample without compatible neighbours is guarded")
{
  const double h = 0.1;
  Sites sites = lattice(h, 5, 0, 1);
  sites.normals[0] = tilted(normalized(Vec3d{1, 0, 0.2})); // far from the others' normals
  const std::vector<Cell> cells = cells_of(sites, std::cos(shapes::pi / 3), h);
  CHECK(cells[0].status == Cell_status::guarded);
  CHECK(cells[0].area > 0);
  const double guard = 3 * std::sqrt(2.) * h; // the 6th neighbour is a diagonal one
  for (const Vec3d& p : cells[0].vertices) CHECK(length(p) <= 1.0001 * std::sqrt(2.) * guard);
  // It takes its neighbours' place nevertheless where they do not see it.
  int ok = 0, guarded = 0;
  for (int i = 1; i < sites.size(); ++i) {
    ok += cells[i].status == Cell_status::ok;
    guarded += cells[i].status == Cell_status::guarded; // at the rim of the patch
  }
  CHECK(ok + guarded == sites.size() - 1);
  CHECK(guarded >= 36);
  CHECK(ok >= 8);
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
    for (double radius : {1e-4, 0.01, 0.1, 1., 5.}) {
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
  // A denser neighbour pulls the centre towards itself.
  const auto pulled = cell_moments(square, 1, [](int j) { return j == 0 ? 2. : 1.; });
  CHECK(pulled.x > -0.4);
  CHECK(square.clip(1, 0, -3, 2)); // nothing is left
  CHECK(square.size == 0);
  CHECK(cell_moments(square).area == 0);
}

// --- searches ------------------------------------------------------------------------------------

TEST_CASE("layout of packed trees: every item in one leaf, every node below the root")
{
  for (int n : {0, 1, 2, 7, 8, 9, 63, 64, 65, 511, 512, 513, 4095, 4096, 4097, 100000}) {
    CAPTURE(n);
    const Packed_tree_layout tree(n);
    int levels = n > 0 ? 1 : 0, below = (n + 7) / 8, nodes = below;
    for (; below > 1; ++levels) nodes += below = (below + 7) / 8;
    CHECK(tree.levels == levels);
    CHECK(tree.nodes() == nodes);
    if (n > 0) CHECK(tree.nodes(tree.levels - 1) == 1);

    std::vector<int> visits(n, 0), entered(nodes, 0);
    traverse(
        tree,
        [&](int node)
        {
          ++entered[node];
          return true;
        },
        [&](int begin, int end)
        {
          CHECK(end - begin <= 8);
          for (int k = begin; k < end; ++k) ++visits[k];
        });
    CHECK(std::count(visits.begin(), visits.end(), 1) == n);
    CHECK(std::count(entered.begin(), entered.end(), 1) == std::max(0, nodes - 1)); // not the root
  }
}

TEST_CASE("nearest point of a triangle against exact arithmetic")
{
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  std::mt19937 random(1);
  const auto point = [&]() { return Vec3d{unit(random), unit(random), unit(random)}; };
  const auto exact = [](const Vec3d& p) { return Kernel::Point_3(p.x, p.y, p.z); };
  for (int k = 0; k < 300; ++k) {
    const Vec3d a = point(), b = point(), c = point(), p = 2 * point() - Vec3d{0.5, 0.5, 0.5};
    const Vec3d q = nearest_point_on_triangle(p, a, b, c);
    const double expected = CGAL::to_double(
        CGAL::squared_distance(exact(p), Kernel::Triangle_3(exact(a), exact(b), exact(c))));
    CHECK(squared_length(q - p) == Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("nearest facet against brute force")
{
  for (const shapes::Soup& soup : {shapes::torus(30, 15, 1, 0.4), shapes::box(1),
                                   shapes::thin_disc(0.05, 8), shapes::tetrahedron()}) {
    const Surface surface = shapes::make_surface(soup);
    const Facet_tree tree(surface.points, surface.triangles);
    const int facets = int(surface.triangles.size());
    std::mt19937 random(7);
    for (int k = 0; k < 200; ++k) {
      const Vec3d p{1.4 * unit(random) - 0.7, 1.4 * unit(random) - 0.7, 1.4 * unit(random) - 0.7};
      const Vec3d normal = random_direction(random);
      for (double cos_angle : {every_angle, 0.5}) {
        double least = std::numeric_limits<double>::infinity();
        for (int f = 0; f < facets; ++f) {
          if (!(dot(surface.facet_normals[f], normal) > cos_angle)) continue;
          const Triangle& t = surface.triangles[f];
          const Vec3d q = nearest_point_on_triangle(p, surface.points[t[0]], surface.points[t[1]],
                                                    surface.points[t[2]]);
          least = std::min(least, squared_length(q - p));
        }
        for (int hint : {-1, int(random() % facets)}) {
          const Surface_point<double> q = nearest_facet(tree.view(), p, normal, cos_angle, hint);
          if (std::isinf(least)) {
            CHECK(q.facet == -1);
            continue;
          }
          REQUIRE(q.facet >= 0);
          CHECK(q.squared_distance == least);
          CHECK(squared_length(q.point - p) == least);
          CHECK(dot(surface.facet_normals[q.facet], normal) > cos_angle);
        }
      }
    }
  }
}

// --- weights -------------------------------------------------------------------------------------

TEST_CASE("the paper's rule for one weight")
{
  const double d = 0.5, d2 = d * d;
  const Multiplicative_weight_rule up{0.04, 1, false, 2}, down{0.04, 1, true, 2};
  for (const auto& rule : {up, down}) {
    CHECK(rule(2.0, d) == 0);
    CHECK(rule(2.079, d) == 0); // inside the interval
    CHECK(rule(1.921, d) == 0);
    CHECK(rule(0, d) == Approx(0.2 * d2)); // empty
  }
  // alpha = (excess / gamma - 1), rounded; the change is alpha tau gamma D^2 / 2.
  CHECK(up(2.2, d) == Approx(-2 * 0.04 * d2 / 2));   // 1.5
  CHECK(down(2.2, d) == Approx(-1 * 0.04 * d2 / 2));
  CHECK(up(1.9, d) == Approx(0.04 * d2 / 2));        // 0.25
  CHECK(down(1.9, d) == 0);                          // the printed form parks here
  const Multiplicative_weight_rule slow{0.04, 0.25, false, 2};
  CHECK(slow(2.2, d) == Approx(up(2.2, d) / 4));
  const Multiplicative_weight_rule limit{0, 1, false, 2}; // CCCPD: in proportion
  CHECK(limit(2.2, d) == Approx(-0.1 * d2 / 2));
  CHECK(limit(1.9, d) == Approx(0.05 * d2 / 2));
}

TEST_CASE("Newton's direction in closed form")
{
  // Two cells of areas 1 and 3 with one common edge, as long as the sites are apart.
  const std::vector<Capacity_edge> edges = {{0, 1, 1}, {1, 0, 1}};
  const std::vector<double> direction = newton_weights_direction({1, 3}, {1, 1}, edges, {0, 0});
  REQUIRE(direction.size() == 2);
  CHECK(direction[0] == Approx(1).epsilon(1e-6)); // dA = (dw_0 - dw_1) e / (2 d) = 1
  CHECK(direction[1] == Approx(-1).epsilon(1e-6));
  // Area in inverse proportion to the density: nothing is left to do.
  for (double dw : newton_weights_direction({1, 3}, {3, 1}, edges, {0, 0}))
    CHECK(std::abs(dw) < 1e-9);
  // The second one keeps its area: nothing can change.
  for (double dw : newton_weights_direction({1, 3}, {1, 1}, edges, {0, 1}))
    CHECK(std::abs(dw) < 1e-9);
  // Two components: each keeps its area.
  const std::vector<double> apart = newton_weights_direction(
      {1, 3, 10, 10}, {1, 1, 1, 1}, {{0, 1, 1}, {1, 0, 1}, {2, 3, 1}, {3, 2, 1}},
      {0, 0, 0, 0});
  CHECK(apart[0] == Approx(1).epsilon(1e-6));
  CHECK(std::abs(apart[2]) < 1e-9);
}

TEST_CASE("Newton's direction for more cells than are factored")
{
  // Unit squares around a torus whose areas are waves: an eigenvector of the system.
  const int m = 320;
  const double angle = 2 * 3.14159265358979 / m, eigenvalue = 1 - std::cos(angle);
  std::vector<double> areas, density(m * m, 1);
  std::vector<Capacity_edge> edges;
  for (int i = 0; i < m * m; ++i) {
    const int row = i / m, column = i % m;
    areas.push_back(1 + 0.1 * std::cos(angle * column));
    for (const int j : {(row + 1) % m * m + column, (row + m - 1) % m * m + column,
                        row * m + (column + 1) % m, row * m + (column + m - 1) % m})
      edges.push_back({i, j, 1});
  }
  // Two cells with more edges than the iterations have room for. They lead to cells of the same
  // direction, so that they change nothing, left out or not.
  for (const int hub : {0, m / 2})
    for (int row = 2; row < 42; ++row) {
      edges.push_back({hub, hub + row * m, 5});
      edges.push_back({hub + row * m, hub, 5});
    }
  const std::vector<double> direction =
      newton_weights_direction(areas, density, edges, std::vector<char>(m * m, 0));
  REQUIRE(direction.size() == areas.size());
  double error = 0, norm = 0;
  for (int i = 0; i < m * m; ++i) {
    const double expected = (1 - areas[i]) / eigenvalue;
    error += (direction[i] - expected) * (direction[i] - expected);
    norm += expected * expected;
  }
  CHECK(error <= 1e-6 * norm);
}

TEST_CASE("cells at tips do not keep the others from equal capacities")
{
  engine_comparison::check_tips<Cpu_engine<Sequential_tag>>();
}

TEST_CASE("both ways of weighting make the capacities equal")
{
  for (double power : {0., 1.})
    for (unsigned seed : {1u, 2u}) {
      CAPTURE(power);
      CAPTURE(seed);
      Surface surface = shapes::make_surface(shapes::icosphere(4));
      for (std::size_t v = 0; v < surface.points.size(); ++v)
        surface.vertex_density[v] = std::exp(power * surface.points[v].z);
      Remeshing_options options = options_for(300);
      options.random_seed = seed;
      const Samples samples = sample_surface(surface, options);
      Cpu_engine<Sequential_tag> newton(surface, options);
      newton.set_samples(samples);
      newton.build_cells();
      const std::vector<Vec3d> points = newton.samples().points;
      CHECK(newton.capacity().rms > 0.02);
      double before = newton.capacity().rms;
      for (int pass = 0; pass < 12 && newton.capacity().rms > 1e-9; ++pass) {
        REQUIRE(newton.newton_weights());
        CHECK(newton.capacity().rms < before);
        before = newton.capacity().rms;
      }
      CHECK(newton.capacity().largest_deviation < 1e-6);
      CHECK(newton.capacity().inside_interval == 1);
      CHECK(newton.samples().points == points); // weights move no sample
      const std::vector<double> weights = newton.samples().weights;
      CHECK(std::abs(std::accumulate(weights.begin(), weights.end(), 0.)) < 1e-9);
      for (const Cell_polygon& cell : newton.cells())
        CHECK(cell.mass == Approx(newton.cells()[0].mass).epsilon(1e-5));

      Cpu_engine<Sequential_tag> rule(surface, options);
      rule.set_samples(samples);
      rule.build_cells();
      for (int pass = 0; pass < 300 && rule.capacity().inside_interval < 1; ++pass) {
        rule.update_weights();
        rule.build_cells();
      }
      CHECK(rule.capacity().inside_interval == 1);
      const std::size_t constructions = rule.constructions();
      rule.clear_weights();
      CHECK(rule.samples().weights == std::vector<double>(300, 0));
      CHECK(rule.capacity().rms > 0.02); // of cells without weights
      CHECK(rule.constructions() == constructions + 1);
    }
}

// --- positions and the engine as a whole -----------------------------------------------------------

TEST_CASE("L-BFGS on a quadratic energy")
{
  // A chain of points, each pulled to its place and to its neighbours.
  constexpr int n = 200;
  const auto gradient_at = [](const std::vector<Vec3d>& x)
  {
    std::vector<Vec3d> g(n);
    for (int i = 0; i < n; ++i) {
      g[i] = 0.01 * (1 + i % 5) * (x[i] - Vec3d{double(i), std::sin(i), 1});
      if (i > 0) g[i] += x[i] - x[i - 1];
      if (i + 1 < n) g[i] += x[i] - x[i + 1];
    }
    return g;
  };
  const std::vector<double> inverse_diagonal(n, 0.5);
  const auto residual_after = [&](int iterations, int memory)
  {
    Lbfgs<Sequential_tag> lbfgs(memory);
    std::vector<Vec3d> x(n, {0, 0, 0});
    for (int k = 0; k < iterations; ++k) {
      const std::vector<Vec3d> step = lbfgs.direction(x, gradient_at(x), inverse_diagonal);
      for (int i = 0; i < n; ++i) x[i] += step[i];
    }
    double squares = 0;
    for (const Vec3d& g : gradient_at(x)) squares += squared_length(g);
    return std::sqrt(squares);
  };
  const double before = residual_after(0, 5), descent = residual_after(100, 0);
  CHECK(residual_after(100, 5) < 1e-4 * before);
  CHECK(residual_after(100, 5) < 0.01 * descent);

  // The first direction, and the one after clear(), is the scaled gradient.
  Lbfgs<Sequential_tag> lbfgs(5);
  const std::vector<Vec3d> x(n, {1, 2, 3}), g = gradient_at(x);
  for (int k = 0; k < 2; ++k) {
    const std::vector<Vec3d> step = lbfgs.direction(x, g, inverse_diagonal);
    for (int i = 0; i < n; ++i) CHECK(length(step[i] + 0.5 * g[i]) < 1e-14);
    lbfgs.clear();
  }
}

TEST_CASE("L-BFGS: a point without a gradient has no say")
{
  // The first point in a bowl that is twice as steep one way; the other leaps about, its gradient
  // unknown (0) in most iterations: it is known in no two in a row.
  const auto gradient_at = [](const Vec3d& p) { return Vec3d{p.x, 2 * p.y, 1.5 * p.z}; };
  Lbfgs<Sequential_tag> alone(5), both(5);
  Vec3d p{1, 2, 3}, leap{10, -20, 30};
  for (int k = 0; k < 8; ++k) {
    const Vec3d one = alone.direction({p}, {gradient_at(p)}, {0.7})[0];
    const bool is_known = k % 3 == 1;
    const Vec3d two = both.direction({p, leap}, {gradient_at(p), is_known ? leap : Vec3d{0, 0, 0}},
                                     {0.7, is_known ? 0.5 : 0.0})[0];
    CHECK(length(one - two) <= 1e-14 * length(one));
    p += one;
    leap = Vec3d{leap.y, -leap.z, 1.5 * leap.x};
  }
  CHECK(length(p) < 1e-3); // it has learnt something
}

TEST_CASE("the engine: cells of the surface, Lloyd's steps, statistics")
{
  const Surface surface = shapes::make_surface(shapes::icosphere(4));
  Remeshing_options options = options_for(400);
  options.sampling = Sampling::random;
  Cpu_engine<Sequential_tag> engine(surface, options);
  engine.set_samples(sample_surface(surface, options));
  engine.build_cells();
  CHECK(engine.constructions() == 1);
  const double first = engine.displacement();
  for (int k = 0; k < 60; ++k) {
    engine.move_samples(Position_method::lloyd);
    engine.build_cells();
  }
  CHECK(engine.constructions() == 61);
  CHECK(engine.displacement() < 0.15 * first);
  CHECK(engine.cell_counts().ok == 400);

  const Samples samples = engine.samples();
  const std::vector<Cell_polygon> cells = engine.cells();
  REQUIRE(cells.size() == 400);
  double area = 0;
  for (int i = 0; i < 400; ++i) {
    area += cells[i].area;
    CHECK(cells[i].weight == samples.weights[i]);
    CHECK(cells[i].mass == Approx(cells[i].area * cells[i].density));
    CHECK(cells[i].vertices.size() == cells[i].neighbors.size());
    for (const Vec3d& p : cells[i].vertices) // in the tangent plane
      CHECK(std::abs(dot(p - samples.points[i], samples.normals[i])) < 1e-12);
    // On the facet that carries the sample.
    const Triangle& t = surface.triangles[samples.facets[i]];
    const Vec3d q = nearest_point_on_triangle(samples.points[i], surface.points[t[0]],
                                              surface.points[t[1]], surface.points[t[2]]);
    CHECK(length(q - samples.points[i]) < 1e-12);
  }
  CHECK(area == Approx(surface.area).epsilon(0.03)); // tangent planes lie outside of the sphere
}

TEST_CASE("L-BFGS gets nearer to centroidal samples than Lloyd's method does in as many steps")
{
  const Surface surface = shapes::make_surface(shapes::torus(60, 30, 1, 0.4));
  const Remeshing_options options = options_for(400);
  const auto displacement_after = [&](Position_method method)
  {
    Cpu_engine<Sequential_tag> engine(surface, options);
    engine.set_samples(sample_surface(surface, options));
    engine.build_cells();
    for (int k = 0; k < 80; ++k) {
      engine.move_samples(k < 10 ? Position_method::lloyd : method);
      engine.build_cells();
    }
    engine.restore_best();
    return engine.displacement();
  };
  CHECK(displacement_after(Position_method::lbfgs) <
        0.8 * displacement_after(Position_method::lloyd));
}
