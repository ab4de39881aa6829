// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Many meshes at a time.
#include "mesh_of_shape.h"
#include "remeshed_shape.h"
#include "with_threads.h"

#include <CGAL/PowerRTF/internal/find_first.h>
#include <CGAL/PowerRTF/remesh_batch.h>
#include <CGAL/PowerRTF/sampling/random_source.h>
#include <CGAL/power_rtf_remeshing.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace CGAL::PowerRTF;
using remeshed_shape::are_equal;
using shapes::make_mesh;
using shapes::Mesh;
using shapes::soup_of;

namespace {

const int all_threads[] = {1, 2, 3, 5};

std::vector<Mesh> inputs()
{
  std::vector<Mesh> meshes;
  for (int i = 0; i < 6; ++i) meshes.push_back(make_mesh(shapes::ellipsoid(1, 1 + i, 2, 3)));
  meshes.push_back(make_mesh(shapes::box(6)));
  meshes.push_back(make_mesh(shapes::torus(30, 15, 1, 0.4)));
  return meshes;
}

} // namespace

TEST_CASE("the meshes of a batch are those of single runs, for any number of threads")
{
  const std::vector<Mesh> in = inputs();
  std::vector<Mesh> alone(in.size());
  for (std::size_t i = 0; i < in.size(); ++i)
    CGAL::power_rtf_remeshing(in[i], 300 + 10 * i, alone[i]);
  const auto check = [&](auto tag) {
    std::vector<Mesh> out(in.size());
    const auto remesh = [&](std::size_t i) {
      return CGAL::power_rtf_remeshing(in[i], 300 + 10 * i, out[i]);
    };
    const std::vector<Batch_result> results = remesh_batch<decltype(tag)>(in.size(), remesh);
    REQUIRE(results.size() == in.size());
    for (std::size_t i = 0; i < in.size(); ++i) {
      CAPTURE(i);
      CHECK(!results[i].error);
      CHECK(results[i].report.samples_asked == 300 + 10 * i);
      CHECK(results[i].report.missed_guarantees().empty());
      CHECK(are_equal(soup_of(out[i]), soup_of(alone[i])));
    }
  };
  for (const int threads : all_threads)
    with_threads(threads, [&] { check(CGAL::Parallel_if_available_tag()); });
  check(CGAL::Sequential_tag());
}

TEST_CASE("what one mesh throws is its own error; the others are made")
{
  std::vector<Mesh> in = inputs(), out(in.size());
  in[0].clear();
  in[5].clear();
  const auto remesh = [&](std::size_t i) {
    if (i == 3) throw std::runtime_error("cannot be read");
    return CGAL::power_rtf_remeshing(in[i], 200, out[i]);
  };
  for (const int threads : all_threads)
    with_threads(threads, [&] {
      const std::vector<Batch_result> results = remesh_batch(in.size(), remesh);
      for (std::size_t i = 0; i < in.size(); ++i) {
        CAPTURE(i);
        const bool fails = i == 0 || i == 3 || i == 5;
        CHECK(bool(results[i].error) == fails);
        CHECK(num_vertices(out[i]) == (fails ? 0 : 200));
        if (i == 3)
          CHECK_THROWS_WITH(std::rethrow_exception(results[i].error), "cannot be read");
        else if (fails)
          CHECK_THROWS_AS(std::rethrow_exception(results[i].error), Invalid_input_error);
      }
    });
}

TEST_CASE("each job runs once; on one thread in order")
{
  for (const int threads : all_threads)
    for (const int n : {0, 1, 2, 7, 100})
      with_threads(threads, [&] {
        std::vector<std::atomic<int>> begun(n), place(n);
        std::atomic<int> count{0};
        internal::for_each_job(CGAL::Parallel_if_available_tag(), n, [&](int i) {
          ++begun[i];
          place[i] = count++;
        });
        CHECK(count == n);
        for (int i = 0; i < n; ++i) {
          CHECK(begun[i] == 1);
          if (threads == 1) CHECK(place[i] == i);
        }
      });
}

TEST_CASE("a job that waits in a loop of its own takes up no other one, nor its loops")
{
  const CGAL::Parallel_if_available_tag parallel;
  for (const int threads : all_threads)
    for (const int n : {2, 3, 24}) // fewer than threads: the others help
      with_threads(threads, [&] {
        thread_local int job = -1;
        std::atomic<int> disturbed{0};
        internal::for_each_job(parallel, n, [&](int i) {
          job = i;
          const auto is_own = [&] { return job == i || job == -1; }; // or a thread without a job
          for (int loop = 0; loop < 10; ++loop) {
            internal::for_each_chunk(parallel, 16, 1, [&](int, int) {
              if (!is_own()) ++disturbed;
              std::this_thread::sleep_for(std::chrono::microseconds(100));
            });
            if (!is_own()) ++disturbed;
          }
          job = -1;
        });
        CHECK(disturbed == 0);
      });
}

TEST_CASE("the first job that holds is that of a loop, also where others fail or throw")
{
  const CGAL::Parallel_if_available_tag parallel;
  constexpr int n = 20;
  for (const int threads : all_threads)
    for (const int most : {1, 2, n})
      for (int seed = 0; seed < 50; ++seed)
        with_threads(threads, [&] {
          const auto random = [seed](int i) { return counted_random(seed, i, 0); };
          const auto throws = [&](int i) { return random(i) < 0.05; };
          const auto holds = [&](int i) { return random(i) > 0.9; };
          int expected = 0;
          while (expected < n && !throws(expected) && !holds(expected)) ++expected;
          std::atomic<int> at_once{0}, most_at_once{0}, needed{0};
          const auto find = [&] {
            const auto job = [&](int i, const auto& is_needed) {
              const int now = ++at_once;
              for (int before = most_at_once;
                   now > before && !most_at_once.compare_exchange_weak(before, now);) {
              }
              std::this_thread::sleep_for(std::chrono::microseconds(int(100 * random(n + i))));
              if (is_needed()) ++needed;
              --at_once;
              if (throws(i)) throw i;
              return holds(i);
            };
            return internal::find_first(parallel, n, most, job, [] {});
          };
          if (expected < n && throws(expected)) {
            int thrown = -1;
            try {
              find();
            } catch (int i) {
              thrown = i;
            }
            CHECK(thrown == expected);
          } else {
            CHECK(find() == expected);
          }
          CHECK(needed >= std::min(expected + 1, n));
          CHECK(most_at_once <= most);
        });
}

TEST_CASE("jobs after one that holds are told that they are not needed")
{
  for (const int threads : all_threads)
    with_threads(threads, [&] {
      const auto job = [](int i, const auto& is_needed) {
        while (i > 0 && is_needed()) {
        }
        return i == 0;
      };
      CHECK(internal::find_first(CGAL::Parallel_if_available_tag(), 8, 8, job, [] {}) == 0);
    });
}

TEST_CASE("a thread that waits for the jobs of others is idle")
{
  for (const int threads : all_threads)
    with_threads(threads, [&] {
      const std::thread::id caller = std::this_thread::get_id();
      std::atomic<bool> was_idle{false};
      const auto job = [&](int, const auto&) { // elsewhere, until this thread has no other one
        while (std::this_thread::get_id() != caller && !was_idle) {
        }
        return false;
      };
      const auto idle = [&] {
        CHECK(std::this_thread::get_id() == caller);
        was_idle = true;
      };
      CHECK(internal::find_first(CGAL::Parallel_if_available_tag(), 8, 8, job, idle) == 8);
    });
}
