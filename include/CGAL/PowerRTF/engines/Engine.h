// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps of Algorithms 1 to 3 over all samples at once: the one engine, over a backend that says
// where the arrays lie and how loops run, and a construction of the cells.
#ifndef CGAL_POWER_RTF_ENGINES_ENGINE_H
#define CGAL_POWER_RTF_ENGINES_ENGINE_H

#include <CGAL/PowerRTF/cells/Cell_arrays.h>
#include <CGAL/PowerRTF/engines/Engine_base.h>
#include <CGAL/PowerRTF/engines/Engine_mesh.h>
#include <CGAL/PowerRTF/engines/nearest_facets.h>
#include <CGAL/PowerRTF/engines/placed_samples.h>
#include <CGAL/PowerRTF/engines/sample_rules.h>
#include <CGAL/PowerRTF/engines/sound_stars.h>
#include <CGAL/PowerRTF/geometry/Surface_arrays.h>
#include <CGAL/PowerRTF/geometry/Surface_in_tree.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/optimization/Newton_solver.h>
#include <CGAL/PowerRTF/optimization/position_steps.h>
#include <CGAL/PowerRTF/optimization/weight_steps.h>
#include <CGAL/PowerRTF/sampling/Lattice_field.h>
#include <CGAL/PowerRTF/smoothing/Star_sweeps.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// The result is the same bit for bit for any number of threads.
///
/// \tparam Real what positions and cells are computed in; sums are double
/// \tparam Backend a model of `PowerRTFBackend`
/// \tparam Cells a model of `PowerRTFCells`
template <class Real, class Backend, class Cells>
class Engine final : public Engine_base {
public:
  /// `backend`: the arguments of the backend's constructor.
  template <class... Arguments>
  Engine(const Surface_in_tree& surface, const Remeshing_options& options, Arguments&&... backend)
      : m_options(options), m_cos_angle(Real(compatibility_cosine(options.normal_angle))),
        m_resident(surface.resident), m_backend(std::forward<Arguments>(backend)...),
        m_surface(m_backend, surface), m_area_of_surface(surface.area), m_shared_summary(m_backend)
  {
    m_summary.allocate(m_backend, 1);
    m_scalar.allocate(m_backend, 1);
  }

  /// The most memory that a run holds at a time on a device, its backend's own included; see
  /// Engine_memory.h.
  static std::size_t bytes(const Run_sizes& sizes, const Remeshing_options& options);

