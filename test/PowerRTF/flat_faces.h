// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How flat the flat faces of a part stay: the area of a mesh that lies over flat faces of another
// one without being parallel to them.
#ifndef CGAL_POWER_RTF_TEST_FLAT_FACES_H
#define CGAL_POWER_RTF_TEST_FLAT_FACES_H

#include "exact_judge.h"

#include <CGAL/PowerRTF/internal/compat.h>

#include <CGAL/AABB_tree.h>

#include <cmath>

namespace judge {

inline double angle_in_degrees(const Kernel::Vector_3& a, const Kernel::Vector_3& b)
{
  const Kernel::Vector_3 c = CGAL::cross_product(a, b);
  return std::atan2(std::sqrt(c.squared_length()), a * b) * 180 / CGAL_PI;
}

/// The facets of a mesh that belong to flat faces.
class Flat_faces {
  using Primitive = CGAL::PowerRTF::internal::AABB_triangle_primitive_3<
      Kernel, std::vector<Kernel::Triangle_3>::iterator>;
  using Tree = CGAL::AABB_tree<CGAL::PowerRTF::internal::AABB_traits_3<Kernel, Primitive>>;

  static constexpr std::size_t none = std::size_t(-1);
  std::vector<Kernel::Triangle_3> m_triangles;
  std::vector<std::size_t> m_face; // of each facet: its flat face
  Tree m_tree;

public:
  /// A flat face: connected facets in one plane that together are wider than `least_width`; a strip
  /// of length l and width w is 2 l w / (2 l + 2 w) wide.
  Flat_faces(const Mesh& mesh, double least_width)
  {
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) m_triangles.push_back(mesh.triangle(f));
    mark_flat_facets(mesh, least_width);
    m_tree.rebuild(m_triangles.begin(), m_triangles.end());
  }

  double area() const
  {
    double sum = 0;
    for (std::size_t f = 0; f < m_triangles.size(); ++f)
      if (m_face[f] != none) sum += std::sqrt(m_triangles[f].squared_area());
    return sum;
  }

  struct Tilted_area {
    double over = 0;   ///< nearest to a flat face, in parts of facets
    double inside = 0; ///< of that: in facets of which all parts are nearest to the same face
  };

  /// How much of `mesh` is nearest to a flat face, with a normal more than `max_degrees` off that
  /// face's. Each facet is looked at in 16 parts.
  Tilted_area tilted_area(const Mesh& mesh, double max_degrees = 0.5) const
  {
    const int steps = 4; // along each side of a facet
    Tilted_area result;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
      const Kernel::Triangle_3 t = mesh.triangle(f);
      std::map<std::size_t, int> parts; // of each flat face
      int tilted = 0;
      const auto look_at = [&](int i, int j) { // barycentric coordinates, times 3 * steps
        const double u = i / (3. * steps), v = j / (3. * steps);
        const Point p = CGAL::barycenter(t[0], 1 - u - v, t[1], u, t[2], v);
        const std::size_t g = m_tree.closest_point_and_primitive(p).second - m_triangles.begin();
        if (m_face[g] == none) return;
        ++parts[m_face[g]];
        tilted += angle_in_degrees(normal(t), normal(m_triangles[g])) > max_degrees;
      };
      for (int i = 0; i < steps; ++i)
        for (int j = 0; i + j < steps; ++j) {
          look_at(3 * i + 1, 3 * j + 1);
          if (i + j + 1 < steps) look_at(3 * i + 2, 3 * j + 2);
        }
      const double area = std::sqrt(t.squared_area()) * tilted / (steps * steps);
      result.over += area;
      if (parts.size() == 1 && parts.begin()->second == steps * steps) result.inside += area;
    }
    return result;
  }

private:
  static Kernel::Vector_3 normal(const Kernel::Triangle_3& t)
  {
    return CGAL::cross_product(t[1] - t[0], t[2] - t[0]);
  }

  void mark_flat_facets(const Mesh& mesh, double least_width)
  {
    const double same_plane = 1e-3; // degrees
    struct Edge {
      std::size_t facet;
      double length;
    };
    std::map<std::pair<std::size_t, std::size_t>, std::vector<Edge>> edges;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f)
      for (int i = 0; i < 3; ++i) {
        const std::size_t a = mesh.facets[f][i], b = mesh.facets[f][(i + 1) % 3];
        const double length = std::sqrt(CGAL::squared_distance(mesh.points[a], mesh.points[b]));
        edges[std::minmax(a, b)].push_back({f, length});
      }
    const auto in_one_plane = [&](const std::vector<Edge>& e) {
      return e.size() == 2 && angle_in_degrees(normal(m_triangles[e[0].facet]),
                                               normal(m_triangles[e[1].facet])) < same_plane;
    };
    Classes faces(mesh.facets.size());
    for (const auto& [ends, sides] : edges)
      if (in_one_plane(sides)) faces.unite(sides[0].facet, sides[1].facet);
    std::map<std::size_t, double> area, perimeter;
    for (const auto& [ends, sides] : edges)
      if (!in_one_plane(sides))
        for (const Edge& e : sides) perimeter[faces.find(e.facet)] += e.length;
    for (std::size_t f = 0; f < m_triangles.size(); ++f)
      area[faces.find(f)] += std::sqrt(m_triangles[f].squared_area());
    for (std::size_t f = 0; f < m_triangles.size(); ++f) {
      const std::size_t face = faces.find(f);
      m_face.push_back(2 * area[face] > least_width * perimeter[face] ? face : none);
    }
  }
};

} // namespace judge

#endif // CGAL_POWER_RTF_TEST_FLAT_FACES_H
