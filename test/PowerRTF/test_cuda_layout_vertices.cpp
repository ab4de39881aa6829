// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The paper's projection and attributes as a warp of the GPU finds them, run on the host, against
// those of a single thread: by the vertices' lists, and in the tree where no list proves them.
#include "packed.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <random>

#include "warp_on_host.h"

#include "../../cuda/surface/vertices_by_warp.cuh"

using namespace CGAL::PowerRTF;
using namespace CGAL::PowerRTF::device;

namespace {

/// A large box with a small, finely meshed ball beside a corner: lists there do not reach far.
shapes::Soup dense_spot()
{
  const shapes::Soup box = shapes::box(1);
  return shapes::joined(
      box, shapes::translated(shapes::scaled(shapes::icosphere(3), 1e-3), box.points[0] * 1.01));
}

template <class Real>
void compare(const shapes::Soup& soup)
{
  const Surface surface = shapes::make_surface(soup);
  Packed<Real> packed(surface);
  packed.arrays.list_near_vertices(packed.backend);
  const Surface_view<Real>& view = packed.view();

  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::uniform_int_distribution<int> any_facet(0, int(surface.triangles.size()) - 1);
  for (int round = 0; round < 64; ++round) {
    const int hint = any_facet(random);
    const Facet_corners<Real> f = view.facets[hint];
    const double a = std::abs(uniform(random)), b = (1 - a) * std::abs(uniform(random));
    const double steps[] = {0, 0.01, 0.1, 1};
    const Real far = Real(steps[round % 4]);
    const Vec3<Real> p =
        f.a * Real(a) + f.b * Real(b) + f.c * Real(1 - a - b) +
        Vec3<Real>{Real(uniform(random)), Real(uniform(random)), Real(uniform(random))} * far;
    const int k = 1 + round % 32;
    int expected[max_near_vertices];
    const int count = nearest_vertices(view, p, k, expected);
    const Real angle = Real(0.5);
    const Surface_point<Real> q =
        project_near_vertices(view, p, f.normal, angle, k, hint, Single_lane());
    const Vertex_attributes<Real> attributes =
        attributes_near_vertices(view, p, hint, k, k / 2, angle, Single_lane());
    Host_warp::run([&](int lane) {
      const Warp_lanes lanes;
      const int vertex = nearest_vertex(view, p, count, hint, lanes);
      const int in_tree = nearest_vertex_in_tree(view, p, count, Real(1e30), lanes);
      const Surface_point<Real> x = project_near_vertices(view, p, f.normal, angle, k, hint, lanes);
      const Vertex_attributes<Real> y =
          attributes_near_vertices(view, p, hint, k, k / 2, angle, lanes);
      // In the ball that the last one is on, as where no list proves it.
      const Real within = squared_length(view.vertices[expected[count - 1]] - p);
      const int collected = collect_vertices(view, p, within, vertex_memory<Real>(), lanes);
      CHECK((collected >= count || collected < 0));
      if (lane < count) {
        CHECK(vertex == expected[lane]);
        CHECK(in_tree == expected[lane]);
      }
      CHECK(x.facet == q.facet);
      if (q.facet >= 0) CHECK(x.point == q.point);
      CHECK(y.normal == attributes.normal);
      CHECK(y.density == attributes.density);
    });
  }
}

} // namespace

TEST_CASE_TEMPLATE("a warp finds the vertices, the projection and the attributes of a thread", Real,
                   float, double)
{
  SUBCASE("few vertices") { compare<Real>(shapes::box(2)); }
  SUBCASE("even ones") { compare<Real>(shapes::ellipsoid(1, 0.7, 0.5, 4)); }
  SUBCASE("a thin torus") { compare<Real>(shapes::torus(96, 12, 1, 0.05)); }
  SUBCASE("a dense spot") { compare<Real>(dense_spot()); }
}
