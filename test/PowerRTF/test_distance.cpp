// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The distance of two surfaces against closed forms.
#include "shapes.h"
#include "unknown_mesh.h"

#include <CGAL/PowerRTF/engines/surface_distances.h>
#include <CGAL/PowerRTF/geometry/curve_order.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/quality/surface_distance.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace CGAL::PowerRTF;
using doctest::Approx;
using shapes::Soup;

namespace {

Distance_statistics distance(const Soup& a, const Soup& b)
{
  return surface_distance(a.points, a.triangles, b.points, b.triangles);
}

} // namespace

TEST_CASE("distance: parallel squares")
{
  const Soup square = shapes::plane_patch(7, 7);
  for (const double d : {0., 1e-3, 0.25}) {
    const Distance_statistics s =
        distance(square, shapes::translated(shapes::plane_patch(3, 5), {0, 0, d}));
    const double percent = 100 * d / std::sqrt(2.);
    CHECK(s.mean == Approx(percent));
    CHECK(s.rms == Approx(percent));
    CHECK(s.max == Approx(percent));
  }
}

TEST_CASE("distance: the worse direction counts")
{
  // the unit square, and its half x <= 1/2: mean over the square 1/8, RMS sqrt(1/24), maximum 1/2
  const Soup square = shapes::plane_patch(8, 8);
  Soup half = shapes::plane_patch(8, 8);
  for (Vec3d& p : half.points) p.x /= 2;
  for (const bool turned : {false, true}) {
    const Distance_statistics s = turned ? distance(half, square) : distance(square, half);
    const double percent = 100 / (turned ? std::sqrt(1.25) : std::sqrt(2.));
    CHECK(s.mean == Approx(percent / 8).epsilon(0.01));
    CHECK(s.rms == Approx(percent * std::sqrt(1. / 24)).epsilon(0.01));
    CHECK(s.max == Approx(percent / 2));
  }
}

TEST_CASE("distance: a vertex counts for the maximum, however small its facets")
{
  Soup spike = shapes::plane_patch(10, 10);
  const int tip = static_cast<int>(spike.points.size());
  spike.points.push_back({0.5, 0.5, 0.2});
  spike.points.push_back({0.5 + 1e-9, 0.5, 0});
  spike.points.push_back({0.5, 0.5 + 1e-9, 0});
  spike.triangles.push_back({tip, tip + 1, tip + 2});
  const Distance_statistics s = distance(shapes::plane_patch(10, 10), spike);
  CHECK(s.max == Approx(100 * 0.2 / std::sqrt(2.)));
  CHECK(s.mean < 1e-3);
}

TEST_CASE("distance: in groups as one by one, to the last bit")
{
  using internal::Group_distances;
  const Soup sphere = shapes::scaled(shapes::icosphere(4), 0.7);
  const Facet_tree tree(sphere.points, sphere.triangles);
  const auto check = [&](const std::vector<Vec3d>& points, double enough) {
    Group_distances distances(tree);
    double found[Group_distances::most_points];
    for (int first = 0; first < int(points.size()); first += Group_distances::most_points) {
      const int n = std::min(Group_distances::most_points, int(points.size()) - first);
      distances.find(&points[first], n, found, enough);
      for (int k = 0; k < n; ++k) {
        const double expected = tree.nearest_anywhere(points[first + k]).squared_distance;
        if (expected > enough)
          CHECK(found[k] == expected);
        else
          CHECK((found[k] >= expected && found[k] <= enough));
      }
    }
  };
  std::vector<Vec3d> along, anywhere; // a spiral near the sphere with a leap; points far apart
  for (int i = 0; i < 1500; ++i) {
    const double z = -1 + (i + 0.5) / 750, r = std::sqrt(1 - z * z);
    const double out = i == 700 ? 0.2 : 0.69 + 0.03 * std::sin(0.1 * i);
    along.push_back(out * Vec3d{r * std::cos(0.3 * i), r * std::sin(0.3 * i), z});
    anywhere.push_back(0.9 * Vec3d{std::sin(1.7 * i), std::sin(2.3 * i), std::sin(3.1 * i)});
  }
  for (const auto& points : {along, anywhere, sphere.points})
    for (const double enough : {-1., 0., 1e-4, 1.}) check(points, enough);
}

TEST_CASE("distance: spheres, and invariance")
{
  const Soup fine = shapes::icosphere(5);
  Soup larger = shapes::icosphere(5);
  for (Vec3d& p : larger.points) p = 1.1 * p;
  const Distance_statistics s = distance(fine, larger);
  const double percent = 100 / (2 * std::sqrt(3.));
  CHECK(s.mean == Approx(0.1 * percent).epsilon(0.01));
  CHECK(s.max == Approx(0.1 * percent).epsilon(0.02));
  CHECK(s.rms >= s.mean);

  const auto moved = [](const Soup& t) {
    return shapes::translated(shapes::rotated(shapes::scaled(t, 1000), 0.7), {5000, -3000, 800});
  };
  const auto coarse = shapes::icosphere(3);
  const Distance_statistics before = distance(fine, coarse),
                            after = distance(moved(fine), moved(coarse));
  const auto diagonal = [](const Soup& t) {
    const Box3<double> box = internal::bounding_box(t.points, t.triangles);
    return length(box.hi - box.lo);
  };
  const double change = 1000 * diagonal(fine) / diagonal(moved(fine)); // the box turns too
  CHECK(after.mean == Approx(before.mean * change).epsilon(0.02));
  CHECK(after.rms == Approx(before.rms * change).epsilon(0.02));

  const Distance_statistics parallel =
      surface_distance(fine.points, fine.triangles, coarse.points, coarse.triangles,
                       CGAL::Parallel_if_available_tag());
  CHECK(parallel.mean == before.mean);
  CHECK(parallel.rms == before.rms);
  CHECK(parallel.max == before.max);
  CHECK(distance(fine, Soup()).max == 0);
  CHECK(distance(Soup(), fine).max == 0);
}

