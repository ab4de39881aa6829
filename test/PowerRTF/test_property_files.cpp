// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Values of vertices and faces from file to file: read, transferred, written.
#include "mesh_data.h"
#include "transfer.h"

#include <doctest/doctest.h>

using namespace mesh_data;
using namespace tools;
using CGAL::PowerRTF::Triangle;

namespace {

using Values = std::vector<double>;

const std::vector<Triangle> triangles = {{{0, 1, 2}}, {{1, 3, 2}}, {{0, 3, 4}}};

/// One of every type for vertices and faces, with the extreme values.
Mesh_properties properties_of_all_types()
{
  const Values least = {-128, 0, -32768, 0, -2147483648., 0, -1.5, -1e300};
  const Values largest = {127, 255, 32767, 65535, 2147483647, 4294967295., 1e10, 1. / 3};
  Mesh_properties properties;
  for (int k = 0; k < 8; ++k) {
    const std::string name = "p" + std::to_string(k);
    const auto type = static_cast<Number_type>(k);
    properties.vertices.push_back({name, type, {least[k], 1, largest[k], 3, 4}});
    properties.faces.push_back({name, type, {largest[k], least[k], 7}});
  }
  return properties;
}

std::string written(Format format, Encoding encoding, const Mesh_properties& properties)
{
  std::ostringstream out;
  write_mesh(out, format, encoding, points, triangles, properties);
  return out.str();
}

void check_equal(const std::vector<Mesh_property>& a, const std::vector<Mesh_property>& b)
{
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].name == b[i].name);
    CHECK(a[i].type == b[i].type);
    CHECK(a[i].values == b[i].values);
  }
}

Mesh_properties colors(Number_type type, double unit)
{
  return {{{"red", type, {0, unit, 0, unit, unit / 5}},
           {"green", type, {0, 0, unit, unit, unit / 5}},
           {"blue", type, {unit, 0, 0, unit, 0}}},
          {}};
}

} // namespace

TEST_CASE("PLY: values of every type come back as they were written")
{
  const Mesh_properties properties = properties_of_all_types();
  for (const Encoding encoding : {Encoding::binary, Encoding::text}) {
    const Polygon_mesh mesh = parse_mesh(Format::ply, written(Format::ply, encoding, properties));
    check_equal(mesh.properties.vertices, properties.vertices);
    check_equal(mesh.properties.faces, properties.faces);
    CHECK(mesh.attributes.empty());
  }
}

TEST_CASE("PLY: values stand in any order, between lists of different lengths; not all are kept")
{
  const std::string header = "ply\nformat ascii 1.0\nelement vertex 3\n";
  const std::string rest = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const Polygon_mesh mesh = parse_mesh(
      Format::ply, header + "property int label\n" + xyz +
                       "property list uchar int more\nproperty float t\nproperty float h\n"
                       "property int label\n" +
                       rest +
                       "7 0 0 0 0 9 1e-3 1\n8 1 0 0 2 5 6 9 nan 1\n9 0 1 0 1 5 9 x 1\n3 0 1 2\n");
  CHECK(mesh.attributes == std::set<std::string>{"texture coordinates", "vertex property label",
                                                 "vertex property more"});
  REQUIRE(mesh.properties.vertices.size() == 2);
  CHECK(mesh.properties.vertices[0].values == Values{7, 8, 9});
  CHECK(mesh.properties.vertices[1].name == "h");
  CHECK(mesh.properties.vertices[1].values[0] == 1e-3);
  CHECK(std::isnan(mesh.properties.vertices[1].values[1]));
  CHECK(std::isnan(mesh.properties.vertices[1].values[2])); // no number, but nobody needs it

  // vertices in two elements: none of all has the value
  const Polygon_mesh parts =
      parse_mesh(Format::ply, header + xyz + "property int label\nelement vertex 1\n" + xyz + rest +
                                  "0 0 0 1\n1 0 0 1\n0 1 0 1\n0 0 1\n3 0 1 2\n");
  CHECK(parts.properties.empty());
  CHECK(parts.attributes == std::set<std::string>{"vertex property label"});
}

TEST_CASE("colors go from PLY to OBJ and back")
{
  const Mesh_properties bytes = colors(Number_type::uint8, 255);
  const Polygon_mesh obj = parse_mesh(Format::obj, written(Format::obj, Encoding::text, bytes));
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t i = 0; i < points.size(); ++i)
      CHECK(obj.properties.vertices[k].values[i] ==
            doctest::Approx(bytes.vertices[k].values[i]).epsilon(1e-6));
  const Polygon_mesh ply =
      parse_mesh(Format::ply, written(Format::ply, Encoding::binary, obj.properties));
  check_equal(ply.properties.vertices, bytes.vertices);

  const std::string text = written(Format::obj, Encoding::text, colors(Number_type::float32, 1));
  CHECK(text.find("v 7 0 1 1 0 0\n") != std::string::npos);
  CHECK(written(Format::obj, Encoding::text, {}).find("v 7 0 1\n") != std::string::npos);
}

