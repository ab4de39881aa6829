// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgPowerRTFConcepts
\cgalConcept

Where the arrays of an engine lie and how its loops run. All that an algorithm computes over many
items is written once, as functors that are copied to where they run and read and write arrays by
pointers. Calls may return before the work is done; they are carried out in their order.

Each model must be deterministic: sums are added up in an order that depends on the number of items
alone.

\cgalHasModelsBegin
\cgalHasModels{`CGAL::PowerRTF::Host_backend<ConcurrencyTag>`}
\cgalHasModels{`CGAL::PowerRTF::device::Cuda_backend`}
\cgalHasModelsEnd
*/
class PowerRTFBackend {
public:
  /// Whether the lanes of `for_each_by_warps()` are a warp, which needs lists of near vertices.
  static constexpr bool works_by_warps;
  /// Items up to which `run_resident_team()` is worth trying.
  static constexpr int max_resident;
  /// Of loops in the host's memory beside those of the backend.
  static CGAL::PowerRTF::internal::Concurrency concurrency();

  /// An array. It is default constructible and frees its memory; what it holds is lost when it
  /// grows.
  template <class T>
  class Buffer {
  public:
    void allocate(PowerRTFBackend& backend, std::size_t n);
    T* data();
    const T* data() const;
    std::size_t size() const;
  };

  /// One item that loops write and the host reads after `synchronize()`.
  template <class T>
  class Shared_item {
  public:
    explicit Shared_item(PowerRTFBackend& backend);
    T* data();
  };

  /// Calls `f(i)` for i in [0, n), in any order and at the same time.
  template <class F>
  void for_each(int n, F f);

  /// Calls `f(i, lanes)` for i in [0, n), by a few lanes that work on item i together. Only the
  /// lane with `lanes.leads()` writes.
  template <class F>
  void for_each_by_lanes(int n, F f);
  /// The same by as many lanes as a warp has.
  template <class F>
  void for_each_by_warps(int n, F f);

  /// Adds `f(i, totals)` up over [0, n) and calls `finish(totals)` once, where the loops run.
  /// `totals`: a `CGAL::PowerRTF::Totals<Sums, Maxima>`.
  template <int Sums, int Maxima, class F, class Finish>
  void reduce(int n, F f, Finish finish);

  /// Adds `rule.add_first(i, first)` up, then, with `result = rule.middle(first)`,
  /// `rule.add_second(i, result, second)`, and calls `rule.finish(result, second)`. `Rule::First`
  /// and `Rule::Second` are the types of the totals.
  template <class Rule>
  void reduce_twice(int n, const Rule& rule);

  /// Runs `f(team)` by n threads at once, which exchange totals by `team.join(totals)`. Returns
  /// `false` and does nothing where so many cannot wait for each other.
  template <class F>
  bool run_resident_team(int n, const F& f);

  /// Calls `f(sweep, i)` for i in [0, n), in any order and at the same time, for each sweep in
  /// [0, sweeps) after the one before, where that takes less than `for_each()` for each. Else
  /// returns `false` and does nothing. \pre n > 0
  template <class F>
  bool run_sweeps(int n, int sweeps, const F& f);

  /// The order of n items by their keys, equal ones by number. The keys may be lost. `is_coarse`:
  /// points that are near along a Hilbert curve, whose codes the keys are, may count as equal.
  void sort_order(int n, std::uint64_t* keys, int* order, bool is_coarse = false);

  /// Writes the items i of [0, n) with `is_wanted[i]`, in order, to `items`, which has room for n.
  /// Returns their number.
  int select(int n, const unsigned char* is_wanted, int* items);

  template <class T>
  void upload(T* to, const T* from, std::size_t n);
  /// Waits for the work so far.
  template <class T>
  void download(T* to, const T* from, std::size_t n);
  template <class T>
  void fill(T* to, T value, std::size_t n);

  /// Waits for the work so far.
  void synchronize();

  /// The time of a device from `start_clock()` to the last `stop_clock()`; 0 for the host.
  void start_clock();
  void stop_clock();
  double seconds() const;

  /// Whether the facets of a surface are where it works; not asked of the host.
  bool has(const CGAL::PowerRTF::Resident_surface& surface) const;

  /// Whether so many bytes are free.
  bool has_room(std::size_t bytes) const;

  /// The most memory of a device that was held at a time; 0 for the host.
  std::size_t bytes() const;
  /// What a backend has from the beginning, and what `sort_order()` of n items adds; of a device.
  static std::size_t least_bytes();
  static std::size_t sort_bytes(int n);

  /// The name of the device; empty for the host.
  std::string name() const;
};
