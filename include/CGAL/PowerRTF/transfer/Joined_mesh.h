// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A region that has been remeshed, and the rest of the input, which is as it was, as one mesh.
#ifndef CGAL_POWER_RTF_TRANSFER_JOINED_MESH_H
#define CGAL_POWER_RTF_TRANSFER_JOINED_MESH_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/geometry/self_intersections.h>
#include <CGAL/PowerRTF/input/Soup_region.h>
#include <CGAL/PowerRTF/input/polygon_triangulation.h>
#include <CGAL/PowerRTF/quality/triangle_quality.h>
#include <CGAL/PowerRTF/transfer/find_sources.h>

#include <boost/range/irange.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The triangles of some polygons of a soup, and the polygon of each: a triangle is itself.
inline std::vector<int> append_triangles(const Polygon_soup& soup, const std::vector<int>& polygons,
                                         std::vector<Triangle>& triangles)
{
  const std::size_t before = triangles.size();
  std::vector<int> result;
  for (const int k : polygons) {
    const std::vector<int> corners(soup.corners.begin() + soup.first[k],
                                   soup.corners.begin() + soup.first[k + 1]);
    if (corners.size() == 3)
      triangles.push_back({corners[0], corners[1], corners[2]});
    else if (corners.size() > 3)
      triangulate_polygon(soup.points, corners, triangles);
    result.resize(triangles.size() - before, k);
  }
  return result;
}

/// The pairs of triangles that meet in more than a shared vertex or edge, at least one of the pair
/// being among the last ones, from `first` on.
inline std::size_t intersections_of_last(const std::vector<Vec3d>& points,
                                         const std::vector<Triangle>& triangles, std::size_t first,
                                         Concurrency concurrency)
{
  return Intersecting_pairs<Soup_triangles>({points, triangles}, concurrency)
      .find_where(boost::irange(0, static_cast<int>(triangles.size())),
                  [first](int f) { return f >= static_cast<int>(first); })
      .size();
}

/// The points of the polygons that stay, in their order, as the input has them, then the new ones;
/// the triangles of the polygons that stay, then the new ones.
struct Joined_mesh {
  std::vector<Vec3d> points; ///< in the input's coordinates
  std::vector<Triangle> triangles;
  std::vector<int> input_points;   ///< of the points that stay: their numbers in the input
  std::vector<int> input_polygons; ///< of the triangles that stay: their polygons in the input
  std::vector<int> names;          ///< of each point of the region's mesh, its number here

  Joined_mesh() = default;

  /// \param mesh what `region` of `whole` has become, in the unit box of `normalization`
  Joined_mesh(const Polygon_soup& whole, const Soup_region& region, const Extracted_mesh& mesh,
              const Normalization& normalization)
  {
    input_polygons = append_triangles(whole, region.others, triangles);
    const std::vector<int> places = places_of_points(whole);
    const auto place_of_kept = [&](std::size_t v) {
      return places[region.points[mesh.input_points[v].number]];
    };
    std::vector<char> is_joined(whole.points.size(), 0); // by place
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
      if (mesh.is_kept(static_cast<int>(v))) is_joined[place_of_kept(v)] = 1;
    std::vector<int> name(whole.points.size(), -1), first_name = name; // by point, by place
    for (const Triangle& t : triangles)
      for (const int v : t) name[v] = 0;
    for (std::size_t v = 0; v < name.size(); ++v) {
      if (name[v] < 0) continue;
      int& first = first_name[places[v]];
      if (first >= 0 && is_joined[places[v]]) { // the new triangles have one vertex there
        name[v] = first;
        continue;
      }
      name[v] = static_cast<int>(points.size());
      if (first < 0) first = name[v];
      points.push_back(whole.points[v]);
      input_points.push_back(static_cast<int>(v));
    }
    for (Triangle& t : triangles)
      for (int& v : t) v = name[v];
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      const bool is_kept = mesh.is_kept(static_cast<int>(v));
      const int place = is_kept ? place_of_kept(v) : -1;
      if (is_kept && first_name[place] >= 0) {
        names.push_back(first_name[place]);
      } else { // new, or all faces at it are
        names.push_back(static_cast<int>(points.size()));
        points.push_back(mesh.outside(static_cast<int>(v), normalization));
      }
    }
    for (const auto& [a, b] : region.fields.kept_edges)
      m_kept_edges.push_back(
          sorted_edge(first_name[places[region.points[a]]], first_name[places[region.points[b]]]));
    for (const auto& [a, b, c] : mesh.triangles)
      triangles.push_back({names[a], names[b], names[c]});
  }

  /// Puts into `report` what stays, the edges between that and the new triangles that these lack,
  /// and the intersections of new triangles, also with those that stay.
  void judge(const Polygon_soup& whole, const Soup_region& region, Remeshing_report& report,
             Concurrency concurrency) const
  {
    report.kept_vertices = input_points.size();
    report.kept_faces = region.others.size();
    const std::vector<Edge> edges =
        edges_of(std::vector<Triangle>(triangles.begin() + input_polygons.size(), triangles.end()),
                 concurrency);
    for (const Edge& e : m_kept_edges)
      report.lost_feature_edges += !std::binary_search(edges.begin(), edges.end(), e);
    report.self_intersections =
        intersections_of_last(points, triangles, input_polygons.size(), concurrency);
    if (report.self_intersections == 0) return;
    std::vector<Triangle> before;
    append_triangles(whole, region.others, before);
    const std::size_t first = before.size();
    append_triangles(whole, region.polygons, before);
    report.input_self_intersections =
        intersections_of_last(whole.points, before, first, concurrency);
  }

  /// The sources in the input, of this mesh. What stays comes from itself.
  /// \param sources those of the region's mesh in the region's soup
  Sources sources(const Soup_region& region, const Sources& sources) const
  {
    const auto in_whole = [&](Source s) {
      s.face = region.polygons[s.face];
      for (int& v : s.vertices) v = region.points[v];
      return s;
    };
    Sources result;
    result.vertices.resize(points.size());
    for (std::size_t f = 0; f < input_polygons.size(); ++f) {
      Triangle t = triangles[f];
      for (int& v : t) v = input_points[v];
      std::array<Source, 3> corners;
      for (int i = 0; i < 3; ++i) {
        corners[i] = {input_polygons[f], t, {0, 0, 0}};
        corners[i].weights[i] = 1;
        result.vertices[triangles[f][i]] = corners[i];
      }
      if (!sources.corners.empty()) result.corners.push_back(corners);
      result.faces.push_back({input_polygons[f], t, {1. / 3, 1. / 3, 1. / 3}});
      if (!sources.shares.empty()) result.shares.emplace_back().fill(input_polygons[f]);
    }
    for (std::size_t v = 0; v < names.size(); ++v)
      if (names[v] >= static_cast<int>(input_points.size()))
        result.vertices[names[v]] = in_whole(sources.vertices[v]);
    for (const Source& s : sources.faces) result.faces.push_back(in_whole(s));
    for (const auto& polygons : sources.shares) {
      result.shares.push_back(polygons);
      for (int& k : result.shares.back()) k = region.polygons[k];
    }
    for (const auto& [a, b, c] : sources.corners)
      result.corners.push_back({in_whole(a), in_whole(b), in_whole(c)});
    return result;
  }

private:
  std::vector<Edge> m_kept_edges;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_TRANSFER_JOINED_MESH_H
