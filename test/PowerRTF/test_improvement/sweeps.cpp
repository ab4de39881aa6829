// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sweeps over all vertices of a mesh, as loops that a backend runs.
#include "../counting_backend.h"
#include "../odd_shapes.h"
#include "../sweeps_case.h"

#include <CGAL/PowerRTF/improvement/Mesh_sweeper.h>
#include <CGAL/PowerRTF/improvement/color_order.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

using namespace improvement_case;

namespace {

struct Named_case {
  std::string name;
  std::unique_ptr<Sweeps_case> mesh;
  double least_gain; ///< of the distance, by a fit
};

const std::vector<Named_case>& all()
{
  static const std::vector<Named_case> cases = [] {
    std::vector<Named_case> list;
    const auto add = [&list](const std::string& name, const shapes::Soup& soup, std::size_t n,
                             double least_gain) {
      list.push_back({name, std::make_unique<Sweeps_case>(soup, n), least_gain});
    };
    add("ellipsoid", shapes::ellipsoid(1, 0.7, 0.4, 4), 2000, 1.5);
    add("cylinder with borders", shapes::open_cylinder(40, 10, .5, 2), 400, 1.1);
    add("few vertices", shapes::icosphere(2), 12, 1);
    return list;
  }();
  return cases;
}

// The colors of the stars' vertices, which had `colors`. Those in the order of each color are
// checked to be all of it.
std::vector<int> recolored(const internal::Flat_stars& stars, std::vector<int> colors,
                           internal::Concurrency concurrency)
{
  const internal::Color_order order = internal::color_order(stars, colors, concurrency);
  std::vector<int> result(stars.size(), internal::Color_vertices::none);
  for (std::size_t color = 0; color + 1 < order.first.size(); ++color)
    for (int k = order.first[color]; k < order.first[color + 1]; ++k) {
      CHECK(result[order.vertices[k]] == internal::Color_vertices::none);
      result[order.vertices[k]] = int(color);
    }
  CHECK(result == colors);
  return result;
}

// Changes some of all that can change between sweeps, and does some of it in vain.
void edit(internal::Star_mesh& mesh, unsigned seed)
{
  using Star_mesh = internal::Star_mesh;
  std::mt19937 random(seed);
  const auto is_chosen = [&](unsigned one_in) { return random() % one_in == 0; };
  auto& working = mesh.working();
  const auto flip_some = [&](unsigned one_in) {
    for (const auto e : working.mesh.edges())
      if (is_chosen(one_in) && mesh.is_free(e) && working.is_flippable(e)) mesh.flip(e);
  };
  flip_some(200);
  {
    Star_mesh::Checkpoint before(mesh);
    flip_some(200);
    seed % 2 == 0 ? before.rewind() : before.restore();
  }
  for (int v = 0; v < int(mesh.size()); ++v) {
    const Star_mesh::Vertex vertex(v);
    if (!mesh.is_movable(vertex)) {
      mesh.release(vertex);
      continue;
    }
    if (is_chosen(50)) mesh.pin(vertex);
    if (is_chosen(50)) mesh.move_off(vertex, mesh.point(vertex) * 1.001);
  }
  int gone = 0; // and come again elsewhere
  for (const auto h : working.mesh.halfedges()) {
    if (working.mesh.is_removed(h) || !is_chosen(100)) continue;
    const auto s = working.mesh.source(h), t = working.mesh.target(h);
    if (gone > 0) {
      if (!mesh.is_movable(s) || !mesh.is_movable(t)) continue;
      mesh.split(h, mesh.projector().nearest((mesh.point(s) + mesh.point(t)) * .5));
      --gone;
    } else if (mesh.is_movable(s) && mesh.is_movable(t) &&
               CGAL::Euler::does_satisfy_link_condition(working.mesh.edge(h), working.mesh)) {
      mesh.collapse(h);
      ++gone;
    }
  }
  for (const auto e : working.mesh.edges()) {
    if (gone == 0) break;
    const auto h = working.mesh.halfedge(e);
    const auto s = working.mesh.source(h), t = working.mesh.target(h);
    if (!mesh.is_movable(s) || !mesh.is_movable(t)) continue;
    mesh.split(h, mesh.projector().nearest((mesh.point(s) + mesh.point(t)) * .5));
    --gone;
  }
  REQUIRE(gone == 0);
}

// Notes what it is given, and has no room when it is told so.
class Noting_sweeps : public Star_sweeps_base {
public:
  explicit Noting_sweeps(std::unique_ptr<Star_sweeps_base> sweeps) : m_sweeps(std::move(sweeps)) {}

