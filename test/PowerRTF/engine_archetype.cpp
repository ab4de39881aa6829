// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An engine and traits that have what the manual's concepts list and nothing else:
// `PowerRTF_remesher` must compile with them. Nothing runs.
#include <CGAL/PowerRTF_remesher.h>

namespace {

using namespace CGAL::PowerRTF;

class Engine_archetype {
public:
  Engine_archetype(const Surface&, const Remeshing_options&);
  Engine_archetype(const Engine_archetype&) = delete;
  Engine_archetype& operator=(const Engine_archetype&) = delete;
  static Surface_work surface_work(const Remeshing_options&);
  Make_lattice_field lattice_field_maker();
  Find_facets facet_finder();
  Place_candidates candidate_placer();
  void set_samples(const Samples& samples, const Feature_samples& features);
  void build_cells();
  bool optimize_weights(int passes);
  bool newton_weights();
  void clear_weights();
  void move_samples(Position_method method);
  void restore_best();
  Capacity_statistics capacity() const;
  Cell_counts cell_counts() const;
  double displacement() const;
  std::size_t constructions() const;
  Samples samples() const;
  Samples sites() const;
  std::vector<Cell_polygon> cells();
  void release_memory();
  Bring_mesh mesh_bringer();
  Find_sound_stars sound_star_finder();
  Make_star_sweeps star_sweeps_maker();
  Neighbor_cycles neighbors();
  double epsilon() const;
  const Facet_tree& facet_tree();
  Device_report device_report() const;
};

struct Kernel_archetype {};

struct Traits_archetype {
  using Kernel = Kernel_archetype;
  using Concurrency_tag = CGAL::Sequential_tag;
  using Engine = Engine_archetype;
  static const char* name();
};

struct Visitor_archetype {
  void on_stage(const char* name);
  void on_iteration(const Iteration_report& report, double progress);
  bool go_further();
};

} // namespace

template class CGAL::PowerRTF_remesher<Traits_archetype>;
template bool CGAL::PowerRTF_remesher<Traits_archetype>::optimize(Visitor_archetype&);
template Extracted_mesh CGAL::PowerRTF_remesher<Traits_archetype>::extract(Visitor_archetype&);
