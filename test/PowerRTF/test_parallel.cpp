// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/PowerRTF/Remeshing_visitor.h>
#include <CGAL/PowerRTF/geometry/for_each_node.h>
#include <CGAL/PowerRTF/internal/Background_work.h>
#include <CGAL/PowerRTF/internal/Buckets.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/internal/Index_set.h>
#include <CGAL/PowerRTF/internal/label_trees.h>
#include <CGAL/PowerRTF/internal/nth_value.h>
#include <CGAL/PowerRTF/internal/order_by_key.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/sampling/random_source.h>

#include <CGAL/tags.h>

#include <doctest/doctest.h>

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#endif

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace CGAL::PowerRTF;
using namespace CGAL::PowerRTF::internal;

namespace {

const Concurrency both[] = {CGAL::Sequential_tag(), CGAL::Parallel_if_available_tag()};
const int sizes[] = {0, 1, 2, 63, 64, 65, 4095, 4096, 4097, 100000};

} // namespace

TEST_CASE("a scan has the sums of what is before")
{
  for (const int n : sizes)
    for (const Concurrency& concurrency : both) {
      std::vector<int> values(n), expected(n);
      for (int i = 0; i < n; ++i) values[i] = i % 7;
      for (int i = 1; i < n; ++i) expected[i] = expected[i - 1] + values[i - 1];
      const int sum = std::accumulate(values.begin(), values.end(), 0);
      CHECK(exclusive_scan(concurrency, n, values.data()) == sum);
      CHECK(values == expected);
    }
}

TEST_CASE("rounded sums never fall, and are the same for any concurrency")
{
  for (const int n : sizes) {
    Random_source random(1);
    std::vector<double> values(n);
    for (double& x : values) x = random() < 0.5 ? 0 : std::pow(random(), 20);
    const double exact = std::accumulate(values.begin(), values.end(), 0.L);
    const std::vector<double> before = values;
    std::vector<double> other = values;
    const double sum = exclusive_scan(both[0], n, values.data());
    CHECK(exclusive_scan(both[1], n, other.data()) == sum);
    CHECK(other == values);
    Host_backend<CGAL::Parallel_if_available_tag> backend;
    std::vector<double> by_backend = before, sums(scan_sums(n));
    exclusive_scan(backend, n, by_backend.data(), sums.data());
    CHECK(by_backend == values);
    CHECK(std::is_sorted(values.begin(), values.end()));
    CHECK(sum == doctest::Approx(exact).epsilon(1e-12));
    if (n > 0) CHECK(values.back() <= sum);
  }
}

TEST_CASE("what is selected keeps its order")
{
  for (const int n : sizes)
    for (const Concurrency& concurrency : both) {
      std::vector<int> expected;
      for (int i = 0; i < n; i += 3) expected.push_back(i);
      const auto is_wanted = [](int i) { return i % 3 == 0; };
      CHECK(select(concurrency, n, is_wanted) == expected);
      std::vector<int> taken;
      select(
          concurrency, n, is_wanted, [&](int count) { taken.assign(count, -1); },
          [&](int k, int i) { taken[k] = i; });
      CHECK(taken == expected);
    }
}

TEST_CASE("what is gathered is sorted and comes once, for any concurrency")
{
  for (const int n : sizes) {
    const auto find = [](int i, auto&& add) {
      for (int k = 0; k < i % 4; ++k) add(int(i * 7919u % 1000) + k);
    };
    std::set<int> expected;
    for (int i = 0; i < n; ++i) find(i, [&](int item) { expected.insert(item); });
    const std::vector<int> items(expected.begin(), expected.end());
    CHECK(gather_uniquely<int>(CGAL::Sequential_tag(), n, find) == items);
    CHECK(gather_uniquely<int>(CGAL::Parallel_if_available_tag(), n, find) == items);
  }
}

