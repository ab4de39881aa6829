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
#include <CGAL/PowerRTF/extraction/Opened_surface.h>
#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/extraction/extract_from_cells.h>
#include <CGAL/PowerRTF/extraction/extract_restricted_delaunay.h>
#include <CGAL/PowerRTF/extraction/mesh_patches.h>
#include <CGAL/PowerRTF/extraction/mirrored_mesh.h>
#include <CGAL/PowerRTF/features/Surface_patches.h>
#include <CGAL/PowerRTF/features/move_off_kept_edges.h>
#include <CGAL/PowerRTF/features/split_off_image.h>
#include <CGAL/PowerRTF/fields/resolution.h>
#include <CGAL/PowerRTF/improvement/coarsen_mesh.h>
#include <CGAL/PowerRTF/improvement/improve_mesh.h>
#include <CGAL/PowerRTF/internal/Background_work.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/Stage.h>
#include <CGAL/PowerRTF/internal/Stopwatch.h>
#include <CGAL/PowerRTF/option_table.h>
#include <CGAL/PowerRTF/quality/assess.h>
#include <CGAL/PowerRTF/sampling/sample_surface.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

namespace CGAL {

/// \ingroup PkgPowerRTFRef
/// Distributes samples on a surface by their restricted tangent faces and triangulates them. With
/// `Remeshing_options::symmetry` these are samples of one half of the surface.
///
/// \tparam Traits a model of `PowerRTFTraits_3`.
template <class Traits>
class PowerRTF_remesher {
public:
  using Options = PowerRTF::Remeshing_options;
  using Report = PowerRTF::Remeshing_report;
  using Engine = typename Traits::Engine;

  /// `surface`: from `prepare_surface()`, and `report` what that has begun. \throws
  /// Invalid_input_error when an option has a value that is not allowed, or the samples are too few
  /// for the surface, or it is not as symmetric as it has to be.
  PowerRTF_remesher(PowerRTF::Surface surface, const Options& options, const Report& report = {})
      : m_surface(std::move(surface)), m_options(with_number_of_samples(options, report)),
        m_report(report), m_watch(std::in_place, m_report.seconds.surface),
        m_whole(PowerRTF::split_off_image(m_surface, m_options, m_report,
                                          typename Traits::Concurrency_tag())),
        m_patches(m_surface, m_options, typename Traits::Concurrency_tag(),
                  Engine::surface_work(m_options)),
        m_engine(m_patches.surface(), m_options)
  {
    if (!m_whole) m_report.samples_asked = m_options.number_of_samples;
    m_report.min_angle = m_options.min_angle;
    m_report.max_angle = m_options.max_angle;
    m_report.feature_samples = m_patches.features().size();
    m_watch.reset();
  }

  PowerRTF_remesher(const PowerRTF_remesher&) = delete; // the engine refers to the surface
  PowerRTF_remesher& operator=(const PowerRTF_remesher&) = delete;

  /// Distributes the samples (Algorithm 3, lines 2 to 21). Returns `false` when `visitor` stopped
  /// it.
  template <class Visitor>
  bool optimize(Visitor& visitor)
  {
    if (!PowerRTF::internal::run_unless_cancelled(visitor, [&] { distribute(visitor); }))
      m_report.cancelled = true;
    return !m_report.cancelled;
  }

  /// Triangulates the samples (Algorithm 3, line 22), improves the mesh unless
  /// `Improvement::no`, and judges the result. Where a largest distance is asked for, but no
  /// density, and all guarantees are met, it then takes out the vertices that can be spared.
  /// Returns an empty mesh, and the report says `cancelled`, when `visitor` stopped it.
  template <class Visitor>
  PowerRTF::Extracted_mesh extract(Visitor& visitor)
  {
    return extract(visitor, PowerRTF::is_coarsened(m_options, surface()));
  }
  /// The same, but all samples become vertices.
  template <class Visitor>
  PowerRTF::Extracted_mesh extract_all(Visitor& visitor)
  {
    return extract(visitor, false);
  }

