// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface in the order of packed trees, and what is asked of it: projections (Section 4.2.2,
// with all facets as candidates instead of those at the nearest vertices; NVISPC as in Section 4.3)
// and attributes.
#ifndef CGAL_POWER_RTF_GEOMETRY_SURFACE_VIEW_H
#define CGAL_POWER_RTF_GEOMETRY_SURFACE_VIEW_H

#include <CGAL/PowerRTF/geometry/nearest_facet.h>

namespace CGAL::PowerRTF {

/// 48 bytes in single precision: three loads.
template <class Real>
struct alignas(16) Facet_corners {
  Vec3<Real> a, b, c, normal;
};

template <class Real>
CGAL_POWER_RTF_HD Facet_corners<Real> facet_corners(const Vec3<Real>& a, const Vec3<Real>& b,
                                                    const Vec3<Real>& c)
{
  return {a, b, c, normalized(cross(b - a, c - a))};
}

namespace internal {

/// Where a tree has a facet with these corners.
CGAL_POWER_RTF_HD inline Vec3d center_of(const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  return (a + b + c) * (1.0 / 3);
}

/// For a tree's nodes.
struct Box_of_facet {
  const Facet_corners<double>* facets;

  CGAL_POWER_RTF_HD Box3<double> operator()(int place) const
  {
    const Facet_corners<double>& f = facets[place];
    Box3<double> box{f.a, f.a};
    box.add(f.b);
    box.add(f.c);
    return box;
  }
};

} // namespace internal

template <class Real>
struct alignas(16) Vertex_attributes {
  Vec3<Real> normal;
  Real density;
};

/// Non-owning. A facet and a vertex are named by their places in the trees.
template <class Real>
struct Surface_view {
  const Facet_corners<Real>* facets = nullptr;
  const int* facet_vertices = nullptr; ///< three per facet
  const int* patches = nullptr;        ///< per facet; null: all are of one
  const Child_boxes* facet_nodes = nullptr;
  Packed_tree_layout facet_tree;

  const Vertex_attributes<Real>* attributes = nullptr; ///< per vertex
  // For the paper's preset alone:
  const Vec3<Real>* vertices = nullptr;
  const Child_boxes* vertex_nodes = nullptr;
  Packed_tree_layout vertex_tree;
  const int* first_facet = nullptr; ///< of a vertex in `vertex_facets`
  const int* vertex_facets = nullptr;
  /// The `near_vertices` vertices nearest to each, itself first; -1: the surface has no more.
  const int* near_lists = nullptr;
  /// Distance of each to the last on its list: all vertices that are nearer are on it.
  const Real* near_reach = nullptr;
  static constexpr int near_vertices = 64;
};

/// A point that is to be projected onto the facets of one patch whose normals make less than Theta
/// with its own.
template <class Real>
class Facet_query {
public:
  /// `hint`: a facet of the patch; -1: all patches count.
  CGAL_POWER_RTF_HD Facet_query(const Surface_view<Real>& view, const Vec3<Real>& p,
                                const Vec3<Real>& normal, Real cos_angle, int hint)
      : m_view(view), m_point(p), m_normal(normal), m_cos_angle(cos_angle),
        m_patch(view.patches && hint >= 0 ? view.patches[hint] : -1)
  {}

