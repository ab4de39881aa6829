// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_IMPROVEMENT_POINTS_BY_FACE_H
#define CGAL_POWER_RTF_IMPROVEMENT_POINTS_BY_FACE_H

#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <boost/range/iterator_range.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The face of each point, and the points of each face in order. All are assigned at once; then
/// some may move.
class Points_by_face {
public:
  using Face = Working_mesh::Face;

  /// `face(i)`: of point i
  template <class Face_of>
  void assign(Concurrency concurrency, int points, std::size_t faces, const Face_of& face)
  {
    m_moved.clear();
    m_face.resize(points);
    for_each_index(concurrency, points, [&](int i) { m_face[i] = face(i); });
    m_points.emplace(
        concurrency, points, faces, [this](int i) { return int(m_face[i]); },
        [](int i) { return i; });
  }

  void move(int i, Face to)
  {
    const Face from = std::exchange(m_face[i], to);
    if (to == from) return;
    std::vector<int>& before = moved(from);
    before.erase(std::find(before.begin(), before.end(), i));
    std::vector<int>& after = moved(to);
    after.insert(std::upper_bound(after.begin(), after.end(), i), i);
  }

  Face face(int i) const { return m_face[i]; }

  boost::iterator_range<const int*> at(Face f) const
  {
    if (!m_moved.empty())
      if (const auto moved = m_moved.find(f); moved != m_moved.end())
        return {moved->second.data(), moved->second.data() + moved->second.size()};
    const int* points = m_points->entries.data();
    return {points + m_points->first[f], points + m_points->first[f + 1]};
  }

private:
  std::vector<int>& moved(Face f)
  {
    const auto now = at(f);
    return m_moved.try_emplace(f, now.begin(), now.end()).first->second;
  }

  Unset_vector<Face> m_face;                          // by point
  std::optional<Buckets<int>> m_points;               // by face, as they were assigned
  std::unordered_map<Face, std::vector<int>> m_moved; // since then: all points of such faces
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_POINTS_BY_FACE_H
