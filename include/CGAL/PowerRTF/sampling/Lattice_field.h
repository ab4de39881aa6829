// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fields of a lattice on the nodes of a hierarchy, found from coarse to fine.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_H

#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/sampling/Candidate_elimination.h>
#include <CGAL/PowerRTF/sampling/Candidate_search.h>
#include <CGAL/PowerRTF/sampling/Lattice_field_base.h>
#include <CGAL/PowerRTF/sampling/Lattice_level.h>
#include <CGAL/PowerRTF/sampling/Lattice_plan.h>
#include <CGAL/PowerRTF/sampling/lattice_candidates.h>
#include <CGAL/PowerRTF/sampling/lattice_gaps.h>
#include <CGAL/PowerRTF/sampling/lattice_points.h>
#include <CGAL/PowerRTF/sampling/orientation_field.h>
#include <CGAL/PowerRTF/sampling/position_field.h>
#include <CGAL/PowerRTF/sampling/random_source.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF {

/// The direction in which a random vector points: no choice of frames has a part in it.
struct Draw_direction {
  Lattice_view view;
  std::uint64_t seed;
  Phasor* result;
  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    const auto coordinate = [&](int k) { return float(counted_random(seed, i, k)) - 0.5f; };
    const Vec3f v{coordinate(0), coordinate(1), coordinate(2)};
    const Tangent_frame<float> frame(view.normals[i]);
    result[i] = unit(sixth_power(unit({dot(v, frame.u), dot(v, frame.v)})));
  }
};

/// The node is a point of the lattice.
struct Set_crests {
  Stored_waves* waves;
  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    constexpr Phasor one{1, 0};
    waves[i] = {{one, one, one}};
  }
};

namespace internal {

/// One of several sweeps.
template <class Rule>
struct Sweep {
  Rule rule;
  int number;
  CGAL_POWER_RTF_HD void operator()(int i) const { rule(number, i); }
};

} // namespace internal

/// Points of the lattice, and the node that each is nearest to, in increasing order.
template <class Backend>
struct Chosen_points {
  typename Backend::template Buffer<int> nodes;
  typename Backend::template Buffer<Seen_point> points;

  int size() const { return static_cast<int>(nodes.size()); }
};

/// Each level is solved from the next coarser one's result by Jacobi's sweeps, so the fields are
/// the same for any number of threads.
template <class Backend>
class Lattice_field final : public Lattice_field_base {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  /// As `Make_lattice_field`; the nodes are points of `surface`, which the backend sees.
  template <class Real>
  Lattice_field(Backend& backend, const Surface_view<Real>& surface, const Lattice_plan& plan)
      : m_backend(backend), m_plan(plan)
  {
    m_bases.set(m_backend, plan.strata.bases);
    m_components.set(m_backend, plan.strata.components);
    m_sums.set(m_backend, plan.strata.sums);
    m_shares.set(m_backend, plan.shares);
    float reach = neighbor_reach;
    for (std::size_t l = 0; l < plan.free.size(); ++l) {
      m_levels.emplace_back(plan.free[l], plan.sites[l], reach);
      reach *= 2;
    }
    m_make_nodes = [this, surface](Level& level, std::uint64_t seed) {
      m_backend.for_each(
          level.free, Make_node<Real>{surface, strata(), m_plan.cube, m_shares.data(), level.free,
                                      seed, level.points.data(), level.normals.data(),
                                      level.components.data(), level.spacing.data()});
    };
    make_nodes(0);
  }

  /// The most that fields for so many points hold at a time on a device: while the finest level's
  /// points are placed, or chosen, or become candidates, or those are chosen from.
  static std::size_t bytes(std::size_t points, std::size_t facets, bool is_even)
  {
    const std::vector<std::size_t> sizes = lattice_levels(points);
    const std::size_t n = sizes.front(), coarser = sizes.size() > 1 ? sizes[1] : 0;
    const std::size_t nodes = facets * (2 * sizeof(int) + sizeof(double)) + Level::node_bytes(n);
    const std::size_t solved = Level::edges_bytes(n) + Level::solved_bytes(n, !is_even);
    const std::size_t selecting = n * (sizeof(unsigned char) + sizeof(int));
    const std::size_t chosen = points * (sizeof(int) + sizeof(Seen_point));
    const std::size_t placing = n * sizeof(Stored_waves) + Level::node_bytes(coarser) +
                                Level::solved_bytes(coarser, !is_even);
    const std::size_t choosing = n * sizeof(Seen_point) + selecting + chosen;
    const std::size_t gathering = chosen + selecting + points * sizeof(Sample_candidate);
    const std::size_t eliminating =
        chosen + points * sizeof(Sample_candidate) + choosing_bytes(points);
    return nodes +
           (std::max)({solved + placing, solved + choosing, solved + gathering, eliminating});
  }

