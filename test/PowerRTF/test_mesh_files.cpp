// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program's readers and writers of mesh files: STL, what all formats share, data that is
// something else, and meshes that come back as they were written.
#include "Text.h"
#include "dataset.h"
#include "foreign_file.h"
#include "mesh_data.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <new>

using namespace mesh_data;
using namespace tools;
using CGAL::PowerRTF::Triangle;

// --- all the memory that is asked for, given back or not -----------------------------------------

namespace {
std::size_t allocated = 0;
}

[[gnu::noinline]] void* operator new(std::size_t size)
{
  allocated += size;
  if (void* const memory = std::malloc(std::max<std::size_t>(size, 1))) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

std::string float_bytes(float x)
{
  const auto bits = bits_of<std::uint32_t>(x);
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(bits >> 8 * i);
  return bytes;
}

/// The triangles of `corners`, three of them each, as binary STL.
std::string binary_stl(const std::string& beginning, const std::vector<Vec3d>& corners,
                       const std::string& attributes = {})
{
  std::string data = beginning + std::string(80 - beginning.size(), ' ');
  const auto count = static_cast<char>(corners.size() / 3);
  data += std::string{count, 0, 0, 0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (i % 3 == 0) data += float_bytes(0) + float_bytes(0) + float_bytes(std::nanf(""));
    for (const double x : {corners[i].x, corners[i].y, corners[i].z})
      data += float_bytes(static_cast<float>(x));
    if (i % 3 == 2)
      data += attributes.empty() ? std::string(2, ' ') : attributes.substr(i / 3, 1) + '\0';
  }
  return data;
}

} // namespace

TEST_CASE("STL: text and binary give the same mesh")
{
  const std::vector<Vec3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5},
                                      {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5}};
  const std::vector<Vec3d> merged = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5}, {1, 1, 0}};
  const std::vector<std::vector<std::size_t>> facets = {{0, 1, 2}, {1, 3, 2}};
  const std::string two_facets =
      "facet normal 0 0 nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 .5\nendloop\n"
      "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 0 -0\nvertex 1 1 0\nvertex 0 1 .5\n"
      "endloop\nendfacet\n";
  std::string in_one_line = two_facets;
  std::replace(in_one_line.begin(), in_one_line.end(), '\n', ' ');
  const std::string cut = two_facets.substr(0, two_facets.find("facet normal 0 0 1"));
  for (const std::string& data :
       {"solid\n" + two_facets + "endsolid\n",
        "\n solid a facet # 3\r\n" + two_facets + "endsolid a",
        "solid vertex\n" + two_facets + "endsolid vertex\n",
        "solid s " + in_one_line + "endsolid s", "\xef\xbb\xbfsolid\n" + two_facets + "endsolid\n",
        "solid a\n" + cut + "endsolid a\nsolid b\n" + two_facets.substr(cut.size()) +
            "endsolid b\n",
        binary_stl("", corners), binary_stl("solid but binary", corners),
        binary_stl("ply\n", corners), binary_stl("", corners) + "a few bytes more"}) {
    CAPTURE(data);
    const Polygon_mesh mesh = parse_mesh(Format::stl, data);
    CHECK(equal(mesh.soup.points, merged));
    CHECK(polygons_of(mesh) == facets);
  }
}

TEST_CASE("STL: what is malformed is told")
{
  const std::vector<Vec3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::string begin = "solid s\nfacet normal 0 0 1\nouter loop\n", a = "vertex 0 0 0\n",
                    end = "endloop\nendfacet\nendsolid s\n";
  struct Case {
    std::string data, reason;
  };
  for (const Case& c : {
           Case{"", "it is not an STL file"},
           {"solid", "truncated: it does not end with endsolid"},
           {"solid s\nendsolid s\n", "it has no facets"},
           {begin, "truncated: it ends in a facet"},
           {begin + a + a + "vertex 0 0", "truncated: it ends in a facet"},
           {begin + a + a + end, "line 7: a facet with fewer than three vertices"},
           {begin + a + a + a + a + end, "line 7: a facet with more than three vertices"},
           {begin + a + "vertex 0 inf 0\n" + a + end, "line 5: 'inf' is not a finite number"},
           {begin + a + "vertex 0 x 0\n" + a + end, "line 5: 'x' is not a number"},
           {begin + a + a + a + "endloop\nendfacet\n", "truncated: it does not end with endsolid"},
           {"solid s\n" + a + end, "line 2: 'vertex' stands outside of a facet"},
           {"solid s\nendfacet\n" + end, "line 2: 'endfacet' stands outside of a facet"},
           {binary_stl("", corners).substr(0, 100), "announces 1 facets, the file has room for 0"},
           {binary_stl("", corners) + binary_stl("", corners), "the file has room for 3"},
           {binary_stl("", {}), "it has no facets"},
           {std::string(83, ' '), "truncated in its header"},
           {binary_stl("", {{0, 0, 0}, {HUGE_VAL, 0, 0}, {0, 1, 0}}), "vertex 2 has a coordinate"},
       }) {
    CAPTURE(c.data);
    const std::string is = reason(Format::stl, c.data);
    CAPTURE(is);
    CHECK(is.find(c.reason) != std::string::npos);
  }
}

