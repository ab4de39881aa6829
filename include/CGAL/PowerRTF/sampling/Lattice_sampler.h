// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples that begin as a hexagonal lattice wherever the surface lets them:
//
//   put nodes on the surface, `nodes_per_lattice_point` times as many as samples
//   find the directions of the rows on them (orientation_field.h)
//   repeat: find the places of the lattice's points (position_field.h), count them, and scale the
//     spacing, until there are n of them but for 3.5 %
//   candidates: the lattice's points, and nodes in gaps between them; all nodes of components that
//     are too small for a lattice
//   eliminate those that are most crowded, until n are left
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_SAMPLER_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_SAMPLER_H

#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/fields/gradation.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Find_facets.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/sampling/Lattice_field.h>
#include <CGAL/PowerRTF/sampling/Lattice_fields.h>
#include <CGAL/PowerRTF/sampling/Surface_strata.h>
#include <CGAL/PowerRTF/sampling/initial_sampling.h>
#include <CGAL/PowerRTF/sampling/lattice_defects.h>
#include <CGAL/PowerRTF/sampling/lattice_points.h>
#include <CGAL/PowerRTF/sampling/sample_elimination.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// A point that may become a sample.
struct Sample_candidate {
  Vec3d point;
  int node;       ///< where the lattice is seen from
  float distance; ///< of the two, relative to the spacing; -1: the point is the node
};

template <class Backend>
class Lattice_sampler {
public:
  /// Keeps references. `tree`: of the surface's facets. `component`: of each facet.
  Lattice_sampler(Backend& backend, const Surface& surface, const Facet_tree& tree,
                  const Feature_samples& features, const std::vector<int>& component,
                  const std::vector<Component_share>& shares, std::uint64_t seed)
      : m_backend(backend), m_surface(surface), m_tree(tree), m_features(features),
        m_component(component), m_shares(shares), m_seed(seed), m_cube(surface)
  {
    for (const Component_share& share : shares) {
      m_size += share.samples;
      if (share.samples >= min_lattice) m_lattice_size += share.samples;
    }
  }

  /// `find`: see `sample_surface()`.
  Samples run(const Make_lattice_field& make, const Find_facets& find)
  {
    internal::Progress_part part(0.05);
    make_nodes();
    {
      const auto field = make(m_levels, has_uniform_density(m_surface), m_seed);
      part.next(0.8);
      find_points(*field);
      part.next(0.85);
      add_candidates(*field);
    }
    m_levels.resize(1);
    part.next(1);
    return eliminate(find);
  }

  /// Samples of the last run that are no points of the lattice.
  std::size_t off_lattice() const { return m_off_lattice; }

  /// What `run()` begins with, made by this backend.
  Lattice_fields fields()
  {
    make_nodes();
    Lattice_field<Backend> field(m_backend, m_levels, has_uniform_density(m_surface), m_seed);
    find_points(field);
    set_candidates([](int) { return false; });
    return described(field.view());
  }

private:
  static constexpr double tolerance = 0.035;
  static constexpr int max_scalings = 2;
  static constexpr std::size_t min_lattice = 50; // samples of a component
  static constexpr double max_beyond = 0.05;     // a border, relative to the spacing
  static constexpr double cos_same_side = 0.2;   // of normals

  /// The fields, and the points with their number scaled to what is wanted.
  void find_points(Lattice_field_base& field)
  {
    internal::Progress_part part(0);
    // Rows that end cost points: a share that falls slowly with n (kitten, fertility, armadillo).
    double scale = 1 - 0.02 * std::pow(3000. / static_cast<double>(m_size), 0.2);
    for (int step = 0;; ++step) {
      part.next(1 - 0.3 / (step + 1)); // mostly one step does
      field.solve(static_cast<float>(scale));
      part.next(1 - 0.2 / (step + 1));
      choose_points(field);
      const double count = static_cast<double>(m_chosen.nodes.size() - field.count_twins(m_chosen));
      const double wanted = static_cast<double>(m_lattice_size);
      if (step == max_scalings || std::fabs(count - wanted) <= tolerance * wanted || count == 0)
        break;
      scale *= std::sqrt(count / wanted);
    }
  }

