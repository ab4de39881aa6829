// Remeshes on an NVIDIA GPU. Programs that use the CUDA traits link PowerRTF::cuda.
//
//   cuda_remesh [input.off [number_of_vertices [output.off]]]
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/PowerRTF_cuda_traits_3.h>
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
using Traits = CGAL::PowerRTF_cuda_traits_3<Kernel>;

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
    CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(4));
  }
  const std::size_t number_of_vertices = argc > 2 ? std::stoul(argv[2]) : 1000;

  try {
    const CGAL::PowerRTF::Remeshing_report report = CGAL::power_rtf_remeshing(
        input, number_of_vertices, output, CGAL::parameters::geom_traits(Traits()));
    std::cout << report.device.name << ": " << 1e3 * report.device.seconds << " ms for "
              << report.constructions << " constructions of " << number_of_vertices << " cells, "
              << double(report.device.bytes) / 1e6 << " MB\n"
              << "triangle quality: " << report.quality.q_min << " (worst), "
              << report.quality.q_avg << " (mean)\n";
  } catch (const CGAL::PowerRTF::Cuda_error& error) { // no GPU, or one that cannot be used
    std::cout << "skipped: " << error.what() << '\n';
    return 77;
  }
  if (argc > 3)
    CGAL::IO::write_polygon_mesh(argv[3], output, CGAL::parameters::stream_precision(17));
  return EXIT_SUCCESS;
}
