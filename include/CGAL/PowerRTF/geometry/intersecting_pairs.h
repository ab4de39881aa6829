// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The search for pairs of triangles that intersect, of a soup or of a mesh, by exact predicates.
#ifndef CGAL_POWER_RTF_GEOMETRY_INTERSECTING_PAIRS_H
#define CGAL_POWER_RTF_GEOMETRY_INTERSECTING_PAIRS_H

#include <CGAL/PowerRTF/geometry/Box_tree.h>
#include <CGAL/PowerRTF/geometry/triangles_intersect.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

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
/// vertices, `points(corners)`: their points, and of two faces with area
/// `intersect(corners, points, corners, points)`.
template <class Triangles>
class Intersecting_pairs {
public:
  using Face = typename Triangles::Face;
  /// The face with the smaller number first; or one without area, twice.
  using Pair = std::pair<Face, Face>;

  /// `concurrency`: of the search.
  explicit Intersecting_pairs(Triangles triangles, Concurrency concurrency = Sequential_tag())
      : m_triangles(std::move(triangles)), m_concurrency(concurrency)
  {}

  /// Of two faces with area.
  bool intersect(Face f, Face g) const
  {
    const auto s = m_triangles.corners(f), t = m_triangles.corners(g);
    return m_triangles.intersect(s, m_triangles.points(s), t, m_triangles.points(t));
  }

  /// The pairs of `faces`, sorted.
  template <class Faces>
  std::vector<Pair> find(const Faces& faces) const
  {
    return find_where(faces, [](Face) { return true; });
  }

  /// Those of which at least one face `is_wanted()`.
  template <class Faces, class IsWanted>
  std::vector<Pair> find_where(const Faces& faces, IsWanted&& is_wanted) const
  {
    const std::vector<Face> all(std::begin(faces), std::end(faces));
    Unset_vector<Box3<double>> boxes(all.size());
    Unset_vector<char> is_flat(all.size());
    for_each_index(m_concurrency, int(all.size()), [&](int i) {
      const Triangle_points p = m_triangles.points(m_triangles.corners(all[i]));
      is_flat[i] = has_no_area(p);
      const Bbox_3 b = box_of(p);
      boxes[i] = {{b.xmin(), b.ymin(), b.zmin()}, {b.xmax(), b.ymax(), b.zmax()}};
    });
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (is_flat[i] && is_wanted(all[i])) pairs.emplace_back(all[i], all[i]);
    const Box_tree tree(boxes, m_concurrency);
    for (const auto& [i, j] : tree.pairs(
             [&](int i) { return is_wanted(all[i]); },
             [&](int i, int j) { return !is_flat[i] && !is_flat[j] && intersect(all[i], all[j]); }))
      pairs.push_back(std::minmax(all[i], all[j]));
    std::sort(pairs.begin(), pairs.end());
    return pairs;
  }

  /// Those of `pairs`, sorted. \pre all others are known to be none
  template <class Pairs>
  std::vector<Pair> find_among(const Pairs& pairs) const
  {
    const auto is_flat = [this](Face f) {
      return has_no_area(m_triangles.points(m_triangles.corners(f)));
    };
    std::vector<Pair> found;
    for (const auto& [i, j] : pairs) {
      const Face f(i), g(j);
      if (f == g ? is_flat(f) : !is_flat(f) && !is_flat(g) && intersect(f, g))
        found.push_back(std::minmax(f, g));
    }
    std::sort(found.begin(), found.end());
    return found;
  }

protected:
  Concurrency concurrency() const { return m_concurrency; }

private:
  Triangles m_triangles;
  Concurrency m_concurrency;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_INTERSECTING_PAIRS_H
