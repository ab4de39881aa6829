// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A peer: CGAL's Mesh_3, surface only (restricted Delaunay refinement), of a closed polyhedral
// surface: facets of one size, or, for `curvature`, as small as a bound on their distance to the
// surface asks for.
//
//   cgal_mesh_3 INPUT OUTPUT uniform|curvature LENGTH CREASE_ANGLE
//
// LENGTH is in units of the diagonal of the bounding box. Edges are kept where the normals turn by
// more than CREASE_ANGLE degrees (180: none).
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/facets_in_complex_3_to_triangle_mesh.h>
#include <CGAL/make_mesh_3.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel, Mesh>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
namespace PMP = CGAL::Polygon_mesh_processing;
using namespace CGAL::parameters;

int main(int argc, char** argv)
{
  Mesh mesh, output;
  if (argc != 6 || !PMP::IO::read_polygon_mesh(argv[1], mesh) || !CGAL::is_triangle_mesh(mesh) ||
      !CGAL::is_closed(mesh)) {
    std::cerr << "cgal_mesh_3: wrong usage, or " << (argc > 1 ? argv[1] : "")
              << " is no closed triangle mesh\n";
    return EXIT_FAILURE;
  }
  const CGAL::Bbox_3 box = PMP::bbox(mesh);
  const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
  const double length = std::atof(argv[4]) * diagonal;
  const bool uniform = std::string(argv[3]) == "uniform";
  CGAL::get_default_random() = CGAL::Random(0);
  const Mesh* surfaces[] = {&mesh};
  Domain domain(surfaces, surfaces + 1); // of surfaces: what is inside is not meshed
  const double crease_angle = std::atof(argv[5]);
  if (crease_angle < 180) domain.detect_features(crease_angle);
  const double largest = uniform ? length : 0.1 * diagonal;
  const Criteria criteria =
      uniform ? Criteria(edge_size = largest, facet_angle = 30, facet_size = largest,
                         facet_topology = CGAL::MANIFOLD)
              : Criteria(edge_size = largest, facet_angle = 30, facet_size = largest,
                         facet_distance = length, facet_topology = CGAL::MANIFOLD);
  const Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria, no_perturb(), no_exude());
  CGAL::facets_in_complex_3_to_triangle_mesh(complex, output);
  return CGAL::IO::write_polygon_mesh(argv[2], output, stream_precision(17)) ? EXIT_SUCCESS
                                                                             : EXIT_FAILURE;
}
