// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "fields_io.h"

#include "dataset.h"

#include <array>
#include <cstddef>

namespace tools {

using CGAL::PowerRTF::Lattice_fields;
using CGAL::PowerRTF::Normalization;
using CGAL::PowerRTF::Vec3d;

void write_fields(std::ostream& out, const Lattice_fields& fields,
                  const Normalization& normalization)
{
  Dataset data;
  Field node{"node", {}, {}}, is_point{"is_point", {}, {}}, normal{"normal", {}, {}},
      axis{"axis", {}, {}}, spacing{"spacing", {}, {}}, index{"index", {}, {}},
      dislocation{"dislocation", {}, {}};
  const auto add_point = [&](const Vec3d& p) {
    data.points.push_back(normalization.to_outside(p));
    return static_cast<int>(data.points.size()) - 1;
  };
  const auto add_values = [&](int i, bool of_point) {
    node.integers.push_back(i);
    is_point.integers.push_back(of_point);
    normal.vectors.push_back(fields.normals[i]);
    axis.vectors.push_back(fields.axes[i]);
    spacing.values.push_back(fields.spacing[i] / normalization.scale);
    index.integers.push_back(of_point ? 0 : fields.indices[i]);
    dislocation.integers.push_back(of_point ? 0 : fields.dislocations[i]);
  };
  for (std::size_t k = 0; k < fields.points.size(); ++k) {
    data.dots.add(std::array{add_point(fields.points[k])});
    add_values(fields.point_nodes[k], true);
  }
  for (std::size_t i = 0; i < fields.nodes.size(); ++i) {
    const Vec3d half = 0.25 * fields.spacing[i] * fields.axes[i];
    const int from = add_point(fields.nodes[i] - half);
    data.lines.add(std::array{from, add_point(fields.nodes[i] + half)});
    add_values(static_cast<int>(i), false);
  }
  data.cell_fields = {node, is_point, normal, axis, spacing, index, dislocation};
  write_vtp(out, data);
}

} // namespace tools
