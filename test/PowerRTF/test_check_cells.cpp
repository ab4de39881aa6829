// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the comparison with the exact cells puts down to rounding, and that it hides nothing else.
#include <doctest/doctest.h>

#include "fast_cells.h"

#include <cmath>

using namespace fast_cells;

namespace {

const Vec3d up{0, 0, 1};

/// A site at the origin with neighbors all around.
Cloud ring(int neighbors)
{
  Cloud cloud;
  cloud.cos_angle = -2;
  cloud.add({0, 0, 0}, up);
  for (int k = 0; k < neighbors; ++k) {
    const double angle = 2 * sample_families::pi * k / neighbors;
    cloud.add(Vec3d{std::cos(angle), std::sin(angle), 0} * 0.5, up);
  }
  return cloud;
}

std::vector<Cell_polygon> cells_of(Cloud& cloud, double first_radius = 1)
{
  return construct<Inexact_construction>(cloud, Remeshing_options(), first_radius);
}

Cell_comparison compare(const Cloud& cloud, const std::vector<Cell_polygon>& cells)
{
  return check_cells<CGAL::Sequential_tag>(cloud.samples, cells, cloud.cos_angle);
}

int place_of(const Cloud& cloud, const Vec3d& point)
{
  int place = 0;
  while (!(cloud.samples.points[place] == point)) ++place;
  return place;
}

/// Compares the cells of `cloud` as they are while the site at `hidden` is out of reach.
Cell_comparison compare_without(Cloud cloud, const Vec3d& hidden)
{
  sort(cloud);
  Cloud changed = cloud;
  changed.samples.weights[place_of(cloud, hidden)] = -1000;
  return compare(cloud, cells_of(changed));
}

} // namespace

TEST_CASE("a site that is left out is found missing")
{
  for (int neighbors = 5; neighbors < 12; ++neighbors) {
    Cloud cloud = ring(neighbors);
    CHECK(compare(cloud, cells_of(cloud)).passed());
    const Cell_comparison c = compare_without(cloud, cloud.samples.points[2]);
    CHECK(c.certified_wrong >= 3); // its own cell and those beside it
  }
}

TEST_CASE("a cell that is a point may be empty, and the other way round")
{
  Cloud cloud;
  cloud.cos_angle = -2;
  cloud.add({0, 0, 0}, up);
  cloud.add({-1, 1, 0}, up, 4); // its bisector passes through the crossing of the others
  cloud.add({1, 0, 0}, up);
  cloud.add({0, -1, 0}, up);
  const std::vector<Cell_polygon> cells = cells_of(cloud);
  const int place = place_of(cloud, {0, 0, 0});
  CHECK(cells[place].area == 0);
  CHECK(compare(cloud, cells).passed());

  Cloud heavier = cloud;
  heavier.samples.weights[place_of(cloud, {-1, 1, 0})] = 4.5;
  const Cell_comparison c = compare(heavier, cells);
  CHECK(std::find(c.wrong.begin(), c.wrong.end(), place) != c.wrong.end());
}

TEST_CASE("rounding may decide of a site straight above, but of no other")
{
  const double height = 1e-4, squared = height * height; // at this weight its bisector is the plane
  const Vec3d above{0, 0, height};
  const auto with_weight = [&](double weight) {
    Cloud cloud = ring(6);
    cloud.add(above, up, weight);
    return cloud;
  };
  const auto is_right = [&](double weight, double constructed_weight) {
    Cloud cloud = with_weight(weight), constructed = with_weight(constructed_weight);
    const std::vector<Cell_polygon> cells = cells_of(constructed);
    sort(cloud);
    const Cell_comparison c = compare(cloud, cells);
    const int place = place_of(cloud, {0, 0, 0});
    return std::find(c.wrong.begin(), c.wrong.end(), place) == c.wrong.end();
  };
  for (const int side : {-1, 1}) {
    CHECK(is_right(squared, squared * (1 + side * 1e-12)));
    CHECK(is_right(squared * (1 + side * 1e-6), squared * (1 + side * 1e-6)));
    CHECK_FALSE(is_right(squared * (1 + side * 1e-6), squared * (1 - side * 1e-6)));
  }
  for (const double weight : {squared, squared * (1 - 1e-12)}) {
    Cloud cloud = with_weight(weight);
    const Vec3d hidden = cloud.samples.points[2];
    const Cell_comparison c = compare_without(cloud, hidden);
    sort(cloud);
    const int place = place_of(cloud, {0, 0, 0});
    CHECK(std::find(c.wrong.begin(), c.wrong.end(), place) != c.wrong.end());
  }
}

