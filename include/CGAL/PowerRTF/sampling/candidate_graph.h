// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which candidates for samples are near each other.
#ifndef CGAL_POWER_RTF_SAMPLING_CANDIDATE_GRAPH_H
#define CGAL_POWER_RTF_SAMPLING_CANDIDATE_GRAPH_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/geometry/hilbert_code.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A point that may become a sample.
struct Elimination_candidate {
  Vec3d point;
  Vec3d normal;
  double radius; ///< half the distance of samples that are packed as densely as possible
};

using Elimination_candidates = Unset_vector<Elimination_candidate>;

/// Which candidates see each other: closer than the sum of their radii, normals compatible. Places
/// are those of the candidates in spatial order.
struct Candidate_graph {
  struct Neighbor {
    int place;
    double crowding; ///< Yuksel's weight, from 0 (radii touch) to 1 (same point)
  };
  std::vector<int> order;         ///< the candidate at each place
  std::vector<std::size_t> first; ///< of place k: `neighbors[first[k]]` to `neighbors[first[k+1]]`
  Unset_vector<Neighbor> neighbors;
};

/// The candidates in a packed tree, of whose nodes the largest radius is known, too: the work of a
/// search does not grow with the contrast of the radii.
class Candidate_tree {
public:
  Candidate_tree(const Elimination_candidates& candidates, Concurrency concurrency)
      : m_layout(static_cast<int>(candidates.size())), m_order(candidates.size()),
        m_sorted(candidates.size()), m_boxes(m_layout.nodes()), m_radii(m_layout.nodes())
  {
    Unset_vector<std::pair<std::uint64_t, int>> codes(candidates.size());
    for_each_index(concurrency, m_layout.items, [&](int i) {
      codes[i] = {hilbert_code(candidates[i].point), i};
    });
    sort(concurrency, codes.begin(), codes.end());
    for_each_index(concurrency, m_layout.items, [&](int k) {
      m_order[k] = codes[k].second;
      m_sorted[k] = candidates[m_order[k]];
    });
    for (int level = 0; level < m_layout.levels; ++level)
      for_each_index(concurrency, m_layout.nodes(level), [&](int k) { fit(level, k); });
  }

  const std::vector<int>& order() const { return m_order; }
  int leaves() const { return m_layout.levels > 0 ? m_layout.nodes(0) : 0; }

  /// Calls `found(k, neighbor)` for the places k of a leaf in order, and each of its neighbors.
  /// `near` is memory.
  template <class Found>
  void for_each_neighbor(int leaf, double cos_normal_angle, std::vector<int>& near,
                         Found&& found) const
  {
    near.clear();
    traverse(
        m_layout,
        [&](int node) {
          const double reach = m_radii[leaf] + m_radii[node];
          return squared_distance(m_boxes[leaf], m_boxes[node]) <= reach * reach;
        },
        [&](int begin, int end) {
          for (int j = begin; j < end; ++j) near.push_back(j);
        });
    for (int i = m_layout.children_begin(leaf); i < m_layout.children_end(0, leaf); ++i)
      for (const int j : near) {
        const Elimination_candidate &a = m_sorted[i], &b = m_sorted[j];
        const double reach = a.radius + b.radius, squared = squared_length(a.point - b.point);
        if (j == i || squared >= reach * reach || dot(a.normal, b.normal) < cos_normal_angle)
          continue;
        const double free = 1 - std::sqrt(squared) / reach;
        const double free_2 = free * free, free_4 = free_2 * free_2;
        found(i, Candidate_graph::Neighbor{j, free_4 * free_4}); // alpha = 8
      }
  }

private:
  void fit(int level, int k)
  {
    const int node = m_layout.first[level] + k, begin = m_layout.children_begin(k);
    const auto add = [&](int c, const Box3<double>& box, double radius) {
      if (c == begin) m_boxes[node] = box;
      m_boxes[node].add(box);
      m_radii[node] = (std::max)(m_radii[node], radius);
    };
    for (int c = begin; c < m_layout.children_end(level, k); ++c) {
      if (level == 0) {
        const Elimination_candidate& item = m_sorted[c];
        add(c, {item.point, item.point}, item.radius);
      } else {
        const int below = m_layout.first[level - 1] + c;
        add(c, m_boxes[below], m_radii[below]);
      }
    }
  }

  Packed_tree_layout m_layout;
  std::vector<int> m_order;
  Elimination_candidates m_sorted;
  Unset_vector<Box3<double>> m_boxes; // of the nodes
  std::vector<double> m_radii;        // the largest in each node
};

/// \param cos_normal_angle candidates whose normals' dot product is below it do not see each other
///   (NVISPC)
inline Candidate_graph candidate_graph(const Elimination_candidates& candidates,
                                       double cos_normal_angle, Concurrency concurrency)
{
  constexpr int leaves_per_chunk = 64, arity = Packed_tree_layout::arity;
  const Candidate_tree tree(candidates, concurrency);
  Candidate_graph graph;
  graph.order = tree.order();
  graph.first.assign(candidates.size() + 1, 0);
  std::vector<std::vector<Candidate_graph::Neighbor>> parts(tree.leaves() / leaves_per_chunk + 1);
  for_each_chunk(concurrency, tree.leaves(), leaves_per_chunk, [&](int begin, int end) {
    std::vector<Candidate_graph::Neighbor>& part = parts[begin / leaves_per_chunk];
    std::vector<int> near;
    for (int leaf = begin; leaf < end; ++leaf)
      tree.for_each_neighbor(leaf, cos_normal_angle, near, [&](int i, const auto& neighbor) {
        ++graph.first[i];
        part.push_back(neighbor);
      });
  });
  exclusive_scan(concurrency, static_cast<int>(graph.first.size()), graph.first.data());
  graph.neighbors.resize(graph.first.back());
  for_each_chunk(concurrency, tree.leaves(), leaves_per_chunk, [&](int begin, int) {
    const auto& part = parts[begin / leaves_per_chunk];
    std::copy(part.begin(), part.end(), graph.neighbors.begin() + graph.first[begin * arity]);
  });
  return graph;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SAMPLING_CANDIDATE_GRAPH_H
