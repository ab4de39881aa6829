// Remeshes a mesh file (or a sphere) with edges of a given length.
//
//   edge_length [input.off [length]]
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/Resolution.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

#include <cstdlib>
#include <iostream>
#include <string>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

int main(int argc, char** argv)
{
  Mesh input, output;
  if (argc > 1) {
    if (!CGAL::IO::read_polygon_mesh(argv[1], input)) {
      std::cerr << argv[1] << " cannot be read\n";
      return EXIT_FAILURE;
    }
  } else {
    CGAL::make_icosahedron<Mesh, Kernel::Point_3>(input);
    CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(3));
  }
  const double length = argc > 2 ? std::stod(argv[2]) : 0.1;

  CGAL::PowerRTF::Remeshing_options options;
  options.density = CGAL::PowerRTF::Density::uniform;
  const CGAL::PowerRTF::Remeshing_report report =
      CGAL::power_rtf_remeshing(input, CGAL::PowerRTF::Resolution::edge_length(length), output,
                                CGAL::PowerRTF::parameters::remeshing_options(options));

  std::cout << num_vertices(output) << " vertices; edges: " << report.edge_length.median
            << " (median), " << report.edge_length.min << " (shortest), " << report.edge_length.max
            << " (longest)\n";
  return report.missed_guarantees().empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}
