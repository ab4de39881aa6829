// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vertices of a mesh in an order in which each may change itself and read its neighbors, many
// at once: first those whose neighbors are all of the same block of consecutive vertices, block
// beside block; then the others by colors, such that neighbors differ. Each of these takes the
// first color that is free as soon as all neighbors before it have theirs, in an order of blocks
// that a hash shuffles: few wait long, and the colors are the same for any number of threads.
// (Jones and Plassmann, "A parallel graph coloring heuristic", 1993.) Where consecutive vertices
// are near each other, as samples are, most of the memory is read in order.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_INDEPENDENT_VERTICES_H
#define CGAL_POWER_RTF_IMPROVEMENT_INDEPENDENT_VERTICES_H

#include <CGAL/PowerRTF/extraction/Working_mesh.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/mixed_bits.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Independent_vertices {
public:
  using Mesh = Working_mesh::Mesh;
  using Vertex = Working_mesh::Vertex;

  /// After an edge has changed; many may at once.
  void note_change()
  {
    if (atomic_load(&m_is_current)) atomic_store(&m_is_current, false);
  }

  /// Calls `f(v)` for all vertices of the mesh as it is now.
  template <class F>
  void for_each(const Mesh& mesh, Concurrency concurrency, F&& f)
  {
    if (!m_is_current) update(mesh, concurrency);
    for_each_chunk(concurrency, int(m_colors.size()), block, [&](int begin, int end) {
      for (int v = begin; v < end; ++v)
        if (m_colors[v] == inside) f(Vertex(v));
    });
    for (const std::vector<Vertex>& vertices : m_classes)
      for_each_chunk(concurrency, int(vertices.size()), 64, [&](int begin, int end) {
        for (int k = begin; k < end; ++k) f(vertices[k]);
      });
  }

private:
  static constexpr int block = 512;
  static constexpr int none = -1, inside = -2; // of a block: needs no color

  // Most keep the color that they had.
  void update(const Mesh& mesh, Concurrency concurrency)
  {
    const int vertices = int(mesh.num_vertices());
    m_colors.resize(vertices, none);
    for_each_index(concurrency, vertices, [&](int v) {
      if (is_inside(mesh, Vertex(v)))
        m_colors[v] = inside;
      else if (m_colors[v] == inside)
        m_colors[v] = none;
    });
    std::vector<int> waiting =
        select(concurrency, vertices, [&](int v) { return needs_color(mesh, Vertex(v)); });
    for (const int v : waiting) m_colors[v] = none;
    while (!waiting.empty()) {
      for_each_index(concurrency, int(waiting.size()), [&](int k) {
        const Vertex v(waiting[k]);
        if (!must_wait(mesh, v)) atomic_store(&m_colors[v], free_color(mesh, v));
      });
      const std::vector<int> left = select(concurrency, int(waiting.size()),
                                           [&](int k) { return m_colors[waiting[k]] == none; });
      for (std::size_t k = 0; k < left.size(); ++k) waiting[k] = waiting[left[k]];
      waiting.resize(left.size());
    }
    m_classes.clear();
    for (const int v :
         select(concurrency, vertices, [this](int v) { return m_colors[v] != inside; })) {
      m_classes.resize(std::max(m_classes.size(), std::size_t(m_colors[v]) + 1));
      m_classes[m_colors[v]].push_back(Vertex(v));
    }
    m_is_current = true;
  }

  static bool is_inside(const Mesh& mesh, Vertex v)
  {
    return !is_any_neighbor(mesh, v, [v](Vertex u) { return u / block != v / block; });
  }

  // Of two neighbors with the same color the second.
  bool needs_color(const Mesh& mesh, Vertex v) const
  {
    if (m_colors[v] < 0) return m_colors[v] == none;
    return is_any_neighbor(mesh, v, [&](Vertex u) { return u < v && m_colors[u] == m_colors[v]; });
  }

  bool must_wait(const Mesh& mesh, Vertex v) const
  {
    return is_any_neighbor(
        mesh, v, [&](Vertex u) { return atomic_load(&m_colors[u]) == none && is_before(u, v); });
  }

  // The first that no neighbor has. Those that may change meanwhile have none.
  int free_color(const Mesh& mesh, Vertex v) const
  {
    int color = 0;
    while (is_any_neighbor(mesh, v, [&](Vertex u) { return atomic_load(&m_colors[u]) == color; }))
      ++color;
    return color;
  }

  static bool is_before(Vertex u, Vertex v)
  {
    const std::uint64_t x = mixed_bits(u / block), y = mixed_bits(v / block);
    return x != y ? x < y : u < v;
  }

  template <class F>
  static bool is_any_neighbor(const Mesh& mesh, Vertex v, F&& f)
  {
    if (mesh.is_isolated(v)) return false;
    const auto first = mesh.halfedge(v);
    auto h = first;
    do {
      if (f(mesh.source(h))) return true;
      h = mesh.next_around_target(h);
    } while (h != first);
    return false;
  }

  int m_is_current = false;                   // has been updated since the last change
  std::vector<int> m_colors;                  // by vertex
  std::vector<std::vector<Vertex>> m_classes; // by color
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_INDEPENDENT_VERTICES_H
