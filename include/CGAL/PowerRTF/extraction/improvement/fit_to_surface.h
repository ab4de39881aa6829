// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves the vertices along their normals so that the mesh lies on both sides of the surface: least
// squares of the distances, seen from the mesh (at a quadrature of each triangle) and from the
// surface (at its vertices). On a curved part vertices on the surface leave all triangles on one
// side of it; this halves the mean distance.
#ifndef CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_FIT_TO_SURFACE_H
#define CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_FIT_TO_SURFACE_H

#include <CGAL/PowerRTF/extraction/improvement/Star_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstdio>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

class Surface_fitter
{
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Face = Working_mesh::Mesh::Face_index;

  explicit Surface_fitter(Star_mesh& mesh) : m(mesh) {}

  void run()
  {
    m_limit.assign(m.size(), 0);
    collect();
    const int rounds = getenv("IRLS") ? atoi(getenv("IRLS")) : 1;
    m_move.assign(m.size(), 0);
    double before = 0, after = 0; if (getenv("DBG")) dump("before");
    for (const Row& r : m_rows) before = std::max(before, std::abs(r.residual));
    for (int round = 0; round < rounds; ++round) {
      if (round > 0) reweight();
      solve();
    }
    for (const Row& r : m_rows) after = std::max(after, std::abs(left(r)));
    if (getenv("DBG")) std::fprintf(stderr, "rows %zu max %g -> %g\n", m_rows.size(), before, after);
    apply();
    if (getenv("DBG")) { dump("after"); m_rows.clear(); collect(); std::fill(m_move.begin(), m_move.end(), 0); dump("again"); }
  }

private:
  void dump(const char* name) {
    double s[2]={0,0}, w[2]={0,0}; for (std::size_t i=0;i<m_rows.size();++i) { int k=i>=m_first; s[k]+=m_rows[i].weight*std::abs(left(m_rows[i])); w[k]+=m_rows[i].weight; }
    std::fprintf(stderr, "%s mesh %.5f surface %.5f (w %.3f %.3f)\n", name, 1e3*s[0]/w[0], 1e3*s[1]/w[1], w[0], w[1]); }
  std::size_t m_first=0;
  struct Row { // residual - sum of coefficients times moves is what is left
    std::array<int, 3> vertices;
    std::array<double, 3> coefficients;
    double residual, weight, scale;
  };

  double left(const Row& r) const
  {
    double x = r.residual;
    for (int k = 0; k < 3; ++k) x -= r.coefficients[k] * m_move[r.vertices[k]];
    return x;
  }

  void add(const Triangle& t, const std::array<double, 3>& barycentric, const Vec3d& direction,
           double residual, double weight)
  {
    Row r{t, {}, residual, weight, 1};
    for (const int v : t) m_limit[v] = std::max(m_limit[v], std::abs(residual));
    for (int k = 0; k < 3; ++k)
      r.coefficients[k] =
          barycentric[k] * dot(direction, m.normal(Vertex(Vertex::size_type(t[k]))));
    m_rows.push_back(r);
  }

