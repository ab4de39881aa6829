// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for clean_surface.h: from polygons with indices to an oriented 2-manifold of triangles
// in the unit box. Every repair is preceded by a linear check, so clean input costs little.
#ifndef CGAL_POWER_RTF_INPUT_CLEAN_SURFACE_IMPL_H
#define CGAL_POWER_RTF_INPUT_CLEAN_SURFACE_IMPL_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/geometry/degenerate_facets.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/surface_geometry.h>
#include <CGAL/PowerRTF/input/Polygon_soup.h>
#include <CGAL/PowerRTF/input/clean_surface.h>
#include <CGAL/PowerRTF/input/near_borders.h>
#include <CGAL/PowerRTF/input/soup_triangles.h>
#include <CGAL/PowerRTF/input/split_sheets.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/connected_components.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A soup of more triangles than caches hold is put into an order in which what is near in space is
/// near in memory: all that is done with it is several times as fast.
inline Triangle_soup triangle_soup(const std::vector<Vec3d>& points,
                                   std::vector<Triangle>&& triangles, Concurrency concurrency)
{
  Triangle_soup soup{{}, std::move(triangles), {}, {}, {}, {}};
  if (soup.triangles.size() <= facets_in_caches) {
    soup.points = points;
    soup.originals.resize(points.size());
    std::iota(soup.originals.begin(), soup.originals.end(), 0);
    return soup;
  }
  const int vertices = static_cast<int>(points.size()),
            facets = static_cast<int>(soup.triangles.size());
  soup.originals = spatial_order(points, concurrency);
  resize_in_parallel(concurrency, soup.points, vertices);
  Unset_vector<int> places(vertices);
  for_each_index(concurrency, vertices, [&](int v) {
    places[soup.originals[v]] = v;
    soup.points[v] = points[soup.originals[v]];
  });
  for_each_index(concurrency, facets, [&](int f) {
    for (int& v : soup.triangles[f]) v = places[v];
  });
  const Buckets<int> at_least_vertex(
      concurrency, facets, points.size(),
      [&](int f) { return *std::min_element(soup.triangles[f].begin(), soup.triangles[f].end()); },
      [](int f) { return f; });
  std::vector<Triangle> sorted;
  resize_in_parallel(concurrency, sorted, facets);
  for_each_index(concurrency, facets,
                 [&](int k) { sorted[k] = soup.triangles[at_least_vertex.entries[k]]; });
  soup.triangles.swap(sorted);
  return soup;
}

/// Keeps the first of all triangles with the same three vertices; `keep_reversed`: the first of
/// each orientation.
inline void drop_repeated(std::vector<Triangle>& triangles, bool keep_reversed,
                          Repair_counts& repairs)
{
  std::set<Triangle> seen;
  const auto is_repeated = [&](Triangle t) {
    Cancellation::poll_now_and_then();
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    if (!keep_reversed && t[1] > t[2]) std::swap(t[1], t[2]);
    return !seen.insert(t).second;
  };
  std::size_t kept = 0;
  for (const Triangle& t : triangles)
    if (!is_repeated(t)) triangles[kept++] = t;
  repairs.duplicate_facets += triangles.size() - kept;
  triangles.resize(kept);
}

/// What may be done to make a soup a 2-manifold, the mildest first.
enum class Manifold_repair {
  none,         ///< nothing
  orient,       ///< drop repeated facets, turn facets
  network,      ///< keep edges of more than two facets and vertices where sheets touch
  split,        ///< part sheets that touch, too
  split_double, ///< facets on top of each other with opposite orientations are two sheets
};

/// How a repair ended.
struct [[nodiscard]] Repair_status {
  std::string failure; ///< why it could not be done; empty: it was

  bool is_done() const { return failure.empty(); }
};

