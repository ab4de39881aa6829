// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SAMPLING_RANDOM_SOURCE_H
#define CGAL_POWER_RTF_SAMPLING_RANDOM_SOURCE_H

#include <CGAL/PowerRTF/internal/mixed_bits.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>

namespace CGAL::PowerRTF {

/// Uniform in [0, 1): a function of its arguments alone, so that numbers can be drawn in any order.
CGAL_POWER_RTF_HD inline double counted_random(std::uint64_t seed, std::uint64_t index,
                                               std::uint64_t stream)
{
  using internal::mixed_bits;
  constexpr std::uint64_t golden = 0x9e3779b97f4a7c15u;
  const std::uint64_t key = mixed_bits(seed * golden + golden) + stream * golden;
  return static_cast<double>(mixed_bits(mixed_bits(index * golden + key) + key) >> 11) * 0x1p-53;
}

/// Random numbers that are the same with every standard library, which the distributions of
/// `<random>` are not.
class Random_source {
public:
  explicit Random_source(unsigned seed) : m_bits(seed) {}

  /// Uniform in [0, 1).
  double operator()() { return static_cast<double>(m_bits() >> 11) * 0x1p-53; }

  /// Barycentric coordinates of a random point of a triangle, distributed like the linear function
  /// with the values `density` at its corners (all equal: uniformly).
  std::array<double, 3> barycentric(const std::array<double, 3>& density)
  {
    // A linear density is a mixture of three, each proportional to one coordinate; for that one the
    // coordinate is distributed like the median of three uniform numbers (Beta(2, 2)).
    const double pick = (*this)() * (density[0] + density[1] + density[2]);
    const int i = pick < density[0] ? 0 : pick < density[0] + density[1] ? 1 : 2;
    const double a = (*this)(), b = (*this)(), c = (*this)();
    const double median = (std::max)((std::min)(a, b), (std::min)((std::max)(a, b), c));
    const double share = (*this)();
    std::array<double, 3> result;
    result[i] = median;
    result[(i + 1) % 3] = (1 - median) * share;
    result[(i + 2) % 3] = (1 - median) * (1 - share);
    return result;
  }

private:
  std::mt19937_64 m_bits;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_RANDOM_SOURCE_H