TEST_CASE("memory stays in proportion to the size of the data")
{
  const std::string zeros(36, '\0'), digits(2000, '9'), large = "1152921504606846975";
  std::string many = "ply\nformat ascii 1.0\nelement face 1\nproperty list char int vertex_index\n",
              values = "1 5000\n"; // out of range; then points, each an element of its own
  for (int i = 0; i < 5000; ++i) {
    many += std::string("element vertex 1\n") + xyz;
    values += "1 2 3\n";
  }
  many += "end_header\n" + values;
  struct Case {
    Format format;
    std::string data;
  };
  for (const Case& c : {
           Case{Format::ply, ply_header("binary_little_endian", "uint int") + zeros +
                                 std::string("\x00\x65\xcd\x1d", 4) + std::string(12, '\0')},
           {Format::ply,
            ply_header("binary_big_endian", "uint int") + zeros + std::string(1000, '\xff')},
           {Format::ply, ply_header("ascii", "uint int") + "0 0 0 1 0 0 0 1 0 " + large + " 0 1 2"},
           {Format::ply, ply_header("ascii", "uint int") + "0 0 0 1 0 0 0 1 0 " + digits},
           {Format::ply,
            "ply\nformat ascii 1.0\nelement vertex " + large + "\n" + xyz +
                "element face 1\nproperty list uchar int vertex_indices\nend_header\n"},
           {Format::ply, "ply\nformat binary_little_endian 1.0\nelement face " + large +
                             "\nproperty list uchar int vertex_indices\nend_header\n" +
                             std::string(1000, '\0')},
           {Format::ply, "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty list uint "
                         "double x\n" +
                             std::string(xyz) +
                             "element face 1\nproperty list uchar int "
                             "vertex_indices\nend_header\n" +
                             std::string(1000, '\x7f')},
           {Format::ply, many},
           {Format::off, "OFF\n" + large + " " + large + " 0\n"},
           {Format::off, "OFF\n1 1 0\n0 0 0\n" + large + " 0\n"},
           {Format::obj, "v 0 0 0\nf " + large + " 1 1\n"},
           {Format::stl, std::string(80, ' ') + "\xff\xff\xff\xff" + std::string(1000, ' ')},
       }) {
    CAPTURE(c.data);
    const std::size_t before = allocated;
    CHECK(reason(c.format, c.data) != "read");
    CHECK(allocated - before < 100 * c.data.size() + 5000);
  }
}

