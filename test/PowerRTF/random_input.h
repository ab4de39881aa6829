// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Seeded random numbers, directions and points for test inputs.
#ifndef CGAL_POWER_RTF_TEST_RANDOM_INPUT_H
#define CGAL_POWER_RTF_TEST_RANDOM_INPUT_H

#include <CGAL/PowerRTF/geometry/vector.h>

#include <cstdint>
#include <random>

namespace random_input {

using CGAL::PowerRTF::Vec3d;

class Random {
  std::mt19937_64 m_engine;

public:
  explicit Random(std::uint64_t seed) : m_engine(seed) {}
  double real(double a, double b) { return std::uniform_real_distribution<double>(a, b)(m_engine); }
  int integer(int a, int b) { return std::uniform_int_distribution<int>(a, b)(m_engine); }
  Vec3d direction()
  {
    std::normal_distribution<double> d;
    Vec3d v{0, 0, 0};
    while (squared_length(v) == 0) v = {d(m_engine), d(m_engine), d(m_engine)};
    return normalized(v);
  }
  Vec3d in_box() { return {real(-1, 1), real(-1, 1), real(-1, 1)}; }
};

} // namespace random_input

#endif // CGAL_POWER_RTF_TEST_RANDOM_INPUT_H
