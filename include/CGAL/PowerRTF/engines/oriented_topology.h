// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The topology of triangles that are an oriented 2-manifold, as nearly all results are, counted
// where a backend works: what is at a vertex tells all of it, so no list of edges is needed.
#ifndef CGAL_POWER_RTF_ENGINES_ORIENTED_TOPOLOGY_H
#define CGAL_POWER_RTF_ENGINES_ORIENTED_TOPOLOGY_H

#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/Vertex_fan.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/label_trees.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>
#include <optional>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// The corners of triangles by vertex, in any order.
struct Corner_lists {
  static constexpr int most = 16; ///< that have room where the lists have no bounds of their own

  const int* first;  ///< where the list of each vertex begins; null: `most` times as far as it is
  const int* degree; ///< of each vertex, if there are no bounds: it may be more than `most`
  const int* corners;

  CGAL_POWER_RTF_HD int size(int v) const { return first ? first[v + 1] - first[v] : degree[v]; }
  CGAL_POWER_RTF_HD bool is_full(int v) const { return !first && degree[v] > most; }
  CGAL_POWER_RTF_HD const int* operator[](int v) const
  {
    return corners + (first ? std::size_t(first[v]) : std::size_t(most) * v);
  }
};

struct List_corner {
  const int* vertices;
  int *degree, *corners;

  CGAL_POWER_RTF_HD void operator()(int c) const
  {
    const int v = vertices[c], place = atomic_add(degree + v, 1);
    if (place < Corner_lists::most) corners[std::size_t(Corner_lists::most) * v + place] = c;
  }
};

struct Set_to_own_number {
  int* label;
  CGAL_POWER_RTF_HD void operator()(int v) const { label[v] = v; }
};

/// Writes the opposites of the halfedges that leave a vertex with `n` corners; -1: on the border.
CGAL_POWER_RTF_HD inline void write_opposites(const Vertex_fan& fan, const int* corners, int n,
                                              int* opposite)
{
  if (fan.border() >= 0) opposite[corners[fan.border()]] = -1;
  for (int k = 0; k < n; ++k)
    if (fan.after(k) >= 0) opposite[corners[fan.after(k)]] = previous_halfedge(corners[k]);
}

/// Joins a vertex to its neighbors, and counts those whose triangles are not as they should be.
struct Join_fan {
  const int* vertices;
  Corner_lists lists;
  int* component;              ///< label trees
  int* next_on_border;         ///< -1: it is not on a border
  int *opposite, *last_corner; ///< as of `Triangle_links`; or null

  CGAL_POWER_RTF_HD void operator()(int v, Totals<1, 0>& defects) const
  {
    next_on_border[v] = -1;
    if (last_corner) last_corner[v] = -1;
    const int n = lists.size(v);
    if (n == 0) return;
    if (lists.is_full(v)) return defects.add(0, 1);
    const Vertex_fan fan(vertices, v, lists[v], n);
    if (!fan.is_single()) return defects.add(0, 1);
    for (int k = 0; k < n; ++k) // each edge once
      if (fan.next(k) < v || k == fan.border()) join_trees(component, v, fan.next(k));
    if (fan.border() >= 0) next_on_border[v] = fan.next(fan.border());
    if (opposite) write_links(fan, v, n);
  }

private:
  CGAL_POWER_RTF_HD void write_links(const Vertex_fan& fan, int v, int n) const
  {
    const int* const corners = lists[v];
    write_opposites(fan, corners, n, opposite);
    int last = -1;
    for (int k = 0; k < n; ++k) last = corners[k] > last ? corners[k] : last;
    last_corner[v] = last;
  }
};

/// Counts vertices with triangles, components and edges on borders.
struct Count_parts {
  Corner_lists lists;
  const int *component, *next_on_border;

  CGAL_POWER_RTF_HD void operator()(int v, Totals<3, 0>& counts) const
  {
    if (lists.size(v) == 0) return;
    counts.add(0, 1);
    counts.add(1, component[v] == v);
    counts.add(2, next_on_border[v] >= 0);
  }
};

struct Join_on_border {
  const int* next_on_border;
  int* loop; ///< label trees

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    if (next_on_border[v] >= 0) join_trees(loop, v, next_on_border[v]);
  }
};

struct Count_loops {
  const int *next_on_border, *loop;

  CGAL_POWER_RTF_HD void operator()(int v, Totals<1, 0>& count) const
  {
    count.add(0, next_on_border[v] >= 0 && loop[v] == v);
  }
};

