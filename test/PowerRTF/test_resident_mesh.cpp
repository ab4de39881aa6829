// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes where an engine works, on the host: what is found there is what the host finds, and in a
// run each goes up once. (On a device: test_cuda_device/meshes.cpp.)
#include "counting_backend.h"
#include "engine_comparison.h"
#include "flips_case.h"
#include "mesh_of_shape.h"

#include <CGAL/PowerRTF/quality/assess.h>
#include <CGAL/PowerRTF_remesher.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

using namespace engine_comparison;

namespace {

/// Counts the meshes that go up.
template <class Tag>
class Watched_engine : public counting::Counted_engine<double, Tag> {
public:
  using counting::Counted_engine<double, Tag>::Surface_engine;
  inline static int brought = 0;

  Bring_mesh mesh_bringer()
  {
    return [bring = Surface_engine_base::mesh_bringer()](const Mesh_arrays& mesh) {
      ++brought;
      return bring(mesh);
    };
  }
};

template <class Tag>
struct Watched_traits {
  using Kernel = shapes::Kernel;
  using Concurrency_tag = Tag;
  using Engine = Watched_engine<Tag>;
  static const char* name() { return "watched"; }
};

/// The result of a run, whose meshes go up once each, and which is judged as by the host.
template <class Tag>
Extracted_mesh judged_run(const Case& c)
{
  Surface surface = shapes::make_surface(c.soup);
  surface.kept_vertices = c.kept_vertices;
  for (const int v : c.kept_vertices) surface.kept_points.push_back(surface.points[v]);
  set_creases(surface, c.options);
  set_density(surface, c.options);
  CGAL::PowerRTF_remesher<Watched_traits<Tag>> remesher(surface, c.options);
  Remeshing_default_visitor visitor;
  REQUIRE(remesher.optimize(visitor));
  int& brought = Watched_engine<Tag>::brought;
  brought = 0;
  Extracted_mesh mesh = remesher.extract(visitor);
  // Vertices that stay are judged where the input has them, which is another mesh.
  const int meshes =
      (c.options.improvement == Improvement::yes ? 2 : 1) + (c.kept_vertices.empty() ? 0 : 2);
  CHECK(brought == meshes);
  CHECK(mesh.there(remesher.mesh_bringer()));
  CHECK(brought == meshes);

  const Remeshing_report& report = remesher.report();
  Remeshing_report expected;
  assess(remesher.surface(), mesh, expected);
  CHECK(report.topology.vertices == c.options.number_of_samples);
  CHECK(report.topology.euler_characteristic == expected.topology.euler_characteristic);
  CHECK(report.topology.edges == expected.topology.edges);
  CHECK(report.topology.border_loops == expected.topology.border_loops);
  CHECK(report.self_intersections == 0);
  CHECK(expected.self_intersections == 0);
  CHECK(report.quality.q_min == expected.quality.q_min);
  CHECK(report.distance.mean == Approx(expected.distance.mean));
  CHECK(report.distance.max == Approx(expected.distance.max));
  return mesh;
}

} // namespace

TEST_CASE("in a run the extracted mesh goes up once, and the improved one")
{
  for (const Case& c : cases()) {
    CAPTURE(c.name);
    const Extracted_mesh sequential = judged_run<CGAL::Sequential_tag>(c),
                         parallel = judged_run<CGAL::Parallel_if_available_tag>(c);
    CHECK(sequential.points == parallel.points);
    CHECK(sequential.triangles == parallel.triangles);
  }
}

