// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The named parameters that CGAL does not have. CGAL's list of chainable parameters is closed, so
// these start a chain, and CGAL's follow:
// `PowerRTF::parameters::density_map(m).remeshing_options(o).random_seed(3)`.
#ifndef CGAL_POWER_RTF_NAMED_PARAMETERS_H
#define CGAL_POWER_RTF_NAMED_PARAMETERS_H

#include <CGAL/PowerRTF/Remeshing_options.h>

#include <CGAL/Named_function_parameters.h>

namespace CGAL
{
namespace PowerRTF
{

namespace internal
{

enum density_map_t { density_map };
enum remeshing_options_t { remeshing_options };
enum repair_t { repair };

/// A chain of named parameters that also goes on with our own.
template <class T, class Tag, class Base = internal_np::No_property>
struct Named_parameters : Named_function_parameters<T, Tag, Base> {
  using Named_function_parameters<T, Tag, Base>::Named_function_parameters;

  template <class DensityMap>
  Named_parameters<DensityMap, density_map_t, Named_parameters>
  density_map(const DensityMap& map) const
  {
    return {map, *this};
  }

  Named_parameters<Remeshing_options, remeshing_options_t, Named_parameters>
  remeshing_options(const Remeshing_options& options) const
  {
    return {options, *this};
  }

  Named_parameters<bool, repair_t, Named_parameters> repair(bool wanted) const
  {
    return {wanted, *this};
  }
};

} // namespace internal

/// CGAL's named parameters, and those of this package.
namespace parameters
{

using namespace CGAL::parameters;

/// The user's own density: a readable property map from the input's vertices to numbers > 0.
template <class DensityMap>
internal::Named_parameters<DensityMap, internal::density_map_t> density_map(const DensityMap& map)
{
  return {map};
}

/// All parameters of the method, see `Remeshing_options`.
inline internal::Named_parameters<Remeshing_options, internal::remeshing_options_t>
remeshing_options(const Remeshing_options& options)
{
  return {options};
}

/// Whether an input that is no 2-manifold is made one (default) or refused.
inline internal::Named_parameters<bool, internal::repair_t> repair(bool wanted)
{
  return {wanted};
}

} // namespace parameters
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_NAMED_PARAMETERS_H
