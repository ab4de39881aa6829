// Remeshes a cube in a texture, whose six sides are charts: the corners of the new faces get
// texture coordinates, those at the edges of the cube other ones on each side.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/transfer/Mesh_source.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Halfedge = Mesh::Halfedge_index;
using Coordinates = std::array<double, 2>;
using Source = CGAL::PowerRTF::Mesh_source<Mesh>;

int main()
{
  Mesh input, output;
  CGAL::make_hexahedron(Point(0, 0, 0), Point(1, 0, 0), Point(1, 1, 0), Point(0, 1, 0),
                        Point(0, 1, 1), Point(0, 0, 1), Point(1, 0, 1), Point(1, 1, 1), input);
  // A halfedge stands for the corner of its face at its target. Chart k lies in [k, k + 1] x [0,
  // 1].
  auto texture = input.add_property_map<Halfedge, Coordinates>("h:texture").first;
  for (const auto f : input.faces()) {
    const std::array<Coordinates, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    std::size_t i = 0;
    for (const Halfedge h : CGAL::halfedges_around_face(input.halfedge(f), input)) {
      texture[h] = {double(std::size_t(f)) + corners[i][0], corners[i][1]};
      ++i;
    }
  }
  auto is_seam = input.add_property_map<Mesh::Edge_index, bool>("e:seam", true).first;

  auto sources = output.add_property_map<Halfedge, Source>("h:source").first;
  namespace params = CGAL::PowerRTF::parameters;
  const CGAL::PowerRTF::Remeshing_report report =
      CGAL::power_rtf_remeshing(input, 1000, output, params::edge_is_constrained_map(is_seam),
                                params::corner_source_map(sources));
  auto new_texture = output.add_property_map<Halfedge, Coordinates>("h:texture").first;
  CGAL::PowerRTF::transfer_corner_values(output, sources, input, texture, new_texture);

  std::array<double, 6> areas{};
  for (const auto f : output.faces()) {
    std::array<Coordinates, 3> t;
    std::size_t i = 0;
    for (const Halfedge h : CGAL::halfedges_around_face(output.halfedge(f), output))
      t[i++] = new_texture[h];
    const double twice =
        (t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0]);
    areas[std::size_t((t[0][0] + t[1][0] + t[2][0]) / 3)] += std::abs(twice) / 2;
  }
  std::cout << "The areas of the charts are";
  for (const double area : areas) std::cout << ' ' << area;
  std::cout << '\n';
  return report.missed_guarantees().empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}