  bool take(const internal::Flat_stars& stars) override
  {
    taken.push_back(stars.are_all ? -1 : stars.size());
    return has_room && m_sweeps->take(stars);
  }
  void smooth(int steps) override { m_sweeps->smooth(steps); }
  bool fit(const internal::Flat_fit& fit) override { return has_room_to_fit && m_sweeps->fit(fit); }
  void read(internal::Swept_vertices& swept) override { m_sweeps->read(swept); }

  std::vector<int> taken; // so many stars; -1: all
  bool has_room = true, has_room_to_fit = true;

private:
  std::unique_ptr<Star_sweeps_base> m_sweeps;
};

std::vector<int> smooth(internal::Mesh_sweeper& sweeper, int steps)
{
  return sweeper.sweep([&](Star_sweeps_base& sweeps) {
    sweeps.smooth(steps);
    return true;
  });
}

// Of a mesh, by sweeps over it.
std::vector<int> fit(internal::Mesh_sweeper& sweeper, const internal::Star_mesh& mesh)
{
  const Surface& surface = mesh.projector().surface();
  const internal::Distance_tracker tracker(
      mesh,
      internal::tracked_points(surface, mesh.projector().tree(), mesh.size(), mesh.concurrency()));
  const internal::Flat_fit fit = flat_fit(mesh, tracker, Flat_patches(surface), 0.3);
  return sweeper.sweep([&](Star_sweeps_base& sweeps) { return sweeps.fit(fit); });
}

// As an engine finds them.
template <class Tag>
internal::Unset_vector<int> nearest_faces(const Sweeps_case& c)
{
  counting::Counted_engine<float, Tag> engine(c.surface(), Remeshing_options());
  engine.facet_finder(); // the surface is there
  return c.nearest_faces(engine.mesh_bringer());
}

} // namespace

TEST_CASE("vertices of one color are no neighbors, and most keep theirs when edges are flipped")
{
  for (const auto& [name, c, least_gain] : all()) {
    CAPTURE(name);
    internal::Star_mesh mesh = c->mesh();
    std::vector<int> colors(mesh.size(), internal::Color_vertices::none);
    for (int pass = 0; pass < 3; ++pass) {
      const internal::Flat_stars stars = flat_stars(mesh);
      const std::vector<int> before = colors,
                             sequential = recolored(stars, before, CGAL::Sequential_tag());
      colors = recolored(stars, before, CGAL::Parallel_if_available_tag());
      CHECK(colors == sequential);
      int kept = 0;
      for (int v = 0; v < stars.size(); ++v) {
        CHECK((colors[v] >= 0) == bool(stars.kinds[v] & internal::is_movable_kind));
        for (int k = stars.first[v]; k < stars.first[v + 1]; ++k)
          CHECK(colors[stars.neighbors[k]] != colors[v]);
        kept += colors[v] == before[v];
      }
      if (pass > 0) CHECK(kept > 0.8 * stars.size());
      int e = 0;
      for (const auto edge : mesh.working().mesh.edges())
        if (++e % (19 + pass) == 0 && mesh.is_free(edge) && mesh.working().is_flippable(edge))
          mesh.flip(edge);
    }
  }
}

TEST_CASE("vertices are listed by as many colors as they have had")
{
  constexpr int colors = 3 * internal::Colored_parts::colors_at_once + 1, unused = 4;
  for (const auto& [name, c, least_gain] : all()) {
    CAPTURE(name);
    const internal::Flat_stars stars = flat_stars(c->mesh());
    std::vector<int> before(stars.size());
    for (int v = 0; v < stars.size(); ++v)
      before[v] = v % colors == unused ? internal::Color_vertices::none : v % colors;
    const std::vector<int> after = recolored(stars, before, CGAL::Parallel_if_available_tag());
    CHECK(after == recolored(stars, before, CGAL::Sequential_tag()));
    CHECK(*std::max_element(after.begin(), after.end()) >= std::min(stars.size(), colors) - 2);
  }
  CHECK(internal::color_order({}, CGAL::Sequential_tag()).first == std::vector<int>{0});
}