  void solve(float factor) override
  {
    for (std::size_t l = m_levels.size(); l-- > 0;) {
      Level& level = m_levels[l];
      Level* const coarser = l + 1 < m_levels.size() ? &m_levels[l + 1] : nullptr;
      const internal::Progress_part level_part(std::ldexp(1., -2 * int(l))); // of all nodes
      internal::Progress_part part(0.2);
      if (coarser) coarser->edges = {};
      make_nodes(l);
      level.scale = factor;
      level.find_neighbors(m_backend);
      part.next(0.4);
      if (level.axes.size() == 0)
        orient(level, coarser, coarser ? direction_sweeps : coarsest_sweeps);
      part.next(1);
      place(level, coarser, l == 0 ? last_wave_sweeps : wave_sweeps);
      if (coarser) coarser->release_nodes();
    }
  }

  std::size_t find_points() override
  {
    choose_points();
    return m_chosen.size() - count_twins(m_chosen);
  }

  Sample_candidates candidates() override
  {
    return downloaded(candidates(m_chosen.size(), gaps(m_chosen)));
  }

  std::optional<Sample_candidates> choose_candidates(std::size_t n) override
  {
    std::optional<Buffer<Sample_candidate>> chosen = chosen_candidates(n);
    if (!chosen) return std::nullopt;
    return downloaded(*chosen);
  }

  /// The same, where the backend works.
  std::optional<Buffer<Sample_candidate>> chosen_candidates(std::size_t n)
  {
    constexpr int least = 1 << 14; // before it the host's threads are as fast
    if constexpr (!Backend::is_host)
      if (m_chosen.size() >= least) return eliminated_candidates(n);
    return std::nullopt;
  }

  /// What the candidates are in.
  const Surface_cube& cube() const { return m_plan.cube; }

  Sample_candidates nodes_of(const std::vector<unsigned char>& is_wanted) override
  {
    const Lattice_view view = this->view();
    Given<unsigned char> of_component;
    of_component.set(m_backend, is_wanted);
    Buffer<unsigned char> of_node;
    of_node.allocate(m_backend, view.free);
    m_backend.for_each(view.free,
                       Mark_components{view.components, of_component.data(), of_node.data()});
    return downloaded(candidates(0, of_node));
  }

  /// Those that were found last.
  const Chosen_points<Backend>& points() const { return m_chosen; }

  /// How many of some points have another one nearly at the same place.
  std::size_t count_twins(const Chosen_points<Backend>& points)
  {
    const Placing placing(m_backend, view(), points, 0);
    Buffer<unsigned char> is_twin;
    Buffer<int> twins;
    is_twin.allocate(m_backend, points.size());
    twins.allocate(m_backend, points.size());
    m_backend.for_each(points.size(), Mark_twin{placing.view(), is_twin.data()});
    return m_backend.select(points.size(), is_twin.data(), twins.data());
  }

  /// Of each free node, whether none of the points and of the sites on creases and borders is near,
  /// or its component has no lattice.
  Buffer<unsigned char> gaps(const Chosen_points<Backend>& points)
  {
    const Lattice_view view = this->view();
    const Placing placing(m_backend, view, points, view.size - view.free);
    Buffer<unsigned char> is_gap;
    is_gap.allocate(m_backend, view.free);
    m_backend.for_each(view.free,
                       Mark_gap_or_small{{placing.view(), is_gap.data()}, m_shares.data()});
    return is_gap;
  }

