// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Runs a warp's device code on the host: 32 fibres take turns, each up to the next exchange between
// lanes. Include before the headers for the device.
#ifndef POWER_RTF_TEST_WARP_ON_HOST_H
#define POWER_RTF_TEST_WARP_ON_HOST_H

#include <ucontext.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <vector>

#define __device__
#define __shared__ static
#define __global__
#define __noinline__
#define __launch_bounds__(...)

using std::fma;
using std::fmax;
using std::fmin;
using std::max;
using std::min;

class Host_warp {
public:
  static constexpr int lanes = 32;

  /// Calls `body(lane)` for all lanes of the warp together.
  static void run(const std::function<void(int)>& body)
  {
    Host_warp& w = warp();
    w.m_body = &body;
    for (int l = 0; l < lanes; ++l) {
      Fibre& f = w.m_fibres[l];
      f.stack.resize(1 << 18);
      f.is_done = false;
      f.exchanges = 0;
      getcontext(&f.context);
      f.context.uc_stack.ss_sp = f.stack.data();
      f.context.uc_stack.ss_size = f.stack.size();
      f.context.uc_link = nullptr;
      makecontext(&f.context, &Host_warp::enter, 0);
    }
    for (;;) {
      for (w.m_lane = 0; w.m_lane < lanes; ++w.m_lane)
        swapcontext(&w.m_main, &w.m_fibres[w.m_lane].context);
      const auto done =
          std::count_if(w.m_fibres, w.m_fibres + lanes, [](const Fibre& f) { return f.is_done; });
      if (done == lanes) return;
      if (done > 0) throw std::logic_error("some lanes ended at an exchange of the others");
    }
  }

  static int lane() { return warp().m_lane; }

  /// All lanes hand in `x`; returns those of all lanes in turn.
  template <class T>
  static const T* exchange(const T& x)
  {
    static_assert(sizeof(T) <= sizeof(double), "a register or two");
    Host_warp& w = warp();
    const int lane = w.m_lane;
    // Two places: the others still read the last exchange.
    char* const slot = w.m_slots[w.m_fibres[lane].exchanges++ % 2];
    std::memcpy(slot + lane * sizeof(T), &x, sizeof(T));
    swapcontext(&w.m_fibres[lane].context, &w.m_main);
    return reinterpret_cast<const T*>(slot);
  }

private:
  struct Fibre {
    ucontext_t context;
    std::vector<char> stack;
    bool is_done = false;
    unsigned exchanges = 0;
  };

  static Host_warp& warp()
  {
    static Host_warp w;
    return w;
  }
  static void enter()
  {
    Host_warp& w = warp();
    const int lane = w.m_lane;
    (*w.m_body)(lane);
    w.m_fibres[lane].is_done = true;
    swapcontext(&w.m_fibres[lane].context, &w.m_main);
  }

  const std::function<void(int)>* m_body = nullptr;
  ucontext_t m_main;
  Fibre m_fibres[lanes];
  int m_lane = 0;
  alignas(8) char m_slots[2][lanes * sizeof(double)];
};

/// The threads of one warp.
struct Host_thread_index {
  struct Rank {
    operator int() const { return Host_warp::lane(); }
  } x;
};
constexpr Host_thread_index threadIdx{};

inline void __syncwarp() { Host_warp::exchange(0); }
template <class T>
T __shfl_sync(unsigned, T x, int from)
{
  return Host_warp::exchange(x)[from & 31];
}
template <class T>
T __shfl_xor_sync(unsigned, T x, int mask)
{
  const int from = Host_warp::lane() ^ mask;
  return Host_warp::exchange(x)[from];
}
template <class T>
T __shfl_up_sync(unsigned, T x, int distance)
{
  const int lane = Host_warp::lane();
  return Host_warp::exchange(x)[lane < distance ? lane : lane - distance];
}
inline unsigned __ballot_sync(unsigned, bool x)
{
  const bool* const all = Host_warp::exchange(x);
  unsigned bits = 0;
  for (int l = 0; l < Host_warp::lanes; ++l) bits |= unsigned(all[l]) << l;
  return bits;
}
inline bool __any_sync(unsigned mask, bool x) { return __ballot_sync(mask, x) != 0; }
inline bool __all_sync(unsigned mask, bool x) { return __ballot_sync(mask, x) == 0xffffffffu; }

inline int __popc(unsigned x) { return __builtin_popcount(x); }
inline int __ffs(int x) { return __builtin_ffs(x); }
inline int __clz(int x) { return __builtin_clz(x); }
inline int __float_as_int(float x)
{
  int bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
inline float __int_as_float(int bits)
{
  float x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}
inline long long __double_as_longlong(double x)
{
  long long bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
template <class T>
T __ldcg(const T* p)
{
  return *p;
}
template <class T>
T atomicMax(T* p, T x)
{
  const T before = *p;
  *p = std::max(before, x);
  return before;
}

#endif // POWER_RTF_TEST_WARP_ON_HOST_H
