// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves the vertices, off the surface too, so that the triangles come near to it: least squares of
// the distances, at a quadrature of each triangle, to the points of the surface that are nearest
// now, and of those from the surface's vertices to the mesh, that also see its tips. With all
// vertices on the surface, a curved part has all triangles on one side of it: to move along the
// normals halves the mean distance. Where the normals vary, on ridges and tips, the vertices are
// also drawn sideways to where they are needed (quadrics: Garland and Heckbert, "Surface
// simplification using quadric error metrics", 1997).
#ifndef CGAL_POWER_RTF_IMPROVEMENT_FIT_TO_SURFACE_H
#define CGAL_POWER_RTF_IMPROVEMENT_FIT_TO_SURFACE_H

#include <CGAL/PowerRTF/features/flat_patches.h>
#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/triangle_badness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A symmetric matrix of size 3.
struct Symmetric_matrix {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  /// Adds w d d^T.
  void add(const Vec3d& d, double w)
  {
    xx += w * d.x * d.x, xy += w * d.x * d.y, xz += w * d.x * d.z;
    yy += w * d.y * d.y, yz += w * d.y * d.z, zz += w * d.z * d.z;
  }
  void add_identity(double w) { xx += w, yy += w, zz += w; }

  Vec3d operator*(const Vec3d& v) const
  {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z};
  }

  /// The x with A x = r; 0 if A is not positive definite.
  Vec3d solve(const Vec3d& r) const
  {
    const Vec3d a{xx, xy, xz}, b{xy, yy, yz}, c{xz, yz, zz}, bc = cross(b, c);
    const double determinant = dot(a, bc);
    if (!(determinant > 0)) return {0, 0, 0};
    return Vec3d{dot(r, bc), dot(r, cross(c, a)), dot(r, cross(a, b))} * (1 / determinant);
  }
};

class Surface_fitter {
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;

  /// `flat`: of the surface. `limit`: the badness that a move may bring upon a triangle that was
  /// better.
  Surface_fitter(Star_mesh& mesh, const Distance_tracker& tracker, const Flat_patches& flat,
                 double limit)
      : m(mesh), m_tracker(tracker), m_flat(flat), m_badness_limit(limit),
        m_spacing(std::sqrt(mesh.projector().surface().area / double(mesh.size()))),
        m_tangential_weight(is_even(mesh.projector().surface()) ? Parameters::even_tangential_weight
                                                                : Parameters::tangential_weight),
        m_unknowns(mesh.size()), m_coupling(mesh.working().mesh.number_of_edges())
  {}

  void run()
  {
    measure();
    solve();
    for (const Vertex v : m.working().mesh.vertices())
      if (m.is_movable(v)) move(v);
  }

private:
  using Edges = std::array<Halfedge, 3>;     // of a face
  using Barycentric = std::array<double, 3>; // of the sources of its edges

  struct Unknown {
    Symmetric_matrix matrix;
    Vec3d right{0, 0, 0}, move{0, 0, 0};
    double weight = 0, longest = 0;
    double around = 0, level = 0; // area of the star, and of what is in the plane of the vertex

    bool is_flat() const { return level > Parameters::flat_share * around; }
  };

  using Parameters = Improvement_parameters::Fitting;

  static bool is_even(const Surface& surface)
  {
    const auto& density = surface.vertex_density;
    return std::equal(density.begin() + 1, density.end(), density.begin());
  }

  void measure()
  {
    const auto& mesh = m.working().mesh;
    for (const auto f : mesh.faces()) measure_face(mesh.halfedge(f));
    const double density =
        std::min(1., double(m_tracker.size()) / (Parameters::fully_tracked * double(m.size())));
    const double share = Parameters::tracked_weight * density * density;
    for (int i = 0; i < m_tracker.size(); ++i) {
      const auto& w = m_tracker[i];
      const Edges edges{w.face, mesh.next(w.face), mesh.prev(w.face)};
      const Vec3d direction = w.distance > 0 ? (w.point - w.nearest) * (1 / w.distance) : w.normal;
      add(edges, w.barycentric, direction, w.distance, share * w.weight);
    }
    for (const Vertex v : mesh.vertices()) {
      Unknown& u = m_unknowns[v];
      u.matrix.add_identity(m_tangential_weight * u.weight);
      u.matrix.add(normal(v),
                   ((u.is_flat() ? Parameters::flat_normal_weight : Parameters::normal_weight) -
                    m_tangential_weight) *
                       u.weight);
    }
  }

  // A rule that is exact for cubics: the corners, the middles of the edges, the centroid.
  void measure_face(Halfedge first)
  {
    const auto& mesh = m.working().mesh;
    const Edges edges{first, mesh.next(first), mesh.prev(first)};
    const double a = area(first);
    add_point(edges, {1 / 3., 1 / 3., 1 / 3.}, a * 9 / 20);
    for (int k = 0; k < 3; ++k) {
      Barycentric corner{0, 0, 0}, middle{.5, .5, .5};
      corner[k] = 1;
      middle[(k + 2) % 3] = 0;
      const Vertex v = mesh.source(edges[k]);
      if (m.is_movable(v)) add(edges, corner, m.normal(v), -m.height(v), a / 20);
      const Halfedge o = mesh.opposite(edges[k]);
      if (mesh.is_border(o))
        add_point(edges, middle, a * 2 / 15);
      else if (edges[k] < o)
        add_point(edges, middle, (a + area(o)) * 2 / 15);
    }
  }

  double area(Halfedge h) const
  {
    const auto [a, b, c] = m.working().corners(h);
    return length(m.working().area_vector(a, b, c)) / 2;
  }