  /// Of the finest level.
  Lattice_view view() { return m_levels.front().view(); }

private:
  // More make no better meshes (kitten, homer, fertility, rocker arm; n = 3000).
  static constexpr int coarsest_sweeps = 100, direction_sweeps = 10, wave_sweeps = 12,
                       last_wave_sweeps = 8;
  static constexpr float neighbor_reach = 1.04f; // of 4 nodes per point: 15 others are within

  using Level = Lattice_level<Backend>;
  using Elimination = internal::Candidate_elimination<Backend, internal::Candidate_search_view>;

  /// What `choose_candidates()` takes for `n` candidates beside them.
  static std::size_t choosing_bytes(std::size_t n)
  {
    return internal::Candidate_search<Backend>::bytes(n) +
           internal::bytes_of_listed<Elimination>(n) + n * (sizeof(int) + sizeof(Sample_candidate));
  }

  /// An array of the host's where the backend sees it.
  template <class T>
  class Given {
  public:
    template <class Items>
    void set(Backend& backend, const Items& from)
    {
      m_data = from.data();
      if constexpr (!Backend::is_host) {
        m_copy.allocate(backend, from.size());
        backend.upload(m_copy.data(), from.data(), from.size());
        m_data = m_copy.data();
      }
    }
    const T* data() const { return m_data; }

  private:
    const T* m_data = nullptr;
    Buffer<T> m_copy;
  };

  /// Owns what is behind `Placed_points`.
  class Placing {
  public:
    /// Of the points, and the first `sites` sites.
    Placing(Backend& backend, const Lattice_view& nodes, const Chosen_points<Backend>& points,
            int sites)
        : m_nodes(nodes)
    {
      const int given = points.size(), size = given + sites;
      m_seen_from.allocate(backend, size);
      m_points.allocate(backend, size);
      m_distances.allocate(backend, size);
      backend.for_each(size, Place_points{nodes, given, points.nodes.data(), points.points.data(),
                                          m_seen_from.data(), m_points.data(), m_distances.data()});
      m_tree.emplace(backend, m_points.data(), size);
    }

    Placed_points view() const
    {
      return {m_nodes, m_tree->view(), m_seen_from.data(), m_distances.data()};
    }

  private:
    Lattice_view m_nodes;
    Buffer<int> m_seen_from;
    Buffer<Vec3d> m_points;
    Buffer<float> m_distances;
    std::optional<Point_tree<Backend, double>> m_tree;
  };

  /// `coarser`: has axes; null: there is none.
  void orient(Level& level, Level* coarser, int sweeps)
  {
    level.axes.allocate(m_backend, level.size);
    if (!m_plan.is_even) level.find_turning(m_backend);
    Buffer<Phasor> directions, next;
    for (Buffer<Phasor>* b : {&directions, &next}) b->allocate(m_backend, level.size);
    m_backend.upload(directions.data() + level.free, level.sites->directions.data(),
                     level.sites->size());
    const Lattice_view view = level.view();
    if (coarser)
      m_backend.for_each(view.free, Refine_direction{coarser->view(), view, directions.data()});
    else
      m_backend.for_each(view.free, Draw_direction{view, m_plan.seed, directions.data()});
    m_backend.for_each(view.size, Set_direction_edges{view});
    sweep(view.size, sweeps,
          Smooth_directions{view, level.is_directed.data(), directions.data(), next.data()});
    if (sweeps % 2) std::swap(directions, next);
    m_backend.for_each(view.size, Set_axis{view, directions.data()});
  }

  /// `coarser`: has waves; null: there is none.
  void place(Level& level, Level* coarser, int sweeps)
  {
    Buffer<Stored_waves> next;
    for (Buffer<Stored_waves>* waves : {&level.waves, &next}) {
      waves->allocate(m_backend, level.size);
      m_backend.for_each(level.size, Set_crests{waves->data()}); // what sites have
    }
    const Lattice_view view = level.view();
    if (coarser) m_backend.for_each(view.free, Refine_waves{coarser->view(), view});
    m_backend.for_each(view.size, Set_wave_edges{view});
    sweep(view.free, sweeps, Smooth_waves_repeatedly{view, next.data()});
    if (sweeps % 2) std::swap(level.waves, next);
  }

