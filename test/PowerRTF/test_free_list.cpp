// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The GPU's list of memory that is kept, over memory of the host. (Over the GPU's:
// cuda/test/test_cuda_memory.cu.)
#include "../../cuda/backend/Free_list.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cstddef>
#include <cstring>
#include <mutex>
#include <new>
#include <thread>
#include <unordered_map>
#include <vector>

using CGAL::PowerRTF::device::block_size;
using CGAL::PowerRTF::device::Free_list;

namespace {

/// Memory of a size, and what became of it.
struct Heap {
  std::size_t room = std::size_t(-1), used = 0;
  int taken = 0;
  std::unordered_map<void*, std::size_t> sizes;
  std::mutex mutex;

  ~Heap() { CHECK(sizes.empty()); }
};

struct Heap_source {
  Heap* heap;

  void* take(std::size_t bytes)
  {
    const std::lock_guard<std::mutex> lock(heap->mutex);
    if (bytes > heap->room - heap->used) return nullptr;
    void* const block = ::operator new(bytes);
    heap->used += bytes;
    ++heap->taken;
    heap->sizes[block] = bytes;
    return block;
  }
  void give_back(void* block, std::size_t) noexcept
  {
    const std::lock_guard<std::mutex> lock(heap->mutex);
    heap->used -= heap->sizes.at(block);
    heap->sizes.erase(block);
    ::operator delete(block);
  }
};

using List = Free_list<Heap_source>;

struct List_source {
  List* list;

  void* take(std::size_t bytes) { return list->take(bytes); }
  void give_back(void* block, std::size_t bytes) noexcept { list->give_back(block, bytes); }
};

} // namespace

TEST_CASE("a block is as large as asked for, at most an eighth larger, and its own block's size")
{
  CHECK(block_size(0) == 512);
  CHECK(block_size(512) == 512);
  for (std::size_t bytes = 1; bytes < std::size_t(1) << 40; bytes += bytes / 37 + 1) {
    const std::size_t size = block_size(bytes);
    CHECK(size >= bytes);
    CHECK(size <= (bytes + bytes / 8 < bytes + 512 ? bytes + 512 : bytes + bytes / 8));
    CHECK(block_size(size) == size);
    CHECK(block_size(bytes + 1) >= size);
  }
}

TEST_CASE("what is given back is taken again by who asks for nearly as much")
{
  Heap heap;
  List list(Heap_source{&heap});
  void* const first = list.take(100000);
  list.give_back(first, 100000);
  CHECK(list.kept() == block_size(100000));
  void* const second = list.take(99000);
  CHECK(second == first);
  CHECK(list.kept() == 0);
  void* const third = list.take(100000);
  CHECK(third != first);
  CHECK(heap.taken == 2);
  list.give_back(second, 99000);
  list.give_back(third, 100000);
  void* const large = list.take(200000);
  CHECK(heap.taken == 3);
  list.give_back(large, 200000);
}

TEST_CASE("released memory is its source's again")
{
  Heap heap;
  List list(Heap_source{&heap});
  void* const kept = list.take(5000);
  void* const used = list.take(5000);
  list.give_back(kept, 5000);
  list.release();
  CHECK(list.kept() == 0);
  CHECK(heap.used == block_size(5000));
  list.give_back(used, 5000);
}

TEST_CASE("where memory runs out, what is kept goes first; then there is none, and later there is")
{
  Heap heap;
  heap.room = 10000;
  List list(Heap_source{&heap});
  list.give_back(list.take(4000), 4000);
  void* const large = list.take(8000); // only without the other
  REQUIRE(large);
  CHECK(list.kept() == 0);
  CHECK(list.take(4000) == nullptr);
  list.give_back(large, 8000);
  void* const small = list.take(4000);
  CHECK(small);
  list.give_back(small, 4000);
}

TEST_CASE("of two lists one may be the other's source")
{
  Heap heap;
  heap.room = 20000;
  List shared(Heap_source{&heap});
  {
    Free_list<List_source> first(List_source{&shared}), second(List_source{&shared});
    void* const block = first.take(9000);
    first.give_back(block, 9000);
    CHECK(first.kept() == block_size(9000));
    CHECK(shared.kept() == 0);
    void* const other = second.take(9000);
    CHECK(other != block); // which is the first list's
    CHECK(first.take(9000) == block);
    first.give_back(block, 9000);
    first.release();
    CHECK(shared.kept() == block_size(9000));
    CHECK(second.take(9000) == block);
    second.give_back(block, 9000);
    second.give_back(other, 9000);
    void* const large = second.take(15000); // only without those that both keep
    CHECK(large);
    CHECK(heap.used == block_size(15000));
    second.give_back(large, 15000);
  }
  CHECK(shared.kept() == block_size(15000));
}

TEST_CASE("no two threads have the same block at once")
{
  Heap heap;
  List list(Heap_source{&heap});
  std::atomic<int> faults{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int k = 0; k < 2000; ++k) {
        const std::size_t bytes = 600 + 500 * std::size_t(k % 5);
        auto* const block = static_cast<unsigned char*>(list.take(bytes));
        std::memset(block, t, bytes);
        if (k % 100 == 99) list.release();
        for (std::size_t i = 0; i < bytes; ++i) faults += block[i] != t;
        list.give_back(block, bytes);
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(faults == 0);
  CHECK(list.kept() == heap.used);
  CHECK(heap.used <= 4 * 5 * block_size(2600));
}
