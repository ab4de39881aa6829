// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a GPU does to a mesh that is improved, against the host.
#include "../engine_comparison.h"

#ifdef CGAL_POWER_RTF_WITH_CUDA

#include "../counting_backend.h"
#include "../odd_shapes.h"
#include "../sweeps_case.h"

#include <CGAL/PowerRTF/engines/Cuda_engine.h>

#include <cmath>
#include <utility>
#include <vector>

using namespace engine_comparison;
using improvement_case::Sweeps_case;

namespace {

/// An engine on the GPU, with the surface of meshes.
class Device {
public:
  explicit Device(const Surface& surface) : m_engine(surface, Remeshing_options())
  {
    m_engine.facet_finder(); // the surface is there
  }
  Bring_mesh bringer() { return m_engine.mesh_bringer(); }
  Make_star_sweeps maker() { return m_engine.star_sweeps_maker(); }

private:
  Cuda_engine<float> m_engine;
};

} // namespace

TEST_CASE("sweeps over a mesh move its vertices as the host's loops do")
{
  const shapes::Soup fine = shapes::ellipsoid(1, 0.7, 0.4, 6);
  struct Mesh {
    shapes::Soup soup;
    int n;
    double bound; // of nine tenths of the distances, in the spacing: a fit is in single precision
  };
  // Of a cylinder's strips two are as near to a point: rounding chooses.
  for (const auto& [soup, n, bound] :
       {Mesh{shapes::icosphere(2), 12, 1e-6}, Mesh{shapes::open_cylinder(40, 10, .5, 2), 400, 0.01},
        Mesh{fine, 3000, 1e-6}, Mesh{fine, 40000, 1e-6}}) {
    CAPTURE(n);
    const Sweeps_case mesh(soup, n);
    Device device(mesh.surface());
    const auto on_device = mesh.sweeps(device.maker()),
               on_host = mesh.host_sweeps(CGAL::Parallel_if_available_tag());
    const auto smooth = mesh.smoothed(*on_device, 2), smooth_on_host = mesh.smoothed(*on_host, 2);
    REQUIRE(smooth.size() == int(mesh.mesh().size()));
    CHECK(improvement_case::distances(smooth, smooth_on_host).back() < 1e-11 * mesh.spacing());
    CHECK(mesh.smoothed(*on_device, 2).points == smooth.points);
    CHECK(improvement_case::doubts(mesh.mesh(), smooth).missed == 0);
    if (n > 1000) CHECK(smooth.doubtful.size() < 0.8 * n);
    double gain = 0, gain_on_host = 0;
    const auto fit = mesh.fitted(*on_device, gain),
               fit_on_host = mesh.fitted(*on_host, gain_on_host);
    REQUIRE(fit.size() == smooth.size());
    CHECK(improvement_case::doubts(mesh.mesh(), fit).missed == 0);
    const std::vector<double> d = improvement_case::distances(fit, fit_on_host);
    CHECK(d[d.size() * 9 / 10] < bound * mesh.spacing());
    CHECK(std::fabs(gain - gain_on_host) < 0.01 * gain_on_host);
  }
}

TEST_CASE("stars that are made on the GPU are smoothed as those that go up")
{
  for (const auto& [soup, n] :
       {std::pair(shapes::icosphere(2), 12), std::pair(shapes::open_cylinder(40, 10, .5, 2), 400),
        std::pair(shapes::ellipsoid(1, 0.7, 0.4, 6), 40000)}) {
    CAPTURE(n);
    const Sweeps_case mesh(soup, n);
    Device device(mesh.surface());
    const auto sweeps = mesh.sweeps(device.maker());
    const auto expected = mesh.smoothed(*sweeps, 2);
    const internal::Flat_stars stars = flat_stars(mesh.mesh());
    Extracted_mesh raw;
    raw.points.resize(mesh.mesh().size());
    mesh.mesh().write(raw);
    const auto there = raw.there(device.bringer());
    Triangle_links links;
    REQUIRE(there->topology(&links));
    REQUIRE(there->give_stars({stars.kinds.data(), stars.normals.data(), stars.facets.data()},
                              *sweeps));
    internal::Swept_vertices swept;
    sweeps->smooth(2);
    sweeps->read(swept);
    CHECK(swept.points == expected.points);
    CHECK(swept.doubtful == expected.doubtful);
  }
}

// What the host finds is compared with a search of all in test_improvement/sweeps.cpp.
TEST_CASE("the faces that are nearest to a surface's vertices are as near as the host's")
{
  struct Mesh {
    shapes::Soup soup;
    int n;
  };
  for (const auto& [soup, n] : {Mesh{shapes::icosphere(2), 12}, Mesh{shapes::shell(3, 0.05), 100},
                                Mesh{shapes::open_cylinder(40, 10, .5, 2), 400},
                                Mesh{shapes::ellipsoid(1, 0.7, 0.4, 6), 40000}}) {
    CAPTURE(n);
    const Sweeps_case mesh(soup, n);
    Device device(mesh.surface());
    counting::Counted_engine<float, CGAL::Parallel_if_available_tag> host(mesh.surface(),
                                                                          Remeshing_options());
    host.facet_finder();
    const auto nearest = mesh.nearest_faces(device.bringer()),
               on_host = mesh.nearest_faces(host.mesh_bringer());
    REQUIRE(int(nearest.size()) == mesh.vertices_of_surface());
    for (int v = 0; v < int(nearest.size()); ++v) {
      REQUIRE((nearest[v] < 0) == (on_host[v] < 0)); // no normal is at the limit
      if (nearest[v] < 0) continue;
      const double on_device = mesh.distance(v, nearest[v]);
      CHECK(std::fabs(on_device - mesh.distance(v, on_host[v])) < 1e-12 * mesh.spacing());
    }
  }
}

#endif
