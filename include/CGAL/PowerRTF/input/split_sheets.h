// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Parts the sheets of a triangle soup that meet in an edge or in a vertex, so that each is a
// 2-manifold. Vertices are copied; no point of the surface moves. Which facets at an edge go on in
// one another is read from their cyclic order around it: sheets may touch, but not cross, and what
// is enclosed between two facets is inside (Gueziec et al. 2001, "Cutting and stitching").
#ifndef CGAL_POWER_RTF_INPUT_SPLIT_SHEETS_H
#define CGAL_POWER_RTF_INPUT_SPLIT_SHEETS_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/degenerate_facets.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// Triangles whose vertices may be copies of one another.
struct Triangle_soup {
  std::vector<Vec3d> points;
  std::vector<Triangle> triangles;
  std::vector<int> originals; ///< for each vertex the one of the input that it is or copies
  std::vector<Edge> seams;    ///< see `Surface`
  std::vector<int> contacts;  ///< see `Surface`
  Facet_adjacency adjacency;  ///< of the triangles

  /// To be called after changes of the triangles.
  void update_adjacency(internal::Concurrency concurrency = Sequential_tag())
  {
    adjacency = facet_adjacency(triangles, points.size(), concurrency);
  }
};

namespace internal {

/// The halfedges at an edge of more than two facets, counter-clockwise seen along the edge from its
/// smaller vertex to its larger one.
using Crowd = std::vector<int>;

/// The crowds of a soup, by edge. An empty crowd: a facet at the edge has no direction.
inline std::vector<Crowd> crowds(const Triangle_soup& soup)
{
  const auto& triangles = soup.triangles;
  const Facet_adjacency& adjacency = soup.adjacency;
  std::map<Edge, Crowd> by_edge;
  for (int h = 0; h < static_cast<int>(adjacency.opposite.size()); ++h) {
    Cancellation::poll_now_and_then();
    if (adjacency.opposite[h] != Facet_adjacency::none) continue;
    by_edge[sorted_edge(halfedge_source(triangles, h), halfedge_target(triangles, h))].push_back(h);
  }
  std::vector<Crowd> result;
  for (auto& entry : by_edge) {
    const Edge edge = entry.first;
    Crowd& crowd = entry.second;
    if (crowd.size() < 3) continue;
    const Vec3d origin = soup.points[edge[0]], axis = normalized(soup.points[edge[1]] - origin);
    Vec3d u{0, 0, 0}, v{0, 0, 0};
    std::vector<std::pair<double, int>> order;
    for (const int h : crowd) {
      const Triangle& t = triangles[h / 3];
      if (is_degenerate(soup.points[t[0]], soup.points[t[1]], soup.points[t[2]])) break;
      const Vec3d to_apex = soup.points[opposite_vertex(triangles, h)] - origin;
      const Vec3d side = normalized(to_apex - dot(to_apex, axis) * axis);
      if (order.empty()) {
        u = side;
        v = cross(axis, u);
      }
      const double angle = std::atan2(dot(side, v), dot(side, u));
      constexpr double rounding = 1e-7, pi = 3.14159265358979323846;
      order.emplace_back(angle < -rounding ? angle + 2 * pi : angle, h);
    }
    if (order.size() < crowd.size()) {
      result.emplace_back();
      continue;
    }
    // Of facets on top of each other, those come first that end a solid: solids touch there.
    const auto ends_solid = [&](int h) { return halfedge_source(triangles, h) == edge[0]; };
    constexpr double same = 1e-7;
    std::sort(order.begin(), order.end());
    for (std::size_t k = 1; k < order.size(); ++k)
      for (std::size_t l = k; l > 0 && order[l].first - order[l - 1].first < same &&
                              ends_solid(order[l].second) && !ends_solid(order[l - 1].second);
           --l)
        std::swap(order[l].second, order[l - 1].second);
    for (std::size_t k = 0; k < order.size(); ++k) crowd[k] = order[k].second;
    result.push_back(crowd);
  }
  return result;
}

/// Joins the facets of each crowd in pairs that do not cross, each the two sides of a solid.
/// \returns false if the facets' orientations leave no such pairs
inline bool pair_crowds(const std::vector<Triangle>& triangles, const std::vector<Crowd>& list,
                        Facet_adjacency& adjacency)
{
  for (const Crowd& crowd : list) {
    // In the order around the edge a facet that runs backwards begins a solid, one that runs
    // forwards ends it: brackets, to be read from where fewest are open.
    const auto begins = [&](int h) {
      return halfedge_source(triangles, h) > halfedge_target(triangles, h);
    };
    int open = 0, fewest = 0;
    std::size_t start = 0;
    for (std::size_t k = 0; k < crowd.size(); ++k) {
      open += begins(crowd[k]) ? 1 : -1;
      if (open < fewest) {
        fewest = open;
        start = k + 1;
      }
    }
    if (open != 0 || crowd.empty()) return false;
    std::vector<int> opened;
    for (std::size_t k = 0; k < crowd.size(); ++k) {
      const int h = crowd[(start + k) % crowd.size()];
      if (begins(h)) {
        opened.push_back(h);
        continue;
      }
      adjacency.opposite[h] = opened.back();
      adjacency.opposite[opened.back()] = h;
      opened.pop_back();
    }
  }
  return true;
}

/// Turns facets so that neighbors agree and the facets of each crowd take turns.
/// \returns false if there is no such orientation
inline bool orient_crowds(std::vector<Triangle>& triangles, const Facet_adjacency& adjacency,
                          const std::vector<Crowd>& list, std::size_t& turned)
{
  std::vector<std::vector<int>> partners(adjacency.opposite.size());
  for (const Crowd& crowd : list) {
    if (crowd.size() % 2 != 0 || crowd.empty()) return false;
    for (std::size_t k = 0; k < crowd.size(); ++k) {
      const int h = crowd[k], next = crowd[(k + 1) % crowd.size()];
      partners[h].push_back(next);
      partners[next].push_back(h);
    }
  }
  for (std::size_t h = 0; h < partners.size(); ++h)
    if (adjacency.opposite[h] != Facet_adjacency::none) partners[h] = {adjacency.opposite[h]};
  return orient_facets(
      triangles, [&](int h) -> const std::vector<int>& { return partners[h]; },
      [](int, int) { return false; }, turned);
}

/// Gives the facets of the halfedges `fan`, which leave `v`, a copy of it.
inline void copy_vertex(Triangle_soup& soup, int v, const std::vector<int>& fan)
{
  for (const int h : fan) soup.triangles[h / 3][h % 3] = static_cast<int>(soup.points.size());
  soup.points.push_back(Vec3d(soup.points[v]));
  soup.originals.push_back(int(soup.originals[v]));
}

/// Gives each fan of facets around a vertex a vertex of its own; the first keeps the vertex.
/// `adjacency` says which facets go on in one another, with opposite directions.
/// \returns the number of vertices that were copied
inline std::size_t split_fans(Triangle_soup& soup, const Facet_adjacency& adjacency)
{
  std::vector<char> fans(soup.points.size(), 0);
  std::size_t copied = 0;
  const auto opposite = [&](int h) { return adjacency.opposite[h]; };
  for_each_fan(adjacency.opposite.size(), opposite, [&](const std::vector<int>& fan) {
    const int v = halfedge_source(soup.triangles, fan[0]);
    if (fans[v] == 0) {
      fans[v] = 1;
      return;
    }
    copied += fans[v] == 1;
    fans[v] = 2;
    copy_vertex(soup, v, fan);
  });
  return copied;
}

/// The edges of more than two facets, smaller vertex first, sorted.
inline std::vector<Edge> crowded_edges(const Triangle_soup& soup)
{
  std::vector<Edge> single; // once for each facet
  for (int h = 0; h < static_cast<int>(soup.adjacency.opposite.size()); ++h)
    if (soup.adjacency.opposite[h] == Facet_adjacency::none)
      single.push_back(
          sorted_edge(halfedge_source(soup.triangles, h), halfedge_target(soup.triangles, h)));
  std::sort(single.begin(), single.end());
  std::vector<Edge> crowded;
  for (std::size_t k = 1; k < single.size(); ++k)
    if (single[k] == single[k - 1]) crowded.push_back(single[k]);
  crowded.erase(std::unique(crowded.begin(), crowded.end()), crowded.end());
  return crowded;
}

inline bool is_seam(const Triangle_soup& soup, int h)
{
  return std::binary_search(
      soup.seams.begin(), soup.seams.end(),
      sorted_edge(halfedge_source(soup.triangles, h), halfedge_target(soup.triangles, h)));
}

/// Calls `f` with the halfedges around each vertex that go on in one another once the soup is cut
/// along its seams.
template <class F>
void for_each_fan_between_seams(const Triangle_soup& soup, const F& f)
{
  const auto opposite = [&](int h) {
    return is_seam(soup, h) ? Facet_adjacency::none : soup.adjacency.opposite[h];
  };
  for_each_fan(soup.adjacency.opposite.size(), opposite, f);
}

/// The vertices where more than one fan of facets ends, some of them without a seam: sorted.
inline std::vector<int> find_contacts(const Triangle_soup& soup)
{
  std::vector<char> is_taken(soup.points.size(), 0);
  for (const Edge& e : soup.seams)
    for (const int v : e) is_taken[v] = 1;
  std::vector<int> contacts;
  for_each_fan_between_seams(soup, [&](const std::vector<int>& fan) {
    if (std::any_of(fan.begin(), fan.end(),
                    [&](int h) { return is_seam(soup, h) || is_seam(soup, previous_halfedge(h)); }))
      return;
    const int v = halfedge_source(soup.triangles, fan[0]);
    if (is_taken[v]) contacts.push_back(v);
    is_taken[v] = 1;
  });
  sort_uniquely(contacts);
  return contacts;
}

/// Cuts the edges of the crowds into halves, and with them their facets.
inline void halve_crowded_edges(Triangle_soup& soup, const std::vector<Crowd>& list)
{
  std::map<Edge, int> middles;
  for (const Crowd& crowd : list) {
    const int a = halfedge_source(soup.triangles, crowd[0]);
    const int b = halfedge_target(soup.triangles, crowd[0]);
    if (!middles.insert({sorted_edge(a, b), static_cast<int>(soup.points.size())}).second) continue;
    soup.points.push_back(0.5 * (soup.points[a] + soup.points[b]));
    soup.originals.push_back(int(soup.originals[a]));
  }
  for (std::size_t f = 0; f < soup.triangles.size(); ++f) // also of those that are added
    for (int i = 0; i < 3; ++i) {
      Cancellation::poll_now_and_then();
      Triangle& t = soup.triangles[f];
      const auto m = middles.find(sorted_edge(t[i], t[(i + 1) % 3]));
      if (m == middles.end()) continue;
      Triangle half = t;
      half[i] = t[(i + 1) % 3] = m->second;
      soup.triangles.push_back(half);
      i = -1;
    }
}

/// Those of the seams `crowded` that cutting would leave closed, as both ends lie inside of a
/// sheet: one crowd for each, of one halfedge.
inline std::vector<Crowd> closed_slits(const Triangle_soup& soup, const std::vector<Edge>& crowded)
{
  std::vector<int> fan_of(soup.adjacency.opposite.size());
  int fans = 0;
  for_each_fan_between_seams(soup, [&](const std::vector<int>& fan) {
    for (const int h : fan) fan_of[h] = fans;
    ++fans;
  });
  std::set<Edge> seen; // the fans at both ends
  std::vector<Crowd> result;
  for (int h = 0; h < static_cast<int>(fan_of.size()); ++h) {
    const Edge edge =
        sorted_edge(halfedge_source(soup.triangles, h), halfedge_target(soup.triangles, h));
    if (std::binary_search(crowded.begin(), crowded.end(), edge) &&
        !seen.insert(sorted_edge(fan_of[h], fan_of[next_halfedge(h)])).second)
      result.push_back({h});
  }
  return result;
}

/// Makes the edges of more than two facets seams. Those that could not be cut open get a vertex in
/// the middle.
inline void find_crowded_seams(Triangle_soup& soup)
{
  const std::vector<Edge> others = soup.seams;
  const auto find = [&] {
    std::vector<Edge> crowded = crowded_edges(soup);
    soup.seams = others;
    soup.seams.insert(soup.seams.end(), crowded.begin(), crowded.end());
    sort_uniquely(soup.seams);
    return crowded;
  };
  const std::vector<Crowd> closed = closed_slits(soup, find());
  if (closed.empty()) return;
  halve_crowded_edges(soup, closed);
  soup.update_adjacency();
  find();
}

} // namespace internal

