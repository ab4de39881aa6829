// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fast cells of few sites against the exact ones: no certified cell is wrong, and with
// certified combinatorics all have the exact neighbors.
#include "../fast_cells.h"
#include "engine.h"
#include "mutate_sites.h"
#include "promise.h"

namespace {

fast_cells::Cloud cloud_of(const fuzz::Sites_input& input)
{
  fast_cells::Cloud cloud;
  cloud.cos_angle = input.cos_angle;
  for (const auto& s : input.sites) cloud.add(s.point, s.normal, s.weight);
  return cloud;
}

CGAL::PowerRTF::Cell_comparison compare(const fuzz::Sites_input& input, bool is_certified)
{
  fast_cells::Cloud cloud = cloud_of(input);
  CGAL::PowerRTF::Remeshing_options options;
  options.guard_factor = input.guard_factor;
  options.certified_combinatorics = is_certified;
  const auto cells = fast_cells::construct<CGAL::PowerRTF::Filtered_construction>(
      cloud, options, input.first_radius);
  return CGAL::PowerRTF::check_cells<CGAL::Sequential_tag>(
      cloud.samples, cells, cloud.cos_angle, CGAL::PowerRTF::internal::epsilon<double>(),
      input.guard_factor);
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const auto input = fuzz::sites_of(fuzz::text_of(data, size));
  if (!input || !fuzz::is_usable(*input)) return -1;
  for (const bool is_certified : {false, true}) {
    const auto comparison = compare(*input, is_certified);
    for (const int i : comparison.wrong)
      std::cerr << "cell " << i << " of the sites in spatial order is certified and wrong\n";
    fuzz::promise(comparison.passed(), "no certified cell is wrong");
    fuzz::promise(!is_certified || comparison.equal_cycles == comparison.cells,
                  "certified combinatorics are the exact ones");
  }
  return 0;
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                    unsigned seed)
{
  auto input = fuzz::sites_of(fuzz::text_of(data, size));
  if (!input) return LLVMFuzzerMutate(data, size, max_size);
  fuzz::Random random(seed);
  fuzz::Sites_mutator mutator(*input, random);
  do mutator.mutate();
  while (random.integer(0, 2) > 0);
  return fuzz::replace(data, size, max_size, fuzz::to_text(*input));
}
