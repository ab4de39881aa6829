// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reader of VTP: all encodings, pieces, strips, values, and what is wrong.
#include "Base64.h"
#include "mesh_data.h"

#include <doctest/doctest.h>

using namespace mesh_data;
using namespace tools;
using CGAL::PowerRTF::Edge;

#ifndef POWER_RTF_READS_VTK

TEST_CASE("without pugixml and zlib, VTP is refused with that reason")
{
  CHECK(reason(Format::vtp, "<VTKFile/>").find("built without pugixml and zlib") !=
        std::string::npos);
}

#else

#include <zlib.h>

namespace {

using Values = std::vector<double>;

enum class Kind { ascii, base64, appended_base64, appended_raw };

/// Makes a VTP file of one piece.
class Vtp {
public:
  Kind kind = Kind::ascii;
  bool is_wide = false, is_big_endian = false;
  std::size_t block_size = 0; ///< of compressed data; 0: not compressed

  template <class Number>
  std::string array(const std::string& type, const std::string& attributes, const Values& values)
  {
    std::string xml = "<DataArray type=\"" + type + "\" " + attributes + " format=\"";
    if (kind == Kind::ascii) {
      std::ostringstream text;
      text.precision(17);
      for (const double x : values) text << x << '\n';
      return xml + "ascii\">\n" + text.str() + "</DataArray>\n";
    }
    std::string bytes;
    for (const double x : values) bytes += bytes_of(static_cast<Number>(x));
    const bool is_raw = kind == Kind::appended_raw;
    const std::string data = encoded(bytes, is_raw);
    if (kind == Kind::base64) return xml + "binary\">\n  " + data + "\n</DataArray>\n";
    const std::size_t offset = m_appended.size();
    m_appended += data;
    return xml + "appended\" offset=\"" + std::to_string(offset) + "\"/>\n";
  }
  std::string file(const std::string& piece) const
  {
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\"";
    if (is_big_endian) text += " byte_order=\"BigEndian\"";
    if (is_wide) text += " header_type=\"UInt64\"";
    if (block_size > 0) text += " compressor=\"vtkZLibDataCompressor\"";
    text += ">\n<PolyData>\n" + piece + "</PolyData>\n";
    if (!m_appended.empty())
      text += std::string("<AppendedData encoding=\"") +
              (kind == Kind::appended_raw ? "raw" : "base64") + "\">\n_" + m_appended +
              "\n</AppendedData>\n";
    return text + "</VTKFile>\n";
  }

private:
  template <class Number>
  std::string bytes_of(Number x) const
  {
    std::string bytes(sizeof(x), '\0'); // of this machine, whose order is little-endian
    std::memcpy(&bytes[0], &x, sizeof(x));
    if (is_big_endian) std::reverse(bytes.begin(), bytes.end());
    return bytes;
  }
  std::string number(std::size_t x) const
  {
    return is_wide ? bytes_of(std::uint64_t(x)) : bytes_of(std::uint32_t(x));
  }
  std::string encoded(const std::string& bytes, bool is_raw) const
  {
    if (block_size == 0)
      return is_raw ? number(bytes.size()) + bytes : to_base64(number(bytes.size()) + bytes);
    std::string sizes, blocks;
    std::size_t count = 0;
    for (std::size_t begin = 0; begin < bytes.size(); begin += block_size, ++count) {
      const std::string block = bytes.substr(begin, block_size);
      uLongf size = compressBound(block.size());
      std::string packed(size, '\0');
      compress(reinterpret_cast<Bytef*>(&packed[0]), &size,
               reinterpret_cast<const Bytef*>(block.data()), block.size());
      sizes += number(size);
      blocks += packed.substr(0, size);
    }
    const std::string header =
        number(count) + number(block_size) + number(bytes.size() % block_size) + sizes;
    return is_raw ? header + blocks : to_base64(header) + to_base64(blocks);
  }

