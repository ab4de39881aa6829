// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: from a polygon soup to the surface, its patches and its samples.
#include <CGAL/PowerRTF/change_border_impl.h>
#include <CGAL/PowerRTF/engines/Surface_engine_impl.h>
#include <CGAL/PowerRTF/features/Surface_patches_impl.h>
#include <CGAL/PowerRTF/input/clean_surface_impl.h>
#include <CGAL/PowerRTF/prepare_surface_impl.h>
#include <CGAL/PowerRTF/sampling/sample_surface_impl.h>

#include <CGAL/tags.h>

namespace CGAL::PowerRTF {

template Samples sample_surface<Sequential_tag>(const Surface&, const Remeshing_options&,
                                                const Feature_samples&, const Facet_tree*,
                                                std::size_t*, const Make_lattice_field&,
                                                const Find_facets&, const Place_candidates&);
template Lattice_fields lattice_fields<Sequential_tag>(const Surface&, const Remeshing_options&,
                                                       const Feature_samples&, const Facet_tree&);
#ifdef CGAL_LINKED_WITH_TBB
template Samples sample_surface<Parallel_tag>(const Surface&, const Remeshing_options&,
                                              const Feature_samples&, const Facet_tree*,
                                              std::size_t*, const Make_lattice_field&,
                                              const Find_facets&, const Place_candidates&);
template Lattice_fields lattice_fields<Parallel_tag>(const Surface&, const Remeshing_options&,
                                                     const Feature_samples&, const Facet_tree&);
#endif

} // namespace CGAL::PowerRTF
