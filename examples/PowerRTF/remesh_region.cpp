// Remeshes a part of a sphere, finer; the rest stays as it is, and the new faces are joined to it.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

#include <cstdlib>
#include <iostream>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using CGAL::PowerRTF::Resolution;

int main()
{
  Mesh mesh;
  CGAL::make_icosahedron<Mesh, Kernel::Point_3>(mesh);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(3));

  std::vector<Mesh::Face_index> region;
  for (const Mesh::Face_index f : mesh.faces())
    if (mesh.point(mesh.target(mesh.halfedge(f))).z() > 0.3) region.push_back(f);

  const CGAL::PowerRTF::Remeshing_report report =
      CGAL::power_rtf_remeshing(region, mesh, Resolution::edge_length(0.05));

  std::cout << region.size() << " faces became " << report.topology.faces << ", "
            << report.kept_faces << " stayed\n";
  return report.missed_guarantees().empty() && CGAL::is_closed(mesh) ? EXIT_SUCCESS : EXIT_FAILURE;
}