  const PowerRTF::Surface& surface() const { return m_whole ? *m_whole : m_surface; }
  /// The plane about which the result is symmetric, in the unit box: samples and cells are those
  /// above it (`with_images()` adds the others); none without `Remeshing_options::symmetry`.
  const std::optional<PowerRTF::Mirror_plane>& mirror() const { return m_surface.mirror; }
  /// With the number of the samples that are distributed.
  const Options& options() const { return m_options; }
  const Report& report() const { return m_report; }
  Report& report() { return m_report; }
  /// The current samples, in the order of the output's vertices, but for those that were taken out:
  /// those with cells, then those of `features()`.
  PowerRTF::Samples samples() const { return with_features(m_engine.samples()); }
  /// The sites of the cells: the samples that have one, then the copies of those of `features()`,
  /// one for each patch at them.
  PowerRTF::Samples sites() const { return m_engine.sites(); }
  /// The samples that do not move: on creases and borders, and at vertices that are to stay.
  const PowerRTF::Feature_samples& features() const { return m_patches.features(); }
  /// The cells of the current samples and weights; their neighbors are numbers of sites.
  std::vector<PowerRTF::Cell_polygon> cells() { return m_engine.cells(); }
  /// The fields of the lattice that the samples begin as. \throws Invalid_input_error when
  /// `Options::sampling` is not `lattice`
  PowerRTF::Lattice_fields lattice_fields()
  {
    return PowerRTF::lattice_fields<typename Traits::Concurrency_tag>(
        m_patches.surface(), m_options, m_patches.features(), m_engine.facet_tree());
  }
  /// The patch of each triangle of `mesh`, a result of `extract()`: numbers from 0, in the order of
  /// the surface's facets, or, with a symmetry, of the triangles.
  std::vector<int> patches(const PowerRTF::Extracted_mesh& mesh) const
  {
    using Tag = typename Traits::Concurrency_tag;
    return m_whole ? PowerRTF::mesh_parts(mesh, Tag()).first
                   : PowerRTF::mesh_patches(mesh, m_patches.surface(), Tag());
  }
  /// Brings meshes to where the engine works; empty: on the host. It lives as long as this.
  PowerRTF::Bring_mesh mesh_bringer() { return m_engine.mesh_bringer(); }
  /// The precision of the cells' numbers: the machine epsilon of double, or of float.
  double epsilon() const { return m_engine.epsilon(); }

private:
  using Weight_method = PowerRTF::Weight_method;
  using Weights_end = PowerRTF::Weights_end;
  using Progress_part = PowerRTF::internal::Progress_part;
  using Stage = PowerRTF::internal::Stage;

  /// The options, with the n that `prepare_surface()` has found.
  static Options with_number_of_samples(Options options, const Report& report)
  {
    PowerRTF::validate(options);
    if (PowerRTF::is_number_of_samples_open(options))
      options.number_of_samples = report.samples_asked;
    return PowerRTF::validate(options);
  }

  bool all_fixed() const { return m_patches.features().size() == m_options.number_of_samples; }
  int iterations() const { return m_options.relaxation_iterations + m_options.max_iterations; }

  /// The share of the iterations in the optimization's progress, before Newton's method.
  double iterations_share() const
  {
    return m_options.weight_method == Weight_method::newton ? 0.8 : 1;
  }

  /// Algorithm 3, lines 2 to 21.
  template <class Visitor>
  void distribute(Visitor& visitor)
  {
    m_report.cancelled = false;
    sample();
    const Stage stage("optimization", m_report.seconds.optimization);
    prepare_improvement();
    for (int iteration = 0; !all_fixed(); ++iteration) { // 5
      const Progress_part part(iterations_share() * (iteration + 1) / (iterations() + 1));
      m_engine.build_cells(); // 8, 9
      const bool relaxation = iteration < m_options.relaxation_iterations;
      const bool done = !relaxation && optimize_weights(); // 11 to 14
      if (iteration == iterations()) break;
      finish_iteration(visitor, iteration);
      if (m_report.cancelled || done || (!relaxation && has_settled())) break;
      m_engine.move_samples(relaxation ? PowerRTF::Position_method::lloyd
                                       : m_options.position_method); // 15 to 19
    }
    if (!m_report.cancelled && !all_fixed()) equalize_capacities();
    m_report.constructions = m_engine.constructions();
    m_report.cells = m_engine.cell_counts();
    m_report.capacity = m_engine.capacity();
    m_report.device = m_engine.device_report();
    if (m_report.cancelled) throw PowerRTF::internal::Run_cancelled();
  }

