// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every option at, below and above its bounds, wherever options enter the library.
#include "shapes.h"

#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/option_table.h>
#include <CGAL/power_rtf_remeshing.h>

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

using namespace CGAL::PowerRTF;
namespace params = CGAL::PowerRTF::parameters;

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Remesher = CGAL::PowerRTF_remesher<CGAL::PowerRTF_traits_3<Kernel, CGAL::Sequential_tag>>;

Mesh make_mesh(const shapes::Soup& soup)
{
  std::vector<Kernel::Point_3> points;
  for (const Vec3d& p : soup.points) points.emplace_back(p.x, p.y, p.z);
  Mesh mesh;
  CGAL::Polygon_mesh_processing::polygon_soup_to_polygon_mesh(points, soup.triangles, mesh);
  return mesh;
}

/// With creases, so that all stages have something to do.
const shapes::Soup& box()
{
  static const shapes::Soup soup = shapes::box(4);
  return soup;
}

/// Calls `visit(option, member)` for each option that is a number.
template <class Visitor>
void for_each_number(Visitor&& visit)
{
  for_each_option([&](const Option& option, auto member) {
    using T = std::decay_t<decltype(Remeshing_options().*member)>;
    if constexpr (std::is_arithmetic<T>::value && !std::is_same<T, bool>::value)
      visit(option, member, T());
  });
}

/// The values of type `T` next to the range, and those that are never allowed.
template <class T>
std::vector<T> forbidden_values(const Option_range& range)
{
  using Limits = std::numeric_limits<T>;
  std::vector<T> values;
  if constexpr (Limits::is_integer) {
    if (range.lowest > double(Limits::lowest())) values = {T(range.lowest - 1), Limits::lowest()};
    if (range.highest < double(Limits::max())) {
      values.push_back(T(range.highest + 1));
      values.push_back(Limits::max());
    }
  } else {
    const T infinity = Limits::infinity();
    values = {std::nextafter(range.lowest, -infinity),
              std::nextafter(range.highest, infinity),
              -1,
              infinity,
              -infinity,
              Limits::quiet_NaN()};
    if (range.lowest == Option_range::above_zero) values.push_back(0);
  }
  return values;
}

/// Checks that `call` refuses `name`, and says what is allowed.
template <class Call>
void check_refuses(const std::string& name, const std::string& allowed, const Call& call)
{
  std::string said = "nothing";
  try {
    call();
  } catch (const Invalid_input_error& e) {
    said = e.what();
  }
  CAPTURE(said);
  CHECK(said.rfind(name + " is ", 0) == 0);
  CHECK(said.find(allowed) != std::string::npos);
}

/// Checks that all functions that take options refuse these.
void check_all_refuse(const Remeshing_options& options, const std::string& name,
                      const std::string& allowed)
{
  static const Mesh mesh = make_mesh(box());
  Surface surface = shapes::make_surface(box());
  const auto refuses = [&](const auto& call) { check_refuses(name, allowed, call); };
  refuses([&] { validate(options); });
  refuses([&] { set_creases(surface, options); });
  refuses([&] { set_density(surface, options); });
  refuses([&] { set_density(surface, options, std::vector<double>(surface.points.size(), 1)); });
  refuses([&] { sample_surface(surface, options); });
  refuses([&] { Remesher(surface, options); });
  const bool is_resolution = options.vertex_share != 0 || options.edge_length != 0 ||
                             options.relative_edge_length != 0 || options.size_factor != 0 ||
                             options.max_distance != 0 || options.relative_max_distance != 0;
  if (is_resolution) return; // an argument of its own of the function
  refuses([&] {
    Mesh output;
    CGAL::power_rtf_remeshing(mesh, options.number_of_samples, output,
                              params::remeshing_options(options));
  });
}

struct Stop_after : Remeshing_default_visitor {
  int iterations;
  explicit Stop_after(int n) : iterations(n) {}
  void on_iteration(const Iteration_report&, double) { --iterations; }
  bool go_further() const { return iterations > 0; }
};

} // namespace

TEST_CASE("the values of all presets are allowed, and differ")
{
  for (const Preset preset : {Preset::quality, Preset::fast, Preset::paper})
    CHECK(validate(Remeshing_options::of(preset)).preset == preset);
  CHECK(Remeshing_options::of(Preset::quality).weight_method == Weight_method::newton);
  CHECK(Remeshing_options::of(Preset::fast).weight_method == Weight_method::none);
  CHECK(Remeshing_options::of(Preset::paper).weight_method == Weight_method::multiplicative);
}

TEST_CASE("every option has a name and a meaning of its own")
{
  std::set<std::string> names, meanings;
  std::size_t rows = 0;
  for_each_option([&](const Option& option, auto) {
    ++rows;
    names.insert(option.name);
    meanings.insert(option.meaning);
  });
  CHECK(names.size() == rows);
  CHECK(meanings.size() == rows);
  CHECK(meanings.count("") == 0);
}

