// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program's reader of PLY: every variant that there is, and data that is malformed.
#include "mesh_data.h"

#include <doctest/doctest.h>

using namespace mesh_data;
using tools::parse_mesh;
using tools::Polygon_mesh;

TEST_CASE("PLY: every format, type and order gives the same mesh")
{
  for (const char* const body : bodies)
    for (const bool extra : {false, true}) {
      for (const Type& coordinate : types) {
        CAPTURE(body);
        CAPTURE(coordinate.name);
        const Polygon_mesh mesh =
            parse_mesh(Format::ply, ply(body, coordinate, uchar, int32, extra));
        CHECK(equal(mesh.soup.points, points));
        CHECK(polygons_of(mesh) == polygons);
      }
      for (const Type& length : types)
        for (const Type& index : types) {
          CAPTURE(body);
          CAPTURE(length.name);
          CAPTURE(index.name);
          const std::string data = ply(body, float32, length, index, extra);
          if (length.code == 'f' || index.code == 'f') {
            CHECK(reason(Format::ply, data).find("whole numbers") != std::string::npos);
            continue;
          }
          const Polygon_mesh mesh = parse_mesh(Format::ply, data);
          CHECK(equal(mesh.soup.points, points));
          CHECK(polygons_of(mesh) == polygons);
        }
    }
}

TEST_CASE("PLY: doubles keep all their digits")
{
  const double x = 0.1, y = -1e-300, z = 3.3333333333333332e299;
  for (const char* const body : bodies) {
    Ply data(body);
    data.line("element vertices 1").line("property double x").line("property double y");
    data.line("property double z").line("element faces 1");
    data.line("property list uchar uchar vertex_indices").line("end_header");
    if (std::string(body) == "ascii") {
      data.line("0.1 -1e-300").line("3.3333333333333332e299 3 0 0 0");
    } else {
      for (const double c : {x, y, z}) data.value(types[14], c);
      for (const int v : {3, 0, 0, 0}) data.value(uchar, v);
    }
    const Polygon_mesh mesh = parse_mesh(Format::ply, data.data());
    CHECK(equal(mesh.soup.points, {{x, y, z}}));
  }
}

TEST_CASE("PLY: line ends of other systems, a byte order mark, data after the end")
{
  std::string text = ply("ascii", float32, uchar, int32, false);
  CHECK(reason(Format::ply, "\xef\xbb\xbf" + text + "\nmore") == "read");
  std::string crlf;
  for (const char c : text) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  CHECK(reason(Format::ply, crlf) == "read");
  const std::string binary = ply("binary_little_endian", float32, uchar, int32, false);
  const std::size_t end = binary.find("end_header\n") + 10;
  const Polygon_mesh mesh = parse_mesh(
      Format::ply, binary.substr(0, end) + "\r" + binary.substr(end) + std::string(7, '\xff'));
  CHECK(equal(mesh.soup.points, points));
}

TEST_CASE("PLY: points and facets may be in any number of elements")
{
  const std::size_t count = 3;
  std::string header = "ply\nformat ascii 1.0\n", body;
  for (std::size_t i = 0; i < count; ++i) {
    header += std::string("element vertex 1\n") + xyz;
    header += "element face 1\nproperty list uchar int vertex_index\n";
    body += "1 2 3\n2 0 1\n";
  }
  const Polygon_mesh mesh = parse_mesh(Format::ply, header + "end_header\n" + body);
  CHECK(mesh.soup.points.size() == count);
  CHECK(polygons_of(mesh).size() == count);
}

