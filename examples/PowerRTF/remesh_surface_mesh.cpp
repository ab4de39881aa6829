// Remeshes a mesh file (or a sphere) with a given number of vertices.
//
//   remesh_surface_mesh [input.off [number_of_vertices [output.off]]]
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
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
  const std::size_t number_of_vertices = argc > 2 ? std::stoul(argv[2]) : 500;

  const CGAL::PowerRTF::Remeshing_report report =
      CGAL::power_rtf_remeshing(input, number_of_vertices, output);

  std::cout << num_vertices(input) << " vertices in, " << num_vertices(output) << " out\n"
            << "triangle quality: " << report.quality.q_min << " (worst), " << report.quality.q_avg
            << " (mean); smallest angle " << report.quality.theta_min << " degrees\n"
            << "mean distance: " << report.distance.mean << " % of the diagonal\n";
  for (const std::string& guarantee : report.missed_guarantees())
    std::cout << "missed: " << guarantee << '\n';

  CGAL::IO::write_polygon_mesh(argc > 3 ? argv[3] : "remeshed.off", output,
                               CGAL::parameters::stream_precision(17));
  return report.missed_guarantees().empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}
