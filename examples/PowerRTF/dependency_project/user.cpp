// A program of another CMake project.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

int main()
{
  Mesh input, output;
  CGAL::make_icosahedron<Mesh, Kernel::Point_3>(input);
  const auto report = CGAL::power_rtf_remeshing(input, 100, output);
  return num_vertices(output) == 100 && report.missed_guarantees().empty() ? 0 : 1;
}