  std::string m_appended;
};

/// The mesh of mesh_data.h, with values.
std::string mesh_file(Vtp vtp)
{
  Values xyz, connectivity, offsets;
  for (const Vec3d& p : points) xyz.insert(xyz.end(), {p.x, p.y, p.z});
  for (const auto& polygon : polygons) {
    connectivity.insert(connectivity.end(), polygon.begin(), polygon.end());
    offsets.push_back(double(connectivity.size()));
  }
  const std::string piece =
      "<Piece NumberOfPoints=\"5\" NumberOfPolys=\"3\">\n<PointData Normals=\"n\" "
      "TCoords=\"uv\">\n" +
      vtp.array<float>("Float32", "Name=\"n\" NumberOfComponents=\"3\"", Values(15, 0.5)) +
      vtp.array<unsigned char>("UInt8", "Name=\"Colors\" NumberOfComponents=\"3\"",
                               {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 255}) +
      vtp.array<float>("Float32", "Name=\"uv\" NumberOfComponents=\"2\"",
                       {0, 0, 1, 0, 1, 1, 0, 1, 0.5, 0.5}) +
      vtp.array<double>("Float64", "Name=\"two of\" NumberOfComponents=\"2\"",
                        {0, 1e-9, 2, 3, 4, 5, 6, 7, 8, -9.5}) +
      "</PointData>\n<CellData>\n" +
      vtp.array<std::int64_t>("Int64", "Name=\"label\"", {7, -2, 5}) + "</CellData>\n<Points>\n" +
      vtp.array<double>("Float64", "NumberOfComponents=\"3\"", xyz) + "</Points>\n<Polys>\n" +
      vtp.array<std::int32_t>("Int32", "Name=\"connectivity\"", connectivity) +
      vtp.array<std::uint64_t>("UInt64", "Name=\"offsets\"", offsets) + "</Polys>\n</Piece>\n";
  return vtp.file(piece);
}

Values values_of(const std::vector<Mesh_property>& properties, const std::string& name)
{
  const Mesh_property* const found = find_property(properties, name);
  return found ? found->values : Values();
}

} // namespace

TEST_CASE("every encoding gives the same mesh and the same values")
{
  for (const Kind kind : {Kind::ascii, Kind::base64, Kind::appended_base64, Kind::appended_raw})
    for (const bool is_wide : {false, true})
      for (const bool is_big_endian : {false, true})
        for (const std::size_t block_size : {0, 7, 40, 32768}) {
          Vtp vtp;
          vtp.kind = kind;
          vtp.is_wide = is_wide;
          vtp.is_big_endian = is_big_endian;
          vtp.block_size = block_size;
          const Polygon_mesh mesh = parse_mesh(Format::vtp, mesh_file(vtp));
          CHECK(equal(mesh.soup.points, points));
          CHECK(polygons_of(mesh) == polygons);
          const auto& vertices = mesh.properties.vertices;
          CHECK(mesh.properties.faces.at(0).type == Number_type::int32);
          const Texture& texture = mesh.properties.texture;
          CHECK(values_of(mesh.properties.faces, "label") == Values{7, -2, 5});
          CHECK(values_of(vertices, "nx") == Values(5, 0.5));
          CHECK(values_of(vertices, "blue") == Values{3, 6, 9, 12, 255});
          CHECK(values_of(vertices, "two of_1") == Values{1e-9, 3, 5, 7, -9.5});
          REQUIRE(texture.corners == mesh.soup.corners);
          CHECK(texture.coordinates[4] == std::array{0.5, 0.5});
          CHECK(mesh.attributes == std::set<std::string>{"texture coordinates"});
        }
}

TEST_CASE("what is written as VTP is read as it was")
{
  Mesh_properties properties;
  for (int k = 0; k < 8; ++k) {
    const std::string name = "p<&\"" + std::to_string(k);
    properties.vertices.push_back({name, static_cast<Number_type>(k), {1, 2, 3, 4, 100}});
    properties.faces.push_back({name, static_cast<Number_type>(k), {7, 0, 9}});
  }
  std::ostringstream out;
  write_mesh(out, Format::vtp, Encoding::text, points, {{{0, 1, 2}}, {{1, 3, 2}}, {{0, 3, 4}}},
             properties);
  const Polygon_mesh mesh = parse_mesh(Format::vtp, out.str());
  CHECK(equal(mesh.soup.points, points));
  REQUIRE(mesh.properties.vertices.size() == 8);
  for (int k = 0; k < 8; ++k) {
    CHECK(mesh.properties.vertices[k].name == properties.vertices[k].name);
    CHECK(mesh.properties.vertices[k].type == properties.vertices[k].type);
    CHECK(mesh.properties.vertices[k].values == properties.vertices[k].values);
    CHECK(mesh.properties.faces[k].values == properties.faces[k].values);
  }
}

