// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine of all traits.
#ifndef CGAL_POWER_RTF_ENGINES_SURFACE_ENGINE_H
#define CGAL_POWER_RTF_ENGINES_SURFACE_ENGINE_H

#include <CGAL/PowerRTF/engines/Engine_base.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/fields/Surface_work.h>
#include <CGAL/PowerRTF/geometry/Find_facets.h>
#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/Surface_in_tree.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace CGAL::PowerRTF {

class Facet_tree;

/// What the engines of all traits share: takes a surface and its samples to an `Engine_base`, where
/// everything stays until the final samples are asked for.
class Surface_engine_base {
public:
  Surface_engine_base(const Surface_engine_base&) = delete;
  Surface_engine_base& operator=(const Surface_engine_base&) = delete;

  /// Makes the fields of a lattice where the engine works. The surface's normals and density are
  /// those of then.
  Make_lattice_field lattice_field_maker();
  /// Finds facets where the engine works, with the surface's normals of then, too. Empty: it works
  /// on the host.
  Find_facets facet_finder() { return engine().facet_finder(); }
  /// Makes points of a lattice samples where the engine works.
  Place_candidates candidate_placer();
  /// `samples`: none where they have been placed.
  void set_samples(const Samples& samples, const Feature_samples& features = {});
  void build_cells() { m_engine->build_cells(); }
  bool optimize_weights(int passes) { return m_engine->optimize_weights(passes); }
  bool newton_weights() { return m_engine->newton_weights(); }
  void clear_weights() { m_engine->clear_weights(); }
  void move_samples(Position_method method) { m_engine->move_samples(method); }
  void restore_best() { m_engine->restore_best(); }

  Capacity_statistics capacity() const { return m_engine->summary().capacity; }
  Cell_counts cell_counts() const;
  double displacement() const;
  std::size_t constructions() const { return m_engine->constructions(); }

  Samples samples() const { return gather(m_size); }
  Samples sites() const { return gather(m_sites); }
  std::vector<Cell_polygon> cells() { return m_engine->cells(); }
  Neighbor_cycles neighbors() { return m_engine->neighbors(); }
  void release_memory() { m_engine->release_memory(); }
  /// Brings meshes to where the engine works; it has to live as long as the result. Empty: it works
  /// on the host, or there were no samples for it to work on.
  Bring_mesh mesh_bringer() { return m_engine ? m_engine->mesh_bringer() : Bring_mesh(); }
  /// The same for what finds cells whose triangles are sound.
  Find_sound_stars sound_star_finder()
  {
    return m_engine ? m_engine->sound_star_finder() : Find_sound_stars();
  }
  /// The same for what moves the vertices of meshes.
  Make_star_sweeps star_sweeps_maker()
  {
    return m_engine ? m_engine->star_sweeps_maker() : Make_star_sweeps();
  }
  double epsilon() const { return m_engine->epsilon(); }
  Device_report device_report() const { return m_engine->device_report(); }
  const Facet_tree& facet_tree();

  /// What decides how much memory a run takes on a device.
  static Run_sizes run_sizes(const Surface& surface, const Remeshing_options& options);

protected:
  using Make = std::unique_ptr<Engine_base> (*)(const Surface_in_tree&, const Remeshing_options&);

  /// Keeps a reference to `surface`.
  /// `concurrency`: of the construction of what stays on the host; `arrange`: of the facets' tree.
  Surface_engine_base(const Surface& surface, const Remeshing_options& options, Make make,
                      internal::Concurrency concurrency, Arrange_facets&& arrange);
  ~Surface_engine_base();

private:
  Engine_base& engine();
  Samples gather(std::size_t count) const;

  Remeshing_options m_options;
  const Surface& m_surface;
  Make m_make;
  internal::Concurrency m_concurrency;
  Arrange_facets m_arrange;
  std::unique_ptr<Facet_tree> m_tree;
  Surface_in_tree m_in_tree;
  std::unique_ptr<Engine_base> m_engine;
  std::size_t m_size = 0, m_sites = 0; // cells; and with the feature samples' sites
};

/// \cgalModels `PowerRTFEngine`
///
/// \tparam Maker `Maker::check(run_sizes, options)` throws what keeps the engine from working;
/// `Maker::make(surface_in_tree, options)` returns a `std::unique_ptr<Engine_base>`;
/// `Maker::surface_work(options)` is what the engine's is;
/// `Maker::Concurrency_tag` is that of the host's work.
template <class Maker>
class Surface_engine : public Surface_engine_base {
public:
  /// Keeps a reference to `surface`.
  Surface_engine(const Surface& surface, const Remeshing_options& options)
      : Surface_engine_base(surface, options, &Maker::make, typename Maker::Concurrency_tag(),
                            Maker::surface_work(options).arrange_facets)
  {
    Maker::check(run_sizes(surface, options), options);
  }

  /// What is done to a surface where such an engine works, before there is one.
  static Surface_work surface_work(const Remeshing_options& options)
  {
    return Maker::surface_work(options);
  }
};

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/engines/Surface_engine_impl.h>
#endif

#endif // CGAL_POWER_RTF_ENGINES_SURFACE_ENGINE_H
