// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An input of the cells: lines of numbers. The first one has the cosine of the compatibility angle,
// the guard factor and the first guess of the cells' radii, each further one a site's coordinates,
// normal and weight.
#ifndef CGAL_POWER_RTF_TEST_FUZZ_SITES_INPUT_H
#define CGAL_POWER_RTF_TEST_FUZZ_SITES_INPUT_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace fuzz {

using CGAL::PowerRTF::Vec3d;

struct Sites_input {
  static constexpr std::size_t max_sites = 100;

  struct Site {
    Vec3d point, normal;
    double weight;
  };
  double cos_angle = -2, guard_factor = 3, first_radius = 1;
  std::vector<Site> sites;
};

inline std::istream& operator>>(std::istream& in, Vec3d& v) { return in >> v.x >> v.y >> v.z; }
inline std::ostream& operator<<(std::ostream& out, const Vec3d& v)
{
  return out << v.x << ' ' << v.y << ' ' << v.z;
}

inline std::string to_text(const Sites_input& input)
{
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  out << input.cos_angle << ' ' << input.guard_factor << ' ' << input.first_radius << '\n';
  for (const auto& s : input.sites) out << s.point << ' ' << s.normal << ' ' << s.weight << '\n';
  return out.str();
}

/// None: the text is no input.
inline std::optional<Sites_input> sites_of(const std::string& text)
{
  std::istringstream in(text);
  Sites_input input;
  if (!(in >> input.cos_angle >> input.guard_factor >> input.first_radius)) return std::nullopt;
  Sites_input::Site site;
  while (in >> site.point >> site.normal >> site.weight) input.sites.push_back(site);
  if (!in.eof() || input.sites.empty() || input.sites.size() > Sites_input::max_sites)
    return std::nullopt;
  return input;
}

/// Whether it is one that the remesher may come to: in about the unit box, with weights of about
/// the size of squared lengths there, and without lengths so small that their products underflow.
inline bool is_usable(const Sites_input& input)
{
  const auto is_length = [](double x) {
    return std::abs(x) <= 8 && (x == 0 || std::abs(x) > 1e-60);
  };
  const auto is_vector = [&](const Vec3d& v) {
    return is_length(v.x) && is_length(v.y) && is_length(v.z);
  };
  for (const auto& s : input.sites)
    if (!is_vector(s.point) || !is_vector(s.normal) || !is_length(s.weight) ||
        !(squared_length(s.normal) > 1e-6))
      return false;
  return input.cos_angle >= -2 && input.cos_angle <= 1 && input.guard_factor >= 1 &&
         input.guard_factor <= 1000 && input.first_radius > 1e-6 && input.first_radius <= 8;
}

} // namespace fuzz

#endif // CGAL_POWER_RTF_TEST_FUZZ_SITES_INPUT_H
