// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Vertices on creases and borders stay on their curves, but they may slide along them where that
// makes their bad triangles better: between curves that run close together no other vertex can.
#ifndef CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_SLIDE_FEATURES_H
#define CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_SLIDE_FEATURES_H

#include <CGAL/PowerRTF/extraction/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/extraction/improvement/triangle_badness.h>
#include <CGAL/PowerRTF/surface/facet_adjacency.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

class Feature_slider
{
public:
  using Vertex = Star_mesh::Vertex;
  using Halfedge = Star_mesh::Halfedge;

  /// `patches`: the surface cut along its creases; the curves are its borders.
  Feature_slider(Star_mesh& mesh, const Surface& patches) : m(mesh)
  {
    const Facet_adjacency adjacency = facet_adjacency(patches.triangles, patches.points.size());
    if (adjacency.border_edges == 0) return;
    for (int h = 0; h < int(adjacency.opposite.size()); ++h)
      if (adjacency.opposite[h] == Facet_adjacency::none)
        m_curves.emplace_back(patches.points[halfedge_source(patches.triangles, h)],
                              patches.points[halfedge_target(patches.triangles, h)]);
  }

  void run(int rounds)
  {
    if (m_curves.empty()) return;
    for (int round = 0; round < rounds; ++round)
      for (const Vertex v : m.working().mesh.vertices()) slide(v);
  }

private:
  using Segment = std::pair<Vec3d, Vec3d>;

  static constexpr double first_step = 0.2; // in edges of the curve
  static constexpr int halvings = 4, max_steps = 10;
  static constexpr double clearly = 1 - 1e-9;
  static constexpr double closest = 0.4;     // to a neighbour, in edges of the curve
  static constexpr double cos_turn = 0.7071; // sharper turns are corners
  static constexpr double cos_fold = 0.9;    // that triangles may turn

  static Vec3d nearest_point(const Segment& s, const Vec3d& p)
  {
    const Vec3d d = s.second - s.first;
    const double l = squared_length(d), t = l > 0 ? dot(p - s.first, d) / l : 0;
    return s.first + d * std::min(1., std::max(0., t));
  }

  /// The neighbours of `v` on its curve; false if it is none, or a corner.
  bool neighbours(Vertex v, Vertex& a, Vertex& b) const
  {
    int found = 0;
    for (const Halfedge h : halfedges_around_target(v, m.working().mesh))
      if (m.is_feature(m.working().mesh.edge(h))) {
        (found == 0 ? a : b) = m.working().mesh.source(h);
        ++found;
      }
    return found == 2 &&
           dot(normalized(m.point(v) - m.point(a)), normalized(m.point(b) - m.point(v))) > cos_turn;
  }

  static double energy(const Star& star, const Vec3d& p)
  {
    double sum = 0;
    for (const Star::Corner& c : star.corners) { // squared: the worst triangle counts most
      const double e = triangle_badness(p, c.a, c.b).energy();
      sum += e * e;
    }
    return sum;
  }

  void slide(Vertex v)
  {
    Vertex a, b;
    if (!m.is_on_feature(v) || m.is_locked(v) || !neighbours(v, a, b)) return;
    const Star star = m.star(v);
    const Vec3d p = m.point(v), pa = m.point(a), pb = m.point(b);
    double bad = 0;
    for (const Star::Corner& c : star.corners) bad += triangle_badness(p, c.a, c.b).badness;
    if (!(bad > 0)) return;

    const double scale = (length(pa - p) + length(pb - p)) / 2;
    std::vector<Segment> near;
    for (const Segment& s : m_curves)
      if (squared_length(nearest_point(s, p) - p) < scale * scale) near.push_back(s);
    const auto on_curve = [&](double s) { // s > 0: towards b
      const Vec3d q = s > 0 ? p + (pb - p) * (s * scale / length(pb - p))
                            : p + (pa - p) * (-s * scale / length(pa - p));
      Vec3d best = p;
      double least = std::numeric_limits<double>::infinity();
      for (const Segment& segment : near) {
        const Vec3d r = nearest_point(segment, q);
        if (squared_length(r - q) < least) {
          least = squared_length(r - q);
          best = r;
        }
      }
      return best;
    };
    const auto is_allowed = [&](const Vec3d& q) {
      if (length(q - pa) < closest * scale || length(q - pb) < closest * scale) return false;
      if (!(dot(normalized(q - pa), normalized(pb - q)) > cos_turn)) return false;
      for (const Star::Corner& c : star.corners) {
        const Vec3d now = cross(c.a - p, c.b - p), then = cross(c.a - q, c.b - q);
        if (!(dot(now, then) >= cos_fold * length(now) * length(then))) return false;
      }
      return true;
    };
    double least = energy(star, p), at = 0, step = first_step;
    Vec3d best = p;
    for (int i = 0, halved = 0; i < max_steps && halved < halvings; ++i) {
      bool found = false;
      for (const double s : {at - step, at + step}) {
        const Vec3d q = on_curve(s);
        const double e = energy(star, q);
        if (!(e < clearly * least) || !is_allowed(q)) continue;
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
    if (best == p) return;
    auto place = m.guide().nearest(best);
    place.point = best;
    m.move(v, place);
  }

  Star_mesh& m;
  std::vector<Segment> m_curves;
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_IMPROVEMENT_SLIDE_FEATURES_H
