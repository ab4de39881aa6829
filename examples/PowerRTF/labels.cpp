// Remeshes a sphere whose faces have labels, one for each half: the line between them is kept, and
// the new faces have the labels.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

#include <cstdlib>
#include <iostream>
#include <map>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace params = CGAL::PowerRTF::parameters;

int main()
{
  Mesh input, output;
  CGAL::make_icosahedron<Mesh, Kernel::Point_3>(input);
  CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(3));

  auto part = input.add_property_map<Mesh::Face_index, int>("f:part").first;
  for (const Mesh::Face_index f : input.faces())
    part[f] = input.point(input.target(input.halfedge(f))).z() > 0 ? 2 : 1;
  auto new_part = output.add_property_map<Mesh::Face_index, int>("f:part").first;

  const CGAL::PowerRTF::Remeshing_report report = CGAL::power_rtf_remeshing(
      input, 1000, output, params::face_patch_map(part), params::face_patch_map(new_part));

  std::map<int, int> faces;
  for (const Mesh::Face_index f : output.faces()) ++faces[new_part[f]];
  for (const auto& [label, count] : faces)
    std::cout << "part " << label << ": " << count << " faces\n";
  return report.missed_guarantees().empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}