TEST_CASE("PLY: what is malformed is told")
{
  const std::string text = ply_header("ascii"), little = ply_header("binary_little_endian"),
                    big = ply_header("binary_big_endian"), three = "0 0 0\n1 0 0\n0 1 0\n";
  const std::string zeros(36, '\0');
  struct Case {
    std::string data, reason;
  };
  const std::string huge = "999999999999999999999999";
  for (const Case& c : {
           Case{"", "it is not a PLY file"},
           {"plyformat ascii 1.0", "it is not a PLY file"},
           {"ply", "truncated in its header"},
           {"ply\nformat ascii 1.0\n", "truncated in its header"},
           {"ply\nformat\n", "line 2: the format is missing"},
           {"ply\nformat binary 1.0\n", "line 2: 'binary' is not a format of PLY"},
           {"ply\nend_header\n", "its header names no format"},
           {"ply\nformat ascii 1.0\nproperty float x\n",
            "line 3: a property stands before the first element"},
           {"ply\nformat ascii 1.0\nelement\n", "line 3: the element's name is missing"},
           {"ply\nformat ascii 1.0\nelement vertex\n", "line 3: the number of elements is missing"},
           {"ply\nformat ascii 1.0\nelement vertex -1\n",
            "line 3: '-1' is not a number of elements"},
           {"ply\nformat ascii 1.0\nelement vertex 3x\n", "line 3: '3x' is not a whole number"},
           {"ply\nformat ascii 1.0\nelement vertex 3\nproperty\n",
            "line 4: the property's type is missing"},
           {"ply\nformat ascii 1.0\nelement vertex 3\nproperty real x\n",
            "line 4: 'real' is not a type of PLY"},
           {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float\n",
            "line 4: the property's name is missing"},
           {"ply\nformat ascii 1.0\nelement face 3\nproperty list\n",
            "line 4: the type of the list's length is missing"},
           {"ply\nformat ascii 1.0\nelement face 3\nproperty list float int vertex_indices\n",
            "line 4: 'float' is not a type of whole numbers"},
           {"ply\nformat ascii 1.0\nelement face 3\nproperty list int double vertex_indices\n",
            "line 4: 'vertex_indices' is no list of whole numbers"},
           {"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float x\n",
            "line 5: 'x' occurs twice"},
           {"ply\nformat ascii 1.0\npropertie float x\n",
            "line 3: 'propertie' is not known in the header"},
           {"ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int "
            "vertex_index\nend_header\n"
            "3 0 1 2\n",
            "out of range"},
           {"ply\nformat ascii 1.0\nelement vertex 1\nend_header\n", "no coordinates x, y, z"},
           {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty list int int y\n"
            "property float z\nend_header\n",
            "no coordinates x, y, z"},
           {std::string("ply\nformat ascii 1.0\nelement vertex 1\n") + xyz + "end_header\n0 0 0\n",
            "it has no facets"},
           {std::string("ply\nformat ascii 1.0\nelement face 1\nproperty int vertex_indices\n") +
                "end_header\n0 0 0\n",
            "no list vertex_indices"},
           {text, "truncated: it has no room for vertex 1 of 3"},
           {text + "0 0 0\n1 0", "truncated: it ends in vertex 2 of 3"},
           {text + three, "truncated: it ends in face 1 of 1"},
           {text + three + "3 0 1", "truncated: it ends in face 1 of 1"},
           {text + three + "500000000 0 1 2", "truncated: it ends in face 1 of 1"},
           {text + three + huge + " 0 1 2", "truncated: it ends in face 1 of 1"},
           {text + three + "-1 0 1 2", "line 13: a list has a negative length in face 1 of 1"},
           {text + three + "3 0 1 3", "facet 1 refers to a vertex that does not exist"},
           {text + three + "3 0 1 -1", "facet 1 refers to a vertex that does not exist"},
           {text + three + "3 0 1 " + huge, "facet 1 refers to a vertex that does not exist"},
           {text + three + "3 0 1 2.5", "line 13: '2.5' is not a whole number"},
           {text + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "line 11: 'nan' is not a finite number"},
           {text + "0 0 0\n1 # 0\n0 1 0\n3 0 1 2\n", "line 11: '#' is not a number"},
           {little, "truncated: it has no room for vertex 1 of 3"},
           {little + zeros.substr(1), "truncated: it has no room for vertex 3 of 3"},
           {little + zeros, "truncated: it has no room for face 1 of 1"},
           {little + zeros + '\3' + std::string(11, '\0'), "truncated: it ends in face 1 of 1"},
           {little + std::string("\0\0\xc0\x7f", 4) + zeros.substr(4) + std::string(1, '\0'),
            "vertex 1 has a coordinate that is not finite"},
           {big + zeros + '\1' + std::string("\0\0\0\3", 4), "facet 1 refers to a vertex"},
           {big + zeros + '\1' + std::string("\xff\xff\xff\xff", 4), "facet 1 refers to a vertex"},
           {ply_header("binary_big_endian", "int int") + zeros + std::string(4, '\xff'),
            "a list has a negative length in face 1 of 1"},
           {ply_header("binary_little_endian", "uint int") + zeros +
                std::string("\x00\x65\xcd\x1d", 4) + std::string(12, '\0'), // 5e8 entries
            "truncated: it ends in face 1 of 1"},
           {ply_header("binary_little_endian", "uint double") + zeros + std::string(16, '\xff'),
            "no list of whole numbers"},
       }) {
    CAPTURE(c.data);
    const std::string is = reason(Format::ply, c.data);
    CAPTURE(is);
    CHECK(is.find(c.reason) != std::string::npos);
  }
}