TEST_CASE("pieces, strips and lines; cells have their values in VTK's order")
{
  const auto cells = [](const std::string& name, const std::string& points,
                        const std::string& ends) {
    return "<" + name + "><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" +
           points + "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">" +
           ends + "</DataArray></" + name + ">";
  };
  const std::string piece =
      "<Piece><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">"
      "0 0 0 1 0 0 0 1 0 1 1 0 0 2 0</DataArray></Points><CellData><DataArray type=\"UInt8\" "
      "Name=\"label\" format=\"ascii\">1 2 3 4</DataArray></CellData>" +
      cells("Strips", "0 1 2 3 4", "5") + cells("Polys", "0 1 3 2", "4") +
      cells("Lines", "0 1 2", "3") + cells("Verts", "4", "1") + "</Piece>";
  const Polygon_mesh mesh = parse_mesh(Format::vtp, Vtp().file(piece + piece));
  CHECK(polygons_of(mesh) == std::vector<std::vector<std::size_t>>{{0, 1, 3, 2},
                                                                   {0, 1, 2},
                                                                   {1, 3, 2},
                                                                   {2, 3, 4},
                                                                   {5, 6, 8, 7},
                                                                   {5, 6, 7},
                                                                   {6, 8, 7},
                                                                   {7, 8, 9}});
  CHECK(values_of(mesh.properties.faces, "label") == Values{3, 4, 4, 4, 3, 4, 4, 4});
  CHECK(mesh.lines == std::vector<Edge>{{0, 1}, {1, 2}, {5, 6}, {6, 7}});
  CHECK(mesh.dots == std::vector<int>{4, 9});
  CHECK(mesh.attributes == std::set<std::string>{"lines", "points"});
}

TEST_CASE("VTP: what is malformed is told")
{
  Vtp packed;
  packed.kind = Kind::appended_raw;
  packed.block_size = 40;
  const std::string good = mesh_file(Vtp()), binary = mesh_file(packed);
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  struct Case {
    std::string data, reason;
  };
  for (const Case& c : {
           Case{"", "line 1: "},
           {"<VTKFile>", "line 1: "},
           {good.substr(0, good.size() / 2), "line "},
           {"<VTKFile type=\"ImageData\"/>", "it holds ImageData, not PolyData"},
           {changed(good, "7\n-2\n5\n", "7\n-2\n"),
            "line 66: the array label has 2 values instead of 3"},
           {changed(good, "0\n1\n2\n1\n3", "0\n1\n5\n1\n3"), "facet 1 refers to a vertex"},
           {changed(good, "3\n6\n10", "3\n2\n10"), "the offsets of cells do not increase"},
           {changed(good, "3\n6\n10", "3\n6\n11"), "the offsets of cells go beyond their points"},
           {changed(good, "9\n100\n3\n", "9\nx\n3\n"), "vertex 4 has a coordinate"},
           {changed(binary, "ZLib", "LZ4"), "compressed by vtkLZ4DataCompressor"},
           {changed(binary, "offset=\"0\"", "offset=\"99999\""),
            "the array offsets cannot be read: it is truncated"},
           {binary.substr(0, binary.size() - 60), "it is truncated"},
           {changed(binary, "\x78\x9c", "\x78\x9d"), "its compressed data is damaged"},
           {binary.substr(0, binary.find("_")), "truncated in its appended data"},
       }) {
    CAPTURE(c.data);
    const std::string is = reason(Format::vtp, c.data);
    CAPTURE(is);
    CHECK(is.find(c.reason) != std::string::npos);
  }
}

#endif