TEST_CASE("buckets hold their items in increasing order, however full they are")
{
  const std::function<int(int)> spreads[] = {
      [](int i) { return i; },                                     // one in each
      [](int) { return 3; },                                       // all in one
      [](int i) { return int(7919LL * i % 1000); },                // some in each
      [](int i) { return i % 100 == 0 ? 99999 : 99000 + i % 7; }}; // most are empty
  for (const int n : sizes)
    for (const auto& bucket : spreads)
      for (const Concurrency& concurrency : both) {
        const Buckets<int> buckets(concurrency, n, 100001, bucket, [&](int i) { return n - i; });
        REQUIRE(buckets.first.size() == 100002);
        CHECK(buckets.first.front() == 0);
        CHECK(buckets.first.back() == n);
        std::vector<int> expected(n), sizes_of(100001, 0);
        std::iota(expected.begin(), expected.end(), 1);
        for (int i = 0; i < n; ++i) ++sizes_of[bucket(i)];
        std::stable_sort(expected.begin(), expected.end(),
                         [&](int a, int b) { return bucket(n - a) < bucket(n - b); });
        CHECK(std::equal(expected.begin(), expected.end(), buckets.entries.begin(),
                         buckets.entries.end()));
        std::vector<int> found(100001);
        for (int b = 0; b <= 100000; ++b) found[b] = buckets.first[b + 1] - buckets.first[b];
        CHECK(found == sizes_of);
      }
}

TEST_CASE("the n-th value is that of the sorted ones, however they are spread")
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> even;
  constexpr double least = std::numeric_limits<double>::denorm_min();
  const std::function<double(int)> spreads[] = {
      [&](int) { return even(random); },                       // evenly
      [&](int) { return std::exp(20 * even(random)); },        // most of them in one interval
      [](int) { return 0.1; },                                 // all the same
      [](int i) { return i == 7 ? 1e300 : i % 3; },            // all but one
      [](int i) { return (i % 5 - 2) * least; },               // a range that has no inverse
      [&](int i) { return (i % 2 ? -1 : 1) * even(random); }}; // of both signs
  for (const auto& spread : spreads)
    for (const int size : {1, 2, 1000, 200000}) {
      std::vector<double> values(size);
      for (int i = 0; i < size; ++i) values[i] = spread(i);
      std::vector<double> sorted = values;
      std::sort(sorted.begin(), sorted.end());
      for (const int n : {0, size / 3, size / 2, size - 1})
        for (const Concurrency& concurrency : both)
          CHECK(nth_value(concurrency, values, n) == sorted[n]);
    }
}

TEST_CASE("the order by keys is that of a stable sort, however they are spread")
{
  std::mt19937_64 random(1);
  const std::function<std::uint64_t(int)> spreads[] = {
      [&](int) { return random(); },                                    // evenly
      [&](int) { return random() % 1000; },                             // low ones, some equal
      [&](int i) { return i % 100 == 0 ? random() : random() >> 40; },  // most of them near others
      [&](int i) { return i % 3 == 0 ? 7 : ~(std::uint64_t(i) << 7); }, // falling, with a long run
      [](int) { return ~std::uint64_t(0); }};                           // all the same
  for (const auto& spread : spreads)
    for (const int n : sizes) {
      std::vector<std::uint64_t> keys(n);
      for (int i = 0; i < n; ++i) keys[i] = spread(i);
      std::vector<int> expected(n);
      std::iota(expected.begin(), expected.end(), 0);
      std::stable_sort(expected.begin(), expected.end(),
                       [&](int i, int j) { return keys[i] < keys[j]; });
      for (const Concurrency& concurrency : both) {
        std::vector<int> order(n, -1);
        order_by_key(
            concurrency, n, [&](int i) { return keys[i]; }, order.data());
        CHECK(order == expected);
      }
    }
}

TEST_CASE("the nodes of a tree come once each, after their children")
{
  for (const int n : sizes)
    for (const Concurrency& concurrency : both) {
      const Packed_tree_layout tree(n);
      std::vector<int> items(tree.nodes(), 0); // below each node
      for_each_node(concurrency, tree, [&](int level, int k) {
        for (int c = tree.children_begin(k); c < tree.children_end(level, k); ++c)
          items[tree.first[level] + k] += level == 0 ? 1 : items[tree.first[level - 1] + c];
      });
      for (int level = 0; level < tree.levels; ++level)
        CHECK(std::accumulate(items.begin() + tree.first[level],
                              items.begin() + tree.first[level + 1], 0) == n);
    }
}

TEST_CASE("copies and fills of any length")
{
  Host_backend<CGAL::Parallel_if_available_tag> backend;
  for (const int n : sizes) {
    std::vector<int> from(n), to(n, -1);
    std::iota(from.begin(), from.end(), 0);
    Host_backend<CGAL::Parallel_if_available_tag>::Buffer<int> buffer;
    buffer.allocate(backend, n);
    CHECK(buffer.size() == std::size_t(n));
    backend.upload(buffer.data(), from.data(), n);
    backend.download(to.data(), buffer.data(), n);
    CHECK(to == from);
    backend.fill(buffer.data(), 7, n);
    CHECK(std::count(buffer.data(), buffer.data() + n, 7) == n);
  }
}

