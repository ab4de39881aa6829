// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faces and edges that are found from the stars of a mesh, against those of the mesh.
#include "../sweeps_case.h"

#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/smoothing/Fit_arrays.h>
#include <CGAL/PowerRTF/smoothing/Star_arrays.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

using namespace improvement_case;

namespace {

using Backend = Host_backend<CGAL::Parallel_if_available_tag>;

Triangle rotated(Triangle t)
{
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

bool has_edge(const Triangle& t, int from, int to)
{
  for (int k = 0; k < 3; ++k)
    if (t[k] == from && t[(k + 1) % 3] == to) return true;
  return false;
}

struct Case_with_stars {
  Sweeps_case c;
  internal::Flat_stars flat;
  Backend backend;
  internal::Star_arrays<Backend> stars;
  internal::Fit_arrays<Backend> arrays;
  internal::Fit_equations equations;
  internal::Flat_fit fit;

  explicit Case_with_stars(const shapes::Soup& soup, std::size_t n, double share_pinned)
      : c(soup, n)
  {
    internal::Star_mesh mesh = c.mesh();
    for (int v = 0; v < int(mesh.size() * share_pinned); ++v)
      if (mesh.is_movable(internal::Star_mesh::Vertex(v))) mesh.pin(internal::Star_mesh::Vertex(v));
    flat = flat_stars(mesh);
    REQUIRE(stars.upload(backend, flat));
    const internal::Distance_tracker tracker(
        mesh,
        internal::tracked_points(c.surface(), mesh.projector().tree(), n, mesh.concurrency()));
    const Flat_patches flat_patches(c.surface());
    fit = flat_fit(mesh, tracker, flat_patches, 0.3);
    internal::Star_view view = stars.view();
    view.surface = mesh.projector().descent();
    REQUIRE(arrays.make(backend, view, flat.first.back(), fit, equations));
  }
  bool is_movable(int v) const { return flat.kinds[v] & internal::is_movable_kind; }
  Triangle corners(int f) const
  {
    const int* const t = equations.corners + 3 * f;
    return {t[0], t[1], t[2]};
  }
  // From a vertex of the surface to a face, if their normals agree; else infinite.
  double distance(int vertex, int f) const
  {
    const Triangle t = corners(f);
    const Vec3d &a = flat.points[t[0]], &b = flat.points[t[1]], &d = flat.points[t[2]],
                &x = c.surface().points[vertex];
    if (!internal::agrees(c.surface().vertex_normals[vertex], a, b, d))
      return std::numeric_limits<double>::infinity();
    return length(nearest_point_on_triangle(x, a, b, d) - x);
  }
};

void check(const shapes::Soup& soup, std::size_t n, double share_pinned)
{
  CAPTURE(n);
  CAPTURE(share_pinned);
  const Case_with_stars c(soup, n, share_pinned);
  std::set<Triangle> faces, expected_faces;
  std::set<Edge> edges, expected_edges;
  const auto& mesh = c.c.mesh().working();
  for (const auto f : mesh.mesh.faces()) {
    const auto [a, b, d] = mesh.corners(f);
    const Triangle t{int(a), int(b), int(d)};
    const auto movable = [&](int v) { return c.is_movable(v); };
    if (std::any_of(t.begin(), t.end(), movable)) expected_faces.insert(rotated(t));
    for (int k = 0; k < 3; ++k)
      if (movable(t[k]) || movable(t[(k + 1) % 3]))
        expected_edges.insert(sorted_edge(t[k], t[(k + 1) % 3]));
  }
  const int number_of_faces = c.arrays.mesh.number_of_faces(),
            number_of_edges = c.arrays.mesh.number_of_edges();
  for (int f = 0; f < number_of_faces; ++f) faces.insert(rotated(c.corners(f)));
  CHECK(faces == expected_faces);
  CHECK(int(faces.size()) == number_of_faces);
  for (int e = 0; e < number_of_edges; ++e) {
    const internal::Mesh_edge& edge = c.equations.edges[e];
    edges.insert(sorted_edge(edge.source, edge.target));
    CHECK(has_edge(c.corners(edge.left), edge.source, edge.target));
    CHECK(has_edge(c.corners(edge.right), edge.target, edge.source));
  }
  CHECK(edges == expected_edges);
  CHECK(int(edges.size()) == number_of_edges);
  for (int v = 0; v < c.flat.size(); ++v)
    for (int k = c.flat.first[v]; k < c.flat.first[v + 1]; ++k) {
      const int u = c.flat.neighbors[k];
      const internal::Mesh_edge& edge = c.equations.edges[c.equations.spoke_edges[k]];
      CHECK(sorted_edge(edge.source, edge.target) == sorted_edge(u, v));
      CHECK(has_edge(c.corners(c.equations.spoke_faces[k]), u, v));
    }

  // Of each vertex of the surface: the distance of the nearest face, of those there are and agree.
  std::vector<double> least(c.c.vertices_of_surface(), std::numeric_limits<double>::infinity());
  std::vector<int> is_tracked(least.size(), 0);
  for (const internal::Tracked_vertex& w : c.fit.tracked)
    for (int f = 0; f < number_of_faces && w.near >= 0; ++f)
      least[w.vertex] = std::min(least[w.vertex], c.distance(w.vertex, f));
  int nearest = 0, tracked = 0;
  for (int f = 0; f < number_of_faces; ++f)
    for (int k = c.equations.first_tracked[f]; k < c.equations.first_tracked[f + 1]; ++k) {
      const internal::Tracked_place& w = c.equations.tracked[k];
      const double rounding = 1e-12 * c.c.spacing(), d = c.distance(w.vertex, f);
      CHECK(std::fabs(w.distance - d) <= rounding);
      CHECK(std::fabs(length(w.nearest - c.c.surface().points[w.vertex]) - d) <= rounding);
      ++is_tracked[w.vertex];
      ++tracked;
      nearest += d <= least[w.vertex] + rounding;
    }
  CHECK(nearest >= 0.97 * tracked);
  for (const internal::Tracked_vertex& w : c.fit.tracked)
    CHECK(is_tracked[w.vertex] == (w.near >= 0 ? 1 : 0));
}

} // namespace

TEST_CASE(
    "stars tell of all faces and edges with a vertex that may move, and what is tracked there")
{
  for (const double share_pinned : {0., 0.5, 0.95, 1.}) {
    check(shapes::ellipsoid(1, 0.7, 0.4, 4), 1000, share_pinned);
    check(shapes::open_cylinder(40, 10, .5, 2), 400, share_pinned);
    check(shapes::icosphere(2), 12, share_pinned);
    check(shapes::tetrahedron(), 4, share_pinned);
  }
}
