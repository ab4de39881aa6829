// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points and polygons with named values at both, as PLY or VTP (which CGAL writes without values).
#ifndef POWER_RTF_TOOLS_DATASET_H
#define POWER_RTF_TOOLS_DATASET_H

#include <CGAL/PowerRTF/cells/vector.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace tools
{

/// A value per point or polygon; `integers` is taken instead of `values` when it is not empty.
struct Field {
  std::string name;
  std::vector<double> values;
  std::vector<int> integers;
};

struct Dataset {
  std::vector<CGAL::PowerRTF::Vec3d> points;
  std::vector<CGAL::PowerRTF::Vec3d> normals; ///< of the points; or none
  std::vector<std::vector<int>> polygons;     ///< indices into `points`
  std::vector<Field> point_fields, polygon_fields;
};

enum class Encoding { binary, text };

/// Text has as many digits as bring every double back.
void write_ply(std::ostream& out, const Dataset& data, Encoding encoding);
void write_vtp(std::ostream& out, const Dataset& data); ///< as text

} // namespace tools

#endif // POWER_RTF_TOOLS_DATASET_H
