// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the tests' shapes that intersect themselves, as models for intersections.py.
//
//   crossing_models FOLDER
#include "crossing_shapes.h"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::cerr << "crossing_models FOLDER\n";
    return EXIT_FAILURE;
  }
  for (const auto& [name, soup] : shapes::crossing_shapes()) {
    std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
    for (const shapes::Vec3d& p : soup.points) points.emplace_back(p.x, p.y, p.z);
    const std::string file = std::string(argv[1]) + '/' + name + ".off";
    if (!CGAL::IO::write_polygon_soup(file, points, soup.triangles,
                                      CGAL::parameters::stream_precision(17))) {
      std::cerr << "crossing_models: cannot write " << file << '\n';
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}
