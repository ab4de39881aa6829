// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The differences between CGAL 5.5 and 6.x, in one place.
#ifndef CGAL_POWER_RTF_INTERNAL_COMPAT_H
#define CGAL_POWER_RTF_INTERNAL_COMPAT_H

#include <CGAL/version.h>

#if CGAL_VERSION_NR < 1050500000
#error "PowerRTF needs CGAL 5.5 or newer"
#endif

#if CGAL_VERSION_NR >= 1060000000
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>

#include <variant>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>

#include <boost/variant/get.hpp>
#endif

namespace CGAL::PowerRTF::internal {

#if CGAL_VERSION_NR >= 1060000000
template <class GeomTraits, class Primitive>
using AABB_traits_3 = CGAL::AABB_traits_3<GeomTraits, Primitive>;
template <class GeomTraits, class Iterator>
using AABB_triangle_primitive_3 = CGAL::AABB_triangle_primitive_3<GeomTraits, Iterator>;
/// What an intersection is, if it is a `T`; else none.
template <class T, class Variant>
const T* get_if(const Variant& intersection)
{
  return std::get_if<T>(&intersection);
}
#else
template <class GeomTraits, class Primitive>
using AABB_traits_3 = CGAL::AABB_traits<GeomTraits, Primitive>;
template <class GeomTraits, class Iterator>
using AABB_triangle_primitive_3 = CGAL::AABB_triangle_primitive<GeomTraits, Iterator>;
template <class T, class Variant>
const T* get_if(const Variant& intersection)
{
  return boost::get<T>(&intersection);
}
#endif

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_COMPAT_H
