// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for extract_restricted_delaunay.h.
#ifndef CGAL_POWER_RTF_EXTRACTION_EXTRACT_RESTRICTED_DELAUNAY_IMPL_H
#define CGAL_POWER_RTF_EXTRACTION_EXTRACT_RESTRICTED_DELAUNAY_IMPL_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/extraction/extract_restricted_delaunay.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/compat.h>

#include <CGAL/AABB_tree.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_with_circumcenter_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

class Restricted_delaunay_extractor {
public:
  Restricted_delaunay_extractor(const Surface& surface, const Samples& samples) : m_samples(samples)
  {
    m_facets.reserve(surface.triangles.size());
    for (const Triangle& t : surface.triangles) {
      const Kernel::Triangle_3 facet(to_point(surface.points[t[0]]), to_point(surface.points[t[1]]),
                                     to_point(surface.points[t[2]]));
      if (!facet.is_degenerate()) m_facets.push_back(facet); // others are on their neighbors' edges
    }
    m_tree.rebuild(m_facets.begin(), m_facets.end());
    Delaunay::Vertex_handle last; // each is near the one before
    for (const int s : spatial_order(samples.points)) {
      Cancellation::poll();
      const auto v = last == Delaunay::Vertex_handle()
                         ? m_delaunay.insert(to_point(samples.points[s]))
                         : m_delaunay.insert(to_point(samples.points[s]), last->cell());
      v->info() = s;
      last = v;
    }
  }

  Extracted_mesh run() const
  {
    Extracted_mesh result;
    result.points = m_samples.points;
    if (m_delaunay.dimension() < 2) return result;
    for (auto f = m_delaunay.finite_facets_begin(); f != m_delaunay.finite_facets_end(); ++f) {
      Cancellation::poll();
      if (dual_meets_surface(*f)) result.triangles.push_back(oriented(corners(*f)));
    }
    return result;
  }

private:
  using Kernel = Exact_predicates_inexact_constructions_kernel;
  using Point = Kernel::Point_3;
  using Vector = Kernel::Vector_3;
  using Vertex_base = Triangulation_vertex_base_with_info_3<int, Kernel>;
  using Cell_base = Delaunay_triangulation_cell_base_with_circumcenter_3<Kernel>;
  using Delaunay =
      Delaunay_triangulation_3<Kernel, Triangulation_data_structure_3<Vertex_base, Cell_base>>;
  using Facet = Delaunay::Facet;
  using Facets = std::vector<Kernel::Triangle_3>;
  using Primitive = AABB_triangle_primitive_3<Kernel, Facets::const_iterator>;
  using Tree = AABB_tree<AABB_traits_3<Kernel, Primitive>>;

  static Point to_point(const Vec3d& p) { return Point(p.x, p.y, p.z); }

  static bool is_finite(const Point& p)
  {
    return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
  }

  static std::array<Delaunay::Vertex_handle, 3> corners(const Facet& f)
  {
    // Counter-clockwise seen from the cell's fourth vertex; in a planar triangulation the cell is
    // the triangle itself.
    return {f.first->vertex(Delaunay::vertex_triple_index(f.second, 0)),
            f.first->vertex(Delaunay::vertex_triple_index(f.second, 1)),
            f.first->vertex(Delaunay::vertex_triple_index(f.second, 2))};
  }

  // The dual Voronoi edge: a segment, a ray where one of the cells is infinite (or so flat that its
  // circumcenter is), a line in a planar triangulation.
  bool dual_meets_surface(const Facet& f) const
  {
    const auto v = corners(f);
    const Vector a = v[1]->point() - v[0]->point(), b = v[2]->point() - v[0]->point(),
                 normal = cross_product(b, a);
    const double size =
        (std::max)({std::abs(normal.x()), std::abs(normal.y()), std::abs(normal.z())});
    if (!(size * size > 0)) return false; // collinear but for rounding
    const Vector axis = normal / size;    // a ray holds a second point
    if (m_delaunay.dimension() == 2) {
      const Vector to_center =
          cross_product(b.squared_length() * a - a.squared_length() * b, normal) /
          (2 * normal.squared_length());
      const Point center = v[0]->point() + to_center;
      return is_finite(center) && meets(Kernel::Line_3(center, axis));
    }
    const Facet mirror = m_delaunay.mirror_facet(f);
    Point here, there;
    const bool is_here = finite_center(f.first, here),
               is_there = finite_center(mirror.first, there);
    if (is_here && is_there) return meets(Kernel::Segment_3(here, there));
    if (is_here) return meets(Kernel::Ray_3(here, axis));
    if (is_there) return meets(Kernel::Ray_3(there, -axis));
    return false;
  }

  // Of a line, a ray or a segment that rounding may have left without direction.
  template <class Dual>
  bool meets(const Dual& dual) const
  {
    return !dual.is_degenerate() && m_tree.do_intersect(dual);
  }

  bool finite_center(Delaunay::Cell_handle c, Point& center) const
  {
    if (m_delaunay.is_infinite(c)) return false;
    const Point& p = c->vertex(0)->point();
    const Vector a = c->vertex(1)->point() - p, b = c->vertex(2)->point() - p,
                 d = c->vertex(3)->point() - p;
    if (CGAL::determinant(a, b, d) == 0) return false; // coplanar but for rounding
    center = m_delaunay.dual(c);
    return is_finite(center);
  }

  Triangle oriented(const std::array<Delaunay::Vertex_handle, 3>& v) const
  {
    Triangle t{v[0]->info(), v[1]->info(), v[2]->info()};
    const Vec3d& p = m_samples.points[t[0]];
    const Vec3d n = cross(m_samples.points[t[1]] - p, m_samples.points[t[2]] - p);
    const auto& normals = m_samples.normals;
    if (dot(n, normals[t[0]] + normals[t[1]] + normals[t[2]]) < 0) std::swap(t[1], t[2]);
    return t;
  }

  const Samples& m_samples;
  Facets m_facets;
  Tree m_tree;
  Delaunay m_delaunay;
};

} // namespace internal

CGAL_POWER_RTF_INLINE Extracted_mesh extract_restricted_delaunay(const Surface& surface,
                                                                 const Samples& samples,
                                                                 const Feature_samples& features)
{
  Extracted_mesh mesh = internal::Restricted_delaunay_extractor(surface, samples).run();
  mesh.sort_triangles(); // the triangulation visits them by the addresses of its cells
  for (Vec3d& p : mesh.points) p = surface.normalization.snapped(p);
  const int first = static_cast<int>(samples.size() - features.size());
  for (const Edge& e : features.edges) mesh.feature_edges.push_back({first + e[0], first + e[1]});
  return mesh;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXTRACTION_EXTRACT_RESTRICTED_DELAUNAY_IMPL_H