/// Makes the soup an oriented 2-manifold. A soup for which that fails may have changed.
inline Repair_status make_manifold(Triangle_soup& soup, Manifold_repair allowed,
                                   Repair_counts& repairs,
                                   Concurrency concurrency = Sequential_tag())
{
  soup.seams.clear();
  soup.contacts.clear();
  const std::string not_manifold = "the surface is not a 2-manifold: ";
  if (soup.adjacency.repeated_facets) {
    if (allowed == Manifold_repair::none)
      return {not_manifold + "there are facets with the same vertices"};
    drop_repeated(soup.triangles, allowed == Manifold_repair::split_double, repairs);
    soup.update_adjacency();
  }
  if (soup.adjacency.non_manifold_edges > 0) {
    const std::string count = not_manifold + std::to_string(soup.adjacency.non_manifold_edges) +
                              " edge(s) with more than two facets";
    if (allowed < Manifold_repair::network)
      return {count + "; non_manifold = keep or split takes them"};
    if (allowed != Manifold_repair::network && !split_sheets(soup, repairs))
      return {count + " that do not pair up into sheets, so that the shape would have to change; "
                      "non_manifold = keep keeps them"};
  }
  if (soup.adjacency.same_direction) {
    if (allowed == Manifold_repair::none) return {"the facets are not consistently oriented"};
    soup.seams = orient_facets(soup.triangles, soup.adjacency, repairs.reoriented_facets);
    soup.update_adjacency();
  }
  if (soup.adjacency.non_manifold_edges > 0) find_crowded_seams(soup);
  if (allowed == Manifold_repair::network) {
    soup.contacts = find_contacts(soup);
    return {};
  }
  if (!soup.seams.empty()) {
    if (has_single_fans(soup.triangles, soup.adjacency, soup.points.size())) return {};
    return {not_manifold + "it has one side only, and parts of it touch in a point only"};
  }
  const auto touching = count_non_manifold_vertices(soup.adjacency, concurrency);
  if (touching == 0) return {};
  if (allowed < Manifold_repair::split)
    return {not_manifold + std::to_string(touching) +
            " vertex(es) where parts of the surface touch in a point only"};
  repairs.non_manifold_vertices += split_fans(soup, soup.adjacency);
  soup.update_adjacency(concurrency);
  return {};
}

/// Drops the vertices that no triangle uses. The others keep their order, and with it the
/// adjacency.
inline void drop_unused_vertices(Triangle_soup& soup, Concurrency concurrency)
{
  Unset_vector<int>& first = soup.adjacency.corners.first;
  const std::vector<int> used = select(concurrency, static_cast<int>(soup.points.size()),
                                       [&](int v) { return first[v] < first[v + 1]; });
  if (used.size() == soup.points.size()) return; // mostly
  first.erase(std::unique(first.begin(), first.end()), first.end());
  const int vertices = static_cast<int>(used.size());
  Unset_vector<int> new_index(soup.points.size()); // of those that are used
  const Triangle_soup all = {std::move(soup.points), {}, std::move(soup.originals), {}, {}, {}};
  resize_in_parallel(concurrency, soup.points, vertices);
  resize_in_parallel(concurrency, soup.originals, vertices);
  for_each_index(concurrency, vertices, [&](int v) {
    new_index[used[v]] = v;
    soup.points[v] = all.points[used[v]];
    soup.originals[v] = all.originals[used[v]];
  });
  for_each_index(concurrency, static_cast<int>(soup.triangles.size()), [&](int f) {
    for (int& v : soup.triangles[f]) v = new_index[v];
  });
  for (Edge& e : soup.seams) e = {new_index[e[0]], new_index[e[1]]};
  for (int& v : soup.contacts) v = new_index[v];
}

/// The surface of a soup, without the vertices that no triangle uses.
inline Surface compacted(Triangle_soup&& soup, const Normalization& normalization,
                         Concurrency concurrency)
{
  drop_unused_vertices(soup, concurrency);
  Surface surface;
  surface.points = std::move(soup.points);
  surface.triangles = std::move(soup.triangles);
  surface.adjacency = std::move(soup.adjacency);
  surface.input_vertices = std::move(soup.originals);
  surface.creases = soup.seams;
  surface.seams = std::move(soup.seams);
  surface.contacts = std::move(soup.contacts);
  resize_in_parallel(concurrency, surface.vertex_density, surface.points.size(), 1.);
  surface.normalization = normalization;
  return surface;
}