  /// Of n cells and the sites that clip them, but for what only some methods need; see
  /// listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t cells, std::size_t sites, bool has_patches,
                             bool has_features)
  {
    using E = Engine;
    f(&E::m_sites, sites);
    f(&E::m_normals, sites);
    f(&E::m_facets, sites);
    if (has_patches) f(&E::m_patches, sites);
    if (has_features)
      for (auto array : {&E::m_next, &E::m_previous}) f(array, sites);
    for (auto array : {&E::m_density, &E::m_density_root}) f(array, sites);
    for (auto array : {&E::m_area, &E::m_mass, &E::m_nearest, &E::m_sixth, &E::m_weights_before})
      f(array, cells);
    for (auto array : {&E::m_offset, &E::m_step}) f(array, cells);
    for (auto array : {&E::m_status, &E::m_is_left_out}) f(array, cells);
  }

  std::unique_ptr<Lattice_field_base> make_lattice_field(const Lattice_plan& plan) override
  {
    return std::make_unique<Lattice_field<Backend>>(m_backend, m_surface.view(), plan);
  }
  std::optional<std::size_t> place_candidates(Lattice_field_base& field, std::size_t n) override;
  int set_samples(const Engine_samples& samples) override;
  void build_cells() override;
  bool optimize_weights(int passes) override;
  bool newton_weights() override;
  void clear_weights() override;
  void move_samples(Position_method method) override;
  void restore_best() override;
  Cell_summary summary() override;
  std::size_t constructions() const override { return m_constructions; }
  Samples samples() override;
  std::vector<Cell_polygon> cells() override;
  Neighbor_cycles neighbors() override;
  void release_memory() override;
  Bring_mesh mesh_bringer() override
  {
    if constexpr (Backend::is_host)
      return {};
    else
      return [this](const Mesh_arrays& mesh) -> std::shared_ptr<Resident_mesh> {
        using Mesh = Engine_mesh<Real, Backend>;
        if (m_mesh) m_mesh->release();
        m_mesh.reset();
        if (m_backend.has_room(internal::bytes_of_listed<Mesh>(mesh)))
          m_mesh = std::make_shared<Mesh>(m_backend, m_surface, mesh);
        return m_mesh;
      };
  }
  Find_sound_stars sound_star_finder() override
  {
    if constexpr (Backend::is_host)
      return {};
    else
      return
          [this](const Surface& surface, const Cell_triangles& triangles, unsigned char* is_sound) {
            return internal::find_sound_stars(m_backend, surface, triangles, is_sound);
          };
  }
  Find_facets facet_finder() override
  {
    if constexpr (Backend::is_host)
      return {};
    else
      return
          [this](int n, const Vec3d* points, const Vec3d* normals, double cos_angle, int* places) {
            return internal::nearest_facets(m_backend, m_surface.view(), n, points, normals,
                                            cos_angle, places);
          };
  }
  Make_star_sweeps star_sweeps_maker() override
  {
    if constexpr (Backend::is_host)
      return {};
    else
      return
          [this](const Surface_descent& surface, double grid) -> std::unique_ptr<Star_sweeps_base> {
            const std::optional<Surface_descent> there = m_surface.descent(m_backend, surface);
            if (!there) return nullptr;
            return std::make_unique<Star_sweeps<Backend>>(m_backend, *there, grid);
          };
  }
  double epsilon() const override { return std::numeric_limits<Real>::epsilon(); }
  Device_report device_report() override
  {
    std::size_t bytes = m_backend.bytes();
    if constexpr (!Backend::is_host)
      if (internal::are_facets_there(m_backend, m_resident.get())) bytes += m_resident->bytes;
    return {m_backend.name(), m_backend.seconds(), bytes};
  }

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;
  static constexpr int short_memory = 5; // of L-BFGS: the default

  void make_builder();
  /// Made anew if its memory has been released.
  Cells& builder();
  void upload_cells(const Engine_samples& samples);
  /// The placed samples along a curve that fills their cube; they are the ones with cells.
  void sort();
  void upload_others(const Engine_samples& samples);
  void update_attributes();
  /// The sites have moved.
  void set_sites();
  void update_weights();
  void use_weights();
  /// Makes the cells that `build_cells()` has promised.
  void finish_cells();
  void start_summary();
  void forget_summary() { m_is_summary_known = m_is_summary_started = false; }
  void find_distances();
  void choose_left_out();
  /// Returns the residual over the least one so far.
  double remember_best();
  template <class Step>
  void project(const Step& step);

  bool has_features() const { return m_size > m_cells; }
  /// Calls `f(lbfgs)`.
  template <class F>
  void with_lbfgs(F&& f);
  void forget_lbfgs()
  {
    m_lbfgs.reset();
    m_long_lbfgs.reset();
  }
  void forget_newton()
  {
    m_newton.reset();
    m_are_edges_wanted = m_are_edges_known = m_are_components_known = false;
  }
  Newton_solver<Real, Backend>& newton()
  {
    return m_newton ? *m_newton : m_newton.emplace(m_backend);
  }
  Attribute_rule<Real> attribute_rule()
  {
    return {m_surface.view(),
            m_normals.data(),
            m_density.data(),
            m_density_root.data(),
            m_options.attributes == Attributes::facet,
            m_options.normal_neighbors,
            m_options.density_neighbors,
            m_cos_angle,
            Real(m_options.centroid_density_power)};
  }
  Usable_cells<Real> usable_cells() const
  {
    return {m_area.data(), m_mass.data(), m_density.data(), m_status.data(), m_mean_mass};
  }
  /// The mean mass is that of the summary.
  Multiplicative_weight_rule weight_rule() const
  {
    return {m_options.capacity_tolerance, m_options.weight_step,
            m_options.weight_operator == Weight_operator::floor, 0};
  }
  Sites_arrays<Real> sites();
  Cell_outputs<Real> outputs();

  Remeshing_options m_options;
  Real m_cos_angle;
  std::shared_ptr<const Resident_surface> m_resident; // or null; until the backend has done all
  Backend m_backend;
  Surface_arrays<Real, Backend> m_surface;
  double m_area_of_surface;
  std::shared_ptr<Resident_mesh> m_mesh; // the last one; or null
  std::optional<Cells> m_builder;
  // Made when they are needed.
  std::optional<Lbfgs<Real, Backend, short_memory>> m_lbfgs;
  std::optional<Lbfgs<Real, Backend, max_lbfgs_memory>> m_long_lbfgs; // if the other is too short
  std::optional<Newton_solver<Real, Backend>> m_newton;

  Placed_samples<Real, Backend> m_placed; // to come
  int m_cells = 0, m_size = 0;            // n, and with the sites that only clip
  bool m_has_patches = false;
  Buffer<Site<Real>> m_sites;
  Buffer<Vec3<Real>> m_normals;
  Buffer<int> m_facets, m_patches;
  Buffer<int> m_next, m_previous;         // see `clip_at_features()`
  Buffer<Real> m_density, m_density_root; // rho_i; cube root of what weights the centroids
  Buffer<Real> m_area, m_mass;
  Buffer<Vec3<Real>> m_offset, m_step; // c_i - s_i; the next move
  Buffer<unsigned char> m_status;
  Buffer<Real> m_nearest, m_sixth;     // distances, of the weight rule
  Buffer<Real> m_weights_before;       // of Newton's step
  Buffer<unsigned char> m_is_left_out; // of the capacities, by Newton's steps
  Buffer<double> m_scalar;             // that one loop leaves for the next

  struct Best_state { // where the residual of L-BFGS was least; empty before
    double residual = std::numeric_limits<double>::infinity();
    Buffer<Site<Real>> sites;
    Buffer<int> facets;

    template <class F>
    static void for_each_array(F&& f, std::size_t sites)
    {
      f(&Best_state::sites, sites);
      f(&Best_state::facets, sites);
    }
  } m_best;

  Buffer<Cell_summary> m_summary;
  typename Backend::template Shared_item<Cell_summary> m_shared_summary; // when it is known
  double m_mean_mass = 0;             // of the first cells; 0: there was no look at them
  const int* m_passes_made = nullptr; // by the builder, where the summary shall tell
  bool m_is_summary_started = false, m_is_summary_known = false;
  bool m_are_cells_due = false;                               // until something needs them
  bool m_are_edges_wanted = false, m_are_edges_known = false; // of the cells, by Newton's steps
  bool m_are_distances_known = false, m_are_components_known = false, m_is_left_out_known = false;
  bool m_has_newton_overshot = false;
  Newton_goal m_newton_goal = local_newton_goal;
  std::size_t m_constructions = 0;
};

} // namespace CGAL::PowerRTF

#include <CGAL/PowerRTF/engines/Engine_memory.h>
#include <CGAL/PowerRTF/engines/Engine_samples.h>
#include <CGAL/PowerRTF/engines/Engine_steps.h>

#endif // CGAL_POWER_RTF_ENGINES_ENGINE_H
