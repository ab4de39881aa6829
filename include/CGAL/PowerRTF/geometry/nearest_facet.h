// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the projection of a point onto a surface is made of: the nearest point of a facet, and a
// search in a packed tree of boxes.
#ifndef CGAL_POWER_RTF_GEOMETRY_NEAREST_FACET_H
#define CGAL_POWER_RTF_GEOMETRY_NEAREST_FACET_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>

#include <vector>

namespace CGAL::PowerRTF {

/// A point of a surface and the facet that carries it.
template <class FT>
struct Surface_point {
  Vec3<FT> point;
  int facet = -1;
  FT squared_distance = 0; ///< to the query
};

/// Where on a triangle a point is: edge k leads from corner k to the next one.
struct Triangle_part {
  enum { inside, edge, corner } kind;
  int index; ///< of the edge or corner
};

/// Nearest point of the triangle (a, b, c) and where that is. (Ericson, "Real-Time Collision
/// Detection", 5.1.5.)
template <class FT>
CGAL_POWER_RTF_HD inline Vec3<FT> nearest_point_on_triangle(const Vec3<FT>& p, const Vec3<FT>& a,
                                                            const Vec3<FT>& b, const Vec3<FT>& c,
                                                            Triangle_part& part)
{
  const Vec3<FT> ab = b - a, ac = c - a, ap = p - a;
  const FT d1 = dot(ab, ap), d2 = dot(ac, ap);
  part = {Triangle_part::corner, 0};
  if (d1 <= 0 && d2 <= 0) return a;
  const Vec3<FT> bp = p - b;
  const FT d3 = dot(ab, bp), d4 = dot(ac, bp);
  part.index = 1;
  if (d3 >= 0 && d4 <= d3) return b;
  const FT vc = d1 * d4 - d3 * d2;
  part = {Triangle_part::edge, 0};
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return d1 - d3 > 0 ? a + ab * (d1 / (d1 - d3)) : a;
  const Vec3<FT> cp = p - c;
  const FT d5 = dot(ab, cp), d6 = dot(ac, cp);
  part = {Triangle_part::corner, 2};
  if (d6 >= 0 && d5 <= d6) return c;
  const FT vb = d5 * d2 - d1 * d6;
  part.kind = Triangle_part::edge;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return d2 - d6 > 0 ? a + ac * (d2 / (d2 - d6)) : a;
  const FT va = d3 * d6 - d5 * d4;
  part.index = 1;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const FT s = (d4 - d3) + (d5 - d6);
    return s > 0 ? b + (c - b) * ((d4 - d3) / s) : b;
  }
  part.kind = Triangle_part::inside;
  const FT denominator = 1 / (va + vb + vc);
  return a + ab * (vb * denominator) + ac * (vc * denominator);
}

template <class FT>
CGAL_POWER_RTF_HD inline Vec3<FT> nearest_point_on_triangle(const Vec3<FT>& p, const Vec3<FT>& a,
                                                            const Vec3<FT>& b, const Vec3<FT>& c)
{
  Triangle_part ignored;
  return nearest_point_on_triangle(p, a, b, c, ignored);
}

/// What boxes of a tree are near to, with the coordinates of the unit box.
struct Point_query {
  float point[3];

  template <class Real>
  CGAL_POWER_RTF_HD explicit Point_query(const Vec3<Real>& p)
      : point{float(p.x), float(p.y), float(p.z)}
  {}
};
struct Box_query {
  float center[3], half[3];

  CGAL_POWER_RTF_HD explicit Box_query(const Box3<double>& box)
      : center{float(0.5 * (box.lo.x + box.hi.x)), float(0.5 * (box.lo.y + box.hi.y)),
               float(0.5 * (box.lo.z + box.hi.z))},
        half{float(0.5 * (box.hi.x - box.lo.x)), float(0.5 * (box.hi.y - box.lo.y)),
             float(0.5 * (box.hi.z - box.lo.z))}
  {}
};

/// The boxes of a tree node's children side by side, so that one loop over them is one run of
/// vector instructions. Single precision and rounded outwards: distances to them are lower bounds.
struct Child_boxes {
  static constexpr int size = Packed_tree_layout::arity;
  float center[3][size], half[3][size]; ///< per axis

