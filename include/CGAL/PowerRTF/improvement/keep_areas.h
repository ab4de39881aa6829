// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gives the patches of a mesh, between its features, the areas that they have on the surface. With
// its vertices on a bent surface, a mesh is too small; fitted to it (fit_to_surface.h), about as
// much too large. So the vertices inside a patch move along their normals by one multiple of the
// gradients of its area, which are where the surface bends, and as long as the distance between
// the two: flat parts stay.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_KEEP_AREAS_H
#define CGAL_POWER_RTF_IMPROVEMENT_KEEP_AREAS_H

#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/smoothing/can_move.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Area_keeper {
public:
  using Vertex = Star_mesh::Vertex;
  using Face = Working_mesh::Face;

  /// `mesh`: of a surface with patches. `limit`: the badness that a move may bring upon a triangle
  /// that was better.
  Area_keeper(Star_mesh& mesh, double limit) : m(mesh), m_limit(limit)
  {
    const Surface& surface = m.projector().surface();
    for (std::size_t f = 0; f < surface.facet_patches.size(); ++f) {
      const std::size_t patch = surface.facet_patches[f];
      if (patch >= m_wanted.size()) m_wanted.resize(patch + 1, 0);
      m_wanted[patch] += surface.facet_areas[f];
    }
    find_patches();
  }

  void run()
  {
    for (int round = 0; round < Parameters::rounds; ++round) {
      find_gradients();
      const std::vector<double> factors = find_factors();
      for (const Vertex v : m.working().mesh.vertices())
        if (m.is_movable(v)) move(v, factors[patch_of(v)]);
    }
  }

private:
  using Parameters = Improvement_parameters::Areas;

  int patch_of(Vertex v) const { return m.projector().surface().facet_patches[m.facet(v)]; }

  /// A face has the patch of its vertices inside; one without any, that of a face beside it.
  void find_patches()
  {
    const auto& mesh = m.working().mesh;
    m_patches.assign(mesh.num_faces(), -1);
    std::vector<Face> found;
    for (const Face f : mesh.faces())
      for (const Vertex v : m.working().corners(f))
        if (m_patches[f] < 0 && !m.is_on_feature(v)) {
          m_patches[f] = patch_of(v);
          found.push_back(f);
        }
    for (; !found.empty();) {
      const Face f = found.back();
      found.pop_back();
      for (const auto h : mesh.halfedges_around_face(mesh.halfedge(f))) {
        const auto o = mesh.opposite(h);
        if (mesh.is_border(o) || m.is_feature(mesh.edge(h)) || m_patches[mesh.face(o)] >= 0)
          continue;
        m_patches[mesh.face(o)] = m_patches[f];
        found.push_back(mesh.face(o));
      }
    }
  }

  /// Of a vertex, along its normal: how its patch grows.
  void find_gradients()
  {
    m_gradients.assign(m.size(), 0);
    for_each_index(m.concurrency(), int(m.size()), [&](int i) {
      const Vertex v(i);
      if (!m.is_movable(v)) return;
      const Vec3d p = m.point(v);
      Vec3d sum{0, 0, 0};
      for (const Star::Corner& c : m.star(v).corners)
        sum += cross(normalized(cross(c.a - p, c.b - p)), c.b - c.a);
      m_gradients[i] = dot(sum, m.normal(v)) / 2;
    });
  }

  /// By patch: how many times their gradients its vertices are to move.
  std::vector<double> find_factors() const
  {
    std::vector<double> lacking = m_wanted, squares(m_wanted.size(), 0);
    const auto& mesh = m.working().mesh;
    for (const Face f : mesh.faces()) {
      if (m_patches[f] < 0) continue;
      const auto [a, b, c] = m.points(mesh.halfedge(f));
      lacking[m_patches[f]] -= length(cross(b - a, c - a)) / 2;
    }
    for (const Vertex v : mesh.vertices())
      if (m.is_movable(v)) squares[patch_of(v)] += m_gradients[v] * m_gradients[v];
    std::vector<double> factors(m_wanted.size(), 0);
    for (std::size_t k = 0; k < factors.size(); ++k)
      if (squares[k] > 0)
        factors[k] = std::clamp(lacking[k] / squares[k], -Parameters::most, Parameters::most);
    return factors;
  }

  void move(Vertex v, double factor)
  {
    const Vec3d p = m.point(v), q = p + factor * m_gradients[v] * m.normal(v);
    if (can_move(m.star(v), p, q, Parameters::max_turn_cosine, m_limit)) m.move_off(v, q);
  }

  Star_mesh& m;
  double m_limit;
  std::vector<double> m_wanted;    // by patch
  std::vector<int> m_patches;      // by face; -1: unknown
  std::vector<double> m_gradients; // by vertex
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_KEEP_AREAS_H
