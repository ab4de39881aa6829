// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The triangles on which the cells agree, mended where they do not make a 2-manifold: a sample
// whose triangles form no disk is open, and all its triangles are made anew on the piece of the
// surface around it. Where these do not fit to the others, more samples are opened, and the pieces
// grow.
#ifndef CGAL_POWER_RTF_EXTRACTION_MENDED_STARS_H
#define CGAL_POWER_RTF_EXTRACTION_MENDED_STARS_H

#include <CGAL/PowerRTF/extraction/Cell_stars.h>
#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/extraction/Surface_piece.h>
#include <CGAL/PowerRTF/extraction/border_samples.h>
#include <CGAL/PowerRTF/extraction/fan_topology.h>
#include <CGAL/PowerRTF/extraction/insert_samples.h>
#include <CGAL/PowerRTF/extraction/reduce_to_samples.h>
#include <CGAL/PowerRTF/geometry/Surface_walk.h>
#include <CGAL/PowerRTF/geometry/self_intersections.h>
#include <CGAL/PowerRTF/internal/Background_work.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

template <class ConcurrencyTag>
class Mended_stars {
public:
  /// Keeps references to all but `neighbors`; see `extract_from_cells()`.
  Mended_stars(const Surface& surface, const Samples& samples, const Feature_samples& features,
               Neighbor_cycles&& neighbors, const Bring_mesh& bring,
               const Find_sound_stars& find_sound)
      : m_surface(surface), m_samples(samples), m_features(features), m_bring(bring),
        m_stars(surface, samples, features, std::move(neighbors), find_sound),
        m_size(static_cast<int>(samples.size())), m_openings(samples.size(), 0),
        m_has_made(samples.size(), 0), m_on_curves(features.size()),
        m_is_on_border(are_on_border(surface, features))
  {
    for (const Edge& e : features.edges)
      for (const int i : {0, 1}) m_on_curves[e[i]].push_back(m_stars.cells() + e[1 - i]);
    find_spacing();
  }

  /// Returns whether the mesh has come to have all that is promised of it.
  bool mend()
  {
    Progress_part part(0.4);
    const std::vector<int> faulty =
        select(ConcurrencyTag(), m_size, [this](int v) { return !is_sound(v); });
    part.next(0.6);
    if (!close(faulty)) return false;
    part.next(0.7);
    make_mesh();
    part.next(1);
    for (int round = 0; round < max_rounds; ++round) {
      bool is_homeomorphic = false;
      Background_work check(ConcurrencyTag(), [&] { is_homeomorphic = has_topology_of_surface(); });
      const std::vector<int> crossed = samples_at_intersections();
      check.finish();
      if (!is_homeomorphic) return false;
      if (crossed.empty()) return true;
      if (!close(crossed)) return false;
      make_mesh();
    }
    return false;
  }

  Extracted_mesh& mesh() { return m_mesh; }
  std::size_t open_samples() const
  {
    return std::count_if(m_openings.begin(), m_openings.end(), [](int k) { return k > 0; });
  }
  std::size_t pieces() const { return m_pieces.size(); }

private:
  // A part of the surface where triangles are made anew.
  struct Piece {
    std::vector<int> facets;         // sorted
    std::vector<int> open;           // samples, sorted
    std::vector<Triangle> triangles; // at these
  };

  static constexpr int max_rounds = 6;
  static constexpr double first_reach = 1.5, growth = 1.6; // of a piece, in units of the spacing
  static constexpr double max_cover = 4; // of the surface, by pieces before they are joined
  static constexpr double pi = 3.14159265358979323846;

  bool is_open(int v) const { return m_openings[v] > 0; }

  // The side of a square that has the area of a sample's cell.
  double spacing(int v) const
  {
    return m_samples.density.empty() ? m_unit : m_unit / std::sqrt(m_samples.density[v]);
  }
  void find_spacing()
  {
    const double shares = sum<ConcurrencyTag>(
        m_size, [&](int v) { return m_samples.density.empty() ? 1 : 1 / m_samples.density[v]; });
    m_unit = std::sqrt(m_surface.area / std::max(shares, 1.));
  }

