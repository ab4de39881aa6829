// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtp_mesh.h"

#include "Tokenizer.h"

#ifdef POWER_RTF_READS_VTK

#include "Vtk_arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace tools {
namespace {

/// The cells of a section, as the points of each.
struct Vtk_cells {
  std::vector<int> points, ends;

  std::size_t size() const { return ends.size(); }
  int begin(std::size_t i) const { return i == 0 ? 0 : ends[i - 1]; }
};

/// Reads the pieces of a file.
class Vtp_reader {
public:
  explicit Vtp_reader(std::string_view data) : m_file(data) {}

  Polygon_mesh read()
  {
    const pugi::xml_node data = m_file.root().child("PolyData");
    if (!data)
      reject("it holds " + printable(m_file.root().attribute("type").value()) + ", not PolyData");
    for (const pugi::xml_node piece : data.children("Piece")) read_piece(piece);
    keep_complete(m_mesh.properties.vertices, m_mesh.soup.points.size(), true);
    keep_complete(m_mesh.properties.faces, m_mesh.soup.first.size() - 1, false);
    Texture& texture = m_mesh.properties.texture;
    if (texture.coordinates.size() == m_mesh.soup.points.size() && !texture.coordinates.empty()) {
      texture.corners = m_mesh.soup.corners;
      m_mesh.attributes.insert("texture coordinates");
    } else {
      texture = {};
    }
    return std::move(m_mesh);
  }

private:
  void read_piece(pugi::xml_node piece)
  {
    const std::size_t first = m_mesh.soup.points.size();
    const Vtk_array points = m_file.read(piece.child("Points").child("DataArray"));
    if (points.components != 3 && !points.values.empty())
      reject(m_file.at(piece) + "its points have " + std::to_string(points.components) +
             " coordinates, not 3");
    for (std::size_t i = 0; i + 3 <= points.values.size(); i += 3)
      m_mesh.soup.points.push_back({points.values[i], points.values[i + 1], points.values[i + 2]});
    const std::size_t count = m_mesh.soup.points.size() - first;
    const auto section = [&](const char* name) {
      return cells(piece.child(name), static_cast<int>(first), count);
    };
    const Vtk_cells dots = section("Verts"), lines = section("Lines"), strips = section("Strips"),
                    polygons = section("Polys");
    if (dots.size() > 0) m_mesh.attributes.insert("points");
    if (lines.size() > 0) m_mesh.attributes.insert("lines");
    m_mesh.dots.insert(m_mesh.dots.end(), dots.points.begin(), dots.points.end());
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (int k = lines.begin(i); k + 1 < lines.ends[i]; ++k)
        m_mesh.lines.push_back({lines.points[k], lines.points[k + 1]});
    // the order of the cells' values: dots, lines, polygons, strips
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      m_mesh.soup.corners.insert(m_mesh.soup.corners.end(),
                                 polygons.points.begin() + polygons.begin(i),
                                 polygons.points.begin() + polygons.ends[i]);
      m_mesh.soup.end_polygon();
      rows.push_back(dots.size() + lines.size() + i);
    }
    for (std::size_t i = 0; i < strips.size(); ++i)
      for (int k = strips.begin(i); k + 2 < strips.ends[i]; ++k) {
        const bool is_turned = (k - strips.begin(i)) % 2 == 1; // every other triangle
        for (const int c : {k, k + 1 + is_turned, k + 2 - is_turned})
          m_mesh.soup.corners.push_back(strips.points[c]);
        m_mesh.soup.end_polygon();
        rows.push_back(dots.size() + lines.size() + polygons.size() + i);
      }
    read_values(piece.child("PointData"), count, {}, true);
    read_values(piece.child("CellData"),
                dots.size() + lines.size() + polygons.size() + strips.size(), rows, false);
  }

