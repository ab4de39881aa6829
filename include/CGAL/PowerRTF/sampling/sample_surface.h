// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The first n samples (Section 4.3, "Initial Sampling").
#ifndef CGAL_POWER_RTF_SAMPLING_SAMPLE_SURFACE_H
#define CGAL_POWER_RTF_SAMPLING_SAMPLE_SURFACE_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/features/Feature_samples.h>
#include <CGAL/PowerRTF/geometry/Find_facets.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/sampling/Lattice_field_base.h>
#include <CGAL/PowerRTF/sampling/Lattice_fields.h>

#include <CGAL/tags.h>

namespace CGAL::PowerRTF {

class Facet_tree;

/// Puts exactly `options.number_of_samples` samples on the surface, by `options.sampling`:
///
/// - `lattice`: a hexagonal lattice wherever the surface lets it be one, see `Lattice_sampler`.
/// - `stratified`: a random point in each of n parts of equal mass.
/// - `random`: the paper's. m n points, uniform by area; n of them are kept, with probability
///   proportional to the density.
/// - `elimination`: m n points distributed like the density, and weighted sample elimination down
///   to n. Points whose normals differ by more than `options.normal_angle` do not see each other.
///
/// Every component of the surface gets its share by mass (the integral of the density), and at
/// least 4 samples when n allows it; components are sampled one after another.
/// \returns the samples with their facets; normals and density are interpolated over the facet,
///   weights are 0. The same seed gives the same samples, also for a scaled surface (a lattice,
///   which is found in single precision: if the factor is a power of two).
/// \param features samples that are there already, on the patches' boundaries; they count among
///   the n
/// \param tree of the surface's facets; null: it is made where it is needed
/// \param make makes the fields of a lattice; empty: they are made on the CPU
/// \param find finds the facets that are nearest to the lattice's points, where it does
/// \param place makes the lattice's points samples of the engine that makes its fields, where it
///   does; then none are returned
/// \param off_lattice gets the number of samples that are no points of the lattice; may be null
/// \throws Invalid_input_error an option has a value that is not allowed
template <class ConcurrencyTag = Sequential_tag>
Samples sample_surface(const Surface& surface, const Remeshing_options& options,
                       const Feature_samples& features = {}, const Facet_tree* tree = nullptr,
                       std::size_t* off_lattice = nullptr, const Make_lattice_field& make = {},
                       const Find_facets& find = {}, const Place_candidates& place = {});

/// The fields of the lattice that `sample_surface()` begins with when it gets the same; they are
/// made anew.
/// \throws Invalid_input_error as `sample_surface()`, or `options.sampling` is not `lattice`
template <class ConcurrencyTag = Sequential_tag>
Lattice_fields lattice_fields(const Surface& surface, const Remeshing_options& options,
                              const Feature_samples& features, const Facet_tree& tree);

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/sampling/sample_surface_impl.h>
#endif

#endif // CGAL_POWER_RTF_SAMPLING_SAMPLE_SURFACE_H
