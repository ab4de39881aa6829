// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Creases: the edges that the result must keep, given by the user or found by dihedral angle. Found
// ones count only where they are clean, as on mechanical parts: on scans the sharp edges are noise,
// whose chains end anywhere.
#ifndef CGAL_POWER_RTF_FEATURES_CREASES_H
#define CGAL_POWER_RTF_FEATURES_CREASES_H

#include <CGAL/PowerRTF/features/flat_boundaries.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

inline std::vector<char> border_vertices(const Surface& surface,
                                         Concurrency concurrency = Sequential_tag())
{
  const std::vector<int>& opposite = surface.adjacency.opposite;
  std::vector<char> on_border(surface.points.size(), 0);
  for (const int h : select(concurrency, static_cast<int>(opposite.size()),
                            [&](int h) { return opposite[h] == Facet_adjacency::none; }))
    on_border[halfedge_source(surface.triangles, h)] =
        on_border[halfedge_target(surface.triangles, h)] = 1;
  return on_border;
}

/// The vertices that are an end of one of the edges only.
inline std::vector<int> single_ends(const std::vector<Edge>& edges,
                                    Concurrency concurrency = Sequential_tag())
{
  std::vector<int> ends, singles;
  for (const Edge& e : edges) ends.insert(ends.end(), e.begin(), e.end());
  sort(concurrency, ends.begin(), ends.end());
  for (auto v = ends.begin(); v != ends.end();) {
    const auto next = std::find_if(v, ends.end(), [v](int u) { return u != *v; });
    if (next - v == 1) singles.push_back(*v);
    v = next;
  }
  return singles;
}

/// Removes dangling chains shorter than `shortest`, and pieces shorter than twice that in all.
inline void prune_creases(const Surface& surface, const std::vector<char>& on_border,
                          double shortest, std::vector<Edge>& creases)
{
  Edge_graph graph(creases, surface.points.size());
  std::vector<char> alive(creases.size(), 1);
  const auto length_of = [&](int e) {
    return length(surface.points[creases[e][1]] - surface.points[creases[e][0]]);
  };
  std::vector<int> ends;
  for (const int v : single_ends(creases))
    if (!on_border[v]) ends.push_back(v);
  std::vector<int> chain;
  while (!ends.empty()) {
    int v = ends.back();
    ends.pop_back();
    if (graph.degree(v) != 1) continue;
    chain.clear();
    double sum = 0;
    int e = graph.at(v)[0];
    for (;;) {
      chain.push_back(e);
      sum += length_of(e);
      v = graph.other_end(e, v);
      if (graph.degree(v) != 2 || on_border[v] || sum >= shortest) break;
      e = graph.other_edge(e, v);
    }
    if (sum >= shortest) continue;
    for (const int c : chain) {
      alive[c] = 0;
      graph.remove(c);
    }
    if (graph.degree(v) == 1 && !on_border[v]) ends.push_back(v);
  }

  std::vector<char> seen(creases.size(), 0);
  for (int first = 0; first < static_cast<int>(creases.size()); ++first) {
    if (!alive[first] || seen[first]) continue;
    chain.assign(1, first); // a whole piece
    seen[first] = 1;
    double sum = 0;
    for (std::size_t k = 0; k < chain.size(); ++k) {
      sum += length_of(chain[k]);
      for (const int v : creases[chain[k]])
        for (const int e : graph.at(v))
          if (!seen[e]) {
            seen[e] = 1;
            chain.push_back(e);
          }
    }
    if (sum < 2 * shortest)
      for (const int e : chain) alive[e] = 0;
  }
  std::size_t kept = 0;
  for (std::size_t e = 0; e < creases.size(); ++e)
    if (alive[e]) creases[kept++] = creases[e];
  creases.resize(kept);
}

} // namespace internal

