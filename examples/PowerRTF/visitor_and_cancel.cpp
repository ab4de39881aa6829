// Watches a run, and stops it as soon as the samples hardly move any more.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

#include <cstdlib>
#include <functional>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

struct Watcher : CGAL::PowerRTF::Remeshing_default_visitor {
  int patience;
  int iterations = 0;

  explicit Watcher(int patience) : patience(patience) {}

  void on_stage(const char* name) { std::cout << name << '\n'; }
  void on_iteration(const CGAL::PowerRTF::Iteration_report& iteration, double progress)
  {
    if (++iterations % 20 == 0)
      std::cout << "  " << int(100 * progress) << " %, the samples are " << iteration.displacement
                << " of their spacing from their cells' centers\n";
  }
  bool go_further() { return iterations < patience; } // false: stop, and make no mesh
};

int main()
{
  Mesh input, output;
  CGAL::make_icosahedron<Mesh, Kernel::Point_3>(input);
  CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(3));

  // std::ref: the visitor itself is used, not a copy.
  Watcher patient(1000), impatient(5);
  CGAL::power_rtf_remeshing(input, 500, output, CGAL::parameters::visitor(std::ref(patient)));
  const auto faces = num_faces(output);

  const CGAL::PowerRTF::Remeshing_report report =
      CGAL::power_rtf_remeshing(input, 800, output, CGAL::parameters::visitor(std::ref(impatient)));
  std::cout << (report.cancelled ? "cancelled" : "done") << " after " << impatient.iterations
            << " iterations; the output has " << num_faces(output) << " faces, as before\n";
  return report.cancelled && num_faces(output) == faces ? EXIT_SUCCESS : EXIT_FAILURE;
}
