// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes shapes of the tests as models for the drivers: mechanical parts, shapes that intersect
// themselves, or those that are hard to remesh.
//
//   shape_models cad|crossing|hard FOLDER
#include "crossing_shapes.h"
#include "hard_shapes.h"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <cstdlib>
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace {

shapes::Named_shapes cad_shapes()
{
  return {{"gear_chamfered", shapes::gear(0.5)},
          {"bracket", shapes::bracket(3, 16)},
          {"plate", shapes::drilled_plate(3, 2)}};
}

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
  const std::map<std::string, std::function<shapes::Named_shapes()>> sets{
      {"cad", cad_shapes}, {"crossing", shapes::crossing_shapes}, {"hard", shapes::hard_shapes}};
  const auto set = argc == 3 ? sets.find(argv[1]) : sets.end();
  if (set == sets.end()) {
    std::cerr << "shape_models cad|crossing|hard FOLDER\n";
    return EXIT_FAILURE;
  }
  for (const auto& [name, soup] : set->second()) {
    const std::string file = std::string(argv[2]) + '/' + name + ".off";
    if (!write(file, soup)) {
      std::cerr << "shape_models: cannot write " << file << '\n';
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}
