// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The reference extraction: the dual of the Voronoi (or power) diagram restricted to the surface,
// with exact predicates and by connected components of the restricted cells, so that close sheets
// are separated (the "multi-nerve" of Geogram). Every facet is cut into its pieces of cells;
// pieces of a cell that meet across an edge of the surface belong to one component; where three
// pieces of a facet meet, there is a triangle of their components.
#ifndef CGAL_POWER_RTF_TEST_EXTRACT_EXACT_H
#define CGAL_POWER_RTF_TEST_EXTRACT_EXACT_H

#include "Facet_cell_clipper.h"
#include <CGAL/PowerRTF/exact/Weighted_site_tree.h>
#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

class Exact_extractor {
  using Exact_nt = Exact_kernel_selector<Simple_cartesian<double>>::Exact_rt;
  using Clipper = Facet_cell_clipper<Exact_nt>;

  struct Piece {
    int facet, sample;
    double area;
    Vec3d moment;
  };
  struct Corner { // where three pieces of a facet meet, counter-clockwise
    int facet;
    std::array<int, 3> samples;
  };

  const Surface& m_surface;
  const Samples& m_samples;
  std::vector<double> m_weights;
  Weighted_site_tree m_tree;
  std::vector<Piece> m_pieces;
  std::vector<int> m_parent;                                // of the pieces: components
  std::map<std::pair<int, int>, int> m_piece;               // by facet and sample
  std::map<std::array<int, 3>, std::vector<int>> m_at_edge; // edge and sample: pieces
  std::vector<Corner> m_corners;

public:
  Exact_extractor(const Surface& surface, const Samples& samples, std::vector<double> weights)
      : m_surface(surface), m_samples(samples), m_weights(std::move(weights)),
        m_tree(samples.points, m_weights)
  {}

  Extracted_mesh run()
  {
    Extracted_mesh mesh;
    mesh.points = m_samples.points;
    if (m_samples.points.empty()) return mesh;
    for (int f = 0; f < int(m_surface.triangles.size()); ++f) cut_facet(f);
    m_parent.resize(m_pieces.size());
    std::iota(m_parent.begin(), m_parent.end(), 0);
    for (const auto& entry : m_at_edge)
      for (int piece : entry.second) m_parent[root(piece)] = root(entry.second.front());
    const std::vector<int> vertex = number_components(mesh);
    std::set<std::array<int, 3>> known;
    for (const Corner& c : m_corners) {
      Triangle t;
      for (int k = 0; k < 3; ++k) t[k] = vertex[root(m_piece.at({c.facet, c.samples[k]}))];
      std::array<int, 3> key = t;
      std::sort(key.begin(), key.end());
      if (known.insert(key).second) mesh.triangles.push_back(t);
    }
    return mesh;
  }

private:
  int root(int piece)
  {
    while (m_parent[piece] != piece) piece = m_parent[piece] = m_parent[m_parent[piece]];
    return piece;
  }

  int nearest_to_corner(const Clipper& clipper, const Vec3d& corner) const
  {
    int nearest = -1;
    m_tree.visit(
        corner,
        [&](const Weighted_box& box) {
          if (nearest < 0) return true;
          double least = -box.max_weight; // power of the box, with a margin for its rounding
          double size = std::fabs(box.max_weight) + std::fabs(m_weights[nearest]);
          const double to_box = squared_distance(box, corner);
          least += to_box;
          size += to_box;
          const double d2 = squared_length(m_samples.points[nearest] - corner);
          return !(least - (d2 - m_weights[nearest]) > 1e-14 * (size + d2));
        },
        [&](int j) {
          if (nearest < 0 || clipper.is_nearer_to_corner(j, nearest)) nearest = j;
        });
    return nearest;
  }

