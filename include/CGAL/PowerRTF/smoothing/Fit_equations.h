// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The normal equations of a fit of a mesh to a surface: least squares of the distances, at a
// quadrature of each triangle, to the points of the surface that are nearest now, and of those from
// tracked points of the surface to the mesh, that also see its tips. Where the normals vary, on
// ridges and tips, the vertices are also drawn sideways to where they are needed (quadrics: Garland
// and Heckbert, "Surface simplification using quadric error metrics", 1997). What is kept of each
// vertex, edge and face is in single precision: these are moves and distances, small beside the
// triangles.
#ifndef CGAL_POWER_RTF_SMOOTHING_FIT_EQUATIONS_H
#define CGAL_POWER_RTF_SMOOTHING_FIT_EQUATIONS_H

#include <CGAL/PowerRTF/smoothing/Smoothing_parameters.h>
#include <CGAL/PowerRTF/smoothing/Star_view.h>
#include <CGAL/PowerRTF/smoothing/Symmetric_matrix.h>
#include <CGAL/PowerRTF/smoothing/can_move.h>

#include <cmath>
#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// An edge of a mesh and the faces to its left and right.
struct Mesh_edge {
  int source, target;
  int left, right;
};

/// A vertex of the surface and where the mesh is nearest to it.
struct Tracked_place {
  Vec3d nearest; ///< of the mesh
  double distance;
  int vertex, facet; ///< of the surface
  double weight;     ///< area of the surface that it stands for
};

/// A point of the mesh is to move by `distance` along `direction`, to a place of the surface.
struct Fit_target {
  Vec3<float> direction{0, 0, 0};
  float distance = 0, weight = 0;
  int facet = -1; ///< of the place; -1: there is none
};

/// Of a vertex: its own part of the equations.
struct Fit_unknown {
  Symmetric_matrix<float> inverse;
  Vec3<float> right{0, 0, 0};
  float longest = 0;    ///< step
  bool is_flat = false; ///< it lies in a flat patch, in whose plane it stays
};

/// Non-owning. First all that says where the mesh should be, at faces and edges; then of each
/// vertex and edge what is around it; then sweeps over the vertices.
struct Fit_equations {
  using Parameters = Fitting_parameters;

  Star_view stars;
  const int* spoke_edges = nullptr;
  const int* spoke_faces = nullptr;
  const int* corners = nullptr; ///< three per face, counter-clockwise
  const Mesh_edge* edges = nullptr;
  const int* first_tracked = nullptr;     ///< of each face, and the end
  const Tracked_place* tracked = nullptr; ///< by the face to which they are nearest
  const unsigned char* is_wide = nullptr; ///< per facet: it lies in a wide flat patch
  double tangential_weight = 0, tracked_weight = 0;
  double badness_limit = 0; ///< that a move may bring upon a triangle that was better
  // results
  Fit_target* centroids = nullptr;              ///< by face
  Fit_target* middles = nullptr;                ///< by edge
  Fit_unknown* unknowns = nullptr;              ///< by vertex
  Symmetric_matrix<float>* couplings = nullptr; ///< by edge
  Vec3<float>* steps = nullptr;                 ///< by vertex: the solution

  // The places are those of a rule that is exact for cubics: the corners, the middles of the edges,
  // the centroid.
  CGAL_POWER_RTF_HD void set_centroid(int f) const
  {
    constexpr double third = 1 / 3.;
    centroids[f] = target(f, {third, third, third}, area(f) * 9 / 20);
  }

  CGAL_POWER_RTF_HD void set_middle(int e) const
  {
    const Mesh_edge& edge = edges[e];
    const double a = area(edge.left) + area(edge.right);
    const int f = edge.left;
    Weights w;
    for (int k = 0; k < 3; ++k) {
      const int v = corners[3 * f + k];
      w.of_corner[k] = v == edge.source || v == edge.target ? .5 : 0;
    }
    middles[e] = target(f, w, a * 2 / 15);
  }