  // Of a piece around an open sample.
  double reach(int v) const
  {
    return first_reach * std::pow(growth, m_openings[v] - 1) * spacing(v);
  }

  // Whether all triangles at a sample are those of its cell.
  bool is_of_cell(int v) const
  {
    if (v >= m_stars.cells() || !m_stars.is_agreed(v) || is_open(v) || m_has_made[v]) return false;
    const Neighbor_cycles::Cycle around = m_stars.neighbors(v);
    return std::none_of(around.begin(), around.end(), [this](int w) { return is_open(w); });
  }

  // The triangles at a sample as they are now; of a cell in their order around it.
  Fan star(int v) const
  {
    Fan star;
    if (!is_open(v))
      m_stars.for_each_at(v, [&](const Fan_corner& c) {
        if (!is_open(c[0]) && !is_open(c[1])) star.push_back(c);
      });
    if (m_has_made[v])
      m_stars.for_each_of(m_made, v, [&](const Fan_corner& c) { star.push_back(c); });
    return star;
  }

  // Whether the triangles at a sample are a disk, with it on the border if it is on the surface's,
  // and the pieces of its creases and borders are there.
  bool is_whole(int v) const
  {
    if (is_of_cell(v)) return m_stars.triangles().are_distinct(v);
    Fan s = star(v);
    if (!sort_around(s)) return false;
    if (v < m_stars.cells()) return is_closed(s) && s.size() >= 3;
    const int k = v - m_stars.cells();
    if (is_closed(s) == bool(m_is_on_border[k])) return false;
    const std::vector<int>& curve = m_on_curves[k];
    const auto is_on_curve = [&](int w) {
      return std::find(curve.begin(), curve.end(), w) != curve.end();
    };
    if (is_closed(s) ? s.size() < 3 : !is_on_curve(s.front()[0]) || !is_on_curve(s.back()[1]))
      return false;
    const auto is_at_mirror = [&](int w) { return m_surface.is_at_mirror(m_samples.points[w]); };
    if (is_at_mirror(v) && std::any_of(s.begin() + 1, s.end(), [&](const Fan_corner& c) {
          return is_at_mirror(c[0]); // the image of that edge has the same ends
        }))
      return false;
    return std::all_of(curve.begin(), curve.end(), [&](int w) {
      return w == s.back()[1] ||
             std::any_of(s.begin(), s.end(), [w](const Fan_corner& c) { return c[0] == w; });
    });
  }

  // Whether the triangles at a sample are as the cells have them, and all that is asked of them.
  bool is_sound(int v) const
  {
    const bool has_cell = v < m_stars.cells();
    return (has_cell && m_stars.is_sound(v)) || (is_whole(v) && (!has_cell || lies_well(v)));
  }

  bool lies_well(int v) const
  {
    return m_stars.triangles().lies_well(
        v,
        [&](const auto& f) { m_stars.for_each_at(v, [&](const Fan_corner& c) { f(c[0], c[1]); }); },
        [&](int w) { return are_neighbors(v, w); });
  }

  // Whether a short way along the surface joins a sample and another one, perhaps on a feature.
  bool are_neighbors(int v, int w) const
  {
    if (w < m_stars.cells()) return m_stars.triangles().are_neighbors(m_surface, v, w);
    const Vec3d &p = m_samples.points[v], &q = m_samples.points[w];
    const Edge_place& place = m_features.places[w - m_stars.cells()];
    return Surface_walk(m_surface, p, q, m_samples.normals[v] + m_samples.normals[w])
        .leads_to(m_samples.facets[v], [&](int facet) {
          const Triangle& t = m_surface.triangles[facet];
          return std::find(t.begin(), t.end(), place.from) != t.end() &&
                 std::find(t.begin(), t.end(), place.to) != t.end();
        });
  }

  // Makes the triangles at the samples anew, and at more of them until all fit.
  bool close(std::vector<int> faulty)
  {
    for (int round = 0; round < max_rounds && !faulty.empty(); ++round) {
      for (const int v : faulty) ++m_openings[v];
      if (!add_pieces(faulty)) return false;
      gather_made();
      faulty = select(ConcurrencyTag(), m_size, [this](int v) { return !is_whole(v); });
    }
    return faulty.empty();
  }