TEST_CASE("attributes beside points and facets are told")
{
  using Names = std::set<std::string>;
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const auto of = [](Format format, const std::string& data) {
    return parse_mesh(format, data).attributes;
  };
  CHECK(of(Format::off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").empty());
  CHECK(of(Format::off, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n") == Names{"colors"});
  CHECK(of(Format::off,
           "STNOFF\n3 1 0\n0 0 0 1 0 0 0 0\n1 0 0 1 0 0 0 0\n0 1 0 1 0 0 0 0\n3 0 1 2\n") ==
        Names{"normals", "texture coordinates"});
  CHECK(of(Format::off, "COFF\n3 1 0\n0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 1 1 1\n3 0 1 2\n") ==
        Names{"colors"});

  CHECK(of(Format::obj, v + "o one\ng two\ns off\nmtllib x.mtl\nf 1 2 3\n").empty());
  CHECK(of(Format::obj, v + "vt 0 0\nvn 0 0 1\nusemtl m\nf 1/1/1 2/1/1 3/1/1\n") ==
        Names{"materials", "normals", "texture coordinates"});
  CHECK(of(Format::obj, v + "g a\ng b\no c\no d\ns 1\nl 1 2\np 1\nf 1 2 3\n") ==
        Names{"groups", "lines", "objects", "points", "smoothing groups"});
  CHECK(of(Format::obj, "v 0 0 0 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").empty()); // a weight
  CHECK(of(Format::obj, "v 0 0 0 1 .5 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n") ==
        Names{"colors of some vertices"});

  for (const char* const body : bodies) {
    CHECK(of(Format::ply, ply(body, float32, uchar, int32, false)).empty());
    CHECK(of(Format::ply, ply(body, float32, uchar, int32, true)) ==
          Names{"lines", "texture coordinates", "vertex property weights"}); // lists
    CHECK(parse_mesh(Format::ply, ply(body, float32, uchar, int32, true)).lines ==
          std::vector<CGAL::PowerRTF::Edge>{{0, 1}});
    Ply ends(body); // of edges, of which only one is a number of a vertex
    ends.line("element vertex 3").line("property float x").line("property float y");
    ends.line("property float z").line("element edge 2").line("property int mark");
    ends.line("property int vertex1").line("property float vertex2").line("element face 1");
    ends.line("property list uchar int vertex_indices").line("end_header");
    for (const double x : {0, 0, 0, 1, 0, 0, 0, 1, 0}) ends.value(float32, x);
    for (const double x : {0, 1}) ends.value(int32, 7).value(int32, x).value(float32, x + 1);
    ends.value(uchar, 3).value(int32, 0).value(int32, 1).value(int32, 2);
    CHECK(of(Format::ply, ends.data()) == Names{"elements edge"});
    CHECK(parse_mesh(Format::ply, ends.data()).lines.empty());
  }

  const std::vector<Vec3d> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                      {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  CHECK(of(Format::stl, binary_stl("", corners)).empty());
  CHECK(of(Format::stl, binary_stl("", corners, "aa")).empty());
  CHECK(of(Format::stl, binary_stl("", corners, "ab")) == Names{"facet attributes"});
  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                            "vertex 0 1 0\nendloop\nendfacet\n";
  CHECK(of(Format::stl, "solid a\n" + facet + "endsolid\n").empty());
  CHECK(of(Format::stl, "solid a\n" + facet + "endsolid\nsolid b\n" + facet + "endsolid\n") ==
        Names{"groups"});
}

TEST_CASE("foreign files are named, a format's own are not")
{
  const auto is = [](Format format, const std::string& data) { return foreign_kind(data, format); };
  for (const Format format :
       {Format::off, Format::obj, Format::ply, Format::stl, Format::unknown}) {
    CHECK(is(format, "\x1f\x8b\x08") == "it is a gzip archive: unpack it first");
    CHECK(is(format, "PK\3\4") == "it is a zip archive: unpack it first");
    CHECK(is(format, std::string("\xfd"
                                 "7zXZ\0",
                                 6)) == "it is an xz archive: unpack it first");
    CHECK(is(format, "\xfe\xff").find("UTF-16") != std::string::npos);
    CHECK(is(format, " \r\n<!DOCTYPE html>").find("an HTML page") != std::string::npos);
    CHECK(is(format, "<HTML lang=").find("an HTML page") != std::string::npos);
    CHECK(is(format, "<?xml version=\"1.0\"?>").find("an XML file") != std::string::npos);
    CHECK(is(format, "# nothing known\n").empty());
    CHECK(is(format, "").empty());
    CHECK(is(format, "ply\nformat").empty() == (format == Format::ply));
    CHECK(is(format, "OFF\r\n3 1").empty() == (format == Format::off));
    CHECK(is(format, "solid s\n").empty() == (format == Format::stl));
  }
}

TEST_CASE("meshes come back as they were written")
{
  const std::vector<Vec3d> exact = {{0.1, -1e-300, 1e300 / 3},
                                    {1 / 3., 2 / 7., 5e-324}, // the least number above 0
                                    {5e8 + 1 / 3., 1, -0.0},
                                    {-1, -2, 1e22}};
  const std::vector<Vec3d> single = {
      {0.5, -0.25, 1024}, {1.0f / 3, 1, 0}, {7, -1e30f, 3}, {1, 2, 9}};
  const std::vector<Triangle> triangles = {{{0, 1, 2}}, {{0, 2, 3}}, {{3, 1, 0}}};
  for (const Format format : {Format::off, Format::obj, Format::ply, Format::stl})
    for (const Encoding encoding : {Encoding::binary, Encoding::text}) {
      CAPTURE(static_cast<int>(format));
      CAPTURE(static_cast<int>(encoding));
      const bool floats = format == Format::stl && encoding == Encoding::binary;
      const std::vector<Vec3d>& written = floats ? single : exact;
      std::ostringstream out;
      write_mesh(out, format, encoding, written, triangles);
      const Polygon_mesh mesh = parse_mesh(format, out.str());
      CHECK(mesh.attributes.empty());
      CHECK(equal(mesh.soup.points, written));
      REQUIRE(polygons_of(mesh).size() == triangles.size());
      for (std::size_t f = 0; f < triangles.size(); ++f)
        CHECK(std::equal(triangles[f].begin(), triangles[f].end(),
                         mesh.soup.corners.begin() + 3 * f));
    }
}

TEST_CASE("rows that all threads make are written in order")
{
  for (const std::size_t n : {0, 1, 4095, 4096, 4097, (1 << 20) - 1, 1 << 20, (1 << 20) + 4097}) {
    std::ostringstream out;
    write_rows(out, n, [](Text& text, std::size_t i) { text << i << "\n"; });
    std::string expected;
    for (std::size_t i = 0; i < n; ++i) expected += std::to_string(i) + '\n';
    CHECK((out.str() == expected)); // not printed
  }
}

TEST_CASE("VTP: dots, lines and polygons with values, in this order")
{
  Dataset data;
  data.points = {{0.1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  data.polygons = {{0, 1, 2}};
  data.lines = {{0, 1}, {1, 2}};
  data.dots = {{2}};
  data.cell_fields = {{"kind", {}, {7, 8, 8, 9}},
                      {"axis", {}, {}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5, 0, 0}}}};
  std::ostringstream out;
  write_vtp(out, data);
  const std::string text = out.str();
  std::size_t at = 0; // what follows is found in this order
  for (const char* part :
       {"NumberOfPoints=\"3\" NumberOfVerts=\"1\" NumberOfLines=\"2\"", "NumberOfPolys=\"1\"",
        "<CellData>", "\"kind\"", "7\n8\n8\n9\n", "Name=\"axis\" NumberOfComponents=\"3\"",
        "1 0 0\n0 1 0\n0 0 1\n0.5 0 0\n", "<Points>", "0.1 2 3\n", "<Verts>", "2 \n", "<Lines>",
        "0 1 \n1 2 \n", "2\n4\n", "<Polys>", "0 1 2 \n"}) {
    INFO(part);
    at = text.find(part, at);
    REQUIRE(at != std::string::npos);
  }
}

TEST_CASE("PLY with values: binary and text hold the same")
{
  Dataset data;
  data.points = {{0.1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  data.normals = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  data.point_fields = {{"weight", {0.25, -1e-9, 3}, {}}};
  data.cell_fields = {{"sample", {}, {-5, 70000}}, {"mass", {1.5, 2.5}, {}}};
  for (const std::size_t corners : {3, 255, 256, 1000}) { // a byte holds the number, or does not
    data.polygons = {std::vector<int>(corners, 2), {0, 1, 2}};
    for (const Encoding encoding : {Encoding::binary, Encoding::text}) {
      std::ostringstream out;
      write_ply(out, data, encoding);
      const Polygon_mesh mesh = parse_mesh(Format::ply, out.str());
      CHECK(equal(mesh.soup.points, data.points));
      REQUIRE(polygons_of(mesh).size() == 2);
      CHECK(polygons_of(mesh)[0] == std::vector<std::size_t>(corners, 2));
      CHECK(polygons_of(mesh)[1] == std::vector<std::size_t>{0, 1, 2});
      CHECK(mesh.attributes.empty());
      const auto& vertices = mesh.properties.vertices;
      const auto& faces = mesh.properties.faces;
      REQUIRE(vertices.size() == 4); // the normals first
      CHECK(vertices[0].values == std::vector<double>{0, 0, 1});
      CHECK(vertices[3].values == data.point_fields[0].values);
      REQUIRE(faces.size() == 2);
      CHECK(faces[0].values == std::vector<double>{-5, 70000});
      CHECK(faces[1].values == data.cell_fields[1].values);
    }
  }
}