  /// Coordinates are those of the unit box, at most 1 in size: this covers the rounding of a box
  /// and of the query.
  static constexpr float margin = 2.5e-7f;

  template <class FT>
  CGAL_POWER_RTF_HD void set(int child, const Box3<FT>& box)
  {
    const Vec3<FT> c = (box.lo + box.hi) * FT(0.5), h = (box.hi - box.lo) * FT(0.5);
    const FT cs[3] = {c.x, c.y, c.z}, hs[3] = {h.x, h.y, h.z};
    for (int axis = 0; axis < 3; ++axis) {
      center[axis][child] = static_cast<float>(cs[axis]);
      half[axis][child] = static_cast<float>(hs[axis]) + margin;
    }
  }

  /// The box of a child of another node.
  CGAL_POWER_RTF_HD void copy(int child, const Child_boxes& other, int other_child)
  {
    for (int axis = 0; axis < 3; ++axis) {
      center[axis][child] = other.center[axis][other_child];
      half[axis][child] = other.half[axis][other_child];
    }
  }

  /// Lower bounds of the squared distances to a point.
  CGAL_POWER_RTF_HD void squared_distances(const Point_query& p, float (&d)[size]) const
  {
    squared_distances(
        p.point, [&](int axis, int child) { return half[axis][child]; }, d);
  }
  /// Lower bounds of the squared distances to a box.
  CGAL_POWER_RTF_HD void squared_distances(const Box_query& b, float (&d)[size]) const
  {
    squared_distances(
        b.center, [&](int axis, int child) { return half[axis][child] + b.half[axis]; }, d);
  }

private:
  template <class Half>
  CGAL_POWER_RTF_HD void squared_distances(const float (&p)[3], Half half_of,
                                           float (&d)[size]) const
  {
    for (int child = 0; child < size; ++child) {
      float sum = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const float outside = std::fabs(p[axis] - center[axis][child]) - half_of(axis, child);
        const float twice = outside + std::fabs(outside); // 2 max(outside, 0), without a branch
        sum += twice * twice;
      }
      d[child] = 0.25f * sum;
    }
  }
};

/// The nearest items found so far, at most `most`, by increasing distance, equal distances by
/// number. Non-owning.
template <class Real>
struct Nearest_items {
  int most;
  Real* distances;
  int* found;
  int count = 0;

  CGAL_POWER_RTF_HD bool is_full() const { return count == most; }
  CGAL_POWER_RTF_HD Real farthest() const { return distances[most - 1]; } ///< \pre `is_full()`
  CGAL_POWER_RTF_HD bool takes(Real distance, int item) const
  {
    return !is_full() || comes_before(distance, item, most - 1);
  }
  /// \pre `takes(distance, item)`
  CGAL_POWER_RTF_HD void insert(Real distance, int item)
  {
    int place = is_full() ? most - 1 : count++;
    for (; place > 0 && comes_before(distance, item, place - 1); --place) {
      distances[place] = distances[place - 1];
      found[place] = found[place - 1];
    }
    distances[place] = distance;
    found[place] = item;
  }

private:
  CGAL_POWER_RTF_HD bool comes_before(Real distance, int item, int place) const
  {
    return distance < distances[place] || (distance == distances[place] && item < found[place]);
  }
};

/// Computes node `k` of `level` and its own box `boxes[...]`; the levels are done in ascending
/// order. `box_of(i)`: of item i.
template <class Box_of>
CGAL_POWER_RTF_HD inline void fit_child_boxes(const Packed_tree_layout& tree, int level, int k,
                                              const Box_of& box_of, Box3<double>* boxes,
                                              Child_boxes* nodes)
{
  const int begin = tree.children_begin(k), end = tree.children_end(level, k);
  const int node = tree.first[level] + k;
  for (int c = begin; c < end; ++c) {
    const Box3<double> box = level > 0 ? boxes[tree.first[level - 1] + c] : box_of(c);
    nodes[node].set(c - begin, box);
    if (c > begin)
      boxes[node].add(box);
    else
      boxes[node] = box;
  }
  for (int c = end - begin; c < Child_boxes::size; ++c) nodes[node].set(c, boxes[node]); // unused
}

