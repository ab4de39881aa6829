// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stars of a mesh where a backend works. They stay there: of what has changed since, only the
// stars that have go up.
#ifndef CGAL_POWER_RTF_SMOOTHING_STAR_ARRAYS_H
#define CGAL_POWER_RTF_SMOOTHING_STAR_ARRAYS_H

#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/scan.h>
#include <CGAL/PowerRTF/smoothing/Star_view.h>
#include <CGAL/PowerRTF/smoothing/color_vertices.h>

#include <cstddef>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// Stars of some vertices; non-owning, as a `Star_view` of all.
struct Changed_stars {
  const int *vertices, *first, *neighbors;
  const unsigned char* kinds;
  const Vec3d *points, *normals;
  const int* facets;
  const double* heights;
};

/// Takes what has changed, but for the spokes, to its vertex.
struct Scatter_changes {
  Changed_stars changed;
  int* change_at; ///< by vertex: the number of its change
  unsigned char* kinds;
  Vec3d *points, *normals;
  int* facets;
  double* heights;

  CGAL_POWER_RTF_HD void operator()(int k) const
  {
    const int v = changed.vertices[k];
    change_at[v] = k;
    kinds[v] = changed.kinds[k];
    points[v] = changed.points[k];
    normals[v] = changed.normals[k];
    facets[v] = changed.facets[k];
    heights[v] = changed.heights[k];
  }
};

/// For all vertices, and the end.
struct Count_spokes {
  Changed_stars changed;
  int vertices;
  const int *change_at, *first; ///< as they were
  int* counts;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    const int k = v < vertices ? change_at[v] : 0;
    counts[v] = v == vertices ? 0
                : k < 0       ? first[v + 1] - first[v]
                              : changed.first[k + 1] - changed.first[k];
  }
};

struct Merge_spokes {
  Changed_stars changed;
  const int *change_at, *first, *neighbors; ///< as they were
  const int* new_first;
  int* merged;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    const int k = change_at[v];
    const int* const from = k < 0 ? neighbors + first[v] : changed.neighbors + changed.first[k];
    for (int at = new_first[v]; at < new_first[v + 1]; ++at) merged[at] = from[at - new_first[v]];
  }
};

/// The arrays of a `Star_view`, and the order of the vertices.
template <class Backend>
struct Star_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> first, neighbors, facets;
  Buffer<unsigned char> kinds;
  Buffer<Vec3d> points, normals;
  Buffer<double> heights;
  Buffer<int> order;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices, std::size_t spokes)
  {
    using A = Star_arrays;
    f(&A::first, vertices + 1);
    f(&A::neighbors, spokes);
    for (auto array : {&A::facets, &A::order}) f(array, vertices);
    f(&A::kinds, vertices);
    for (auto array : {&A::points, &A::normals}) f(array, vertices);
    f(&A::heights, vertices);
  }

  /// With what it takes to color the vertices.
  static std::size_t bytes(std::size_t vertices, std::size_t spokes)
  {
    return bytes_of_listed<Star_arrays>(vertices, spokes) +
           bytes_of_listed<Color_arrays<Backend>>(vertices);
  }

  int size() const { return static_cast<int>(points.size()); }

  Star_view view()
  {
    Star_view view;
    view.size = size();
    view.first = first.data();
    view.neighbors = neighbors.data();
    view.kinds = kinds.data();
    view.points = points.data();
    view.normals = normals.data();
    view.facets = facets.data();
    view.heights = heights.data();
    return view;
  }

  /// `stars`: all. \returns `false` where the memory does not suffice
  bool upload(Backend& backend, const Flat_stars& stars)
  {
    const std::size_t n = stars.points.size(), spokes = stars.neighbors.size();
    if (!backend.has_room(bytes(n, spokes))) return false;
    allocate_listed(backend, *this, n, spokes);
    uploaded(backend, first, stars.first.data());
    uploaded(backend, neighbors, stars.neighbors.data());
    uploaded(backend, kinds, stars.kinds.data());
    uploaded(backend, points, stars.points.data());
    uploaded(backend, normals, stars.normals.data());
    uploaded(backend, facets, stars.facets.data());
    uploaded(backend, heights, stars.heights.data());
    return true;
  }

  /// `stars`: those that have changed. \returns `false` where the memory does not suffice
  bool update(Backend& backend, const Flat_stars& stars)
  {
    const int n = size(), changes = stars.size();
    if (changes == 0) return true;
    const std::size_t spokes = neighbors.size() + stars.neighbors.size(); // at most
    if (!backend.has_room(bytes_of_listed<Changes>(changes, stars.neighbors.size()) +
                          bytes_of_listed<Merged>(n, spokes)))
      return false;
    Changes there;
    Merged merged;
    const Changed_stars changed = there.upload(backend, stars);
    allocate_listed(backend, merged, n, spokes);
    int* const change_at = order.data(); // until the next order is made
    backend.fill(change_at, -1, n);
    backend.for_each(changes, Scatter_changes{changed, change_at, kinds.data(), points.data(),
                                              normals.data(), facets.data(), heights.data()});
    backend.for_each(n + 1, Count_spokes{changed, n, change_at, first.data(), merged.first.data()});
    exclusive_scan(backend, n + 1, merged.first.data(), merged.sums.data());
    backend.for_each(n, Merge_spokes{changed, change_at, first.data(), neighbors.data(),
                                     merged.first.data(), merged.neighbors.data()});
    std::swap(first, merged.first);
    std::swap(neighbors, merged.neighbors);
    return true;
  }

private:
  /// The arrays of `Changed_stars`.
  struct Changes {
    Buffer<int> vertices, first, neighbors, facets;
    Buffer<unsigned char> kinds;
    Buffer<Vec3d> points, normals;
    Buffer<double> heights;

    template <class F>
    static void for_each_array(F&& f, std::size_t vertices, std::size_t spokes)
    {
      for (auto array : {&Changes::vertices, &Changes::facets}) f(array, vertices);
      f(&Changes::first, vertices + 1);
      f(&Changes::neighbors, spokes);
      f(&Changes::kinds, vertices);
      for (auto array : {&Changes::points, &Changes::normals}) f(array, vertices);
      f(&Changes::heights, vertices);
    }

    Changed_stars upload(Backend& backend, const Flat_stars& stars)
    {
      allocate_listed(backend, *this, stars.vertices.size(), stars.neighbors.size());
      return {uploaded(backend, vertices, stars.vertices.data()),
              uploaded(backend, first, stars.first.data()),
              uploaded(backend, neighbors, stars.neighbors.data()),
              uploaded(backend, kinds, stars.kinds.data()),
              uploaded(backend, points, stars.points.data()),
              uploaded(backend, normals, stars.normals.data()),
              uploaded(backend, facets, stars.facets.data()),
              uploaded(backend, heights, stars.heights.data())};
    }
  };

  struct Merged {
    Buffer<int> first, neighbors, sums;

    template <class F>
    static void for_each_array(F&& f, std::size_t vertices, std::size_t spokes)
    {
      f(&Merged::first, vertices + 1);
      f(&Merged::neighbors, spokes);
      f(&Merged::sums, scan_sums(static_cast<int>(vertices + 1)));
    }
  };
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_STAR_ARRAYS_H
