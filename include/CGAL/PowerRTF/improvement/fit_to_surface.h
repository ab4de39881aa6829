// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves the vertices, off the surface too, so that the triangles come near to it: least squares of
// the distances, at a quadrature of each triangle, to the points of the surface that are nearest
// now, and of those from the surface's vertices to the mesh, that also see its tips. With all
// vertices on the surface, a curved part has all triangles on one side of it: to move along the
// normals halves the mean distance. Where the normals vary, on ridges and tips, the vertices are
// also drawn sideways to where they are needed (quadrics: Garland and Heckbert, "Surface
// simplification using quadric error metrics", 1997). What is kept of each vertex, edge and face is
// in single precision: these are moves and distances, small beside the triangles.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_FIT_TO_SURFACE_H
#define CGAL_POWER_RTF_IMPROVEMENT_FIT_TO_SURFACE_H

#include <CGAL/PowerRTF/features/flat_patches.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/triangle_badness.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace CGAL::PowerRTF::internal {

/// A symmetric matrix of size 3.
template <class FT>
struct Symmetric_matrix {
  FT xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;

  /// Adds w d d^T.
  void add(const Vec3<FT>& d, FT w)
  {
    xx += w * d.x * d.x, xy += w * d.x * d.y, xz += w * d.x * d.z;
    yy += w * d.y * d.y, yz += w * d.y * d.z, zz += w * d.z * d.z;
  }
  void add_identity(FT w) { xx += w, yy += w, zz += w; }

  Vec3<FT> operator*(const Vec3<FT>& v) const
  {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
            xz * v.x + yz * v.y + zz * v.z};
  }

  /// 0 if the matrix is not positive definite.
  Symmetric_matrix inverse() const
  {
    const Vec3<FT> a{xx, xy, xz}, b{xy, yy, yz}, c{xz, yz, zz};
    const Vec3<FT> bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    const FT determinant = dot(a, bc);
    if (!(determinant > 0)) return {};
    const FT i = 1 / determinant;
    return {i * bc.x, i * bc.y, i * bc.z, i * ca.y, i * ca.z, i * ab.z};
  }

  Symmetric_matrix<float> rounded() const
  {
    return {float(xx), float(xy), float(xz), float(yy), float(yz), float(zz)};
  }
};

class Surface_fitter {
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;
  using Edge = Star_mesh::Edge;
  using Face = Working_mesh::Face;

  /// `flat`: of the surface. `limit`: the badness that a move may bring upon a triangle that was
  /// better.
  Surface_fitter(Star_mesh& mesh, const Distance_tracker& tracker, const Flat_patches& flat,
                 double limit)
      : m(mesh), m_tracker(tracker), m_flat(flat), m_badness_limit(limit),
        m_spacing(std::sqrt(mesh.projector().surface().area / double(mesh.size()))),
        m_tangential_weight(has_uniform_density(mesh.projector().surface())
                                ? Parameters::even_tangential_weight
                                : Parameters::tangential_weight)
  {
    m_centroids.resize(mesh.working().mesh.num_faces());
    m_middles.resize(mesh.working().mesh.num_edges());
    m_unknowns.resize(mesh.size());
    m_coupling.resize(mesh.working().mesh.num_edges());
    m_moves.resize(mesh.size());
  }

  void run()
  {
    measure();
    solve();
    m.for_each_vertex([this](Vertex v) {
      if (m.is_movable(v)) move(v);
    });
  }

private:
  using Edges = std::array<Halfedge, 3>;     // of a face
  using Barycentric = std::array<double, 3>; // of the sources of its edges

  using Parameters = Improvement_parameters::Fitting;

  // A point of the mesh is to move by `distance` along `direction`, to a place of the surface.
  struct Target {
    Vec3<float> direction{0, 0, 0};
    float distance = 0, weight = 0;
    int facet = -1; // of the place; -1: there is none
  };

  struct Unknown {
    Symmetric_matrix<float> inverse; // of its own part of the matrix
    Vec3<float> right{0, 0, 0};
    float longest = 0;
    bool is_flat = false; // it lies in a flat patch
  };

  // What is gathered around a vertex.
  struct Equations {
    Symmetric_matrix<double> matrix;
    Vec3d right{0, 0, 0};
    double weight = 0, longest = 0;
    double around = 0, level = 0; // area of the star, and of what is in the plane of the vertex

    // Of a point with the coordinate `b` at the vertex.
    void add(const Target& t, double b)
    {
      if (t.facet < 0 || !(b > 0)) return;
      const Vec3d direction = to_double(t.direction);
      const double w = t.weight * b;
      matrix.add(direction, w * b);
      right += (w * t.distance) * direction;
      weight += w * b;
      if (b > 0.1) longest = std::max(longest, std::abs(double(t.distance)));
    }
  };