  void make_nodes()
  {
    const Surface_strata strata(m_surface, m_component, m_shares, m_backend.concurrency());
    const double most = nodes_per_lattice_point * static_cast<double>(m_size);
    if (most + static_cast<double>(m_features.sites.size()) >= Lattice_edge::none)
      throw Invalid_input_error(
          std::to_string(m_size) +
          " samples are more than a lattice can have: use another `sampling`");
    for (const std::size_t count : lattice_levels(m_size)) {
      const std::size_t stride = std::size_t(1) << m_levels.size(); // twice as far apart each
      const std::size_t sites = (m_features.sites.size() + stride - 1) / stride;
      m_levels.emplace_back();
      add_strata(strata, static_cast<int>(count), sites, m_levels.back());
      add_sites(stride, m_levels.back());
    }
  }

  /// Free nodes, and room for sites.
  void add_strata(const Surface_strata& strata, int count, std::size_t sites, Lattice_nodes& nodes)
  {
    const std::size_t level = m_levels.size();
    if (level == 1) m_facets.resize(count);
    nodes.resize(count, sites);
    m_backend.for_each(count, [&](int i) {
      const auto [f, w] = strata.place(i, count, m_seed + level);
      const Triangle& t = m_surface.triangles[f];
      const auto& p = m_surface.points;
      set_node(i, w[0] * p[t[0]] + w[1] * p[t[1]] + w[2] * p[t[2]],
               interpolated_normal(m_surface, f, w), interpolated_density(m_surface, f, w),
               m_component[f], nodes);
      if (level == 1) m_facets[i] = f;
    });
  }

  /// Every `stride`-th of the sites on creases and borders. The lattice's rows follow these where
  /// they do not turn.
  void add_sites(std::size_t stride, Lattice_nodes& nodes)
  {
    constexpr double straight = 0.8; // cosine
    const Samples& sites = m_features.sites;
    std::vector<int> before(sites.size(), -1);
    for (std::size_t s = 0; s < sites.size(); ++s)
      if (m_features.next[s] >= 0) before[m_features.next[s]] = static_cast<int>(s);
    m_backend.for_each(nodes.size() - nodes.free, [&](int k) {
      const int i = nodes.free + k, at = static_cast<int>(k * stride);
      set_node(i, sites.points[at], sites.normals[at], sites.density[at],
               m_component[sites.facets[at]], nodes);
      nodes.directions[k] = {};
      nodes.is_directed[k] = 0;
      const auto way = [&](int from, int to) {
        return from < 0 || to < 0 ? Vec3d{0, 0, 0}
                                  : normalized(sites.points[to] - sites.points[from]);
      };
      const Vec3d in = way(before[at], at), out = way(at, m_features.next[at]);
      if (!(dot(in, out) > straight)) return;
      const Tangent_frame<double> frame(sites.normals[at]);
      const Vec3d along = in + out;
      nodes.is_directed[k] = 1;
      nodes.directions[k] = unit(sixth_power(unit(
          {static_cast<float>(dot(along, frame.u)), static_cast<float>(dot(along, frame.v))})));
    });
  }

  void set_node(int i, const Vec3d& point, const Vec3d& normal, double density, int component,
                Lattice_nodes& nodes) const
  {
    nodes.points[i] = to_real<float>(m_cube.to_inside(point));
    nodes.normals[i] = to_real<float>(normal);
    nodes.components[i] = component;
    const double cell = m_shares[component].cell_mass / density; // sqrt(3) / 2 h^2
    nodes.spacing[i] = static_cast<float>(m_cube.scale * std::sqrt(2 / std::sqrt(3.) * cell));
  }

  void choose_points(Lattice_field_base& field)
  {
    m_chosen = field.points();
    const std::vector<int> kept =
        internal::select(m_backend.concurrency(), static_cast<int>(m_chosen.nodes.size()),
                         [&](int k) { return has_lattice(m_chosen.nodes[k]); });
    if (kept.size() == m_chosen.nodes.size()) return;
    for (std::size_t k = 0; k < kept.size(); ++k) {
      m_chosen.nodes[k] = m_chosen.nodes[kept[k]];
      m_chosen.points[k] = m_chosen.points[kept[k]];
    }
    m_chosen.nodes.resize(kept.size());
    m_chosen.points.resize(kept.size());
  }

  bool has_lattice(int node) const
  {
    return m_shares[m_levels.front().components[node]].samples >= min_lattice;
  }

  /// The lattice's points, and the nodes in its gaps.
  void add_candidates(Lattice_field_base& field)
  {
    const std::vector<unsigned char> is_gap = field.gaps(m_chosen);
    set_candidates([&](int i) { return !has_lattice(i) || is_gap[i]; });
  }

