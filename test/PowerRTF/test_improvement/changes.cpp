// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is found anew only where a mesh has changed, against searches of all of it.
#include "../improvement_case.h"

#include <CGAL/PowerRTF/geometry/Cell_marks.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/box_around.h>
#include <CGAL/PowerRTF/improvement/Changed_vertices.h>
#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Face_blocks.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/Surface_projector.h>
#include <CGAL/PowerRTF/sampling/random_source.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/tags.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

using namespace improvement_case;

namespace {

using Vertex = internal::Star_mesh::Vertex;
using Face = internal::Working_mesh::Face;

struct Changing_mesh {
  Case c = make_case(shapes::ellipsoid(1, 0.7, 0.4, 4), 3000, 1);
  Facet_tree tree{c.surface.points, c.surface.triangles};
  internal::Surface_projector projector{c.surface, tree};
  internal::Star_mesh mesh{c.raw, projector};
  double spacing = std::sqrt(c.surface.area / double(mesh.size()));

  /// Lifts so many vertices off the surface, by up to the spacing, and flips an edge at each.
  void change(int vertices, std::uint64_t seed)
  {
    for (int k = 0; k < vertices; ++k) {
      const Vertex v(int(counted_random(seed, k, 0) * double(mesh.size())));
      if (!mesh.is_movable(v)) continue;
      mesh.move_off(v, mesh.point(v) + counted_random(seed, k, 1) * spacing * mesh.normal(v));
      const auto e = mesh.working().mesh.edge(mesh.working().mesh.halfedge(v));
      if (mesh.working().is_flippable(e)) mesh.flip(e);
    }
  }
};

} // namespace

TEST_CASE("what is watched is what a search of all faces finds")
{
  Changing_mesh m;
  const auto& mesh = m.mesh.working().mesh;
  const auto holds = [&](Face f) {
    const auto [a, b, c] = m.mesh.points(mesh.halfedge(f));
    return internal::triangle_badness(a, b, c).badness > 0.1;
  };
  internal::Watched_faces watched(m.mesh);
  std::size_t before = 0;
  const auto check = [&] {
    std::vector<Face> expected;
    for (const Face f : mesh.faces())
      if (holds(f)) expected.push_back(f);
    CHECK(watched.find(holds) == expected);
    const std::size_t found = expected.size();
    CHECK(found != before);
    before = found;
  };
  check();
  for (int round = 1; round <= 8; ++round) { // few changes, and many
    CAPTURE(round);
    m.change(round % 4 == 0 ? 1000 : 20, round);
    check();
  }
  internal::Star_mesh::Checkpoint start(m.mesh);
  m.change(20, 100);
  check();
  start.restore();
  check();
}

TEST_CASE("faces near a place are those of a search of all of them, after any changes")
{
  Changing_mesh m;
  const auto& mesh = m.mesh.working().mesh;
  const double radius = 2 * m.spacing;
  internal::Face_blocks blocks(m.mesh, 0), whole(m.mesh);
  std::size_t found = 0;
  const auto check = [&] {
    for (int v = 0; v < int(m.mesh.size()); v += 100) {
      if (mesh.is_removed(Vertex(v))) continue;
      const Vec3d p = m.mesh.point(Vertex(v));
      const auto is_near = [&](const Box3<double>& box) {
        return squared_distance(box, p) < radius * radius;
      };
      std::vector<Face> expected;
      for (const Face f : mesh.faces())
        if (is_near(blocks.box(f))) expected.push_back(f);
      for (internal::Face_blocks* faces : {&blocks, &whole})
        CHECK(faces->find(is_near, [&](Face f) { return is_near(faces->box(f)); }) == expected);
      found += expected.size();
    }
  };
  // Takes a vertex out, and puts it into an edge far away.
  const auto relocate = [&](int k) {
    const auto h = mesh.halfedge(Vertex(100 * k + 7));
    REQUIRE(CGAL::Euler::does_satisfy_link_condition(mesh.edge(h), mesh));
    m.mesh.collapse(h);
    check();
    const auto split = mesh.halfedge(Vertex(2900 - 100 * k));
    m.mesh.split(split, m.projector.nearest(m.mesh.point(mesh.target(split))));
    check();
  };
  check();
  for (int round = 1; round <= 4; ++round) { // few changes, and many
    CAPTURE(round);
    m.change(round == 3 ? 1000 : 20, round);
    check();
    internal::Star_mesh::Checkpoint start(m.mesh);
    relocate(2 * round);
    if (round % 2 == 0) start.restore();
    check();
    relocate(2 * round + 1);
  }
  CHECK(found > 1000);
}

