// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Workload.h"

#include <CGAL/PowerRTF/PowerRTF_traits_3.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/fields/smooth_normals.h>
#include <CGAL/PowerRTF/input/import_surface.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/subdivision_method_3.h>
#include <CGAL/tags.h>

#include <cmath>
#include <memory>

namespace {

using namespace CGAL::PowerRTF;

/// A sphere with waves: its curvature varies over the surface.
Surface wavy_sphere()
{
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  using Mesh = CGAL::Surface_mesh<Point>;
  Mesh mesh;
  CGAL::make_icosahedron<Mesh, Point>(mesh);
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(6));
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    const Vec3d d = normalized(Vec3d{p.x(), p.y(), p.z()});
    const Vec3d q = d * (1 + 0.15 * std::sin(6 * d.x) * std::sin(5 * d.y) * std::cos(4 * d.z));
    mesh.point(v) = Point(q.x, q.y, q.z);
  }
  Repair_counts repairs;
  return import_surface(mesh, CGAL::parameters::default_values(), repairs);
}

Workload make(const Workload::Kind& kind)
{
  Workload w;
  w.kind = kind;
  w.options.number_of_samples = std::size_t(kind.n);
  w.options.density = kind.adaptive ? Density::curvature : Density::uniform;
  w.surface = wavy_sphere();
  set_density(w.surface, w.options);
  smooth_normals(w.surface, w.options.number_of_samples, w.options.normal_smoothing);
  w.options.sampling = !kind.regular      ? Sampling::random
                       : kind.n > 1000000 ? Sampling::stratified // others would take minutes
                                          : Sampling::elimination;
  w.samples = sample_surface(w.surface, w.options);
  if (!kind.regular) return w;
  Cpu_engine<CGAL::Parallel_if_available_tag> engine(w.surface, w.options);
  engine.set_samples(w.samples);
  for (int i = 0; i < 10; ++i) {
    engine.build_cells();
    engine.move_samples(Position_method::lloyd);
  }
  w.samples = engine.samples();
  return w;
}

} // namespace

const Workload& Workload::get(const Kind& kind)
{
  static std::unique_ptr<Workload> last;
  if (!last || !(last->kind == kind)) last = std::make_unique<Workload>(make(kind));
  return *last;
}

std::vector<Workload::Kind> Workload::kinds(int largest)
{
  std::vector<Kind> result;
  for (const bool adaptive : {false, true})
    for (const bool regular : {true, false})
      for (int n = 1000; n <= largest; n *= 10) result.push_back({n, regular, adaptive});
  return result;
}
