// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What cells are made of, as Python keeps it: a dictionary of arrays, which can be pickled. The
// cells themselves are made when they are asked for.
#ifndef POWER_RTF_PYTHON_CELLS_H
#define POWER_RTF_PYTHON_CELLS_H

#include "arrays.h"

#include <CGAL/PowerRTF/cells/cells_of_sites.h>
#include <CGAL/PowerRTF/cells/mirror_images.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <optional>
#include <vector>

namespace powerrtf {

using CGAL::PowerRTF::Cell_polygon;
using CGAL::PowerRTF::Cell_sites;
using CGAL::PowerRTF::Normalization;

/// The sites of a run in the unit box, and the way out of it.
struct Placed_sites {
  Cell_sites in;
  Normalization normalization;
  std::optional<CGAL::PowerRTF::Mirror_plane> mirror; ///< the sites are those above it
  bool faces_as_input = true;                         ///< see `Remeshing_report`
};

template <class Remesher>
Placed_sites sites_of(const Remesher& remesher)
{
  const auto& options = remesher.options();
  Placed_sites sites;
  sites.normalization = remesher.surface().normalization;
  sites.mirror = remesher.mirror();
  sites.faces_as_input = remesher.report().faces_as_input();
  sites.in.samples = remesher.sites();
  sites.in.cells = static_cast<int>(options.number_of_samples - remesher.features().size());
  sites.in.area = remesher.surface().area;
  sites.in.cos_angle = CGAL::PowerRTF::compatibility_cosine(options.normal_angle);
  sites.in.guard_factor = options.guard_factor;
  return sites;
}

inline nb::dict to_python(Placed_sites&& sites)
{
  Cell_sites& in = sites.in;
  const Vec3d& center = sites.normalization.center;
  nb::dict d;
  d["points"] = to_array<double>(std::move(in.samples.points));
  d["normals"] = to_array<double>(std::move(in.samples.normals));
  d["density"] = to_array<double>(std::move(in.samples.density));
  d["weights"] = to_array<double>(std::move(in.samples.weights));
  d["patches"] = to_array<int>(std::move(in.samples.patches));
  d["cells"] = in.cells;
  d["area"] = in.area;
  d["cos_angle"] = in.cos_angle;
  d["guard_factor"] = in.guard_factor;
  d["center"] = nb::make_tuple(center.x, center.y, center.z);
  d["scale"] = sites.normalization.scale;
  d["mirror"] =
      sites.mirror ? nb::object(nb::make_tuple(sites.mirror->axis, sites.mirror->at)) : nb::none();
  d["faces_as_input"] = sites.faces_as_input;
  return d;
}

inline Normalization normalization_from_python(const nb::dict& d)
{
  Normalization normalization;
  const auto center = nb::cast<nb::tuple>(d["center"]);
  normalization.center = {nb::cast<double>(center[0]), nb::cast<double>(center[1]),
                          nb::cast<double>(center[2])};
  normalization.scale = nb::cast<double>(d["scale"]);
  return normalization;
}

inline Placed_sites sites_from_python(const nb::dict& d)
{
  Placed_sites sites;
  Cell_sites& in = sites.in;
  const auto reals = [&](const char* name) {
    return numbers_of_array(nb::cast<Real_array>(d[name]));
  };
  in.samples.points = points_of_array(nb::cast<Real_array>(d["points"]));
  in.samples.normals = points_of_array(nb::cast<Real_array>(d["normals"]));
  in.samples.density = reals("density");
  in.samples.weights = reals("weights");
  for_each_index(nb::cast<Index_array>(d["patches"]),
                 [&](std::size_t, auto patch) { in.samples.patches.push_back(int(patch)); });
  in.cells = nb::cast<int>(d["cells"]);
  in.area = nb::cast<double>(d["area"]);
  in.cos_angle = nb::cast<double>(d["cos_angle"]);
  in.guard_factor = nb::cast<double>(d["guard_factor"]);
  sites.normalization = normalization_from_python(d);
  if (!d["mirror"].is_none()) {
    const auto plane = nb::cast<nb::tuple>(d["mirror"]);
    sites.mirror = {nb::cast<int>(plane[0]), nb::cast<double>(plane[1])};
  }
  return sites;
}

/// The cells of the whole, with the images of those of a half.
template <class Concurrency>
std::vector<Cell_polygon> whole_cells(const Placed_sites& sites)
{
  return with_images(CGAL::PowerRTF::cells_of_sites<Concurrency>(sites.in), sites.mirror);
}

/// The cells as arrays: all corners, where each cell's begin (and the last's end), and of each cell
/// its area, mass, density, weight and status. In the input's units.
template <class Concurrency>
nb::dict cells(const nb::dict& of)
{
  const Placed_sites sites = sites_from_python(of);
  const double square = 1 / (sites.normalization.scale * sites.normalization.scale);
  std::vector<Vec3d> points;
  std::vector<int> first{0}, status;
  std::vector<double> area, mass, density, weight;
  {
    const nb::gil_scoped_release release;
    for (const Cell_polygon& cell : whole_cells<Concurrency>(sites)) {
      for (const Vec3d& p : cell.vertices) points.push_back(sites.normalization.to_outside(p));
      first.push_back(static_cast<int>(points.size()));
      status.push_back(static_cast<int>(cell.status));
      area.push_back(square * cell.area);
      mass.push_back(square * cell.mass);
      density.push_back(cell.density);
      weight.push_back(square * cell.weight);
    }
  }
  nb::dict d;
  d["points"] = to_array<double>(std::move(points));
  d["first"] = to_array<int>(std::move(first));
  d["area"] = to_array<double>(std::move(area));
  d["mass"] = to_array<double>(std::move(mass));
  d["density"] = to_array<double>(std::move(density));
  d["weight"] = to_array<double>(std::move(weight));
  d["status"] = to_array<int>(std::move(status));
  return d;
}

} // namespace powerrtf

#endif // POWER_RTF_PYTHON_CELLS_H