TEST_CASE("materials and groups go from OBJ to OBJ by their names, to PLY as numbers")
{
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
  const Polygon_mesh mesh =
      parse_mesh(Format::obj, vertices + "usemtl red wine\nf 1 2 3\nusemtl steel\ng a b\nf 2 4 3\n"
                                         "usemtl red wine\nf 1 2 4\nl 1 2 -1\np 2\np -2 1\n");
  REQUIRE(mesh.properties.faces.size() == 2);
  const Mesh_property& material = mesh.properties.faces[0];
  CHECK(material.name == "material");
  CHECK(material.values == Values{0, 1, 0});
  CHECK(material.names == std::vector<std::string>{"red wine", "steel"});
  CHECK(mesh.properties.faces[1].names == std::vector<std::string>{"default", "a b"});
  CHECK(mesh.lines == std::vector<CGAL::PowerRTF::Edge>{{0, 1}, {1, 3}});
  CHECK(mesh.dots == std::vector<int>{1, 2, 0});
  CHECK(parse_mesh(Format::obj, vertices + "f 1 2 3\n").properties.empty());
  const Polygon_mesh one = parse_mesh(Format::obj, vertices + "usemtl a\nf 1 2 3\n");
  CHECK(one.properties.faces.size() == 1);
  CHECK(one.properties.faces[0].names == std::vector<std::string>{"a"});

  std::ostringstream out;
  const std::vector<Triangle> again = {{{0, 1, 2}}, {{1, 3, 2}}, {{0, 1, 3}}};
  write_mesh(out, Format::obj, Encoding::text, mesh.soup.points, again, mesh.properties);
  CHECK(out.str().find("usemtl red wine\ng default\nf 1 2 3\nusemtl steel\ng a b\nf 2 4 3\n"
                       "usemtl red wine\nf 1 2 4\n") != std::string::npos);
  check_equal(parse_mesh(Format::obj, out.str()).properties.faces, mesh.properties.faces);
  CHECK(held_by(Format::obj, mesh.properties).faces.size() == 2);
  CHECK(held_by(Format::ply, mesh.properties).faces.size() == 2);
}

TEST_CASE("values are rounded to their types and stay in their ranges")
{
  const auto as = [](Number_type type, double x) {
    double result = 0;
    visit_as(type, x, [&](auto y) { result = double(y); });
    return result;
  };
  CHECK(as(Number_type::uint8, 254.6) == 255);
  CHECK(as(Number_type::uint8, 300) == 255);
  CHECK(as(Number_type::uint8, -3) == 0);
  CHECK(as(Number_type::int8, -2.5) == -3);
  CHECK(as(Number_type::int32, 1e10) == 2147483647);
  CHECK(as(Number_type::int32, std::nan("")) == -2147483648.);
  CHECK(as(Number_type::float64, 1. / 3) == 1. / 3);
}

TEST_CASE("what a format cannot hold is told")
{
  Mesh_properties properties = colors(Number_type::uint8, 255);
  properties.vertices.push_back({"height", Number_type::float32, Values(5, 1)});
  properties.faces.push_back({"label", Number_type::int32, Values(3, 1)});
  using Names = std::set<std::string>;
  CHECK(not_held_by(Format::ply, properties).empty());
  for (const Format format : {Format::vtp, Format::vtu, Format::msh})
    CHECK(not_held_by(format, properties).empty());
  CHECK(not_held_by(Format::obj, properties) ==
        Names{"facet property label", "vertex property height"});
  CHECK(not_held_by(Format::off, properties) ==
        Names{"colors", "facet property label", "vertex property height"});
  CHECK(held_by(Format::stl, properties).empty());
  CHECK(held_by(Format::obj, properties).vertices.size() == 3);
  CHECK(held_by(Format::ply, properties).faces.size() == 1);
}

TEST_CASE("VTP: values have their types, names are escaped")
{
  Mesh_properties properties = colors(Number_type::uint8, 255);
  properties.faces.push_back({"a<b&\"c\"", Number_type::int32, {1e6, -2, 3}});
  const std::string text = written(Format::vtp, Encoding::text, properties);
  CHECK(text.find("type=\"UInt8\" Name=\"red\"") != std::string::npos);
  CHECK(text.find("type=\"Int32\" Name=\"a&lt;b&amp;&quot;c&quot;\" NumberOfComponents=\"1\" "
                  "format=\"ascii\">\n1000000\n-2\n3\n") != std::string::npos);
}