TEST_CASE("PLY: texture coordinates of corners, of facets that have as many, and others")
{
  const std::string header =
      " 1.0\ncomment TextureFile a b.png\ncomment TextureFile c.png\nelement vertex 4\n" +
      std::string(xyz);
  const std::string list = "property list uchar int vertex_indices\n",
                    uv = "property list uchar float texcoord\nproperty int texnumber\n";
  using Uv = std::array<double, 2>;
  for (const char* const body : bodies)
    for (const bool even : {true, false}) {
      CAPTURE(body);
      CAPTURE(even);
      Ply data(body);
      data.line("comment TextureFile a b.png").line("comment TextureFile c.png");
      data.line("element vertex 4").line("property float x").line("property float y");
      data.line("property float z").line("element face 2");
      data.line("property list uchar int vertex_indices");
      data.line("property list uchar float texcoord").line("property int texnumber");
      data.line("end_header");
      for (int v = 0; v < 4; ++v)
        for (const int x : {v % 2, v / 2, 0}) data.value(float32, x);
      const auto facet = [&](const std::vector<int>& corners, const std::vector<double>& numbers,
                             int texture) {
        data.value(uchar, double(corners.size()));
        for (const int v : corners) data.value(int32, v);
        data.value(uchar, double(numbers.size()));
        for (const double x : numbers) data.value(float32, x);
        data.value(int32, texture);
      };
      facet({0, 1, 2}, {0, 0, 0.5, 0, 0, 0.25}, 1);
      facet({1, 3, 2}, even ? std::vector<double>{1, 0, 1, 1, 0, 1} : std::vector<double>(), 0);
      const Polygon_mesh mesh = parse_mesh(Format::ply, data.data());
      CHECK(mesh.texture_error.empty());
      const tools::Texture& texture = mesh.properties.texture;
      std::vector<Uv> wanted = {{0, 0}, {0.5, 0}, {0, 0.25}};
      if (even) wanted.insert(wanted.end(), {{1, 0}, {1, 1}, {0, 1}});
      CHECK(texture.coordinates == wanted);
      CHECK(texture.corners ==
            (even ? std::vector<int>{0, 1, 2, 3, 4, 5} : std::vector<int>{0, 1, 2, -1, -1, -1}));
      REQUIRE(mesh.properties.faces.size() == 1);
      CHECK(mesh.properties.faces[0].name == "material");
      CHECK(mesh.properties.faces[0].values == std::vector<double>{1, 0});
      CHECK(mesh.properties.faces[0].names == std::vector<std::string>{"a b.png", "c.png"});
      CHECK(mesh.attributes == std::set<std::string>{"texture coordinates"});
    }
  const auto error = [&](const std::string& facet) {
    return parse_mesh(Format::ply, "ply\nformat ascii" + header + "element face 1\n" + list + uv +
                                       "end_header\n0 0 0 1 0 0 0 1 0 1 1 0\n" + facet)
        .texture_error;
  };
  CHECK(error("3 0 1 2 6 0 0 1 0 0 1 0\n").empty());
  CHECK(error("3 0 1 2 4 0 0 1 0 0\n") == "facet 1 has 4 numbers for 3 corners");
  CHECK(error("3 0 1 2 6 0 0 x 0 0 1 0\n") == "they are not finite");
}
