// Reads a Polyhedron_3 through a point map of one's own, which moves the points on the fly, and
// writes into a property map of a Surface_mesh.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Mesh = CGAL::Surface_mesh<Point>;

// The points of a polyhedron, twice as high.
struct Stretched_points {
  using key_type = boost::graph_traits<Polyhedron>::vertex_descriptor;
  using value_type = Point;
  using reference = Point;
  using category = boost::readable_property_map_tag;

  friend Point get(const Stretched_points&, key_type v)
  {
    const Point& p = v->point();
    return Point(p.x(), p.y(), 2 * p.z());
  }
};

int main()
{
  Polyhedron input;
  CGAL::make_icosahedron<Polyhedron, Point>(input);
  CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(3));
  Mesh output;
  auto remeshed = output.add_property_map<Mesh::Vertex_index, Point>("v:remeshed").first;

  CGAL::power_rtf_remeshing(input, 400, output,
                            CGAL::parameters::vertex_point_map(Stretched_points()),
                            CGAL::parameters::vertex_point_map(remeshed));

  CGAL::Bbox_3 box;
  for (const auto v : output.vertices()) box += remeshed[v].bbox();
  std::cout << num_vertices(output) << " vertices in [" << box << "]\n";
  return box.zmax() > 1.5 * box.xmax() ? EXIT_SUCCESS : EXIT_FAILURE;
}
