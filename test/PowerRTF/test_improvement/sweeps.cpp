// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sweeps over all vertices of a mesh, as loops that a backend runs.
#include "../odd_shapes.h"
#include "../sweeps_case.h"

#include <CGAL/PowerRTF/improvement/color_order.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace improvement_case;

namespace {

struct Named_case {
  std::string name;
  std::unique_ptr<Sweeps_case> mesh;
  double least_gain; ///< of the distance, by a fit
};

const std::vector<Named_case>& all()
{
  static const std::vector<Named_case> cases = [] {
    std::vector<Named_case> list;
    const auto add = [&list](const std::string& name, const shapes::Soup& soup, std::size_t n,
                             double least_gain) {
      list.push_back({name, std::make_unique<Sweeps_case>(soup, n), least_gain});
    };
    add("ellipsoid", shapes::ellipsoid(1, 0.7, 0.4, 4), 2000, 1.5);
    add("cylinder with borders", shapes::open_cylinder(40, 10, .5, 2), 400, 1.1);
    add("few vertices", shapes::icosphere(2), 12, 1);
    return list;
  }();
  return cases;
}

// The colors of the stars' vertices, which had `colors`. Those in the order of each color are
// checked to be all of it.
std::vector<int> recolored(const internal::Flat_stars& stars, std::vector<int> colors,
                           internal::Concurrency concurrency)
{
  const internal::Color_order order = internal::color_order(stars, colors, concurrency);
  std::vector<int> result(stars.size(), internal::Color_vertices::none);
  for (std::size_t color = 0; color + 1 < order.first.size(); ++color)
    for (int k = order.first[color]; k < order.first[color + 1]; ++k) {
      CHECK(result[order.vertices[k]] == internal::Color_vertices::none);
      result[order.vertices[k]] = int(color);
    }
  CHECK(result == colors);
  return result;
}

} // namespace

TEST_CASE("vertices of one color are no neighbors, and most keep theirs when edges are flipped")
{
  for (const auto& [name, c, least_gain] : all()) {
    CAPTURE(name);
    internal::Star_mesh mesh = c->mesh();
    std::vector<int> colors(mesh.size(), internal::Color_vertices::none);
    for (int pass = 0; pass < 3; ++pass) {
      const internal::Flat_stars stars = flat_stars(mesh);
      const std::vector<int> before = colors,
                             sequential = recolored(stars, before, CGAL::Sequential_tag());
      colors = recolored(stars, before, CGAL::Parallel_if_available_tag());
      CHECK(colors == sequential);
      int kept = 0;
      for (int v = 0; v < stars.size(); ++v) {
        CHECK((colors[v] >= 0) == bool(stars.kinds[v] & internal::is_movable_kind));
        for (int k = stars.first[v]; k < stars.first[v + 1]; ++k)
          CHECK(colors[stars.neighbors[k]] != colors[v]);
        kept += colors[v] == before[v];
      }
      if (pass > 0) CHECK(kept > 0.8 * stars.size());
      int e = 0;
      for (const auto edge : mesh.working().mesh.edges())
        if (++e % (19 + pass) == 0 && mesh.is_free(edge) && mesh.working().is_flippable(edge))
          mesh.flip(edge);
    }
  }
}

TEST_CASE("a sweep smooths one vertex after the other, whatever the number of threads")
{
  constexpr int steps = 3;
  for (const auto& [name, mesh, least_gain] : all()) {
    CAPTURE(name);
    const Sweeps_case& c = *mesh;
    internal::Star_mesh one_by_one = c.mesh();
    const internal::Flat_stars stars = flat_stars(one_by_one);
    const internal::Color_order order = internal::color_order(stars, CGAL::Sequential_tag());
    for (int step = 0; step < steps; ++step)
      for (int k = 0; k < order.first.back(); ++k)
        smooth_vertex(one_by_one, internal::Star_mesh::Vertex(order.vertices[k]));
    const auto sequential = c.smoothed(*c.host_sweeps(CGAL::Sequential_tag()), steps),
               parallel = c.smoothed(*c.host_sweeps(CGAL::Parallel_if_available_tag()), steps);
    CHECK(sequential.points == parallel.points);
    CHECK(sequential.normals == parallel.normals);
    CHECK(sequential.facets == parallel.facets);
    CHECK(distances(flat_stars(one_by_one), sequential).back() < 1e-9 * c.spacing());
    CHECK((order.first.back() == 0 || sequential.points != stars.points));
  }
}

TEST_CASE("the faces that are nearest to the surface's vertices are those of a search of all")
{
  struct Mesh {
    std::string name;
    Sweeps_case mesh;
    bool has_sheets; // which a face that is nearer does not belong to
  };
  const Mesh meshes[] = {{"ellipsoid", {shapes::ellipsoid(1, 0.7, 0.4, 3), 500}, false},
                         {"two sheets", {shapes::shell(3, 0.05), 100}, true},
                         {"borders", {shapes::open_cylinder(40, 10, .5, 2), 400}, false},
                         {"few vertices", {shapes::icosphere(2), 12}, false}};
  for (const auto& [name, c, has_sheets] : meshes) {
    CAPTURE(name);
    const auto nearest = c.nearest_faces(*c.host_sweeps(CGAL::Sequential_tag()));
    REQUIRE(int(nearest.size()) == c.vertices_of_surface());
    CHECK(nearest == c.nearest_faces(*c.host_sweeps(CGAL::Parallel_if_available_tag())));
    const double rounding = 1e-12 * c.spacing();
    int on_other_sheet = 0;
    std::vector<double> least(nearest.size(), std::numeric_limits<double>::infinity());
    for (int v = 0; v < int(nearest.size()); ++v) {
      double least_of_any = least[v];
      for (int f = 0; f < c.faces(); ++f) {
        least[v] = std::min(least[v], c.distance(v, f));
        least_of_any = std::min(least_of_any, c.distance(v, f, true));
      }
      on_other_sheet += least_of_any < 0.9 * least[v];
      CHECK((nearest[v] < 0) == (least[v] == std::numeric_limits<double>::infinity()));
      if (nearest[v] >= 0) CHECK(c.distance(v, nearest[v]) <= least[v] + rounding);
    }
    CHECK((on_other_sheet > 0) == has_sheets);
    const internal::Distance_tracker tracker = c.tracker(nearest), without = c.tracker({});
    for (int i = 0; i < tracker.size(); ++i) {
      const int v = tracker[i].vertex;
      CHECK(tracker[i].distance <= without[i].distance + rounding);
      if (nearest[v] >= 0) CHECK(tracker[i].distance <= least[v] + rounding);
    }
  }
}

TEST_CASE("a fit is the same for any number of threads, and brings the mesh nearer to the surface")
{
  for (const auto& [name, mesh, least_gain] : all()) {
    CAPTURE(name);
    double gain = 0, same_gain = 0;
    const auto sequential = mesh->fitted(*mesh->host_sweeps(CGAL::Sequential_tag()), gain),
               parallel =
                   mesh->fitted(*mesh->host_sweeps(CGAL::Parallel_if_available_tag()), same_gain);
    CHECK(sequential.points == parallel.points);
    CHECK(sequential.normals == parallel.normals);
    CHECK(same_gain == gain);
    CHECK(gain > least_gain);
  }
}
