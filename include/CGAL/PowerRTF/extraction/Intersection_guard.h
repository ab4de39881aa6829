// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Keeps a mesh free of self-intersections while edges are collapsed and flipped: says of each
// change whether it would add some. Triangles are kept in hashed grids, one for each power of two of
// their size, as the mesh has very large and very small ones at the same time.
#ifndef CGAL_POWER_RTF_EXTRACTION_INTERSECTION_GUARD_H
#define CGAL_POWER_RTF_EXTRACTION_INTERSECTION_GUARD_H

#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/internal/triangles_intersect.h>

#include <CGAL/Bbox_3.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

class Intersection_guard
{
public:
  using Vertex = Working_mesh::Vertex;
  using Halfedge = Working_mesh::Halfedge;
  using Edge = Working_mesh::Edge;
  using Face = Working_mesh::Mesh::Face_index;
  using Corners = std::array<Vertex, 3>;
  using Faces = boost::container::small_vector<Face, 24>;
  using Triangles = boost::container::small_vector<Corners, 24>;

  /// \param is_watched by vertex: changes that make triangles at watched vertices are judged, others
  ///   are always allowed
  Intersection_guard(const Working_mesh& mesh, std::vector<char>&& is_watched)
      : m(mesh), m_is_watched(std::move(is_watched))
  {
    for (const Face f : m.mesh.faces()) insert(f);
  }

  void watch(Vertex v) { m_is_watched[v] = true; }

  /// Whether flipping the edge adds an intersection.
  bool forbids_flip(Edge e) const
  {
    const Halfedge h = m.mesh.halfedge(e), o = m.mesh.opposite(h);
    const Vertex a = m.mesh.source(h), b = m.mesh.target(h), c = m.mesh.target(m.mesh.next(h)),
                 d = m.mesh.target(m.mesh.next(o));
    return adds_intersections({m.mesh.face(h), m.mesh.face(o)}, {Corners{a, d, c}, Corners{d, b, c}});
  }

  /// Whether moving the source of `h` to its target adds an intersection.
  bool forbids_collapse(Halfedge h) const
  {
    const Vertex v = m.mesh.target(h);
    Faces old;
    Triangles fresh;
    for (const Halfedge g : halfedges_around_source(m.mesh.source(h), m.mesh)) {
      if (m.mesh.is_border(g)) continue;
      old.push_back(m.mesh.face(g));
      const Vertex a = m.mesh.target(g), b = m.mesh.target(m.mesh.next(g));
      if (a != v && b != v) fresh.push_back({v, a, b});
    }
    return adds_intersections(old, fresh);
  }

  /// To be called before and after a change, for the faces that it touches.
  void insert(Face f) { at_cells(f, [f](auto& cell) { cell.push_back(f); }); }
  void erase(Face f)
  {
    at_cells(f, [f](auto& cell) {
      const auto it = std::find(cell.begin(), cell.end(), f);
      *it = cell.back();
      cell.pop_back();
    });
  }
  void erase_around(Vertex u, Vertex v)
  {
    for (const Halfedge h : halfedges_around_target(u, m.mesh))
      if (!m.mesh.is_border(h)) erase(m.mesh.face(h));
    for (const Halfedge h : halfedges_around_target(v, m.mesh))
      if (!m.mesh.is_border(h) && m.mesh.source(h) != u && m.mesh.target(m.mesh.next(h)) != u)
        erase(m.mesh.face(h));
  }
  void insert_around(Vertex v)
  {
    for (const Halfedge h : halfedges_around_target(v, m.mesh))
      if (!m.mesh.is_border(h)) insert(m.mesh.face(h));
  }

private:
  using Points = std::array<Epick::Point_3, 3>;
  using Cell = boost::container::small_vector<Face, 4>;
  struct Level {
    double cell_size;
    std::unordered_map<std::uint64_t, Cell> cells;
  };

  Points points(const Corners& t) const
  {
    return {m.mesh.point(t[0]), m.mesh.point(t[1]), m.mesh.point(t[2])};
  }
  static Bbox_3 box(const Points& p) { return p[0].bbox() + p[1].bbox() + p[2].bbox(); }
  static bool is_degenerate(const Points& p) { return collinear(p[0], p[1], p[2]); }

