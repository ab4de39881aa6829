// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for assess.h.
#ifndef CGAL_POWER_RTF_QUALITY_ASSESS_IMPL_H
#define CGAL_POWER_RTF_QUALITY_ASSESS_IMPL_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/fields/thin_parts.h>
#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/geometry/self_intersections.h>
#include <CGAL/PowerRTF/internal/Background_work.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/quality/assess.h>
#include <CGAL/PowerRTF/quality/surface_distance.h>
#include <CGAL/PowerRTF/quality/topology.h>
#include <CGAL/PowerRTF/quality/triangle_quality.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

/// How many of the mesh's feature edges are no edges of its triangles.
inline std::size_t lost_feature_edges(const Extracted_mesh& mesh,
                                      Concurrency concurrency = Sequential_tag())
{
  const std::vector<Edge>& wanted = mesh.feature_edges;
  if (wanted.empty()) return 0;
  std::vector<char> is_at_feature(mesh.points.size(), 0);
  for (const Edge& e : wanted) is_at_feature[e[0]] = is_at_feature[e[1]] = 1;
  const auto edge = [&](int h) {
    return sorted_edge(halfedge_source(mesh.triangles, h), halfedge_target(mesh.triangles, h));
  };
  std::vector<Edge> edges;
  for (const int h : select(concurrency, static_cast<int>(3 * mesh.triangles.size()), [&](int h) {
         return is_at_feature[edge(h)[0]] && is_at_feature[edge(h)[1]];
       }))
    edges.push_back(edge(h));
  std::sort(edges.begin(), edges.end());
  return reduce(
      concurrency, static_cast<int>(wanted.size()), std::size_t(0),
      [&](std::size_t& lost, int k) {
        lost += !std::binary_search(edges.begin(), edges.end(),
                                    sorted_edge(wanted[k][0], wanted[k][1]));
      },
      [](std::size_t& lost, std::size_t part) { lost += part; });
}

/// How many of the vertices that are to stay are none of the mesh, where they were.
inline std::size_t lost_kept_vertices(const Surface& surface, const Extracted_mesh& mesh)
{
  if (surface.kept_vertices.empty()) return 0;
  std::vector<char> is_used(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const int v : t) is_used[v] = 1;
  const Normalization& normalization = surface.normalization;
  std::size_t found = 0;
  for (int v = 0; v < static_cast<int>(mesh.points.size()); ++v) {
    if (!is_used[v] || !mesh.is_kept(v)) continue;
    const Vec3d moved = mesh.points[v] - normalization.to_inside(mesh.outside(v, normalization));
    found += (std::max)({std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)}) <=
             normalization.grid; // rounded
  }
  return surface.kept_vertices.size() - found;
}

} // namespace internal

CGAL_POWER_RTF_INLINE void assess(const Surface& surface, const Surface& patches,
                                  const Facet_tree& tree, const Extracted_mesh& mesh,
                                  Remeshing_report& report, internal::Concurrency concurrency,
                                  const Bring_mesh& bring)
{
  constexpr double round_quality = 0.6, round_angle = 30; // degrees
  internal::Progress_part part(0.1);
  if (report.input_topology.faces == 0) // else it is that before facets were split
    report.input_topology = internal::manifold_topology(surface, concurrency);
  report.crease_edges = surface.creases.size();
  report.feature_edges = mesh.feature_edges.size();
  part.next(0.2);
  report.topology = topology(mesh.triangles, concurrency, mesh.there(bring).get());
  const double unit = 1 / surface.normalization.scale; // of the points, in the input's
  // While intersections and distances are found:
  internal::Background_work judgment(concurrency, [&] {
    report.lost_feature_edges = internal::lost_feature_edges(mesh, concurrency);
    report.quality = triangle_quality(mesh.points, mesh.triangles, concurrency);
    if (report.quality.q_min < round_quality || report.quality.theta_min < round_angle)
      report.thin = thin_parts(patches, mesh.points.size(), concurrency);
    const Topology_statistics& t = report.topology;
    const bool is_closed = t.oriented && t.border_edges == 0; // and so without non-manifold edges
    const Edge_length_statistics lengths =
        edge_lengths(mesh.points, mesh.triangles, concurrency, is_closed);
    report.edge_length = {unit * lengths.mean, unit * lengths.median, unit * lengths.min,
                          unit * lengths.max};
  });
  part.next(0.5);
  report.constrained_vertices = surface.kept_vertices.size();
  report.lost_constrained_vertices = internal::lost_kept_vertices(surface, mesh);
  if (surface.kept_vertices.empty()) {
    report.self_intersections =
        self_intersections(mesh.points, mesh.triangles, concurrency, mesh.there(bring).get());
  } else { // these are no places of the grid
    Extracted_mesh outside{mesh.outside(surface.normalization, concurrency), mesh.triangles};
    report.self_intersections = self_intersections(outside.points, outside.triangles, concurrency,
                                                   outside.there(bring).get());
  }
  if (report.self_intersections > 0)
    report.input_self_intersections =
        self_intersections(surface.points, surface.triangles, concurrency);
  const Box3<double> box = internal::bounding_box(surface.points, surface.triangles, concurrency);
  report.diagonal = unit * length(box.hi - box.lo);
  part.next(1);
  report.distance =
      surface_distance(patches.points, patches.triangles, tree, mesh.points, mesh.triangles,
                       concurrency, report.max_distance > 0, mesh.there(bring).get());
  judgment.finish();
  auto& [x, y, z] = report.distance.farthest;
  const Vec3d farthest = surface.normalization.to_outside({x, y, z});
  std::tie(x, y, z) = std::tie(farthest.x, farthest.y, farthest.z);
}

CGAL_POWER_RTF_INLINE void assess(const Surface& surface, const Extracted_mesh& mesh,
                                  Remeshing_report& report, internal::Concurrency concurrency)
{
  assess(surface, surface, Facet_tree(surface.points, surface.triangles, {}, concurrency), mesh,
         report, concurrency);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_QUALITY_ASSESS_IMPL_H
