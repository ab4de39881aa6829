// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Options of the remesher from their names and values, and other values for them.
#ifndef CGAL_POWER_RTF_TEST_FUZZ_OPTIONS_OF_H
#define CGAL_POWER_RTF_TEST_FUZZ_OPTIONS_OF_H

#include "../random_input.h"
#include "Polygons.h"

#include <CGAL/PowerRTF/option_table.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <type_traits>
#include <vector>

namespace fuzz {

using CGAL::PowerRTF::Option;
using CGAL::PowerRTF::Option_range;
using CGAL::PowerRTF::Remeshing_options;
using random_input::Random;

/// The values that are tried: all of the table's, but for those that only make a run long.
inline Option_range tried_range(const Option& option)
{
  const std::string name = option.name;
  const auto ends_with = [&](const std::string& end) {
    return name.size() >= end.size() &&
           name.compare(name.size() - end.size(), end.size(), end) == 0;
  };
  if (name == "number_of_samples") return {4, 80};
  if (name == "vertex_share") return {0, 2};
  if (ends_with("_iterations")) return {0, 10};
  if (ends_with("oversampling")) return {1, 8};
  if (name == "relative_edge_length" || name == "relative_max_distance") return {0.2, 1};
  for (const char* length : {"edge_length", "size_factor", "max_distance", "wrap_radius"})
    if (ends_with(length)) return {0, 0}; // lengths of any scale: for as many samples
  return option.range;
}

/// `number` as a value of the type of `value`; outside of its range, the range's nearer end.
template <class T>
T value_of(double number, const T&, const Option_range& range)
{
  if constexpr (std::is_enum<T>::value) {
    const auto names = value_names(T());
    return static_cast<T>(std::clamp<long>(static_cast<long>(number), 0, long(names.size()) - 1));
  } else {
    return static_cast<T>(std::clamp(number, range.lowest, range.highest));
  }
}

/// `preset` counts as an option of the table.
inline Remeshing_options options_of(const Polygons& input)
{
  Remeshing_options options;
  for (const auto& [name, number] : input.options)
    if (name == "preset" && std::isfinite(number))
      options = Remeshing_options::of(value_of(number, options.preset, {0, 0}));
  options.number_of_samples = 20;
  options.max_iterations = 4;
  options.max_weight_iterations = 4;
  options.relaxation_iterations = std::min(options.relaxation_iterations, 2);
  CGAL::PowerRTF::for_each_option([&](const Option& option, auto member) {
    for (const auto& [name, number] : input.options)
      if (name == option.name && std::abs(number) < 1e9)
        options.*member = value_of(number, options.*member, tried_range(option));
  });
  return options;
}

/// Gives one option another value, a default one as often as not.
inline void mutate_options(Polygons& input, Random& random)
{
  auto& options = input.options;
  if (!options.empty() && random.integer(0, 1)) {
    std::swap(options[random.integer(0, int(options.size()) - 1)], options.back());
    options.pop_back();
    return;
  }
  std::vector<std::pair<std::string, double>> choices{{"preset", random.integer(0, 2)}};
  CGAL::PowerRTF::for_each_option([&](const Option& option, auto) {
    const Option_range range = tried_range(option);
    double value = random.integer(0, 3); // of an enumeration, which has no range
    if (range.highest > range.lowest)
      value = random.integer(0, 3) ? random.real(range.lowest, std::min(range.highest, 200.))
                                   : (random.integer(0, 1) ? range.lowest : range.highest);
    choices.emplace_back(option.name, value);
  });
  options.push_back(choices[random.integer(0, int(choices.size()) - 1)]);
}

} // namespace fuzz

#endif // CGAL_POWER_RTF_TEST_FUZZ_OPTIONS_OF_H
