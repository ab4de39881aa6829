// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Shapes as meshes of CGAL.
#ifndef CGAL_POWER_RTF_TEST_MESH_OF_SHAPE_H
#define CGAL_POWER_RTF_TEST_MESH_OF_SHAPE_H

#include "shapes.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <boost/property_map/property_map.hpp>

#include <map>
#include <vector>

namespace shapes {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

template <class Graph = Mesh, class Polygons>
Graph make_mesh(const std::vector<Vec3d>& points, const Polygons& polygons)
{
  using Map = typename boost::property_map<Graph, CGAL::vertex_point_t>::type;
  using Point = typename boost::property_traits<Map>::value_type;
  std::vector<Point> converted;
  for (const Vec3d& p : points) converted.emplace_back(p.x, p.y, p.z);
  Graph mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(converted, polygons, mesh);
  return mesh;
}

template <class Graph = Mesh>
Graph make_mesh(const Soup& soup)
{
  return make_mesh<Graph>(soup.points, soup.triangles);
}

/// The mesh in the order of its vertices and facets.
template <class Graph, class PointMap>
Soup soup_of(const Graph& mesh, const PointMap& point_map)
{
  Soup soup;
  std::map<typename boost::graph_traits<Graph>::vertex_descriptor, int> index;
  for (const auto v : vertices(mesh)) {
    index[v] = int(soup.points.size());
    soup.points.push_back(CGAL::PowerRTF::internal::to_vec3d(get(point_map, v)));
  }
  for (const auto f : faces(mesh)) {
    const auto h = halfedge(f, mesh);
    soup.triangles.push_back({index.at(source(h, mesh)), index.at(target(h, mesh)),
                              index.at(target(next(h, mesh), mesh))});
  }
  return soup;
}

template <class Graph>
Soup soup_of(const Graph& mesh)
{
  return soup_of(mesh, get(CGAL::vertex_point, mesh));
}

} // namespace shapes

#endif // CGAL_POWER_RTF_TEST_MESH_OF_SHAPE_H
