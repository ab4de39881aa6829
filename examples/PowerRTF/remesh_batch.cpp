// Remeshes many mesh files (or ellipsoids), several at a time.
//
//   remesh_batch [n input.off...]; the results are input_remeshed.off...
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/remesh_batch.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh ellipsoid(double height)
{
  Mesh mesh;
  CGAL::make_icosahedron<Mesh, Kernel::Point_3>(mesh);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(3));
  for (const auto v : vertices(mesh)) {
    const Kernel::Point_3& p = mesh.point(v);
    mesh.point(v) = Kernel::Point_3(p.x(), p.y(), height * p.z());
  }
  return mesh;
}

int main(int argc, char** argv)
{
  const std::vector<std::string> files(argv + (argc > 2 ? 2 : argc), argv + argc);
  const std::size_t meshes = files.empty() ? 8 : files.size();
  const std::size_t n = argc > 1 ? std::stoul(argv[1]) : 300;

  const auto remesh = [&](std::size_t i) {
    Mesh input, output;
    if (files.empty())
      input = ellipsoid(1 + 0.5 * double(i));
    else if (!CGAL::IO::read_polygon_mesh(files[i], input))
      throw std::runtime_error("it cannot be read");
    const auto report = CGAL::power_rtf_remeshing(input, n, output);
    if (!files.empty())
      CGAL::IO::write_polygon_mesh(files[i].substr(0, files[i].rfind('.')) + "_remeshed.off",
                                   output);
    return report;
  };
  const auto results = CGAL::PowerRTF::remesh_batch(meshes, remesh);

  int failures = 0;
  for (std::size_t i = 0; i < meshes; ++i) {
    std::cout << (files.empty() ? "ellipsoid " + std::to_string(i) : files[i]) << ": ";
    try {
      if (results[i].error) std::rethrow_exception(results[i].error);
      std::cout << results[i].report.topology.vertices << " vertices, least quality "
                << results[i].report.quality.q_min << '\n';
    } catch (const std::exception& e) {
      std::cout << e.what() << '\n';
      ++failures;
    }
  }
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
