// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Moves the vertices of creases off their curves, so that the edges between them come near to
// these: with its ends on it, an edge has a bent curve on one side, and is farthest away in the
// middle; moved toward there by half of that, the ends are as far away as the middle, and the
// largest distance is halved (for the smooth parts: fit_to_surface.h). Along a plane curve the
// moves stay in its plane, so that flat faces stay flat.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_FIT_CREASES_H
#define CGAL_POWER_RTF_IMPROVEMENT_FIT_CREASES_H

#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/feature_segments.h>
#include <CGAL/PowerRTF/improvement/slide_features.h>
#include <CGAL/PowerRTF/improvement/tangent_search.h>
#include <CGAL/PowerRTF/smoothing/can_move.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Crease_fitter {
public:
  using Vertex = Star_mesh::Vertex;
  using Edge = Star_mesh::Edge;

  /// `slider`: of the mesh. `limit`: the badness that a move may bring upon a triangle that was
  /// better.
  Crease_fitter(Star_mesh& mesh, const Feature_slider& slider, double limit)
      : m(mesh), m_slider(slider), m_limit(limit)
  {}

  void run()
  {
    find_chords();
    std::vector<Joint> joints = find_joints();
    for (int round = 0; round < Parameters::rounds; ++round) {
      for (Chord& c : m_chords) c.gap = gap(c);
      for (Joint& j : joints) j.step = step(j);
      for (const Joint& j : joints) move(j);
    }
  }

private:
  using Parameters = Improvement_parameters::Crease_fitting;

  // An edge of the mesh on a crease.
  struct Chord {
    Vertex a, b;
    std::vector<Segment> curve; // near it
    Vec3d gap;                  // from the edge to the curve, where that is farthest
  };

  // A vertex between two chords.
  struct Joint {
    Vertex v;
    std::array<int, 2> chords;
    Vec3d step;
  };

  void find_chords()
  {
    const auto& mesh = m.working().mesh;
    m_chord_of.assign(mesh.num_edges(), -1);
    for (const Edge e : mesh.edges()) {
      if (!m.is_feature(e) || mesh.is_border(e)) continue;
      const auto [a, b, c, d] = m.corners(e);
      const Vec3d p = m.point(a), q = m.point(b);
      m_chord_of[e] = int(m_chords.size());
      m_chords.push_back({a,
                          b,
                          m_slider.curves().near(0.5 * (p + q), Parameters::reach * length(q - p)),
                          {0, 0, 0}});
    }
  }

  std::vector<Joint> find_joints() const
  {
    const auto& mesh = m.working().mesh;
    std::vector<Joint> joints;
    for (const Vertex v : mesh.vertices()) {
      Vertex a, b;
      if (mesh.is_border(v) || !m_slider.is_sliding(v, a, b)) continue;
      const Joint joint{
          v,
          {m_chord_of[mesh.edge(mesh.halfedge(v, a))], m_chord_of[mesh.edge(mesh.halfedge(v, b))]},
          {0, 0, 0}};
      const auto has_curve = [this](int c) { return !m_chords[c].curve.empty(); };
      if (has_curve(joint.chords[0]) && has_curve(joint.chords[1])) joints.push_back(joint);
    }
    return joints;
  }

  // From the edge to the curve, where it is farthest, less what it is on the other side.
  Vec3d gap(const Chord& c) const
  {
    if (c.curve.empty()) return {0, 0, 0};
    std::array<Vec3d, Parameters::points_per_edge> gaps;
    Vec3d largest{0, 0, 0};
    for (int k = 0; k < Parameters::points_per_edge; ++k) {
      const double t = (k + 1.) / (Parameters::points_per_edge + 1);
      const Vec3d p = m.point(c.a) * (1 - t) + m.point(c.b) * t;
      gaps[k] = nearest_point(c.curve, p) - p;
      if (squared_length(gaps[k]) > squared_length(largest)) largest = gaps[k];
    }
    double opposite = 0;
    for (const Vec3d& g : gaps) opposite = std::max(opposite, -dot(g, largest));
    const double square = squared_length(largest);
    return square > 0 ? largest * std::max(0., 1 - opposite / square) : largest;
  }

  // To where the vertex is as far from the curve as the chords are.
  Vec3d step(const Joint& j) const
  {
    const Chord &c = m_chords[j.chords[0]], &d = m_chords[j.chords[1]];
    const Vec3d p = m.point(j.v), &own = c.gap, &other = d.gap;
    const Vec3d there = dot(own, other) > 0
                            ? squared_length(own) > squared_length(other) ? own : other
                            : own + other;
    return 0.5 * (there + nearest_point(c.curve, p) - p);
  }

  void move(const Joint& j)
  {
    const Vec3d p = m.point(j.v), q = p + j.step;
    const Star star = m.star(j.v);
    const double least = Parameters::straight * mean_edge(star, p);
    if (squared_length(j.step) < least * least) return;
    if (!can_move(star, p, q, Parameters::max_turn_cosine, m_limit)) return;
    auto place = m.projector().nearest(q);
    place.point = q;
    m.move(j.v, place);
  }

  Star_mesh& m;
  const Feature_slider& m_slider;
  double m_limit;
  std::vector<Chord> m_chords;
  std::vector<int> m_chord_of; // by edge; -1: none
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_FIT_CREASES_H
