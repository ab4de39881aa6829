// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A surface as an engine has it, on the host.
#ifndef CGAL_POWER_RTF_TEST_PACKED_H
#define CGAL_POWER_RTF_TEST_PACKED_H

#include <CGAL/PowerRTF/geometry/Surface_arrays.h>
#include <CGAL/PowerRTF/geometry/make_surface_in_tree.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>

#include <CGAL/tags.h>

using Packed_backend = CGAL::PowerRTF::Host_backend<CGAL::Sequential_tag>;

/// With the tree of its vertices, that the preset of the paper asks for.
template <class Real>
struct Packed {
  Packed_backend backend;
  CGAL::PowerRTF::Facet_tree tree;
  CGAL::PowerRTF::Surface_in_tree surface;
  CGAL::PowerRTF::Surface_arrays<Real, Packed_backend> arrays;

  /// Keeps references to the surface.
  explicit Packed(const CGAL::PowerRTF::Surface& s)
      : tree(s.points, s.triangles, s.facet_patches),
        surface(CGAL::PowerRTF::internal::make_surface_in_tree(s, tree, true)),
        arrays(backend, surface)
  {}
  explicit Packed(CGAL::PowerRTF::Surface&&) = delete;
  Packed(const Packed&) = delete;
  const CGAL::PowerRTF::Surface_view<Real>& view() const { return arrays.view(); }
};

#endif // CGAL_POWER_RTF_TEST_PACKED_H
