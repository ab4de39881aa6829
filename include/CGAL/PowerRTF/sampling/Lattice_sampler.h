// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples that begin as a hexagonal lattice wherever the surface lets them:
//
//   put nodes on the surface, `nodes_per_lattice_point` times as many as samples (plan_lattice.h)
//   find the directions of the rows on them (orientation_field.h)
//   repeat: find the places of the lattice's points (position_field.h), count them, and scale the
//     spacing, until there are n of them but for 3.5 %
//   candidates: the lattice's points, and nodes in gaps between them; all nodes of components that
//     are too small for a lattice
//   eliminate those that are most crowded, until n are left
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_SAMPLER_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_SAMPLER_H

#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Find_facets.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/sampling/Lattice_field.h>
#include <CGAL/PowerRTF/sampling/Lattice_fields.h>
#include <CGAL/PowerRTF/sampling/Lattice_plan.h>
#include <CGAL/PowerRTF/sampling/initial_sampling.h>
#include <CGAL/PowerRTF/sampling/lattice_defects.h>
#include <CGAL/PowerRTF/sampling/place_candidate.h>
#include <CGAL/PowerRTF/sampling/plan_lattice.h>
#include <CGAL/PowerRTF/sampling/sample_elimination.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

template <class Backend>
class Lattice_sampler {
public:
  /// Keeps references. `tree`: of the surface's facets. `component`: of each facet.
  Lattice_sampler(Backend& backend, const Surface& surface, const Facet_tree& tree,
                  const Feature_samples& features, const std::vector<int>& component,
                  const std::vector<Component_share>& shares, std::uint64_t seed)
      : m_backend(backend), m_surface(surface), m_tree(tree), m_features(features),
        m_component(component), m_shares(shares), m_seed(seed),
        m_cube(cube_around(surface, backend.concurrency()))
  {
    for (const Component_share& share : shares) {
      m_size += share.samples;
      if (has_lattice(share)) m_lattice_size += share.samples;
    }
  }

  /// See `sample_surface()`.
  Samples run(const Make_lattice_field& make, const Find_facets& find,
              const Place_candidates& place)
  {
    internal::Progress_part part(0.05);
    const Lattice_plan plan = this->plan();
    std::vector<std::vector<int>> candidates;
    {
      const auto field = make(plan);
      part.next(0.8);
      find_points(*field);
      part.next(0.85);
      if (are_placed_by(place, *field)) return {};
      if (!choose_by(*field)) {
        m_candidates = field->candidates();
        candidates = candidates_of_components(*field);
      }
    }
    part.next(1);
    return on_surface(candidates.empty() ? all_candidates()
                                         : chosen_candidates(candidates, plan.sites.front()),
                      find);
  }

  /// Samples of the last run that are no points of the lattice.
  std::size_t off_lattice() const { return m_off_lattice; }

  /// What `run()` begins with, made by this backend. `surface`: in the order of the tree.
  Lattice_fields fields(const Surface_view<double>& surface)
  {
    const Lattice_plan plan = this->plan();
    Lattice_field<Backend> field(m_backend, surface, plan);
    find_points(field);
    m_candidates = field.candidates();
    m_candidates.resize(field.points().size());
    return described(field);
  }

private:
  static constexpr double tolerance = 0.035;
  static constexpr int max_scalings = 2;