/// The edges where the facets' normals differ by at least `angle` degrees, if these creases are
/// clean: nearly all of their chains close, or end at other creases or at the border. Otherwise
/// none. Where there are creases, the boundaries of large flat patches are creases, too
/// (`flat_patch_boundaries()`). Dangling chains shorter than `2 h`, h = sqrt(area / n), and pieces
/// shorter than `4 h` in all are taken for noise.
///
/// Measured on the models of CGAL's data: mechanical parts have less than one dangling end in 30
/// crease edges and noisy ones up to one in 6.7, scans and figures from one in 5.7 up; but for two
/// bones, whose edges of 20 to 40 degrees are longer in all than the sharper ones.
inline std::vector<Edge> find_creases(const Surface& surface, double angle, std::size_t n,
                                      internal::Concurrency concurrency = Sequential_tag())
{
  constexpr double degrees = 3.14159265358979323846 / 180, soft_angle = 20;
  const double cos_sharp = std::cos(angle * degrees);
  const double cos_soft = std::cos((std::min)(angle, soft_angle) * degrees);
  const auto& triangles = surface.triangles;
  const auto cosine = [&](int h) {
    const int o = surface.adjacency.opposite[h];
    const bool is_seam = std::binary_search(
        surface.seams.begin(), surface.seams.end(),
        sorted_edge(halfedge_source(triangles, h), halfedge_target(triangles, h)));
    return dot(surface.facet_normals[h / 3], surface.facet_normals[o / 3]) * (is_seam ? -1 : 1);
  };
  const std::vector<int> bent =
      internal::select(concurrency, static_cast<int>(3 * triangles.size()), [&](int h) {
        return surface.adjacency.opposite[h] > h && cosine(h) <= cos_soft; // once, no border
      });
  const auto is_sharp = [&](int k) { return cosine(bent[k]) <= cos_sharp; };
  const auto edge = [&](int k) {
    return sorted_edge(halfedge_source(triangles, bent[k]), halfedge_target(triangles, bent[k]));
  };
  std::vector<Edge> creases;
  for (const int k : internal::select(concurrency, static_cast<int>(bent.size()), is_sharp))
    creases.push_back(edge(k));
  if (creases.empty()) return {};
  const auto total_length = [&](bool sharp) {
    return internal::sum(concurrency, static_cast<int>(bent.size()), [&](int k) {
      const auto [a, b] = edge(k);
      return is_sharp(k) == sharp ? length(surface.points[b] - surface.points[a]) : 0;
    });
  };
  const double sharp = total_length(true), soft = total_length(false);
  const std::vector<char> on_border = internal::border_vertices(surface, concurrency);
  const std::vector<int> ends = internal::single_ends(creases, concurrency);
  const auto dangling = static_cast<std::size_t>(
      std::count_if(ends.begin(), ends.end(), [&](int v) { return !on_border[v]; }));
  const bool clean =
      30 * dangling <= creases.size() || (6 * dangling <= creases.size() && soft <= sharp);
  if (!clean) return {};
  const double h = std::sqrt(surface.area / static_cast<double>(n));
  std::sort(creases.begin(), creases.end());
  const std::vector<Edge> flat = flat_patch_boundaries(surface, creases, h);
  creases.insert(creases.end(), flat.begin(), flat.end());
  internal::prune_creases(surface, on_border, 2 * h, creases);
  std::sort(creases.begin(), creases.end());
  return creases;
}

namespace internal {

/// The edges, other than those of the border, of which `is_wanted` holds for the smaller halfedge.
template <class Predicate>
std::vector<Edge> select_edges(const Surface& surface, const Predicate& is_wanted,
                               Concurrency concurrency)
{
  std::vector<Edge> edges;
  for (const int h :
       select(concurrency, static_cast<int>(3 * surface.triangles.size()), [&](int h) {
         return surface.adjacency.opposite[h] > h && is_wanted(h); // once, no border
       }))
    edges.push_back(
        sorted_edge(halfedge_source(surface.triangles, h), halfedge_target(surface.triangles, h)));
  return edges;
}

} // namespace internal

/// The edges, other than those of the border, whose ends are copies of the pairs of input vertices
/// in `marked`.
inline std::vector<Edge> marked_edges(const Surface& surface, std::vector<Edge> marked,
                                      internal::Concurrency concurrency = Sequential_tag())
{
  for (Edge& e : marked) e = sorted_edge(e[0], e[1]);
  std::sort(marked.begin(), marked.end());
  const auto is_marked = [&](int h) {
    const int a = surface.input_vertices[halfedge_source(surface.triangles, h)],
              b = surface.input_vertices[halfedge_target(surface.triangles, h)];
    return std::binary_search(marked.begin(), marked.end(), sorted_edge(a, b));
  };
  return internal::select_edges(surface, is_marked, concurrency);
}

/// The edges between facets with different `labels`.
inline std::vector<Edge> label_boundaries(const Surface& surface, const std::vector<int>& labels,
                                          internal::Concurrency concurrency = Sequential_tag())
{
  const auto is_boundary = [&](int h) {
    return labels[h / 3] != labels[surface.adjacency.opposite[h] / 3];
  };
  return internal::select_edges(surface, is_boundary, concurrency);
}

/// Adds creases to those of `surface`.
inline void add_creases(Surface& surface, const std::vector<Edge>& more)
{
  if (more.empty()) return;
  surface.creases.insert(surface.creases.end(), more.begin(), more.end());
  sort_uniquely(surface.creases);
}

/// Makes creases of the seams and of the edges that are `marked_edges()`.
inline void set_creases(Surface& surface, std::vector<Edge> marked,
                        internal::Concurrency concurrency = Sequential_tag())
{
  surface.creases = surface.seams;
  add_creases(surface, marked_edges(surface, std::move(marked), concurrency));
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_CREASES_H
