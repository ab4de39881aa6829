// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The program on every hard shape, from few samples to many: no failure is silent, none hangs, and
// with many samples clean shapes get all guarantees.
#include "hard_shapes.h"
#include "judged_run.h"

#include <doctest/doctest.h>

namespace {

void check_all(const std::string& format, const std::vector<std::size_t>& sample_numbers)
{
  const judged_run::Scratch_folder folder;
  for (const auto& shape : shapes::hard_shapes())
    for (const std::size_t samples : sample_numbers)
      for (const std::string density : {"uniform", "curvature"}) {
        const std::string name = shape.first;
        CAPTURE(name);
        CAPTURE(samples);
        CAPTURE(density);
        const judged_run::Run run =
            judged_run::run(folder, name, shape.second, {samples, density, format});
        CHECK(judged_run::failure(run) == "");
        const bool is_enough = samples >= 3000 && name != "sphere_moved_1e+15"; // coordinates
        if (is_enough && judge::is_clean(judge::merged(judge::read(run.input))))
          CHECK(run.exit_code == 0);
      }
}

} // namespace

TEST_CASE("no run on a hard shape fails silently: OFF")
{
  check_all("off", {100, 300, 1000, 3000});
}
TEST_CASE("no run on a hard shape fails silently: OBJ") { check_all("obj", {500}); }
TEST_CASE("no run on a hard shape fails silently: STL") { check_all("stl", {1000}); }

int main(int argc, char** argv) { return judged_run::run_tests(argc, argv); }
