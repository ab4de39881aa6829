// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Angles as unit complex numbers, which have means where angles have leaps.
#ifndef CGAL_POWER_RTF_SAMPLING_PHASOR_H
#define CGAL_POWER_RTF_SAMPLING_PHASOR_H

#include <CGAL/PowerRTF/internal/host_device.h>

#include <cmath>
#include <cstdint>

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

/// The nearest integer; |x| < 2^22. (Without a function call, which SSE2 needs.)
CGAL_POWER_RTF_HD inline float nearest_integer(float x)
{
  constexpr float ones = 12582912; // 1.5 * 2^23: floats from there on are integers
  return (x + ones) - ones;
}

/// The number; 0 for 2^21 and more, whose fractions a float does not have.
CGAL_POWER_RTF_HD inline float if_resolved(float turns)
{
  constexpr float most = 1 << 21;
  return turns > -most && turns < most ? turns : 0;
}

/// The phasor of a full turn times `turns`, up to 3e-5; 1 for 2^21 turns and more. (Taylor's series
/// within a quarter: much faster than the library's functions, and the same on every machine.)
CGAL_POWER_RTF_HD inline Phasor phasor_at(float turns)
{
  turns = if_resolved(turns);
  const float half_turns = nearest_integer(2 * turns);
  const float a = 6.28318531f * (turns - 0.5f * half_turns), a_2 = a * a;
  constexpr float by_6 = 1 / 6.f, by_20 = 1 / 20.f, by_42 = 1 / 42.f, by_72 = 1 / 72.f;
  constexpr float by_2 = 1 / 2.f, by_12 = 1 / 12.f, by_30 = 1 / 30.f, by_56 = 1 / 56.f;
  const float sine =
      a * (1 - a_2 * by_6 * (1 - a_2 * by_20 * (1 - a_2 * by_42 * (1 - a_2 * by_72))));
  const float cosine = 1 - a_2 * by_2 * (1 - a_2 * by_12 * (1 - a_2 * by_30 * (1 - a_2 * by_56)));
  const float sign = float(1 - 2 * (int(half_turns) & 1));
  return {sign * cosine, sign * sine};
}

/// A phasor of length 1 in half the memory, up to 2e-5. Products may be a little longer.
struct Short_phasor {
  std::int16_t x = 0, y = 0;

  static constexpr float unit = 32767;

  Short_phasor() = default;
  CGAL_POWER_RTF_HD Short_phasor(Phasor a) : x(shortened(a.x)), y(shortened(a.y)) {}
  CGAL_POWER_RTF_HD operator Phasor() const
  {
    constexpr float by_unit = 1 / unit;
    return {by_unit * float(x), by_unit * float(y)};
  }

private:
  CGAL_POWER_RTF_HD static std::int16_t shortened(float part)
  {
    const float number = nearest_integer(unit * part);
    return static_cast<std::int16_t>(number > unit ? unit : number < -unit ? -unit : number);
  }
};

/// The tangent of a quarter of the angle of a phasor of length 1: from -1 to 1.
CGAL_POWER_RTF_HD inline float quarter_tangent(Phasor a)
{
  // Half the angle first: of the two parts, the larger one without a difference.
  const float x = a.x < -1 ? -1.f : a.x > 1 ? 1.f : a.x, size = x < 0 ? -x : x;
  const float larger = std::sqrt(0.5f * (1 + size)), smaller = 0.5f * a.y / larger;
  const float sine = x < 0 ? (a.y < 0 ? -larger : larger) : smaller;
  const float cosine = x < 0 ? (a.y < 0 ? -smaller : smaller) : larger;
  return sine / (1 + cosine);
}

/// The same of the phasor of a full turn times `turns`. (Lambert's continued fraction.)
CGAL_POWER_RTF_HD inline float quarter_tangent_at(float turns)
{
  turns = if_resolved(turns);
  const float a = 1.57079633f * (turns - nearest_integer(turns)), a_2 = a * a;
  return a * (945 + a_2 * (a_2 - 105)) / (945 + a_2 * (15 * a_2 - 420));
}

/// The phasor with this `quarter_tangent()`. (Without functions, in fewer steps than
/// `phasor_at()`.)
CGAL_POWER_RTF_HD inline Phasor phasor_of_quarter(float t)
{
  const float by = 1 / (1 + t * t);
  const float cosine = (1 - t * t) * by, sine = 2 * t * by;
  return {cosine * cosine - sine * sine, 2 * sine * cosine};
}

/// A phasor of length 1 in a quarter of the memory, up to 1e-4.
class Short_turn {
public:
  Short_turn() = default;
  CGAL_POWER_RTF_HD explicit Short_turn(float turns)
      : m_tangent(static_cast<std::int16_t>(nearest_integer(one * quarter_tangent_at(turns))))
  {}
  CGAL_POWER_RTF_HD operator Phasor() const
  {
    constexpr float by_one = 1 / one;
    return phasor_of_quarter(by_one * float(m_tangent));
  }

private:
  static constexpr float one = 32767;
  std::int16_t m_tangent = 0; // of a quarter of the angle
};

/// The angle in turns, from -1/2 to 1/2.
CGAL_POWER_RTF_HD inline float turns_of(Phasor a) { return std::atan2(a.y, a.x) * 0.159154943f; }

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_PHASOR_H
