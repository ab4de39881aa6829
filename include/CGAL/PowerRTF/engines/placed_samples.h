// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples as they come to an engine: on the surface, in no order yet.
#ifndef CGAL_POWER_RTF_ENGINES_PLACED_SAMPLES_H
#define CGAL_POWER_RTF_ENGINES_PLACED_SAMPLES_H

#include <CGAL/PowerRTF/cells/Sites_view.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/geometry/hilbert_code.h>
#include <CGAL/PowerRTF/sampling/place_candidate.h>

#include <cstddef>
#include <cstdint>

namespace CGAL::PowerRTF {

template <class Real, class Backend>
struct Placed_samples {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<Site<Real>> sites;
  Buffer<int> facets;  ///< places in the tree
  Surface_cube cube{}; ///< around them

  int size() const { return static_cast<int>(facets.size()); }

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t n)
  {
    f(&Placed_samples::sites, n);
    f(&Placed_samples::facets, n);
  }
};

/// Puts a candidate on the surface.
template <class Real>
struct Place_candidate_rule {
  Surface_view<Real> surface;
  Surface_cube cube; ///< of the candidates
  const Sample_candidate* candidates;
  Site<Real>* sites;
  int* facets;

  template <class Lanes>
  CGAL_POWER_RTF_HD void operator()(int i, Lanes lanes) const
  {
    const Sample_candidate& c = candidates[i];
    const int nearest =
        project_to_nearest_facet(surface, to_real<Real>(cube.to_outside(to_double(c.point))),
                                 to_real<Real>(to_double(c.node.normal)), Real(cos_same_side),
                                 c.node.facet, lanes)
            .facet;
    if (!lanes.leads()) return;
    const Surface_point<Real> p = place_candidate<Real>(
        c, cube, nearest, [this](int place) { return surface.facets[place]; });
    sites[i] = {p.point, Real(0)};
    facets[i] = p.facet;
  }
};

/// Whether a candidate is no point of the lattice.
struct Mark_off_lattice {
  const Sample_candidate* candidates;
  unsigned char* result;
  CGAL_POWER_RTF_HD void operator()(int i) const { result[i] = candidates[i].distance < 0; }
};

/// Places along the Hilbert curve through a cube: no size or position of the surface decides them.
template <class Real>
struct Find_hilbert_code {
  Vec3<Real> middle;
  Real scale;
  const Site<Real>* sites;
  std::uint64_t* codes;

  Find_hilbert_code(const Surface_cube& cube, const Site<Real>* its_sites, std::uint64_t* its_codes)
      : middle(to_real<Real>(cube.middle)), scale(Real(cube.scale)), sites(its_sites),
        codes(its_codes)
  {}
  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    codes[i] = hilbert_code(scale * (sites[i].point - middle));
  }
};

template <class Real>
struct Take_in_order {
  const Site<Real>* from_sites;
  const int *from_facets, *order;
  Site<Real>* sites;
  int* facets;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    sites[i] = from_sites[order[i]];
    facets[i] = from_facets[order[i]];
  }
};

/// The patches of samples.
struct Take_patches {
  const int *of_facets, *facets;
  int* result;
  CGAL_POWER_RTF_HD void operator()(int i) const { result[i] = of_facets[facets[i]]; }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_PLACED_SAMPLES_H
