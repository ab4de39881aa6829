// Remeshes a surface so that the result is its own mirror image, vertex by vertex.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <set>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
namespace params = CGAL::PowerRTF::parameters;

int main()
{
  Mesh input, output;
  CGAL::make_icosahedron<Mesh, Point>(input, Point(0, 0, 0), 1);
  CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(3));

  const CGAL::PowerRTF::Remeshing_report report =
      CGAL::power_rtf_remeshing(input, 2000, output, params::symmetry(CGAL::PowerRTF::Symmetry::x));

  std::set<Point> points;
  for (const auto v : output.vertices()) points.insert(output.point(v));
  std::size_t pairs = 0;
  for (const Point& p : points)
    pairs += points.count(Point(2 * report.symmetry.at - p.x(), p.y(), p.z()));
  std::cout << report.symmetry.vertices << " vertices in the plane x = " << report.symmetry.at
            << ", all " << pairs << " have a mirror image\n";
  return report.missed_guarantees().empty() && pairs == points.size() ? EXIT_SUCCESS : EXIT_FAILURE;
}
