// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The positions of hilbert_code.h from a table, several times as fast: what has happened to the
// axes on the way to a cube has few outcomes, and with each a table has the way through the 64
// cubes of the next two levels.
#ifndef CGAL_POWER_RTF_GEOMETRY_HILBERT_TABLE_H
#define CGAL_POWER_RTF_GEOMETRY_HILBERT_TABLE_H

#include <CGAL/PowerRTF/geometry/hilbert_code.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Hilbert_table {
public:
  static const Hilbert_table& get()
  {
    static const Hilbert_table table;
    return table;
  }

  /// The same as `hilbert_index()`.
  std::uint64_t index(const Hilbert_cube& c) const
  {
    const std::uint64_t cubes = spread_bits(c.i) << 2 | spread_bits(c.j) << 1 | spread_bits(c.k);
    std::uint64_t result = 0;
    unsigned state = 0;
    for (int shift = 60; shift >= 0; shift -= 6) {
      const Step step = m_steps[state << 6 | (cubes >> shift & 63)];
      result = result << 6 | step.place;
      state = step.state;
    }
    return result;
  }

private:
  // What Skilling's loop has made of the bits below: of which axis those of each are, whether they
  // are inverted, and the parity that the end of the loop adds.
  struct State {
    std::array<int, 3> axis{0, 1, 2}, inverted{0, 0, 0};
    int parity = 0;

    bool operator==(const State& s) const
    {
      return axis == s.axis && inverted == s.inverted && parity == s.parity;
    }
    // Goes into a cube of the next level. Returns its place on the curve.
    int enter(int cube)
    {
      std::array<int, 3> x;
      for (int k = 0; k < 3; ++k) x[k] = (cube >> (2 - axis[k]) & 1) ^ inverted[k];
      for (int k = 0; k < 3; ++k) {
        if (x[k]) {
          inverted[0] ^= 1;
        } else {
          std::swap(axis[0], axis[k]);
          std::swap(inverted[0], inverted[k]);
        }
      }
      x[1] ^= x[0];
      x[2] ^= x[1];
      const int place = (x[0] ^ parity) << 2 | (x[1] ^ parity) << 1 | (x[2] ^ parity);
      parity ^= x[2];
      return place;
    }
  };
  struct Step {
    std::uint8_t place, state;
  };

  // The 21 levels are made 22 by one above, where all is in cube 0: three of these are none.
  Hilbert_table()
  {
    std::vector<State> states(1);
    for (int k = 0; k < 2; ++k) states[0].enter(0);
    std::vector<Step> single; // of one level
    for (std::size_t s = 0; s < states.size(); ++s)
      for (int cube = 0; cube < 8; ++cube) {
        State state = states[s];
        const int place = state.enter(cube);
        const auto found = std::find(states.begin(), states.end(), state);
        single.push_back({std::uint8_t(place), std::uint8_t(found - states.begin())});
        if (found == states.end()) states.push_back(state);
      }
    for (std::size_t s = 0; s < states.size(); ++s)
      for (int cubes = 0; cubes < 64; ++cubes) {
        const Step first = single[s << 3 | cubes >> 3],
                   second = single[first.state << 3 | (cubes & 7)];
        m_steps.push_back({std::uint8_t(first.place << 3 | second.place), second.state});
      }
  }

  std::vector<Step> m_steps; // by state and cube
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_GEOMETRY_HILBERT_TABLE_H