  // A point of the mesh, where the surface is now. `edges`: of its face. Corners on features belong
  // to several patches: they do not say on which of them the face lies.
  void add_point(const Edges& edges, const Barycentric& barycentric, double weight)
  {
    const auto& mesh = m.working().mesh;
    Vec3d p{0, 0, 0}, n{0, 0, 0};
    int nearest = -1;
    for (int k = 0; k < 3; ++k) {
      const Vertex v = mesh.source(edges[k]);
      p += barycentric[k] * m.point(v);
      if (m.is_on_feature(v)) continue;
      n += barycentric[k] * m.normal(v);
      if (nearest < 0 || barycentric[k] > barycentric[nearest]) nearest = k;
    }
    if (nearest < 0) return; // no corner can move
    const Vertex guide = mesh.source(edges[nearest]);
    n = squared_length(n) > 0 ? normalized(n) : m.normal(guide); // the middle of a feature edge
    const auto place = m.projector().project(p, n, near_facet(mesh.face(edges[0]), p, n, guide));
    if (place.facet < 0) return;
    for (int k = 0; k < 3; ++k)
      if (barycentric[k] > 0) note_level(mesh.source(edges[k]), place, weight);
    const double distance = length(place.point - p);
    add(edges, barycentric, distance > 0 ? (place.point - p) * (1 / distance) : n, distance,
        weight);
  }

  // Whether a place of the surface is in the plane of the facet that carries `v`.
  void note_level(Vertex v, const Surface_projector::Place& place, double weight)
  {
    const auto& normals = m.projector().surface().facet_normals;
    const Vec3d &n = normals[m.facet(v)], offset = place.point - m.point(v);
    const double height = dot(offset, n);
    Unknown& u = m_unknowns[v];
    u.around += weight;
    if (m_flat.width(m.facet(v)) > Parameters::flat_width * m_spacing &&
        dot(normals[place.facet], n) > Parameters::coplanar_cosine &&
        height * height < (1 - Parameters::coplanar_cosine) * squared_length(offset))
      u.level += weight;
  }

  // Of the surface at `v`, as it is there.
  Vec3d normal(Vertex v) const
  {
    return m_unknowns[v].is_flat() ? m.projector().surface().facet_normals[m.facet(v)]
                                   : m.normal(v);
  }

  // A facet near the point `p` of a face: that of `guide`, or of a point that is tracked there, on
  // the same patch, if it is nearer.
  int near_facet(Working_mesh::Face f, const Vec3d& p, const Vec3d& n, Vertex guide) const
  {
    int facet = m.facet(guide);
    double least = squared_length(m.point(guide) - p);
    for (const int i : m_tracker.at_face(f)) {
      const auto& w = m_tracker[i];
      const double d = squared_length(w.point - p);
      if (!(d < least) || !(dot(w.normal, n) > Parameters::sheet_cosine) ||
          !m.projector().are_on_one_patch(w.facet, m.facet(guide)))
        continue;
      facet = w.facet;
      least = d;
    }
    return facet;
  }

  // A point with these barycentric coordinates is to move by `distance` along `direction`.
  void add(const Edges& edges, const Barycentric& barycentric, const Vec3d& direction,
           double distance, double weight)
  {
    const auto& mesh = m.working().mesh;
    for (int k = 0; k < 3; ++k) {
      const double b = barycentric[k], c = barycentric[(k + 1) % 3];
      if (!(b > 0)) continue;
      Unknown& u = m_unknowns[mesh.source(edges[k])];
      u.matrix.add(direction, weight * b * b);
      u.right += (weight * b * distance) * direction;
      u.weight += weight * b * b;
      if (b > 0.1) u.longest = std::max(u.longest, std::abs(distance));
      if (c > 0) m_coupling[mesh.edge(edges[k])].add(direction, weight * b * c);
    }
  }

  void solve()
  {
    const auto& mesh = m.working().mesh;
    for (int sweep = 0; sweep < Parameters::sweeps; ++sweep)
      for (const Vertex v : mesh.vertices()) {
        if (!m.is_movable(v)) continue;
        Unknown& u = m_unknowns[v];
        Vec3d right = u.right;
        for (const Halfedge h : halfedges_around_target(v, mesh))
          right -= m_coupling[mesh.edge(h)] * m_unknowns[mesh.source(h)].move;
        u.move = u.matrix.solve(right);
        const double l = length(u.move);
        if (l > u.longest) u.move *= u.longest / l;
      }
  }

  void move(Vertex v)
  {
    const Unknown& u = m_unknowns[v];
    const Vec3d n = u.is_flat() ? normal(v) : Vec3d{0, 0, 0};
    const Vec3d p = m.point(v), q = p + u.move - dot(u.move, n) * n;
    for (const Star::Corner& c : m.star(v).corners) {
      const Vec3d before = cross(c.a - p, c.b - p), after = cross(c.a - q, c.b - q);
      if (!(dot(before, after) > Parameters::max_turn_cosine * length(before) * length(after)))
        return;
      const double badness = triangle_badness(q, c.a, c.b).badness;
      if (badness > m_badness_limit && badness > triangle_badness(p, c.a, c.b).badness) return;
    }
    m.move_off(v, q);
  }

  Star_mesh& m;
  const Distance_tracker& m_tracker;
  const Flat_patches& m_flat;
  double m_badness_limit, m_spacing, m_tangential_weight;
  // the normal equations, and their solution
  std::vector<Unknown> m_unknowns;          // by vertex
  std::vector<Symmetric_matrix> m_coupling; // by edge
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_FIT_TO_SURFACE_H
