// Runs the method with the parameters of the paper, through the class, and writes the cells F_i as
// polygons that ParaView reads (power_rtf_remesh --cells also writes what belongs to them).
//
//   paper_preset_cells [input.off]
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF_remesher.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Remesher = CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<Kernel>>;
using namespace CGAL::PowerRTF;

// One polygon per cell; vertices are not shared.
void write_off(std::ostream& out, const std::vector<Cell_polygon>& cells,
               const Normalization& normalization)
{
  std::size_t vertices = 0;
  for (const Cell_polygon& cell : cells) vertices += cell.vertices.size();
  out << "OFF\n" << vertices << ' ' << cells.size() << " 0\n";
  out.precision(9);
  for (const Cell_polygon& cell : cells)
    for (const Vec3d& inside : cell.vertices) {
      const Vec3d p = normalization.to_outside(inside);
      out << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
  std::size_t next = 0;
  for (const Cell_polygon& cell : cells) {
    out << cell.vertices.size();
    for (std::size_t k = 0; k < cell.vertices.size(); ++k) out << ' ' << next++;
    out << '\n';
  }
}

int main(int argc, char** argv)
{
  Mesh input;
  if (argc > 1) {
    if (!CGAL::IO::read_polygon_mesh(argv[1], input)) return EXIT_FAILURE;
  } else {
    CGAL::make_icosahedron<Mesh, Kernel::Point_3>(input);
    CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(3));
  }

  Remeshing_options options = Remeshing_options::paper_preset();
  options.number_of_samples = 500;
  options.density = Density::uniform;

  Remeshing_report report;
  Surface surface = prepare_surface(input, options, CGAL::parameters::default_values(), report);
  Remesher remesher(std::move(surface), options, report);
  Remeshing_default_visitor visitor;
  remesher.optimize(visitor);

  report = remesher.report();
  std::cout << report.constructions << " constructions; " << 100 * report.capacity.inside_interval
            << " % of the cells inside " << 100 * options.capacity_tolerance
            << " % of the mean capacity\n";
  std::ofstream out("cells.off");
  write_off(out, remesher.cells(), remesher.surface().normalization);
  return report.capacity.inside_interval == 1 && out.good() ? EXIT_SUCCESS : EXIT_FAILURE;
}
