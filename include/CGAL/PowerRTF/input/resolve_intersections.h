// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles cut where they meet others, so that they share edges and vertices there and meet in
// nothing else. The cuts are exact; then their points are rounded, which may make triangles meet
// anew: so they are cut again, until they do not, or all is done on a coarser grid (iterated snap
// rounding).
#ifndef CGAL_POWER_RTF_INPUT_RESOLVE_INTERSECTIONS_H
#define CGAL_POWER_RTF_INPUT_RESOLVE_INTERSECTIONS_H

#include <CGAL/PowerRTF/geometry/self_intersections.h>
#include <CGAL/PowerRTF/input/Triangle_set.h>
#include <CGAL/PowerRTF/input/near_borders.h>
#include <CGAL/PowerRTF/internal/compat.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The parts of one triangle that segments cut it into.
class Cut_triangle {
public:
  using Exact = Exact_predicates_exact_constructions_kernel;
  using Point = Exact::Point_3;
  using Corners = std::array<Point, 3>;

  explicit Cut_triangle(const Corners& corners) : m_corners(corners)
  {
    const Exact::Vector_3 n = cross_product(corners[1] - corners[0], corners[2] - corners[0]);
    for (int axis = 1; axis < 3; ++axis) // any axis that is not along the triangle would do
      if (abs(n[axis]) > abs(n[m_axis])) m_axis = axis;
    m_is_turned = n[m_axis] < 0;
    m_normal = n;
    for (const Point& p : corners) m_cdt.insert(flat(p));
    for (int i = 0; i < 3; ++i) add(corners[i], corners[(i + 1) % 3]);
  }

  /// Points of the triangle.
  void add(const Point& p, const Point& q)
  {
    if (p == q)
      m_cdt.insert(flat(p));
    else
      m_cdt.insert_constraint(flat(p), flat(q));
  }

  /// Calls `f` with the corners of each part, in the triangle's orientation.
  template <class F>
  void for_each_part(const F& f) const
  {
    for (auto it = m_cdt.finite_faces_begin(); it != m_cdt.finite_faces_end(); ++it) {
      Corners c;
      for (int i = 0; i < 3; ++i) c[i] = lifted(it->vertex(i)->point());
      if (m_is_turned) std::swap(c[1], c[2]);
      f(c);
    }
  }

private:
  using Flat_point = Exact::Point_2;
  using Cdt = Constrained_triangulation_plus_2<
      Constrained_Delaunay_triangulation_2<Exact, Default, Exact_intersections_tag>>;

  Flat_point flat(const Point& p) const { return {p[(m_axis + 1) % 3], p[(m_axis + 2) % 3]}; }

  /// The point of the triangle's plane above or below `q`.
  Point lifted(const Flat_point& q) const
  {
    for (const Point& p : m_corners)
      if (flat(p) == q) return p;
    const int x = (m_axis + 1) % 3, y = (m_axis + 2) % 3;
    const Point& o = m_corners[0];
    std::array<Exact::FT, 3> result;
    result[x] = q.x();
    result[y] = q.y();
    result[m_axis] = o[m_axis] - (m_normal[x] * (q.x() - o[x]) + m_normal[y] * (q.y() - o[y])) /
                                     m_normal[m_axis];
    return {result[0], result[1], result[2]};
  }

  Corners m_corners;
  Exact::Vector_3 m_normal;
  int m_axis = 0;
  bool m_is_turned = false;
  Cdt m_cdt;
};

/// Cuts all triangles where they meet others, once.
class Triangle_cutter {
public:
  using Exact = Cut_triangle::Exact;
  using Point = Cut_triangle::Point;
  using Pairs = std::vector<std::pair<int, int>>;

  /// \param grid of the points of the result
  Triangle_cutter(const Triangle_set& set, double grid) : m_set(set), m_grid(grid) {}

  Triangle_set run(const Pairs& pairs)
  {
    for (const auto& [f, g] : pairs)
      if (f != g) cut(f, g);
    std::vector<char> is_flat(m_set.triangles.size(), 0);
    for (const auto& [f, g] : pairs)
      if (f == g) is_flat[f] = 1; // without area: it is the edges of others
    for (int f = 0; f < static_cast<int>(m_set.triangles.size()); ++f) {
      if (is_flat[f]) continue;
      const auto parts = m_parts.find(f);
      const auto add_part = [&](const Cut_triangle::Corners& c) { add(c); };
      if (parts == m_parts.end())
        add(corners(f));
      else
        parts->second.for_each_part(add_part);
    }
    return merged();
  }

private:
  Cut_triangle::Corners corners(int f) const
  {
    Cut_triangle::Corners result;
    for (int i = 0; i < 3; ++i) {
      const Vec3d& p = m_set.points[m_set.triangles[f][i]];
      result[i] = Point(p.x, p.y, p.z);
    }
    return result;
  }

