// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Changes sites into others that are likely to be hard: with ties, near ties, duplicates and sites
// on each other's normals.
#ifndef CGAL_POWER_RTF_TEST_FUZZ_MUTATE_SITES_H
#define CGAL_POWER_RTF_TEST_FUZZ_MUTATE_SITES_H

#include "../random_input.h"
#include "Sites_input.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace fuzz {

using random_input::Random;

/// 1 to 2^-60, of any order of magnitude, with either sign.
inline double small_number(Random& r)
{
  return std::ldexp(r.integer(0, 1) ? 1. : r.real(-1, 1), -r.integer(0, 60));
}

class Sites_mutator {
  Sites_input& m_input;
  Random& m_random;

public:
  Sites_mutator(Sites_input& input, Random& random) : m_input(input), m_random(random) {}

  void mutate()
  {
    switch (m_random.integer(0, 8)) {
    case 0:
      return add();
    case 1:
      return remove();
    case 2:
    case 3:
      return move(any());
    case 4:
      return turn(any());
    case 5:
      return weigh(any());
    case 6:
      return change_settings();
    case 7:
      return reflect();
    default:
      return round(any());
    }
  }

private:
  using Site = Sites_input::Site;

  Site& any() { return m_input.sites[m_random.integer(0, int(m_input.sites.size()) - 1)]; }

  double& coordinate(Vec3d& v)
  {
    const int k = m_random.integer(0, 2);
    return k == 0 ? v.x : k == 1 ? v.y : v.z;
  }

  /// A copy of a site, changed, or its image around another one: as far from it.
  void add()
  {
    if (m_input.sites.size() == Sites_input::max_sites) return;
    Site site = any();
    const Vec3d center = any().point;
    Vec3d offset = site.point - center;
    if (m_random.integer(0, 1)) {
      std::swap(offset.x, coordinate(offset));
      std::swap(offset.y, coordinate(offset));
      double& x = coordinate(offset);
      x = -x;
      site.point = center + offset;
    } else {
      move(site);
    }
    m_input.sites.push_back(site);
  }

  void remove()
  {
    if (m_input.sites.size() < 2) return;
    std::swap(any(), m_input.sites.back());
    m_input.sites.pop_back();
  }

  void move(Site& s)
  {
    switch (m_random.integer(0, 4)) {
    case 0:
      coordinate(s.point) = m_random.integer(-8, 8) / 8.;
      break;
    case 1:
      coordinate(s.point) = coordinate(any().point);
      break;
    case 2:
      coordinate(s.point) += small_number(m_random);
      break;
    case 3:
      s.point = any().point + s.normal * small_number(m_random);
      break;
    default:
      s.point = m_random.in_box();
    }
  }

  void turn(Site& s)
  {
    switch (m_random.integer(0, 4)) {
    case 0:
      s.normal = any().normal;
      break;
    case 1:
      coordinate(s.normal) += small_number(m_random);
      break;
    case 2:
      s.normal = any().point - any().point;
      break;
    case 3:
      s.normal = s.normal * -1.;
      break;
    default:
      s.normal = m_random.direction();
    }
    if (squared_length(s.normal) > 0) s.normal = normalized(s.normal);
  }

  /// Also so that its bisector with another site passes through one of the two.
  void weigh(Site& s)
  {
    const Site& other = any();
    switch (m_random.integer(0, 3)) {
    case 0:
      s.weight = 0;
      break;
    case 1:
      s.weight += small_number(m_random);
      break;
    case 2:
      s.weight = other.weight;
      break;
    default:
      s.weight = other.weight + squared_length(s.point - other.point);
    }
  }

  void change_settings()
  {
    switch (m_random.integer(0, 2)) {
    case 0:
      m_input.cos_angle = m_random.integer(-4, 1) / 2.;
      break;
    case 1:
      m_input.guard_factor = 1 + std::abs(2 * small_number(m_random));
      break;
    default:
      m_input.first_radius = std::ldexp(1, m_random.integer(-16, 2));
    }
  }

  /// Exchanges the coordinates of all sites: their cells keep their shapes.
  void reflect()
  {
    for (Site& s : m_input.sites) {
      std::swap(s.point.x, s.point.z);
      std::swap(s.normal.x, s.normal.z);
    }
  }

  void round(Site& s)
  {
    const double unit = std::ldexp(1, -m_random.integer(2, 20));
    for (double* x : {&s.point.x, &s.point.y, &s.point.z}) *x = std::round(*x / unit) * unit;
  }
};

} // namespace fuzz

#endif // CGAL_POWER_RTF_TEST_FUZZ_MUTATE_SITES_H
