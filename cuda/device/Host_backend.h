// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The device engine's operations as plain loops: the logic and the layouts of the GPU, run where
// there is none.
#ifndef CGAL_POWER_RTF_CUDA_HOST_BACKEND_H
#define CGAL_POWER_RTF_CUDA_HOST_BACKEND_H

#include "Single_lane.h"

#include <CGAL/PowerRTF/internal/host_loops.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// One thread that is all of them.
struct Host_team {
  CGAL_POWER_RTF_HD int first() const { return 0; }
  CGAL_POWER_RTF_HD int stride() const { return 1; }
  template <class T>
  CGAL_POWER_RTF_HD void join(T&)
  {
  }
};

class Host_backend : public Host_loops<Sequential_tag>
{
public:
  /// One item that both host and device see.
  template <class T>
  class Shared_item
  {
  public:
    explicit Shared_item(Host_backend&) {}
    T* data() { return &m_item; }

  private:
    T m_item{};
  };

  /// Calls `f(i, lanes)` for i in [0, n), in any order; the lanes work on i together.
  template <class F>
  void for_each_by_lanes(int n, F f)
  {
    for (int i = 0; i < n; ++i) f(i, Single_lane());
  }

  template <class F>
  void for_each_by_warps(int n, F f)
  {
    for_each_by_lanes(n, f);
  }

  /// Runs `f(team)` once for all: its threads share the work on n items and add numbers up.
  template <class F>
  void run_team(int, F f)
  {
    Host_team team;
    f(team);
  }

  /// The same with a thread for each item, where there are so many.
  template <class F>
  bool run_resident_team(int, const F&)
  {
    return false;
  }

  /// The order of n points along the Morton curve, by their codes.
  void sort_order(int n, std::uint64_t* keys, int* order)
  {
    std::iota(order, order + n, 0);
    std::stable_sort(order, order + n, [&](int a, int b) { return keys[a] < keys[b]; });
  }

  template <class T>
  void upload(T* to, const T* from, std::size_t n)
  {
    std::copy(from, from + n, to);
  }

  void synchronize() {}
  void start_clock() {}
  void stop_clock() {}
  double seconds() const { return 0; }
  std::size_t bytes() const { return 0; }
  std::string name() const { return "host"; }
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_HOST_BACKEND_H
