// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers for the faces and edges of a mesh of which its stars alone are known, where a backend
// works: those that have a vertex that may move. The first of a face's or an edge's vertices that
// may has its spoke there count it.
#ifndef CGAL_POWER_RTF_SMOOTHING_STAR_FACES_H
#define CGAL_POWER_RTF_SMOOTHING_STAR_FACES_H

#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/scan.h>
#include <CGAL/PowerRTF/smoothing/Fit_equations.h>
#include <CGAL/PowerRTF/smoothing/Star_view.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// Which spokes count what.
struct Counting_spokes {
  Star_view stars;

  /// That of the face (a, b, c), counter-clockwise; -1: none of these may move.
  CGAL_POWER_RTF_HD int of_face(int a, int b, int c) const
  {
    const int v = first_of(first_of(a, b), c);
    if (v < 0) return -1;
    return spoke(v, v == a ? c : v == b ? a : b);
  }
  /// That of the edge between a and b, one of which may move.
  CGAL_POWER_RTF_HD int of_edge(int a, int b) const
  {
    const int v = first_of(a, b);
    return spoke(v, v == a ? b : a);
  }
  /// That of the face at spoke k of v: between it and the next one.
  CGAL_POWER_RTF_HD int of_face_at(int v, int k) const
  {
    return of_face(v, stars.neighbors[stars.next_spoke(v, k)], stars.neighbors[k]);
  }

private:
  CGAL_POWER_RTF_HD bool may_move(int v) const { return v >= 0 && stars.is_movable(v); }
  CGAL_POWER_RTF_HD int first_of(int a, int b) const
  {
    if (!may_move(a) || !may_move(b)) return may_move(a) ? a : may_move(b) ? b : -1;
    return a < b ? a : b;
  }
  /// The spoke of v that leads to u, a neighbor.
  CGAL_POWER_RTF_HD int spoke(int v, int u) const
  {
    int k = stars.first[v];
    while (stars.neighbors[k] != u) ++k;
    return k;
  }
};

struct Mark_counting_spokes {
  Counting_spokes spokes;
  int *of_faces, *of_edges; ///< by spoke: whether it counts one

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    const Star_view& stars = spokes.stars;
    for (int k = stars.first[v]; k < stars.first[v + 1]; ++k) {
      of_faces[k] = spokes.of_face_at(v, k) == k;
      of_edges[k] = spokes.of_edge(v, stars.neighbors[k]) == k;
    }
  }
};

struct Number_faces {
  Counting_spokes spokes;
  const int *faces, *edges; ///< by spoke: the numbers of those that it counts
  int *spoke_faces, *spoke_edges;
  int* corners; ///< three per face
  Mesh_edge* numbered_edges;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    const Star_view& stars = spokes.stars;
    const int begin = stars.first[v], end = stars.first[v + 1];
    for (int k = begin; k < end; ++k) {
      const int u = stars.neighbors[k], face = spokes.of_face_at(v, k), edge = spokes.of_edge(v, u);
      const int f = spoke_faces[k] = faces[face];
      const int e = spoke_edges[k] = edges[edge];
      if (face == k) {
        int* const t = corners + 3 * std::size_t(f);
        t[0] = v, t[1] = stars.neighbors[stars.next_spoke(v, k)], t[2] = u;
      }
      if (edge == k)
        numbered_edges[e] = {u, v, f, faces[spokes.of_face_at(v, k > begin ? k - 1 : end - 1)]};
    }
  }
};

/// Faces and edges by number, and the numbers of those at each spoke.
template <class Backend>
struct Star_faces {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> spoke_faces, spoke_edges, corners;
  Buffer<Mesh_edge> edges;

  int number_of_faces() const { return static_cast<int>(corners.size() / 3); }
  int number_of_edges() const { return static_cast<int>(edges.size()); }

  /// `spokes`: those of all stars. \returns `false` where the memory does not suffice
  bool make(Backend& backend, const Star_view& stars, int spokes)
  {
    if (!backend.has_room(bytes_of_listed<Counts>(spokes))) return false;
    Counts counts;
    allocate_listed(backend, counts, spokes);
    int* const numbers[2] = {counts.faces.data(), counts.edges.data()};
    int totals[2];
    backend.for_each(stars.size, Mark_counting_spokes{{stars}, numbers[0], numbers[1]});
    for (int k = 0; k < 2; ++k) {
      backend.fill(numbers[k] + spokes, 0, 1);
      exclusive_scan(backend, spokes + 1, numbers[k], counts.sums.data());
      backend.download(totals + k, numbers[k] + spokes, 1);
    }
    const std::size_t faces = totals[0];
    if (!backend.has_room(bytes_of_listed<Star_faces>(spokes, faces, totals[1]))) return false;
    allocate_listed(backend, *this, spokes, faces, totals[1]);
    backend.for_each(stars.size, Number_faces{{stars},
                                              numbers[0],
                                              numbers[1],
                                              spoke_faces.data(),
                                              spoke_edges.data(),
                                              corners.data(),
                                              edges.data()});
    return true;
  }

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t spokes, std::size_t faces, std::size_t edges)
  {
    for (auto array : {&Star_faces::spoke_faces, &Star_faces::spoke_edges}) f(array, spokes);
    f(&Star_faces::corners, 3 * faces);
    f(&Star_faces::edges, edges);
  }

private:
  /// By spoke: whether it counts a face or an edge, then how many those before it do.
  struct Counts {
    Buffer<int> faces, edges, sums;

    template <class F>
    static void for_each_array(F&& f, int spokes)
    {
      for (auto array : {&Counts::faces, &Counts::edges}) f(array, std::size_t(spokes) + 1);
      f(&Counts::sums, scan_sums(spokes + 1));
    }
  };
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_STAR_FACES_H