  /// The cells of a section of a piece whose points are numbered from `first` on.
  Vtk_cells cells(pugi::xml_node section, int first, std::size_t count) const
  {
    Vtk_cells result;
    for (const pugi::xml_node array : section.children("DataArray")) {
      const std::string name = array.attribute("Name").value();
      if (name != "connectivity" && name != "offsets") continue;
      for (const double x : m_file.read(array).values) {
        if (name == "offsets") {
          const double least = result.ends.empty() ? 0 : result.ends.back();
          if (!(x >= least && x <= std::numeric_limits<int>::max()))
            reject(m_file.at(array) + "the offsets of cells do not increase");
          result.ends.push_back(static_cast<int>(x));
        } else {
          const bool exists = x >= 0 && x < static_cast<double>(count);
          result.points.push_back(exists ? first + static_cast<int>(x) : -1);
        }
      }
    }
    if (!result.ends.empty() && static_cast<std::size_t>(result.ends.back()) > result.points.size())
      reject(m_file.at(section) + "the offsets of cells go beyond their points");
    return result;
  }

  /// Reads the values of vertices or faces. \param rows those of the faces; none: all
  void read_values(pugi::xml_node section, std::size_t count, const std::vector<std::size_t>& rows,
                   bool of_vertices)
  {
    for (const pugi::xml_node node : section.children("DataArray")) {
      const Vtk_array array = m_file.read(node);
      if (array.rows() == 0) continue;
      if (array.rows() != count || array.values.size() != count * array.components)
        reject(m_file.at(node) + "the array " + printable(array.name) + " has " +
               std::to_string(array.values.size()) + " values instead of " +
               std::to_string(count * array.components));
      const auto is_role = [&](const char* role) {
        return array.name == role || section.attribute(role).value() == array.name;
      };
      if (of_vertices && array.components == 2 && is_role("TCoords")) {
        for (std::size_t i = 0; i < count; ++i)
          m_mesh.properties.texture.coordinates.push_back(
              {array.values[2 * i], array.values[2 * i + 1]});
        continue;
      }
      for (std::size_t k = 0; k < array.components; ++k)
        append(array, k, name_of(array, k, is_role("Normals")), rows, of_vertices);
    }
  }

  static std::string name_of(const Vtk_array& array, std::size_t k, bool are_normals)
  {
    constexpr const char* normals[] = {"nx", "ny", "nz"};
    const std::size_t n = array.components;
    if (n == 1) return array.name;
    if (n == 3 && are_normals) return normals[k];
    if ((n == 3 || n == 4) && array.type == Number_type::uint8) return color_channels[k];
    return array.name + "_" + std::to_string(k);
  }

  void append(const Vtk_array& array, std::size_t k, const std::string& name,
              const std::vector<std::size_t>& rows, bool of_vertices)
  {
    std::vector<Mesh_property>& all =
        of_vertices ? m_mesh.properties.vertices : m_mesh.properties.faces;
    const Mesh_property* const found = find_property(all, name);
    Mesh_property& property =
        found ? all[found - all.data()] : all.emplace_back(Mesh_property{name, array.type, {}});
    const std::vector<double> column = array.column(k);
    if (of_vertices) {
      property.values.insert(property.values.end(), column.begin(), column.end());
    } else {
      for (const std::size_t i : rows) property.values.push_back(column[i]);
    }
  }

  /// Leaves the properties of which there are as many values as elements: not all pieces need to
  /// have them.
  void keep_complete(std::vector<Mesh_property>& properties, std::size_t count, bool of_vertices)
  {
    const auto end =
        std::stable_partition(properties.begin(), properties.end(),
                              [count](const Mesh_property& p) { return p.values.size() == count; });
    for (auto p = end; p != properties.end(); ++p)
      m_mesh.attributes.insert(in_words(p->name, of_vertices));
    properties.erase(end, properties.end());
  }

  Vtk_file m_file;
  Polygon_mesh m_mesh;
};

} // namespace

Polygon_mesh parse_vtp(std::string_view data) { return Vtp_reader(data).read(); }

} // namespace tools

#else

namespace tools {

Polygon_mesh parse_vtp(std::string_view)
{
  reject("this program was built without pugixml and zlib, which VTP needs");
}

} // namespace tools

#endif
