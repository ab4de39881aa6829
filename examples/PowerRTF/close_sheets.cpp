// The paper's ablation (Figure 15): a thin disc with and without the normal verification that keeps
// its two sheets from cutting each other's cells (NVISPC). Writes the meshes with_nvispc.off and
// without_nvispc.off, and counts the cells that the other sheet cuts.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/extraction/export_mesh.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF_remesher.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using namespace CGAL::PowerRTF;

// A sphere flattened to a disc: the gap between the sheets is less than the spacing of the samples.
Mesh thin_disc()
{
  Mesh mesh;
  CGAL::make_icosahedron<Mesh, Point>(mesh);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(5));
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    mesh.point(v) = Point(p.x(), p.y(), 0.02 * p.z());
  }
  return mesh;
}

// Remeshes and returns the share of the cells that a sample of the other sheet bounds.
double remesh(const Mesh& disc, double normal_angle, const std::string& file)
{
  Remeshing_options options;
  options.number_of_samples = 500;
  options.density = Density::uniform;
  options.feature_angle = 180; // the rim is not to be a crease
  options.normal_angle = normal_angle;
  Remeshing_report report;
  Surface surface = prepare_surface(disc, options, CGAL::parameters::default_values(), report);
  CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<Kernel>> remesher(std::move(surface), options,
                                                                    report);
  Remeshing_default_visitor visitor;
  remesher.optimize(visitor);

  const std::vector<Vec3d> normals = remesher.samples().normals;
  const std::vector<Cell_polygon> cells = remesher.cells();
  std::size_t cut = 0;
  for (std::size_t i = 0; i < cells.size(); ++i)
    cut += std::any_of(cells[i].neighbors.begin(), cells[i].neighbors.end(),
                       [&](int j) { return j >= 0 && dot(normals[i], normals[j]) < -0.8; });

  Mesh output;
  export_mesh(remesher.extract(visitor), remesher.surface().normalization, output,
              CGAL::parameters::default_values());
  CGAL::IO::write_polygon_mesh(file, output);
  const double share = double(cut) / double(cells.size());
  std::cout << file << ": the other sheet cuts " << 100 * share << " % of the cells; "
            << "average quality of the triangles " << remesher.report().quality.q_avg << '\n';
  return share;
}

int main()
{
  const Mesh disc = thin_disc();
  const double with = remesh(disc, Remeshing_options().normal_angle, "with_nvispc.off");
  const double without = remesh(disc, 180, "without_nvispc.off");
  return with < 0.2 && without > 0.8 ? EXIT_SUCCESS : EXIT_FAILURE;
}
