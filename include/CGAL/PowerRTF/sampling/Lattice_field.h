// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fields of a lattice on the nodes of a hierarchy, found from coarse to fine.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_H

#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/sampling/Lattice_field_base.h>
#include <CGAL/PowerRTF/sampling/lattice_gaps.h>
#include <CGAL/PowerRTF/sampling/orientation_field.h>
#include <CGAL/PowerRTF/sampling/position_field.h>
#include <CGAL/PowerRTF/sampling/random_source.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
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

struct Mark_chosen {
  Choose_points choose;
  unsigned char* result;
  CGAL_POWER_RTF_HD void operator()(int i) const { result[i] = choose(i); }
};

struct Find_mean_points {
  Lattice_view view;
  const Seen_point* seen;
  const int* nodes;
  Seen_point* result;
  CGAL_POWER_RTF_HD void operator()(int k) const
  {
    result[k] = {mean_seen_point(view, seen, nodes[k]), seen[nodes[k]].distance};
  }
};

/// Each level is solved from the next coarser one's result by Jacobi's sweeps, so the fields are
/// the same for any number of threads.
template <class Backend>
class Lattice_field final : public Lattice_field_base {
public:
  /// As `Make_lattice_field`. A backend of the host keeps references to the nodes.
  Lattice_field(Backend& backend, const std::vector<Lattice_nodes>& levels, bool is_even,
                std::uint64_t seed)
      : m_backend(backend), m_is_turning(!is_even), m_seed(seed)
  {
    float reach = neighbor_reach;
    for (const Lattice_nodes& nodes : levels) {
      m_levels.emplace_back();
      m_levels.back().set_nodes(m_backend, nodes, reach);
      reach *= 2;
    }
  }

  /// The most that fields for so many points hold at a time on a device: while the finest level's
  /// points are placed, or chosen.
  static std::size_t bytes(std::size_t points, bool is_even)
  {
    const std::vector<std::size_t> sizes = lattice_levels(points);
    const std::size_t n = sizes.front(), coarser = sizes.size() > 1 ? sizes[1] : 0;
    std::size_t sum = Level::edges_bytes(n) + Level::solved_bytes(n, !is_even);
    for (const std::size_t size : sizes) sum += Level::given_bytes(size);
    const std::size_t placing = n * sizeof(Stored_waves) + Level::solved_bytes(coarser, !is_even);
    const std::size_t choosing = n * (sizeof(Seen_point) + sizeof(unsigned char) + sizeof(int)) +
                                 points * sizeof(Seen_point);
    return sum + (std::max)(placing, choosing);
  }

  void solve(float factor) override
  {
    for (std::size_t l = m_levels.size(); l-- > 0;) {
      Level& level = m_levels[l];
      Level* const coarser = l + 1 < m_levels.size() ? &m_levels[l + 1] : nullptr;
      const internal::Progress_part level_part(std::ldexp(1., -2 * int(l))); // of all nodes
      internal::Progress_part part(0.2);
      if (coarser) coarser->edges = {};
      level.scale = factor;
      level.find_neighbors(m_backend);
      part.next(0.4);
      if (level.axes.size() == 0)
        orient(level, coarser, coarser ? direction_sweeps : coarsest_sweeps);
      part.next(1);
      place(level, coarser, l == 0 ? last_wave_sweeps : wave_sweeps);
      if (coarser) coarser->release();
    }
  }

  Chosen_points points() override
  {
    const Lattice_view view = this->view();
    Buffer<Seen_point> seen, means;
    Buffer<unsigned char> is_chosen;
    Buffer<int> nodes;
    seen.allocate(m_backend, view.size);
    is_chosen.allocate(m_backend, view.free);
    m_backend.for_each(view.size, See_points{view, seen.data()});
    m_backend.for_each(view.free, Mark_chosen{{view, seen.data()}, is_chosen.data()});
    nodes.allocate(m_backend, view.free);
    const int size = m_backend.select(view.free, is_chosen.data(), nodes.data());
    means.allocate(m_backend, size);
    m_backend.for_each(size, Find_mean_points{view, seen.data(), nodes.data(), means.data()});
    Chosen_points chosen;
    chosen.nodes.resize(size);
    chosen.points.resize(size);
    m_backend.download(chosen.nodes.data(), nodes.data(), size);
    m_backend.download(chosen.points.data(), means.data(), size);
    return chosen;
  }

