// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgPowerRTFConcepts
\cgalConcept

Owns the samples with their weights and cells, and carries out one step of the algorithm over all of
them at once. `CGAL::PowerRTF_remesher` decides which step comes next; a handful of calls per
iteration, none per sample. Everything is in the coordinates of the unit box
(`CGAL::PowerRTF::Normalization`).

Each model must be deterministic: the same calls give the same result bit for bit, whatever the
number of threads. Cells may be constructed only when something is asked of them.

The models of this package are one class, `CGAL::PowerRTF::Engine`, over a `PowerRTFBackend`, which
says where arrays lie and how loops run, and a model of `PowerRTFCells`, which constructs the cells.

\cgalHasModelsBegin
\cgalHasModels{`CGAL::PowerRTF::Cpu_engine`}
\cgalHasModels{`CGAL::PowerRTF::Exact_engine`}
\cgalHasModels{`CGAL::PowerRTF::Cuda_engine`}
\cgalHasModelsEnd
*/
class PowerRTFEngine {
public:
  /// Keeps a reference to `surface`, whose vertex normals may still change before `set_samples()`.
  PowerRTFEngine(const CGAL::PowerRTF::Surface& surface,
                 const CGAL::PowerRTF::Remeshing_options& options);

  /// What is done to surfaces where such an engine works, before there is one.
  static CGAL::PowerRTF::Surface_work
  surface_work(const CGAL::PowerRTF::Remeshing_options& options);

  /// What makes the fields of a lattice, on which samples begin, where the engine works; or empty.
  CGAL::PowerRTF::Make_lattice_field lattice_field_maker();

  /// What finds facets of the surface where the engine works; or empty.
  CGAL::PowerRTF::Find_facets facet_finder();

  /// What makes points of a lattice samples where the engine works; or empty.
  CGAL::PowerRTF::Place_candidates candidate_placer();

  /// Takes the samples' points and facets; none: those that `candidate_placer()` has made. Their
  /// normals and densities come from the surface, their weights become 0. The engine may reorder
  /// them, once. `features`: samples that stay where they are; the copies of each, one for every
  /// patch at it, bound cells and have none.
  void set_samples(const CGAL::PowerRTF::Samples& samples,
                   const CGAL::PowerRTF::Feature_samples& features);

  /// Constructs all cells (Algorithm 1), with area, mass and center of mass.
  void build_cells();

  /// Passes of the paper's rule over all weights (Algorithm 2, lines 3 to 10), each followed by a
  /// construction, until all masses are inside the capacity interval; at most `passes`. The cells
  /// must be those of the current samples and weights. Returns whether all masses are inside.
  bool optimize_weights(int passes);

  /// One damped Newton step on the weights; the cells are those of the new weights. Cells that no
  /// weights make equal to the others keep their areas, nearly, and are left out of `capacity()`
  /// until the samples move: at most one in a hundred besides those that reach far beyond the
  /// surface. `false`: no step made the masses more equal, and nothing has changed.
  bool newton_weights();

  /// All weights become 0, and the cells are built again.
  void clear_weights();

  /// Moves each sample toward the center of mass of its cell and projects it onto the surface
  /// (Algorithm 3, lines 15 to 19). The cells are outdated after it.
  void move_samples(CGAL::PowerRTF::Position_method method);

  /// Goes back to the most centroidal samples that L-BFGS has passed, when the current ones are
  /// less so, and builds their cells.
  void restore_best();

  /// How equal the masses of the current cells are.
  CGAL::PowerRTF::Capacity_statistics capacity() const;

  /// The current cells by status.
  CGAL::PowerRTF::Cell_counts cell_counts() const;

  /// The root mean square of \f$|s_i - c_i|\f$, in units of \f$\sqrt{\mathrm{area}/n}\f$.
  double displacement() const;

  /// How often all cells have been constructed.
  std::size_t constructions() const;

  /// The current samples with normals, densities and weights, without the feature samples.
  CGAL::PowerRTF::Samples samples() const;

  /// The same, and after them the copies of the feature samples, as the engine's numbers hold them.
  CGAL::PowerRTF::Samples sites() const;

  /// The polygons of the current cells, in the samples' order, not cut at creases and borders. The
  /// neighbors are numbers of sites.
  std::vector<CGAL::PowerRTF::Cell_polygon> cells();

  /// The neighbors of each sample's cell, were there no weights: numbers of sites.
  CGAL::PowerRTF::Neighbor_cycles neighbors();

  /// Frees what only further steps need. They would make it again.
  void release_memory();

  /// What brings a mesh to where the engine works, once for all that is asked of it; or empty. What
  /// is not found there, the caller finds.
  CGAL::PowerRTF::Bring_mesh mesh_bringer();
  /// What finds cells whose triangles are sound there; or empty. Where it returns `false`, the
  /// caller finds them.
  CGAL::PowerRTF::Find_sound_stars sound_star_finder();
  /// The same of sweeps over the vertices of a mesh.
  CGAL::PowerRTF::Make_star_sweeps star_sweeps_maker();

  /// The precision of the cells' numbers: the machine epsilon of `double`, or of `float`.
  double epsilon() const;

  /// The facets of the surface and their patches, for searches.
  const CGAL::PowerRTF::Facet_tree& facet_tree();

  /// Name, time and memory of the device; an empty name: there is none.
  CGAL::PowerRTF::Device_report device_report() const;
};
