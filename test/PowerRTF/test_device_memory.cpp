// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The memory that a run takes on a device, as it is told before, against what an engine on the host
// takes whose arrays are counted; and what goes up. (On a device: test_cuda_device/memory.cpp.)
#include "engine_comparison.h"
#include "sweeps_case.h"

#include <CGAL/PowerRTF/cells/Tree_cells.h>
#include <CGAL/PowerRTF/engines/Engine.h>
#include <CGAL/PowerRTF/engines/Surface_engine.h>
#include <CGAL/PowerRTF/geometry/Surface_facets.h>
#include <CGAL/PowerRTF/geometry/halve_edges.h>
#include <CGAL/PowerRTF/geometry/make_surface_in_tree.h>
#include <CGAL/PowerRTF/geometry/split_at_centers.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/quality/surface_distance.h>

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

using namespace engine_comparison;

namespace {

using Backend = Host_backend<CGAL::Sequential_tag>;

/// Its loops run on the host; its arrays are copies, as on a device, and counted.
class Counting_backend : public Backend {
public:
  static constexpr bool is_host = false;
  static constexpr int device = 7;
  inline static std::size_t uploaded = 0; ///< bytes, by all of them

  /// Bytes that count for as long as it lives.
  struct Uncount {
    std::size_t bytes;
    void operator()(Counting_backend* backend) const { backend->m_bytes -= bytes; }
  };
  using Count = std::unique_ptr<Counting_backend, Uncount>;

  template <class T>
  class Buffer {
  public:
    void allocate(Counting_backend& backend, std::size_t n)
    {
      m_items.allocate(backend, n);
      if (n * sizeof(T) > m_count.get_deleter().bytes) {
        m_count.reset();
        m_count = backend.counted(n * sizeof(T));
      }
    }
    T* data() { return m_items.data(); }
    const T* data() const { return m_items.data(); }
    std::size_t size() const { return m_items.size(); }

  private:
    Backend::Buffer<T> m_items;
    Count m_count;
  };

  static bool has(const Resident_surface& surface) { return surface.device == device; }
  template <class T>
  void upload(T* to, const T* from, std::size_t n)
  {
    uploaded += n * sizeof(T);
    Backend::upload(to, from, n);
  }
  std::size_t bytes() const { return m_most; }
  static std::size_t least_bytes() { return 0; }

private:
  Count counted(std::size_t bytes)
  {
    m_bytes += bytes;
    m_most = std::max(m_most, m_bytes);
    return {this, {bytes}};
  }

  std::size_t m_bytes = 0, m_most = 0;
};

/// Those of the host, which are not counted.
class Host_cells : public Tree_cells<float, Backend> {
public:
  using Tree_cells::Tree_cells;
  static std::size_t bytes(int, bool) { return 0; }
  static std::size_t neighbors_bytes(int) { return 0; }
};

using Counted = Engine<float, Counting_backend, Host_cells>;

struct Make_counted {
  using Concurrency_tag = CGAL::Sequential_tag;
  static void check(const Run_sizes&, const Remeshing_options&) {}
  static Surface_work surface_work(const Remeshing_options&) { return {}; }
  static std::unique_ptr<Engine_base> make(const Surface_in_tree& surface,
                                           const Remeshing_options& options)
  {
    return std::make_unique<Counted>(surface, options);
  }
};

std::vector<Case> larger_cases()
{
  const shapes::Soup torus = shapes::torus(48, 24, 1, 0.3);
  std::vector<Case> all{
      {"quality, even", torus, options_of(false, Density::uniform, 2000)},
      {"quality, adaptive", torus, options_of(false, Density::curvature, 2000)},
      {"quality, two components", shapes::two_spheres(3),
       options_of(false, Density::uniform, 2000)},
      {"quality, creases", shapes::box(8), options_of(false, Density::uniform, 8000)},
      {"paper, even", torus, options_of(true, Density::uniform, 1000)},
      {"paper, adaptive", torus, options_of(true, Density::curvature, 1000)},
      {"stratified", torus, options_of(false, Density::uniform, 2000)},
      {"stratified, long memory", torus, options_of(false, Density::uniform, 2000)},
      {"stratified, no weights", torus, options_of(false, Density::uniform, 2000)}};
  for (std::size_t k = all.size() - 3; k < all.size(); ++k)
    all[k].options.sampling = Sampling::stratified; // else the lattice takes most
  all[all.size() - 2].options.lbfgs_memory = 10;
  all.back().options.weight_method = Weight_method::none;
  return all;
}

} // namespace

