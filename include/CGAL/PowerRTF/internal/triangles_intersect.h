// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether two triangles of a mesh meet in more than the vertices and edges that they share, decided
// by exact predicates.
#ifndef CGAL_POWER_RTF_INTERNAL_TRIANGLES_INTERSECT_H
#define CGAL_POWER_RTF_INTERNAL_TRIANGLES_INTERSECT_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <array>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

using Epick = Exact_predicates_inexact_constructions_kernel;

/// \param s, t the triangles' vertices, of any type that compares; distinct in each
/// \param p, q their points, not collinear in either
template <class Vertex>
bool triangles_intersect(const std::array<Vertex, 3>& s, const std::array<Epick::Point_3, 3>& p,
                         const std::array<Vertex, 3>& t, const std::array<Epick::Point_3, 3>& q)
{
  int shared = 0, i_s = 0, i_t = 0; // the last pair of corners with the same vertex
  bool s_is_shared[3] = {false, false, false}, t_is_shared[3] = {false, false, false};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (s[i] == t[j]) {
        ++shared;
        s_is_shared[i] = t_is_shared[j] = true;
        i_s = i;
        i_t = j;
      }
  const auto triangle = [](const std::array<Epick::Point_3, 3>& x)
  { return Epick::Triangle_3(x[0], x[1], x[2]); };
  const auto opposite_edge = [](const std::array<Epick::Point_3, 3>& x, int i)
  { return Epick::Segment_3(x[(i + 1) % 3], x[(i + 2) % 3]); };
  if (shared == 0) return do_intersect(triangle(p), triangle(q));
  if (shared == 1)
    return do_intersect(triangle(p), opposite_edge(q, i_t)) ||
           do_intersect(triangle(q), opposite_edge(p, i_s));
  if (shared == 3) return true;
  // a shared edge: the triangles overlap when they are coplanar and on the same side of it
  const int a = s_is_shared[0] ? (s_is_shared[1] ? 2 : 1) : 0; // the corners off the edge
  const int b = t_is_shared[0] ? (t_is_shared[1] ? 2 : 1) : 0;
  const auto &e = p[(a + 1) % 3], &f = p[(a + 2) % 3];
  return coplanar(e, f, p[a], q[b]) && coplanar_orientation(e, f, p[a], q[b]) == POSITIVE;
}

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_INTERNAL_TRIANGLES_INTERSECT_H
