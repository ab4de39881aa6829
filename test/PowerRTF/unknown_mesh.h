// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef POWER_RTF_TEST_UNKNOWN_MESH_H
#define POWER_RTF_TEST_UNKNOWN_MESH_H

#include "shapes.h"

#include <CGAL/PowerRTF/geometry/Resident_mesh.h>

#include <optional>
#include <vector>

namespace unknown {

using namespace CGAL::PowerRTF;

/// A mesh of which nothing is found.
class Mesh : public Resident_mesh {
public:
  std::optional<Topology_statistics> topology(Triangle_links*) override { return {}; }
  bool find_flips(std::vector<int>&) override { return false; }
  bool find_close_faces(Face_pairs&) override { return false; }
  bool find_distances(int, Two_sided_distances&) override { return false; }
  bool find_faces(double, int, const int*, int*) override { return false; }
  bool give_stars(const Vertex_places&, Star_sweeps_base&) override { return false; }
  void release() override {}
};

} // namespace unknown

namespace shapes {

inline CGAL::PowerRTF::Mesh_arrays arrays(const Soup& s)
{
  return {int(s.points.size()), s.points.data(), int(s.triangles.size()),
          s.triangles.empty() ? nullptr : s.triangles.front().data()};
}

} // namespace shapes

#endif // POWER_RTF_TEST_UNKNOWN_MESH_H
