// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's table of options for Python, and Python's values of them.
#ifndef POWER_RTF_PYTHON_OPTIONS_H
#define POWER_RTF_PYTHON_OPTIONS_H

#include <CGAL/PowerRTF/option_table.h>

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <string>
#include <type_traits>

namespace powerrtf {

namespace nb = nanobind;

/// Enumerations of `no` and `yes` are Python's `bool`.
template <class T>
constexpr bool is_switch()
{
  using namespace CGAL::PowerRTF;
  return std::is_same<T, bool>::value || std::is_same<T, Improvement>::value ||
         std::is_same<T, Repair>::value;
}

/// The option's name for users: the member's, or a shorter one.
inline std::string python_name(const CGAL::PowerRTF::Option& option)
{
  const std::string name = option.name;
  return name == "number_of_samples" ? "n" : name == "random_seed" ? "seed" : name;
}

template <class T>
nb::object to_python(const T& value)
{
  if constexpr (is_switch<T>())
    return nb::cast(bool(value));
  else if constexpr (std::is_enum<T>::value)
    return nb::cast(CGAL::PowerRTF::name_of(value));
  else
    return nb::cast(value);
}

/// A row for each option: name, default, those of the presets `fast` and `paper`, meaning, allowed
/// values.
inline nb::list option_rows()
{
  using namespace CGAL::PowerRTF;
  nb::list rows;
  const Remeshing_options quality, fast = Remeshing_options::fast_preset(),
                                   paper = Remeshing_options::paper_preset();
  for_each_option([&](const Option& option, auto member) {
    using T = std::decay_t<decltype(quality.*member)>;
    rows.append(nb::make_tuple(python_name(option), to_python(quality.*member),
                               to_python(fast.*member), to_python(paper.*member), option.meaning,
                               is_switch<T>() ? "True or False" : allowed_values<T>(option.range)));
  });
  return rows;
}

/// \throws Invalid_input_error `value` cannot be the option's
template <class T>
T from_python(const CGAL::PowerRTF::Option& option, nb::handle value)
{
  using namespace CGAL::PowerRTF;
  if constexpr (std::is_enum<T>::value && !is_switch<T>()) {
    const Value_names names = value_names(T());
    for (std::size_t i = 0; i < names.size(); ++i)
      if (nb::isinstance<nb::str>(value) && nb::cast<std::string>(value) == names[i])
        return static_cast<T>(i);
  } else {
    using Number = std::conditional_t<is_switch<T>(), bool, T>;
    Number number;
    if (nb::try_cast<Number>(value, number) && (is_switch<T>() || is_allowed(number, option.range)))
      return static_cast<T>(number);
  }
  throw Invalid_input_error(python_name(option) + " is " + nb::repr(value).c_str() +
                            ", but must be " +
                            (is_switch<T>() ? "True or False" : allowed_values<T>(option.range)));
}

/// The options that a dictionary names; the others are those of its entry `preset`.
/// \throws Invalid_input_error names the option as users do
inline CGAL::PowerRTF::Remeshing_options options_of(const nb::dict& values)
{
  using namespace CGAL::PowerRTF;
  Remeshing_options options;
  const Option preset{"", "preset", "", "", {}};
  if (values.contains("preset"))
    options = Remeshing_options::of(from_python<Preset>(preset, values["preset"]));
  for_each_option([&](const Option& option, auto member) {
    const std::string name = python_name(option);
    if (values.contains(name.c_str()))
      options.*member =
          from_python<std::decay_t<decltype(options.*member)>>(option, values[name.c_str()]);
  });
  return options;
}

} // namespace powerrtf

#endif // POWER_RTF_PYTHON_OPTIONS_H
