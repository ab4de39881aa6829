// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Data of mesh files, made in code.
#ifndef CGAL_POWER_RTF_TEST_MESH_DATA_H
#define CGAL_POWER_RTF_TEST_MESH_DATA_H

#include "mesh_io.h"

#include <CGAL/PowerRTF/internal/errors.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace mesh_data {

using CGAL::PowerRTF::Invalid_input_error;
using CGAL::PowerRTF::Vec3d;
using tools::Format;

/// Its coordinates are whole numbers below 128, so that every type holds them.
inline const std::vector<Vec3d> points = {
    {0, 0, 0}, {7, 0, 1}, {0, 5, 2}, {9, 100, 3}, {127, 4, 8}};
inline const std::vector<std::vector<std::size_t>> polygons = {{0, 1, 2}, {1, 3, 2}, {0, 1, 3, 4}};

inline bool equal(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b)
{
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](const Vec3d& p, const Vec3d& q) {
           return p.x == q.x && p.y == q.y && p.z == q.z;
         });
}

inline std::vector<std::vector<std::size_t>> polygons_of(const tools::Polygon_mesh& mesh)
{
  const CGAL::PowerRTF::Polygon_soup& soup = mesh.soup;
  std::vector<std::vector<std::size_t>> result;
  for (std::size_t k = 0; k + 1 < soup.first.size(); ++k)
    result.emplace_back(soup.corners.begin() + soup.first[k],
                        soup.corners.begin() + soup.first[k + 1]);
  return result;
}

struct Type {
  const char* name;
  char code; ///< i: signed, u: unsigned, f: floating-point
  std::size_t size;
};
inline const Type types[] = {
    {"char", 'i', 1},  {"int8", 'i', 1},    {"uchar", 'u', 1},  {"uint8", 'u', 1},
    {"short", 'i', 2}, {"int16", 'i', 2},   {"ushort", 'u', 2}, {"uint16", 'u', 2},
    {"int", 'i', 4},   {"int32", 'i', 4},   {"uint", 'u', 4},   {"uint32", 'u', 4},
    {"float", 'f', 4}, {"float32", 'f', 4}, {"double", 'f', 8}, {"float64", 'f', 8}};
inline const char* const bodies[] = {"ascii", "binary_little_endian", "binary_big_endian"};

template <class To, class From>
To bits_of(From from)
{
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof(to));
  return to;
}

/// Makes PLY data.
class Ply {
public:
  explicit Ply(const std::string& body) : m_body(body)
  {
    m_data = "ply\nformat " + body + " 1.0\ncomment made by a test\nobj_info # 1\n";
  }

  Ply& line(const std::string& text)
  {
    m_data += text + '\n';
    return *this;
  }
  Ply& value(const Type& type, double x)
  {
    if (m_body == "ascii") {
      std::ostringstream text;
      text << x << (++m_values % 5 == 0 ? "\r\n" : " ");
      m_data += text.str();
      return *this;
    }
    const std::uint64_t bits = type.code != 'f'
                                   ? static_cast<std::uint64_t>(static_cast<std::int64_t>(x))
                               : type.size == 4 ? bits_of<std::uint32_t>(static_cast<float>(x))
                                                : bits_of<std::uint64_t>(x);
    std::string bytes;
    for (std::size_t i = 0; i < type.size; ++i) bytes += static_cast<char>(bits >> 8 * i);
    if (m_body == "binary_big_endian") std::reverse(bytes.begin(), bytes.end());
    m_data += bytes;
    return *this;
  }
  const std::string& data() const { return m_data; }

private:
  std::string m_body, m_data;
  int m_values = 0;
};

inline const Type& uchar = types[2];
inline const Type& int32 = types[8];
inline const Type& float32 = types[12];

/// The mesh as PLY. `extra`: with other properties and elements, facets before points.
inline std::string ply(const std::string& body, const Type& coordinate, const Type& length,
                       const Type& index, bool extra)
{
  Ply ply(body);
  const std::string xyz = coordinate.name;
  const auto vertex_header = [&] {
    ply.line("element vertex " + std::to_string(points.size()));
    if (extra) ply.line("property list uchar float weights").line("property uchar red");
    ply.line("property " + xyz + " x")
        .line("property " + xyz + " z")
        .line("property " + xyz + " y");
    if (extra) ply.line("property float nx");
  };
  const auto vertices = [&] {
    for (const Vec3d& p : points) {
      if (extra) ply.value(uchar, 2).value(float32, .5).value(float32, .25).value(uchar, 255);
      ply.value(coordinate, p.x).value(coordinate, p.z).value(coordinate, p.y);
      if (extra) ply.value(float32, std::nan(""));
    }
  };
  const auto facet_header = [&] {
    ply.line("element face " + std::to_string(polygons.size()));
    ply.line(std::string("property list ") + length.name + ' ' + index.name +
             (extra ? " vertex_index" : " vertex_indices"));
    if (extra) ply.line("property int quality").line("property list uint8 float32 texcoord");
  };
  const auto facets = [&] {
    for (const auto& polygon : polygons) {
      ply.value(length, double(polygon.size()));
      for (const std::size_t v : polygon) ply.value(index, double(v));
      if (extra) ply.value(int32, -7).value(uchar, 0);
    }
  };
  if (!extra) {
    vertex_header();
    facet_header();
    ply.line("end_header");
    vertices();
    facets();
    return ply.data();
  }
  ply.line("element nothing 1000000000000").line("element none 0").line("property int number");
  facet_header();
  ply.line("element edge 1").line("property int vertex1").line("property int vertex2");
  vertex_header();
  ply.line("end_header");
  facets();
  ply.value(int32, 0).value(int32, 1);
  vertices();
  return ply.data();
}

/// Why the data cannot be read; "read" if it can.
inline std::string reason(Format format, const std::string& data)
{
  try {
    parse_mesh(format, data);
  } catch (const Invalid_input_error& e) {
    return e.what();
  }
  return "read";
}

inline const char* const xyz = "property float x\nproperty float y\nproperty float z\n";

/// A header for three points and one facet.
inline std::string ply_header(const std::string& body, const std::string& list = "uchar int")
{
  return "ply\nformat " + body + " 1.0\nelement vertex 3\n" + xyz +
         "element face 1\nproperty list " + list + " vertex_indices\nend_header\n";
}

} // namespace mesh_data

#endif // CGAL_POWER_RTF_TEST_MESH_DATA_H