TEST_CASE("a mesh is there until another comes, it is released or changed")
{
  const Case c = cases().front();
  const Start start(c);
  auto engine = std::make_unique<counting::Counted_engine<double>>(start.surface, c.options);
  engine->facet_finder(); // the surface is there
  const Bring_mesh bring = engine->mesh_bringer();
  const shapes::Soup sphere = shapes::icosphere(1);
  Extracted_mesh mesh{sphere.points, sphere.triangles};
  CHECK_FALSE(mesh.there({}));
  const auto there = mesh.there(bring);
  REQUIRE(there);
  CHECK(mesh.there({}) == there);
  CHECK_FALSE(Extracted_mesh(mesh).there({}));
  std::vector<int> halfedges;
  CHECK_FALSE(there->find_flips(halfedges)); // the links are not known
  Triangle_links links;
  CHECK(there->topology(&links)->faces == sphere.triangles.size());
  CHECK(there->find_flips(halfedges));
  SUBCASE("changed")
  {
    mesh.sort_triangles();
    CHECK_FALSE(mesh.there({}));
  }
  SUBCASE("the triangles of another")
  {
    Extracted_mesh other{sphere.points, sphere.triangles};
    mesh.take(std::move(other));
    CHECK_FALSE(mesh.there({}));
  }
  SUBCASE("moved")
  {
    const Extracted_mesh moved = std::move(mesh);
    CHECK(moved.there({}) == there);
  }
  SUBCASE("released or replaced")
  {
    if (const auto other = Extracted_mesh{sphere.points, sphere.triangles}.there(bring))
      other->release();
    for (const auto& gone : {there, mesh.there({})}) {
      Face_pairs pairs;
      Two_sided_distances distances;
      int face = 0;
      CHECK_FALSE(gone->topology(nullptr));
      CHECK_FALSE(gone->find_flips(halfedges));
      CHECK_FALSE(gone->find_close_faces(pairs));
      CHECK_FALSE(gone->find_distances(10, distances));
      CHECK_FALSE(gone->find_faces(0, 1, &face, &face));
    }
  }
  CHECK_FALSE(Extracted_mesh{sphere.points, {}}.there(bring));
}

TEST_CASE("the stars that an engine makes of a mesh are those that would go up")
{
  using Backend = counting::Backend<CGAL::Sequential_tag>;
  for (const shapes::Soup& soup :
       {shapes::ellipsoid(1, 0.7, 0.4, 4), shapes::open_cylinder(40, 10, .5, 2)}) {
    const improvement_case::Sweeps_case c(soup, 400);
    const internal::Star_mesh& mesh = c.mesh();
    counting::Counted_engine<float> engine(c.surface(), Remeshing_options());
    engine.facet_finder(); // the surface is there
    const internal::Flat_stars expected = flat_stars(mesh);
    Extracted_mesh raw;
    raw.points.resize(mesh.size());
    mesh.write(raw);
    const auto there = raw.there(engine.mesh_bringer());
    const auto sweeps = c.sweeps(engine.star_sweeps_maker());
    const Vertex_places places{expected.kinds.data(), expected.normals.data(),
                               expected.facets.data()};
    CHECK_FALSE(there->give_stars(places, *sweeps)); // the links are not known
    Triangle_links links;
    REQUIRE(there->topology(&links));
    const auto elsewhere = c.host_sweeps(CGAL::Sequential_tag());
    CHECK_FALSE(there->give_stars(places, *elsewhere));
    const std::size_t before = Backend::uploaded;
    REQUIRE(there->give_stars(places, *sweeps));
    CHECK(Backend::uploaded - before == mesh.size() * (1 + sizeof(Vec3d) + sizeof(int)));
    auto& made = dynamic_cast<Star_sweeps<Backend>&>(*sweeps).stars();
    const auto check = [](const auto& array, const auto& of_host) {
      REQUIRE(array.size() == of_host.size());
      CHECK(std::equal(of_host.begin(), of_host.end(), array.data()));
    };
    check(made.first, expected.first);
    check(made.neighbors, expected.neighbors);
    check(made.kinds, expected.kinds);
    check(made.points, expected.points);
    check(made.normals, expected.normals);
    check(made.facets, expected.facets);
    there->release();
    CHECK_FALSE(there->give_stars(places, *sweeps));
  }
}

TEST_CASE("among the edges that may be worth a flip are all that are, and few others")
{
  const shapes::Soup egg = shapes::ellipsoid(1, 0.7, 0.4, 4);
  flips_case::check(egg, 2000, [&](const Surface& surface) {
    return std::make_unique<counting::Counted_engine<float>>(surface, Remeshing_options());
  });
  flips_case::check(shapes::open_cylinder(40, 10, .5, 2), 400, [&](const Surface& surface) {
    return std::make_unique<counting::Counted_engine<float>>(surface, Remeshing_options());
  });
}
