// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Rounder triangles on average, for a mesh with creases. The lattice has no room between them, and
// round stars, which smoothing aims for, are not the best triangles there. So edges are flipped,
// and vertices search their tangent planes or slide along their curves, where that lowers the sum
// over the triangles of 1 - Q and, so that no triangle pays for others, of their badness.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_ROUND_MESH_H
#define CGAL_POWER_RTF_IMPROVEMENT_ROUND_MESH_H

#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/better_flips.h>
#include <CGAL/PowerRTF/improvement/flat_stars.h>
#include <CGAL/PowerRTF/improvement/slide_features.h>
#include <CGAL/PowerRTF/improvement/tangent_search.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Of a triangle: 1 - Q, Q as in triangle_quality.h, and the badness that is not tolerated; 0:
/// equilateral.
struct Unroundness {
  double badness_weight;

  double operator()(const Vec3d& a, const Vec3d& b, const Vec3d& c) const
  {
    const double l0 = length(b - a), l1 = length(c - b), l2 = length(a - c),
                 twice_area = length(cross(b - a, c - a));
    if (!(twice_area > 0)) return std::numeric_limits<double>::infinity();
    const double q = 3.4641016151377544 * twice_area / ((l0 + l1 + l2) * std::max({l0, l1, l2}));
    const double excess =
        triangle_badness(a, b, c).badness - Improvement_parameters::Rounding::tolerated_badness;
    return 1 - q + badness_weight * std::max(0., excess);
  }
};

class Mesh_rounder {
public:
  using Vertex = Star_mesh::Vertex;
  using Edge = Star_mesh::Edge;
  using Face = Working_mesh::Face;

  Mesh_rounder(Star_mesh& mesh, Feature_slider& slider, double badness_weight)
      : m(mesh), m_slider(slider), m_unroundness{badness_weight}
  {}

  void run(int rounds)
  {
    for (int round = 0; round < rounds; ++round) {
      flip();
      const double turn = round; // radians: other directions in each
      for_each_movable(m, [&](Vertex v) { search(v, Parameters::first_step, turn); });
      for (const Vertex v : m.working().mesh.vertices()) m_slider.slide(v, m_unroundness);
    }
  }

  /// The same for these vertices alone. `first_step`: in the mean edge of a star.
  void move(const std::vector<Vertex>& vertices, double first_step)
  {
    for (const Vertex v : vertices)
      m.is_movable(v) ? search(v, first_step, 0) : m_slider.slide(v, m_unroundness);
  }

  /// The same for the edges at these vertices.
  void flip_at(const std::vector<Vertex>& vertices)
  {
    std::vector<Edge> edges;
    const auto& mesh = m.working().mesh;
    for (const Vertex v : vertices)
      for (const auto h : halfedges_around_target(v, mesh)) edges.push_back(mesh.edge(h));
    sort_uniquely(edges);
    for (const Edge e : edges)
      if (is_better_flipped(e)) m.flip(e);
  }

  double unroundness(Face f) const
  {
    const auto [a, b, c] = m.points(m.working().mesh.halfedge(f));
    return m_unroundness(a, b, c);
  }

  /// The faces at some vertices: the sum and the most of their unroundness.
  struct Patch {
    double sum = 0, most = 0;
  };

  /// Its sum ends once it is more than `limit`.
  Patch patch(const std::vector<Vertex>& vertices,
              double limit = std::numeric_limits<double>::infinity()) const
  {
    Patch result;
    for (const Face f : m.working().faces_at(vertices)) {
      const double x = unroundness(f);
      result.sum += x;
      result.most = std::max(result.most, x);
      if (result.sum > limit) break;
    }
    return result;
  }

  std::vector<Star_mesh::Placed_triangle> triangles(const std::vector<Vertex>& vertices) const
  {
    std::vector<Star_mesh::Placed_triangle> result;
    for (const Face f : m.working().faces_at(vertices)) {
      const auto [a, b, c] = m.working().corners(f);
      result.push_back(m.placed(a, b, c));
    }
    return result;
  }

  /// The least agreement, which may take a search for each triangle.
  double agreement(const std::vector<Star_mesh::Placed_triangle>& triangles) const
  {
    double least = 1;
    for (const auto& t : triangles) least = std::min(least, m.agreement(t));
    return least;
  }

private:
  using Parameters = Improvement_parameters::Rounding;

  void flip()
  {
    for (const int e : select(m.concurrency(), int(m.working().mesh.num_edges()),
                              [this](int e) { return is_better_flipped(Edge(e)); })) {
      Cancellation::poll();
      if (is_better_flipped(Edge(e))) m.flip(Edge(e));
    }
  }

  bool is_better_flipped(Edge e) const
  {
    return internal::is_better_flipped(m, e, m_unroundness, 0, Parameters::min_agreement);
  }

  void search(Vertex v, double first_step, double turn)
  {
    const Star star = m.star(v);
    const Vec3d p = m.point(v), n = m.normal(v);
    const double start = star.sum(p, m_unroundness);
    if (start < Parameters::good * double(star.corners.size())) return;
    const double step = first_step * mean_edge(star, p), limit = clearly_less * start;
    double least = start;
    const Vec3d best = search_tangent_plane<Parameters>(
        p, n, step, turn, least,
        [&](const Vec3d& q, double enough) { return star.sum(q, m_unroundness, enough); });
    if (!(least < limit)) return;
    const auto place = m.project(v, best);
    if (place.facet < 0 || !(star.sum(place.point, m_unroundness, limit) < limit)) return;
    if (m.agreement(star, place.point, place.normal) <
        std::min(Parameters::min_agreement, m.agreement(star, p, n)))
      return;
    m.move(v, place);
  }

  Star_mesh& m;
  Feature_slider& m_slider;
  Unroundness m_unroundness;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_ROUND_MESH_H
