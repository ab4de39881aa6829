// Remeshes with the fast traits and compares their last cells with the exact ones; then runs the
// whole method on the exact traits.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/PowerRTF_exact_traits_3.h>
#include <CGAL/PowerRTF/exact/check_cells.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF_remesher.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Remesher = CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<Kernel>>;
using namespace CGAL::PowerRTF;

int main()
{
  Mesh input, output;
  CGAL::make_icosahedron<Mesh, Kernel::Point_3>(input);
  CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(3));

  Remeshing_options options;
  options.number_of_samples = 300;
  Remeshing_report report;
  Surface surface = prepare_surface(input, options, CGAL::parameters::default_values(), report);
  Remesher remesher(std::move(surface), options, report);
  Remeshing_default_visitor visitor;
  remesher.optimize(visitor);
  const Cell_comparison comparison = check_cells<CGAL::Sequential_tag>(
      remesher.samples(), remesher.cells(), compatibility_cosine(options.normal_angle));
  std::cout << comparison.equal_cycles << " of " << comparison.cells
            << " cells have the exact neighbors; " << comparison.certified_wrong
            << " are wrong beyond rounding\n";

  report = CGAL::power_rtf_remeshing(
      input, 100, output, CGAL::parameters::geom_traits(CGAL::PowerRTF_exact_traits_3<Kernel>()));
  std::cout << "exact traits: " << num_vertices(output) << " vertices\n";
  return comparison.passed() && report.missed_guarantees().empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}
