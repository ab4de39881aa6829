// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// How much memory a run of `Engine` takes on a device, told before it: the sum of what the owners
// of its arrays tell, which are the sizes that they allocate. What is not known before is left out:
// how many samples are on creases and have no cell, and how many sites are there in their place;
// whether the cells fall into components; a second try at the lattice. These are some per cent.
#ifndef CGAL_POWER_RTF_ENGINES_ENGINE_MEMORY_H
#define CGAL_POWER_RTF_ENGINES_ENGINE_MEMORY_H

#include <CGAL/PowerRTF/engines/Engine.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace CGAL::PowerRTF {

template <class R, class B, class C>
std::size_t Engine<R, B, C>::bytes(const Run_sizes& sizes, const Remeshing_options& options)
{
  using internal::bytes_of_listed;
  const int n = static_cast<int>(sizes.samples);
  const bool has_lbfgs = options.position_method == Position_method::lbfgs;
  const bool has_newton = options.weight_method == Weight_method::newton;
  // The lattice goes before the samples come, the steps of L-BFGS before Newton's, and these before
  // the neighbors.
  const std::size_t sampling =
      options.sampling == Sampling::lattice
          ? Lattice_field<B>::bytes(sizes.samples, sizes.facets, sizes.is_even)
          : 0;
  const bool has_features = sizes.has_patches; // which creases part
  const std::size_t samples = bytes_of_listed<Engine>(n, n, sizes.has_patches, has_features) +
                              C::bytes(n, has_features) + B::sort_bytes(n);
  const std::size_t sorting =
      bytes_of_listed<Placed_samples<R, B>>(n) + n * (sizeof(std::uint64_t) + sizeof(int));
  std::size_t positions = 0, weights = 0, extraction = 0;
  if (has_lbfgs)
    positions =
        bytes_of_listed<Best_state>(n) + (options.lbfgs_memory <= short_memory
                                              ? bytes_of_listed<Lbfgs<R, B, short_memory>>(n)
                                              : bytes_of_listed<Lbfgs<R, B, max_lbfgs_memory>>(n));
  if (has_newton) weights = Newton_solver<R, B>::bytes(n);
  if (options.extraction == Extraction_method::cells)
    extraction = n * sizeof(Site<R>) + C::neighbors_bytes(n); // see neighbors()
  return B::least_bytes() +
         Surface_arrays<R, B>::bytes(sizes.facets, sizes.vertices, sizes.has_patches,
                                     asks_for_vertices(options)) +
         (std::max)(sampling, samples + (std::max)({sorting, positions, weights, extraction}));
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_ENGINE_MEMORY_H