TEST_CASE("a sweep smooths one vertex after the other, whatever the number of threads")
{
  constexpr int steps = 3;
  for (const auto& [name, mesh, least_gain] : all()) {
    CAPTURE(name);
    const Sweeps_case& c = *mesh;
    internal::Star_mesh one_by_one = c.mesh();
    const internal::Flat_stars stars = flat_stars(one_by_one);
    const internal::Color_order order = internal::color_order(stars, CGAL::Sequential_tag());
    for (int step = 0; step < steps; ++step)
      for (int k = order.first.front(); k < order.first.back(); ++k)
        smooth_vertex(one_by_one, internal::Star_mesh::Vertex(order.vertices[k]));
    const auto sequential = c.smoothed(*c.host_sweeps(CGAL::Sequential_tag()), steps),
               parallel = c.smoothed(*c.host_sweeps(CGAL::Parallel_if_available_tag()), steps);
    CHECK(sequential.points == parallel.points);
    CHECK(sequential.normals == parallel.normals);
    CHECK(sequential.facets == parallel.facets);
    CHECK(distances(flat_stars(one_by_one), sequential).back() < 1e-9 * c.spacing());
    CHECK((order.first.size() == 1 || sequential.points != stars.points));
  }
}

TEST_CASE("vertices stay as high over the surface as they are when they are smoothed")
{
  const Sweeps_case& c = *all()[0].mesh;
  internal::Star_mesh one_by_one = c.mesh();
  for (int v = 0; v < int(one_by_one.size()); v += 3) {
    const internal::Star_mesh::Vertex vertex(v);
    const double height = (v % 2 ? 0.1 : -0.1) * c.spacing();
    if (one_by_one.is_movable(vertex))
      one_by_one.move_off(vertex, one_by_one.point(vertex) + height * one_by_one.normal(vertex));
  }
  const internal::Flat_stars stars = flat_stars(one_by_one);
  const internal::Color_order order = internal::color_order(stars, CGAL::Sequential_tag());
  for (int k = order.first.front(); k < order.first.back(); ++k)
    smooth_vertex(one_by_one, internal::Star_mesh::Vertex(order.vertices[k]));
  const auto sweeps = c.host_sweeps(CGAL::Sequential_tag());
  internal::Swept_vertices swept;
  REQUIRE(sweeps->take(stars));
  sweeps->smooth(1);
  sweeps->read(swept);
  CHECK(swept.points != stars.points);
  CHECK(swept.heights == stars.heights);
  CHECK(distances(flat_stars(one_by_one), swept).back() < 1e-9 * c.spacing());
}

TEST_CASE("sweeps over what is there, but for what has changed, are those over all")
{
  for (const auto& [name, c, least_gain] : all())
    for (const bool is_parallel : {false, true}) {
      CAPTURE(name);
      const internal::Concurrency concurrency =
          is_parallel ? internal::Concurrency(CGAL::Parallel_if_available_tag())
                      : internal::Concurrency(CGAL::Sequential_tag());
      internal::Star_mesh mesh = c->mesh(), expected = c->mesh();
      Noting_sweeps sweeps(c->host_sweeps(concurrency)), over_all(c->host_sweeps(concurrency));
      internal::Mesh_sweeper sweeper(mesh, nullptr, sweeps);
      for (unsigned pass = 0; pass < 5; ++pass) {
        CAPTURE(pass);
        internal::Mesh_sweeper anew(expected, nullptr, over_all);
        if (pass == 3)
          CHECK(fit(sweeper, mesh) == fit(anew, expected));
        else
          CHECK(smooth(sweeper, 2) == smooth(anew, 2));
        const auto swept = flat_stars(mesh), as_expected = flat_stars(expected);
        CHECK(swept.points == as_expected.points);
        CHECK(swept.normals == as_expected.normals);
        CHECK(swept.facets == as_expected.facets);
        CHECK(swept.heights == as_expected.heights);
        edit(mesh, pass);
        edit(expected, pass);
      }
      CHECK(over_all.taken == std::vector<int>(5, -1));
      CHECK(sweeps.taken.front() == -1);
      for (std::size_t k = 1; k < 5 && mesh.size() > 100; ++k) {
        CHECK(sweeps.taken[k] >= 0);
        CHECK(sweeps.taken[k] <= int(mesh.size()) / 2);
      }
    }
}

TEST_CASE("what sweeps know of one mesh is not taken for another's that came in between")
{
  const shapes::Soup soup = shapes::ellipsoid(1, 0.7, 0.4, 4);
  const Sweeps_case mesh(soup, 500), larger(soup, 4000);
  const auto sweeps = mesh.host_sweeps(CGAL::Sequential_tag()),
             others = mesh.host_sweeps(CGAL::Sequential_tag());
  const auto expected = mesh.smoothed(*others, 2);
  CHECK(mesh.smoothed(*sweeps, 2).points == expected.points);
  REQUIRE(sweeps->take(flat_stars(larger.mesh()))); // needs more memory, but is not swept over
  CHECK(mesh.smoothed(*sweeps, 2).points == expected.points);
  CHECK(larger.smoothed(*sweeps, 2).points == larger.smoothed(*others, 2).points);
  CHECK(mesh.smoothed(*sweeps, 2).points == expected.points);
}

