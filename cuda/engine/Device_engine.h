// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps of Algorithms 1 to 3 over arrays on a device. The algorithms are those of
// `Host_engine`; `Backend` says how loops run, so that one code runs on the GPU and, for the tests,
// on the host.
#ifndef CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_H
#define CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_H

#include "../cells/cell_arrays.h"
#include "../optimization/Device_lbfgs.h"
#include "../optimization/Newton_solver.h"
#include "../surface/Device_surface.h"
#include "Summary_rule.h"
#include "sample_rules.h"

#include <CGAL/PowerRTF/cells/construct_cell.h>
#include <CGAL/PowerRTF/optimization/multiplicative_weights.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// Whether `Cells` does the passes of the paper's rule by itself.
template <class Cells, class = void>
struct Makes_weight_passes : std::false_type {
};
template <class Cells>
struct Makes_weight_passes<Cells, std::void_t<decltype(&Cells::start_weight_passes)>>
    : std::true_type {
};

/// \tparam Real what positions and cells are computed in; sums are double
/// \tparam Cells `Tree_cells` or another with its interface
template <class Real, class Backend, class Cells>
class Device_engine : public Device_engine_base
{
public:
  template <class... Arguments>
  Device_engine(const Device_surface_input& surface, const Remeshing_options& options,
                Arguments&&... backend)
      : m_options(options), m_cos_angle(cosine(options.normal_angle)),
        m_backend(std::forward<Arguments>(backend)...), m_surface(m_backend, surface),
        m_lbfgs(m_backend), m_long_lbfgs(m_backend), m_newton(m_backend), m_summary(m_backend)
  {
    if (options.lbfgs_memory > long_memory)
      throw Cuda_error("the CUDA traits keep at most " + std::to_string(long_memory) +
                       " pairs of L-BFGS");
    const int near = std::max(
        {options.normal_neighbors, options.density_neighbors, options.projection_neighbors});
    if (near > most_vertices && (options.attributes == Attributes::nearest_vertices ||
                                 options.projection == Projection::nearest_vertices))
      throw Cuda_error("the CUDA traits take at most " + std::to_string(most_vertices) +
                       " nearest vertices");
    m_summary_buffer.allocate(m_backend, 1);
    m_scalar.allocate(m_backend, 1);
  }

  void set_samples(const Device_samples& samples) override;
  void build_cells() override;
  void update_weights() override;
  bool optimize_weights(int passes) override;
  bool newton_weights() override;
  void clear_weights() override;
  void move_samples(Position_method method) override;
  void restore_best() override;
  Device_summary summary() override;
  std::size_t constructions() const override { return m_constructions; }
  Device_samples samples() override;
  Device_polygons polygons(int begin, int end) override;
  std::string device_name() const override { return m_backend.name(); }
  double seconds() override { return m_backend.seconds(); }
  std::size_t bytes() const override { return m_backend.bytes(); }

  static constexpr int short_memory = 5, long_memory = 10; // the default; and the most
  static constexpr int most_vertices = 32;                 // one for each lane of a warp

  // Public for the device compiler alone.
  void sort(const Device_samples& samples);
  void upload_boundaries(const Device_samples& samples);
  void update_attributes();
  void set_sites();
  void finish_cells();
  void center_weights();
  void weight_pass();
  void find_distances();
  void set_weights(const double* direction, double step);
  void start_summary();
  void choose_left_out();
  /// Whether there were any, and few enough.
  bool leave_out_vanishing(const Capacity_statistics& before);
  void copy_state(Site<Real>* to_sites, int* to_facets, const Site<Real>* sites, const int* facets);
  double remember_best();
  template <class Lbfgs>
  void find_lbfgs_steps(Lbfgs& lbfgs);
  void part_duplicates();
  template <class Step>
  void project(const Step& step);

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

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
  Usable_rule<Real> usable_rule()
  {
    return {m_area.data(), m_mass.data(), m_density.data(), m_status.data(), m_mean_mass};
  }
  Lloyd_step<Real> lloyd_step() { return {usable_rule(), m_offset.data()}; }
  /// Its mean mass is filled in on the device.
  Multiplicative_weight_rule weight_rule() const
  {
    return {m_options.capacity_tolerance, m_options.weight_step,
            m_options.weight_operator == Weight_operator::floor, 0};
  }
  bool has_short_memory() const { return m_options.lbfgs_memory <= short_memory; }
  static Real cosine(double degrees)
  {
    return degrees >= 180 ? Real(-2) : Real(std::cos(degrees * 3.14159265358979323846 / 180));
  }

  Sites_arrays<Real> sites()
  {
    Sites_arrays<Real> s;
    s.sites = m_sites.data();
    s.normals = m_normals.data();
    s.density_root = m_density_root.data();
    s.patches = m_has_patches ? m_patches.data() : nullptr;
    if (m_size > m_cells) {
      s.next = m_next.data();
      s.previous = m_previous.data();
    }
    s.cells = m_cells;
    s.sites_size = m_size;
    return s;
  }
  Cell_outputs<Real> outputs()
  {
    Cell_outputs<Real> out;
    out.area = m_area.data();
    out.mass = m_mass.data();
    out.offset = m_offset.data();
    out.status = m_status.data();
    return out;
  }

  Remeshing_options m_options;
  Real m_cos_angle;
  Backend m_backend;
  Device_surface<Real, Backend> m_surface;
  std::unique_ptr<Cells> m_cell_builder;
  Device_lbfgs<Real, Backend, short_memory> m_lbfgs;
  Device_lbfgs<Real, Backend, long_memory> m_long_lbfgs; // used when the other is too short
  Newton_solver<Real, Backend> m_newton;

  int m_cells = 0, m_size = 0; // n, and with the sites that only clip
  bool m_has_patches = false;
  std::vector<int> m_order;
  Buffer<Site<Real>> m_sites;
  Buffer<Vec3<Real>> m_normals;
  Buffer<int> m_facets, m_patches, m_next, m_previous;
  Buffer<Real> m_density, m_density_root; // rho_i; cube root of what weights the centroids
  Buffer<Real> m_area, m_mass;
  Buffer<Vec3<Real>> m_offset, m_step; // c_i - s_i; the next move
  Buffer<unsigned char> m_status;
  Buffer<Real> m_nearest, m_sixth; // distances, of the weight rule
  Buffer<Real> m_weights_before;   // of Newton's step
  Buffer<unsigned char> m_is_left_out; // of the capacities, by Newton's steps
  Buffer<double> m_scalar; // that kernels leave for each other

  struct Best_state { // where the residual of L-BFGS was least
    double residual = std::numeric_limits<double>::infinity();
    Buffer<Site<Real>> sites;
    Buffer<int> facets;
  } m_best;

  Buffer<Device_summary> m_summary_buffer;
  typename Backend::template Shared_item<Iteration_summary> m_summary; // when it is known
  double m_mean_mass = 0;             // of the first cells; 0: there was no look at them
  const int* m_passes_made = nullptr; // by the cell builder, where the summary shall tell
  bool m_is_summary_started = false, m_is_summary_known = false;
  bool m_are_cells_due = false; // until something needs them
  bool m_are_distances_known = false, m_are_components_known = false, m_is_left_out_known = false;
  std::size_t m_constructions = 0;
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#include "Device_engine_impl.h"
#include "Device_engine_samples.h"

#endif // CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_H
