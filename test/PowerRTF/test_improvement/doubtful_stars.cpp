// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What sweeps leave to be looked at, against searches of whole meshes.
#include "../sweeps_case.h"

#include <CGAL/PowerRTF/improvement/improve_mesh.h>
#include <CGAL/PowerRTF/sampling/random_source.h>

#include <CGAL/tags.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

using namespace improvement_case;

namespace {

struct Named_case {
  std::string name;
  Case c;
};

// Lattices of which one in `stride` points is up to `noise` times h off.
std::vector<Named_case> noisy_cases(std::size_t stride, double noise)
{
  const auto lattice = [](const shapes::Soup& soup) {
    return make_case(soup, 3000, 1, Sampling::lattice);
  };
  std::vector<Named_case> cases{
      {"sphere", lattice(shapes::icosphere(4))},
      {"torus with features", lattice(shapes::torus(60, 30, 1, .4))},
      {"cylinder with borders", lattice(shapes::open_cylinder(40, 10, .5, 2))}};
  for (const Triangle& t : cases[1].c.raw.triangles) // those at every 100th vertex
    for (int k = 0; k < 3; ++k)
      if (t[k] % 100 == 0)
        for (int l = 0; l < 3; ++l) cases[1].c.raw.feature_edges.push_back({t[l], t[(l + 1) % 3]});
  for (Named_case& named : cases) {
    std::vector<Vec3d>& points = named.c.raw.points;
    const double h = std::sqrt(named.c.surface.area / double(points.size()));
    for (std::size_t v = 0; v < points.size(); v += stride) {
      const auto random = [&](std::uint64_t axis) { return 2 * counted_random(1, v, axis) - 1; };
      points[v] += noise * h / std::sqrt(3.) * Vec3d{random(0), random(1), random(2)};
    }
  }
  return cases;
}

enum class Doubtful { none, as_found, all };

// Sweeps on the host after which other vertices are doubtful.
class Other_doubts : public Star_sweeps_base {
public:
  Other_doubts(std::unique_ptr<Star_sweeps_base> sweeps, Doubtful doubtful)
      : m_sweeps(std::move(sweeps)), m_doubtful(doubtful)
  {}

  bool take(const internal::Flat_stars& stars) override { return m_sweeps->take(stars); }
  void smooth(int steps) override { m_sweeps->smooth(steps); }
  bool fit(const internal::Flat_fit& fit) override { return m_sweeps->fit(fit); }
  void read(internal::Swept_vertices& swept) override
  {
    m_sweeps->read(swept);
    if (m_doubtful == Doubtful::as_found) return;
    swept.doubtful.resize(m_doubtful == Doubtful::all ? swept.size() : 0);
    std::iota(swept.doubtful.begin(), swept.doubtful.end(), 0);
  }

private:
  std::unique_ptr<Star_sweeps_base> m_sweeps;
  Doubtful m_doubtful;
};

Extracted_mesh improved(const Case& c, Doubtful doubtful)
{
  Improvement_settings settings;
  settings.dislocations = Dislocations::keep;
  settings.make_sweeps = [&](const Surface_descent& surface, double grid) {
    return std::make_unique<Other_doubts>(
        internal::make_host_star_sweeps(surface, grid, CGAL::Sequential_tag()), doubtful);
  };
  Extracted_mesh mesh = c.raw;
  CHECK(improve_mesh(c.surface, Facet_tree(c.surface.points, c.surface.triangles), mesh,
                     CGAL::Sequential_tag(), settings));
  return mesh;
}

bool are_equal(const Extracted_mesh& a, const Extracted_mesh& b)
{
  return a.points == b.points && a.triangles == b.triangles;
}

} // namespace

TEST_CASE("bad triangles are at doubtful vertices")
{
  for (const auto& [name, c] : noisy_cases(1, 0.4)) {
    CAPTURE(name);
    const Sweeps_case mesh(c);
    const auto sequential = mesh.host_sweeps(CGAL::Sequential_tag()),
               parallel = mesh.host_sweeps(CGAL::Parallel_if_available_tag());
    const auto check = [&](const internal::Swept_vertices& stars, int least_bad) {
      const Doubts found = doubts(mesh.mesh(), stars);
      CHECK(found.bad >= least_bad);
      CHECK(found.missed == 0);
      CHECK(std::is_sorted(stars.doubtful.begin(), stars.doubtful.end()));
      CHECK(stars.doubtful.size() < 0.8 * stars.size());
    };
    for (const int steps : {0, 1, 2}) {
      CAPTURE(steps);
      const internal::Swept_vertices stars = mesh.smoothed(*sequential, steps);
      check(stars, 20);
      CHECK(mesh.smoothed(*parallel, steps).doubtful == stars.doubtful);
    }
    double gain = 0;
    check(mesh.fitted(*sequential, gain), 100);
  }
}

TEST_CASE("to look at doubtful vertices alone changes nothing")
{
  for (const auto& [name, c] : noisy_cases(20, 1)) {
    CAPTURE(name);
    const Extracted_mesh better = improved(c, Doubtful::all);
    CHECK(are_equal(improved(c, Doubtful::as_found), better));
    CHECK(!are_equal(improved(c, Doubtful::none), better));
  }
}
