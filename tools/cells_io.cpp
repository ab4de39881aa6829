// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "cells_io.h"

#include "dataset.h"

#include <numeric>

namespace tools {
namespace {

using CGAL::PowerRTF::Cell_polygon;
using CGAL::PowerRTF::Normalization;
using CGAL::PowerRTF::Samples;

void write(std::ostream& out, Format format, Encoding encoding, const Dataset& data)
{
  format == Format::ply ? write_ply(out, data, encoding) : write_vtp(out, data);
}

/// The factor of areas and of squared lengths.
double outside_square(const Normalization& normalization)
{
  return 1 / (normalization.scale * normalization.scale);
}

} // namespace

void write_cells(std::ostream& out, Format format, Encoding encoding,
                 const std::vector<Cell_polygon>& cells, const Normalization& normalization,
                 std::size_t half)
{
  const std::size_t images = half > 0 ? cells.size() / 2 : cells.size(); // where they begin

  const double square = outside_square(normalization);
  Dataset data;
  Field sample{"sample", {}, {}}, status{"status", {}, {}}, weight{"weight", {}, {}},
      mass{"mass", {}, {}}, density{"density", {}, {}};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell_polygon& cell = cells[i];
    if (cell.vertices.empty()) continue;
    std::vector<int> polygon(cell.vertices.size());
    std::iota(polygon.begin(), polygon.end(), static_cast<int>(data.points.size()));
    for (const auto& p : cell.vertices) data.points.push_back(normalization.to_outside(p));
    data.polygons.add(polygon);
    sample.integers.push_back(static_cast<int>(i < images ? i : i - images + half));
    status.integers.push_back(static_cast<int>(cell.status));
    weight.values.push_back(square * cell.weight);
    mass.values.push_back(square * cell.mass);
    density.values.push_back(cell.density);
  }
  data.cell_fields = {sample, weight, mass, density, status};
  write(out, format, encoding, data);
}

void write_samples(std::ostream& out, Format format, Encoding encoding, const Samples& samples,
                   const Normalization& normalization)
{
  Dataset data;
  for (const auto& p : samples.points) data.points.push_back(normalization.to_outside(p));
  data.normals = samples.normals;
  Field weight{"weight", samples.weights, {}};
  for (double& w : weight.values) w *= outside_square(normalization);
  data.point_fields = {weight, {"density", samples.density, {}}};
  write(out, format, encoding, data);
}

} // namespace tools
