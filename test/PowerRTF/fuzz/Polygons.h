// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An input of the soups and of the remesher: a line "# option value option value ...", and an OFF
// file after it, which may name points that are not there.
#ifndef CGAL_POWER_RTF_TEST_FUZZ_POLYGONS_H
#define CGAL_POWER_RTF_TEST_FUZZ_POLYGONS_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace fuzz {

using CGAL::PowerRTF::Vec3d;

struct Polygons {
  static constexpr std::size_t max_points = 60, max_polygons = 100, max_corners = 8;

  std::vector<std::pair<std::string, double>> options;
  std::vector<Vec3d> points;
  std::vector<std::vector<int>> polygons;
};

inline std::string to_text(const Polygons& input)
{
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << '#';
  for (const auto& [name, value] : input.options) out << ' ' << name << ' ' << value;
  out << "\nOFF\n" << input.points.size() << ' ' << input.polygons.size() << " 0\n";
  for (const Vec3d& p : input.points) out << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const auto& polygon : input.polygons) {
    out << polygon.size();
    for (const int v : polygon) out << ' ' << v;
    out << '\n';
  }
  return out.str();
}

/// None: the text is no input.
inline std::optional<Polygons> polygons_of(const std::string& text)
{
  std::istringstream in(text);
  Polygons input;
  std::string line, word;
  if (!std::getline(in, line) || line.empty() || line[0] != '#') return std::nullopt;
  std::istringstream options(line.substr(1));
  for (double value; options >> word >> value;) input.options.emplace_back(word, value);
  std::size_t points, polygons, edges;
  if (!(in >> word >> points >> polygons >> edges) || word != "OFF" ||
      points > Polygons::max_points || polygons > Polygons::max_polygons)
    return std::nullopt;
  input.points.resize(points);
  for (Vec3d& p : input.points) in >> p.x >> p.y >> p.z;
  for (std::size_t size; polygons-- > 0 && in >> size && size <= Polygons::max_corners;) {
    input.polygons.emplace_back(size);
    for (int& v : input.polygons.back()) in >> v;
  }
  if (!in) return std::nullopt;
  return input;
}

} // namespace fuzz

#endif // CGAL_POWER_RTF_TEST_FUZZ_POLYGONS_H