TEST_CASE(
    "the bounds are allowed, the values next to them, NaN and infinity are refused everywhere")
{
  for_each_number([&](const Option& option, auto member, auto zero) {
    using T = decltype(zero);
    Remeshing_options options;
    const auto set = [&](T value) { options.*member = value; };
    for (const double bound : {option.range.lowest, option.range.highest}) {
      set(static_cast<T>(bound));
      CAPTURE(option.name);
      CHECK_NOTHROW(validate(options));
    }
    const std::vector<T> forbidden = forbidden_values<T>(option.range);
    CHECK((!forbidden.empty() || std::is_same<T, unsigned>::value));
    for (const T value : forbidden) {
      CAPTURE(value);
      set(value);
      check_all_refuse(options, option.name, to_text(option.range));
    }
  });
}

TEST_CASE("the bounds are those that the algorithms stand")
{
  struct Expected {
    const char* name;
    double lowest, highest;
  };
  const double int_max = std::numeric_limits<int>::max();
  // Halfedges, 6 n, and the sum of the iterations are ints; a warp finds 32 vertices.
  for (const Expected& e :
       {Expected{"number_of_samples", 4, int_max / 6},
        Expected{"relaxation_iterations", 0, int_max / 2},
        Expected{"max_iterations", 0, int_max / 2}, Expected{"normal_neighbors", 1, 32},
        Expected{"density_neighbors", 1, 32}, Expected{"projection_neighbors", 1, 32},
        Expected{"feature_angle", 0, 180}, Expected{"normal_angle", 0, 180},
        Expected{"capacity_tolerance", 0, 1}}) {
    CAPTURE(e.name);
    bool found = false;
    for_each_option([&](const Option& option, auto) {
      if (std::string(option.name) != e.name) return;
      found = true;
      CHECK(option.range.lowest >= e.lowest);
      CHECK(option.range.highest <= e.highest);
    });
    CHECK(found);
  }
}

TEST_CASE("values outside of an enumeration are refused")
{
  for_each_option([&](const Option& option, auto member) {
    Remeshing_options options;
    using T = std::decay_t<decltype(options.*member)>;
    if constexpr (std::is_enum<T>::value)
      for (const int value : {-1, 17}) {
        options.*member = static_cast<T>(value);
        check_all_refuse(options, option.name, choices(T()));
      }
  });
}

TEST_CASE("what the named parameters say is validated, too")
{
  const Mesh mesh = make_mesh(box());
  Mesh output;
  const auto refuses = [&](const char* name, std::size_t n, const auto& np) {
    check_refuses(name, "but must be a number from",
                  [&] { CGAL::power_rtf_remeshing(mesh, n, output, np); });
  };
  refuses("number_of_samples", std::numeric_limits<std::size_t>::max(),
          CGAL::parameters::default_values());
  refuses("number_of_samples", 3, CGAL::parameters::default_values());
  refuses("max_iterations", 100, CGAL::parameters::number_of_iterations(-1));
  Remeshing_options options;
  options.sampling = Sampling::elimination;
  options.oversampling = 30;
  CHECK_THROWS_WITH_AS(
      CGAL::power_rtf_remeshing(mesh, 40000000, output, params::remeshing_options(options)),
      "samples times oversampling are 1200000000, but must be at most 1000000000",
      CGAL::PowerRTF::Invalid_input_error);
}

TEST_CASE("a run at any bound of any option ends, with the vertices asked for")
{
  const shapes::Soup torus = shapes::torus(30, 15, 1, 0.4);
  for (const shapes::Soup& soup : {torus, box()})
    for (const Preset preset : {Preset::quality, Preset::paper}) {
      const Mesh mesh = make_mesh(soup);
      for_each_number([&](const Option& option, auto member, auto zero) {
        if (std::string(option.name) == "device") return;
        if (std::string(option.name) == "min_edge_length") return; // leaves room for none
        for (const double bound : {option.range.lowest, option.range.highest}) {
          Remeshing_options options = Remeshing_options::of(preset);
          options.max_iterations = options.max_weight_iterations = 5;
          options.centroid_tolerance = 0; // or no run would be endless
          options.number_of_samples = 40;
          options.*member = static_cast<decltype(zero)>(bound);
          if (options.number_of_samples != 40) continue;
          if (options.merge_distance == 1e300) { // leaves nothing
            check_refuses("merge_distance", "one", [&] {
              Mesh output;
              CGAL::power_rtf_remeshing(mesh, 40, output, params::remeshing_options(options));
            });
            continue;
          }
          CAPTURE(option.name);
          CAPTURE(bound);
          CAPTURE(int(preset));
          const bool is_endless =
              bound == 1e6 && option.name != std::string("max_weight_iterations");
          Stop_after visitor(is_endless ? 20 : std::numeric_limits<int>::max());
          Mesh output;
          const Remeshing_report report = CGAL::power_rtf_remeshing(
              mesh, 40, output, params::remeshing_options(options).visitor(std::ref(visitor)));
          CHECK(report.cancelled == is_endless);
          if (is_endless) continue;
          CHECK(output.number_of_vertices() == 40);
          for (const auto v : output.vertices())
            for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(output.point(v)[axis]) < 2);
        }
      });
    }
}