/// Parts the sheets that meet in an edge of more than two facets or touch in a vertex. The facets
/// must be oriented where only two meet, else they are turned (`repairs.reoriented_facets`). A
/// sheet that leaves another one along an edge whose ends it shares with it gets a vertex in the
/// middle of that edge.
/// \returns false, and leaves the soup as it is, when the facets at an edge cannot be paired: their
///   number is odd, or no orientation lets them take turns around it, or one has no area
inline bool split_sheets(Triangle_soup& soup, Repair_counts& repairs)
{
  using namespace internal;
  Triangle_soup whole = soup;
  Repair_counts counts = repairs;
  for (int attempt = 0; attempt < 2; ++attempt) {
    std::vector<Crowd> list = crowds(whole);
    if (attempt == 0) counts.non_manifold_edges += list.size();
    Facet_adjacency paired = whole.adjacency;
    if (whole.adjacency.same_direction || !pair_crowds(whole.triangles, list, paired)) {
      if (!orient_crowds(whole.triangles, whole.adjacency, list, counts.reoriented_facets))
        return false;
      whole.update_adjacency(); // halfedges were turned, too
      list = crowds(whole);
      paired = whole.adjacency;
      if (!pair_crowds(whole.triangles, list, paired)) return false;
    }
    Triangle_soup split = whole;
    const std::size_t copied = split_fans(split, paired);
    split.update_adjacency();
    if (split.adjacency.non_manifold_edges == 0) {
      counts.non_manifold_vertices += copied;
      repairs = counts;
      soup = std::move(split);
      return true;
    }
    halve_crowded_edges(whole, crowds(split));
    whole.update_adjacency();
  }
  return false;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_INPUT_SPLIT_SHEETS_H
