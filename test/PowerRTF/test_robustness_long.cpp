// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whole runs on what users bring: every guarantee must be met. Real models are run by
// benchmark/PowerRTF/Robustness.
#include "dirty_shapes.h"

#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF_remesher.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <doctest/doctest.h>

#include <string>

namespace PRTF = CGAL::PowerRTF;

namespace {

std::string missed_guarantees(const shapes::Soup& soup, std::size_t n, PRTF::Density density)
{
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  PRTF::Remeshing_options options;
  options.number_of_samples = n;
  options.density = density;
  PRTF::Repair_counts repairs;
  PRTF::Surface surface = PRTF::import_soup(soup.points, soup.triangles, repairs);
  PRTF::set_creases(surface, options);
  PRTF::set_density(surface, options);
  CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<Kernel>> remesher(std::move(surface), options);
  PRTF::Remeshing_default_visitor visitor;
  remesher.optimize(visitor);
  remesher.extract(visitor);
  std::string text;
  for (const std::string& missed : remesher.report().missed_guarantees()) text += missed + "; ";
  return text;
}

void check_met(const std::string& name, const shapes::Soup& soup, std::size_t n)
{
  CAPTURE(name);
  CAPTURE(n);
  for (const PRTF::Density density : {PRTF::Density::uniform, PRTF::Density::curvature})
    CHECK(missed_guarantees(soup, n, density) == "");
}

} // namespace

TEST_CASE("spheres with a defect")
{
  for (const auto& [name, soup] : shapes::dirty_spheres()) check_met(name, soup, 300);
}

TEST_CASE("from far fewer samples than vertices to far more")
{
  const shapes::Soup sphere = shapes::icosphere(3), torus = shapes::torus(40, 20, 2, 0.7);
  check_met("sphere", sphere, 20);
  check_met("torus", torus, 20);
  for (const auto& [name, soup] :
       {std::pair{"tetrahedron", shapes::tetrahedron()}, std::pair{"cube", shapes::box(1)},
        std::pair{"coarse sphere", shapes::icosphere(1)}})
    check_met(name, soup, 50 * soup.points.size());
}

TEST_CASE("several components of very different sizes")
{
  shapes::Soup many = shapes::icosphere(2);
  for (int i = 0; i < 8; ++i)
    many = shapes::joined(many, shapes::translated(shapes::scaled(shapes::torus(20, 10, 2, 0.7),
                                                                  0.003 * double(1 << i)),
                                                   {3. + 2 * i, 0, 0}));
  check_met("a sphere and eight tori", many, 500);
  check_met("the same with few samples", many, 120);
}

TEST_CASE("plates with holes, thick and thin")
{
  for (const double thickness : {1., 0.1, 0.01}) {
    shapes::Soup plate = shapes::plate_with_holes(3, 3);
    for (auto& p : plate.points) p.z *= thickness;
    for (const std::size_t n : {std::size_t(200), std::size_t(1000)})
      check_met("plate of thickness " + std::to_string(thickness), plate, n);
  }
}

TEST_CASE("close sheets, one-sided and open surfaces")
{
  for (const double gap : {0.05, 0.005}) check_met("thin disc", shapes::thin_disc(gap), 500);
  check_met("Moebius strip", shapes::moebius_strip(40), 300);
  check_met("cylinder", shapes::open_cylinder(40, 10, 1, 2), 300);
  check_met("square", shapes::plane_patch(10, 10), 300);
}
