// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stars of a triangle mesh whose vertices lie on a surface, as plain arrays.
#ifndef CGAL_POWER_RTF_SMOOTHING_STAR_VIEW_H
#define CGAL_POWER_RTF_SMOOTHING_STAR_VIEW_H

#include <CGAL/PowerRTF/geometry/Surface_descent.h>
#include <CGAL/PowerRTF/geometry/snapped.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>

#include <vector>

namespace CGAL::PowerRTF::internal {

/// What is known of a vertex: flags.
enum Star_kind : unsigned char { is_movable_kind = 1, is_on_feature_kind = 2 };

/// Non-owning. Only the vertices that may move have spokes: the edges to their neighbors, all the
/// way around. Triangle k of such a star has the spokes k and k + 1.
struct Star_view {
  using Vertex = int;

  /// The edge (a, b) of a triangle across from the center of the star, counter-clockwise.
  struct Corner {
    Vec3d a, b;
    int vertex_a, vertex_b;
  };
  class Star;

  int size = 0;                         ///< vertices
  const int* first = nullptr;           ///< spoke of each vertex, and the end
  const int* neighbors = nullptr;       ///< by spoke
  const unsigned char* kinds = nullptr; ///< flags of `Star_kind`
  // on the surface, or over it:
  Vec3d* points = nullptr;
  Vec3d* normals = nullptr;
  int* facets = nullptr;
  double* heights = nullptr;
  Surface_descent surface;
  double grid = 0; ///< of the points' coordinates; 0: none

  CGAL_POWER_RTF_HD const Vec3d& point(int v) const { return points[v]; }
  CGAL_POWER_RTF_HD const Vec3d& normal(int v) const { return normals[v]; }
  CGAL_POWER_RTF_HD int facet(int v) const { return facets[v]; }
  CGAL_POWER_RTF_HD double height(int v) const { return heights[v]; }
  CGAL_POWER_RTF_HD bool is_movable(int v) const { return kinds[v] & is_movable_kind; }
  CGAL_POWER_RTF_HD bool is_on_feature(int v) const { return kinds[v] & is_on_feature_kind; }
  CGAL_POWER_RTF_HD Star star(int v) const;

  /// The place on the surface to which `v` would go.
  CGAL_POWER_RTF_HD Surface_place project(int v, const Vec3d& p) const
  {
    Surface_place place = surface.project(p - height(v) * normals[v], normals[v], facets[v]);
    place.point += height(v) * place.normal;
    return place;
  }

  CGAL_POWER_RTF_HD void move(int v, const Surface_place& place) const
  {
    set_point(v, place.point);
    normals[v] = place.normal;
    facets[v] = place.facet;
  }

  /// Moves `v`, off the surface too, if a place of the surface agrees.
  CGAL_POWER_RTF_HD void move_off(int v, const Vec3d& p) const
  {
    const Surface_place place = surface.project(p, normals[v], facets[v]);
    if (place.facet < 0) return;
    move(v, place);
    set_point(v, p);
    heights[v] = dot(p - place.point, place.normal);
  }

  /// The spoke after spoke `k` of `v`.
  CGAL_POWER_RTF_HD int next_spoke(int v, int k) const
  {
    return k + 1 < first[v + 1] ? k + 1 : first[v];
  }

private:
  CGAL_POWER_RTF_HD void set_point(int v, const Vec3d& p) const
  {
    points[v] = grid > 0 ? snapped(p, grid) : p;
  }
};

class Star_view::Star {
public:
  CGAL_POWER_RTF_HD Star(const Star_view& mesh, int center) : m(mesh), m_center(center) {}

  /// Calls `f(corner)` for all of its triangles.
  template <class F>
  CGAL_POWER_RTF_HD void for_each(const F& f) const
  {
    for (int k = m.first[m_center]; k < m.first[m_center + 1]; ++k) {
      const int a = m.neighbors[m.next_spoke(m_center, k)], b = m.neighbors[k];
      f(Corner{m.points[a], m.points[b], a, b});
    }
  }

private:
  const Star_view& m;
  int m_center;
};

CGAL_POWER_RTF_HD inline Star_view::Star Star_view::star(int v) const { return {*this, v}; }

/// What a `Star_view` needs of the mesh, of all vertices or of some.
struct Flat_stars {
  bool are_all = true;
  std::vector<int> vertices; ///< of which they are, sorted, if not of all
  Unset_vector<int> first, neighbors;
  Unset_vector<unsigned char> kinds;
  Unset_vector<Vec3d> points, normals;
  Unset_vector<int> facets;
  Unset_vector<double> heights;

  int size() const { return static_cast<int>(points.size()); }
};

/// What sweeps make of all vertices.
struct Swept_vertices {
  Unset_vector<Vec3d> points, normals;
  Unset_vector<int> facets;
  Unset_vector<double> heights;
  std::vector<int> doubtful; ///< vertices, sorted; see `Find_doubtful_stars`

  int size() const { return static_cast<int>(points.size()); }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_STAR_VIEW_H