  /// Calls `rule(sweep, i)` for n items, one sweep after the other.
  template <class Rule>
  void sweep(int n, int sweeps, const Rule& rule)
  {
    if (n == 0 || m_backend.run_sweeps(n, sweeps, rule)) return;
    internal::Progress_part part(0);
    for (int k = 0; k < sweeps; ++k) {
      part.next((k + 1.) / sweeps);
      m_backend.for_each(n, internal::Sweep<Rule>{rule, k});
    }
  }

  /// Of level `l`, if they are not there.
  void make_nodes(std::size_t l)
  {
    m_levels[l].make_nodes(m_backend, [&](Level& to) { m_make_nodes(to, m_plan.seed_of(l)); });
  }

  Strata_view strata() const
  {
    return {static_cast<int>(m_plan.strata.bases.size()), m_bases.data(), m_components.data(),
            m_sums.data()};
  }

  void choose_points()
  {
    const Lattice_view view = this->view();
    Buffer<Seen_point> seen;
    Buffer<unsigned char> is_chosen;
    Buffer<int> nodes;
    seen.allocate(m_backend, view.size);
    is_chosen.allocate(m_backend, view.free);
    m_backend.for_each(view.size, See_points{view, seen.data()});
    m_backend.for_each(view.free,
                       Mark_chosen{{view, seen.data()}, m_shares.data(), is_chosen.data()});
    nodes.allocate(m_backend, view.free);
    const int size = m_backend.select(view.free, is_chosen.data(), nodes.data());
    m_chosen.nodes.allocate(m_backend, size);
    m_chosen.points.allocate(m_backend, size);
    m_backend.for_each(size, Find_mean_points{view, seen.data(), nodes.data(),
                                              m_chosen.nodes.data(), m_chosen.points.data()});
  }

  /// The first `points` of the lattice's, and the free nodes that are wanted.
  Buffer<Sample_candidate> candidates(int points, const Buffer<unsigned char>& is_wanted)
  {
    const Lattice_view view = this->view();
    Buffer<int> nodes;
    Buffer<Sample_candidate> candidates;
    nodes.allocate(m_backend, view.free);
    const int size = points + m_backend.select(view.free, is_wanted.data(), nodes.data());
    candidates.allocate(m_backend, size);
    m_backend.for_each(size, Make_candidate{view, strata(), m_plan.seed_of(0), points,
                                            m_chosen.nodes.data(), m_chosen.points.data(),
                                            nodes.data(), candidates.data()});
    return candidates;
  }

  /// As `choose_candidates()`.
  std::optional<Buffer<Sample_candidate>> eliminated_candidates(std::size_t n)
  {
    m_levels.front().edges = {};
    m_levels.front().release();
    const Lattice_view view = this->view();
    const Buffer<Sample_candidate> all = candidates(m_chosen.size(), gaps(m_chosen));
    const int free = static_cast<int>(all.size()), size = free + view.size - view.free;
    if (all.size() < n || !m_backend.has_room(choosing_bytes(size))) return std::nullopt;
    const internal::Candidate_search<Backend> search(
        m_backend, size, As_elimination_candidate{view, free, all.data()}, 0);
    Elimination elimination(m_backend, search.view(), search.order(), size, free);
    if (!elimination.run(n, [](const int*, int, double) { return false; })) return std::nullopt;
    Buffer<int> left;
    left.allocate(m_backend, free);
    if (elimination.write_left(left.data()) != static_cast<int>(n)) return std::nullopt;
    Buffer<Sample_candidate> chosen;
    chosen.allocate(m_backend, n);
    m_backend.for_each(static_cast<int>(n), internal::Gather_chosen<Sample_candidate>{
                                                all.data(), left.data(), chosen.data()});
    return chosen;
  }

  Sample_candidates downloaded(const Buffer<Sample_candidate>& candidates)
  {
    Sample_candidates result(candidates.size());
    m_backend.download(result.data(), candidates.data(), result.size());
    return result;
  }

  Backend& m_backend;
  const Lattice_plan& m_plan;
  Given<int> m_bases, m_components; // the plan's strata
  Given<double> m_sums;
  Given<Component_share> m_shares;
  std::function<void(Level&, std::uint64_t seed)> m_make_nodes;
  std::deque<Level> m_levels; // from fine to coarse
  Chosen_points<Backend> m_chosen;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_H
