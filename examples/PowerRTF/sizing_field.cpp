// Remeshes a sphere with edges that are short on one side and longer on the other, and shortest in
// a small ball around a point.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/Refinement.h>
#include <CGAL/PowerRTF/Resolution.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

#include <cstdlib>
#include <iostream>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace params = CGAL::PowerRTF::parameters;

int main()
{
  Mesh input, output;
  CGAL::make_icosahedron<Mesh, Kernel::Point_3>(input);
  CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(3));

  auto wanted = input.add_property_map<Mesh::Vertex_index, double>("v:length").first;
  for (const Mesh::Vertex_index v : input.vertices()) wanted[v] = 0.1 + 0.05 * input.point(v).x();
  const Kernel::Point_3 center = input.point(*input.vertices().begin());
  const std::vector<CGAL::PowerRTF::Refinement> regions{
      CGAL::PowerRTF::Refinement::sphere({center.x(), center.y(), center.z()}, 0.2, 0.02)};

  const CGAL::PowerRTF::Remeshing_report report =
      CGAL::power_rtf_remeshing(input, CGAL::PowerRTF::Resolution::size_factor(), output,
                                params::sizing_map(wanted).refinements(regions));

  std::cout << num_vertices(output) << " vertices; edges: " << report.edge_length.min
            << " (shortest), " << report.edge_length.max << " (longest)\n";
  return report.missed_guarantees().empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}