  void collect()
  {
    const auto& mesh = m.working().mesh;
    std::vector<Vec3d> points(m.size());
    for (std::size_t v = 0; v < m.size(); ++v) points[v] = m.point(Vertex(Vertex::size_type(v)));
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.number_of_faces());
    double area = 0;
    for (const Face f : mesh.faces()) {
      const Halfedge h = mesh.halfedge(f);
      const Triangle t{int(mesh.source(h)), int(mesh.target(h)), int(mesh.target(mesh.next(h)))};
      triangles.push_back(t);
      area += length(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]])) / 2;
    }
    see_from_mesh(points, triangles, (getenv("MW")?atof(getenv("MW")):1) / area);
    m_first = m_rows.size();
    see_from_surface(points, triangles);
  }

  // A rule that is exact for cubics: the corners, the middles of the edges, the centroid.
  void see_from_mesh(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles, double scale)
  {
    const auto look = [&](const Triangle& t, const std::array<double, 3>& b, double weight) {
      Vec3d q{0, 0, 0}, n{0, 0, 0};
      int first = 0;
      for (int k = 0; k < 3; ++k) {
        q += b[k] * points[t[k]];
        n += b[k] * m.normal(Vertex(Vertex::size_type(t[k])));
        if (b[k] > b[first]) first = k;
      }
      n = normalized(n);
      const auto place = m.guide().project(q, n, m.facet(Vertex(Vertex::size_type(t[first]))));
      if (place.facet < 0) return;
      const Vec3d r = place.point - q;
      const double d = length(r);
      const Vec3d direction = d > 0 ? r * (1 / d) : n;
      add(t, b, direction, d, weight);
    };
    const auto& mesh = m.working().mesh;
    for (const auto e : mesh.edges()) {
      const Halfedge h = mesh.halfedge(e);
      double a = 0;
      for (const Halfedge g : {h, mesh.opposite(h)})
        if (!mesh.is_border(g)) a += length(m.working().area_vector(mesh.source(g), mesh.target(g), mesh.target(mesh.next(g)))) / 2;
      const Halfedge g = mesh.is_border(h) ? mesh.opposite(h) : h;
      look({int(mesh.source(g)), int(mesh.target(g)), int(mesh.target(mesh.next(g)))}, {.5, .5, 0}, a * scale * 2 / 15);
    }
    for (const Triangle& t : triangles) {
      const double a = length(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]])) / 2;
      look(t, {1 / 3., 1 / 3., 1 / 3.}, a * scale * 9 / 20);
      for (int k = 0; k < 3; ++k) {
        std::array<double, 3> b{0, 0, 0};
        b[k] = 1;
        add(t, b, m.normal(Vertex(Vertex::size_type(t[k]))), -m.height(Vertex(Vertex::size_type(t[k]))), a * scale / 20);
      }
    }
  }

  void see_from_surface(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles)
  {
    const Surface& surface = m.guide().surface();
    const Facet_tree tree(points, triangles);
    std::vector<double> areas(surface.points.size(), 0);
    for (std::size_t f = 0; f < surface.triangles.size(); ++f)
      for (const int v : surface.triangles[f]) areas[v] += surface.facet_areas[f] / 3;
    int hint = -1;
    for (std::size_t v = 0; v < surface.points.size(); ++v) {
      const Vec3d& x = surface.points[v];
      const auto y = nearest_facet(tree.view(), x, surface.vertex_normals[v], -0.35, hint);
      if (y.facet < 0) continue;
      hint = y.facet;
      const Triangle& t = triangles[y.facet];
      double beta, gamma;
      barycentric_coordinates(y.point, points[t[0]], points[t[1]], points[t[2]], beta, gamma);
      const Vec3d r = x - y.point;
      const double d = length(r);
      if (!(d > 0)) continue;
      add(t, {1 - beta - gamma, beta, gamma}, r * (1 / d), d, areas[v] / surface.area);
    }
  }

  void reweight()
  {
    double sum = 0, weights = 0;
    for (const Row& r : m_rows) {
      sum += r.weight * std::abs(left(r));
      weights += r.weight;
    }
    const double mean = sum / weights;
    static const double A = getenv("WA") ? atof(getenv("WA")) : .5, B = getenv("WB") ? atof(getenv("WB")) : 10;
    for (Row& r : m_rows) {
      const double x = std::abs(left(r)) / mean, y = x / B;
      r.scale = 1 / std::max(x, A) + y * y;
    }
  }

  // Gauss-Seidel sweeps on the normal equations, whose matrix is like a mass matrix.
  void solve()
  {
    const auto& mesh = m.working().mesh;
    std::vector<double> diagonal(m.size(), 0), right(m.size(), 0);
    // matrix as lists by vertex
    std::vector<std::array<int, 2>> dummy;
    std::vector<double> off(mesh.number_of_halfedges(), 0);
    const auto edge = [&](int a, int b) {
      for (const Halfedge h : halfedges_around_target(Vertex(Vertex::size_type(a)), mesh))
        if (int(mesh.source(h)) == b) return int(mesh.edge(h));
      return -1;
    };
    for (const Row& r : m_rows) {
      for (int k = 0; k < 3; ++k) {
        const int v = r.vertices[k], w = r.vertices[(k + 1) % 3];
        diagonal[v] += r.scale * r.weight * r.coefficients[k] * r.coefficients[k];
        right[v] += r.scale * r.weight * r.coefficients[k] * r.residual;
        const double c = r.scale * r.weight * r.coefficients[k] * r.coefficients[(k + 1) % 3];
        if (c != 0) off[edge(v, w)] += c;
      }
    }
    for (int sweep = 0; sweep < 8; ++sweep)
      for (const Vertex v : mesh.vertices()) {
        if (!m.is_movable(v) || !(diagonal[v] > 0)) continue;
        double x = right[v];
        for (const Halfedge h : halfedges_around_target(v, mesh))
          x -= off[mesh.edge(h)] * m_move[mesh.source(h)];
        m_move[v] = x / diagonal[v];
      }
  }

  void apply()
  {
    for (const Vertex v : m.working().mesh.vertices())
      if (m.is_movable(v)) m.raise(v, std::max(-m_limit[v], std::min(m_limit[v], m_move[v])));
  }

  Star_mesh& m;
  std::vector<Row> m_rows;
  std::vector<double> m_move, m_limit; // by vertex, along its normal
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_FIT_TO_SURFACE_H
