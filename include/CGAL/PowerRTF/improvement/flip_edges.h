// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Flips of edges where that makes triangles rounder, in the sense of smooth_vertex.h.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_FLIP_EDGES_H
#define CGAL_POWER_RTF_IMPROVEMENT_FLIP_EDGES_H

#include <CGAL/PowerRTF/improvement/Changed_vertices.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/better_flips.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Shape_flipper {
public:
  using Edge = Star_mesh::Edge;
  using Halfedge = Star_mesh::Halfedge;

  explicit Shape_flipper(Star_mesh& mesh) : m(mesh), m_changed(mesh) {}

  /// None but these edges of the mesh as it is may be worth a flip.
  void expect(std::vector<Edge>&& edges) { m_expected = std::move(edges); }

  /// Flips edges until that does not help any more.
  void run()
  {
    std::vector<Edge> edges = edges_to_flip();
    for (int pass = 0; pass < Parameters::max_flip_passes && !edges.empty(); ++pass) {
      std::vector<Edge> around;
      for (const Edge e : edges) {
        Cancellation::poll();
        if (!is_better_flipped(e)) continue;
        m.flip(e);
        for (const Halfedge h : {m.working().mesh.halfedge(e, 0), m.working().mesh.halfedge(e, 1)})
          for (const Halfedge side : {m.working().mesh.next(h), m.working().mesh.prev(h)})
            around.push_back(m.working().mesh.edge(side));
      }
      sort_uniquely(around);
      edges.swap(around);
    }
  }

private:
  using Parameters = Improvement_parameters::Smoothing;

  // Where something has changed since the last run.
  std::vector<Edge> edges_to_flip()
  {
    constexpr std::size_t vertices_per_change = 6;
    const auto is_wanted = [this](Edge e) { return is_better_flipped(e); };
    const std::vector<int> changed = m_changed.take();
    if (m_changed.are_few(changed, vertices_per_change)) return edges_around(m, changed, is_wanted);
    // Of those with these numbers, as `edge` names them.
    const auto wanted = [&](int n, const auto& edge) {
      std::vector<Edge> edges;
      for (const int k :
           select(m.concurrency(), n, [&](int k) { return is_wanted(Edge(edge(k))); }))
        edges.push_back(Edge(edge(k)));
      return edges;
    };
    if (const auto expected = std::exchange(m_expected, std::nullopt))
      return wanted(int(expected->size()), [&](int k) { return (*expected)[k]; });
    return wanted(int(m.working().mesh.num_edges()), [](int e) { return e; });
  }

  bool is_better_flipped(Edge e) const
  {
    return internal::is_better_flipped(
        m, e, [](const Vec3d& a, const Vec3d& b, const Vec3d& c) { return shape_energy(a, b, c); },
        least_shape_energy, Parameters::min_agreement);
  }

  Star_mesh& m;
  Changed_vertices m_changed;                  // since the last run
  std::optional<std::vector<Edge>> m_expected; // for the next run; none: all
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_FLIP_EDGES_H