  Corners corners(Face f) const
  {
    const Halfedge h = m.mesh.halfedge(f);
    return {m.mesh.source(h), m.mesh.target(h), m.mesh.target(m.mesh.next(h))};
  }

  static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z)
  {
    constexpr std::uint64_t mask = (1u << 21) - 1;
    return (std::uint64_t(x) & mask) | (std::uint64_t(y) & mask) << 21 |
           (std::uint64_t(z) & mask) << 42;
  }

  template <class Visit>
  static void for_each_key(const Bbox_3& b, double cell_size, Visit visit)
  {
    const auto along = [&](double x) { return std::int64_t(std::floor(x / cell_size)); };
    for (std::int64_t z = along(b.zmin()); z <= along(b.zmax()); ++z)
      for (std::int64_t y = along(b.ymin()); y <= along(b.ymax()); ++y)
        for (std::int64_t x = along(b.xmin()); x <= along(b.xmax()); ++x) visit(key(x, y, z));
  }

  template <class Change>
  void at_cells(Face f, Change change)
  {
    const Bbox_3 b = box(points(corners(f)));
    const double size = std::max({b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin()});
    constexpr double smallest = 0x1p-19; // 21 bits for the number of a cell along an axis
    const int exponent = std::ilogb(std::max(size, smallest)) + 1;
    const auto it = m_levels.insert({exponent, Level{std::ldexp(1., exponent), {}}}).first;
    for_each_key(b, it->second.cell_size, [&](std::uint64_t k) { change(it->second.cells[k]); });
  }

  // Calls visit(face) for the faces near the box; some more than once.
  template <class Visit>
  void for_each_near(const Bbox_3& b, Visit visit) const
  {
    const double size = std::max({b.xmax() - b.xmin(), b.ymax() - b.ymin(), b.zmax() - b.zmin()});
    for (const auto& [exponent, level] : m_levels) {
      const double along = size / level.cell_size + 1;
      if (along * along * along > double(level.cells.size()))
        for (const auto& [k, cell] : level.cells)
          for (const Face f : cell) visit(f);
      else
        for_each_key(b, level.cell_size, [&, &cells = level.cells](std::uint64_t k) {
          const auto it = cells.find(k);
          if (it == cells.end()) return;
          for (const Face f : it->second) visit(f);
        });
    }
  }

  // The faces, none of `except`, that intersect the triangle.
  std::size_t count(const Corners& t, const Faces& except) const
  {
    const Points p = points(t);
    const Bbox_3 b = box(p);
    Faces found;
    for_each_near(b, [&](Face f) {
      if (std::find(except.begin(), except.end(), f) != except.end()) return;
      if (std::find(found.begin(), found.end(), f) != found.end()) return;
      const Corners u = corners(f);
      const Points q = points(u);
      if (do_overlap(b, box(q)) && !is_degenerate(q) && triangles_intersect(t, p, u, q))
        found.push_back(f);
    });
    return found.size();
  }

  std::size_t count(const Triangles& triangles, const Faces& except) const
  {
    std::size_t sum = 0;
    for (auto t = triangles.begin(); t != triangles.end(); ++t) {
      if (is_degenerate(points(*t))) {
        ++sum;
        continue;
      }
      sum += count(*t, except);
      for (auto u = triangles.begin(); u != t; ++u)
        if (!is_degenerate(points(*u)) && triangles_intersect(*t, points(*t), *u, points(*u)))
          ++sum;
    }
    return sum;
  }

  bool adds_intersections(const Faces& old, const Triangles& fresh) const
  {
    const bool is_watched = std::any_of(fresh.begin(), fresh.end(), [this](const Corners& t) {
      return m_is_watched[t[0]] || m_is_watched[t[1]] || m_is_watched[t[2]];
    });
    if (!is_watched) return false;
    const std::size_t then = count(fresh, old);
    if (then == 0) return false;
    Triangles now;
    for (const Face f : old) now.push_back(corners(f));
    return then > count(now, old);
  }

  const Working_mesh& m;
  std::vector<char> m_is_watched;
  std::map<int, Level> m_levels; // by the exponent of the cell size
};

} // namespace internal
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_EXTRACTION_INTERSECTION_GUARD_H