/// The same as a loop's body.
template <class Box_of>
struct Fit_child_boxes {
  Packed_tree_layout tree;
  int level;
  Box_of box_of;
  Box3<double>* boxes;
  Child_boxes* nodes;
  CGAL_POWER_RTF_HD void operator()(int k) const
  {
    fit_child_boxes(tree, level, k, box_of, boxes, nodes);
  }
};

/// Fits all nodes where a backend works.
template <class Backend, class Box_of>
void fit_tree(Backend& backend, const Packed_tree_layout& tree, const Box_of& box_of,
              Box3<double>* boxes, Child_boxes* nodes)
{
  for (int level = 0; level < tree.levels; ++level)
    backend.for_each(tree.nodes(level), Fit_child_boxes<Box_of>{tree, level, box_of, boxes, nodes});
}

/// The nodes of a tree whose item `k` lies in the box `box_of(k)`.
template <class Box_of>
std::vector<Child_boxes> child_boxes(const Packed_tree_layout& tree, const Box_of& box_of)
{
  std::vector<Child_boxes> nodes(tree.nodes());
  std::vector<Box3<double>> boxes(tree.nodes());
  for (int level = 0; level < tree.levels; ++level)
    for (int k = 0; k < tree.nodes(level); ++k)
      fit_child_boxes(tree, level, k, box_of, boxes.data(), nodes.data());
  return nodes;
}

/// Calls `visit(item)` for the items of a tree whose boxes are no farther from `query`, a point or
/// a box, than `bound()`, near ones first; the bound may shrink meanwhile.
template <class Query, class Bound, class Visit>
CGAL_POWER_RTF_HD inline void visit_near(const Packed_tree_layout& tree, const Child_boxes* nodes,
                                         const Query& query, Bound bound, Visit visit)
{
  if (tree.items == 0) return;
  struct Pending {
    int level, node;
    float squared_distance;
  };
  Pending stack[Packed_tree_layout::stack_size];
  int size = 0;
  stack[size++] = {tree.levels - 1, 0, 0};
  while (size > 0) {
    const Pending top = stack[--size];
    if (top.squared_distance > bound()) continue;
    const int begin = tree.children_begin(top.node), end = tree.children_end(top.level, top.node);
    float d[Child_boxes::size];
    nodes[tree.first[top.level] + top.node].squared_distances(query, d);
    const int bottom = size;
    CGAL_POWER_RTF_UNROLL
    for (int k = 0; k < Child_boxes::size; ++k) {
      if (begin + k >= end || d[k] > bound()) continue;
      if (top.level == 0) {
        visit(begin + k);
        continue;
      }
      int place = size++; // the nearest child ends on top of the stack
      for (; place > bottom && d[k] > stack[place - 1].squared_distance; --place)
        stack[place] = stack[place - 1];
      stack[place] = {top.level - 1, begin + k, d[k]};
    }
  }
}

/// An upper bound of a squared distance in single precision, for comparisons with boxes.
template <class Real>
CGAL_POWER_RTF_HD inline float bound_of(Real squared_distance)
{
  return float(squared_distance) * (1 + 1e-6f) + 1e-37f;
}

/// Barycentric coordinates (of b and c) of a point of the triangle, clamped to it.
template <class FT>
CGAL_POWER_RTF_HD inline void barycentric_coordinates(const Vec3<FT>& p, const Vec3<FT>& a,
                                                      const Vec3<FT>& b, const Vec3<FT>& c,
                                                      FT& beta, FT& gamma)
{
  const Vec3<FT> ab = b - a, ac = c - a, ap = p - a;
  const FT bb = dot(ab, ab), bc = dot(ab, ac), cc = dot(ac, ac), pb = dot(ap, ab), pc = dot(ap, ac);
  const FT determinant = bb * cc - bc * bc;
  beta = determinant > 0 ? (cc * pb - bc * pc) / determinant : FT(0);
  gamma = determinant > 0 ? (bb * pc - bc * pb) / determinant : FT(0);
  beta = beta < 0 ? FT(0) : beta > 1 ? FT(1) : beta;
  gamma = gamma < 0 ? FT(0) : gamma > 1 - beta ? 1 - beta : gamma;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_NEAREST_FACET_H
