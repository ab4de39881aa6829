// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices on creases and borders stay on their curves, or as far from them as fit_creases.h has
// put them, but they may slide along them where that makes their bad triangles better: between
// curves that run close together no other vertex can. At a corner where two curves make a sharp
// angle, the next vertices on both slide together: away from the corner bent curves open, and one
// alone would spoil the triangle between them.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_SLIDE_FEATURES_H
#define CGAL_POWER_RTF_IMPROVEMENT_SLIDE_FEATURES_H

#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/feature_segments.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Feature_slider {
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;

  /// `patches`: the surface cut along its creases; the curves are its borders.
  Feature_slider(Star_mesh& mesh, const Surface& patches) : m(mesh), m_curves(patches) {}

  void run(int rounds)
  {
    if (m_curves.empty()) return;
    for (int round = 0; round < rounds; ++round)
      for (const Vertex v : m.working().mesh.vertices()) slide(v);
    for (const auto f : m.working().mesh.faces()) slide_pair(f);
  }

  /// Slides `v`, if it is on a curve, to where the sum of `energy(a, b, c)` of its triangles, none
  /// negative, is less, whether these are bad or not.
  template <class Energy>
  void slide(Vertex v, const Energy& energy)
  {
    Vertex a, b;
    if (!is_sliding(v, a, b)) return;
    Path curve = path(v, a, b);
    if (!curve.is_straight())
      curve.longest = std::max(curve.longest_edge(), Parameters::max_spacing * curve.scale);
    slide(v, m.star(v), curve, energy);
  }

  const Feature_segments& curves() const { return m_curves; }

  /// Whether `v` may slide between `a` and `b`, its neighbors on a curve, which this sets.
  bool is_sliding(Vertex v, Vertex& a, Vertex& b) const
  {
    return m.is_on_feature(v) && !m.is_locked(v) && neighbors(v, a, b);
  }

