// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The memory of the program, whose operators are those of this test.
#include "../../tools/memory_blocks.cpp"

#include <doctest/doctest.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <random>
#include <thread>
#include <vector>

namespace {

constexpr std::size_t megabyte = std::size_t(1) << 20;

/// Blocks of a thread, which all have a number of their own on each page.
bool keeps_what_is_written(unsigned thread)
{
  constexpr std::size_t page_size = 4096;
  std::mt19937 random(thread);
  std::vector<std::vector<unsigned>> blocks(8);
  bool is_kept = true;
  for (unsigned round = 0; round < 400; ++round) {
    std::vector<unsigned>& block = blocks[random() % blocks.size()];
    constexpr std::size_t step = page_size / sizeof(unsigned);
    for (std::size_t k = 0; k < block.size(); k += step) is_kept = is_kept && block[k] == block[0];
    std::vector<unsigned>().swap(block);
    block.resize(random() % 3 == 0 ? random() % 1000 : random() % (4 * megabyte));
    for (std::size_t k = 0; k < block.size(); k += step) block[k] = 1000 * round + thread;
  }
  return is_kept;
}

} // namespace

TEST_CASE("blocks of several threads keep what is written")
{
  std::atomic<int> kept{0};
  std::vector<std::thread> threads;
  for (unsigned t = 0; t < 4; ++t)
    threads.emplace_back([t, &kept] { kept += keeps_what_is_written(t); });
  for (std::thread& t : threads) t.join();
  CHECK(kept == 4);
}

#ifdef POWER_RTF_KEEPS_LARGE_BLOCKS
TEST_CASE("a large block has the memory of one that was freed, in another thread, too")
{
  const auto place = [](std::size_t bytes) {
    return reinterpret_cast<std::uintptr_t>(std::vector<char>(bytes).data());
  };
  const std::uintptr_t first = place(64 * megabyte);
  CHECK(place(63 * megabyte) == first);
  std::thread([&] { CHECK(place(64 * megabyte) == first); }).join();
}

TEST_CASE("too large a block")
{
  constexpr std::size_t most = std::numeric_limits<std::ptrdiff_t>::max();
  CHECK_THROWS_AS(std::vector<char>(most / 2), std::bad_alloc);
}
#endif