TEST_CASE("where an engine has no room the host sweeps, and the next time all goes there again")
{
  const Sweeps_case& c = *all()[0].mesh;
  internal::Star_mesh mesh = c.mesh();
  Noting_sweeps there(c.host_sweeps(CGAL::Sequential_tag())),
      here(c.host_sweeps(CGAL::Sequential_tag()));
  internal::Mesh_sweeper sweeper(mesh, &there, here);
  const auto step = [&] {
    const internal::Flat_stars before = flat_stars(mesh);
    smooth(sweeper, 1);
    CHECK(flat_stars(mesh).points != before.points);
  };
  step();
  CHECK(sweeper.changes() == 0);
  edit(mesh, 1);
  const std::size_t edited = sweeper.changes();
  step();
  CHECK(there.taken.size() == 2);
  CHECK(int(edited) == there.taken[1]);
  CHECK(there.taken[1] > 0);
  CHECK(here.taken.empty());
  there.has_room = false;
  step();
  step();
  CHECK(there.taken == std::vector<int>{-1, there.taken[1], 0, -1});
  CHECK(here.taken == std::vector<int>{-1, 0});
  CHECK(sweeper.changes() == edited);
  there.has_room = true;
  step();
  step();
  CHECK(there.taken == std::vector<int>{-1, there.taken[1], 0, -1, -1, 0});
  CHECK(here.taken.size() == 2);
  there.has_room_to_fit = false;
  fit(sweeper, mesh);
  CHECK(here.taken.size() == 3);
  step();
  CHECK(there.taken.back() == -1);
  CHECK(sweeper.changes() == edited);
  edit(mesh, 2);
  CHECK(sweeper.changes() > edited);
}

TEST_CASE("the faces that are nearest to the surface's vertices are those of a search of all")
{
  struct Mesh {
    std::string name;
    Sweeps_case mesh;
    bool has_sheets; // which a face that is nearer does not belong to
  };
  const Mesh meshes[] = {{"ellipsoid", {shapes::ellipsoid(1, 0.7, 0.4, 3), 500}, false},
                         {"two sheets", {shapes::shell(3, 0.05), 100}, true},
                         {"borders", {shapes::open_cylinder(40, 10, .5, 2), 400}, false},
                         {"few vertices", {shapes::icosphere(2), 12}, false}};
  for (const auto& [name, c, has_sheets] : meshes) {
    CAPTURE(name);
    const auto nearest = nearest_faces<CGAL::Sequential_tag>(c);
    REQUIRE(int(nearest.size()) == c.vertices_of_surface());
    CHECK(nearest == nearest_faces<CGAL::Parallel_if_available_tag>(c));
    const double rounding = 1e-12 * c.spacing();
    int on_other_sheet = 0;
    std::vector<double> least(nearest.size(), std::numeric_limits<double>::infinity());
    for (int v = 0; v < int(nearest.size()); ++v) {
      double least_of_any = least[v];
      for (int f = 0; f < c.faces(); ++f) {
        least[v] = std::min(least[v], c.distance(v, f));
        least_of_any = std::min(least_of_any, c.distance(v, f, true));
      }
      on_other_sheet += least_of_any < 0.9 * least[v];
      CHECK((nearest[v] < 0) == (least[v] == std::numeric_limits<double>::infinity()));
      if (nearest[v] >= 0) CHECK(c.distance(v, nearest[v]) <= least[v] + rounding);
    }
    CHECK((on_other_sheet > 0) == has_sheets);
    const internal::Distance_tracker tracker = c.tracker(nearest), without = c.tracker({});
    for (int i = 0; i < tracker.size(); ++i) {
      const int v = tracker[i].vertex;
      CHECK(tracker[i].distance <= without[i].distance + rounding);
      if (nearest[v] >= 0) CHECK(tracker[i].distance <= least[v] + rounding);
    }
  }
}

TEST_CASE("a fit is the same for any number of threads, and brings the mesh nearer to the surface")
{
  for (const auto& [name, mesh, least_gain] : all()) {
    CAPTURE(name);
    double gain = 0, same_gain = 0;
    const auto sequential = mesh->fitted(*mesh->host_sweeps(CGAL::Sequential_tag()), gain),
               parallel =
                   mesh->fitted(*mesh->host_sweeps(CGAL::Parallel_if_available_tag()), same_gain);
    CHECK(sequential.points == parallel.points);
    CHECK(sequential.normals == parallel.normals);
    CHECK(same_gain == gain);
    CHECK(gain > least_gain);
  }
}
