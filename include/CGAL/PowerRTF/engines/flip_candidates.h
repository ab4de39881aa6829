// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The edges of a mesh of which a flip may be worth while, found where a backend works.
#ifndef CGAL_POWER_RTF_ENGINES_FLIP_CANDIDATES_H
#define CGAL_POWER_RTF_ENGINES_FLIP_CANDIDATES_H

#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/halfedge_numbers.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/smoothing/lowers_energy.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF::internal {

struct Flag_flip_candidates {
  Mesh_arrays mesh;
  const int* opposite; ///< as of `Triangle_links`
  unsigned char* is_candidate;

  CGAL_POWER_RTF_HD void operator()(int h) const
  {
    constexpr double rounding = 1e-9; // on a GPU
    const int o = opposite[h];
    is_candidate[h] = h < o && lowers_energy(
                                   source(h), source(next_halfedge(h)),
                                   source(previous_halfedge(h)), source(previous_halfedge(o)),
                                   [](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
                                     return shape_energy(a, b, c);
                                   },
                                   least_shape_energy, 1 + rounding);
  }

private:
  CGAL_POWER_RTF_HD const Vec3d& source(int h) const { return mesh.points[mesh.corners[h]]; }
};

template <class Backend>
struct Flip_candidate_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<unsigned char> is_candidate;
  Buffer<int> candidates;

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, std::size_t halfedges)
  {
    f(&Flip_candidate_arrays::is_candidate, halfedges);
    f(&Flip_candidate_arrays::candidates, halfedges);
  }
};

/// As `Resident_mesh::find_flips()`, of a mesh that is where the backend works, as the `opposite`
/// halfedges: `false` where the memory does not suffice.
template <class Backend>
bool find_flip_candidates(Backend& backend, const Mesh_arrays& mesh, const int* opposite,
                          std::vector<int>& halfedges)
{
  using Arrays = Flip_candidate_arrays<Backend>;
  const std::size_t n = 3 * std::size_t(mesh.faces);
  if (!backend.has_room(bytes_of_listed<Arrays>(n))) return false;
  Arrays a;
  allocate_listed(backend, a, n);
  backend.for_each(static_cast<int>(n),
                   Flag_flip_candidates{mesh, opposite, a.is_candidate.data()});
  halfedges.resize(backend.select(static_cast<int>(n), a.is_candidate.data(), a.candidates.data()));
  backend.download(halfedges.data(), a.candidates.data(), halfedges.size());
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_FLIP_CANDIDATES_H
