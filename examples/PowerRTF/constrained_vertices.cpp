// Remeshes a sphere so that some of its vertices stay where they are, as those where loads are
// applied, and looks them up in the result.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

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
  CGAL::make_icosahedron<Mesh, Point>(input);
  CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(3));

  auto stays = input.add_property_map<Mesh::Vertex_index, bool>("v:stays", false).first;
  std::set<Point> points;
  for (const Mesh::Vertex_index v : input.vertices())
    if (v.idx() % 100 == 0) {
      stays[v] = true;
      points.insert(input.point(v));
    }

  const CGAL::PowerRTF::Remeshing_report report =
      CGAL::power_rtf_remeshing(input, 300, output, params::vertex_is_constrained_map(stays));

  std::size_t found = 0;
  for (const Mesh::Vertex_index v : output.vertices()) found += points.count(output.point(v));
  std::cout << found << " of " << points.size() << " vertices have stayed\n";
  return found == points.size() && report.missed_guarantees().empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}