TEST_CASE("after any changes far points are as far as the nearest face that agrees")
{
  using Parameters = internal::Improvement_parameters;
  Changing_mesh m;
  const auto& mesh = m.mesh.working().mesh;
  const internal::Surface_projector& projector = m.mesh.projector();
  internal::Distance_tracker tracker(m.mesh,
                                     internal::tracked_points(projector.surface(), projector.tree(),
                                                              m.mesh.size(), m.mesh.concurrency()));
  std::size_t far = 0;
  for (int round = 1; round <= 6; ++round) { // few changes, and many
    CAPTURE(round);
    m.change(round % 3 == 0 ? 500 : 20, round);
    tracker.update();
    std::vector<int> at_faces(tracker.size(), 0);
    for (const Face f : mesh.faces()) {
      const auto points = tracker.at_face(f);
      CHECK(std::is_sorted(points.begin(), points.end()));
      for (const int i : points) {
        ++at_faces[i];
        CHECK(mesh.face(tracker[i].face) == f);
      }
    }
    CHECK(std::count(at_faces.begin(), at_faces.end(), 1) == tracker.size());
    for (const int i :
         tracker.farther_than(Parameters::Tracking::tree_search_distance * m.spacing)) {
      double least = std::numeric_limits<double>::infinity();
      for (const Face f : mesh.faces()) {
        const auto [a, b, c] = m.mesh.points(mesh.halfedge(f));
        const Vec3d n = cross(b - a, c - a);
        if (dot(n, tracker.normal(i)) > Parameters::Projection::min_normal_cosine * length(n))
          least = std::min(least, length(nearest_point_on_triangle(tracker.point(i), a, b, c) -
                                         tracker.point(i)));
      }
      CHECK(tracker[i].distance == doctest::Approx(least).epsilon(1e-12));
      ++far;
    }
  }
  CHECK(far > 100);
}

TEST_CASE("a box that overlaps one that was marked touches its cells, one far away does not")
{
  const auto box = [](std::uint64_t seed, int k, double largest) {
    const auto random = [&](int i) { return counted_random(seed, k, i); };
    const Vec3d p{2 * random(0) - 1, 2 * random(1) - 1, 2 * random(2) - 1};
    const double r = largest * random(3);
    return Box3<double>{p, p + Vec3d{r, r, r}};
  };
  for (const double largest : {0., 0.02, 0.5}) {
    CAPTURE(largest);
    std::vector<Box3<double>> marked;
    for (int k = 0; k < 20; ++k) marked.push_back(box(1, k, largest));
    internal::Cell_marks cells(
        internal::box_around(CGAL::Sequential_tag(), int(marked.size()), marked));
    for (const Box3<double>& b : marked) cells.add(b);
    int touching = 0, apart = 0;
    for (int k = 0; k < 2000; ++k) {
      const Box3<double> b = box(2, k, 0.3);
      const bool overlaps = std::any_of(marked.begin(), marked.end(), [&](const auto& other) {
        return squared_distance(b, other) == 0;
      });
      if (overlaps) CHECK(cells.touches(b));
      touching += overlaps;
      apart += !cells.touches(b);
    }
    CHECK(touching > 10);
    CHECK(apart > 200);
  }
}
