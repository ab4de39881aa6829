// A program of another CMake project.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/power_rtf_remeshing.h>

int main()
{
  CGAL::Surface_mesh<CGAL::Exact_predicates_inexact_constructions_kernel::Point_3> in, out;
  if (!CGAL::IO::read_polygon_mesh("input.off", in)) return 1;
  const auto report = CGAL::power_rtf_remeshing(in, 3000, out);
  CGAL::IO::write_polygon_mesh("output.off", out);
  return report.missed_guarantees().empty() ? 0 : 3;
}
