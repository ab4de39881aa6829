// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Gives the patches of a mesh, between its features, the areas that they have on the surface. With
// its vertices on a bent surface, a mesh is too small; fitted to it (fit_to_surface.h), about as
// much too large. So the vertices inside a patch move along their normals by one multiple of the
// gradients of its area, which are where the surface bends, and as long as the distance between
// the two: flat parts stay. A label of which more is still lacking takes it from larger ones: where
// the surface goes on smoothly, the lines between them move.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_KEEP_AREAS_H
#define CGAL_POWER_RTF_IMPROVEMENT_KEEP_AREAS_H

#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/smoothing/can_move.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
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
    std::vector<int> labels = surface.facet_labels;
    sort_uniquely(labels);
    m_wanted_of_labels.resize(labels.size(), 0);
    for (std::size_t f = 0; f < surface.facet_patches.size(); ++f) {
      const std::size_t patch = surface.facet_patches[f];
      if (patch >= m_wanted.size()) {
        m_wanted.resize(patch + 1, 0);
        m_labels.resize(patch + 1, 0);
      }
      const int label = int(
          std::lower_bound(labels.begin(), labels.end(), surface.facet_labels[f]) - labels.begin());
      m_wanted[patch] += surface.facet_areas[f];
      m_labels[patch] = label;
      m_wanted_of_labels[label] += surface.facet_areas[f];
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
    for (int round = 0; round < Parameters::line_rounds; ++round)
      if (!shift_lines()) break;
  }