TEST_CASE(
    "a tiny cell may be lost to a line known less well than the cell's edges, but to no other")
{
  const double size = 1e-16, height = 1e-5, squared = height * height;
  const auto with_weight = [&](double weight) {
    Cloud cloud;
    cloud.cos_angle = -2;
    cloud.add({0, 0, 0}, up);
    for (int k = 0; k < 3; ++k) {
      const double angle = 2 * sample_families::pi * k / 3;
      cloud.add(Vec3d{std::cos(angle), std::sin(angle), 0} * size, up);
    }
    cloud.add({2 * size, size, height}, up, weight); // at `squared` its bisector is the plane's
    return cloud;
  };
  const auto is_right = [&](double weight, double constructed_weight) {
    Cloud cloud = with_weight(weight), constructed = with_weight(constructed_weight);
    std::vector<Cell_polygon> cells = cells_of(constructed);
    sort(cloud);
    const int place = place_of(cloud, {0, 0, 0});
    REQUIRE(cells[place].neighbors.empty());
    const Cell_comparison c = compare(cloud, cells);
    return std::find(c.wrong.begin(), c.wrong.end(), place) == c.wrong.end();
  };
  const double heavier = squared * (1 + 1e-14);
  CHECK(is_right(squared * (1 - 1e-14), heavier));
  CHECK_FALSE(is_right(squared * (1 - 1e-6), heavier));
}

TEST_CASE("rounding may decide if a cell without room is there, but not among copies of its site")
{
  const int copies = 7;
  const auto with_weight = [&](double weight) { // at 1 its bisector passes through the copies
    Cloud cloud;
    cloud.cos_angle = -2;
    for (int k = 0; k < copies; ++k) cloud.add({0, 0, 0}, up);
    cloud.add({1, 0, 0}, up, weight);
    return cloud;
  };
  const auto wrong_cells = [&](double weight, double constructed_weight) {
    Cloud cloud = with_weight(weight), constructed = with_weight(constructed_weight);
    const std::vector<Cell_polygon> cells = cells_of(constructed);
    sort(cloud);
    return compare(cloud, cells).certified_wrong;
  };
  for (const int side : {-1, 1}) {
    CHECK(wrong_cells(1 + side * 1e-15, 1 - side * 1e-15) == 0);
    CHECK(wrong_cells(1 + side * 1e-6, 1 + side * 1e-6) == 0);
    CHECK(wrong_cells(1 + side * 1e-6, 1 - side * 1e-6) == 1);
  }

  Cloud cloud = with_weight(1);
  std::vector<Cell_polygon> cells = cells_of(cloud);
  for (Cell_polygon& cell : cells) {
    if (cell.status != Cell_status::empty) continue;
    cell.status = Cell_status::guarded;
    CHECK(compare(cloud, cells).certified_wrong == 1);
    cell.status = Cell_status::empty;
  }
}

TEST_CASE(
    "whether a needle reaches the guard radius may be due to rounding; whether a cell does, not")
{
  // Between two bisectors, nearly parallel, of which one passes the other 1e-15 away.
  Cloud cloud;
  cloud.cos_angle = -2;
  const double e = 2.2204460492503131e-16;
  cloud.add({-1, -1, -1}, up);
  cloud.add({-1 + e, -1 - e, -1 - e},
            {0.50767308256680954, -0.60920769908017147, -0.60920769908017147});
  cloud.add({0, 0, -1}, up);
  cloud.add({1.0006078227207347, -1.0007293872648815, -1.0007293872648815}, up, 4.002432724342964);
  CHECK(compare(cloud, cells_of(cloud)).passed());

  cloud = ring(6);
  std::vector<Cell_polygon> cells = cells_of(cloud);
  const int place = place_of(cloud, {0, 0, 0});
  REQUIRE(cells[place].status == Cell_status::ok);
  cells[place].status = Cell_status::guarded;
  CHECK_FALSE(compare(cloud, cells).passed());
}

TEST_CASE("a cell is found in a first square of any size")
{
  for (const double scale : {1., 1e-9, 1e-16, 1e-30}) {
    Cloud cloud = ring(7);
    for (Vec3d& p : cloud.samples.points) p = p * scale;
    const std::vector<Cell_polygon> cells = cells_of(cloud, 8);
    CHECK(compare(cloud, cells).passed());
    CHECK(cells[place_of(cloud, {0, 0, 0})].status == Cell_status::ok);
  }
}
