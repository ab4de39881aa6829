// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The surface that backends make, here the host's; test_cuda_device has the GPU's.
#include "built_surfaces.h"

#include <CGAL/PowerRTF/engines/arrange_facets.h>
#include <CGAL/PowerRTF/engines/build_surface.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>

#include <doctest/doctest.h>

#include <vector>

using namespace CGAL::PowerRTF;

TEST_CASE_TEMPLATE("what a backend makes of clean triangles is the surface that the host makes",
                   Tag, CGAL::Sequential_tag, CGAL::Parallel_if_available_tag)
{
  built_surfaces::check([](const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles,
                           Surface& surface) {
    Host_backend<Tag> backend;
    internal::Facet_buffers<Host_backend<Tag>> there;
    return build_surface(backend, points, triangles, surface, there);
  });
}

TEST_CASE_TEMPLATE("facets that a backend arranges are in the tree that the host makes", Tag,
                   CGAL::Sequential_tag, CGAL::Parallel_if_available_tag)
{
  built_surfaces::check_trees([](const Surface& surface, int* order, Child_boxes* nodes) {
    Host_backend<Tag> backend;
    return arrange_facets(backend, surface, order, nodes);
  });
}