  /// All pieces of a facet: from the one at its first corner on, from piece to piece.
  void cut_facet(int f)
  {
    const Triangle& t = m_surface.triangles[f];
    const std::array<Vec3d, 3> facet{m_surface.points[t[0]], m_surface.points[t[1]],
                                     m_surface.points[t[2]]};
    Clipper clipper(m_samples.points, m_weights, facet);
    if (clipper.is_degenerate()) return;
    std::vector<int> waiting{nearest_to_corner(clipper, facet[0])};
    std::set<int> seen(waiting.begin(), waiting.end());
    while (!waiting.empty()) {
      const int i = waiting.back();
      waiting.pop_back();
      clipper.start(i);
      m_tree.visit(
          m_samples.points[i], [&](const Weighted_box& box) { return clipper.may_be_cut_by(box); },
          [&](int j) { clipper.clip(j); });
      if (clipper.is_empty()) continue;
      add_piece(f, i, clipper);
      for (int id : clipper.cycle())
        if (id >= 0 && seen.insert(id).second) waiting.push_back(id);
    }
  }

  void add_piece(int f, int i, const Clipper& clipper)
  {
    const int piece = int(m_pieces.size());
    const std::vector<Vec3d> corners = clipper.corners();
    Piece p{f, i, 0, {0, 0, 0}};
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
      const double area = length(cross(corners[k] - corners[0], corners[k + 1] - corners[0])) / 2;
      p.area += area;
      p.moment += (corners[0] + corners[k] + corners[k + 1]) * (area / 3);
    }
    m_pieces.push_back(p);
    m_piece[{f, i}] = piece;
    const std::vector<int> cycle = clipper.cycle();
    const Triangle& t = m_surface.triangles[f];
    for (std::size_t k = 0; k < cycle.size(); ++k) {
      const int j = cycle[k], l = cycle[(k + 1) % cycle.size()];
      if (j < 0) {
        const int a = t[-1 - j], b = t[-j % 3];
        m_at_edge[{(std::min)(a, b), (std::max)(a, b), i}].push_back(piece);
      } else if (l >= 0 && i < j && i < l) { // once for the three pieces
        m_corners.push_back({f, {i, j, l}});
      }
    }
  }

  /// The vertex of each component, by its root: the sample for the component that holds it (else
  /// for the largest one), a new point, the component's centroid, for the others.
  std::vector<int> number_components(Extracted_mesh& mesh)
  {
    const int n = int(m_pieces.size());
    std::vector<double> area(n, 0);
    std::vector<Vec3d> moment(n, {0, 0, 0});
    for (int k = 0; k < n; ++k) {
      area[root(k)] += m_pieces[k].area;
      moment[root(k)] += m_pieces[k].moment;
    }
    std::vector<int> main(m_samples.size(), -1), vertex(n, -1);
    for (int k = 0; k < n; ++k) {
      int& m = main[m_pieces[k].sample];
      if (root(k) == k && (m < 0 || area[k] > area[m])) m = k;
    }
    for (int s = 0; s < int(m_samples.facets.size()); ++s)
      if (const auto own = m_piece.find({m_samples.facets[s], s}); own != m_piece.end())
        main[s] = root(own->second);
    for (int k = 0; k < n; ++k) {
      if (root(k) != k) continue;
      const int s = m_pieces[k].sample;
      if (main[s] == k) {
        vertex[k] = s;
      } else {
        vertex[k] = int(mesh.points.size());
        mesh.points.push_back(area[k] > 0 ? moment[k] * (1 / area[k]) : m_samples.points[s]);
      }
    }
    return vertex;
  }
};

} // namespace internal

/// The dual of the samples' Voronoi diagram, or with `weighted` of their power diagram, restricted
/// to `surface`, by components of the restricted cells; oriented like the surface. Exact for
/// points, weights and surface taken as exact doubles; degenerate facets are left out. Points: the
/// samples, then one for each further component of a cell. May still be no manifold where cells
/// are no discs (Edelsbrunner and Shah 1997). Slow: a reference.
inline Extracted_mesh extract_exact(const Surface& surface, const Samples& samples,
                                    bool weighted = false)
{
  return internal::Exact_extractor(
             surface, samples, weighted ? samples.weights : std::vector<double>(samples.size(), 0.))
      .run();
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_TEST_EXTRACT_EXACT_H
