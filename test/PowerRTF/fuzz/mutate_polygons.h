// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes a mesh into one that is likely to be hard: with points on each other, on edges and
// facets, facets that are turned, doubled, without area, fins, holes and more sheets than two at an
// edge.
#ifndef CGAL_POWER_RTF_TEST_FUZZ_MUTATE_POLYGONS_H
#define CGAL_POWER_RTF_TEST_FUZZ_MUTATE_POLYGONS_H

#include "../random_input.h"
#include "Polygons.h"
#include "engine.h"
#include "options_of.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace fuzz {

using random_input::Random;

class Polygons_mutator {
  Polygons& m_input;
  Random& m_random;

public:
  Polygons_mutator(Polygons& input, Random& random) : m_input(input), m_random(random) {}

  void mutate()
  {
    if (m_input.points.empty()) m_input.points.push_back(m_random.in_box());
    if (m_input.polygons.empty()) m_input.polygons.push_back({0, 0, 0});
    if (any_polygon().empty()) return remove();
    switch (m_random.integer(0, 11)) {
    case 0:
    case 1:
      return move();
    case 2:
      return snap();
    case 3:
      return turn();
    case 4:
      return duplicate();
    case 5:
      return remove();
    case 6:
      return split_edge();
    case 7:
      return add_fin();
    case 8:
      return replace_corner();
    case 9:
      return copy_all();
    case 10:
      return part_vertex();
    default:
      return scale();
    }
  }

private:
  using Polygon = std::vector<int>;

  template <class T>
  T& any(std::vector<T>& list)
  {
    return list[m_random.integer(0, int(list.size()) - 1)];
  }
  Vec3d& any_point() { return any(m_input.points); }
  Polygon& any_polygon() { return any(m_input.polygons); }
  bool has_room(std::size_t points, std::size_t polygons) const
  {
    return m_input.points.size() + points <= Polygons::max_points &&
           m_input.polygons.size() + polygons <= Polygons::max_polygons;
  }
  int add(const Vec3d& point)
  {
    m_input.points.push_back(point);
    return int(m_input.points.size()) - 1;
  }
  Vec3d point_of(int v) const
  {
    const auto& points = m_input.points;
    return v >= 0 && v < int(points.size()) ? points[v] : Vec3d{0, 0, 0};
  }

  void move()
  {
    Vec3d& p = any_point();
    const double size = std::ldexp(1, -m_random.integer(0, 50));
    if (m_random.integer(0, 1))
      p += m_random.in_box() * size;
    else
      for (double* x : {&p.x, &p.y, &p.z}) *x = std::round(*x * 4) / 4;
  }

  /// To another point, or onto the line, the segment or the triangle of others.
  void snap()
  {
    const Vec3d a = any_point(), b = any_point(), c = any_point();
    const double s = m_random.integer(0, 2) / 2., t = m_random.integer(0, 2) / 4.;
    any_point() = a + (b - a) * s + (c - a) * t;
  }

  void turn()
  {
    Polygon& polygon = any_polygon();
    std::reverse(polygon.begin(), polygon.end());
  }

  void duplicate()
  {
    if (!has_room(0, 1)) return;
    const Polygon copy = any_polygon();
    m_input.polygons.push_back(copy);
    if (m_random.integer(0, 1))
      std::rotate(m_input.polygons.back().begin(), m_input.polygons.back().end() - 1,
                  m_input.polygons.back().end());
  }

  void remove()
  {
    std::swap(any_polygon(), m_input.polygons.back());
    m_input.polygons.pop_back();
  }

  void split_edge()
  {
    Polygon& polygon = any_polygon();
    if (!has_room(1, 0) || polygon.size() >= Polygons::max_corners) return;
    const std::size_t k = m_random.integer(0, int(polygon.size()) - 1);
    const Vec3d a = point_of(polygon[k]), b = point_of(polygon[(k + 1) % polygon.size()]);
    polygon.insert(polygon.begin() + k + 1, add(a + (b - a) * (m_random.integer(0, 4) / 4.)));
  }

  /// A triangle on an edge.
  void add_fin()
  {
    if (!has_room(1, 1)) return;
    const Polygon polygon = any_polygon();
    const std::size_t k = m_random.integer(0, int(polygon.size()) - 1);
    const int tip = m_random.integer(0, 1) ? add(m_random.in_box())
                                           : m_random.integer(0, int(m_input.points.size()) - 1);
    m_input.polygons.push_back({polygon[(k + 1) % polygon.size()], polygon[k], tip});
  }

  void replace_corner()
  {
    any(any_polygon()) =
        m_random.integer(m_random.integer(0, 20) ? 0 : -1,
                         int(m_input.points.size()) - 1 + (m_random.integer(0, 20) ? 0 : 1));
  }

  /// All once more, apart or not, turned or not.
  void copy_all()
  {
    const std::size_t points = m_input.points.size(), polygons = m_input.polygons.size();
    if (!has_room(points, polygons)) return;
    const Vec3d shift = any_point() - any_point();
    const bool is_turned = m_random.integer(0, 1);
    for (std::size_t k = 0; k < points; ++k) add(m_input.points[k] + shift);
    for (std::size_t k = 0; k < polygons; ++k) {
      Polygon copy = m_input.polygons[k];
      for (int& v : copy) v += int(points);
      if (is_turned) std::reverse(copy.begin(), copy.end());
      m_input.polygons.push_back(copy);
    }
  }

  /// Gives a corner a vertex of its own at the same place.
  void part_vertex()
  {
    if (!has_room(1, 0)) return;
    int& v = any(any_polygon());
    v = add(point_of(v));
  }

  void scale()
  {
    const double factor = std::ldexp(1, m_random.integer(-3, 3));
    const int axis = m_random.integer(0, 2);
    for (Vec3d& p : m_input.points) (axis == 0 ? p.x : axis == 1 ? p.y : p.z) *= factor;
  }
};

} // namespace fuzz

/// The target's that includes this: changes polygons; what is none, byte by byte.
std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                    unsigned seed)
{
  auto input = fuzz::polygons_of(fuzz::text_of(data, size));
  if (!input) return LLVMFuzzerMutate(data, size, max_size);
  fuzz::Random random(seed);
  fuzz::Polygons_mutator mutator(*input, random);
  do {
    if (random.integer(0, 3) == 0)
      fuzz::mutate_options(*input, random);
    else
      mutator.mutate();
  } while (random.integer(0, 2) > 0);
  return fuzz::replace(data, size, max_size, fuzz::to_text(*input));
}

#endif // CGAL_POWER_RTF_TEST_FUZZ_MUTATE_POLYGONS_H
