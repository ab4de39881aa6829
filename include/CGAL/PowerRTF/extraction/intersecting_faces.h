// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which faces of a mesh intersect others, decided by exact predicates: all of them, or those that
// have changed.
#ifndef CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H
#define CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H

#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/triangles_intersect.h>

#include <CGAL/Bbox_3.h>
#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

/// A mesh's faces as triangles for exact predicates.
class Face_triangles
{
public:
  using Mesh = Working_mesh::Mesh;
  using Vertex = Working_mesh::Vertex;
  using Face = Mesh::Face_index;
  using Corners = std::array<Vertex, 3>;
  using Points = std::array<Working_mesh::Point, 3>;

  explicit Face_triangles(const Mesh& mesh) : m_mesh(mesh) {}

  Corners corners(Face f) const
  {
    const auto h = m_mesh.halfedge(f);
    return {m_mesh.source(h), m_mesh.target(h), m_mesh.target(m_mesh.next(h))};
  }
  Points points(const Corners& t) const
  { return {m_mesh.point(t[0]), m_mesh.point(t[1]), m_mesh.point(t[2])}; }
  static Bbox_3 box(const Points& p) { return p[0].bbox() + p[1].bbox() + p[2].bbox(); }
  static bool is_degenerate(const Points& p) { return collinear(p[0], p[1], p[2]); }

  /// Whether the faces, neither of them degenerate, meet in more than what they share.
  bool intersect(Face f, Face g) const
  {
    const Corners s = corners(f), t = corners(g);
    return triangles_intersect(s, points(s), t, points(t));
  }

private:
  const Mesh& m_mesh;
};

/// Two faces that intersect, the one with the smaller number first; or one without area, twice.
using Face_pair = std::pair<Face_triangles::Face, Face_triangles::Face>;

/// Finds the pairs of a mesh.
class Intersection_finder
{
public:
  using Mesh = Face_triangles::Mesh;
  using Face = Face_triangles::Face;

  explicit Intersection_finder(const Mesh& mesh) : m_mesh(mesh), m_triangles(mesh) {}

  /// All of them, sorted.
  std::vector<Face_pair> all() const
  {
    std::vector<Face_pair> pairs;
    find([&](Face f, Face g) { pairs.push_back(std::minmax(f, g)); });
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  bool any() const
  {
    struct Found {};
    try {
      find([](Face, Face) { throw Found(); });
    } catch (const Found&) {
      return true;
    }
    return false;
  }

  /// Those of `pairs`, all that there were before the faces with `has_changed[f]` changed, as they
  /// are now, sorted.
  std::vector<Face_pair> updated(std::vector<Face_pair> pairs,
                                 const std::vector<char>& has_changed) const
  {
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [&](const Face_pair& p)
                               { return has_changed[p.first] || has_changed[p.second]; }),
                pairs.end());
    std::vector<Box> all, changed;
    for (const Face f : m_mesh.faces()) {
      const auto points = m_triangles.points(m_triangles.corners(f));
      if (Face_triangles::is_degenerate(points)) {
        if (has_changed[f]) pairs.push_back({f, f});
        continue;
      }
      all.emplace_back(Face_triangles::box(points), f);
      if (has_changed[f]) changed.push_back(all.back());
    }
    Pointers of_all = pointers(all), of_changed = pointers(changed);
    box_intersection_d(of_changed.begin(), of_changed.end(), of_all.begin(), of_all.end(),
                       [&](const Box* a, const Box* b) {
                         const Face f = a->info(), g = b->info();
                         if (f == g || (has_changed[g] && g < f)) return; // itself; found twice
                         poll();
                         if (m_triangles.intersect(f, g)) pairs.push_back(std::minmax(f, g));
                       },
                       cutoff);
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

private:
  // An index, not its address, tells the boxes apart: one may be copied.
  using Box = Box_intersection_d::Box_with_info_d<double, 3, Face,
                                                  Box_intersection_d::ID_EXPLICIT>;
  using Pointers = std::vector<const Box*>;
  static constexpr std::ptrdiff_t cutoff = 2000; // the leaves are cheap against the recursion

  static Pointers pointers(const std::vector<Box>& boxes)
  {
    Pointers result;
    result.reserve(boxes.size());
    for (const Box& box : boxes) result.push_back(&box);
    return result;
  }

  void poll() const
  {
    if (++m_tests % 1024 == 0) Cancellation::poll();
  }

  template <class F>
  void find(F&& found) const
  {
    std::vector<Box> boxes;
    boxes.reserve(m_mesh.number_of_faces());
    for (const Face f : m_mesh.faces()) {
      const auto points = m_triangles.points(m_triangles.corners(f));
      if (Face_triangles::is_degenerate(points))
        found(f, f);
      else
        boxes.emplace_back(Face_triangles::box(points), f);
    }
    Pointers all = pointers(boxes);
    box_self_intersection_d(all.begin(), all.end(),
                            [&](const Box* a, const Box* b) {
                              poll();
                              if (m_triangles.intersect(a->info(), b->info()))
                                found(a->info(), b->info());
                            },
                            cutoff);
  }

  const Mesh& m_mesh;
  Face_triangles m_triangles;
  mutable std::size_t m_tests = 0;
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_INTERSECTING_FACES_H
