// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An engine behind plain arrays: it knows no mesh, no type of CUDA and none of CGAL, so that a
// library can carry it compiled. `Surface_engine` makes the engine of the remesher from it.
#ifndef CGAL_POWER_RTF_ENGINES_ENGINE_BASE_H
#define CGAL_POWER_RTF_ENGINES_ENGINE_BASE_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/cells/Cell_polygon.h>
#include <CGAL/PowerRTF/cells/Find_sound_stars.h>
#include <CGAL/PowerRTF/cells/Neighbor_cycles.h>
#include <CGAL/PowerRTF/geometry/Find_facets.h>
#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/optimization/Cell_summary.h>
#include <CGAL/PowerRTF/sampling/Lattice_field_base.h>
#include <CGAL/PowerRTF/smoothing/Star_sweeps_base.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF {

/// Whether a rule looks at the vertices nearest to a point.
inline bool asks_for_vertices(const Remeshing_options& options)
{
  return options.projection == Projection::nearest_vertices ||
         options.attributes == Attributes::nearest_vertices;
}

/// What decides, with the options, how much memory a run takes.
struct Run_sizes {
  std::size_t samples = 0;
  std::size_t facets = 0, vertices = 0; ///< of the surface
  bool has_patches = false;             ///< several
  bool is_even = true;                  ///< the density is the same everywhere
};

/// Samples as they come: the first `cells` have cells and move; the others only clip.
struct Engine_samples {
  internal::Unset_vector<Vec3d> points;
  internal::Unset_vector<int> facets; ///< places in the tree
  int cells = 0;
  // Of the others:
  internal::Unset_vector<Vec3d> normals;
  internal::Unset_vector<double> density;
  std::vector<int> next; ///< along the boundary of the patch, which of them is the next; or -1

  std::size_t size() const { return points.size(); }
};

/// The steps of Algorithms 1 to 3 over all samples at once; see the concept `PowerRTFEngine`.
class Engine_base {
public:
  virtual ~Engine_base() = default;
  /// As `Make_lattice_field`. The engine has to live as long as the result.
  virtual std::unique_ptr<Lattice_field_base> make_lattice_field(const Lattice_plan& plan) = 0;
  /// As `Place_candidates`.
  virtual std::optional<std::size_t> place_candidates(Lattice_field_base& field, std::size_t n) = 0;
  /// Takes the samples; where none of them has a cell, those that were placed before them. Those
  /// with cells come into spatial order; the others keep theirs. Weights become 0. \returns how
  /// many have cells
  virtual int set_samples(const Engine_samples& samples) = 0;
  virtual void build_cells() = 0;
  virtual bool optimize_weights(int passes) = 0;
  virtual bool newton_weights() = 0;
  virtual void clear_weights() = 0;
  virtual void move_samples(Position_method method) = 0;
  virtual void restore_best() = 0;
  virtual Cell_summary summary() = 0;
  virtual std::size_t constructions() const = 0;
  /// All. Their facets are places in the tree.
  virtual Samples samples() = 0;
  virtual std::vector<Cell_polygon> cells() = 0;
  virtual Neighbor_cycles neighbors() = 0;
  virtual void release_memory() = 0;
  /// Brings meshes to where the engine works, or empty: on the host, where what is asked of them is
  /// found by groups. The engine has to live as long as the result.
  virtual Bring_mesh mesh_bringer() = 0;
  /// The same for what finds cells whose triangles are sound.
  virtual Find_sound_stars sound_star_finder() = 0;
  /// The same for what finds facets of its surface.
  virtual Find_facets facet_finder() = 0;
  /// The same for what moves the vertices of meshes.
  virtual Make_star_sweeps star_sweeps_maker() = 0;
  virtual double epsilon() const = 0;
  virtual Device_report device_report() = 0;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_ENGINE_BASE_H
