// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_IMPROVEMENT_COLOR_ORDER_H
#define CGAL_POWER_RTF_IMPROVEMENT_COLOR_ORDER_H

#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/color_vertices.h>

#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// The vertices of stars: those that may not move, then the others, color by color.
struct Color_order {
  Unset_vector<int> vertices;
  std::vector<int> first; ///< of each color, and the end
};

template <class Backend>
Color_order color_order_by(Backend&& backend, const Flat_stars& stars, std::vector<int>& colors)
{
  Color_order order;
  order.vertices.resize(stars.points.size());
  Star_view view;
  view.size = stars.size();
  view.first = stars.first.data();
  view.neighbors = stars.neighbors.data();
  view.kinds = stars.kinds.data();
  Color_arrays<std::decay_t<Backend>> arrays;
  allocate_listed(backend, arrays, colors.size());
  uploaded(backend, arrays.colors, colors.data());
  order.first = order_by_colors(backend, view, arrays, order.vertices.data());
  backend.download(colors.data(), arrays.colors.data(), colors.size());
  return order;
}

/// `colors`: that the vertices have, or none; most keep theirs.
inline Color_order color_order(const Flat_stars& stars, std::vector<int>& colors,
                               Concurrency concurrency)
{
  return with_host_backend(concurrency,
                           [&](auto&& backend) { return color_order_by(backend, stars, colors); });
}

/// The same where none has a color yet.
inline Color_order color_order(const Flat_stars& stars, Concurrency concurrency)
{
  std::vector<int> colors(stars.points.size(), Color_vertices::none);
  return color_order(stars, colors, concurrency);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_COLOR_ORDER_H
