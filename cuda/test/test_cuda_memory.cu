// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Memory and streams of a GPU that outlive what used them, on a GPU.
#include "../backend/Cuda_backend.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cstddef>
#include <cstdio>
#include <thread>
#include <vector>

using namespace CGAL::PowerRTF;
using namespace CGAL::PowerRTF::device;

namespace {

std::size_t free_on_device()
{
  std::size_t free = 0, total = 0;
  check(cudaMemGetInfo(&free, &total), "test");
  return free;
}

/// Sums of n numbers that two loops make, each from what the other has left.
std::vector<double> work(Cuda_backend& backend, int n, int rounds)
{
  Cuda_backend::Buffer<double> a, b, sum;
  a.allocate(backend, n);
  b.allocate(backend, n);
  sum.allocate(backend, 1);
  double *const x = a.data(), *const y = b.data(), *const s = sum.data();
  std::vector<double> sums;
  backend.for_each(n, [=] __device__(int i) { x[i] = i % 17; });
  for (int round = 0; round < rounds; ++round) {
    backend.for_each(n, [=] __device__(int i) { y[i] = x[i] + 1. / (1 + i % (round + 3)); });
    backend.for_each(n, [=] __device__(int i) { x[i] = .5 * y[i] + y[n - 1 - i]; });
    backend.reduce<1, 0>(
        n, [=] __device__(int i, Totals<1, 0>& t) { t.add(0, x[i]); },
        [=] __device__(const Totals<1, 0>& t) { *s = t.sum(0); });
    sums.push_back(0);
    backend.download(&sums.back(), s, 1);
  }
  return sums;
}

} // namespace

TEST_CASE("copies of all sizes come to the device and back, one after the other")
{
  constexpr std::size_t mib = std::size_t(1) << 20;
  Cuda_backend backend(0);
  Cuda_backend::Buffer<unsigned char> buffer, sum;
  const std::vector<std::size_t> sizes = {1,           63,           2 * mib - 1, 2 * mib,
                                          2 * mib + 1, 7 * mib,      8 * mib,     8 * mib + 1,
                                          32 * mib,    32 * mib + 3, 100 * mib,   5};
  buffer.allocate(backend, 100 * mib);
  sum.allocate(backend, 1);
  unsigned char seed = 1;
  for (const std::size_t n : sizes) {
    CAPTURE(n);
    std::vector<unsigned char> up(n), down(n);
    for (std::size_t i = 0; i < n; ++i)
      up[i] = static_cast<unsigned char>(i * 31 + i / 4099 + seed);
    unsigned char* const items = buffer.data();
    unsigned char* const last = sum.data();
    backend.upload(items, up.data(), n);
    for (unsigned char& u : up) u ^= 1; // the device has what was there
    backend.for_each(static_cast<int>(n), [=] __device__(int i) { items[i] ^= 3; });
    for (int k = 0; k < 100; ++k) backend.upload(last, &seed, 1); // while others may be under way
    backend.download(down.data(), items, n);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < n; ++i) wrong += down[i] != (up[i] ^ 2);
    CHECK(wrong == 0);
    unsigned char back = 0;
    backend.download(&back, last, 1);
    CHECK(back == seed++);
  }
}

TEST_CASE("the second of two alike takes no memory from the device")
{
  const auto run = [] {
    Cuda_backend backend(0);
    work(backend, 1 << 22, 3);
  };
  run();
  const std::size_t free = free_on_device();
  run();
  CHECK(free_on_device() == free);
}

TEST_CASE("memory that is kept is freed when it is asked for")
{
  Cuda_backend backend(0);
  work(backend, 1 << 26, 1);
  const std::size_t free = free_on_device();
  release_cuda_memory(0);
  CHECK(free_on_device() >= free + 2 * sizeof(double) * (std::size_t(1) << 26));
  CHECK(work(backend, 1000, 3) == work(backend, 1000, 3));
}

TEST_CASE("memory that is kept makes way for what has no room beside it")
{
  Cuda_backend backend(0);
  release_cuda_memory(0);
  const std::size_t free = free_on_device();
  {
    Cuda_backend::Buffer<char> most;
    most.allocate(backend, free / 10 * 7);
  }
  CHECK(free_on_device() < free / 10 * 4);
  Cuda_backend::Buffer<char> other;
  other.allocate(backend, free / 10 * 6);
  CHECK(other.size() == free / 10 * 6);
}

TEST_CASE("after memory has run out all goes on as before")
{
  Cuda_backend backend(0);
  const std::vector<double> before = work(backend, 100000, 20);
  const std::size_t bytes = backend.bytes();
  release_cuda_memory(0);
  Cuda_backend::Buffer<char> all;
  CHECK_THROWS_WITH_AS(all.allocate(backend, free_on_device() * 2),
                       doctest::Contains("the memory of the GPU does not suffice"), Cuda_error);
  CHECK(backend.bytes() == bytes);
  CHECK(work(backend, 100000, 20) == before);
  Cuda_backend another(0);
  CHECK(work(another, 100000, 20) == before);
}

TEST_CASE("threads that share a GPU get what each would get alone")
{
  std::vector<std::vector<double>> alone;
  for (int k = 0; k < 8; ++k) {
    Cuda_backend backend(0);
    alone.push_back(work(backend, 50000 + 100 * k, 30));
  }
  std::atomic<int> others{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      for (int repeat = 0; repeat < 10; ++repeat) {
        Cuda_backend backend(0);
        const int k = (t + repeat) % 8;
        others += work(backend, 50000 + 100 * k, 30) != alone[k];
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(others == 0);
}

int main(int argc, char** argv)
{
  try {
    Cuda_backend backend(0);
  } catch (const Cuda_error& error) {
    std::printf("skipped: %s\n", error.what());
    return 77;
  }
  return doctest::Context(argc, argv).run();
}