  Cut_triangle& parts_of(int f)
  {
    const auto found = m_parts.find(f);
    return found != m_parts.end() ? found->second : m_parts.emplace(f, corners(f)).first->second;
  }

  void cut(int f, int g)
  {
    const auto triangle = [](const Cut_triangle::Corners& c) {
      return Exact::Triangle_3(c[0], c[1], c[2]);
    };
    const auto common = intersection(triangle(corners(f)), triangle(corners(g)));
    if (!common) return;
    const auto add = [&](const Point& p, const Point& q) {
      parts_of(f).add(p, q);
      parts_of(g).add(p, q);
    };
    const auto add_polygon = [&](const auto& polygon, std::size_t size) {
      for (std::size_t i = 0; i < size; ++i)
        add(polygon[static_cast<int>(i)], polygon[static_cast<int>((i + 1) % size)]);
    };
    if (const Point* p = get_if<Point>(*common))
      add(*p, *p);
    else if (const auto* s = get_if<Exact::Segment_3>(*common))
      add(s->source(), s->target());
    else if (const auto* t = get_if<Exact::Triangle_3>(*common))
      add_polygon(*t, 3);
    else if (const auto* polygon = get_if<std::vector<Point>>(*common))
      add_polygon(*polygon, polygon->size());
  }

  void add(const Cut_triangle::Corners& corners)
  {
    Triangle t;
    for (int i = 0; i < 3; ++i) {
      const Point& p = corners[i];
      const auto number = [](const Exact::FT& x) { return CGAL::to_double(CGAL::exact(x)); };
      t[i] = static_cast<int>(m_result.points.size());
      m_result.points.push_back(snapped({number(p.x()), number(p.y()), number(p.z())}, m_grid));
    }
    m_result.triangles.push_back(t);
  }

  /// The result with vertices at the same place merged, without triangles that are an edge or that
  /// there are already.
  Triangle_set merged()
  {
    const std::vector<int> vertex = first_of_equal_points(m_result.points);
    std::set<Triangle> seen;
    Triangle_set result{std::move(m_result.points), {}};
    for (Triangle t : m_result.triangles) {
      for (int& v : t) v = vertex[v];
      Triangle key = t;
      std::sort(key.begin(), key.end());
      if (key[0] != key[1] && key[1] != key[2] && seen.insert(key).second)
        result.triangles.push_back(t);
    }
    return result;
  }

  const Triangle_set& m_set;
  double m_grid;
  std::map<int, Cut_triangle> m_parts;
  Triangle_set m_result;
};

/// Cuts the triangles until they meet in shared edges and vertices only.
/// \param grid coordinates of the result are multiples of it
/// \returns the number of pairs that met in more
/// \throws Invalid_input_error it could not be done
inline std::size_t resolve_intersections(Triangle_set& set, double grid, Concurrency concurrency)
{
  // A finer grid keeps points apart that meant the same one; a coarser one than the last is visible
  // in floats.
  constexpr double finest_grid = 0x1p-32, coarsening = 0x1p4, coarsest_grid = 0x1p-24;
  constexpr int max_passes = 4;         // mostly 1 or 2 do
  constexpr std::size_t max_growth = 2; // sheets that are nearly one cut each other ever finer
  const auto pairs_of = [&](const Triangle_set& s) {
    return Intersecting_pairs<Soup_triangles>({s.points, s.triangles}, concurrency)
        .find(boost::irange(0, static_cast<int>(s.triangles.size())));
  };
  const auto found = pairs_of(set);
  if (found.empty()) return 0;
  for (double rounding = (std::max)(grid, finest_grid); rounding <= coarsest_grid;
       rounding *= coarsening) {
    auto pairs = found;
    Triangle_set cut = set;
    for (int pass = 0; pass < max_passes && !pairs.empty(); ++pass) {
      if (pairs.size() > max_growth * found.size()) break;
      cut = Triangle_cutter(cut, rounding).run(pairs);
      pairs = pairs_of(cut);
    }
    if (!pairs.empty()) continue;
    set = std::move(cut);
    return found.size();
  }
  throw Invalid_input_error(std::to_string(found.size()) +
                            " pairs of facets intersect, and still some after they have been cut "
                            "where they meet, as where sheets are nearly one; intersections = wrap "
                            "makes a closed surface of any facets");
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INPUT_RESOLVE_INTERSECTIONS_H
