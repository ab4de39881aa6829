// Remeshes with a density of one's own: four times as dense at the north pole of a sphere as at the
// south pole, that is with half the distance between samples.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

#include <cmath>
#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace params = CGAL::PowerRTF::parameters;

int main()
{
  Mesh input, output;
  CGAL::make_icosahedron<Mesh, Kernel::Point_3>(input);
  CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(4));
  auto density = input.add_property_map<Mesh::Vertex_index, double>("v:density").first;
  for (const auto v : input.vertices()) density[v] = std::pow(4, input.point(v).z() / 2);

  // The package's parameters and CGAL's, in any order.
  CGAL::power_rtf_remeshing(input, 1000, output, params::random_seed(1).density_map(density));

  std::size_t north = 0;
  for (const auto v : output.vertices()) north += output.point(v).z() > 0;
  std::cout << north << " of " << num_vertices(output) << " vertices lie in the north\n";
  return north > 550 ? EXIT_SUCCESS : EXIT_FAILURE;
}