  /// Algorithm 3, lines 2 to 4.
  void sample()
  {
    const Stage stage("sampling", m_report.seconds.sampling);
    const PowerRTF::Feature_samples& features = m_patches.features();
    Progress_part part(0.1);
    const PowerRTF::Facet_tree& tree = m_engine.facet_tree();
    part.next(0.85);
    const PowerRTF::Samples samples = PowerRTF::sample_surface<typename Traits::Concurrency_tag>(
        m_patches.surface(), m_options, features, &tree, &m_report.off_lattice_samples,
        m_engine.lattice_field_maker(), m_engine.facet_finder(), m_engine.candidate_placer());
    part.next(1);
    m_engine.set_samples(samples, features);
    m_report.iterations.clear();
  }

  /// In the background, where the engine leaves the host idle: it works elsewhere.
  void prepare_improvement()
  {
    if (m_options.improvement == PowerRTF::Improvement::no || !m_engine.star_sweeps_maker()) return;
    const typename Traits::Concurrency_tag concurrency;
    m_preparation.emplace(concurrency, [this, concurrency] {
      m_prepared = PowerRTF::prepare_improvement(m_patches.surface(), m_engine.facet_tree(),
                                                 m_options.number_of_samples, concurrency);
    });
  }

  /// The engine's samples on the whole surface, then those on creases and borders.
  PowerRTF::Samples with_features(PowerRTF::Samples samples) const
  {
    return PowerRTF::joined(m_patches.on_whole(std::move(samples)), m_patches.features().samples);
  }

  template <class Visitor>
  PowerRTF::Extracted_mesh extract(Visitor& visitor, bool is_coarsened)
  {
    PowerRTF::Extracted_mesh result;
    m_report.cancelled = !PowerRTF::internal::run_unless_cancelled(visitor, [&] {
      PowerRTF::Extracted_mesh mesh = triangulated_samples();
      if (is_coarsened) {
        result = judged(PowerRTF::Extracted_mesh(mesh));
        coarsen(mesh, result);
      } else {
        result = judged(std::move(mesh));
      }
    });
    m_report.device = m_engine.device_report(); // with what was held since
    return result;
  }

  /// Algorithm 3, line 22; of the half, if that is all that is remeshed.
  PowerRTF::Extracted_mesh triangulated_samples()
  {
    const PowerRTF::Feature_samples& features = m_patches.features();
    PowerRTF::Samples all = m_engine.samples();
    std::vector<int> carriers = all.facets; // of the patches; those on features may be others
    const std::vector<int>& on_features = features.samples.facets;
    carriers.insert(carriers.end(), on_features.begin(), on_features.end());
    all = with_features(std::move(all));
    PowerRTF::move_off_kept_edges(m_surface, all.size() - features.size(), all);
    PowerRTF::Extracted_mesh mesh;
    if (!m_surface.is_closed_up()) {
      mesh = triangulate(m_surface, all, features, {}, std::move(carriers));
    } else {
      const PowerRTF::Opened_surface opened(m_surface, all, features);
      mesh = triangulate(opened.surface(), opened.samples(), opened.features(), opened.seams(), {});
      PowerRTF::Opened_surface::sew_up(mesh);
    }
    return mesh;
  }

