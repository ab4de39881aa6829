// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_io.h"

#include "dataset.h"
#include "foreign_file.h"
#include "gltf_mesh.h"
#include "gmsh_mesh.h"
#include "obj_mesh.h"
#include "off_mesh.h"
#include "output_file.h"
#include "ply_mesh.h"
#include "stl_mesh.h"
#include "vtp_mesh.h"

#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <CGAL/IO/STL.h>
#include <CGAL/Simple_cartesian.h>

#include <boost/interprocess/exceptions.hpp>
#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

namespace tools {
namespace {

namespace fs = std::filesystem;
using CGAL::PowerRTF::Invalid_input_error;
using CGAL::PowerRTF::Triangle;
using CGAL::PowerRTF::Vec3d;
using Point = CGAL::Simple_cartesian<double>::Point_3;

/// Why the file cannot be opened; empty if it can.
std::string file_error(const std::string& file)
{
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (!fs::exists(status))
    return error && error != std::errc::no_such_file_or_directory ? error.message()
                                                                  : "there is no such file";
  if (fs::is_directory(status)) return "it is a directory";
  if (!fs::is_regular_file(status)) return "it is not a regular file";
  if (fs::file_size(file, error) == 0) return "the file is empty";
  errno = 0;
  if (!std::ifstream(file)) return std::strerror(errno);
  return {};
}

/// The first bytes of the file, as many as there are.
std::string read_bytes(const std::string& file, std::uintmax_t count)
{
  std::ifstream in(file, std::ios::binary);
  std::string data(static_cast<std::size_t>(count), '\0');
  in.read(data.data(), static_cast<std::streamsize>(count));
  data.resize(static_cast<std::size_t>(in.gcount()));
  return data;
}

/// Why a file that can be opened is no mesh of that format; empty if it may be one.
std::string kind_error(const std::string& file, Format format)
{
  const std::string beginning = read_bytes(file, 256);
  if (format == Format::stl && is_binary_stl(beginning, fs::file_size(file))) return {};
  const std::string foreign = foreign_kind(beginning, format);
  if (!foreign.empty()) return foreign;
  if (!is_read(format)) return std::string("its name does not end in ") + read_endings;
  return {};
}

/// \throws Invalid_input_error there is no facet, a coordinate is not finite, an index out of range
void check(const Polygon_mesh& mesh)
{
  const auto& [points, corners, first, merges_vertices] = mesh.soup;
  if (first.size() == 1) throw Invalid_input_error("it has no facets");
  const int vertices = static_cast<int>(points.size());
  const auto find = [](int n, const auto& is_wrong) {
    const std::vector<int> found =
        CGAL::PowerRTF::internal::select(CGAL::Parallel_if_available_tag(), n, is_wrong);
    return found.empty() ? -1 : found[0];
  };
  const int v = find(vertices, [&p = points](int i) {
    return !std::isfinite(p[i].x) || !std::isfinite(p[i].y) || !std::isfinite(p[i].z);
  });
  if (v >= 0)
    throw Invalid_input_error("vertex " + std::to_string(v + 1) +
                              " has a coordinate that is not finite");
  const int c = find(static_cast<int>(corners.size()), [vertices, &all = corners](int i) {
    return all[i] < 0 || all[i] >= vertices;
  });
  if (c >= 0)
    throw Invalid_input_error(
        "facet " + std::to_string(std::upper_bound(first.begin(), first.end(), c) - first.begin()) +
        " refers to a vertex that does not exist: the index is out of range");
}

/// \throws Output_error a coordinate is too large for a float
void check_single_precision(const std::vector<Vec3d>& points)
{
  const double largest = std::numeric_limits<float>::max();
  for (const Vec3d& p : points)
    for (const double x : {p.x, p.y, p.z})
      if (std::abs(x) > largest)
        throw Output_error("a coordinate is too large for single precision");
}

} // namespace

Polygon_mesh read_mesh(const std::string& file)
{
  const Format format = format_of(file);
  try {
    std::string reason = file_error(file);
    if (reason.empty()) reason = kind_error(file, format);
    if (!reason.empty()) throw Invalid_input_error(reason);
    namespace ipc = boost::interprocess;
    const ipc::mapped_region data(ipc::file_mapping(file.c_str(), ipc::read_only), ipc::read_only);
    return parse_mesh(format, {static_cast<const char*>(data.get_address()), data.get_size()},
                      fs::path(file).parent_path().string());
  } catch (const Invalid_input_error& e) {
    throw Invalid_input_error(file + ": cannot be read: " + e.what());
  } catch (const boost::interprocess::interprocess_exception& e) { // it cannot be mapped
    throw Invalid_input_error(file + ": cannot be read: " + e.what());
  }
}

Polygon_mesh parse_mesh(Format format, std::string_view data, const std::string& folder)
{
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf"; // as some editors begin UTF-8
  const bool is_text = format != Format::stl || !is_binary_stl(data, data.size());
  if (is_text && data.substr(0, byte_order_mark.size()) == byte_order_mark)
    data.remove_prefix(byte_order_mark.size());
  Polygon_mesh mesh = format == Format::off   ? parse_off(data)
                      : format == Format::obj ? parse_obj(data)
                      : format == Format::ply ? parse_ply(data)
                      : format == Format::vtp ? parse_vtp(data)
                      : is_gltf(format)       ? parse_gltf(data, folder)
                                              : parse_stl(data);
  mesh.soup.merges_vertices = true;
  check(mesh);
  return mesh;
}

void write_mesh(std::ostream& out, Format format, Encoding encoding,
                const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles,
                const Mesh_properties& properties)
{
  if (format == Format::msh) return write_msh(out, points, triangles, properties);
  if (holds_numbers(format)) {
    Dataset data;
    data.points = points;
    data.point_fields = fields_of(properties.vertices);
    data.cell_fields = fields_of(properties.faces);
    data.polygons.reserve(triangles.size(), 3 * triangles.size());
    for (const Triangle& t : triangles) data.polygons.add(t);
    if (!properties.texture.empty()) data.texture = &properties.texture;
    data.texture_files = properties.texture_files;
    return format == Format::ply   ? write_ply(out, data, encoding)
           : format == Format::vtp ? write_vtp(out, data)
                                   : write_vtu(out, data);
  }
  if (format == Format::off) return write_off(out, points, triangles);
  if (format == Format::obj) return write_obj(out, points, triangles, properties);
  if (holds_floats(format, encoding)) check_single_precision(points);
  if (is_gltf(format)) return write_gltf(out, format == Format::glb, points, triangles, properties);
  std::vector<Point> copies;
  copies.reserve(points.size());
  for (const Vec3d& p : points) copies.emplace_back(p.x, p.y, p.z);
  if (encoding == Encoding::binary) CGAL::IO::set_binary_mode(out);
  CGAL::IO::write_STL(out, copies, triangles, CGAL::parameters::stream_precision(17));
}

} // namespace tools