template <class Backend>
struct Topology_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> degree, corners;           // where the backend has no lists of the host's
  Buffer<int> opposite, last_corner;     // the same of links
  Buffer<int> component, next_on_border; // `component` is that of borders, too, in the end
  Buffer<double> sums;

  /// See listed_arrays.h. `n`: triangles.
  template <class F>
  static void for_each_array(F&& f, std::size_t vertices, std::size_t n, bool has_links)
  {
    using A = Topology_arrays;
    if (!Backend::is_host) {
      f(&A::degree, vertices);
      f(&A::corners, Corner_lists::most * vertices);
      if (has_links) f(&A::opposite, 3 * n);
      if (has_links) f(&A::last_corner, vertices);
    }
    for (auto array : {&A::component, &A::next_on_border}) f(array, vertices);
    f(&A::sums, std::size_t(4));
  }
};

/// The arrays of `Triangle_links` where a backend works; or none.
template <class Backend>
struct Link_buffers {
  typename Backend::template Buffer<int> opposite, last_corner;

  bool are_known() const { return opposite.size() > 0; }
};

/// As `Resident_mesh::topology()`, of `n` triangles that are where the backend works: none, too,
/// where the memory does not suffice or a vertex has very many triangles. `links_there`: get those
/// of `links` where the backend works, if that is not on the host; or null.
template <class Backend>
std::optional<Topology_statistics>
oriented_topology(Backend& backend, int vertices, int n, const int* corners,
                  Triangle_links* links = nullptr, Link_buffers<Backend>* links_there = nullptr)
{
  using Arrays = Topology_arrays<Backend>;
  if (!backend.has_room(bytes_of_listed<Arrays>(vertices, n, links != nullptr)))
    return std::nullopt;
  Arrays a;
  allocate_listed(backend, a, std::size_t(vertices), std::size_t(n), links != nullptr);
  int *opposite = a.opposite.data(), *last_corner = a.last_corner.data();
  Triangle_links found;
  if (links) {
    found.opposite.resize(3 * std::size_t(n));
    found.last_corner.resize(vertices);
    if (Backend::is_host) opposite = found.opposite.data(), last_corner = found.last_corner.data();
  }
  Corner_lists lists{nullptr, a.degree.data(), a.corners.data()};
  Buckets<int> buckets;
  if constexpr (Backend::is_host) {
    buckets = {Backend::concurrency(), 3 * n, std::size_t(vertices),
               [=](int c) { return corners[c]; }, [](int c) { return c; }};
    lists = {buckets.first.data(), nullptr, buckets.entries.data()};
  } else {
    backend.fill(a.degree.data(), 0, vertices);
    backend.for_each(3 * n, List_corner{corners, a.degree.data(), a.corners.data()});
  }
  int *const component = a.component.data(), *const next = a.next_on_border.data();
  double* const sums = a.sums.data();
  backend.for_each(vertices, Set_to_own_number{component});
  backend.template reduce<1, 0>(vertices,
                                Join_fan{corners, lists, component, next, opposite, last_corner},
                                Keep_totals{sums});
  backend.template reduce<3, 0>(vertices, Count_parts{lists, component, next},
                                Keep_totals{sums + 1});
  double counts[4];
  backend.download(counts, sums, 4);
  if (counts[0] > 0) return std::nullopt;
  if (links) {
    if (!Backend::is_host) {
      backend.download(found.opposite.data(), opposite, found.opposite.size());
      backend.download(found.last_corner.data(), last_corner, found.last_corner.size());
    }
    *links = std::move(found);
    if (links_there) *links_there = {std::move(a.opposite), std::move(a.last_corner)};
  }
  Topology_statistics result;
  result.faces = n;
  result.vertices = static_cast<std::size_t>(counts[1]);
  result.components = static_cast<std::size_t>(counts[2]);
  result.border_edges = static_cast<std::size_t>(counts[3]);
  result.edges = (3 * result.faces + result.border_edges) / 2;
  result.euler_characteristic = static_cast<long>(result.vertices) -
                                static_cast<long>(result.edges) + static_cast<long>(result.faces);
  if (result.border_edges == 0) return result;
  backend.for_each(vertices, Set_to_own_number{component});
  backend.for_each(vertices, Join_on_border{next, component});
  backend.template reduce<1, 0>(vertices, Count_loops{next, component}, Keep_totals{sums});
  backend.download(counts, sums, 1);
  result.border_loops = static_cast<std::size_t>(counts[0]);
  return result;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_ORIENTED_TOPOLOGY_H