private:
  using Parameters = Improvement_parameters::Sliding;

  /// The curve around a vertex.
  struct Path {
    Vec3d p, pa, pb; // the vertex, and its neighbors on the curve
    double scale;    // their mean distance
    double longest = std::numeric_limits<double>::infinity(); // that one of them may become
    std::vector<Segment> near;
    Vec3d offset{0, 0, 0}; // of the vertex from the curve, where that has been fitted

    /// The place at `s` times the scale from the vertex; s > 0: toward b.
    Vec3d at(double s) const
    {
      const Vec3d q = s > 0 ? p + (pb - p) * (s * scale / length(pb - p))
                            : p + (pa - p) * (-s * scale / length(pa - p));
      return near.empty() ? p : nearest_point(near, q) + offset;
    }

    double longest_edge() const { return std::max(length(p - pa), length(p - pb)); }
    bool is_straight() const
    {
      return dot(p - pa, pb - p) > (1 - Parameters::straight) * length(p - pa) * length(pb - p);
    }

    bool is_spaced(const Vec3d& q) const
    {
      const auto [shorter, longer] = std::minmax({length(q - pa), length(q - pb)});
      return shorter >= Parameters::min_spacing * scale && longer <= longest &&
             dot(normalized(q - pa), normalized(pb - q)) > Parameters::corner_cosine;
    }
  };

  Path path(Vertex v, Vertex a, Vertex b) const
  {
    Path result;
    result.p = m.point(v), result.pa = m.point(a), result.pb = m.point(b);
    result.scale = (length(result.pa - result.p) + length(result.pb - result.p)) / 2;
    result.near = m_curves.near(result.p, result.scale);
    if (result.near.empty() || m.working().mesh.is_border(v)) return result;
    const Vec3d offset = result.p - nearest_point(result.near, result.p);
    const double rounding = Improvement_parameters::Crease_fitting::straight * result.scale;
    if (squared_length(offset) > rounding * rounding) result.offset = offset;
    return result;
  }

  /// The neighbors of `v` on its curve; false if it is none, or a corner; or kept; or on a seam,
  /// where its copies in other sheets would stay behind.
  bool neighbors(Vertex v, Vertex& a, Vertex& b) const
  {
    if (m.is_kept(v) || m.working().is_on_seam(v)) return false;
    int found = 0;
    for (const Halfedge h : halfedges_around_target(v, m.working().mesh))
      if (m.is_feature(m.working().mesh.edge(h))) {
        (found == 0 ? a : b) = m.working().mesh.source(h);
        ++found;
      }
    return found == 2 && dot(normalized(m.point(v) - m.point(a)),
                             normalized(m.point(b) - m.point(v))) > Parameters::corner_cosine;
  }

  // Squared: the worst triangle counts most.
  static double energy(const Vec3d& a, const Vec3d& b, const Vec3d& c)
  {
    const double e = triangle_badness(a, b, c).energy();
    return e * e;
  }

  void slide(Vertex v)
  {
    Vertex a, b;
    if (!is_sliding(v, a, b)) return;
    const Star star = m.star(v);
    const Vec3d p = m.point(v);
    double bad = 0;
    for (const Star::Corner& c : star.corners) bad += triangle_badness(p, c.a, c.b).badness;
    if (bad > 0) slide(v, star, path(v, a, b), energy);
  }

  template <class Energy>
  void slide(Vertex v, const Star& star, const Path& curve, const Energy& energy)
  {
    const Vec3d p = m.point(v);
    double least = star.sum(p, energy), at = 0, step = Parameters::first_step;
    Vec3d best = p;
    for (int i = 0, halved = 0; i < Parameters::max_steps && halved < Parameters::max_halvings;
         ++i) {
      bool found = false;
      for (const double s : {at - step, at + step}) {
        const Vec3d q = curve.at(s);
        if (!curve.is_spaced(q)) continue;
        const double limit = clearly_less * least, e = star.sum(q, energy, limit);
        if (!(e < limit) || folds(star, p, star, q)) continue;
        least = e;
        best = q;
        at = s;
        found = true;
        break;
      }
      if (found) continue;
      step /= 2;
      ++halved;
    }
    if (!(best == p)) move(v, best);
  }

  /// Whether a triangle around a vertex turns too far when the vertex goes from `p` to `q`, and its
  /// neighbors from where `before` has them to where `after` has them.
  static bool folds(const Star& before, const Vec3d& p, const Star& after, const Vec3d& q)
  {
    for (std::size_t k = 0; k < before.corners.size(); ++k) {
      const Star::Corner &s = before.corners[k], &t = after.corners[k];
      const Vec3d was = cross(s.a - p, s.b - p), is = cross(t.a - q, t.b - q);
      if (!(dot(was, is) >= Parameters::max_turn_cosine * length(was) * length(is))) return true;
    }
    return false;
  }

  void move(Vertex v, const Vec3d& p)
  {
    auto place = m.projector().nearest(p);
    place.point = p;
    m.move(v, place);
  }

  /// The next vertices on both curves at the corner of a bad triangle.
  void slide_pair(Working_mesh::Face f)
  {
    const auto& mesh = m.working().mesh;
    Halfedge h = mesh.halfedge(f);
    for (int k = 0; k < 3; ++k, h = mesh.next(h)) {
      const Halfedge to_corner = h, from_corner = mesh.next(h);
      const std::array<Vertex, 2> ends{mesh.source(to_corner), mesh.target(from_corner)};
      const Vertex corner = mesh.target(to_corner);
      if (!m.is_feature(mesh.edge(to_corner)) || !m.is_feature(mesh.edge(from_corner))) continue;
      if (!(triangle_badness(m.point(ends[0]), m.point(corner), m.point(ends[1])).badness >
            Triangle_badness::tolerable))
        continue;
      std::vector<Path> paths; // a is the corner
      for (const Vertex v : ends) {
        Vertex a, b;
        if (m.is_locked(v) || !neighbors(v, a, b)) break;
        paths.push_back(a == corner ? path(v, a, b) : path(v, b, a));
      }
      if (paths.size() == 2) slide_pair(ends, paths);
    }
  }

  void slide_pair(const std::array<Vertex, 2>& ends, const std::vector<Path>& paths)
  {
    const std::array<Vec3d, 2> before{m.point(ends[0]), m.point(ends[1])};
    const std::array<Star, 2> stars{m.star(ends[0]), m.star(ends[1])};
    std::array<Star, 2> moved = stars;
    std::array<Vec3d, 2> at = before;
    const auto move_to = [&](int k, const Vec3d& p) {
      at[k] = p;
      for (Star::Corner& c : moved[1 - k].corners) {
        if (c.vertex_a == ends[k]) c.a = p;
        if (c.vertex_b == ends[k]) c.b = p;
      }
    };
    const auto worst = [&](double limit) {
      double most = 0;
      for (int k = 0; k < 2; ++k)
        for (const Star::Corner& c : moved[k].corners) {
          most = std::max(most, triangle_badness(at[k], c.a, c.b).energy());
          if (!(most < limit)) return most;
        }
      return most;
    };
    const auto is_folded = [&] {
      return folds(stars[0], before[0], moved[0], at[0]) ||
             folds(stars[1], before[1], moved[1], at[1]);
    };
    std::array<std::vector<Vec3d>, 2> places;
    for (int k = 0; k < 2; ++k)
      for (int i = -Parameters::pair_steps; i <= Parameters::pair_steps; ++i)
        if (const Vec3d p = paths[k].at(i * Parameters::pair_step); paths[k].is_spaced(p))
          places[k].push_back(m.projector().surface().normalization.snapped(p));
    std::array<Vec3d, 2> best = before;
    double least = worst(std::numeric_limits<double>::infinity());
    for (const Vec3d& p : places[0]) {
      move_to(0, p);
      for (const Vec3d& q : places[1]) {
        move_to(1, q);
        const double limit = clearly_less * least, e = worst(limit);
        if (!(e < limit) || is_folded()) continue;
        least = e;
        best = at;
      }
    }
    for (int k = 0; k < 2; ++k)
      if (!(best[k] == before[k])) move(ends[k], best[k]);
  }

  Star_mesh& m;
  Feature_segments m_curves;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_SLIDE_FEATURES_H