private:
  using Parameters = Improvement_parameters::Areas;

  // A vertex on the line between two labels.
  struct Line_vertex {
    Vertex v;
    int larger;     // of the two
    Vec3d gradient; // of the smaller one's area
  };

  int patch_of(Vertex v) const { return m.projector().surface().facet_patches[m.facet(v)]; }

  /// A face has the patch of its vertices inside; one without any, that of a face beside it, or
  /// where there is none either, of the nearest facet that agrees.
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
    spread(std::move(found));
    std::vector<std::pair<double, Face>> unknown; // with their areas, the largest first
    for (const Face f : mesh.faces())
      if (m_patches[f] < 0) unknown.push_back({-area(f), f});
    std::sort(unknown.begin(), unknown.end());
    for (const auto& [area, f] : unknown) {
      if (m_patches[f] >= 0) continue;
      const auto [a, b, c] = m.points(mesh.halfedge(f));
      const int facet = m.projector()
                            .tree()
                            .nearest((a + b + c) * (1 / 3.), normalized(cross(b - a, c - a)),
                                     Parameters::max_turn_cosine, -1)
                            .facet;
      if (facet < 0) continue;
      m_patches[f] = m.projector().surface().facet_patches[facet];
      spread({f});
    }
  }

  /// Gives the faces around some, which have no patch yet, theirs.
  void spread(std::vector<Face> found)
  {
    const auto& mesh = m.working().mesh;
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

  double area(Face f) const
  {
    const auto [a, b, c] = m.points(m.working().mesh.halfedge(f));
    return length(cross(b - a, c - a)) / 2;
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
      for (const Star::Corner& c : m.star(v).corners) sum += area_gradient(p, c.a, c.b);
      m_gradients[i] = dot(sum, m.normal(v));
    });
  }

  /// Of the area of a triangle, of its corner `p`.
  static Vec3d area_gradient(const Vec3d& p, const Vec3d& a, const Vec3d& b)
  {
    return 0.5 * cross(normalized(cross(a - p, b - p)), b - a);
  }

  /// By patch: the area that is wanted, less that of its faces.
  std::vector<double> find_lacking() const
  {
    std::vector<double> lacking = m_wanted;
    for (const Face f : m.working().mesh.faces())
      if (m_patches[f] >= 0) lacking[m_patches[f]] -= area(f);
    return lacking;
  }

  /// How many times their gradients vertices are to move; `squares`: the sum of those.
  static double factor(double lacking, double squares, double most)
  {
    return squares > 0 ? std::clamp(lacking / squares, -most, most) : 0;
  }

  /// By patch, of its vertices inside.
  std::vector<double> find_factors() const
  {
    const std::vector<double> lacking = find_lacking();
    std::vector<double> squares(m_wanted.size(), 0), factors(m_wanted.size());
    for (const Vertex v : m.working().mesh.vertices())
      if (m.is_movable(v)) squares[patch_of(v)] += m_gradients[v] * m_gradients[v];
    for (std::size_t k = 0; k < factors.size(); ++k)
      factors[k] = factor(lacking[k], squares[k], Parameters::most);
    return factors;
  }

  void move(Vertex v, double factor)
  {
    const Vec3d p = m.point(v), q = p + factor * m_gradients[v] * m.normal(v);
    if (can_move(m.star(v), p, q, Parameters::max_turn_cosine, m_limit)) m.move_off(v, q);
  }

  /// Of labels that lack too much, or have, as far as that goes, beginning with the smallest.
  /// \returns whether anything has changed.
  bool shift_lines()
  {
    std::vector<double> lacking(m_wanted_of_labels.size(), 0);
    const std::vector<double> lacking_in_patches = find_lacking();
    for (std::size_t k = 0; k < m_labels.size(); ++k) lacking[m_labels[k]] += lacking_in_patches[k];
    const auto excess = [&](int label) {
      const double tolerance = Parameters::tolerance * m_wanted_of_labels[label];
      return lacking[label] - std::clamp(lacking[label], -tolerance, tolerance);
    };
    std::vector<int> labels;
    for (int label = 0; label < int(lacking.size()); ++label)
      if (excess(label) != 0) labels.push_back(label);
    if (labels.empty()) return false;
    std::sort(labels.begin(), labels.end(), [this](int k, int l) { return is_smaller(k, l); });
    const std::vector<std::vector<Line_vertex>> lines = find_lines();
    bool changed = false;
    for (const int label : labels) {
      double squares = 0;
      for (const Line_vertex& at : lines[label]) squares += squared_length(at.gradient);
      const double by = factor(excess(label), squares, Parameters::most_of_lines);
      if (by == 0) continue; // a smaller one has given it what it lacked
      for (const Line_vertex& at : lines[label])
        if (shift(at.v, by * at.gradient)) {
          lacking[at.larger] += by * squared_length(at.gradient);
          changed = true;
        }
    }
    return changed;
  }

  bool is_smaller(int k, int l) const
  {
    return std::pair(m_wanted_of_labels[k], k) < std::pair(m_wanted_of_labels[l], l);
  }

  /// By label, those to larger ones, where the surface goes on smoothly.
  std::vector<std::vector<Line_vertex>> find_lines() const
  {
    std::vector<std::vector<Line_vertex>> lines(m_wanted_of_labels.size());
    const auto& mesh = m.working().mesh;
    for (const Vertex v : mesh.vertices()) {
      if (!m.is_on_feature(v) || m.is_locked(v) || m.is_kept(v) || mesh.is_border(v)) continue;
      int features = 0;
      std::map<int, Vec3d> gradients; // by patch
      for (const auto h : halfedges_around_target(v, mesh)) {
        features += m.is_feature(mesh.edge(h));
        const auto [b, p, a] = m.points(h);
        gradients.try_emplace(m_patches[mesh.face(h)], Vec3d{0, 0, 0}).first->second +=
            area_gradient(p, a, b);
      }
      if (features != 2 || gradients.size() != 2 || gradients.begin()->first < 0) continue;
      std::pair<int, Vec3d> one = *gradients.begin(), other = *gradients.rbegin();
      one.first = m_labels[one.first];
      other.first = m_labels[other.first];
      const double lengths = length(one.second) * length(other.second);
      if (one.first == other.first ||
          dot(one.second, other.second) > -Parameters::smooth_cosine * lengths)
        continue;
      if (is_smaller(other.first, one.first)) std::swap(one, other);
      lines[one.first].push_back({v, other.first, one.second});
    }
    return lines;
  }

  bool shift(Vertex v, const Vec3d& step)
  {
    const Vec3d p = m.point(v), q = p + step;
    if (!can_move(m.star(v), p, q, Parameters::max_turn_cosine, Parameters::line_badness))
      return false;
    auto place = m.projector().nearest(q);
    place.point = q;
    m.move(v, place);
    return true;
  }

  Star_mesh& m;
  double m_limit;
  std::vector<double> m_wanted; // by patch
  std::vector<int> m_labels;    // by patch: the number of its label
  std::vector<double> m_wanted_of_labels;
  std::vector<int> m_patches;      // by face; -1: unknown
  std::vector<double> m_gradients; // by vertex
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_KEEP_AREAS_H