  /// Makes candidates of the lattice's points, then of the free nodes that are wanted.
  template <class IsWanted>
  void set_candidates(IsWanted is_wanted)
  {
    const int points = static_cast<int>(m_chosen.nodes.size());
    const std::vector<int> nodes = wanted_nodes(is_wanted);
    m_candidates.resize(points + nodes.size());
    m_backend.for_each(static_cast<int>(m_candidates.size()), [&](int k) {
      if (k >= points) {
        m_candidates[k] = candidate(nodes[k - points]);
        return;
      }
      const Seen_point& p = m_chosen.points[k];
      m_candidates[k] = {to_double(p.point), m_chosen.nodes[k], p.distance};
    });
  }

  template <class IsWanted>
  std::vector<int> wanted_nodes(IsWanted is_wanted) const
  {
    return internal::select(m_backend.concurrency(), m_levels.front().free, is_wanted);
  }
  Sample_candidate candidate(int node) const
  {
    return {to_double(m_levels.front().points[node]), node, -1};
  }

  /// The samples of each component from its candidates.
  Samples eliminate(const Find_facets& find)
  {
    const Lattice_nodes& nodes = m_levels.front();
    std::vector<std::vector<int>> candidates = candidates_of_components();
    const std::vector<int> others = wanted_nodes([&](int i) { // no lattice fits
      const int c = nodes.components[i];
      return candidates[c].size() < m_shares[c].samples;
    });
    for (const int i : others) m_candidates.push_back(candidate(i));
    if (!others.empty()) candidates = candidates_of_components();
    std::vector<std::vector<int>> sites(m_shares.size());
    for (int i = nodes.free; i < nodes.size(); ++i) sites[nodes.components[i]].push_back(i);
    std::vector<std::vector<Sample_candidate>> chosen(m_shares.size());
    for (std::size_t c = 0; c < m_shares.size(); ++c) {
      const std::vector<int> places =
          chosen_candidates(candidates[c], sites[c], m_shares[c].samples);
      chosen[c].resize(places.size());
      m_backend.for_each(static_cast<int>(places.size()),
                         [&](int k) { chosen[c][k] = m_candidates[candidates[c][places[k]]]; });
    }
    const auto all = internal::concatenated(m_backend.concurrency(), chosen);
    m_off_lattice =
        internal::select(m_backend.concurrency(), static_cast<int>(all.size()), [&](int k) {
          return all[k].distance < 0;
        }).size();
    return on_surface(all, find);
  }

  std::vector<std::vector<int>> candidates_of_components() const
  {
    std::vector<std::vector<int>> candidates(m_shares.size());
    if (m_shares.size() == 1) { // mostly
      candidates[0].resize(m_candidates.size());
      std::iota(candidates[0].begin(), candidates[0].end(), 0);
      return candidates;
    }
    for (std::size_t k = 0; k < m_candidates.size(); ++k)
      candidates[m_levels.front().components[m_candidates[k].node]].push_back(static_cast<int>(k));
    return candidates;
  }

  /// The places of `n` of the candidates of a component.
  std::vector<int> chosen_candidates(const std::vector<int>& candidates,
                                     const std::vector<int>& sites, std::size_t n)
  {
    if (n == 0) return {};
    const Lattice_nodes& nodes = m_levels.front();
    const std::size_t free = candidates.size();
    internal::Elimination_candidates all(free + sites.size());
    m_backend.for_each(static_cast<int>(all.size()), [&](int k) {
      const bool is_free = k < static_cast<int>(free);
      const int i = is_free ? m_candidates[candidates[k]].node : sites[k - free];
      all[k] = {is_free ? m_candidates[candidates[k]].point : to_double(nodes.points[i]),
                to_double(nodes.normals[i]), 0.5 * double(nodes.spacing[i])};
    });
    return eliminate_samples(all, 0, n, sites.size(), m_backend.concurrency());
  }

  template <class Candidates>
  Samples on_surface(const Candidates& candidates, const Find_facets& find = {}) const
  {
    const internal::Unset_vector<int> facets = nearest_facets(candidates, find);
    internal::Unset_vector<Facet_place> places(candidates.size());
    m_backend.for_each(static_cast<int>(places.size()),
                       [&](int k) { places[k] = place_on_surface(candidates[k], facets[k]); });
    Samples samples;
    internal::add_samples(m_surface, places, samples, m_backend.concurrency());
    return samples;
  }

