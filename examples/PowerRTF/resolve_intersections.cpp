// Remeshes facets that intersect themselves: resolved, as a network of sheets that share the
// vertices where they meet, and wrapped, as a closed surface. Facets go in and come out as a
// polygon soup, as no halfedge mesh holds edges of more than two facets.
//
//   resolve_intersections [input.off]
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF_remesher.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Remesher = CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<Kernel>>;
using namespace CGAL::PowerRTF;

int main(int argc, char** argv)
{
  // Two octahedra through each other.
  std::vector<Kernel::Point_3> points;
  std::vector<std::vector<std::size_t>> facets;
  if (argc > 1) {
    if (!CGAL::IO::read_polygon_soup(argv[1], points, facets)) {
      std::cerr << argv[1] << " cannot be read\n";
      return EXIT_FAILURE;
    }
  } else {
    for (const double shift : {0., 0.6}) {
      const std::size_t first = points.size();
      for (int axis = 0; axis < 3; ++axis)
        for (const double side : {1., -1.}) {
          double p[3] = {shift, 0.3 * shift, 0};
          p[axis] += side;
          points.emplace_back(p[0], p[1], p[2]);
        }
      for (std::size_t x : {0, 1})
        for (std::size_t y : {2, 3})
          for (std::size_t z : {4, 5}) facets.push_back({first + x, first + y, first + z});
    }
  }

  bool is_done = true;
  for (const Intersections intersections : {Intersections::resolve, Intersections::wrap}) {
    Remeshing_options options;
    options.number_of_samples = 1000;
    options.density = Density::uniform;
    options.intersections = intersections;
    Remeshing_report report;
    Surface surface = prepare_surface(points, facets, options, report);
    Remesher remesher(std::move(surface), options, report);
    Remeshing_default_visitor visitor;
    remesher.optimize(visitor);
    const Extracted_mesh mesh = remesher.extract(visitor);

    std::vector<Kernel::Point_3> output;
    for (const Vec3d& inside : mesh.points) {
      const Vec3d p = remesher.surface().normalization.to_outside(inside);
      output.emplace_back(p.x, p.y, p.z);
    }
    report = remesher.report();
    const std::string name = name_of(intersections);
    CGAL::IO::write_polygon_soup(name + ".off", output, mesh.triangles);
    std::cout << name << ": " << report.cure.resolved_pairs << " pairs of facets were cut, "
              << report.topology.sheets << " sheets, " << report.self_intersections
              << " self-intersections, " << report.cure.wrap_offset << " off the input\n";
    is_done = is_done && report.missed_guarantees().empty();
  }
  return is_done ? EXIT_SUCCESS : EXIT_FAILURE;
}