  std::size_t count_twins(const Chosen_points& points) override
  {
    const Placing placing(m_backend, view(), points, 0);
    Buffer<unsigned char> is_twin;
    Buffer<int> twins;
    is_twin.allocate(m_backend, points.nodes.size());
    twins.allocate(m_backend, points.nodes.size());
    const int size = static_cast<int>(points.nodes.size());
    m_backend.for_each(size, Mark_twin{placing.view(), is_twin.data()});
    return m_backend.select(size, is_twin.data(), twins.data());
  }

  std::vector<unsigned char> gaps(const Chosen_points& points) override
  {
    const Lattice_view view = this->view();
    const Placing placing(m_backend, view, points, view.size - view.free);
    Buffer<unsigned char> is_gap;
    is_gap.allocate(m_backend, view.free);
    m_backend.for_each(view.free, Mark_gap{placing.view(), is_gap.data()});
    std::vector<unsigned char> gaps(view.free);
    m_backend.download(gaps.data(), is_gap.data(), gaps.size());
    return gaps;
  }

  /// Of the finest level.
  Lattice_view view() { return m_levels.front().view(); }

private:
  // More make no better meshes (kitten, homer, fertility, rocker arm; n = 3000).
  static constexpr int coarsest_sweeps = 100, direction_sweeps = 10, wave_sweeps = 12,
                       last_wave_sweeps = 8;
  static constexpr float wave_acceleration = 1.6f; // without: 30 and 15 sweeps
  static constexpr int turning_sweeps = 3;
  static constexpr float neighbor_reach = 1.04f;    // of 4 nodes per point: 15 others are within
  static constexpr float cos_neighbor_angle = 0.2f; // nodes on the other side of a sheet are none

  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  /// An array of the nodes where the backend sees it.
  template <class T>
  class Given {
  public:
    void set(Backend& backend, const internal::Unset_vector<T>& from)
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
    Placing(Backend& backend, const Lattice_view& nodes, const Chosen_points& points, int sites)
        : m_nodes(nodes)
    {
      const int given = static_cast<int>(points.nodes.size()), size = given + sites;
      m_seen_from.allocate(backend, size);
      m_seen.allocate(backend, given);
      m_points.allocate(backend, size);
      m_distances.allocate(backend, size);
      backend.upload(m_seen_from.data(), points.nodes.data(), given);
      backend.upload(m_seen.data(), points.points.data(), given);
      backend.for_each(size, Place_points{nodes, given, m_seen.data(), m_seen_from.data(),
                                          m_points.data(), m_distances.data()});
      m_tree.emplace(backend, m_points.data(), size);
    }

    Placed_points view() const
    {
      return {m_nodes, m_tree->view(), m_seen_from.data(), m_distances.data()};
    }

  private:
    Lattice_view m_nodes;
    Buffer<int> m_seen_from;
    Buffer<Seen_point> m_seen;
    Buffer<Vec3d> m_points;
    Buffer<float> m_distances;
    std::optional<Point_tree<Backend, double>> m_tree;
  };

  struct Level {
    int size = 0, free = 0;
    Given<Vec3f> points, normals;
    Given<int> components;
    Given<float> spacing;
    float scale = 1, reach = 0;
    const Phasor* site_directions = nullptr; // where the nodes were given
    Given<unsigned char> is_directed;
    Buffer<Vec3f> turning, axes;
    Buffer<Lattice_edge> edges;
    Buffer<Stored_waves> waves;

    Lattice_view view()
    {
      Lattice_view v;
      v.size = size;
      v.free = free;
      v.points = points.data();
      v.normals = normals.data();
      v.components = components.data();
      v.node_spacing = spacing.data();
      v.scale = scale;
      v.edges = edges.data();
      v.turning = turning.size() > 0 ? turning.data() : nullptr;
      v.axes = axes.data();
      v.waves = waves.data();
      return v;
    }