TEST_CASE("a set tells what comes for the first time")
{
  Index_set set;
  std::set<int> expected;
  std::mt19937 random(1);
  for (int k = 0; k < 10000; ++k) {
    const int i = random() % 3 > 0 ? int(random() % 4096) : int(random() >> 1);
    CHECK(set.insert(i) == expected.insert(i).second);
  }
}

TEST_CASE("all of some calls are made, each once")
{
  for (const bool parallel : {false, true}) {
    const Concurrency concurrency = parallel ? Concurrency(CGAL::Parallel_if_available_tag())
                                             : Concurrency(CGAL::Sequential_tag());
    std::vector<int> a, b, calls(3, 0);
    call_at_once(
        concurrency,
        [&] {
          ++calls[0];
          resize_in_parallel(concurrency, a, 1 << 20, 7);
        },
        [&] { ++calls[1]; },
        [&] {
          ++calls[2];
          b = select(concurrency, 100000, [](int i) { return i % 2 == 1; });
        });
    CHECK(calls == std::vector<int>(3, 1));
    CHECK(a == std::vector<int>(1 << 20, 7));
    CHECK(b.size() == 50000);
  }
}

TEST_CASE("work in the background is done once, and what it throws is thrown")
{
  for (const Concurrency& concurrency : both) {
    std::atomic<int> done{0};
    {
      const auto even = [&](int n) { // by all threads
        return int(select(concurrency, n, [](int i) { return i % 2 == 0; }).size());
      };
      Background_work work(concurrency, [&] { done += even(100000) == 50000; });
      CHECK(even(200000) == 100000); // beside it
      work.finish();
      work.finish();
      CHECK(done == 1);
    }
    {
      Background_work fails(concurrency, [] { throw std::runtime_error("no"); });
      CHECK_THROWS_AS(fails.finish(), std::runtime_error);
    }
    {
      const Background_work fails(concurrency, [] { throw std::runtime_error("no"); });
    }
    CHECK(done == 1);
    {
      const Background_work unfinished(concurrency, [&] { ++done; });
    }
    CHECK(done == (concurrency.is_parallel() ? 2 : 1));
  }
#ifdef CGAL_LINKED_WITH_TBB
  if (tbb::this_task_arena::max_concurrency() == 1) return;
  std::atomic<bool> is_done{false};
  const Background_work beside(CGAL::Parallel_tag(), [&] { is_done = true; });
  while (!is_done) std::this_thread::yield(); // this thread does nothing for it
#endif
}

#ifdef CGAL_LINKED_WITH_TBB
TEST_CASE("who waits for work in the background asks no visitor")
{
  struct Impatient : Remeshing_default_visitor {
    bool go_further() { return false; }
  } visitor;
  const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
  std::atomic<int> done{0};
  CHECK(run_unless_cancelled(visitor, [&] {
    const Background_work work(CGAL::Parallel_tag(), [&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(60)); // visitors are asked every 50 ms
      for_each_index(CGAL::Parallel_tag(), 100000, [&](int) { done.fetch_add(1); });
    });
  }));
  CHECK(done == 100000);
}
#endif

TEST_CASE("memory that another has left is filled again")
{
  for (const int n : sizes) {
    std::vector<std::uint64_t>(n, ~std::uint64_t(0));
    const auto values = filled(CGAL::Parallel_if_available_tag(), n, std::uint64_t(7));
    CHECK(values.size() == std::size_t(n));
    CHECK(std::count(values.begin(), values.end(), 7u) == n);
  }
}

TEST_CASE("items are hung under their root while others halve the way there")
{
  constexpr int size = 1 << 14;
  for (int run = 0; run < 300; ++run) {
    std::vector<int> label(size, 0); // a tree of long ways
    for (int i = 1; i < size; ++i) label[i] = (std::max)(0, i - 1 - i * 7919 % 3);
    for_each_index(CGAL::Parallel_if_available_tag(), size,
                   [&](int i) { atomic_store(&label[i], root_of(label.data(), i)); });
    REQUIRE(std::count(label.begin(), label.end(), 0) == size);
  }
}