  // All that says where the mesh should be, at faces and edges; then of each vertex and edge what
  // is around it.
  void measure()
  {
    const auto& mesh = m.working().mesh;
    const Concurrency concurrency = m.concurrency();
    const double density =
        std::min(1., double(m_tracker.size()) / (Parameters::fully_tracked * double(m.size())));
    m_tracked_weight = Parameters::tracked_weight * density * density;
    for_each_index(concurrency, int(mesh.num_faces()), [&](int f) {
      if (!mesh.is_removed(Face(f))) m_centroids[f] = centroid(mesh.halfedge(Face(f)));
    });
    for_each_index(concurrency, int(mesh.num_edges()), [&](int e) {
      if (!mesh.is_removed(Edge(e))) m_middles[e] = middle(Edge(e));
    });
    for_each_index(concurrency, int(mesh.num_vertices()), [&](int v) {
      m_unknowns[v] = unknown(Vertex(v));
      m_moves[v] = {0, 0, 0};
    });
    for_each_index(concurrency, int(mesh.num_edges()), [&](int e) {
      if (!mesh.is_removed(Edge(e))) m_coupling[e] = coupling(Edge(e));
    });
  }

  // The places are those of a rule that is exact for cubics: the corners, the middles of the edges,
  // the centroid.
  Target centroid(Halfedge h) const
  {
    const auto& mesh = m.working().mesh;
    return target({h, mesh.next(h), mesh.prev(h)}, {1 / 3., 1 / 3., 1 / 3.}, area(h) * 9 / 20);
  }

  Target middle(Edge e) const
  {
    const auto& mesh = m.working().mesh;
    Halfedge h = mesh.halfedge(e, 0);
    double a = 0;
    for (const Halfedge side : {mesh.halfedge(e, 1), mesh.halfedge(e, 0)}) {
      if (mesh.is_border(side)) continue;
      h = side;
      a += area(side);
    }
    return target({h, mesh.next(h), mesh.prev(h)}, {.5, .5, 0}, a * 2 / 15);
  }

  Unknown unknown(Vertex v) const
  {
    Unknown u;
    const auto& mesh = m.working().mesh;
    if (!m.is_movable(v)) return u;
    Equations sum;
    const Vec3d p = m.point(v), n = m.normal(v);
    for (const Halfedge h : halfedges_around_target(v, mesh)) {
      const Target &middle = m_middles[mesh.edge(h)], &centroid = m_centroids[mesh.face(h)];
      const Vec3d to_source = m.point(mesh.source(h)) - p,
                  to_apex = m.point(m.working().apex(h)) - p;
      sum.add(middle, 0.5);
      note_level(sum, v, middle, 0.5 * to_source);
      sum.add(centroid, 1 / 3.);
      note_level(sum, v, centroid, (1 / 3.) * (to_source + to_apex));
      sum.add({to_real<float>(n), float(-m.height(v)), centroid.weight / 9, 0}, 1);
      for (const int i : m_tracker.at_face(mesh.face(h))) sum.add(tracked(i), barycentric(i, v));
    }
    u.is_flat = sum.level > Parameters::flat_share * sum.around;
    sum.matrix.add_identity(m_tangential_weight * sum.weight);
    sum.matrix.add(u.is_flat ? m.projector().surface().facet_normals[m.facet(v)] : n,
                   ((u.is_flat ? Parameters::flat_normal_weight : Parameters::normal_weight) -
                    m_tangential_weight) *
                       sum.weight);
    u.inverse = sum.matrix.inverse().rounded();
    u.right = to_real<float>(sum.right);
    u.longest = float(sum.longest);
    return u;
  }

  // Of the two ends of an edge.
  Symmetric_matrix<float> coupling(Edge e) const
  {
    const auto& mesh = m.working().mesh;
    Symmetric_matrix<double> sum;
    const auto add = [&sum](const Target& t, double b, double c) {
      if (t.facet >= 0 && b > 0 && c > 0) sum.add(to_double(t.direction), t.weight * b * c);
    };
    add(m_middles[e], 0.5, 0.5);
    for (const Halfedge h : {mesh.halfedge(e, 0), mesh.halfedge(e, 1)}) {
      if (mesh.is_border(h)) continue;
      add(m_centroids[mesh.face(h)], 1 / 3., 1 / 3.);
      for (const int i : m_tracker.at_face(mesh.face(h)))
        add(tracked(i), barycentric(i, mesh.source(h)), barycentric(i, mesh.target(h)));
    }
    return sum.rounded();
  }