  CGAL_POWER_RTF_HD void set_unknown(int v) const
  {
    unknowns[v] = {};
    steps[v] = {0, 0, 0};
    if (!stars.is_movable(v)) return;
    Sums sum;
    const Vec3d p = stars.point(v), n = stars.normal(v);
    for (int k = stars.first[v]; k < stars.first[v + 1]; ++k) {
      const int f = spoke_faces[k];
      const Fit_target &middle = middles[spoke_edges[k]], &centroid = centroids[f];
      const Vec3d to_source = stars.point(stars.neighbors[k]) - p,
                  to_apex = stars.point(stars.neighbors[stars.next_spoke(v, k)]) - p;
      sum.add(middle, 0.5);
      note_level(sum, v, middle, 0.5 * to_source);
      sum.add(centroid, 1 / 3.);
      note_level(sum, v, centroid, (1 / 3.) * (to_source + to_apex));
      sum.add({rounded(n), float(-stars.height(v)), centroid.weight / 9, 0}, 1);
      for (int t = first_tracked[f]; t < first_tracked[f + 1]; ++t)
        sum.add(target(tracked[t]), weight_at(tracked[t], f, v));
    }
    const bool is_flat = sum.level > Parameters::flat_share * sum.around;
    sum.matrix.add_identity(tangential_weight * sum.weight);
    sum.matrix.add(is_flat ? stars.surface.facet_normals[stars.facet(v)] : n,
                   ((is_flat ? Parameters::flat_normal_weight : Parameters::normal_weight) -
                    tangential_weight) *
                       sum.weight);
    unknowns[v] = {sum.matrix.inverse().rounded(), rounded(sum.right), float(sum.longest), is_flat};
  }

  /// Of the two ends of an edge.
  CGAL_POWER_RTF_HD void set_coupling(int e) const
  {
    const Mesh_edge& edge = edges[e];
    Symmetric_matrix<double> sum;
    const auto add = [&sum](const Fit_target& t, double b, double c) {
      if (t.facet >= 0 && b > 0 && c > 0) sum.add(to_double(t.direction), t.weight * b * c);
    };
    add(middles[e], 0.5, 0.5);
    const auto add_face = [&](int f) {
      add(centroids[f], 1 / 3., 1 / 3.);
      for (int t = first_tracked[f]; t < first_tracked[f + 1]; ++t)
        add(target(tracked[t]), weight_at(tracked[t], f, edge.source),
            weight_at(tracked[t], f, edge.target));
    };
    add_face(edge.left);
    add_face(edge.right);
    couplings[e] = sum.rounded();
  }

  /// One step of Gauss and Seidel at vertex `v`.
  CGAL_POWER_RTF_HD void relax(int v) const
  {
    const Fit_unknown& u = unknowns[v];
    Vec3<float> right = u.right;
    for (int k = stars.first[v]; k < stars.first[v + 1]; ++k)
      right -= couplings[spoke_edges[k]] * steps[stars.neighbors[k]];
    Vec3<float> step = u.inverse * right;
    const float l = length(step);
    if (l > u.longest) step *= u.longest / l;
    steps[v] = step;
  }

  /// Moves vertex `v` by its step, unless that spoils or turns over triangles.
  CGAL_POWER_RTF_HD void move(int v) const
  {
    const Vec3d p = stars.point(v), step = to_double(steps[v]);
    Vec3d q = p + step;
    if (unknowns[v].is_flat) {
      const Vec3d& n = stars.surface.facet_normals[stars.facet(v)];
      q -= dot(step, n) * n;
    }
    if (can_move(stars.star(v), p, q, Parameters::max_turn_cosine, badness_limit))
      stars.move_off(v, q);
  }

private:
  /// Barycentric coordinates in a face.
  struct Weights {
    double of_corner[3];
  };

  /// What is gathered around a vertex.
  struct Sums {
    Symmetric_matrix<double> matrix;
    Vec3d right{0, 0, 0};
    double weight = 0, longest = 0;
    double around = 0, level = 0; // area of the star, and of what is in the plane of the vertex

    /// Of a point with the coordinate `b` at the vertex.
    CGAL_POWER_RTF_HD void add(const Fit_target& t, double b)
    {
      if (t.facet < 0 || !(b > 0)) return;
      const Vec3d direction = to_double(t.direction);
      const double w = t.weight * b, distance = std::fabs(double(t.distance));
      matrix.add(direction, w * b);
      right += (w * t.distance) * direction;
      weight += w * b;
      if (b > 0.1 && distance > longest) longest = distance;
    }
  };

  CGAL_POWER_RTF_HD static Vec3<float> rounded(const Vec3d& v)
  {
    return {float(v.x), float(v.y), float(v.z)};
  }

  CGAL_POWER_RTF_HD const Vec3d& point(const Tracked_place& w) const
  {
    return stars.surface.points[w.vertex];
  }
  CGAL_POWER_RTF_HD const Vec3d& normal(const Tracked_place& w) const
  {
    return stars.surface.vertex_normals[w.vertex];
  }