    /// Calls `f(array, nodes' array)`, but for those of sites.
    template <class F>
    static void for_each_given(F&& f)
    {
      f(&Level::points, &Lattice_nodes::points);
      f(&Level::normals, &Lattice_nodes::normals);
      f(&Level::components, &Lattice_nodes::components);
      f(&Level::spacing, &Lattice_nodes::spacing);
    }
    // What n free nodes take on a device: as they come; in between; until the finer level has it.
    static std::size_t given_bytes(std::size_t n)
    {
      std::size_t bytes = 0;
      for_each_given([&](auto array, auto) { bytes += n * internal::item_size(array); });
      return bytes;
    }
    static std::size_t edges_bytes(std::size_t n)
    {
      return n * Lattice_view::degree * sizeof(Lattice_edge);
    }
    static std::size_t solved_bytes(std::size_t n, bool is_turning)
    {
      return n * ((is_turning ? 2 : 1) * sizeof(Vec3f) + sizeof(Stored_waves));
    }

    void set_nodes(Backend& backend, const Lattice_nodes& nodes, float neighbor_reach)
    {
      size = nodes.size();
      free = nodes.free;
      reach = neighbor_reach;
      for_each_given([&](auto to, auto from) { (this->*to).set(backend, nodes.*from); });
      site_directions = nodes.directions.data();
      is_directed.set(backend, nodes.is_directed);
    }

    void find_turning(Backend& backend)
    {
      turning.allocate(backend, size);
      backend.for_each(size, Set_turning{view()});
      Buffer<Vec3f> next_turning;
      next_turning.allocate(backend, size);
      for (int sweep = 0; sweep < turning_sweeps; ++sweep) {
        backend.for_each(size, Smooth_turning{view(), next_turning.data()});
        std::swap(turning, next_turning);
      }
    }

    /// If they are not known.
    void find_neighbors(Backend& backend)
    {
      if (edges.size() > 0) return;
      edges.allocate(backend, static_cast<std::size_t>(size) * Lattice_view::degree);
      const Point_tree tree(backend, points.data(), size);
      backend.for_each(tree.view().leaves(),
                       Find_lattice_neighbors{view(), tree.view(), cos_neighbor_angle, reach});
    }

    /// Frees what finer levels need no longer.
    void release()
    {
      turning = {};
      axes = {};
      waves = {};
    }
  };

  /// `coarser`: has axes; null: there is none.
  void orient(Level& level, Level* coarser, int sweeps)
  {
    level.axes.allocate(m_backend, level.size);
    if (m_is_turning) level.find_turning(m_backend);
    Buffer<Phasor> directions, next;
    for (Buffer<Phasor>* b : {&directions, &next}) b->allocate(m_backend, level.size);
    m_backend.upload(directions.data() + level.free, level.site_directions,
                     level.size - level.free);
    const Lattice_view view = level.view();
    if (coarser)
      m_backend.for_each(view.free, Refine_direction{coarser->view(), view, directions.data()});
    else
      m_backend.for_each(view.free, Draw_direction{view, m_seed, directions.data()});
    m_backend.for_each(view.size, Set_direction_edges{view});
    internal::Progress_part part(0);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      part.next((sweep + 1.) / sweeps);
      m_backend.for_each(view.size, Smooth_direction{view, directions.data(),
                                                     level.is_directed.data(), next.data()});
      std::swap(directions, next);
    }
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
    internal::Progress_part part(0);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      part.next((sweep + 1.) / sweeps);
      m_backend.for_each(
          view.free, Smooth_waves{level.view(), next.data(), sweep == 0 ? 1 : wave_acceleration});
      std::swap(level.waves, next);
    }
  }

  Backend& m_backend;
  bool m_is_turning;
  std::uint64_t m_seed;
  std::deque<Level> m_levels; // from fine to coarse
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_H
