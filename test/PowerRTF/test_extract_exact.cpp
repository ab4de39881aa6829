// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The exact extraction: where sampling is dense it is the restricted Delaunay triangulation; on
// close sheets it keeps them apart.
#include <doctest/doctest.h>

#include "shapes.h"

#include "extract_exact.h"
#include <CGAL/PowerRTF/PowerRTF_traits_3.h>
#include <CGAL/PowerRTF/extraction/extract_restricted_delaunay.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/quality/topology.h>
#include <CGAL/PowerRTF_remesher.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <set>

using namespace CGAL::PowerRTF;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Remesher = CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<Kernel, CGAL::Sequential_tag>>;

namespace {

/// Even samples with the weights of equal capacities.
Samples even_samples(const Surface& surface, std::size_t n)
{
  Remeshing_options options;
  options.number_of_samples = n;
  options.density = Density::uniform;
  options.max_iterations = 30;
  Remesher remesher(surface, options);
  Remeshing_default_visitor visitor;
  remesher.optimize(visitor);
  return remesher.samples();
}

void check_manifold(const Extracted_mesh& mesh, long euler_characteristic)
{
  const Topology_statistics t = topology(mesh.triangles);
  CHECK(t.non_manifold_edges == 0);
  CHECK(t.non_manifold_vertices == 0);
  CHECK(t.border_edges == 0);
  CHECK(t.oriented);
  CHECK(t.euler_characteristic == euler_characteristic);
}

} // namespace

TEST_CASE("dense sampling: the restricted Delaunay triangulation")
{
  for (const auto& [soup, characteristic] :
       {std::pair{shapes::icosphere(3), 2}, std::pair{shapes::torus(60, 30, 3, 1), 0},
        std::pair{shapes::ellipsoid(1, 0.6, 0.4, 3), 2}, std::pair{shapes::two_spheres(3), 4}}) {
    const Surface surface = shapes::make_surface(soup);
    const Samples samples = even_samples(surface, 400);
    const Extracted_mesh exact = extract_exact(surface, samples);
    CHECK(exact.points.size() == samples.size());
    check_manifold(exact, characteristic);
    const Extracted_mesh fast = extract_restricted_delaunay(surface, samples);
    CHECK(shapes::sorted(exact.triangles) == shapes::sorted(fast.triangles));
    const Extracted_mesh weighted = extract_exact(surface, samples, true);
    CHECK(topology(weighted.triangles).oriented);
    CHECK(topology(weighted.triangles).euler_characteristic == characteristic);
  }
}

TEST_CASE("two close sheets are kept apart")
{
  const Surface surface = shapes::make_surface(shapes::thin_disc(0.01));
  const Samples samples = even_samples(surface, 300);
  check_manifold(extract_exact(surface, samples), 2);
  const Topology_statistics t = topology(extract_restricted_delaunay(surface, samples).triangles);
  CHECK(t.non_manifold_edges > 0); // what the components are for
}

TEST_CASE("power: a lighter sample loses, the heaviest ones share the surface")
{
  const Surface surface = shapes::make_surface(shapes::icosphere(2));
  Samples samples = even_samples(surface, 60);
  samples.weights.assign(60, 0.);
  CHECK(shapes::sorted(extract_exact(surface, samples, true).triangles) ==
        shapes::sorted(extract_exact(surface, samples).triangles));
  samples.weights[17] = -1;
  const Extracted_mesh mesh = extract_exact(surface, samples, true);
  check_manifold(mesh, 2);
  std::set<int> used;
  for (const Triangle& t : mesh.triangles) used.insert(t.begin(), t.end());
  CHECK(used.size() == 59);
  CHECK(used.count(17) == 0);
}

TEST_CASE("degenerate positions: samples on the vertices, edges and symmetry planes of a box")
{
  const Surface surface = shapes::make_surface(shapes::box(4));
  Samples samples; // all vertices: cocircular by fours, bisectors along edges and through vertices
  samples.points = surface.points;
  samples.facets.assign(samples.points.size(), -1);
  const Extracted_mesh mesh = extract_exact(surface, samples);
  CHECK(mesh.points.size() == samples.size());
  check_manifold(mesh, 2);
}

TEST_CASE("few samples")
{
  const Surface surface = shapes::make_surface(shapes::icosphere(2));
  CHECK(extract_exact(surface, Samples()).triangles.empty());
  for (int n : {1, 2, 3}) {
    Samples samples;
    for (int k = 0; k < n; ++k) {
      samples.facets.push_back(50 * k);
      samples.points.push_back(surface.points[surface.triangles[50 * k][0]]);
    }
    const Extracted_mesh mesh = extract_exact(surface, samples);
    CHECK(mesh.points.size() == std::size_t(n));
    CHECK(mesh.triangles.size() == (n == 3 ? 1u : 0u)); // both corners of three cells: one triple
  }
}