  /// Its nearest point on the facet at `place`; facet -1 where that one does not count.
  CGAL_POWER_RTF_HD Surface_point<Real> onto(int place) const
  {
    if (m_patch >= 0 && m_view.patches[place] != m_patch) return {};
    const Facet_corners<Real> f = m_view.facets[place];
    if (m_cos_angle > -1 && !(dot(f.normal, m_normal) > m_cos_angle)) return {};
    const Vec3<Real> q = nearest_point_on_triangle(m_point, f.a, f.b, f.c);
    return {q, place, squared_length(q - m_point)};
  }

private:
  const Surface_view<Real>& m_view;
  Vec3<Real> m_point, m_normal;
  Real m_cos_angle;
  int m_patch;
};

/// Whether a projection is nearer than the best one so far; the lower key decides between equals.
template <class Real>
CGAL_POWER_RTF_HD inline bool is_nearer(const Surface_point<Real>& x, int key,
                                        const Surface_point<Real>& best, int best_key)
{
  if (x.facet < 0) return false;
  return best.facet < 0 || x.squared_distance < best.squared_distance ||
         (x.squared_distance == best.squared_distance && key < best_key);
}

// The functions below that take lanes do the work in one thread, whatever the lanes; for some kinds
// of lanes there are versions that share it.

/// The nearest point on the facets of the patch of `hint`, a facet that is probably near (-1: on
/// all facets), whose normals make less than Theta with `normal` (`cos_angle`: its cosine; -2: all
/// do). `facet` is -1 where none agrees.
template <class Real, class Lanes>
CGAL_POWER_RTF_HD inline Surface_point<Real>
project_to_nearest_facet(const Surface_view<Real>& view, const Vec3<Real>& p,
                         const Vec3<Real>& normal, Real cos_angle, int hint, Lanes)
{
  const Facet_query<Real> query(view, p, normal, cos_angle, hint);
  Surface_point<Real> best;
  float bound = 3e38f;
  const auto test = [&](int place) {
    const Surface_point<Real> x = query.onto(place);
    if (!is_nearer(x, place, best, best.facet)) return;
    best = x;
    bound = bound_of(x.squared_distance);
  };
  if (hint >= 0) test(hint);
  visit_near(
      view.facet_tree, view.facet_nodes, Point_query(p), [&]() { return bound; },
      [&](int place) {
        if (place != hint) test(place);
      });
  return best;
}

/// The largest number of vertices that one search in the tree finds.
constexpr int max_near_vertices = 64;

/// Writes the `k` vertices nearest to `p`, at most 64, by increasing distance, equal distances by
/// place. Returns their number.
template <class Real>
CGAL_POWER_RTF_HD inline int nearest_vertices(const Surface_view<Real>& view, const Vec3<Real>& p,
                                              int k, int* found)
{
  Real distances[max_near_vertices] = {};
  k = k < view.vertex_tree.items ? k : view.vertex_tree.items;
  k = k < max_near_vertices ? k : max_near_vertices;
  if (k <= 0) return 0;
  Nearest_items<Real> nearest{k, distances, found};
  visit_near(
      view.vertex_tree, view.vertex_nodes, Point_query(p),
      [&]() { return nearest.is_full() ? bound_of(nearest.farthest()) : 3e38f; },
      [&](int v) {
        const Real d = squared_length(view.vertices[v] - p);
        if (nearest.takes(d, v)) nearest.insert(d, v);
      });
  return nearest.count;
}

/// The paper's projection: onto the facets at the `k` nearest vertices (Section 4.2.2).
template <class Real, class Lanes>
CGAL_POWER_RTF_HD inline Surface_point<Real>
project_near_vertices(const Surface_view<Real>& view, const Vec3<Real>& p, const Vec3<Real>& normal,
                      Real cos_angle, int k, int hint, Lanes)
{
  const Facet_query<Real> query(view, p, normal, cos_angle, hint);
  int near[max_near_vertices];
  const int count = nearest_vertices(view, p, k, near);
  Surface_point<Real> best; // the first of equal ones
  for (int l = 0; l < count; ++l)
    for (int at = view.first_facet[near[l]]; at < view.first_facet[near[l] + 1]; ++at) {
      const Surface_point<Real> x = query.onto(view.vertex_facets[at]);
      if (is_nearer(x, 0, best, 0)) best = x;
    }
  return best;
}

/// Normal and density interpolated over the facet of a sample.
template <class Real>
CGAL_POWER_RTF_HD inline Vertex_attributes<Real> attributes_of_facet(const Surface_view<Real>& view,
                                                                     const Vec3<Real>& p, int facet)
{
  const Facet_corners<Real> f = view.facets[facet];
  Real beta, gamma;
  barycentric_coordinates(p, f.a, f.b, f.c, beta, gamma);
  const Real alpha = 1 - beta - gamma;
  const Vertex_attributes<Real> a = view.attributes[view.facet_vertices[3 * facet]];
  const Vertex_attributes<Real> b = view.attributes[view.facet_vertices[3 * facet + 1]];
  const Vertex_attributes<Real> c = view.attributes[view.facet_vertices[3 * facet + 2]];
  const Vec3<Real> mean = alpha * a.normal + beta * b.normal + gamma * c.normal;
  return {squared_length(mean) > Real(1e-6) ? normalized(mean) : f.normal,
          alpha * a.density + beta * b.density + gamma * c.density};
}

/// The paper's means (Section 4.3) over the first of `count` >= 1 vertices, of which `of(l)` is the
/// l-th nearest, as far as their normals agree with the mean normal of the three nearest.
template <class Real, class Of>
CGAL_POWER_RTF_HD inline Vertex_attributes<Real>
mean_attributes(int count, Of of, int normal_neighbors, int density_neighbors, Real cos_angle)
{
  Vec3<Real> basic{0, 0, 0}, sum{0, 0, 0};
  for (int l = 0; l < count && l < 3; ++l) basic += of(l).normal;
  basic = normalized(basic);
  Real densities = 0;
  int compatible = 0;
  for (int l = 0; l < count; ++l) {
    const Vertex_attributes<Real> v = of(l);
    if (!(dot(basic, v.normal) > cos_angle)) continue;
    if (l < normal_neighbors) sum += v.normal;
    if (l < density_neighbors) {
      densities += v.density;
      ++compatible;
    }
  }
  const Vertex_attributes<Real> nearest = of(0);
  return {squared_length(sum) > 0 ? normalized(sum) : nearest.normal,
          compatible > 0 ? densities / compatible : nearest.density};
}

/// The paper's means over the k_n and k_d nearest vertices of the patch of `facet`; over the facet
/// when there is none.
template <class Real, class Lanes>
CGAL_POWER_RTF_HD inline Vertex_attributes<Real>
attributes_near_vertices(const Surface_view<Real>& view, const Vec3<Real>& p, int facet,
                         int normal_neighbors, int density_neighbors, Real cos_angle, Lanes)
{
  int near[max_near_vertices];
  int k = normal_neighbors > density_neighbors ? normal_neighbors : density_neighbors;
  if (k < 3) k = 3;
  int count = nearest_vertices(view, p, k, near);
  if (view.patches) {
    const int all = count, patch = view.patches[facet];
    count = 0;
    for (int l = 0; l < all; ++l)
      if (view.patches[view.vertex_facets[view.first_facet[near[l]]]] == patch)
        near[count++] = near[l];
    if (count == 0) return attributes_of_facet(view, p, facet);
  }
  return mean_attributes<Real>(
      count, [&](int l) { return view.attributes[near[l]]; }, normal_neighbors, density_neighbors,
      cos_angle);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SURFACE_VIEW_H