  /// Takes vertices out of `mesh` within the distance that is asked for; the judged `result` stays
  /// as it is where a guarantee would be missed.
  void coarsen(const PowerRTF::Extracted_mesh& mesh, PowerRTF::Extracted_mesh& result)
  {
    if (!m_report.missed_guarantees().empty()) return;
    for (const double share : {1.02, 0.95, 0.85}) { // for the points: they are to keep .93 of it
      const Report before = m_report;
      PowerRTF::Extracted_mesh coarse = mesh;
      {
        const Stage stage("improvement", m_report.seconds.improvement);
        const std::size_t taken =
            PowerRTF::coarsen_mesh(m_patches.surface(), m_engine.facet_tree(), coarse,
                                   share * m_report.max_distance * m_surface.normalization.scale,
                                   typename Traits::Concurrency_tag());
        if (taken == 0) return;
        m_report.samples_asked -= m_whole ? 2 * taken : taken;
      }
      coarse = judged(std::move(coarse));
      if (m_report.missed_guarantees().empty()) {
        result = std::move(coarse);
        return;
      }
      m_report = before;
    }
  }

  /// The whole mesh; the report gets its judgment.
  PowerRTF::Extracted_mesh judged(PowerRTF::Extracted_mesh mesh)
  {
    const Stage stage("quality", m_report.seconds.quality);
    const typename Traits::Concurrency_tag concurrency;
    if (!m_whole) {
      PowerRTF::assess(m_surface, m_patches.surface(), m_engine.facet_tree(), mesh, m_report,
                       concurrency, m_engine.mesh_bringer());
    } else {
      const std::size_t of_half = mesh.points.size();
      mesh = PowerRTF::mirrored_mesh(std::move(mesh), m_surface, concurrency);
      m_report.symmetry.vertices = 2 * of_half - mesh.points.size();
      PowerRTF::assess(*m_whole, mesh, m_report, concurrency);
      m_report.symmetry.lone_facets =
          PowerRTF::facets_without_image(mesh, *m_surface.mirror, concurrency);
    }
    return mesh;
  }

  bool inside_interval() const { return m_engine.capacity().inside_interval == 1; }

  /// Whether the samples are at their centroids, or no longer come nearer: another step would not
  /// pay.
  bool has_settled() const
  {
    constexpr std::size_t patience = 20;
    constexpr double nearer = 0.9;
    const auto& steps = m_report.iterations;
    if (m_options.centroid_tolerance == 0) return false;
    if (steps.back().displacement <= m_options.centroid_tolerance) return true;
    const auto nearest = [](auto begin, auto end) {
      return std::min_element(
                 begin, end,
                 [](const auto& a, const auto& b) { return a.displacement < b.displacement; })
          ->displacement;
    };
    if (steps.size() <= patience) return false;
    const auto recent = steps.end() - patience;
    return nearest(recent, steps.end()) > nearer * nearest(steps.begin(), recent);
  }

  /// Algorithm 2. Returns whether the capacities end the run.
  bool optimize_weights()
  {
    if (m_options.weight_method != Weight_method::multiplicative) return false;
    const bool at_rest = m_options.weights_end == Weights_end::rest && inside_interval();
    if (m_engine.optimize_weights(m_options.max_weight_iterations))
      return at_rest || m_options.weights_end == Weights_end::inside;
    if (do_weights_harm()) m_engine.clear_weights(); // they begin anew
    return false;
  }

  /// Whether the capacities are less equal than they were at the end of the relaxation, without
  /// weights: the rule need not converge where samples are too few.
  bool do_weights_harm() const
  {
    const int relaxed = m_options.relaxation_iterations;
    return relaxed > 0 && m_engine.capacity().rms > m_report.iterations[relaxed - 1].capacity.rms;
  }

  /// The weights once the samples are in place, by Newton's method.
  void equalize_capacities()
  {
    if (m_options.position_method == PowerRTF::Position_method::lbfgs) m_engine.restore_best();
    if (m_options.weight_method != Weight_method::newton) return;
    const int passes = m_options.max_weight_iterations;
    for (int pass = 0; pass < passes && !inside_interval(); ++pass) {
      const Progress_part part(1 - (1 - iterations_share()) * (passes - pass - 1) / passes);
      if (!m_engine.newton_weights()) break;
    }
  }

