// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A peer: pmp::uniform_remeshing() and pmp::adaptive_remeshing() of the Polygon Mesh Processing
// Library (pmp-library.org).
//
//   pmp_remeshing INPUT OUTPUT uniform LENGTH CREASE_ANGLE
//   pmp_remeshing INPUT OUTPUT curvature TOLERANCE CREASE_ANGLE
//
// Lengths are in units of the diagonal of the bounding box. Edges are kept where the normals turn
// by more than CREASE_ANGLE degrees (180: none).
#include <pmp/algorithms/features.h>
#include <pmp/algorithms/remeshing.h>
#include <pmp/algorithms/utilities.h>
#include <pmp/io/io.h>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

int main(int argc, char** argv)
{
  if (argc != 6) {
    std::cerr << "pmp_remeshing: wrong usage\n";
    return EXIT_FAILURE;
  }
  try {
    pmp::SurfaceMesh mesh;
    pmp::read(mesh, argv[1]);
    const double diagonal = pmp::bounds(mesh).size();
    const double length = std::atof(argv[4]) * diagonal;
    const double crease_angle = std::atof(argv[5]);
    if (crease_angle < 180) pmp::detect_features(mesh, crease_angle);
    if (std::string(argv[3]) == "uniform")
      pmp::uniform_remeshing(mesh, length);
    else
      pmp::adaptive_remeshing(mesh, 0.001 * diagonal, 0.1 * diagonal, length);
    pmp::write(mesh, argv[2]);
  } catch (const std::exception& error) {
    std::cerr << "pmp_remeshing: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