  Target tracked(int i) const
  {
    const auto& w = m_tracker[i];
    const Vec3d direction =
        w.distance > 0 ? (m_tracker.point(i) - w.nearest) * (1 / w.distance) : m_tracker.normal(i);
    return {to_real<float>(direction), float(w.distance), float(m_tracked_weight * w.weight),
            w.facet};
  }

  // Of the place of the mesh that is nearest to a tracked point: its coordinate at a corner.
  double barycentric(int i, Vertex v) const
  {
    const auto& w = m_tracker[i];
    const auto corners = m.working().corners(w.face);
    const auto [a, b, c] = m.points(w.face);
    double beta, gamma;
    barycentric_coordinates(w.nearest, a, b, c, beta, gamma);
    return v == corners[1] ? beta : v == corners[2] ? gamma : 1 - beta - gamma;
  }

  double area(Halfedge h) const
  {
    const auto [a, b, c] = m.working().corners(h);
    return length(m.working().area_vector(a, b, c)) / 2;
  }

  // Where the surface is at a point of the mesh. `edges`: of its face. Corners on features belong
  // to several patches: they do not say on which of them the face lies.
  Target target(const Edges& edges, const Barycentric& barycentric, double weight) const
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
    Target result;
    result.weight = float(weight);
    if (nearest < 0) return result; // no corner can move
    const Vertex guide = mesh.source(edges[nearest]);
    n = squared_length(n) > 0 ? normalized(n) : m.normal(guide); // the middle of a feature edge
    const auto place = m.projector().project(p, n, near_facet(mesh.face(edges[0]), p, n, guide));
    result.facet = place.facet;
    if (place.facet < 0) return result;
    const double distance = length(place.point - p);
    result.distance = float(distance);
    result.direction = to_real<float>(distance > 0 ? (place.point - p) * (1 / distance) : n);
    return result;
  }

  // Whether a place of the surface is in the plane of the facet that carries `v`. `offset`: from
  // there to the point of the mesh.
  void note_level(Equations& sum, Vertex v, const Target& t, Vec3d offset) const
  {
    if (t.facet < 0) return;
    const auto& normals = m.projector().surface().facet_normals;
    const Vec3d& n = normals[m.facet(v)];
    offset += double(t.distance) * to_double(t.direction);
    const double height = dot(offset, n);
    sum.around += t.weight;
    if (m_flat.width(m.facet(v)) > Parameters::flat_width * m_spacing &&
        dot(normals[t.facet], n) > Parameters::coplanar_cosine &&
        height * height < (1 - Parameters::coplanar_cosine) * squared_length(offset))
      sum.level += t.weight;
  }

  // A facet near the point `p` of a face: that of `guide`, or of a point that is tracked there, on
  // the same patch, if it is nearer.
  int near_facet(Face f, const Vec3d& p, const Vec3d& n, Vertex guide) const
  {
    int facet = m.facet(guide);
    double least = squared_length(m.point(guide) - p);
    for (const int i : m_tracker.at_face(f)) {
      const auto& w = m_tracker[i];
      const double d = squared_length(m_tracker.point(i) - p);
      if (!(d < least) || !(dot(m_tracker.normal(i), n) > Parameters::sheet_cosine) ||
          !m.projector().are_on_one_patch(w.facet, m.facet(guide)))
        continue;
      facet = w.facet;
      least = d;
    }
    return facet;
  }

  void solve()
  {
    const auto& mesh = m.working().mesh;
    for (int sweep = 0; sweep < Parameters::sweeps; ++sweep)
      m.for_each_vertex([&](Vertex v) {
        if (!m.is_movable(v)) return;
        const Unknown& u = m_unknowns[v];
        Vec3<float> right = u.right;
        for (const Halfedge h : halfedges_around_target(v, mesh))
          right -= m_coupling[mesh.edge(h)] * m_moves[mesh.source(h)];
        Vec3<float> move = u.inverse * right;
        const float l = length(move);
        if (l > u.longest) move *= u.longest / l;
        m_moves[v] = move;
      });
  }

  void move(Vertex v)
  {
    const Unknown& u = m_unknowns[v];
    const Vec3d n = u.is_flat ? m.projector().surface().facet_normals[m.facet(v)] : Vec3d{0, 0, 0};
    const Vec3d p = m.point(v), step = to_double(m_moves[v]), q = p + step - dot(step, n) * n;
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
  double m_badness_limit, m_spacing, m_tangential_weight, m_tracked_weight = 0;
  Unset_vector<Target> m_centroids; // by face
  Unset_vector<Target> m_middles;   // by edge
  // the normal equations
  Unset_vector<Unknown> m_unknowns;                 // by vertex
  Unset_vector<Symmetric_matrix<float>> m_coupling; // by edge
  Unset_vector<Vec3<float>> m_moves;                // by vertex: their solution
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_FIT_TO_SURFACE_H
