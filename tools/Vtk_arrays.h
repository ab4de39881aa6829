// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The numbers of VTK's XML files: text, or binary data, in place or appended, compressed or not.
#ifndef POWER_RTF_TOOLS_VTK_ARRAYS_H
#define POWER_RTF_TOOLS_VTK_ARRAYS_H

#include "Mesh_property.h"

#include <pugixml.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

/// An array of rows of numbers.
struct Vtk_array {
  std::string name;
  Number_type type = Number_type::float64; ///< one that holds the values
  std::size_t components = 1;
  std::vector<double> values;

  std::size_t rows() const { return values.size() / components; }
  /// Component `k` of all rows.
  std::vector<double> column(std::size_t k) const;
};

/// A file of VTK's XML formats. The data must outlive it.
class Vtk_file {
public:
  /// \throws Invalid_input_error it is no such file, or of a kind that is not read
  explicit Vtk_file(std::string_view data);

  pugi::xml_node root() const { return m_document.child("VTKFile"); }
  /// Reads a `DataArray`, also of bits or texts, which have no rows.
  /// \throws Invalid_input_error it cannot be read; with its name and line
  Vtk_array read(pugi::xml_node array) const;
  /// "line 7: "
  std::string at(pugi::xml_node node) const;

private:
  std::string bytes_of(pugi::xml_node array) const;

  std::string_view m_data, m_appended; ///< after its '_'
  pugi::xml_document m_document;
  std::string m_compressor;
  bool m_big_endian = false, m_is_base64 = true; ///< the appended data
  std::size_t m_header_size = 4;                 ///< of its numbers, in bytes
};

} // namespace tools

#endif // POWER_RTF_TOOLS_VTK_ARRAYS_H
