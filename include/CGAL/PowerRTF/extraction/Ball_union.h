// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether points lie in one of many balls, whose sizes may differ widely.
#ifndef CGAL_POWER_RTF_EXTRACTION_BALL_UNION_H
#define CGAL_POWER_RTF_EXTRACTION_BALL_UNION_H

#include <CGAL/PowerRTF/geometry/Box_rtree.h>
#include <CGAL/PowerRTF/geometry/vector.h>

#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

struct Ball {
  Vec3d center;
  double radius;
};

class Ball_union {
public:
  /// The balls are taken `factor` times as large.
  Ball_union(std::vector<Ball> balls, double factor) : m_balls(std::move(balls))
  {
    std::vector<Rtree_entry<int>> entries;
    for (Ball& ball : m_balls) {
      ball.radius *= factor;
      entries.emplace_back(rtree_box(ball.center, ball.radius), int(entries.size()));
    }
    m_tree = Box_rtree<int>(entries);
  }

  bool contains(const Vec3d& p) const
  {
    const auto at_p = boost::geometry::index::intersects(rtree_point(p));
    for (auto it = m_tree.qbegin(at_p); it != m_tree.qend(); ++it) {
      const Ball& ball = m_balls[it->second];
      if (squared_length(p - ball.center) < ball.radius * ball.radius) return true;
    }
    return false;
  }

private:
  std::vector<Ball> m_balls;
  Box_rtree<int> m_tree;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_BALL_UNION_H
