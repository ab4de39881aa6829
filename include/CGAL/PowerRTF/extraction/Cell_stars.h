// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles on which the cells of all their corners agree. Two neighbors that follow each other
// around a cell make a triangle with its sample; it stands where the cells of the other two have
// it, too. Samples on creases and borders have no cell, and no opinion. Nearly all triangles of a
// well distributed sampling are found so, each sample for itself. (An addition to the paper.)
#ifndef CGAL_POWER_RTF_EXTRACTION_CELL_STARS_H
#define CGAL_POWER_RTF_EXTRACTION_CELL_STARS_H

#include <CGAL/PowerRTF/cells/Find_sound_stars.h>
#include <CGAL/PowerRTF/cells/Neighbor_cycles.h>
#include <CGAL/PowerRTF/extraction/Fan.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// A triangle at a vertex: that and its corner there.
using Triangle_at = std::array<int, 3>;

template <class ConcurrencyTag>
class Cell_stars {
public:
  /// `neighbors`: of each cell, as `PowerRTFEngine::neighbors()` has them. `find`: what finds sound
  /// triangles, where it does. Keeps references to the arrays of `samples`.
  Cell_stars(const Surface& surface, const Samples& samples, const Feature_samples& features,
             Neighbor_cycles&& neighbors, const Find_sound_stars& find = {})
      : m_cells(static_cast<int>(neighbors.size())),
        m_neighbors(std::move(neighbors)), m_triangles{m_cells,
                                                       static_cast<int>(samples.size()),
                                                       m_neighbors.first.data(),
                                                       m_neighbors.neighbors.data(),
                                                       samples.points.data(),
                                                       samples.normals.data(),
                                                       samples.facets.data()},
        m_is_agreed(m_cells, 1), m_is_sound(filled<unsigned char>(ConcurrencyTag(), m_cells, 0))
  {
    if (features.size() > 0)
      for_each_index<ConcurrencyTag>(static_cast<int>(m_neighbors.neighbors.size()), [&](int k) {
        int& j = m_neighbors.neighbors[k];
        if (j >= m_cells) j = m_cells + features.samples_of_sites[j - m_cells];
      });
    if (find && m_cells > 0) find(surface, m_triangles, m_is_sound.data());
    for_each_index<ConcurrencyTag>(m_cells, [&](int i) {
      for (int k = 0; k < m_triangles.size(i) && !is_sound(i); ++k)
        if (!m_triangles.is_agreed(i, k)) m_is_agreed[i] = 0;
    });
    if (features.size() > 0) find_feature_stars();
  }

  Cell_stars(const Cell_stars&) = delete; // its triangles refer to its neighbors
  Cell_stars& operator=(const Cell_stars&) = delete;

  /// The number of samples with cells, which come first.
  int cells() const { return m_cells; }

  /// Whether all triangles of a cell are agreed.
  bool is_agreed(int i) const { return m_is_agreed[i]; }

  /// Whether they are known to be all that is asked of them.
  bool is_sound(int i) const { return m_is_sound[i] != 0; }

  /// The neighbors of a cell.
  Neighbor_cycles::Cycle neighbors(int i) const { return m_neighbors[i]; }
  const Cell_triangles& triangles() const { return m_triangles; }

  /// Calls `f(corner)` for the agreed triangles at `v`.
  template <class F>
  void for_each_at(int v, F&& f) const
  {
    if (v >= m_cells) {
      for_each_of(m_at_features, v, f);
      return;
    }
    for (int k = 0; k < m_triangles.size(v); ++k)
      if (m_is_agreed[v] || m_triangles.is_agreed(v, k))
        f(Fan_corner{m_triangles.from(v, k), m_triangles.to(v, k)});
  }

  /// The same of `triangles`, sorted.
  template <class F>
  static void for_each_of(const std::vector<Triangle_at>& triangles, int v, F&& f)
  {
    for (auto it = std::lower_bound(triangles.begin(), triangles.end(), Triangle_at{v, -1, -1});
         it != triangles.end() && (*it)[0] == v; ++it)
      f(Fan_corner{(*it)[1], (*it)[2]});
  }

private:
  void find_feature_stars()
  {
    constexpr int chunk = 1024;
    std::vector<std::vector<Triangle_at>> parts((m_cells + chunk - 1) / chunk);
    for_each_chunk<ConcurrencyTag>(m_cells, chunk, [&](int begin, int end) {
      for (int i = begin; i < end; ++i)
        for_each_at(i, [&](const Fan_corner& c) {
          if (c[0] >= m_cells) parts[begin / chunk].push_back({c[0], c[1], i});
          if (c[1] >= m_cells) parts[begin / chunk].push_back({c[1], i, c[0]});
        });
    });
    m_at_features = concatenated(ConcurrencyTag(), parts);
    // Found from each of the cells at it.
    sort_uniquely(m_at_features);
  }

  int m_cells;
  Neighbor_cycles m_neighbors; // samples
  Cell_triangles m_triangles;
  std::vector<char> m_is_agreed;
  Unset_vector<unsigned char> m_is_sound;
  std::vector<Triangle_at> m_at_features; // the agreed triangles there, sorted
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_CELL_STARS_H
