// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset.h"

#include "Bytes.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <string_view>
#include <type_traits>

namespace tools {
namespace {

using CGAL::PowerRTF::Vec3d;

/// Text that goes to a stream in large pieces.
class Streamed_text {
public:
  explicit Streamed_text(std::ostream& out) : m_out(out) {}
  ~Streamed_text() { m_text.flush(m_out); }

  template <class T>
  Streamed_text& operator<<(const T& x)
  {
    m_text << x;
    if (m_text.size() > 1 << 16) m_text.flush(m_out);
    return *this;
  }

private:
  std::ostream& m_out;
  Text m_text;
};

/// A row of numbers as text.
class Text_row {
public:
  explicit Text_row(Text& text) : m_text(text) {}

  template <class Number>
  void add(Number x)
  {
    if (!m_at_begin) m_text << " ";
    m_text << x;
    m_at_begin = false;
  }
  void end() { m_text << "\n"; }

private:
  Text& m_text;
  bool m_at_begin = true;
};

/// Numbers in bytes, the least significant first.
class Binary_row {
public:
  explicit Binary_row(Text& text) : m_text(text) {}

  template <class Number>
  void add(Number x)
  {
    if constexpr (std::is_integral<Number>::value)
      add_bytes<sizeof(x)>(static_cast<std::uint64_t>(x));
    else
      add_bytes<sizeof(x)>(
          bit_cast<std::conditional_t<sizeof(x) == 4, std::uint32_t, std::uint64_t>>(x));
  }
  void end() {}

private:
  template <std::size_t count>
  void add_bytes(std::uint64_t bits)
  {
    char bytes[count];
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<char>(bits >> 8 * i);
    m_text << std::string_view(bytes, count);
  }

  Text& m_text;
};

void ply_properties(Streamed_text& text, const std::vector<Field>& fields)
{
  constexpr const char* names[] = {"char", "uchar", "short", "ushort",
                                   "int",  "uint",  "float", "double"};
  for (const Field& f : fields) {
    std::string name = f.name; // one word
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c <= ' '; }, '_');
    text << "property " << (f.integers.empty() ? names[static_cast<int>(f.type)] : "int") << " "
         << name << "\n";
  }
}

template <class Row>
void ply_fields(Row& row, const std::vector<Field>& fields, std::size_t i)
{
  for (const Field& f : fields) {
    if (f.integers.empty())
      visit_as(f.type, f.values[i], [&](auto x) { row.add(x); });
    else
      row.add(f.integers[i]);
  }
}

/// Whether floats hold the coordinates as they are.
bool has_float_coordinates(const Texture& texture)
{
  return std::all_of(texture.coordinates.begin(), texture.coordinates.end(),
                     [](const auto& uv) { return float(uv[0]) == uv[0] && float(uv[1]) == uv[1]; });
}

/// The texture coordinates of a polygon, one corner after the other; none, if a corner has none.
/// \param first its first corner
template <class Row>
void ply_texture(Row& row, const Texture& texture, bool are_floats, std::size_t first,
                 std::size_t size)
{
  const auto begin = texture.corners.begin() + static_cast<std::ptrdiff_t>(first),
             end = begin + static_cast<std::ptrdiff_t>(size);
  const bool has_all = std::find(begin, end, -1) == end;
  row.add(static_cast<std::uint8_t>(has_all ? 2 * size : 0));
  for (auto corner = begin; has_all && corner != end; ++corner)
    for (const double x : texture.coordinates[*corner])
      are_floats ? row.add(static_cast<float>(x)) : row.add(x);
}

/// Whether a byte holds the number of vertices of every polygon.
bool has_small_polygons(const Dataset& data)
{
  for (std::size_t i = 0; i < data.polygons.size(); ++i)
    if (data.polygons[i].size() > 255) return false;
  return true;
}

void ply_header(Streamed_text& text, const Dataset& data, Encoding encoding)
{
  text << "ply\nformat " << (encoding == Encoding::text ? "ascii" : "binary_little_endian")
       << " 1.0\n";
  for (const std::string& file : data.texture_files) text << "comment TextureFile " << file << "\n";
  text << "element vertex " << data.points.size()
       << "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!data.normals.empty()) text << "property double nx\nproperty double ny\nproperty double nz\n";
  ply_properties(text, data.point_fields);
  if (!data.polygons.empty()) {
    text << "element face " << data.polygons.size() << "\nproperty list "
         << (has_small_polygons(data) ? "uchar" : "int") << " int vertex_indices\n";
    if (data.texture)
      text << "property list uchar " << (has_float_coordinates(*data.texture) ? "float" : "double")
           << " texcoord\n";
    ply_properties(text, data.cell_fields);
  }
  text << "end_header\n";
}

template <class Row>
void ply_body(std::ostream& out, const Dataset& data)
{
  const bool small_polygons = has_small_polygons(data);
  write_rows(out, data.points.size(), [&](Text& text, std::size_t i) {
    Row row(text);
    const auto add = [&row](const Vec3d& p) {
      for (const double x : {p.x, p.y, p.z}) row.add(x);
    };
    add(data.points[i]);
    if (!data.normals.empty()) add(data.normals[i]);
    ply_fields(row, data.point_fields, i);
    row.end();
  });
  const bool has_float_texture = data.texture && has_float_coordinates(*data.texture);
  write_rows(out, data.polygons.size(), [&](Text& text, std::size_t i) {
    Row row(text);
    const Index_lists::List polygon = data.polygons[i];
    small_polygons ? row.add(static_cast<std::uint8_t>(polygon.size()))
                   : row.add(static_cast<int>(polygon.size()));
    for (const int v : polygon) row.add(v);
    if (data.texture)
      ply_texture(row, *data.texture, has_float_texture, data.polygons.first(i), polygon.size());
    ply_fields(row, data.cell_fields, i);
    row.end();
  });
}

