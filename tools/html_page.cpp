// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "html_page.h"

#include "Base64.h"
#include "page_text.h"
#include "traits.h"

#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/bounding_box.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cmath>
#include <cstdint>
#include <ostream>
#include <string_view>
#include <vector>

namespace tools {
namespace {

using namespace CGAL::PowerRTF;

/// The numbers' bytes (of a machine that begins with the lowest) in base 64.
template <class Number>
std::string base64(const std::vector<Number>& numbers)
{
  static_assert(sizeof(Number) == 4, "what the page's typed arrays have");
  return to_base64({reinterpret_cast<const char*>(numbers.data()), 4 * numbers.size()});
}

/// Of each point the distance to the tree's facets, in the input's unit, and the facet.
struct Nearest {
  std::vector<float> distances;
  std::vector<int> facets;

  Nearest(const std::vector<Vec3d>& points, const Facet_tree& to, double unit)
      : distances(points.size()), facets(points.size())
  {
    internal::for_each_index(Concurrency(), int(points.size()), [&](int v) {
      const auto nearest = to.nearest_anywhere(points[v]);
      distances[v] = float(unit * std::sqrt(nearest.squared_distance));
      facets[v] = nearest.facet;
    });
  }
};

void add_point(const Vec3d& p, const Vec3d& center, std::vector<float>& coordinates)
{
  for (const double x : {p.x - center.x, p.y - center.y, p.z - center.z})
    coordinates.push_back(float(x));
}

void write_mesh(std::ostream& out, const std::vector<Vec3d>& points,
                const std::vector<Triangle>& triangles, const Vec3d& center,
                const std::vector<float>& distance, const std::vector<float>& density)
{
  std::vector<float> coordinates;
  for (const Vec3d& p : points) add_point(p, center, coordinates);
  std::vector<std::int32_t> corners;
  for (const Triangle& t : triangles) corners.insert(corners.end(), t.begin(), t.end());
  out << "{\"points\":\"" << base64(coordinates) << "\",\"faces\":\"" << base64(corners)
      << "\",\"distance\":\"" << base64(distance) << "\",\"density\":\"" << base64(density)
      << "\"}";
}

void write_cells(std::ostream& out, const std::vector<Cell_polygon>& cells, const Vec3d& center)
{
  std::vector<float> coordinates;
  std::vector<std::int32_t> sides;
  for (const Cell_polygon& cell : cells) {
    for (const Vec3d& p : cell.vertices) add_point(p, center, coordinates);
    sides.push_back(static_cast<std::int32_t>(cell.vertices.size()));
  }
  out << "{\"points\":\"" << base64(coordinates) << "\",\"sides\":\"" << base64(sides) << "\"}";
}

void write_data(std::ostream& out, const Surface& surface, const Extracted_mesh& mesh,
                const std::vector<Cell_polygon>& cells, const std::string& report)
{
  const double unit = 1 / surface.normalization.scale;
  const auto tree = [](const auto& points, const auto& triangles) {
    return Facet_tree(points, triangles, {}, Concurrency());
  };
  const Facet_tree of_surface = tree(surface.points, surface.triangles);
  const Nearest to_surface(mesh.points, of_surface, unit);
  const Nearest to_mesh(surface.points, tree(mesh.points, mesh.triangles), unit);
  const auto& rho = surface.vertex_density;
  const std::vector<float> density(rho.begin(), rho.end());
  std::vector<float> mesh_density;
  for (const int f : to_surface.facets) {
    const Triangle& t = surface.triangles[f];
    mesh_density.push_back(float((rho[t[0]] + rho[t[1]] + rho[t[2]]) / 3));
  }
  const auto box = internal::bounding_box(surface.points, surface.triangles, Concurrency());
  const Vec3d center = (box.lo + box.hi) * 0.5;
  out << "{\"unit\":" << unit << ",\"input\":";
  write_mesh(out, surface.points, surface.triangles, center, to_mesh.distances, density);
  out << ",\"output\":";
  write_mesh(out, mesh.points, mesh.triangles, center, to_surface.distances, mesh_density);
  out << ",\"cells\":";
  write_cells(out, cells, center);
  out << ",\"report\":";
  for (const char c : report) c == '<' ? out << "\\u003c" : out << c; // no end of the script
  out << '}';
}

} // namespace

void write_html(std::ostream& out, const Surface& surface, const Extracted_mesh& mesh,
                const std::vector<Cell_polygon>& cells, const std::string& report)
{
  const std::string_view page(page_text), mark("@DATA@");
  const std::size_t place = page.find(mark);
  const auto precision = out.precision(17);
  out << page.substr(0, place);
  write_data(out, surface, mesh, cells, report);
  out << page.substr(place + mark.size());
  out.precision(precision);
}

} // namespace tools
