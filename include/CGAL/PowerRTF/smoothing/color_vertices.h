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
#include <CGAL/PowerRTF/internal/scan.h>
#include <CGAL/PowerRTF/smoothing/Colored_parts.h>
#include <CGAL/PowerRTF/smoothing/Star_view.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
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
  int round;
  int* last_wait; ///< the last round that has left a vertex without a color

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    if (!stars.is_movable(v) || colors[v] != none) return;
    for (int k = stars.first[v]; k < stars.first[v + 1]; ++k) {
      const int u = stars.neighbors[k];
      if (!stars.is_movable(u) || !is_colored_before(u, v) || atomic_load(&colors[u]) != none)
        continue;
      atomic_store(last_wait, round);
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

/// What it takes to color vertices and to list them by their colors.
template <class Backend>
struct Color_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> colors;          ///< that vertices have, or none
  Buffer<unsigned char> flags; ///< by vertex
  Buffer<int> parts, sums;     ///< where each begins, and for a scan of that
  Buffer<int> starts;          ///< of colors
  Buffer<int> last_wait;       ///< one

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices)
  {
    using A = Color_arrays;
    const int parts = Colored_parts{nullptr, static_cast<int>(vertices), 0}.size() + 1;
    f(&A::colors, vertices);
    f(&A::flags, vertices);
    f(&A::parts, std::size_t(parts));
    f(&A::sums, scan_sums(parts));
    f(&A::starts, std::size_t(Colored_parts::colors_at_once + 1));
    f(&A::last_wait, std::size_t(1));
  }
};

/// Gives all vertices that may move colors, most of which they have had.
template <class Backend>
void color_vertices(Backend& backend, const Star_view& stars, Color_arrays<Backend>& arrays)
{
  constexpr int rounds_per_look = Backend::is_host ? 1 : 4;
  int *const colors = arrays.colors.data(), *const last_wait = arrays.last_wait.data();
  backend.for_each(stars.size, Find_lost_colors{stars, colors, arrays.flags.data()});
  backend.for_each(stars.size, Drop_lost_colors{arrays.flags.data(), colors});
  backend.fill(last_wait, -1, 1);
  for (int round = 0, last = 0; last == round;) {
    for (int k = 0; k < rounds_per_look; ++k)
      backend.for_each(stars.size, Color_vertices{stars, colors, ++round, last_wait});
    backend.download(&last, last_wait, 1);
  }
}

/// Colors the vertices that may move and writes all into `order`: first those that may not, then
/// the others color by color. `arrays`: with the colors that they have, most of which they keep.
/// \returns where in the order each color begins, and the end
template <class Backend>
std::vector<int> order_by_colors(Backend& backend, const Star_view& stars,
                                 Color_arrays<Backend>& arrays, int* order)
{
  color_vertices(backend, stars, arrays);
  std::vector<int> first;
  int* const places = arrays.parts.data();
  int starts[Colored_parts::colors_at_once + 1];
  for (int color = Color_vertices::none, listed = 0; listed < stars.size;
       color += Colored_parts::colors_at_once) {
    const Colored_parts parts{arrays.colors.data(), stars.size, color};
    backend.for_each(parts.size() + 1, Count_colored{parts, places});
    exclusive_scan(backend, parts.size() + 1, places, arrays.sums.data());
    backend.for_each(parts.size(), List_colored{parts, places, order + listed});
    backend.for_each(int(std::size(starts)),
                     Take_color_starts{parts, places, arrays.starts.data()});
    backend.download(starts, arrays.starts.data(), std::size(starts));
    for (int k = 0; k < Colored_parts::colors_at_once; ++k)
      if (color + k != Color_vertices::none && listed + starts[k] < stars.size)
        first.push_back(listed + starts[k]);
    listed += starts[Colored_parts::colors_at_once];
  }
  first.push_back(stars.size);
  return first;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_COLOR_VERTICES_H