  PowerRTF::Extracted_mesh triangulate(const PowerRTF::Surface& surface,
                                       const PowerRTF::Samples& samples,
                                       const PowerRTF::Feature_samples& features,
                                       const PowerRTF::Seam_places& seams,
                                       std::vector<int> carriers)
  {
    PowerRTF::Extracted_mesh mesh;
    {
      const Stage stage("extraction", m_report.seconds.extraction);
      mesh = triangles(surface, samples, features, seams);
      set_input_points(mesh);
    }
    if (m_options.improvement == PowerRTF::Improvement::yes) {
      const Stage stage("improvement", m_report.seconds.improvement);
      m_preparation.reset();
      PowerRTF::improve_mesh(
          m_patches.surface(), m_engine.facet_tree(), mesh, typename Traits::Concurrency_tag(),
          {m_options.dislocations, m_report.max_distance * surface.normalization.scale,
           std::move(carriers), m_engine.mesh_bringer(), m_engine.star_sweeps_maker(),
           std::move(m_prepared)},
          &m_report.retouched_vertices);
    }
    return mesh;
  }

  /// Names the samples at kept vertices, which are among the last ones of all.
  void set_input_points(PowerRTF::Extracted_mesh& mesh) const
  {
    const std::vector<int>& kept = m_surface.kept_vertices;
    if (kept.empty()) return;
    const std::vector<PowerRTF::Edge_place>& places = m_patches.features().places;
    mesh.input_points.assign(m_options.number_of_samples, {});
    const std::size_t first = m_options.number_of_samples - places.size();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const int v = places[k].from;
      const auto found = std::lower_bound(kept.begin(), kept.end(), v);
      if (places[k].to == v && found != kept.end() && *found == v)
        mesh.input_points[first + k] = {m_surface.input_vertices[v],
                                        m_surface.kept_points[found - kept.begin()]};
    }
  }

  PowerRTF::Extracted_mesh triangles(const PowerRTF::Surface& surface,
                                     const PowerRTF::Samples& samples,
                                     const PowerRTF::Feature_samples& features,
                                     const PowerRTF::Seam_places& seams)
  {
    using Method = PowerRTF::Extraction_method;
    const bool is_opened = m_surface.is_closed_up(); // its cells are those of the surface as it was
    const bool by_cells = m_options.extraction == Method::cells && !is_opened && !all_fixed();
    Progress_part part(0.2);
    PowerRTF::Neighbor_cycles neighbors;
    if (by_cells) neighbors = m_engine.neighbors();
    m_engine.release_memory();
    part.next(1);
    if (m_options.extraction == Method::restricted_delaunay) {
      PowerRTF::Extracted_mesh mesh =
          PowerRTF::extract_restricted_delaunay(surface, samples, features);
      mesh.places = seams.samples;
      return mesh;
    }
    if (!by_cells) return PowerRTF::extract_by_insertion(surface, samples, features, seams);
    PowerRTF::Cell_extraction_statistics statistics;
    PowerRTF::Extracted_mesh mesh = PowerRTF::extract_from_cells<typename Traits::Concurrency_tag>(
        surface, samples, features, std::move(neighbors), &statistics, m_engine.mesh_bringer(),
        m_engine.sound_star_finder());
    m_report.mended_samples =
        statistics.is_from_insertion ? samples.size() : statistics.open_samples;
    return mesh;
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

  PowerRTF::Surface m_surface; // that samples are distributed on
  Options m_options;
  Report m_report;
  std::optional<PowerRTF::internal::Stopwatch> m_watch; // of the constructor
  std::optional<PowerRTF::Surface> m_whole; // of which that is the half; none: it is the whole
  PowerRTF::Surface_patches m_patches;
  Engine m_engine;
  std::shared_ptr<PowerRTF::Improvement_preparation> m_prepared;    // for the next mesh, or none
  std::optional<PowerRTF::internal::Background_work> m_preparation; // refers to all of that
};

} // namespace CGAL

#endif // CGAL_POWER_RTF_REMESHER_H
