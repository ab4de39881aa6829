// Remeshes a mesh file (or a sphere) and gives the result the values that the input's vertices and
// faces have: here heights, and labels of the two halves.
//
//   transfer_values [input.off]
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/transfer/Mesh_source.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/power_rtf_remeshing.h>
#include <CGAL/subdivision_method_3.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iostream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = Mesh::Vertex_index;
using Face = Mesh::Face_index;
using Source = CGAL::PowerRTF::Mesh_source<Mesh>;

int main(int argc, char** argv)
{
  Mesh input, output;
  if (argc > 1) {
    if (!CGAL::IO::read_polygon_mesh(argv[1], input)) {
      std::cerr << argv[1] << " cannot be read\n";
      return EXIT_FAILURE;
    }
  } else {
    CGAL::make_icosahedron<Mesh, Kernel::Point_3>(input);
    CGAL::Subdivision_method_3::Loop_subdivision(input, CGAL::parameters::number_of_iterations(3));
  }
  auto heights = input.add_property_map<Vertex, double>("v:height").first;
  for (const Vertex v : input.vertices()) heights[v] = input.point(v).z();
  auto labels = input.add_property_map<Face, int>("f:label").first;
  for (const Face f : input.faces()) labels[f] = heights[target(halfedge(f, input), input)] > 0;

  auto vertex_sources = output.add_property_map<Vertex, Source>("v:source").first;
  auto face_sources = output.add_property_map<Face, Source>("f:source").first;
  namespace params = CGAL::PowerRTF::parameters;
  const CGAL::PowerRTF::Remeshing_report report = CGAL::power_rtf_remeshing(
      input, 1000, output, params::default_values(),
      params::vertex_source_map(vertex_sources).face_source_map(face_sources));

  auto new_heights = output.add_property_map<Vertex, double>("v:height").first;
  CGAL::PowerRTF::transfer_vertex_values(output, vertex_sources, heights, new_heights);
  auto new_labels = output.add_property_map<Face, int>("f:label").first;
  CGAL::PowerRTF::transfer_face_values(output, face_sources, labels, new_labels);

  double error = 0;
  for (const Vertex v : output.vertices())
    error = (std::max)(error, std::abs(new_heights[v] - output.point(v).z()));
  std::size_t above = 0;
  for (const Face f : output.faces()) above += new_labels[f];
  std::cout << "heights are right up to " << error << "; " << above << " of " << num_faces(output)
            << " faces are of the upper half\n";
  return report.missed_guarantees().empty() ? EXIT_SUCCESS : EXIT_FAILURE;
}