/// Closes the cracks of an oriented 2-manifold: as many as can be while it stays one.
inline void close_cracks(Triangle_soup& soup, Manifold_repair allowed, Repair_counts& repairs,
                         Concurrency concurrency)
{
  if (soup.adjacency.border_edges == 0) return;
  const std::vector<int> vertex =
      merged_near_borders(soup.points, soup.triangles, soup.adjacency, concurrency);
  if (vertex.empty()) return;
  Triangle_soup closed = soup;
  Repair_counts counts = repairs;
  for (std::size_t v = 0; v < vertex.size(); ++v)
    counts.duplicate_vertices += vertex[v] != static_cast<int>(v);
  for (Triangle& t : closed.triangles)
    for (int& v : t) v = vertex[v];
  counts.degenerate_facets += drop_collapsed(closed.triangles);
  closed.update_adjacency();
  allowed = allowed == Manifold_repair::network ? allowed : Manifold_repair::split;
  if (!make_manifold(closed, allowed, counts).is_done()) return;
  if (closed.adjacency.border_edges >= soup.adjacency.border_edges) return;
  soup = std::move(closed);
  repairs = counts;
}

/// Whether `close_cracks()` would try to close some.
inline bool has_cracks(const Surface& surface, Concurrency concurrency)
{
  return surface.adjacency.border_edges > 0 &&
         !merged_near_borders(surface.points, surface.triangles, surface.adjacency, concurrency)
              .empty();
}

/// Makes the surface of polygons in the unit box. `vertex[v]` is the vertex that stands for `v`.
/// `build`: what makes it elsewhere, where nothing has to be repaired; or empty.
inline Repair_status make_surface(const Polygon_soup& polygons, const std::vector<Vec3d>& points,
                                  const std::vector<int>& vertex,
                                  const Normalization& normalization, Manifold_repair allowed,
                                  Repair_counts& repairs, Surface& surface, Concurrency concurrency,
                                  const Build_surface& build)
{
  std::vector<Triangle> triangles = triangulated(polygons, points, vertex, repairs, concurrency);
  const bool closes_cracks = polygons.merges_vertices && allowed != Manifold_repair::none;
  if (build && build(points, triangles, surface) &&
      !(closes_cracks && has_cracks(surface, concurrency))) {
    surface.normalization = normalization;
    return {};
  }
  Triangle_soup soup = triangle_soup(points, std::move(triangles), concurrency);
  const std::size_t degenerate = degenerate_facets(soup.points, soup.triangles, concurrency).size();
  if (degenerate == soup.triangles.size()) return {"the surface has no area"};
  if (degenerate > 0 && allowed == Manifold_repair::none)
    return {std::to_string(degenerate) + " facet(s) have no area"};
  soup.update_adjacency(concurrency);
  Repair_status status = make_manifold(soup, allowed, repairs, concurrency);
  if (!status.is_done()) return status;
  if (closes_cracks) close_cracks(soup, allowed, repairs, concurrency);
  if (degenerate > 0 && soup.seams.empty() && soup.contacts.empty()) {
    const std::size_t before = degenerate_facets(soup.points, soup.triangles).size();
    repairs.duplicate_vertices += remove_degenerate_facets(soup.points, soup.triangles);
    repairs.degenerate_facets += before - degenerate_facets(soup.points, soup.triangles).size();
    soup.update_adjacency();
  }
  surface = compacted(std::move(soup), normalization, concurrency);
  compute_geometry(surface, concurrency);
  if (!(surface.area > 0)) return {"the surface has no area"}; // left of it, or by rounding
  return {};
}

