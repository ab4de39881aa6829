// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_TEST_TOPOLOGY_COUNTS_H
#define CGAL_POWER_RTF_TEST_TOPOLOGY_COUNTS_H

#include <CGAL/PowerRTF/Remeshing_report.h>

#include <doctest/doctest.h>

namespace CGAL::PowerRTF {

/// Compares what is counted of two, but for networks.
inline void check_counts(const Topology_statistics& t, const Topology_statistics& expected)
{
  CHECK(t.vertices == expected.vertices);
  CHECK(t.edges == expected.edges);
  CHECK(t.faces == expected.faces);
  CHECK(t.components == expected.components);
  CHECK(t.border_edges == expected.border_edges);
  CHECK(t.border_loops == expected.border_loops);
  CHECK(t.non_manifold_edges == expected.non_manifold_edges);
  CHECK(t.non_manifold_vertices == expected.non_manifold_vertices);
  CHECK(t.euler_characteristic == expected.euler_characteristic);
  CHECK(t.oriented == expected.oriented);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_TEST_TOPOLOGY_COUNTS_H