TEST_CASE("a run takes the memory that was told before, but for some per cent")
{
  for (const Case& c : larger_cases()) {
    CAPTURE(c.name);
    const Start start(c);
    const std::size_t taken = memory_of_run<Surface_engine<Make_counted>>(c, start);
    const std::size_t told = Counted::bytes(sizes_of(c, start), c.options);
    const double ratio = double(taken) / double(told);
    std::cout << c.name << ": " << taken << " bytes, told " << told << ", ratio " << ratio << '\n';
    const bool has_features = start.patches->features().size() > 0; // some samples have no cell
    CHECK(ratio >= (has_features ? 0.95 : 0.99));
    CHECK(ratio <= 1.05);
  }
}

TEST_CASE("the facets of a surface go up once, or not at all where they are there")
{
  const improvement_case::Sweeps_case mesh(shapes::ellipsoid(1, 0.7, 0.4, 4), 500);
  const Surface& surface = mesh.surface();
  const Facet_tree tree(surface.points, surface.triangles);
  const auto uploaded_by = [](const auto& f) {
    const std::size_t before = Counting_backend::uploaded;
    f();
    return Counting_backend::uploaded - before;
  };
  const auto here = std::make_shared<Resident_surface>();
  here->facets = surface;
  const std::size_t facets = internal::bytes_of_listed<internal::Facet_buffers<Counting_backend>>(
      surface.points.size(), surface.triangles.size());
  std::optional<std::size_t> least; // to make an engine
  for (const int device : {Counting_backend::device, 0}) {
    here->device = device;
    Surface_in_tree in_tree = internal::make_surface_in_tree(surface, tree);
    in_tree.resident = here;
    std::optional<Counted> engine;
    const std::size_t uploaded = uploaded_by([&] { engine.emplace(in_tree, Remeshing_options()); });
    if (!least) least = uploaded;
    CHECK(uploaded == *least + (device == Counting_backend::device ? 0 : facets));

    std::unique_ptr<Star_sweeps_base> sweeps;
    CHECK(uploaded_by([&] { sweeps = mesh.sweeps(engine->star_sweeps_maker()); }) == 0);
    const auto host = mesh.host_sweeps(CGAL::Sequential_tag());
    const auto stars = mesh.smoothed(*sweeps, 2), on_host = mesh.smoothed(*host, 2);
    REQUIRE(stars.size() == int(mesh.mesh().size()));
    CHECK(stars.points == on_host.points);
    CHECK(stars.facets == on_host.facets);

    const shapes::Soup other = shapes::icosphere(2);
    Distance_statistics distances;
    CHECK(uploaded_by([&] {
            distances = surface_distance(surface.points, surface.triangles, tree, other.points,
                                         other.triangles, CGAL::Sequential_tag(), false,
                                         engine->distance_finder());
          }) == sizeof(Vec3d) * other.points.size() + sizeof(Triangle) * other.triangles.size());
    CHECK(distances.mean ==
          surface_distance(surface.points, surface.triangles, tree, other.points, other.triangles)
              .mean);
  }
}

TEST_CASE("what is known of a surface's facets is forgotten when they change, and by a copy")
{
  Surface surface = shapes::make_surface(shapes::octahedron());
  const auto here = std::make_shared<Resident_surface>();
  surface.resident.value = here;
  CHECK(!Surface(surface).resident.value);
  Surface moved = std::move(surface);
  CHECK(moved.resident.value == here);
  SUBCASE("edges are halved") { halve_edges(moved, {0}); }
  SUBCASE("facets are split") { split_at_centers(moved, {0}); }
  CHECK(!moved.resident.value);
}

TEST_CASE("more samples and facets take more memory")
{
  const Case c = larger_cases().front();
  const Start start(c);
  Run_sizes sizes = sizes_of(c, start);
  std::size_t before = 0;
  for (sizes.samples = 1; sizes.samples < 1000000000; sizes.samples += sizes.samples / 5 + 1) {
    const std::size_t told = Counted::bytes(sizes, c.options);
    CHECK(told > before);
    before = told;
  }
  sizes.facets *= 2;
  CHECK(Counted::bytes(sizes, c.options) > before);
}