  // Pieces around the samples, joined with those that they touch. Returns `false` if they are much
  // of the surface.
  bool add_pieces(const std::vector<int>& samples)
  {
    double area = 0;
    for (const int v : samples) area += pi * reach(v) * reach(v);
    if (area > max_cover * m_surface.area) return false;
    const std::size_t old = m_pieces.size();
    m_pieces.resize(old + samples.size());
    for_each_chunk<ConcurrencyTag>(static_cast<int>(samples.size()), 1, [&](int k, int) {
      const int v = samples[k];
      m_pieces[old + k] = {
          facets_near(m_surface, m_samples.points[v], m_samples.facets[v], reach(v)), {v}, {}};
    });
    join_touching();
    std::size_t facets = 0;
    for (const Piece& piece : m_pieces) facets += piece.facets.size();
    if (2 * facets > m_surface.triangles.size()) return false;
    if (!m_places) m_places.emplace(m_surface, m_samples, m_features, ConcurrencyTag());
    std::vector<int> due;
    for (int k = 0; k < static_cast<int>(m_pieces.size()); ++k)
      if (m_pieces[k].triangles.empty()) due.push_back(k);
    for_each_chunk<ConcurrencyTag>(static_cast<int>(due.size()), 1,
                                   [&](int k, int) { triangulate(m_pieces[due[k]]); });
    return true;
  }

  void join_touching()
  {
    std::vector<std::pair<int, int>> facets; // and their pieces
    for (std::size_t k = 0; k < m_pieces.size(); ++k)
      for (const int f : m_pieces[k].facets) facets.emplace_back(f, static_cast<int>(k));
    sort<ConcurrencyTag>(facets.begin(), facets.end());
    boost::disjoint_sets_with_storage<> sets(m_pieces.size());
    for (std::size_t k = 1; k < facets.size(); ++k)
      if (facets[k].first == facets[k - 1].first)
        sets.union_set(facets[k].second, facets[k - 1].second);
    std::vector<Piece> joined;
    std::vector<int> place(m_pieces.size(), -1); // by root
    for (std::size_t k = 0; k < m_pieces.size(); ++k) {
      int& at = place[sets.find_set(k)];
      if (at < 0) {
        at = static_cast<int>(joined.size());
        joined.push_back(std::move(m_pieces[k]));
        continue;
      }
      Piece& piece = joined[at];
      piece.facets.insert(piece.facets.end(), m_pieces[k].facets.begin(), m_pieces[k].facets.end());
      piece.open.insert(piece.open.end(), m_pieces[k].open.begin(), m_pieces[k].open.end());
      piece.triangles.clear();
    }
    for_each_chunk<ConcurrencyTag>(static_cast<int>(joined.size()), 1, [&](int k, int) {
      sort_uniquely(joined[k].facets);
      sort_uniquely(joined[k].open);
    });
    m_pieces = std::move(joined);
  }

  // The triangles at the piece's open samples whose corners are samples.
  void triangulate(Piece& piece) const
  {
    const Surface_piece part(m_surface, m_samples, *m_places, piece.facets);
    Working_mesh mesh(insert_samples(part.surface, part.samples, part.places));
    reduce_to_samples(mesh);
    for (Triangle t : mesh.triangles()) {
      for (int& v : t) {
        const int s = mesh.samples[Working_mesh::Vertex(v)];
        v = s < 0 ? -1 : part.names[s];
      }
      const bool is_made = std::any_of(t.begin(), t.end(), [&](int v) {
        return std::binary_search(piece.open.begin(), piece.open.end(), v);
      });
      if (is_made && *std::min_element(t.begin(), t.end()) >= 0) piece.triangles.push_back(t);
    }
  }

