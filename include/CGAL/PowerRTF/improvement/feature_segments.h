// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges of the surface's creases and borders, found by place.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_FEATURE_SEGMENTS_H
#define CGAL_POWER_RTF_IMPROVEMENT_FEATURE_SEGMENTS_H

#include <CGAL/PowerRTF/geometry/Box_rtree.h>
#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

using Segment = std::pair<Vec3d, Vec3d>;

inline Vec3d nearest_point(const Segment& s, const Vec3d& p)
{
  const Vec3d d = s.second - s.first;
  const double l = squared_length(d), t = l > 0 ? dot(p - s.first, d) / l : 0;
  return s.first + d * std::min(1., std::max(0., t));
}

/// \pre there is a segment
inline Vec3d nearest_point(const std::vector<Segment>& segments, const Vec3d& p)
{
  Vec3d best = p;
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& segment : segments) {
    const Vec3d q = nearest_point(segment, p);
    if (!(squared_length(q - p) < least)) continue;
    least = squared_length(q - p);
    best = q;
  }
  return best;
}

class Feature_segments {
public:
  /// `patches`: the surface cut along its creases; the segments are its borders, those on a crease
  /// from both sides.
  explicit Feature_segments(const Surface& patches)
  {
    const std::vector<int>& opposite = patches.adjacency.opposite;
    std::vector<Rtree_entry<int>> entries;
    for (int h = 0; h < int(opposite.size()); ++h) {
      if (opposite[h] != Facet_adjacency::none) continue;
      const Segment s{patches.points[halfedge_source(patches.triangles, h)],
                      patches.points[halfedge_target(patches.triangles, h)]};
      Box3<double> box{s.first, s.first};
      box.add(s.second);
      entries.emplace_back(Rtree_box(rtree_point(box.lo), rtree_point(box.hi)),
                           int(m_segments.size()));
      m_segments.push_back(s);
    }
    m_tree = Box_rtree<int>(entries);
  }

  bool empty() const { return m_segments.empty(); }

  /// Those nearer to `p` than `reach`.
  std::vector<Segment> near(const Vec3d& p, double reach) const
  {
    std::vector<int> boxes;
    const auto around_p = boost::geometry::index::intersects(rtree_box(p, reach));
    for (auto it = m_tree.qbegin(around_p); it != m_tree.qend(); ++it) boxes.push_back(it->second);
    std::sort(boxes.begin(), boxes.end());
    std::vector<Segment> result;
    for (const int k : boxes)
      if (squared_length(nearest_point(m_segments[k], p) - p) < reach * reach)
        result.push_back(m_segments[k]);
    return result;
  }

private:
  std::vector<Segment> m_segments;
  Box_rtree<int> m_tree; // of their boxes
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_FEATURE_SEGMENTS_H