  Lattice_plan plan() const
  {
    return lattice_plan(m_surface, m_cube, m_tree, m_features, m_component, m_shares, m_seed,
                        m_backend.concurrency());
  }

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
      const double count = static_cast<double>(field.find_points());
      const double wanted = static_cast<double>(m_lattice_size);
      if (step == max_scalings || std::fabs(count - wanted) <= tolerance * wanted || count == 0)
        break;
      scale *= std::sqrt(count / wanted);
    }
  }

  /// The places of each component's candidates. Where these are too few, because no lattice fits,
  /// all its nodes are added.
  std::vector<std::vector<int>> candidates_of_components(Lattice_field_base& field)
  {
    std::vector<std::vector<int>> candidates = candidates_of_components();
    std::vector<unsigned char> lacks(m_shares.size());
    for (std::size_t c = 0; c < lacks.size(); ++c)
      lacks[c] = candidates[c].size() < m_shares[c].samples;
    if (std::find(lacks.begin(), lacks.end(), 1) == lacks.end()) return candidates;
    const Sample_candidates others = field.nodes_of(lacks);
    m_candidates.insert(m_candidates.end(), others.begin(), others.end());
    return candidates_of_components();
  }

  std::vector<std::vector<int>> candidates_of_components() const
  {
    std::vector<std::vector<int>> candidates(m_shares.size());
    if (m_shares.size() == 1) { // mostly
      candidates[0] = all_candidates();
      return candidates;
    }
    for (std::size_t k = 0; k < m_candidates.size(); ++k)
      candidates[m_candidates[k].node.component].push_back(static_cast<int>(k));
    return candidates;
  }

  std::vector<int> all_candidates() const
  {
    std::vector<int> all;
    internal::resize_in_parallel(m_backend.concurrency(), all, m_candidates.size());
    m_backend.for_each(static_cast<int>(all.size()), [&](int k) { all[k] = k; });
    return all;
  }

  /// Whether an engine has made candidates its samples.
  bool are_placed_by(const Place_candidates& place, Lattice_field_base& field)
  {
    if (!place || m_shares.size() != 1) return false;
    const std::optional<std::size_t> off_lattice = place(field, m_shares.front().samples);
    if (off_lattice) m_off_lattice = *off_lattice;
    return off_lattice.has_value();
  }

  /// Whether the candidates that the field has chosen are all.
  bool choose_by(Lattice_field_base& field)
  {
    if (m_shares.size() != 1) return false;
    std::optional<Sample_candidates> chosen = field.choose_candidates(m_shares.front().samples);
    if (chosen) m_candidates = std::move(*chosen);
    return chosen.has_value();
  }

  /// As many of each component's candidates as it has samples.
  std::vector<int> chosen_candidates(const std::vector<std::vector<int>>& candidates,
                                     const Lattice_sites& sites)
  {
    std::vector<std::vector<int>> sites_of(m_shares.size());
    for (std::size_t s = 0; s < sites.size(); ++s)
      sites_of[sites.components[s]].push_back(static_cast<int>(s));
    std::vector<std::vector<int>> chosen(m_shares.size());
    for (std::size_t c = 0; c < m_shares.size(); ++c)
      chosen[c] = chosen_candidates(candidates[c], sites, sites_of[c], m_shares[c].samples);
    return internal::concatenated(m_backend.concurrency(), chosen);
  }

  /// `n` of the candidates of a component, whose sites are those in `sites_of`.
  std::vector<int> chosen_candidates(const std::vector<int>& candidates, const Lattice_sites& sites,
                                     const std::vector<int>& sites_of, std::size_t n)
  {
    if (n == 0) return {};
    const int free = static_cast<int>(candidates.size());
    internal::Elimination_candidates all(free + sites_of.size());
    m_backend.for_each(static_cast<int>(all.size()), [&](int k) {
      if (k < free) {
        all[k] = elimination_candidate(m_candidates[candidates[k]]);
      } else {
        const int s = sites_of[k - free];
        all[k] = elimination_candidate(sites.points[s], sites.normals[s], sites.spacing[s]);
      }
    });
    std::vector<int> chosen =
        eliminate_samples(all, 0, n, sites_of.size(), m_backend.concurrency());
    m_backend.for_each(static_cast<int>(chosen.size()),
                       [&](int k) { chosen[k] = candidates[chosen[k]]; });
    return chosen;
  }

  /// The candidates that were chosen.
  Samples on_surface(const std::vector<int>& chosen, const Find_facets& find)
  {
    m_off_lattice =
        internal::select(m_backend.concurrency(), static_cast<int>(chosen.size()), [&](int k) {
          return m_candidates[chosen[k]].distance < 0;
        }).size();
    const internal::Unset_vector<int> nearest = nearest_facets(chosen, find);
    internal::Unset_vector<Facet_place> places(chosen.size());
    m_backend.for_each(static_cast<int>(places.size()), [&](int k) {
      places[k] = facet_place(place_candidate<double>(m_candidates[chosen[k]], m_cube, nearest[k],
                                                      [this](int place) { return facet(place); }));
    });
    Samples samples;
    internal::add_samples(m_surface, places, samples, m_backend.concurrency());
    return samples;
  }

  /// The places in the tree of the facets that are nearest to the candidates, on the nodes' side of
  /// a sheet; -1: there is none.
  internal::Unset_vector<int> nearest_facets(const std::vector<int>& chosen,
                                             const Find_facets& find) const
  {
    const int n = static_cast<int>(chosen.size());
    internal::Unset_vector<int> nearest(n);
    const auto candidate = [&](int k) -> const Sample_candidate& {
      return m_candidates[chosen[k]];
    };
    const auto point = [&](int k) { return m_cube.to_outside(to_double(candidate(k).point)); };
    const auto normal = [&](int k) { return to_double(candidate(k).node.normal); };
    if (find) {
      internal::Unset_vector<Vec3d> points(n), normals(n);
      m_backend.for_each(n, [&](int k) {
        points[k] = point(k);
        normals[k] = normal(k);
        nearest[k] = candidate(k).node.facet;
      });
      if (find(n, points.data(), normals.data(), cos_same_side, nearest.data())) return nearest;
    }
    m_backend.for_each(n, [&](int k) {
      const int near = m_tree.order()[candidate(k).node.facet],
                f = m_tree.nearest(point(k), normal(k), cos_same_side, near).facet;
      nearest[k] = f < 0 ? -1 : m_tree.place(f);
    });
    return nearest;
  }

  Facet_corners<double> facet(int place) const
  {
    const Triangle& t = m_surface.triangles[m_tree.order()[place]];
    return facet_corners(m_surface.points[t[0]], m_surface.points[t[1]], m_surface.points[t[2]]);
  }

  Facet_place facet_place(const Surface_point<double>& p) const
  {
    const Facet_corners<double> f = facet(p.facet);
    double beta, gamma;
    barycentric_coordinates(p.point, f.a, f.b, f.c, beta, gamma);
    return {m_tree.order()[p.facet], {1 - beta - gamma, beta, gamma}};
  }

  /// The fields for those who want to look at them.
  Lattice_fields described(Lattice_field<Backend>& field)
  {
    const Lattice_view view = field.view();
    Lattice_fields fields;
    for (int i = 0; i < view.size; ++i) {
      fields.nodes.push_back(m_cube.to_outside(to_double(view.points[i])));
      fields.normals.push_back(to_double(view.normals[i]));
      fields.axes.push_back(to_double(view.frame(i).axis));
      fields.spacing.push_back(view.spacing(i) / m_cube.scale);
    }
    fields.indices.resize(view.size);
    fields.dislocations.resize(view.size);
    m_backend.for_each(view.size, [&](int i) {
      const Node_loop loop(view, i);
      fields.indices[i] = orientation_index(view, loop);
      fields.dislocations[i] = fields.indices[i] == 0 ? dislocation(view, loop) : 0;
    });
    const int* const nodes = field.points().nodes.data();
    fields.point_nodes.assign(nodes, nodes + field.points().size());
    fields.points = on_surface(all_candidates(), {}).points;
    return fields;
  }

  Backend& m_backend;
  const Surface& m_surface;
  const Facet_tree& m_tree;
  const Feature_samples& m_features;
  const std::vector<int>& m_component;
  const std::vector<Component_share>& m_shares;
  std::uint64_t m_seed;
  Surface_cube m_cube;                                           // of the nodes
  std::size_t m_size = 0, m_lattice_size = 0, m_off_lattice = 0; // samples
  Sample_candidates m_candidates;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_SAMPLER_H