  /// The facets that are nearest to the candidates, on the nodes' side of a sheet; -1: there is
  /// none.
  template <class Candidates>
  internal::Unset_vector<int> nearest_facets(const Candidates& candidates,
                                             const Find_facets& find) const
  {
    const int n = static_cast<int>(candidates.size());
    internal::Unset_vector<int> facets(n);
    const auto point = [&](int k) { return m_cube.to_outside(candidates[k].point); };
    const auto normal = [&](int k) {
      return to_double(m_levels.front().normals[candidates[k].node]);
    };
    const auto near = [&](int k) { return m_facets[candidates[k].node]; };
    if (find) {
      internal::Unset_vector<Vec3d> points(n), normals(n);
      m_backend.for_each(n, [&](int k) {
        points[k] = point(k);
        normals[k] = normal(k);
        facets[k] = m_tree.place(near(k));
      });
      if (find(n, points.data(), normals.data(), cos_same_side, facets.data())) {
        m_backend.for_each(n, [&](int k) {
          if (facets[k] >= 0) facets[k] = m_tree.order()[facets[k]];
        });
        return facets;
      }
    }
    m_backend.for_each(n, [&](int k) {
      facets[k] = m_tree.nearest(point(k), normal(k), cos_same_side, near(k)).facet;
    });
    return facets;
  }

  /// The candidate's point on its nearest facet `f`; the node itself where there is none, and for a
  /// point of the lattice beyond a border, whose nearest point is on it.
  Facet_place place_on_surface(const Sample_candidate& candidate, int f) const
  {
    const Lattice_nodes& nodes = m_levels.front();
    Vec3d point = m_cube.to_outside(candidate.point);
    if (f < 0) f = m_facets[candidate.node];
    const double h = double(nodes.spacing[candidate.node]) / m_cube.scale;
    if (beyond(point, f) > max_beyond * h) {
      point = m_cube.to_outside(to_double(nodes.points[candidate.node]));
      f = m_facets[candidate.node];
    }
    const auto [a, b, c] = corners(f);
    double beta, gamma;
    barycentric_coordinates(nearest_point_on_triangle(point, a, b, c), a, b, c, beta, gamma);
    return {f, {1 - beta - gamma, beta, gamma}};
  }

  std::array<Vec3d, 3> corners(int f) const
  {
    const Triangle& t = m_surface.triangles[f];
    return {m_surface.points[t[0]], m_surface.points[t[1]], m_surface.points[t[2]]};
  }

  /// How far the foot of the perpendicular from `p` to the plane of a facet is outside the facet.
  double beyond(const Vec3d& p, int f) const
  {
    const auto [a, b, c] = corners(f);
    const Vec3d normal = normalized(cross(b - a, c - a)), foot = p - dot(p - a, normal) * normal;
    return length(foot - nearest_point_on_triangle(foot, a, b, c));
  }

  /// The fields for those who want to look at them.
  Lattice_fields described(const Lattice_view& view) const
  {
    Lattice_fields fields;
    for (int i = 0; i < view.size; ++i) {
      fields.nodes.push_back(m_cube.to_outside(to_double(view.points[i])));
      fields.normals.push_back(to_double(view.normals[i]));
      fields.axes.push_back(to_double(view.axes[i]));
      fields.spacing.push_back(view.spacing(i) / m_cube.scale);
    }
    fields.indices.resize(view.size);
    fields.dislocations.resize(view.size);
    m_backend.for_each(view.size, [&](int i) {
      const Node_loop loop(view, i);
      fields.indices[i] = orientation_index(view, loop);
      fields.dislocations[i] = fields.indices[i] == 0 ? dislocation(view, loop) : 0;
    });
    for (const Sample_candidate& c : m_candidates) fields.point_nodes.push_back(c.node);
    fields.points = on_surface(m_candidates).points;
    return fields;
  }

  Backend& m_backend;
  const Surface& m_surface;
  const Facet_tree& m_tree;
  const Feature_samples& m_features;
  const std::vector<int>& m_component;
  const std::vector<Component_share>& m_shares;
  std::uint64_t m_seed;
  Surface_cube m_cube; // the nodes' coordinates are inside
  std::size_t m_size = 0, m_lattice_size = 0, m_off_lattice = 0; // samples
  std::vector<Lattice_nodes> m_levels;                           // from fine to coarse
  std::vector<int> m_facets; // of the free nodes of the finest level
  Chosen_points m_chosen;    // of components with a lattice
  internal::Unset_vector<Sample_candidate> m_candidates;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_SAMPLER_H