TEST_CASE("distance: a backend has the faces in the order of their tree")
{
  Host_backend<CGAL::Sequential_tag> backend;
  for (const Soup& s :
       {shapes::torus(70, 50, 0.6, 0.2), shapes::plane_patch(30, 40),
        shapes::permuted(shapes::icosphere(4), 1), Soup{{{1, 1, 1}}, {{0, 0, 0}}}}) {
    const int n = int(s.triangles.size());
    std::vector<int> order(n);
    internal::order_along_curve(backend, n,
                                internal::Face_centers{s.points.data(), s.triangles.front().data()},
                                order.data());
    CHECK(order == Facet_tree(s.points, s.triangles).order());
  }
}

TEST_CASE("distance: samples share the area evenly")
{
  const Soup s = shapes::permuted(shapes::torus(40, 13, 0.6, 0.3), 2);
  const Facet_tree tree(s.points, s.triangles);
  const internal::Surface_samples all(s.points, s.triangles, tree, CGAL::Sequential_tag());
  constexpr int n = 5000;
  std::vector<int> count(s.triangles.size());
  for (int i = 0; i < n; ++i) {
    const auto nearest = tree.nearest_anywhere(all.samples(n)(i));
    CHECK(nearest.squared_distance < 1e-28);
    ++count[nearest.facet];
  }
  double area = 0;
  const auto area_of = [&](const Triangle& t) {
    const Vec3d &a = s.points[t[0]], &b = s.points[t[1]], &c = s.points[t[2]];
    return length(cross(b - a, c - a)) / 2;
  };
  for (const Triangle& t : s.triangles) area += area_of(t);
  for (std::size_t f = 0; f < s.triangles.size(); ++f)
    CHECK(std::fabs(count[f] - n * area_of(s.triangles[f]) / area) < 1);
}

namespace {

/// Distances as an engine finds them, on the host.
template <class Tag>
struct Mesh_there : unknown::Mesh {
  const Soup &mesh, &surface;
  const Facet_tree& tree;
  const std::vector<int>& corners_by_place;

  Mesh_there(const Soup& m, const Soup& s, const Facet_tree& t, const std::vector<int>& corners)
      : mesh(m), surface(s), tree(t), corners_by_place(corners)
  {}

  bool find_distances(int samples, Two_sided_distances& result) override
  {
    Host_backend<Tag> backend;
    Surface_view<double> there = tree.view();
    there.facet_vertices = corners_by_place.data();
    Surface_facets facets;
    facets.vertices = int(surface.points.size());
    facets.facets = int(surface.triangles.size());
    facets.points = surface.points.data();
    return internal::surface_distances(backend, facets, there, shapes::arrays(mesh), samples,
                                       result);
  }
};

void check_same(const Distance_statistics& a, const Distance_statistics& b)
{
  CHECK(a.mean == b.mean);
  CHECK(a.rms == b.rms);
  CHECK(a.max == b.max);
  CHECK(a.bound == b.bound);
  for (int k = 0; k < 3; ++k) CHECK(a.farthest[k] == b.farthest[k]);
}

} // namespace

TEST_CASE("distance: found by a backend, to the last bit")
{
  using Tag = CGAL::Parallel_if_available_tag;
  const Soup fine = shapes::icosphere(4), coarse = shapes::icosphere(2);
  Soup with_unused = shapes::permuted(shapes::torus(90, 60, 0.6, 0.2), 3);
  with_unused.points.push_back({0.9, 0.9, 0.9});                // would be the farthest one
  const Soup small = shapes::scaled(shapes::octahedron(), 0.3); // of equally far vertices
  const Soup single = {{{0, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0}}, {{0, 1, 2}}};
  for (const Soup& in : {fine, coarse, with_unused, small, single}) {
    const Facet_tree tree(in.points, in.triangles);
    std::vector<int> corners;
    for (const int f : tree.order())
      corners.insert(corners.end(), in.triangles[f].begin(), in.triangles[f].end());
    for (const Soup& out : {fine, coarse, with_unused, small, single}) {
      const auto run = [&](bool is_bound_wanted, Resident_mesh* there) {
        return surface_distance(in.points, in.triangles, tree, out.points, out.triangles, Tag(),
                                is_bound_wanted, there);
      };
      Mesh_there<Tag> parallel(out, in, tree, corners);
      Mesh_there<CGAL::Sequential_tag> sequential(out, in, tree, corners);
      const bool is_bound_wanted = in.triangles.size() < 20 && out.triangles.size() < 20;
      const Distance_statistics expected = run(is_bound_wanted, nullptr);
      check_same(run(is_bound_wanted, &parallel), expected);
      check_same(run(is_bound_wanted, &sequential), expected);
    }
  }
}

TEST_CASE("distance: where a backend finds none, the host does")
{
  const Soup fine = shapes::icosphere(4), coarse = shapes::icosphere(2);
  struct : unknown::Mesh {
    int calls = 0;
    bool find_distances(int, Two_sided_distances&) override { return ++calls == 0; }
  } there;
  check_same(surface_distance(fine.points, fine.triangles, Facet_tree(fine.points, fine.triangles),
                              coarse.points, coarse.triangles, CGAL::Sequential_tag(), false,
                              &there),
             distance(fine, coarse));
  CHECK(there.calls == 1);
}
