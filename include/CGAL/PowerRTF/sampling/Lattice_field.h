// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fields of a lattice on the nodes of a hierarchy, found from coarse to fine.
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_H

#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/sampling/orientation_field.h>
#include <CGAL/PowerRTF/sampling/position_field.h>
#include <CGAL/PowerRTF/sampling/random_source.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace CGAL::PowerRTF {

/// Nodes as they come: first those that are free, in spatial order, then the sites on creases and
/// borders, which are points of the lattice.
struct Lattice_nodes {
  int free = 0;
  internal::Unset_vector<Vec3d> points;
  internal::Unset_vector<Vec3f> normals;     ///< unit
  internal::Unset_vector<int> components;    ///< of the surface
  internal::Unset_vector<float> spacing;     ///< h
  internal::Unset_vector<Phasor> directions; ///< of sites along a curve, six times the angle
  internal::Unset_vector<unsigned char> is_directed; ///< the direction stays

  int size() const { return static_cast<int>(points.size()); }
  void resize(std::size_t n)
  {
    points.resize(n);
    normals.resize(n);
    components.resize(n);
    spacing.resize(n);
    directions.resize(n);
    is_directed.resize(n);
  }
};

/// Each level is solved from the next coarser one's result by Jacobi's sweeps, so the fields are
/// the same for any number of threads.
template <class Backend>
class Lattice_field {
public:
  /// `levels`: from fine to coarse; free nodes of all levels are in the same order along the
  /// surface. A backend of the host keeps references to them.
  /// `is_even`: the spacing is the same everywhere.
  Lattice_field(Backend& backend, const std::vector<Lattice_nodes>& levels, bool is_even,
                std::uint64_t seed)
      : m_backend(backend), m_seed(seed)
  {
    float reach = neighbor_reach;
    for (const Lattice_nodes& nodes : levels) {
      m_levels.emplace_back();
      m_levels.back().set_nodes(m_backend, nodes, reach);
      if (!is_even) m_levels.back().find_turning(m_backend);
      reach *= 2;
    }
  }

  /// The directions of the rows.
  void orient()
  {
    for (std::size_t l = m_levels.size(); l-- > 0;) {
      const internal::Progress_part level_part(share_down_to(l));
      internal::Progress_part part(0.2);
      Level& level = m_levels[l];
      const Lattice_view view = level.view();
      if (l + 1 == m_levels.size())
        m_backend.for_each(view.free, Draw_direction{view, m_seed});
      else
        m_backend.for_each(view.free, Refine_direction{m_levels[l + 1].view(), view});
      m_backend.for_each(view.size, Set_direction_edges{view});
      level.next_directions.allocate(m_backend, view.size);
      const bool is_coarsest = l + 1 == m_levels.size();
      const int sweeps = is_coarsest ? coarsest_sweeps : direction_sweeps;
      for (int sweep = 0; sweep < sweeps; ++sweep) {
        part.next(0.2 + 0.8 * (sweep + 1) / sweeps);
        m_backend.for_each(view.size, Smooth_direction{level.view(), level.is_directed.data(),
                                                       level.next_directions.data()});
        std::swap(level.directions, level.next_directions);
      }
      level.next_directions = {};
      m_backend.for_each(view.size, Set_axis{level.view()});
    }
  }

  /// The places of the points, for all spacings times `factor`.
  void place(float factor)
  {
    for (std::size_t l = m_levels.size(); l-- > 0;) {
      const internal::Progress_part level_part(share_down_to(l));
      internal::Progress_part part(0.2);
      Level& level = m_levels[l];
      for (Buffer<Waves>* waves : {&level.waves, &level.next_waves}) {
        waves->allocate(m_backend, level.size);
        m_backend.for_each(level.size, Set_crests{waves->data()}); // what sites have
      }
      const Lattice_view view = level.view();
      m_backend.for_each(view.size,
                         Scale_spacing{level.nodes_spacing.data(), factor, level.spacing.data()});
      if (l + 1 == m_levels.size())
        m_backend.for_each(view.free, Set_crests{view.waves});
      else
        m_backend.for_each(view.free, Refine_waves{m_levels[l + 1].view(), view});
      m_backend.for_each(view.size, Set_wave_edges{view});
      const int sweeps = l == 0 ? last_wave_sweeps : wave_sweeps;
      for (int sweep = 0; sweep < sweeps; ++sweep) {
        part.next(0.2 + 0.8 * (sweep + 1) / sweeps);
        m_backend.for_each(view.free, Smooth_waves{level.view(), level.next_waves.data(),
                                                   sweep == 0 ? 1 : wave_acceleration});
        std::swap(level.waves, level.next_waves);
      }
      level.next_waves = {};
    }
  }

