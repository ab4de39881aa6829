// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Points, lines and polygons with named values, and their files: PLY, VTP and VTU. (CGAL writes
// these formats without such values.)
#ifndef POWER_RTF_TOOLS_DATASET_H
#define POWER_RTF_TOOLS_DATASET_H

#include "Format.h"
#include "Mesh_property.h"

#include <CGAL/PowerRTF/geometry/vector.h>

#include <cstddef>
#include <initializer_list>
#include <iosfwd>
#include <string>
#include <vector>

namespace tools {

/// A value per point or cell: those of `integers` or of `vectors` if there are some, else those of
/// `values`.
struct Field {
  std::string name;
  std::vector<double> values;
  std::vector<int> integers;
  std::vector<CGAL::PowerRTF::Vec3d> vectors = {}; ///< VTP only
  Number_type type = Number_type::float64;         ///< that `values` are rounded to
};

/// Lists of indices, one after the other in memory.
class Index_lists {
public:
  struct List {
    const int *first, *last;

    const int* begin() const { return first; }
    const int* end() const { return last; }
    std::size_t size() const { return static_cast<std::size_t>(last - first); }
  };

  Index_lists() = default;
  Index_lists(std::initializer_list<std::vector<int>> lists)
  {
    for (const auto& list : lists) add(list);
  }

  template <class Indices>
  void add(const Indices& indices)
  {
    m_indices.insert(m_indices.end(), indices.begin(), indices.end());
    m_ends.push_back(m_indices.size());
  }
  void reserve(std::size_t lists, std::size_t indices)
  {
    m_ends.reserve(lists + 1);
    m_indices.reserve(indices);
  }
  std::size_t size() const { return m_ends.size() - 1; }
  bool empty() const { return size() == 0; }
  /// The index of the first entry of a list among all.
  std::size_t first(std::size_t i) const { return m_ends[i]; }
  List operator[](std::size_t i) const
  {
    return {m_indices.data() + m_ends[i], m_indices.data() + m_ends[i + 1]};
  }

private:
  std::vector<int> m_indices;
  std::vector<std::size_t> m_ends{0};
};

struct Dataset {
  std::vector<CGAL::PowerRTF::Vec3d> points;
  std::vector<CGAL::PowerRTF::Vec3d> normals; ///< of the points; or none
  Index_lists polygons;                       ///< of `points`
  Index_lists dots, lines;                    ///< likewise; VTP only
  std::vector<Field> point_fields;
  std::vector<Field> cell_fields;   ///< of the dots, the lines and the polygons, in this order
  const Texture* texture = nullptr; ///< of the corners of the polygons, PLY only; or none
  std::vector<std::string> texture_files{}; ///< PLY only
};

/// The same as fields.
std::vector<Field> fields_of(const std::vector<Mesh_property>& properties);

/// Text has as many digits as are needed to read back the same doubles.
void write_ply(std::ostream& out, const Dataset& data, Encoding encoding);
/// As text. Points without any cells become dots.
void write_vtp(std::ostream& out, const Dataset& data);
/// As text: the polygons are the cells of an unstructured grid, as programs for simulation read it.
void write_vtu(std::ostream& out, const Dataset& data);

} // namespace tools

#endif // POWER_RTF_TOOLS_DATASET_H
