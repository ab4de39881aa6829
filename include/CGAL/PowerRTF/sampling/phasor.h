// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Angles as unit complex numbers, which have means where angles have leaps.
#ifndef CGAL_POWER_RTF_SAMPLING_PHASOR_H
#define CGAL_POWER_RTF_SAMPLING_PHASOR_H

#include <CGAL/PowerRTF/internal/host_device.h>

#include <cmath>

namespace CGAL::PowerRTF {

/// A complex number; 0: nothing is known.
struct Phasor {
  float x = 0, y = 0;

  CGAL_POWER_RTF_HD friend Phasor operator+(Phasor a, Phasor b) { return {a.x + b.x, a.y + b.y}; }
  CGAL_POWER_RTF_HD friend Phasor operator*(Phasor a, Phasor b)
  {
    return {a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
  }
};

CGAL_POWER_RTF_HD inline Phasor conjugate(Phasor a) { return {a.x, -a.y}; }

/// The phasor of the same angle with length 1; 0 of 0.
CGAL_POWER_RTF_HD inline Phasor unit(Phasor a)
{
  const float squared = a.x * a.x + a.y * a.y;
  const float factor = squared > 1e-20f ? 1 / std::sqrt(squared) : 0.f;
  return {factor * a.x, factor * a.y};
}

CGAL_POWER_RTF_HD inline Phasor sixth_power(Phasor a)
{
  const Phasor cube = a * a * a;
  return cube * cube;
}

/// The phasor of a full turn times `turns`, up to 3e-5. (Taylor's series within a quarter: much
/// faster than the library's functions, and the same on every machine.)
CGAL_POWER_RTF_HD inline Phasor phasor_at(float turns)
{
  const float half_turns = std::floor(2 * turns + 0.5f); // the nearest number of them
  const float a = 6.28318531f * (turns - 0.5f * half_turns), a_2 = a * a;
  const float sine = a * (1 - a_2 / 6 * (1 - a_2 / 20 * (1 - a_2 / 42 * (1 - a_2 / 72))));
  const float cosine = 1 - a_2 / 2 * (1 - a_2 / 12 * (1 - a_2 / 30 * (1 - a_2 / 56)));
  const bool is_odd = half_turns != 2 * std::floor(0.5f * half_turns);
  return is_odd ? Phasor{-cosine, -sine} : Phasor{cosine, sine};
}

/// The angle in turns, from -1/2 to 1/2.
CGAL_POWER_RTF_HD inline float turns_of(Phasor a) { return std::atan2(a.y, a.x) * 0.159154943f; }

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_PHASOR_H
