// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A peer: CGAL::Polygon_mesh_processing::isotropic_remeshing(), with edges of one length or, from
// CGAL 6 on, as long as its Adaptive_sizing_field says.
//
//   cgal_isotropic_remeshing INPUT OUTPUT uniform LENGTH CREASE_ANGLE
//   cgal_isotropic_remeshing INPUT OUTPUT curvature TOLERANCE CREASE_ANGLE
//
// Lengths are in units of the diagonal of the bounding box. Edges are kept where the normals turn
// by more than CREASE_ANGLE degrees (180: none). Exit code 3: not with this CGAL.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/IO/polygon_mesh_io.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/detect_features.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/version.h>
#if CGAL_VERSION_NR >= 1060000000 && __has_include(<Eigen/Eigenvalues>)
#define HAS_ADAPTIVE_SIZING_FIELD
#include <CGAL/Polygon_mesh_processing/Adaptive_sizing_field.h>
#include <utility>
#endif

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace PMP = CGAL::Polygon_mesh_processing;

int main(int argc, char** argv)
{
  Mesh mesh;
  if (argc != 6 || !PMP::IO::read_polygon_mesh(argv[1], mesh) || !CGAL::is_triangle_mesh(mesh)) {
    std::cerr << "cgal_isotropic_remeshing: wrong usage, or " << (argc > 1 ? argv[1] : "")
              << " is no triangle mesh\n";
    return EXIT_FAILURE;
  }
  const CGAL::Bbox_3 box = PMP::bbox(mesh);
  const double diagonal = std::hypot(box.x_span(), box.y_span(), box.z_span());
  const double length = std::atof(argv[4]) * diagonal;
  const auto is_crease = mesh.add_property_map<Mesh::Edge_index, bool>("e:is_crease", false).first;
  const double crease_angle = std::atof(argv[5]);
  if (crease_angle < 180) PMP::detect_sharp_edges(mesh, crease_angle, is_crease);
  const auto parameters = CGAL::parameters::number_of_iterations(10)
                              .number_of_relaxation_steps(3)
                              .edge_is_constrained_map(is_crease);
  if (std::string(argv[3]) == "uniform") {
    PMP::isotropic_remeshing(faces(mesh), length, mesh, parameters);
  } else {
#ifdef HAS_ADAPTIVE_SIZING_FIELD
    const std::pair<double, double> range{0.001 * diagonal, 0.1 * diagonal};
    PMP::Adaptive_sizing_field<Mesh> sizing(length, range, faces(mesh), mesh);
    PMP::isotropic_remeshing(faces(mesh), sizing, mesh, parameters);
#else
    std::cerr << "cgal_isotropic_remeshing: an adaptive sizing needs CGAL 6 and Eigen\n";
    return 3;
#endif
  }
  mesh.collect_garbage();
  return CGAL::IO::write_polygon_mesh(argv[2], mesh, CGAL::parameters::stream_precision(17))
             ? EXIT_SUCCESS
             : EXIT_FAILURE;
}
