// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs with one number of samples each, as the search for the smallest that keeps a distance makes
// them: of each, one line of JSON with the certified bound, in per cent of the diagonal.
//
//   distance_runs INPUT DISTANCE uniform|curvature N ...
//
// DISTANCE: over the diagonal of the bounding box.
#include <CGAL/power_rtf_remeshing.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <utility>

namespace {

using namespace CGAL::PowerRTF;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Traits = CGAL::PowerRTF_traits_3<Kernel, CGAL::Sequential_tag>;

Remeshing_report run(const Mesh& mesh, const Remeshing_options& options)
{
  Remeshing_report report;
  Surface surface = prepare_surface(mesh, options, CGAL::parameters::default_values(), report);
  CGAL::PowerRTF_remesher<Traits> remesher(std::move(surface), options, report);
  Remeshing_default_visitor visitor;
  if (remesher.optimize(visitor)) remesher.extract_all(visitor);
  return remesher.report();
}

} // namespace

int main(int argc, char** argv)
{
  Mesh mesh;
  if (argc < 5 || !CGAL::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "distance_runs INPUT DISTANCE uniform|curvature N ...\n";
    return EXIT_FAILURE;
  }
  Remeshing_options options;
  options.relative_max_distance = std::atof(argv[2]);
  options.density = argv[3] == std::string("uniform") ? Density::uniform : Density::curvature;
  std::cout.precision(9);
  for (int k = 4; k < argc; ++k) {
    options.number_of_samples = std::strtoull(argv[k], nullptr, 10);
    try {
      const Remeshing_report report = run(mesh, options);
      std::cout << "{\"samples\": " << argv[k] << ", \"distance_bound\": " << report.distance.bound
                << ", \"missed\": " << report.missed_guarantees().size()
                << ", \"q_min\": " << report.quality.q_min
                << ", \"q_avg\": " << report.quality.q_avg
                << ", \"theta_min\": " << report.quality.theta_min
                << ", \"improvement\": " << report.seconds.improvement << "}" << std::endl;
    } catch (const Invalid_input_error&) { // the samples are too few: no line
    }
  }
}
