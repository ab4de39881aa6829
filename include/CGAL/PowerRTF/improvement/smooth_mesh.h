// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Smoothing of all stars: edges are flipped and vertices moved where that lowers the sum of the
// inverse mean ratios L^2 / (4 sqrt(3) A) of the triangles (1: equilateral). A vertex makes an
// over-relaxed Newton step in its tangent plane and goes back to the surface. (Freitag and Knupp,
// "Tetrahedral mesh improvement via optimization of the element condition number", 2002, for
// triangles.)
#ifndef CGAL_POWER_RTF_IMPROVEMENT_SMOOTH_MESH_H
#define CGAL_POWER_RTF_IMPROVEMENT_SMOOTH_MESH_H

#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/better_flips.h>
#include <CGAL/PowerRTF/improvement/tangent_search.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Mesh_smoother {
public:
  using Vertex = Star_mesh::Vertex;
  using Edge = Star_mesh::Edge;
  using Halfedge = Star_mesh::Halfedge;

  explicit Mesh_smoother(Star_mesh& mesh) : m(mesh) {}

  void run(int passes)
  {
    for (int pass = 0; pass < passes; ++pass) {
      flip();
      sweep();
    }
  }

  /// Flips edges until that does not help any more.
  void flip()
  {
    std::vector<Edge> edges; // that may be worth a flip
    for (const int e : select(m.concurrency(), int(m.working().mesh.num_edges()),
                              [this](int e) { return is_better_flipped(Edge(e)); }))
      edges.push_back(Edge(e));
    for (int pass = 0; pass < Parameters::max_flip_passes && !edges.empty(); ++pass) {
      std::vector<Edge> around;
      for (const Edge e : edges) {
        Cancellation::poll();
        if (!is_better_flipped(e)) continue;
        m.flip(e);
        for (const Halfedge h : {m.working().mesh.halfedge(e, 0), m.working().mesh.halfedge(e, 1)})
          for (const Halfedge side : {m.working().mesh.next(h), m.working().mesh.prev(h)})
            around.push_back(m.working().mesh.edge(side));
      }
      sort_uniquely(around);
      edges.swap(around);
    }
  }

  /// One step of every movable vertex.
  void sweep()
  {
    m.for_each_vertex([this](Vertex v) {
      if (m.is_movable(v)) step(v);
    });
  }

  /// The same for some vertices, one after the other.
  template <class Vertices>
  void sweep(const Vertices& vertices)
  {
    for (const Vertex v : vertices) {
      Cancellation::poll();
      if (m.is_movable(v)) step(v);
    }
  }

  /// Of a triangle: the inverse mean ratio, up to the factor 1 / (2 sqrt(3)).
  static double energy(const Vec3d& a, const Vec3d& b, const Vec3d& c)
  {
    const Vec3d e = b - a, f = c - a;
    const double twice_area = length(cross(e, f));
    if (!(twice_area > 0)) return std::numeric_limits<double>::infinity();
    return (squared_length(e) + squared_length(f) + squared_length(f - e)) / twice_area;
  }

private:
  using Parameters = Improvement_parameters::Smoothing;
  static constexpr double least_energy = 3.4641; // a little less than 2 sqrt(3)

  void step(Vertex v)
  {
    const Star star = m.star(v);
    const Vec3d p = m.point(v), n = m.normal(v);

    // gradient and Hessian in the plane (u, w); areas are linear there but for the curvature
    const auto [u, w] = Tangent_axes(n);
    double now = 0, gu = 0, gw = 0, huu = 0, huw = 0, hww = 0, shortest = -1;
    for (const Star::Corner& c : star.corners) {
      const Vec3d e = c.a - p, f = c.b - p, area = cross(e, f);
      const double a = length(area), ee = squared_length(e), ff = squared_length(f),
                   l = ee + ff + squared_length(f - e);
      if (!(a > 0)) return;
      if (shortest < 0 || ee < shortest) shortest = ee;
      const Vec3d dl = -2 * (e + f), da = cross(e - f, area) * (1 / a);
      const double lu = dot(dl, u), lw = dot(dl, w), au = dot(da, u), aw = dot(da, w), i = 1 / a,
                   i2 = i * i, i3 = 2 * l * i2 * i;
      now += l / a;
      gu += lu * i - l * au * i2;
      gw += lw * i - l * aw * i2;
      huu += 4 * i - 2 * lu * au * i2 + i3 * au * au;
      huw += -(lu * aw + lw * au) * i2 + i3 * au * aw;
      hww += 4 * i - 2 * lw * aw * i2 + i3 * aw * aw;
    }
    const double determinant = huu * hww - huw * huw;
    if (!(determinant > 0) || !(huu > 0)) return;
    const double scale = -Parameters::relaxation / determinant;
    double su = scale * (hww * gu - huw * gw), sw = scale * (huu * gw - huw * gu);
    const double size = std::sqrt(su * su + sw * sw), unit = std::sqrt(shortest),
                 limit = Parameters::max_step * unit;
    if (!(size > Parameters::min_step * unit)) return;
    if (size > limit) su *= limit / size, sw *= limit / size;

    for (int halving = 0; halving < 3; ++halving, su /= 2, sw /= 2) {
      const auto place = m.project(v, p + su * u + sw * w);
      if (place.facet < 0 || !(energy(star, place.point) < now)) continue;
      const double agreement = m.agreement(star, place.point, place.normal);
      if (agreement < Parameters::min_agreement && agreement < m.agreement(star, p, n)) continue;
      m.move(v, place);
      return;
    }
  }

  static double energy(const Star& star, const Vec3d& p)
  {
    double sum = 0;
    for (const Star::Corner& c : star.corners) sum += energy(p, c.a, c.b);
    return sum;
  }

  bool is_better_flipped(Edge e) const
  {
    return internal::is_better_flipped(
        m, e, [](const Vec3d& a, const Vec3d& b, const Vec3d& c) { return energy(a, b, c); },
        least_energy, Parameters::min_agreement);
  }

  Star_mesh& m;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_SMOOTH_MESH_H
