// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The nodes of a lattice as they are made where its fields are.
#include "packed.h"
#include "shapes.h"

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/sampling/Lattice_field.h>
#include <CGAL/PowerRTF/sampling/plan_lattice.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

using namespace CGAL::PowerRTF;

namespace {

/// Three components, of which the last one gets no samples; their edges have equal lengths in
/// pairs.
Surface three_components()
{
  const auto at = [](const shapes::Soup& soup, double x) {
    return shapes::translated(soup, {x, 0.1, 0.2});
  };
  Surface surface = shapes::make_surface(
      shapes::joined(at(shapes::torus(24, 12, 2, 0.8), 0),
                     shapes::joined(at(shapes::box(6), 4), at(shapes::icosphere(2), 8))));
  for (std::size_t v = 0; v < surface.points.size(); ++v)
    surface.vertex_density[v] = 1 + 4 * surface.points[v].x * surface.points[v].x;
  return surface;
}

struct Planned {
  Surface surface = three_components();
  std::vector<int> component = facet_components(surface.adjacency).first;
  Lattice_plan plan;

  explicit Planned(const Facet_tree& tree)
  {
    std::vector<Component_share> shares{{700, 0, 0}, {300, 0, 0}, {0, 0, 0}};
    for (std::size_t f = 0; f < component.size(); ++f)
      shares[component[f]].mass += internal::density_mass(surface, int(f));
    for (Component_share& share : shares) share.cell_mass = share.mass / double(share.samples);
    plan = lattice_plan(surface, cube_around(surface, CGAL::Sequential_tag()), tree, {}, component,
                        shares, 5, CGAL::Sequential_tag());
  }
};

template <class Real>
Sample_candidates nodes_of(const Packed<Real>& packed, const Lattice_plan& plan,
                           const std::vector<unsigned char>& components)
{
  Packed_backend backend;
  return Lattice_field<Packed_backend>(backend, packed.view(), plan).nodes_of(components);
}

} // namespace

TEST_CASE("nodes are on their facets, and each component has its share")
{
  const Surface surface = three_components();
  const Packed<double> packed(surface);
  const Planned planned(packed.tree);
  const Lattice_plan& plan = planned.plan;
  std::size_t first = 0;
  for (const std::size_t c : {0u, 1u, 2u}) {
    std::vector<unsigned char> is_wanted(3, 0);
    is_wanted[c] = 1;
    const Sample_candidates nodes = nodes_of(packed, plan, is_wanted);
    CHECK(std::abs(int(nodes.size()) - int(4 * plan.shares[c].samples)) <= 1);
    first += nodes.size();
    double farthest = 0, worst_normal = 0, worst_spacing = 0;
    for (const Sample_candidate& node : nodes) {
      const int f = packed.tree.order()[node.node.facet];
      REQUIRE(planned.component[f] == int(c));
      CHECK(node.node.component == int(c));
      CHECK(node.distance == -1);
      CHECK(node.point == node.node.point);
      const Vec3d p = plan.cube.to_outside(to_double(node.point));
      const Facet_corners<double> corners = packed.view().facets[node.node.facet];
      const Vec3d on_facet = nearest_point_on_triangle(p, corners.a, corners.b, corners.c);
      farthest = std::max(farthest, length(p - on_facet));
      const Vertex_attributes<double> there =
          attributes_of_facet(packed.view(), on_facet, node.node.facet);
      worst_normal = std::max(worst_normal, length(to_double(node.node.normal) - there.normal));
      const double h =
          plan.cube.scale * std::sqrt(2 / std::sqrt(3.) * plan.shares[c].cell_mass / there.density);
      worst_spacing = std::max(worst_spacing, std::abs(double(node.node.spacing) / h - 1));
    }
    CHECK(farthest < 2e-7);
    CHECK(worst_normal < 1e-5);
    CHECK(worst_spacing < 1e-6);
  }
  CHECK(first == plan.free.front());
}

TEST_CASE("nodes of a surface in single precision are the same but for rounding")
{
  const Surface surface = three_components();
  const Packed<double> exact(surface);
  const Packed<float> rounded(surface);
  const Planned planned(exact.tree);
  const Sample_candidates a = nodes_of(exact, planned.plan, {1, 1, 1});
  const Sample_candidates b = nodes_of(rounded, planned.plan, {1, 1, 1});
  REQUIRE(a.size() == planned.plan.free.front());
  REQUIRE(b.size() == a.size());
  int differ = 0; // where rounding decides into which half of a facet a node falls
  for (std::size_t k = 0; k < a.size(); ++k) {
    CHECK(a[k].node.facet == b[k].node.facet);
    CHECK(a[k].node.component == b[k].node.component);
    differ += !(length(a[k].point - b[k].point) < 1e-6f &&
                length(a[k].node.normal - b[k].node.normal) < 1e-5f &&
                std::abs(a[k].node.spacing / b[k].node.spacing - 1) < 1e-6f);
  }
  CHECK(differ <= 2);
}