void vtk_array_begin(Streamed_text& text, const char* type, const std::string& name,
                     int components = 1)
{
  text << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
       << components << "\" format=\"ascii\">\n";
}

/// A name of the user's as XML has it in an attribute.
std::string escaped(const std::string& name)
{
  std::string text;
  for (const char c : name)
    text += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return text;
}

void vtk_array_end(Streamed_text& text) { text << "</DataArray>\n"; }

void vtk_vectors(Streamed_text& text, const std::string& name, const std::vector<Vec3d>& vectors)
{
  vtk_array_begin(text, "Float64", name, 3);
  for (const Vec3d& v : vectors) text << v << "\n";
  vtk_array_end(text);
}

void vtk_fields(Streamed_text& text, const std::vector<Field>& fields)
{
  constexpr const char* names[] = {"Int8",  "UInt8",  "Int16",   "UInt16",
                                   "Int32", "UInt32", "Float32", "Float64"};
  for (const Field& f : fields) {
    if (!f.vectors.empty()) {
      vtk_vectors(text, f.name, f.vectors);
      continue;
    }
    vtk_array_begin(text, f.integers.empty() ? names[static_cast<int>(f.type)] : "Int32",
                    escaped(f.name));
    for (const double x : f.values) visit_as(f.type, x, [&](auto y) { text << y << "\n"; });
    for (const int x : f.integers) text << x << "\n";
    vtk_array_end(text);
  }
}

/// The connectivity and offsets of cells.
void vtk_cells(Streamed_text& text, const Index_lists& cells)
{
  vtk_array_begin(text, "Int64", "connectivity");
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (const int v : cells[i]) text << v << " ";
    text << "\n";
  }
  vtk_array_end(text);
  vtk_array_begin(text, "Int64", "offsets");
  std::size_t end = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) text << (end += cells[i].size()) << "\n";
  vtk_array_end(text);
}

/// A section of VTP cells.
void vtp_section(Streamed_text& text, const char* section, const Index_lists& cells)
{
  text << "<" << section << ">\n";
  vtk_cells(text, cells);
  text << "</" << section << ">\n";
}

/// The beginning of a file with one piece. `type`: of the data; `sizes`: what the piece counts
void vtk_begin(Streamed_text& text, const char* type, std::size_t points, const std::string& sizes)
{
  text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type
       << "\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<" << type
       << ">\n<Piece NumberOfPoints=\"" << points << "\"" << sizes << ">\n";
}

void vtk_end(Streamed_text& text, const char* type)
{
  text << "</Piece>\n</" << type << ">\n</VTKFile>\n";
}

/// The points and all values.
void vtk_points(Streamed_text& text, const Dataset& data)
{
  text << "<PointData>\n";
  if (!data.normals.empty()) vtk_vectors(text, "normals", data.normals);
  vtk_fields(text, data.point_fields);
  text << "</PointData>\n<CellData>\n";
  vtk_fields(text, data.cell_fields);
  text << "</CellData>\n<Points>\n";
  vtk_vectors(text, "Points", data.points);
  text << "</Points>\n";
}

/// Of the piece of VTP or VTU: how many of `name` there are.
std::string vtk_count(const char* name, std::size_t count)
{
  return std::string(" NumberOf") + name + "=\"" + std::to_string(count) + "\"";
}

} // namespace

std::vector<Field> fields_of(const std::vector<Mesh_property>& properties)
{
  std::vector<Field> fields;
  for (const Mesh_property& p : properties) fields.push_back({p.name, p.values, {}, {}, p.type});
  return fields;
}

void write_ply(std::ostream& out, const Dataset& data, Encoding encoding)
{
  {
    Streamed_text text(out);
    ply_header(text, data, encoding);
  }
  encoding == Encoding::text ? ply_body<Text_row>(out, data) : ply_body<Binary_row>(out, data);
}

void write_vtp(std::ostream& out, const Dataset& data)
{
  Streamed_text text(out);
  // points without polygons are drawn only when each is a cell of its own
  Index_lists dots = data.dots;
  if (dots.empty() && data.lines.empty() && data.polygons.empty())
    for (std::size_t i = 0; i < data.points.size(); ++i) dots.add(std::array{static_cast<int>(i)});
  vtk_begin(text, "PolyData", data.points.size(),
            vtk_count("Verts", dots.size()) + vtk_count("Lines", data.lines.size()) +
                vtk_count("Strips", 0) + vtk_count("Polys", data.polygons.size()));
  vtk_points(text, data);
  vtp_section(text, "Verts", dots);
  vtp_section(text, "Lines", data.lines);
  vtp_section(text, "Polys", data.polygons);
  vtk_end(text, "PolyData");
}

void write_vtu(std::ostream& out, const Dataset& data)
{
  constexpr int triangle = 5, polygon = 7; // VTK's numbers
  Streamed_text text(out);
  vtk_begin(text, "UnstructuredGrid", data.points.size(), vtk_count("Cells", data.polygons.size()));
  vtk_points(text, data);
  text << "<Cells>\n";
  vtk_cells(text, data.polygons);
  vtk_array_begin(text, "UInt8", "types");
  for (std::size_t i = 0; i < data.polygons.size(); ++i)
    text << (data.polygons[i].size() == 3 ? triangle : polygon) << "\n";
  vtk_array_end(text);
  text << "</Cells>\n";
  vtk_end(text, "UnstructuredGrid");
}

} // namespace tools
