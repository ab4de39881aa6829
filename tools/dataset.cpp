// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset.h"

#include <charconv>
#include <ostream>

namespace tools
{
namespace
{

using CGAL::PowerRTF::Vec3d;

/// Collects text; numbers in their shortest form that reads back the same.
class Text
{
public:
  explicit Text(std::ostream& out) : m_out(out) {}
  ~Text() { flush(); }

  Text& operator<<(const char* s) { return *this << std::string(s); }
  Text& operator<<(const std::string& s)
  {
    m_text += s;
    if (m_text.size() > 1 << 16) flush();
    return *this;
  }
  template <class Number>
  Text& operator<<(Number x)
  {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof(digits), x).ptr;
    m_text.append(digits, end);
    return *this;
  }
  Text& operator<<(const Vec3d& p) { return *this << p.x << " " << p.y << " " << p.z; }

private:
  void flush()
  {
    m_out.write(m_text.data(), static_cast<std::streamsize>(m_text.size()));
    m_text.clear();
  }

  std::ostream& m_out;
  std::string m_text;
};

void ply_properties(Text& text, const std::vector<Field>& fields)
{
  for (const Field& f : fields)
    text << "property " << (f.integers.empty() ? "double " : "int ") << f.name << "\n";
}

void ply_values(Text& text, const std::vector<Field>& fields, std::size_t i)
{
  for (const Field& f : fields)
    f.integers.empty() ? text << " " << f.values[i] : text << " " << f.integers[i];
}

void vtp_array_begin(Text& text, const char* type, const std::string& name, int components = 1)
{
  text << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\""
       << components << "\" format=\"ascii\">\n";
}

void vtp_array_end(Text& text) { text << "</DataArray>\n"; }

void vtp_vectors(Text& text, const std::string& name, const std::vector<Vec3d>& vectors)
{
  vtp_array_begin(text, "Float64", name, 3);
  for (const Vec3d& v : vectors) text << v << "\n";
  vtp_array_end(text);
}

void vtp_fields(Text& text, const std::vector<Field>& fields)
{
  for (const Field& f : fields) {
    vtp_array_begin(text, f.integers.empty() ? "Float64" : "Int32", f.name);
    for (const double x : f.values) text << x << "\n";
    for (const int x : f.integers) text << x << "\n";
    vtp_array_end(text);
  }
}

/// A section of VTP cells: connectivity and offsets.
void vtp_cells(Text& text, const char* section, const std::vector<std::vector<int>>& cells)
{
  text << "<" << section << ">\n";
  vtp_array_begin(text, "Int64", "connectivity");
  for (const auto& cell : cells) {
    for (const int v : cell) text << v << " ";
    text << "\n";
  }
  vtp_array_end(text);
  vtp_array_begin(text, "Int64", "offsets");
  std::size_t end = 0;
  for (const auto& cell : cells) text << (end += cell.size()) << "\n";
  vtp_array_end(text);
  text << "</" << section << ">\n";
}

} // namespace

void write_ply(std::ostream& out, const Dataset& data)
{
  Text text(out);
  text << "ply\nformat ascii 1.0\nelement vertex " << data.points.size()
       << "\nproperty double x\nproperty double y\nproperty double z\n";
  if (!data.normals.empty()) text << "property double nx\nproperty double ny\nproperty double nz\n";
  ply_properties(text, data.point_fields);
  if (!data.polygons.empty()) {
    text << "element face " << data.polygons.size() << "\nproperty list uchar int vertex_indices\n";
    ply_properties(text, data.polygon_fields);
  }
  text << "end_header\n";
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    text << data.points[i];
    if (!data.normals.empty()) text << " " << data.normals[i];
    ply_values(text, data.point_fields, i);
    text << "\n";
  }
  for (std::size_t i = 0; i < data.polygons.size(); ++i) {
    text << data.polygons[i].size();
    for (const int v : data.polygons[i]) text << " " << v;
    ply_values(text, data.polygon_fields, i);
    text << "\n";
  }
}

void write_vtp(std::ostream& out, const Dataset& data)
{
  Text text(out);
  // points without polygons are drawn only when each is a cell of its own
  std::vector<std::vector<int>> dots;
  if (data.polygons.empty())
    for (std::size_t i = 0; i < data.points.size(); ++i) dots.push_back({static_cast<int>(i)});
  text << "<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\""
       << data.points.size() << "\" NumberOfVerts=\"" << dots.size()
       << "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" << data.polygons.size()
       << "\">\n<PointData>\n";
  if (!data.normals.empty()) vtp_vectors(text, "normals", data.normals);
  vtp_fields(text, data.point_fields);
  text << "</PointData>\n<CellData>\n";
  vtp_fields(text, data.polygon_fields);
  text << "</CellData>\n<Points>\n";
  vtp_vectors(text, "Points", data.points);
  text << "</Points>\n";
  vtp_cells(text, "Verts", dots);
  vtp_cells(text, "Polys", data.polygons);
  text << "</Piece>\n</PolyData>\n</VTKFile>\n";
}

} // namespace tools