  /// Of the finest level.
  Lattice_view view() { return m_levels.front().view(); }

private:
  // More make no better meshes (kitten, homer, fertility, rocker arm; n = 3000).
  static constexpr int coarsest_sweeps = 100, direction_sweeps = 10, wave_sweeps = 12,
                       last_wave_sweeps = 6;
  static constexpr float wave_acceleration = 1.6f; // without: 30 and 15 sweeps
  static constexpr int turning_sweeps = 3;
  static constexpr float neighbor_reach = 0.85f;    // of 6 nodes per point: 15 others are within
  static constexpr float cos_neighbor_angle = 0.2f; // nodes on the other side of a sheet are none

  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  /// Of the work on all levels, that on the coarse ones down to `level`.
  static double share_down_to(std::size_t level) { return std::ldexp(1., -2 * int(level)); }

  /// The direction in which a random vector points: no choice of frames has a part in it.
  struct Draw_direction {
    Lattice_view view;
    std::uint64_t seed;
    CGAL_POWER_RTF_HD void operator()(int i) const
    {
      const auto coordinate = [&](int k) { return float(counted_random(seed, i, k)) - 0.5f; };
      const Vec3f v{coordinate(0), coordinate(1), coordinate(2)};
      const Tangent_frame<float> frame(view.normals[i]);
      view.directions[i] = unit(sixth_power(unit({dot(v, frame.u), dot(v, frame.v)})));
    }
  };
  /// The node is a point of the lattice.
  struct Set_crests {
    Waves* waves;
    CGAL_POWER_RTF_HD void operator()(int i) const { waves[i] = {{{1, 0}, {1, 0}, {1, 0}}}; }
  };
  struct Scale_spacing {
    const float* from;
    float factor;
    float* to;
    CGAL_POWER_RTF_HD void operator()(int i) const { to[i] = factor * from[i]; }
  };
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

  struct Level {
    int size = 0, free = 0;
    Given<Vec3d> points;
    Given<Vec3f> normals;
    Given<int> components;
    Given<float> nodes_spacing;
    Given<unsigned char> is_directed;
    Buffer<Vec3f> turning, axes;
    Buffer<float> spacing;
    Buffer<Phasor> directions, next_directions;
    Buffer<Waves> waves, next_waves;
    Buffer<Lattice_edge> edges;

    Lattice_view view()
    {
      Lattice_view v;
      v.size = size;
      v.free = free;
      v.points = points.data();
      v.normals = normals.data();
      v.components = components.data();
      v.spacing = spacing.data();
      v.edges = edges.data();
      v.turning = turning.size() > 0 ? turning.data() : nullptr;
      v.directions = directions.data();
      v.axes = axes.data();
      v.waves = waves.data();
      return v;
    }

    void set_nodes(Backend& backend, const Lattice_nodes& nodes, float reach)
    {
      size = nodes.size();
      free = nodes.free;
      points.set(backend, nodes.points);
      normals.set(backend, nodes.normals);
      components.set(backend, nodes.components);
      nodes_spacing.set(backend, nodes.spacing);
      is_directed.set(backend, nodes.is_directed);
      spacing.allocate(backend, size);
      backend.upload(spacing.data(), nodes.spacing.data(), size);
      directions.allocate(backend, size);
      backend.upload(directions.data(), nodes.directions.data(), size);
      axes.allocate(backend, size);
      edges.allocate(backend, static_cast<std::size_t>(size) * Lattice_view::degree);
      find_neighbors(backend, reach);
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

    void find_neighbors(Backend& backend, float reach)
    {
      const Point_tree<Backend> tree(backend, points.data(), size);
      backend.for_each(tree.view().leaves(),
                       Find_lattice_neighbors{view(), tree.view(), cos_neighbor_angle, reach});
    }
  };

  Backend& m_backend;
  std::uint64_t m_seed;
  std::deque<Level> m_levels; // from fine to coarse
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_FIELD_H
