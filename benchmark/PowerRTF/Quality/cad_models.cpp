// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the mechanical parts of the tests, as models for reproduce.py.
//
//   cad_models FOLDER
#include "cad_shapes.h"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace {

bool write(const std::string& file, const shapes::Soup& soup)
{
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
  for (const shapes::Vec3d& p : soup.points) points.emplace_back(p.x, p.y, p.z);
  return CGAL::IO::write_polygon_soup(file, points, soup.triangles,
                                      CGAL::parameters::stream_precision(17));
}

} // namespace

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::cerr << "cad_models FOLDER\n";
    return EXIT_FAILURE;
  }
  const std::string folder = std::string(argv[1]) + '/';
  if (!write(folder + "gear_chamfered.off", shapes::gear(0.5)) ||
      !write(folder + "bracket.off", shapes::bracket(3, 16))) {
    std::cerr << "cad_models: cannot write to " << argv[1] << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
