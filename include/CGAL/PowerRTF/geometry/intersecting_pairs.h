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
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The box of a face, with its number.
using Face_box =
    Box_intersection_d::Box_with_info_d<double, 3, int, Box_intersection_d::ID_EXPLICIT>;
using Face_boxes = std::vector<const Face_box*>;

/// Calls `test(a, b)` for the pairs of boxes of `some` and `all` that meet; without `some`, for
/// those of `all`. No template: one instance of CGAL's search, which takes long to compile, serves
/// all.
inline void for_each_meeting(Face_boxes* some, Face_boxes& all,
                             const std::function<void(const Face_box*, const Face_box*)>& test)
{
  constexpr std::ptrdiff_t cutoff = 2000; // the leaves are cheap against the recursion
  if (some)
    box_intersection_d(some->begin(), some->end(), all.begin(), all.end(), std::cref(test), cutoff);
  else
    box_self_intersection_d(all.begin(), all.end(), std::cref(test), cutoff);
}

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
    const std::vector<Face_box> boxes = boxes_of(faces, found);
    Face_boxes all = pointers(boxes);
    for_each_meeting(nullptr, all, tester(found));
  }

  /// The same for the pairs of `faces` of which at least one `is_wanted()`.
  template <class Faces, class IsWanted, class Found>
  void find_where(const Faces& faces, IsWanted&& is_wanted, Found&& found) const
  {
    const std::vector<Face_box> boxes = boxes_of(faces, [&](Face f, Face) {
      if (is_wanted(f)) found(f, f);
    });
    Face_boxes all = pointers(boxes), wanted;
    std::copy_if(all.begin(), all.end(), std::back_inserter(wanted),
                 [&](const Face_box* box) { return is_wanted(face(box)); });
    auto test = tester(found);
    for_each_meeting(&wanted, all, [&](const Face_box* a, const Face_box* b) {
      // not with itself, and once if both are wanted
      if (a == b || (is_wanted(face(b)) && b < a)) return;
      test(a, b);
    });
  }

private:
  static Face face(const Face_box* box) { return Face(box->info()); }

  // Of the faces with area; the others are found.
  template <class Faces, class Found>
  std::vector<Face_box> boxes_of(const Faces& faces, Found&& found) const
  {
    std::vector<Face_box> boxes;
    boxes.reserve(faces.size());
    for (const Face f : faces) {
      const Triangle_points p = m_triangles.points(m_triangles.corners(f));
      if (has_no_area(p))
        found(f, f);
      else
        boxes.emplace_back(box_of(p), int(f));
    }
    return boxes;
  }

  static Face_boxes pointers(const std::vector<Face_box>& boxes)
  {
    Face_boxes result;
    result.reserve(boxes.size());
    for (const Face_box& box : boxes) result.push_back(&box);
    return result;
  }

  template <class Found>
  auto tester(Found& found) const
  {
    return [this, &found, tests = 0u](const Face_box* a, const Face_box* b) mutable {
      if (++tests % 1024 == 0) Cancellation::poll();
      if (intersect(face(a), face(b))) found(face(a), face(b));
    };
  }

  Triangles m_triangles;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_INTERSECTING_PAIRS_H