TEST_CASE("VTU: triangles are cells of an unstructured grid")
{
  const Mesh_properties properties = {{}, {{"label", Number_type::int32, {7, 8, 9}}}};
  const std::string text = written(Format::vtu, Encoding::text, properties);
  CHECK(text.find("<VTKFile type=\"UnstructuredGrid\"") != std::string::npos);
  CHECK(text.find("NumberOfCells=\"3\"") != std::string::npos);
  CHECK(text.find("Name=\"label\" NumberOfComponents=\"1\" format=\"ascii\">\n7\n8\n9\n") !=
        std::string::npos);
  CHECK(text.find("Name=\"types\" NumberOfComponents=\"1\" format=\"ascii\">\n5\n5\n5\n") !=
        std::string::npos);
}

TEST_CASE("MSH: the first labels of faces are physical groups, all properties are values")
{
  Mesh_properties properties;
  const auto text = [&] { return written(Format::msh, Encoding::text, properties); };
  const auto has = [&](const std::string& part) { return text().find(part) != std::string::npos; };
  const auto corners = [](std::size_t f) {
    std::string row;
    for (const int v : triangles[f]) row += ' ' + std::to_string(v + 1);
    return row;
  };
  CHECK(has("$Elements\n3\n1 2 2 1 1" + corners(0) + "\n2 2 2 1 1" + corners(1)));
  CHECK_FALSE(has("$PhysicalNames"));

  properties.vertices.push_back({"height", Number_type::float64, {0.1, 2, 3, 4, 5}});
  properties.faces.push_back({"red", Number_type::uint8, {1, 2, 3}});
  properties.faces.push_back({"share", Number_type::float32, {0.5, 1, 2}});
  properties.faces.push_back({"side", Number_type::int32, {7, 9, 7}});
  properties.faces.push_back({"patch", Number_type::int32, {0, 1, 2}});
  CHECK(has("$PhysicalNames\n2\n2 7 \"side 7\"\n2 9 \"side 9\"\n$EndPhysicalNames"));
  CHECK(has("\n2 2 2 9 9" + corners(1) + "\n"));
  CHECK(has("$NodeData\n1\n\"height\"\n1\n0\n3\n0\n1\n5\n1 0.1\n2 2\n"));
  for (const char* const name : {"red", "share", "side", "patch"})
    CHECK(has("$ElementData\n1\n\"" + std::string(name) + "\"\n"));

  properties.faces = {{"patch", Number_type::int32, {0, 1, 0}}}; // 0 would be none
  CHECK(has("$PhysicalNames\n2\n2 1 \"patch 0\"\n2 2 \"patch 1\"\n$EndPhysicalNames"));
  CHECK(has("\n2 2 2 2 2" + corners(1) + "\n3 2 2 1 1" + corners(2) + "\n"));

  properties.faces = {{"material", Number_type::int32, {1, 0, 1}, {"oak \"old\"", "glass"}}};
  CHECK(has("2 1 \"oak 'old'\"\n2 2 \"glass\"\n"));
  CHECK(has("\n1 2 2 2 2" + corners(0) + "\n"));
  CHECK(has("$ElementData\n1\n\"material\"\n1\n0\n3\n0\n1\n3\n1 1\n2 0\n3 1\n"));
}

TEST_CASE("real numbers and colors are interpolated, labels are not, normals have the length 1")
{
  Polygon_mesh input;
  input.properties = {
      {{"red", Number_type::uint8, {0, 100, 255}},
       {"label", Number_type::int32, {5, 6, 1000}},
       {"nx", Number_type::float32, {1, 0, 0}},
       {"ny", Number_type::float32, {0, 1, 0}},
       {"nz", Number_type::float32, {0, 0, 0}},
       {"height", Number_type::float64, {1, 2, 4}}},
      {{"patch", Number_type::uint8, {3, 9}}, {"height", Number_type::float64, {0.5, 1.5}}}};
  CGAL::PowerRTF::Sources sources;
  sources.vertices = {{0, {{2, 0, 1}}, {0, 0.5, 0.5}}, {1, {{0, 1, 2}}, {0.25, 0.25, 0.5}}};
  sources.faces = {{1, {{0, 1, 2}}, {1, 0, 0}}, {0, {{0, 1, 2}}, {1, 0, 0}}};
  const Mesh_properties result = transferred(input, sources);
  CHECK(result.vertices[0].values == Values{50, 152.5});
  CHECK(result.vertices[1].values == Values{5, 1000});
  CHECK(result.vertices[5].values == Values{1.5, 2.75});
  for (const int axis : {2, 3})
    for (const double x : result.vertices[axis].values) CHECK(x == doctest::Approx(std::sqrt(0.5)));
  CHECK(result.faces[0].values == Values{9, 3});
  CHECK(result.faces[1].values == Values{1.5, 0.5});
  for (std::size_t k = 0; k < result.vertices.size(); ++k)
    CHECK(result.vertices[k].type == input.properties.vertices[k].type);
}
