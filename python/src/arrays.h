// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Python's arrays as the library's, and back.
#ifndef POWER_RTF_PYTHON_ARRAYS_H
#define POWER_RTF_PYTHON_ARRAYS_H

#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/input/Polygon_soup.h>

#include <nanobind/ndarray.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace powerrtf {

namespace nb = nanobind;
using CGAL::PowerRTF::Edge;
using CGAL::PowerRTF::Polygon_soup;
using CGAL::PowerRTF::Vec3d;

/// Of float or double, with any strides; the shape has been checked.
using Real_array = nb::ndarray<nb::ro, nb::device::cpu>;
/// Likewise, of 32 or 64 bit.
using Index_array = nb::ndarray<nb::ro, nb::device::cpu>;

/// Calls `visit(i, value)` for all entries, in the order of rows.
template <class Number, class Visit>
void for_each_entry(const nb::ndarray<nb::ro, nb::device::cpu>& array, const Visit& visit)
{
  const auto* data = static_cast<const Number*>(array.data());
  const std::size_t columns = array.ndim() > 1 ? array.shape(1) : 1;
  const std::int64_t along = array.ndim() > 1 ? array.stride(1) : 0;
  for (std::size_t r = 0; r < array.shape(0); ++r)
    for (std::size_t c = 0; c < columns; ++c)
      visit(r * columns + c, data[std::int64_t(r) * array.stride(0) + std::int64_t(c) * along]);
}

template <class Visit>
void for_each_real(const Real_array& array, const Visit& visit)
{
  array.dtype() == nb::dtype<float>() ? for_each_entry<float>(array, visit)
                                      : for_each_entry<double>(array, visit);
}

template <class Visit>
void for_each_index(const Index_array& array, const Visit& visit)
{
  array.dtype() == nb::dtype<std::int32_t>() ? for_each_entry<std::int32_t>(array, visit)
                                             : for_each_entry<std::int64_t>(array, visit);
}

inline std::vector<Vec3d> points_of_array(const Real_array& array)
{
  std::vector<Vec3d> points(array.shape(0));
  for_each_real(array, [&](std::size_t i, double x) {
    Vec3d& p = points[i / 3];
    (i % 3 == 0 ? p.x : i % 3 == 1 ? p.y : p.z) = x;
  });
  return points;
}

/// \param faces a row for each polygon; or all corners, and `sizes` the numbers of them
/// \throws Invalid_input_error an index is out of range
inline Polygon_soup soup_of_arrays(const Real_array& points, const Index_array& faces,
                                   const std::optional<Index_array>& sizes)
{
  Polygon_soup soup;
  soup.merges_vertices = true;
  soup.points = points_of_array(points);
  std::vector<std::size_t> all_sizes;
  if (sizes)
    for_each_index(*sizes, [&](std::size_t, auto size) { all_sizes.push_back(size); });
  else
    all_sizes.assign(faces.shape(0), faces.shape(1));
  soup.reserve_polygons(all_sizes.size());
  std::size_t polygon = 0, corners = 0;
  const auto end_full_polygons = [&] {
    for (; polygon < all_sizes.size() && corners == all_sizes[polygon]; ++polygon, corners = 0)
      soup.end_polygon();
  };
  end_full_polygons();
  for_each_index(faces, [&](std::size_t, auto v) {
    soup.add_corner(v);
    ++corners;
    end_full_polygons();
  });
  return soup;
}

inline std::vector<CGAL::PowerRTF::Triangle> triangles_of_array(const Index_array& array)
{
  std::vector<CGAL::PowerRTF::Triangle> triangles(array.shape(0));
  for_each_index(array, [&](std::size_t i, auto v) { triangles[i / 3][i % 3] = int(v); });
  return triangles;
}

/// \throws Invalid_input_error an edge refers to no point
inline std::vector<Edge> edges_of_array(const Index_array& array, const Polygon_soup& soup)
{
  std::vector<Edge> edges(array.shape(0));
  for_each_index(array, [&](std::size_t i, auto v) {
    if (v < 0 || std::size_t(v) >= soup.points.size())
      throw CGAL::PowerRTF::Invalid_input_error(
          "constrained edge " + std::to_string(i / 2) + " refers to vertex " + std::to_string(v) +
          ", but there are only " + std::to_string(soup.points.size()) + " (numbered from 0)");
    edges[i / 2][i % 2] = static_cast<int>(v);
  });
  return edges;
}

inline std::vector<double> numbers_of_array(const Real_array& array)
{
  std::vector<double> numbers(array.shape(0));
  for_each_real(array, [&](std::size_t i, double x) { numbers[i] = x; });
  return numbers;
}

/// A NumPy array of `Number` that owns the entries, or their rounded copies.
template <class Number, class Row>
nb::object to_array(std::vector<Row>&& rows)
{
  constexpr bool is_real = std::is_same<Row, Vec3d>::value || std::is_same<Row, double>::value;
  using Entry = std::conditional_t<is_real, double, int>;
  constexpr std::size_t columns = sizeof(Row) / sizeof(Entry);
  static_assert(columns * sizeof(Entry) == sizeof(Row), "rows are packed");
  const std::size_t shape[] = {rows.size(), columns};
  const std::size_t dimensions = columns > 1 ? 2 : 1;
  const auto owned = [&](auto&& entries) {
    using Entries = std::decay_t<decltype(entries)>;
    auto kept = std::make_unique<Entries>(std::move(entries));
    void* const data = kept->data();
    nb::capsule owner(kept.release(), [](void* p) noexcept { delete static_cast<Entries*>(p); });
    return nb::cast(nb::ndarray<nb::numpy, Number>(data, dimensions, shape, owner));
  };
  if constexpr (std::is_same<Number, Entry>::value) {
    return owned(std::move(rows));
  } else {
    const auto* const entries = reinterpret_cast<const Entry*>(rows.data());
    return owned(std::vector<Number>(entries, entries + rows.size() * columns));
  }
}

} // namespace powerrtf

#endif // POWER_RTF_PYTHON_ARRAYS_H