  CGAL_POWER_RTF_HD Fit_target target(const Tracked_place& w) const
  {
    const Vec3d direction = w.distance > 0 ? (point(w) - w.nearest) * (1 / w.distance) : normal(w);
    return {rounded(direction), float(w.distance), float(tracked_weight * w.weight), w.facet};
  }

  /// Of the place of face `f` that is nearest to a tracked point: its coordinate at a corner.
  CGAL_POWER_RTF_HD double weight_at(const Tracked_place& w, int f, int v) const
  {
    const int* const t = corners + 3 * f;
    double beta, gamma;
    barycentric_coordinates(w.nearest, stars.point(t[0]), stars.point(t[1]), stars.point(t[2]),
                            beta, gamma);
    return v == t[1] ? beta : v == t[2] ? gamma : 1 - beta - gamma;
  }

  CGAL_POWER_RTF_HD double area(int f) const
  {
    const int* const t = corners + 3 * f;
    const Vec3d a = stars.point(t[0]);
    return length(cross(stars.point(t[1]) - a, stars.point(t[2]) - a)) / 2;
  }

  /// Where the surface is at a point of face `f`. Corners on features belong to several patches:
  /// they do not say on which of them the face lies.
  CGAL_POWER_RTF_HD Fit_target target(int f, const Weights& weights, double weight) const
  {
    Vec3d p{0, 0, 0}, n{0, 0, 0};
    int nearest = -1;
    for (int k = 0; k < 3; ++k) {
      const int v = corners[3 * f + k];
      const double w = weights.of_corner[k];
      p += w * stars.point(v);
      if (stars.is_on_feature(v)) continue;
      n += w * stars.normal(v);
      if (nearest < 0 || w > weights.of_corner[nearest]) nearest = k;
    }
    Fit_target result;
    result.weight = float(weight);
    if (nearest < 0) return result; // no corner can move
    const int guide = corners[3 * f + nearest];
    n = squared_length(n) > 0 ? normalized(n) : stars.normal(guide); // on a feature edge
    const Surface_place place = stars.surface.project(p, n, near_facet(f, p, n, guide));
    result.facet = place.facet;
    if (place.facet < 0) return result;
    const double distance = length(place.point - p);
    result.distance = float(distance);
    result.direction = rounded(distance > 0 ? (place.point - p) * (1 / distance) : n);
    return result;
  }

  /// A facet near the point `p` of a face: that of `guide`, or of a point that is tracked there, on
  /// the same patch, if it is nearer.
  CGAL_POWER_RTF_HD int near_facet(int f, const Vec3d& p, const Vec3d& n, int guide) const
  {
    int facet = stars.facet(guide);
    double least = squared_length(stars.point(guide) - p);
    for (int t = first_tracked[f]; t < first_tracked[f + 1]; ++t) {
      const Tracked_place& w = tracked[t];
      const double d = squared_length(point(w) - p);
      if (!(d < least) || !(dot(normal(w), n) > Parameters::sheet_cosine) ||
          !stars.surface.are_on_one_patch(w.facet, stars.facet(guide)))
        continue;
      facet = w.facet;
      least = d;
    }
    return facet;
  }

  /// Whether a place of the surface is in the plane of the facet that carries `v`. `offset`: from
  /// there to the point of the mesh.
  CGAL_POWER_RTF_HD void note_level(Sums& sum, int v, const Fit_target& t, Vec3d offset) const
  {
    if (t.facet < 0) return;
    const Vec3d* const normals = stars.surface.facet_normals;
    const Vec3d& n = normals[stars.facet(v)];
    offset += double(t.distance) * to_double(t.direction);
    const double height = dot(offset, n);
    sum.around += t.weight;
    if (is_wide[stars.facet(v)] && dot(normals[t.facet], n) > Parameters::coplanar_cosine &&
        height * height < (1 - Parameters::coplanar_cosine) * squared_length(offset))
      sum.level += t.weight;
  }
};

/// A vertex of the surface whose distance from the mesh counts.
struct Tracked_vertex {
  int vertex, facet; ///< of the surface
  int near;          ///< a vertex of the mesh near it that may move; -1: there is none
  float weight;      ///< area of the surface that it stands for
};

/// Owns what `Fit_equations` needs beside the mesh's stars.
struct Flat_fit {
  Unset_vector<Tracked_vertex> tracked;
  Unset_vector<unsigned char> is_wide; ///< by facet
  double tangential_weight = 0, tracked_weight = 0, badness_limit = 0;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_FIT_EQUATIONS_H