/// What may be done to an input, in the order in which it is tried.
struct Repair_attempt {
  bool merges; ///< vertices at the same place
  Manifold_repair allowed;
  bool is_of_pinches = false; ///< only where merging would join no parts that are given apart
};

inline std::vector<Repair_attempt> repair_attempts(Repair repair, Non_manifold non_manifold,
                                                   bool has_duplicates)
{
  using Allowed = Manifold_repair;
  std::vector<Repair_attempt> attempts{
      {true, repair == Repair::yes ? Allowed::orient : Allowed::none}};
  // Sheets that touch are right as they were given if they are closed without merging: first of all
  // one that touches itself, then several, which a network would join.
  if (repair == Repair::yes && non_manifold == Non_manifold::keep) {
    if (has_duplicates) attempts.push_back({false, Allowed::orient, true});
    attempts.push_back({true, Allowed::network});
  }
  if (has_duplicates) attempts.push_back({false, attempts[0].allowed});
  if (repair == Repair::yes && non_manifold == Non_manifold::split) {
    attempts.push_back({true, Allowed::split});
    attempts.push_back({true, Allowed::split_double});
  }
  return attempts;
}

/// The number of connected parts of the polygons, and of vertices that none has; `vertex[v]` stands
/// for corner `v`.
inline int number_of_parts(const Polygon_soup& soup, const std::vector<int>& vertex,
                           Concurrency concurrency)
{
  const int vertices = static_cast<int>(vertex.size());
  const int polygons = static_cast<int>(soup.first.size()) - 1;
  return connected_components(concurrency, vertices + polygons,
                              [&](int i, const auto& link) {
                                if (i < vertices) return link(vertex[i]);
                                const int k = i - vertices;
                                for (int c = soup.first[k]; c < soup.first[k + 1]; ++c)
                                  link(soup.corners[c]);
                              })
      .second;
}

CGAL_POWER_RTF_INLINE Surface clean_surface(const Polygon_soup& soup, Repair repair,
                                            Non_manifold non_manifold, Repair_counts& repairs,
                                            Concurrency concurrency, const Build_surface& build)
{
  const Boxed_points boxed = boxed_points(soup, concurrency);
  const std::vector<int>& used = boxed.used;

  const int vertices = static_cast<int>(soup.points.size());
  std::vector<int> own_vertex(vertices);
  for_each_index(concurrency, vertices, [&](int v) { own_vertex[v] = v; });
  const std::vector<int> vertex =
      soup.merges_vertices ? merged_vertices(soup, used, concurrency) : own_vertex;
  const auto count = [&](auto&& counts) { return select(concurrency, vertices, counts).size(); };
  const std::size_t duplicates = count([&](int v) { return used[v] && vertex[v] != v; }),
                    unused = count([&](int v) { return !used[v]; });

  std::string reason;
  Build_surface untried = unused == 0 ? build : Build_surface(); // its triangles never change
  for (const auto& [merges, allowed, is_of_pinches] :
       repair_attempts(repair, non_manifold, duplicates > 0)) {
    if (is_of_pinches && number_of_parts(soup, vertex, concurrency) !=
                             number_of_parts(soup, own_vertex, concurrency))
      continue;
    Repair_counts counts = repairs;
    counts.unused_vertices += unused;
    if (merges) counts.duplicate_vertices += duplicates;
    const Build_surface build_now =
        merges && duplicates > 0 ? Build_surface() : std::exchange(untried, {});
    Surface surface;
    const Repair_status status =
        make_surface(soup, boxed.points, merges ? vertex : own_vertex, boxed.normalization, allowed,
                     counts, surface, concurrency, build_now);
    if (status.is_done() && (merges || surface.adjacency.border_edges == 0)) {
      repairs = counts;
      return surface;
    }
    if (merges && allowed != Manifold_repair::split_double) reason = status.failure;
  }
  throw Invalid_input_error(reason);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INPUT_CLEAN_SURFACE_IMPL_H
