// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Colors of the vertices of a mesh that may move, such that neighbors differ: those of one color
// may move at once. Each takes the first color that is free as soon as all neighbors before it have
// theirs, in an order that a hash shuffles: few wait long, and the colors are the same for any
// number of threads. (Jones and Plassmann, "A parallel graph coloring heuristic", 1993.)
#ifndef CGAL_POWER_RTF_SMOOTHING_COLOR_VERTICES_H
#define CGAL_POWER_RTF_SMOOTHING_COLOR_VERTICES_H

#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/smoothing/Star_view.h>

#include <cstdint>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Whether a vertex comes before another one, with which it is not equal.
CGAL_POWER_RTF_HD inline bool is_colored_before(int u, int v)
{
  constexpr std::uint32_t golden = 2654435769u; // 2^32 over the golden ratio (Knuth's hash)
  return golden * std::uint32_t(u) < golden * std::uint32_t(v);
}

/// Which vertices lose the color that they had: of two neighbors with the same one the second.
struct Find_lost_colors {
  Star_view stars;
  const int* colors;
  unsigned char* is_lost;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    bool is_taken = !stars.is_movable(v);
    for (int k = stars.first[v]; k < stars.first[v + 1]; ++k) {
      const int u = stars.neighbors[k];
      is_taken = is_taken || (colors[u] == colors[v] && is_colored_before(u, v));
    }
    is_lost[v] = is_taken;
  }
};

struct Color_vertices {
  static constexpr int none = -1;

  Star_view stars;
  int* colors;
  int* is_waiting; ///< whether a vertex is left without a color

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    if (!stars.is_movable(v) || colors[v] != none) return;
    for (int k = stars.first[v]; k < stars.first[v + 1]; ++k) {
      const int u = stars.neighbors[k];
      if (!stars.is_movable(u) || !is_colored_before(u, v) || atomic_load(&colors[u]) != none)
        continue;
      atomic_store(is_waiting, 1);
      return;
    }
    int color = 0; // the neighbors that come later have none, or have kept theirs
    while (is_at_neighbor(v, color)) ++color;
    atomic_store(&colors[v], color);
  }

private:
  CGAL_POWER_RTF_HD bool is_at_neighbor(int v, int color) const
  {
    for (int k = stars.first[v]; k < stars.first[v + 1]; ++k)
      if (atomic_load(&colors[stars.neighbors[k]]) == color) return true;
    return false;
  }
};

struct Drop_lost_colors {
  const unsigned char* is_lost;
  int* colors;
  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    if (is_lost[v]) colors[v] = Color_vertices::none;
  }
};

struct Has_color {
  const int* colors;
  int color;
  unsigned char* result;
  CGAL_POWER_RTF_HD void operator()(int v) const { result[v] = colors[v] == color; }
};

/// Writes the vertices that may move into `order`, color by color. `colors`: those that they have,
/// or none, by vertex; most keep them. `flag`, `flags`: room for one, and one by vertex.
/// \returns where in the order each color begins, and the end
template <class Backend>
std::vector<int> order_by_colors(Backend& backend, const Star_view& stars, int* colors, int* flag,
                                 unsigned char* flags, int* order)
{
  backend.for_each(stars.size, Find_lost_colors{stars, colors, flags});
  backend.for_each(stars.size, Drop_lost_colors{flags, colors});
  for (int is_waiting = 1; is_waiting;) {
    backend.fill(flag, 0, 1);
    backend.for_each(stars.size, Color_vertices{stars, colors, flag});
    backend.download(&is_waiting, flag, 1);
  }
  const auto count = [&](int color, int* vertices) {
    backend.for_each(stars.size, Has_color{colors, color, flags});
    return backend.select(stars.size, flags, vertices);
  };
  const int movable = stars.size - count(Color_vertices::none, order);
  std::vector<int> first{0};
  for (int color = 0; first.back() < movable; ++color)
    first.push_back(first.back() + count(color, order + first.back()));
  return first;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_COLOR_VERTICES_H