  void gather_made()
  {
    m_made_triangles.clear();
    for (const Piece& piece : m_pieces)
      for (Triangle t : piece.triangles) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        m_made_triangles.push_back(t);
      }
    sort_uniquely(m_made_triangles); // those between two pieces are in both
    m_made.clear();
    for (const auto& [a, b, c] : m_made_triangles)
      m_made.insert(m_made.end(), {{a, b, c}, {b, c, a}, {c, a, b}});
    sort<ConcurrencyTag>(m_made.begin(), m_made.end());
    std::fill(m_has_made.begin(), m_has_made.end(), 0);
    for (const Triangle_at& t : m_made) m_has_made[t[0]] = 1;
  }

  // Calls `f` for the triangles of which the sample is the first.
  template <class F>
  void for_each_triangle_from(int v, const F& f) const
  {
    if (m_has_made[v])
      for (auto made = std::lower_bound(m_made_triangles.begin(), m_made_triangles.end(),
                                        Triangle{v, -1, -1});
           made != m_made_triangles.end() && (*made)[0] == v; ++made)
        f(*made);
    if (v < m_stars.cells() && !is_open(v))
      m_stars.for_each_at(v, [&](const Fan_corner& c) {
        if (v < c[0] && v < c[1] && !is_open(c[0]) && !is_open(c[1])) f({v, c[0], c[1]});
      });
  }

  void make_mesh()
  {
    m_mesh.resident = {};
    Unset_vector<int> first(m_size + 1);
    first[m_size] = 0;
    for_each_index<ConcurrencyTag>(m_size, [&](int v) {
      first[v] = 0;
      for_each_triangle_from(v, [&](const Triangle&) { ++first[v]; });
    });
    const int triangles = exclusive_scan(ConcurrencyTag(), m_size + 1, first.data());
    call_at_once(
        ConcurrencyTag(), [&] { resize_in_parallel(ConcurrencyTag(), m_mesh.points, m_size); },
        [&] { resize_in_parallel(ConcurrencyTag(), m_mesh.triangles, triangles); });
    for_each_index<ConcurrencyTag>(m_size, [&](int v) {
      m_mesh.points[v] = m_surface.normalization.snapped(m_samples.points[v]);
      const auto begin = m_mesh.triangles.begin() + first[v];
      auto end = begin;
      for_each_triangle_from(v, [&](const Triangle& t) { *end++ = t; });
      std::sort(begin, end);
    });
    m_mesh.feature_edges.clear();
    for (const Edge& e : m_features.edges)
      m_mesh.feature_edges.push_back(sorted_edge(m_stars.cells() + e[0], m_stars.cells() + e[1]));
    sort_uniquely(m_mesh.feature_edges);
  }

  bool has_topology_of_surface()
  {
    if (!m_topology) m_topology = known_topology(m_surface, ConcurrencyTag());
    const auto ordered_star = [this](int v) {
      Fan s = star(v);
      if (!is_of_cell(v)) sort_around(s);
      return s;
    };
    return are_homeomorphic(*m_topology, fan_topology(m_size, ordered_star, ConcurrencyTag()),
                            m_samples.facets, ConcurrencyTag());
  }

  std::vector<int> samples_at_intersections() const
  {
    std::vector<int> found;
    const std::vector<Triangle>& triangles = m_mesh.triangles;
    const std::shared_ptr<Resident_mesh> there = m_mesh.there(m_bring);
    for (const auto& [t, u] :
         intersecting_facets(m_mesh.points, triangles, ConcurrencyTag(), there.get()))
      for (const int face : {t, u})
        found.insert(found.end(), triangles[face].begin(), triangles[face].end());
    sort_uniquely(found);
    return found;
  }

  const Surface& m_surface;
  const Samples& m_samples;
  const Feature_samples& m_features;
  const Bring_mesh& m_bring;
  std::optional<Sample_places> m_places; // once they are needed
  Cell_stars<ConcurrencyTag> m_stars;
  int m_size;
  double m_unit = 0;                         // the spacing where the density is 1
  std::vector<int> m_openings;               // by sample: how often its triangles were found wrong
  std::vector<char> m_has_made;              // by sample: triangles of the pieces
  std::vector<std::vector<int>> m_on_curves; // by sample on features: its neighbors along them
  std::vector<char> m_is_on_border;          // by sample on features
  std::vector<Piece> m_pieces;
  std::vector<Triangle> m_made_triangles; // of the pieces, sorted
  std::vector<Triangle_at> m_made;        // the same at their corners, sorted
  Extracted_mesh m_mesh;
  std::shared_ptr<const Topology> m_topology; // of the surface, once it was needed
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_MENDED_STARS_H
