// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Judges a remeshed surface, whoever made it: one line of JSON with the columns of the paper's
// Tables 1 and 2, the largest angle, the lengths of the edges, topology, and the two-sided distance
// to the input in % of the diagonal of its bounding box; the largest in its unit of length, too. By
// the library's own functions (quality/), applied to the triangles as they are in the file.
//
//   judge INPUT OUTPUT
#include <CGAL/PowerRTF/geometry/self_intersections.h>
#include <CGAL/PowerRTF/quality/surface_distance.h>
#include <CGAL/PowerRTF/quality/topology.h>
#include <CGAL/PowerRTF/quality/triangle_quality.h>

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace CGAL::PowerRTF;
using Point = CGAL::Simple_cartesian<double>::Point_3;

struct Soup {
  std::vector<Vec3d> points;
  std::vector<Triangle> triangles;
};

bool read(const std::string& file, Soup& soup)
{
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_polygon_soup(file, points, polygons)) return false;
  for (const Point& p : points) soup.points.push_back({p.x(), p.y(), p.z()});
  for (const auto& polygon : polygons)
    for (std::size_t k = 2; k < polygon.size(); ++k)
      soup.triangles.push_back({int(polygon[0]), int(polygon[k - 1]), int(polygon[k])});
  return !soup.triangles.empty();
}

/// An upper bound of the distance both ways, at most .2 % above the largest (the report's: 1 %), in
/// per cent of the diagonal of `box`, the input's.
double distance_bound(Soup input, Soup output, const Box3<double>& box)
{
  const Vec3d middle = 0.5 * (box.lo + box.hi);
  const double scale = 1 / length(box.hi - box.lo); // the bound's boxes are those of a unit box
  for (Soup* soup : {&input, &output})
    for (Vec3d& p : soup->points) p = scale * (p - middle);
  constexpr double factor = 1.002;
  const CGAL::Sequential_tag sequential;
  const Facet_tree a(input.points, input.triangles), b(output.points, output.triangles);
  const double known = surface_distance(input.points, input.triangles, a, output.points,
                                        output.triangles, sequential)
                           .max /
                       100;
  return 100 * std::max(internal::distance_bound(a, b, known, sequential, factor),
                        internal::distance_bound(b, a, known, sequential, factor));
}

} // namespace

int main(int argc, char** argv)
{
  const bool is_bound_wanted = argc == 4 && std::string(argv[3]) == "--bound";
  if (argc != 3 && !is_bound_wanted) {
    std::cerr << "judge INPUT OUTPUT [--bound]\n";
    return EXIT_FAILURE;
  }
  Soup input, output;
  if (!read(argv[1], input) || !read(argv[2], output)) {
    std::cerr << "judge: one of the files cannot be read or has no facet\n";
    return EXIT_FAILURE;
  }
  const Topology_statistics before = topology(input.triangles), after = topology(output.triangles);
  const Quality_statistics q = triangle_quality(output.points, output.triangles);
  const Distance_statistics d =
      surface_distance(input.points, input.triangles, output.points, output.triangles);
  const Edge_length_statistics edges = edge_lengths(output.points, output.triangles);
  const Box3<double> box = internal::bounding_box(input.points, input.triangles);
  const double absolute_distance_max = d.max / 100 * length(box.hi - box.lo);
  std::cout.precision(9);
  std::cout << "{\"vertices\": " << after.vertices << ", \"faces\": " << after.faces
            << ", \"input_vertices\": " << before.vertices
            << ", \"euler\": " << after.euler_characteristic
            << ", \"input_euler\": " << before.euler_characteristic
            << ", \"components\": " << after.components
            << ", \"input_components\": " << before.components
            << ", \"border_loops\": " << after.border_loops
            << ", \"input_border_loops\": " << before.border_loops
            << ", \"non_manifold_edges\": " << after.non_manifold_edges
            << ", \"non_manifold_vertices\": " << after.non_manifold_vertices
            << ", \"oriented\": " << (after.oriented ? "true" : "false")
            << ", \"self_intersections\": " << self_intersections(output.points, output.triangles)
            << ", \"q_min\": " << q.q_min << ", \"q_avg\": " << q.q_avg
            << ", \"theta_min\": " << q.theta_min << ", \"theta_min_avg\": " << q.theta_min_avg
            << ", \"theta_max\": " << q.theta_max << ", \"below_30\": " << q.below_30
            << ", \"above_90\": " << q.above_90 << ", \"edge_length_mean\": " << edges.mean
            << ", \"edge_length_min\": " << edges.min << ", \"edge_length_max\": " << edges.max
            << ", \"distance_rms\": " << d.rms << ", \"distance_mean\": " << d.mean
            << ", \"distance_max\": " << d.max
            << ", \"absolute_distance_max\": " << absolute_distance_max;
  if (is_bound_wanted) std::cout << ", \"distance_bound\": " << distance_bound(input, output, box);
  std::cout << "}\n";
  return EXIT_SUCCESS;
}
