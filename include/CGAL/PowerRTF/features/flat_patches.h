// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flat parts of a surface.
#ifndef CGAL_POWER_RTF_FEATURES_FLAT_PATCHES_H
#define CGAL_POWER_RTF_FEATURES_FLAT_PATCHES_H

#include <CGAL/PowerRTF/geometry/facet_adjacency.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/label_trees.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <array>
#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

/// The maximal sets of connected facets whose normals differ from that of their first facet by less
/// than an angle, of which the sine is given. Keeps a reference to the surface.
class Flat_patches {
public:
  /// Of normals of coplanar facets whose coordinates are rounded to binary32.
  static constexpr double coplanar_sine = 1e-7;
  static constexpr double level_sine = 1.73e-3; ///< a tenth of a degree

  explicit Flat_patches(const Surface& surface, double max_sine = level_sine,
                        internal::Concurrency concurrency = Sequential_tag())
      : m_surface(surface), m_max_sine(max_sine)
  {
    const int facets = int(surface.triangles.size());
    m_patches.resize(facets);
    m_widths.resize(facets);
    internal::Unset_vector<int> root(facets); // of what is linked, by facet
    internal::for_each_index(concurrency, facets, [&](int f) { root[f] = f; });
    internal::Unset_vector<char> is_alone(facets); // in no patch but its own
    internal::for_each_index(concurrency, facets, [&](int f) {
      is_alone[f] = true;
      m_patches[f] = none;
      for_each_linked(f, [&](int g) {
        is_alone[f] = false;
        if (g < f) join_trees(root.data(), f, g);
      });
      if (!is_alone[f]) return;
      m_patches[f] = f;
      set_width(f, std::array<int, 1>{f}, [](int) { return true; });
    });
    const std::vector<int> others =
        internal::select(concurrency, facets, [&](int f) { return !is_alone[f]; });
    grow_others(others, root.data(), concurrency);
  }

  /// The first facet of the patch.
  int operator[](int facet) const { return m_patches[facet]; }

  /// The width of the patch of facet `f`: twice its area over its perimeter.
  double width(int f) const { return m_widths[m_patches[f]]; }

private:
  static constexpr int none = -1;

  bool are_flat(int f, int g, double max_sine) const
  {
    const Vec3d &m = m_surface.facet_normals[f], &n = m_surface.facet_normals[g];
    return dot(m, n) > 0 && squared_length(cross(m, n)) < max_sine * max_sine;
  }

  // Calls `f(g)` for the facets at the edges of `facet` that may be in a patch with it: the normals
  // of two facets of a patch differ by less than twice the angle.
  template <class F>
  void for_each_linked(int facet, F&& f) const
  {
    constexpr double twice = 2.001; // and rounding
    for (int h = 3 * facet; h < 3 * facet + 3; ++h) {
      const int o = m_surface.adjacency.opposite[h];
      if (o != Facet_adjacency::none && are_flat(facet, o / 3, twice * m_max_sine)) f(o / 3);
    }
  }

  // The patches of several facets: what is linked grows by its first facets, one after another.
  void grow_others(const std::vector<int>& others, int* root, internal::Concurrency concurrency)
  {
    const internal::Buckets<int> linked(
        concurrency, int(others.size()), m_patches.size(),
        [&](int k) { return root_of(root, others[k]); }, [&](int k) { return others[k]; });
    internal::for_each_index(concurrency, int(m_patches.size()), [&](int r) {
      for (int k = linked.first[r]; k < linked.first[r + 1]; ++k) {
        internal::Cancellation::poll_now_and_then();
        if (m_patches[linked.entries[k]] == none) grow(linked.entries[k]);
      }
    });
  }

  // Others may grow meanwhile, by facets that are not linked to these.
  void grow(int seed)
  {
    const auto patch = [this](int f) { return atomic_load(&m_patches[f]); };
    const auto add = [&](int f) { atomic_store(&m_patches[f], seed); };
    std::vector<int> facets(1, seed);
    add(seed);
    for (std::size_t k = 0; k < facets.size(); ++k)
      for (int h = 3 * facets[k]; h < 3 * facets[k] + 3; ++h) {
        const int o = m_surface.adjacency.opposite[h];
        if (o == Facet_adjacency::none || patch(o / 3) != none ||
            !are_flat(o / 3, seed, m_max_sine))
          continue;
        add(o / 3);
        facets.push_back(o / 3);
      }
    const auto is_boundary = [&](int h) {
      const int o = m_surface.adjacency.opposite[h];
      return o == Facet_adjacency::none || patch(o / 3) != seed;
    };
    set_width(seed, facets, is_boundary);
  }

  // Of the patch of these facets.
  template <class Facets, class IsBoundary>
  void set_width(int seed, const Facets& facets, IsBoundary&& is_boundary)
  {
    double area = 0, perimeter = 0;
    for (const int f : facets) {
      area += m_surface.facet_areas[f];
      for (int h = 3 * f; h < 3 * f + 3; ++h)
        if (is_boundary(h))
          perimeter += length(m_surface.points[halfedge_target(m_surface.triangles, h)] -
                              m_surface.points[halfedge_source(m_surface.triangles, h)]);
    }
    m_widths[seed] = 2 * area / perimeter;
  }

  const Surface& m_surface;
  double m_max_sine;
  internal::Unset_vector<int> m_patches;   // by facet: the first of its patch
  internal::Unset_vector<double> m_widths; // by first facet
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_FEATURES_FLAT_PATCHES_H
