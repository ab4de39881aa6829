// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// PowerRTF: power diagram based restricted tangent faces for surface remeshing (Yao et al.). This
// file is Algorithm 3 of the paper; the geometry is in the engine that the traits name.
#ifndef CGAL_POWER_RTF_REMESHER_H
#define CGAL_POWER_RTF_REMESHER_H

#include <CGAL/PowerRTF/PowerRTF_traits_3.h>
#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/Remeshing_visitor.h>
#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/extraction/extract_restricted_delaunay.h>
#include <CGAL/PowerRTF/extraction/improve_mesh.h>
#include <CGAL/PowerRTF/internal/Stopwatch.h>
#include <CGAL/PowerRTF/quality/assess.h>
#include <CGAL/PowerRTF/surface/initial_sampling.h>
#include <CGAL/PowerRTF/surface/smooth_normals.h>

#include <utility>

namespace CGAL {

/// Distributes samples on a surface by their restricted tangent faces and triangulates them.
///
/// \tparam Traits a model of `PowerRTFTraits_3`.
template <class Traits>
class PowerRTF_remesher {
public:
  using Options = PowerRTF::Remeshing_options;
  using Report = PowerRTF::Remeshing_report;
  using Engine = typename Traits::Engine;

  /// `surface`: from `import_surface()`, its density set. \throws Invalid_input_error when an
  /// option has no meaning for it.
  PowerRTF_remesher(PowerRTF::Surface surface, const Options& options)
      : m_surface(std::move(surface)), m_options(options), m_engine(m_surface, m_options)
  {
    m_report.samples_asked = options.number_of_samples;
    PowerRTF::smooth_normals(m_surface, options.number_of_samples, options.normal_smoothing);
  }

  PowerRTF_remesher(const PowerRTF_remesher&) = delete; // the engine refers to the surface
  PowerRTF_remesher& operator=(const PowerRTF_remesher&) = delete;

  /// Distributes the samples (Algorithm 3, lines 2 to 21). Returns `false` when `visitor` stopped it.
  template <class Visitor>
  bool optimize(Visitor& visitor)
  {
    sample(visitor);
    visitor.on_stage("optimization");
    PowerRTF::internal::Stopwatch watch(m_report.seconds.optimization);
    for (int iteration = 0; iteration < iterations() && !m_report.cancelled; ++iteration) { // 5
      m_engine.build_cells();                                                             // 8, 9
      const bool relaxation = iteration < m_options.relaxation_iterations;
      const bool equal = !relaxation && optimize_weights();                          // 11 to 14
      finish_iteration(visitor, iteration);
      if (equal) break;
      m_engine.move_samples(relaxation ? PowerRTF::Position_method::lloyd
                                       : m_options.position_method);                 // 15 to 19
    }
    if (!m_report.cancelled) equalize_capacities();
    m_report.constructions = m_engine.constructions();
    m_report.cells = m_engine.cell_counts();
    m_report.capacity = m_engine.capacity();
    return !m_report.cancelled;
  }

  /// Triangulates the samples (Algorithm 3, line 22), improves the mesh unless
  /// `Improvement::no`, and judges the result.
  template <class Visitor>
  PowerRTF::Extracted_mesh extract(Visitor& visitor)
  {
    visitor.on_stage("extraction");
    PowerRTF::Extracted_mesh mesh;
    {
      PowerRTF::internal::Stopwatch watch(m_report.seconds.extraction);
      const PowerRTF::Samples samples = m_engine.samples();
      mesh = m_options.extraction == PowerRTF::Extraction_method::insertion
                 ? PowerRTF::extract_by_insertion(m_surface, samples)
                 : PowerRTF::extract_restricted_delaunay(m_surface, samples);
    }
    if (m_options.improvement == PowerRTF::Improvement::yes) {
      visitor.on_stage("improvement");
      PowerRTF::internal::Stopwatch watch(m_report.seconds.improvement);
      PowerRTF::improve_mesh(m_surface, mesh);
    }
    visitor.on_stage("quality");
    PowerRTF::internal::Stopwatch watch(m_report.seconds.quality);
    PowerRTF::assess<typename Traits::Concurrency_tag>(m_surface, mesh, m_report);
    return mesh;
  }

  const PowerRTF::Surface& surface() const { return m_surface; }
  const Options& options() const { return m_options; }
  const Report& report() const { return m_report; }
  Report& report() { return m_report; }
  /// The current samples, in the order of the output's vertices.
  PowerRTF::Samples samples() const { return m_engine.samples(); }
  /// The cells of the current samples and weights.
  std::vector<PowerRTF::Cell_polygon> cells() { return m_engine.cells(); }

private:
  using Weight_method = PowerRTF::Weight_method;

  int iterations() const { return m_options.relaxation_iterations + m_options.max_iterations; }

  /// Algorithm 3, lines 2 to 4.
  template <class Visitor>
  void sample(Visitor& visitor)
  {
    visitor.on_stage("sampling");
    PowerRTF::internal::Stopwatch watch(m_report.seconds.sampling);
    m_engine.set_samples(PowerRTF::sample_surface(m_surface, m_options));
  }

  bool inside_interval() const { return m_engine.capacity().inside_interval == 1; }

  /// Algorithm 2. Returns whether all capacities are inside the interval.
  bool optimize_weights()
  {
    if (m_options.weight_method != Weight_method::multiplicative) return false;
    for (int pass = 0; pass < m_options.max_weight_iterations && !inside_interval(); ++pass) {
      m_engine.update_weights();
      m_engine.build_cells();
    }
    return inside_interval();
  }

  /// The weights once the samples are in place, by Newton's method.
  void equalize_capacities()
  {
    m_engine.build_cells();
    if (m_options.position_method == PowerRTF::Position_method::lbfgs) m_engine.restore_best();
    if (m_options.weight_method != Weight_method::newton) return;
    for (int pass = 0; pass < m_options.max_weight_iterations && !inside_interval(); ++pass)
      if (!m_engine.newton_weights()) break;
  }

  template <class Visitor>
  void finish_iteration(Visitor& visitor, int iteration)
  {
    m_report.outer_iterations = iteration + 1;
    m_report.iterations.push_back({m_engine.constructions(), m_engine.cell_counts(),
                                   m_engine.capacity(), m_engine.displacement()});
    visitor.on_iteration(m_report.iterations.back(), double(iteration + 1) / iterations());
    m_report.cancelled = !visitor.go_further();
  }

  PowerRTF::Surface m_surface;
  Options m_options;
  Engine m_engine;
  Report m_report;
};

} // namespace CGAL

#endif // CGAL_POWER_RTF_REMESHER_H
