// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Items with boxes, in Boost's R-tree: for sets that change, and for queries that may stop early.
#ifndef CGAL_POWER_RTF_GEOMETRY_BOX_RTREE_H
#define CGAL_POWER_RTF_GEOMETRY_BOX_RTREE_H

#include <CGAL/PowerRTF/geometry/vector.h>

// the whole of it: which header has the tree's strategy depends on the version
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <utility>

namespace CGAL::PowerRTF::internal {

using Rtree_point = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
using Rtree_box = boost::geometry::model::box<Rtree_point>;

inline Rtree_point rtree_point(const Vec3d& p) { return {p.x, p.y, p.z}; }

/// The cube around `p`.
inline Rtree_box rtree_box(const Vec3d& p, double half_edge)
{
  const Vec3d d{half_edge, half_edge, half_edge};
  return {rtree_point(p - d), rtree_point(p + d)};
}

template <class Item>
using Rtree_entry = std::pair<Rtree_box, Item>;

/// Entries are the same that have the same item.
template <class Item>
struct Have_same_item {
  bool operator()(const Rtree_entry<Item>& a, const Rtree_entry<Item>& b) const
  {
    return a.second == b.second;
  }
};

template <class Item>
using Box_rtree =
    boost::geometry::index::rtree<Rtree_entry<Item>, boost::geometry::index::quadratic<16>,
                                  boost::geometry::index::indexable<Rtree_entry<Item>>,
                                  Have_same_item<Item>>;

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_BOX_RTREE_H
