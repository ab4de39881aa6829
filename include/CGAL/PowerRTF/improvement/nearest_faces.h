// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The faces of the whole mesh that are nearest to some points: those few that are far from it.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_NEAREST_FACES_H
#define CGAL_POWER_RTF_IMPROVEMENT_NEAREST_FACES_H

#include <CGAL/PowerRTF/geometry/Cell_marks.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/box_around.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/improvement/Face_blocks.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

inline constexpr double unknown_distance = std::numeric_limits<double>::max();

struct Far_point {
  Vec3d point;
  double reach;        ///< there is a face as near, or `unknown_distance`
  const Vec3d* normal; ///< faces that agree with it go first; null: all agree
};

/// Whether the normal of a triangle is about `normal`.
inline bool agrees(const Vec3d& normal, const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
  const Vec3d n = cross(b - a, c - a);
  return dot(n, normal) > Improvement_parameters::Projection::min_normal_cosine * length(n);
}

class Nearest_face_finder {
public:
  using Face = Working_mesh::Face;

  explicit Nearest_face_finder(const Star_mesh& mesh) : m(&mesh), m_blocks(mesh) {}

  /// The mesh has become another one.
  void forget() { m_blocks.add_all(); }

  /// Of each point. \pre the mesh has a face
  std::vector<Face> find(std::vector<Far_point> points)
  {
    std::vector<std::size_t> unknown;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (points[k].reach == unknown_distance) unknown.push_back(k);
    if (unknown.size() <= few)
      for (const std::size_t k : unknown) points[k].reach = some_distance(points[k]);
    const std::optional<Reaches> reaches = find_reaches(points);
    const auto may_be_nearer = [&](const Box3<double>& box) {
      return !reaches || is_in_reach(box, points, *reaches);
    };
    const std::vector<Face> faces =
        m_blocks.find(may_be_nearer, [&](Face f) { return may_be_nearer(m_blocks.box(f)); });
    const Facet_tree tree(
        faces.size(), [&](int k) { return m->points(topology().halfedge(faces[k])); }, {},
        m->concurrency());
    std::vector<Face> nearest(points.size());
    for_each_chunk(m->concurrency(), int(points.size()), 16, [&](int begin, int end) {
      for (int k = begin; k < end; ++k) {
        const Far_point& p = points[k];
        int f = -1;
        if (p.normal) f = tree.nearest(p.point, *p.normal, Projection::min_normal_cosine, -1).facet;
        if (f < 0) f = tree.nearest(p.point).facet; // none agrees: any
        nearest[k] = faces[f];
      }
    });
    return nearest;
  }

private:
  using Projection = Improvement_parameters::Projection;

  static constexpr std::size_t few = 64; // points: each is compared with many faces

  // Cubes around points, up to where their nearest faces are.
  struct Reaches {
    Packed_tree_layout tree;
    std::vector<Child_boxes> nodes;
    Cell_marks cells;
  };

  const Working_mesh::Mesh& topology() const { return m->working().mesh; }
  int size() const { return int(topology().num_faces()); }

  // To the nearest of some faces, of those that agree: that to all is no larger.
  double some_distance(const Far_point& p) const
  {
    constexpr int stride = 16;
    return reduce(
        m->concurrency(), (size() + stride - 1) / stride, unknown_distance,
        [&](double& least, int k) {
          const Face f(k * stride);
          if (topology().is_removed(f)) return;
          const auto [a, b, c] = m->points(topology().halfedge(f));
          const double d = length(nearest_point_on_triangle(p.point, a, b, c) - p.point);
          if (d < least && (!p.normal || agrees(*p.normal, a, b, c))) least = d;
        },
        [](double& least, double part) { least = std::min(least, part); });
  }

  // None where not all have an end: all faces count.
  std::optional<Reaches> find_reaches(const std::vector<Far_point>& points) const
  {
    const auto is_known = [](const Far_point& p) { return p.reach < unknown_distance; };
    if (!std::all_of(points.begin(), points.end(), is_known)) return {};
    constexpr double rounding = 1e-6; // to single precision
    const int size = static_cast<int>(points.size());
    std::vector<Box3<double>> boxes(size);
    for_each_index(m->concurrency(), size, [&](int k) {
      const double r = (1 + rounding) * points[k].reach + rounding;
      const Vec3d p = points[k].point, reach{r, r, r};
      boxes[k] = {p - reach, p + reach};
    });
    const Packed_tree_layout tree(size);
    Cell_marks cells(box_around(m->concurrency(), size, boxes));
    for (const Box3<double>& box : boxes) cells.add(box);
    return Reaches{tree, child_boxes(tree, [&](int k) { return boxes[k]; }), std::move(cells)};
  }

  // Whether a face in the box may be nearer to one of the points than what was found.
  static bool is_in_reach(const Box3<double>& box, const std::vector<Far_point>& points,
                          const Reaches& reaches)
  {
    if (!reaches.cells.touches(box)) return false;
    bool is_near = false;
    visit_near(
        reaches.tree, reaches.nodes.data(), Box_query(box), [&] { return is_near ? -1.f : 0.f; },
        [&](int k) {
          const double reach = points[k].reach;
          is_near = clearly_less * squared_distance(box, points[k].point) <= reach * reach;
        });
    return is_near;
  }

  const Star_mesh* m;
  Face_blocks m_blocks;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_NEAREST_FACES_H
