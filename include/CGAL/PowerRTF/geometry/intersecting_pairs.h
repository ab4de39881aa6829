// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The search for pairs of triangles that intersect, of a soup or of a mesh, by exact predicates.
#ifndef CGAL_POWER_RTF_GEOMETRY_INTERSECTING_PAIRS_H
#define CGAL_POWER_RTF_GEOMETRY_INTERSECTING_PAIRS_H

#include <CGAL/PowerRTF/geometry/triangles_intersect.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <CGAL/Box_intersection_d/Box_with_info_d.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Finds pairs of faces that meet in more than the vertices and edges that they share. A face
/// without area counts as a pair with itself and with nothing else.
///
/// \tparam Triangles has the type `Face` and, of a face `f`, `corners(f)`: an array of three
/// vertices that compare, and `points(corners)`: their points.
template <class Triangles>
class Intersecting_pairs {
public:
  using Face = typename Triangles::Face;

  explicit Intersecting_pairs(Triangles triangles) : m_triangles(std::move(triangles)) {}

  /// Of two faces with area.
  bool intersect(Face f, Face g) const
  {
    const auto s = m_triangles.corners(f), t = m_triangles.corners(g);
    return triangles_intersect(s, m_triangles.points(s), t, m_triangles.points(t));
  }

  /// Calls `found(f, g)` for each pair of `faces`, in any order.
  template <class Faces, class Found>
  void find(const Faces& faces, Found&& found) const
  {
    const std::vector<Box> boxes = boxes_of(faces, found);
    Pointers all = pointers(boxes);
    box_self_intersection_d(all.begin(), all.end(), tester(found), cutoff);
  }

  /// The same for the pairs of `faces` of which at least one `is_wanted()`.
  template <class Faces, class IsWanted, class Found>
  void find_where(const Faces& faces, IsWanted&& is_wanted, Found&& found) const
  {
    const std::vector<Box> boxes = boxes_of(faces, [&](Face f, Face) {
      if (is_wanted(f)) found(f, f);
    });
    Pointers all = pointers(boxes), wanted;
    std::copy_if(all.begin(), all.end(), std::back_inserter(wanted),
                 [&](const Box* box) { return is_wanted(box->info()); });
    auto test = tester(found);
    box_intersection_d(
        wanted.begin(), wanted.end(), all.begin(), all.end(),
        [&](const Box* a, const Box* b) {
          // not with itself, and once if both are wanted
          if (a == b || (is_wanted(b->info()) && b < a)) return;
          test(a, b);
        },
        cutoff);
  }

private:
  using Box = Box_intersection_d::Box_with_info_d<double, 3, Face, Box_intersection_d::ID_EXPLICIT>;
  using Pointers = std::vector<const Box*>;
  static constexpr std::ptrdiff_t cutoff = 2000; // the leaves are cheap against the recursion

  // Of the faces with area; the others are found.
  template <class Faces, class Found>
  std::vector<Box> boxes_of(const Faces& faces, Found&& found) const
  {
    std::vector<Box> boxes;
    boxes.reserve(faces.size());
    for (const Face f : faces) {
      const Triangle_points p = m_triangles.points(m_triangles.corners(f));
      if (has_no_area(p))
        found(f, f);
      else
        boxes.emplace_back(box_of(p), f);
    }
    return boxes;
  }

  static Pointers pointers(const std::vector<Box>& boxes)
  {
    Pointers result;
    result.reserve(boxes.size());
    for (const Box& box : boxes) result.push_back(&box);
    return result;
  }

  template <class Found>
  auto tester(Found& found) const
  {
    return [this, &found, tests = 0u](const Box* a, const Box* b) mutable {
      if (++tests % 1024 == 0) Cancellation::poll();
      if (intersect(a->info(), b->info())) found(a->info(), b->info());
    };
  }

  Triangles m_triangles;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_INTERSECTING_PAIRS_H
