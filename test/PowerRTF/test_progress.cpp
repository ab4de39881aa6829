// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a visitor hears of the progress of each stage, and that hearing it changes nothing.
#include "mesh_of_shape.h"
#include "remeshed_shape.h"

#include <CGAL/power_rtf_remeshing.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

using namespace CGAL::PowerRTF;
using namespace remeshed_shape;
using shapes::make_mesh;
using shapes::Mesh;
using shapes::soup_of;
namespace params = CGAL::PowerRTF::parameters;

namespace {

const std::vector<std::string> all_stages{"surface",     "sampling", "optimization", "extraction",
                                          "improvement", "quality",  "write"};

/// Hears at each of the first polls of a stage, or of all: the 50 ms in between have passed.
struct Slow_visitor : Remeshing_default_visitor {
  std::vector<std::string> stages;
  std::map<std::string, std::vector<double>> progress;
  std::thread::id thread = std::this_thread::get_id();
  bool is_called_on_own_thread_only = true;
  std::string slow_stage; // empty: all
  int reports = 0;        // in this stage

  void on_stage(const char* name)
  {
    stages.push_back(name);
    reports = 0;
  }
  void on_progress(double done)
  {
    is_called_on_own_thread_only =
        is_called_on_own_thread_only && thread == std::this_thread::get_id();
    progress[stages.back()].push_back(done);
    const bool is_slow = slow_stage.empty() || slow_stage == stages.back();
    if (++reports <= 12 && is_slow) std::this_thread::sleep_for(std::chrono::milliseconds(51));
  }
};

struct Stopped {};

/// Throws at the k-th report of a stage, or stops the run when it is asked after that.
struct Ending_visitor : Slow_visitor {
  int last = 0;
  bool throws = false;

  void on_progress(double done)
  {
    Slow_visitor::on_progress(done);
    if (throws && is_last()) throw Stopped();
  }
  bool go_further() const { return !is_last(); }
  bool is_last() const { return stages.back() == slow_stage && reports >= last; }
};

/// A visitor from before there was progress.
struct Old_visitor {
  int stages = 0;
  void on_stage(const char*) { ++stages; }
  void on_iteration(const Iteration_report&, double) {}
  bool go_further() { return true; }
};

} // namespace

TEST_CASE("the progress of each stage rises from 0 to 1, on the thread of the call")
{
  const Mesh input = make_mesh(ellipsoid());
  Mesh output, expected;
  Slow_visitor visitor;
  CGAL::power_rtf_remeshing(input, 2000, output, params::visitor(std::ref(visitor)));
  CHECK(visitor.stages == all_stages);
  CHECK(visitor.is_called_on_own_thread_only);
  for (const std::string& stage : all_stages) {
    CAPTURE(stage);
    const std::vector<double>& progress = visitor.progress[stage];
    CHECK(std::is_sorted(progress.begin(), progress.end()));
    CHECK(progress.front() == 0);
    CHECK(progress.back() == 1);
    if (stage != "write") // which nothing interrupts: the output is being replaced
      CHECK(std::any_of(progress.begin(), progress.end(), [](double p) { return p > 0 && p < 1; }));
  }

  CGAL::power_rtf_remeshing(input, 2000, expected);
  CHECK(are_equal(soup_of(output), soup_of(expected)));
}

TEST_CASE("a visitor ends the run at any of its calls; the output stays as it was")
{
  const Mesh input = make_mesh(ellipsoid());
  for (const std::string& stage : all_stages)
    for (const int last : {1, 2, 4}) {
      CAPTURE(stage);
      CAPTURE(last);
      if (stage == "write" && last > 1) continue;
      Ending_visitor visitor;
      visitor.slow_stage = stage;
      visitor.last = last;
      const auto run = [&](Mesh& output) {
        return CGAL::power_rtf_remeshing(input, 500, output, params::visitor(std::ref(visitor)));
      };
      Mesh output = make_mesh(shapes::tetrahedron());
      if (stage == "write") { // has begun: it comes to its end
        Mesh complete;
        CHECK_FALSE(run(complete).cancelled);
        CHECK(num_vertices(complete) == 500);
      } else {
        CHECK(run(output).cancelled);
        CHECK(visitor.stages.back() == stage);
        CHECK(visitor.progress[stage].back() < 1);
      }
      visitor.throws = true;
      CHECK_THROWS_AS(run(output), Stopped);
      CHECK(num_vertices(output) == 4);
    }
}

TEST_CASE("a visitor need not hear of progress")
{
  Mesh output;
  Old_visitor visitor;
  CGAL::power_rtf_remeshing(make_mesh(ellipsoid()), 200, output,
                            params::visitor(std::ref(visitor)));
  CHECK(visitor.stages == int(all_stages.size()));
}
