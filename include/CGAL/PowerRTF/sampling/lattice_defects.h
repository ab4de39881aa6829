// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the fields of a lattice do not fit together: integers that loops around a node have.
//
// On the step from a node j to the next one k of a loop, a field is carried along and then differs
// from the field at k by a residual, at most half a turn. Residual and what is carried, added up
// around the loop, are what the field turns there: whole turns, because it comes back to itself.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_DEFECTS_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_DEFECTS_H

#include <CGAL/PowerRTF/sampling/orientation_field.h>
#include <CGAL/PowerRTF/sampling/position_field.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace CGAL::PowerRTF {

/// A node's neighbors counterclockwise around it: the nodes whose Voronoi cells meet its own in its
/// tangent plane. As each triangle of such neighbors, but for a few where four cells nearly meet,
/// is inside the loops of its corners, hardly a place of the surface is outside all loops. There is
/// no loop at a border.
class Node_loop {
public:
  Node_loop(const Lattice_view& view, int i)
  {
    find_near(view, i);
    if (m_near.empty()) return;
    // The nearest bisector bounds the cell; the next one is the first that it meets.
    const Near first =
        *std::min_element(m_near.begin(), m_near.end(),
                          [](const Near& a, const Near& b) { return a.bisector() < b.bisector(); });
    const Near* last = &first;
    do {
      m_nodes.push_back(last->node);
      last = next_after(*last);
    } while (last && last->node != first.node && m_nodes.size() < m_near.size());
    bool is_closed = last && last->node == first.node && m_nodes.size() > 2;
    for_each_step([&](int j, int k) {
      is_closed = is_closed && is_carried(view.normals[j], view.normals[k]);
    });
    if (!is_closed) m_nodes.clear();
  }

  bool empty() const { return m_nodes.empty(); }

  /// Calls `f(j, k)` for each step.
  template <class F>
  void for_each_step(F&& f) const
  {
    for (std::size_t e = 0; e < m_nodes.size(); ++e)
      f(m_nodes[e], m_nodes[(e + 1) % m_nodes.size()]);
  }

private:
  struct Near {
    float x, y;    ///< from the node, in its tangent plane
    float squared; ///< distance from the node in space
    int node;

    float bisector() const { return squared / std::sqrt(x * x + y * y); } ///< twice the distance
  };

  /// The neighbors that the fields have, theirs, and again theirs: fewer leave out neighbors where
  /// nodes are uneven.
  void find_near(const Lattice_view& view, int i)
  {
    std::vector<int> nodes{i};
    for (int ring = 0; ring < 3; ++ring) {
      for (std::size_t k = 0, inside = nodes.size(); k < inside; ++k)
        for_each_edge(view, nodes[k],
                      [&](const Lattice_edge& edge) { nodes.push_back(int(edge.node)); });
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
    const Tangent_frame<float> frame(view.normals[i]);
    for (const int j : nodes) {
      if (j == i || dot(view.normals[i], view.normals[j]) <= 0) continue;
      const Vec3f d = step_between(view, i, view, j);
      m_near.push_back({dot(d, frame.u), dot(d, frame.v), dot(d, d), j});
    }
  }

  /// Null: there is none within half a turn.
  const Near* next_after(const Near& p) const
  {
    const Near* best = nullptr;
    const float foot = p.squared / (p.x * p.x + p.y * p.y);
    float least = 0; // where q's bisector crosses that of p, from its foot on
    for (const Near& q : m_near) {
      const float area = p.x * q.y - p.y * q.x;
      if (!(area > 0)) continue;
      const float crossing = (q.squared - foot * (p.x * q.x + p.y * q.y)) / area;
      if (best && crossing >= least) continue;
      best = &q;
      least = crossing;
    }
    return best;
  }

  std::vector<Near> m_near;
  std::vector<int> m_nodes;
};

/// The index of the six-fold field of directions in sixths of a turn; 0 of an empty loop:
///
///   (sum over steps (6 a_jk + arg(u_k / (t_kj u_j))) + 6 K) / (2 pi),
///
/// with the directions u and t_kj = `direction_turn()`, the angle a_jk by which the lattice turns
/// on the step (a part of t_kj), and the angle K from -pi to pi by which a tangent turns that is
/// carried around the loop: the curvature inside. It is 1 around a point with five neighbors, -1
/// around one with seven. The indices of the triangles of a closed surface add up to 6 times its
/// Euler characteristic, and a loop has the sum of the triangles inside.
inline int orientation_index(const Lattice_view& view, const Node_loop& loop)
{
  constexpr float per_turn = 0.159154943f;
  float sum = 0;
  Phasor around{1, 0};
  loop.for_each_step([&](int j, int k) {
    const Phasor arrived = direction_turn(view, j, view, k) * axis_direction(view, j);
    sum += 6 * per_turn * turning_between(view, j, view, k) +
           turns_of(axis_direction(view, k) * conjugate(arrived));
    around = around * frame_turn(view.normals[j], view.normals[k]);
  });
  return loop.empty() ? 0 : static_cast<int>(std::lround(sum + 6 * turns_of(around)));
}

/// How many rows end inside the loop, of the direction in which most do; 0 of an empty loop, and of
/// one with an index other than 0, around which waves are not carried to themselves.
///
/// For each wave m of the node where the loop begins, the phases of the way and the residuals add
/// up to the whole number
///
///   b_m = sum over steps s (b_m' d_jk + arg(w_k,m' / (t_kj w_j)_m') / (2 pi)),
///
/// where m' is the wave of node k that m has become, which runs the same way (s = 1) or the
/// opposite way (s = -1). The Burgers vector has these products with the three wave vectors.
/// \returns the largest |b_m|
inline int dislocation(const Lattice_view& view, const Node_loop& loop)
{
  float sums[Waves::size] = {0, 0, 0};
  int sixths = 0; // of a turn, from the axis of the step's end to that of the first node
  loop.for_each_step([&](int j, int k) {
    const Lattice_step step = lattice_step(view, j, view, k, view.frame(k));
    const Waves arrived = carried(wave_edge(view, j, view, k, view.frame(k)), view.waves[j]);
    sixths += step.sixths;
    const float phases[] = {step.phases[0], step.phases[1], -step.phases[0] - step.phases[1]};
    for (int m = 0; m < Waves::size; ++m) {
      const float residual = turns_of(Phasor(view.waves[k].wave[m]) * conjugate(arrived.wave[m]));
      sums[(m + sixths) % Waves::size] += (sixths % 2 ? -1.f : 1.f) * (phases[m] + residual);
    }
  });
  if (sixths % 6 != 0) return 0;
  int most = 0;
  for (const float sum : sums) most = std::max(most, std::abs(static_cast<int>(std::lround(sum))));
  return most;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_DEFECTS_H
