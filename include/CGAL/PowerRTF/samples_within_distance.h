// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The smallest number of samples whose mesh is as near to its input as is asked for.
#ifndef CGAL_POWER_RTF_SAMPLES_WITHIN_DISTANCE_H
#define CGAL_POWER_RTF_SAMPLES_WITHIN_DISTANCE_H

#include <CGAL/PowerRTF/Remeshing_visitor.h>
#include <CGAL/PowerRTF/fields/resolution.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/find_first.h>
#include <CGAL/PowerRTF_remesher.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// The smallest n up to `most` with `ratio(n) <= 1`, to a tenth, where `ratio` falls about as 1 /
/// n, if it falls; infinite if there is none. The search begins with `first`.
template <class Ratio>
double smallest_of_falling(double first, double most, const Ratio& ratio)
{
  constexpr double near_enough = 1.1, step = 1.04, least = 4, farthest = 4;
  double failed = least - 1, met = infinity;
  for (double n = std::round(std::clamp(first, least, most));;) {
    const double r = ratio(static_cast<std::size_t>(n));
    (r <= 1 ? met : failed) = n;
    if (failed == most) return infinity;
    if (met <= near_enough * failed || met == failed + 1) return met;
    // A little more than it should be, and between what has been tried.
    const double next = std::round(n * step * std::clamp(r, 1 / farthest, farthest));
    const double low = std::max(failed + 1, std::ceil(step * failed)),
                 high = std::min({met - 1, std::floor(met / step), most});
    n = std::clamp(next, std::min(low, high), std::max(high, failed + 1));
  }
}

/// Below this, numbers scatter more, and a run takes a moment.
inline constexpr double small_number = 2000;

/// Where `ratio` scatters by some tenths about what it should be, a few numbers below `best`, which
/// does, do by luck. Of those from 24 to 2 % below, in steps of 2 %, the smallest that does is
/// taken. Then of those from 24 to 14 % below that, as about the nearer ones have been tried, and
/// so on until none does. Of small numbers, from 36 % below on. `find(numbers)` returns the place
/// of the first of them with `ratio(n) <= 1`, or their number.
template <class Find>
double smallest_by_luck(double best, const Find& find)
{
  constexpr double step = 0.02, least = 4;
  constexpr int far = 7;
  for (int nearest = 1;; nearest = far) {
    std::vector<std::size_t> numbers;
    for (int k = best < small_number ? 18 : 12; k >= nearest; --k) {
      const double n = std::round((1 - step * k) * best);
      if (n >= least && n < best) numbers.push_back(static_cast<std::size_t>(n));
    }
    const std::size_t at = find(numbers);
    if (at == numbers.size()) return best;
    best = static_cast<double>(numbers[at]);
  }
}

/// What a trial run tells and asks: on the thread of the search, the visitor; on all, whether the
/// visitor has stopped the search, and whether the trial's outcome is still needed.
template <class Visitor, class IsNeeded>
class Trial_visitor : public Remeshing_default_visitor {
public:
  Trial_visitor(Visitor& visitor, std::thread::id thread, std::atomic<bool>& is_stopped,
                const IsNeeded& is_needed)
      : m_visitor(std::this_thread::get_id() == thread ? &visitor : nullptr),
        m_is_stopped(is_stopped), m_is_needed(is_needed)
  {}

  void on_stage(const char* name)
  {
    if (m_visitor) m_visitor->on_stage(name);
  }
  void on_progress(double done)
  {
    if constexpr (Hears_of_progress<Visitor>::value)
      if (m_visitor) m_visitor->on_progress(done);
    (void)done;
  }
  void on_iteration(const Iteration_report& iteration, double progress)
  {
    if (m_visitor) m_visitor->on_iteration(iteration, progress);
  }
  bool go_further()
  {
    if (m_visitor && !m_visitor->go_further()) m_is_stopped = true;
    return !m_is_stopped && m_is_needed();
  }

private:
  Visitor* m_visitor; // null on other threads
  std::atomic<bool>& m_is_stopped;
  const IsNeeded& m_is_needed;
};

/// The largest distance of a run with so many samples, in what is asked for; infinite where the
/// samples are too few, or the visitor stops it.
template <class Traits, class Prepare, class Visitor>
double distance_ratio(Remeshing_options options, std::size_t samples, const Prepare& prepare,
                      Visitor& visitor)
{
  options.number_of_samples = samples;
  Remeshing_report report;
  Surface surface = prepare(options, report);
  try {
    PowerRTF_remesher<Traits> remesher(std::move(surface), options, report);
    if (remesher.optimize(visitor)) remesher.extract_all(visitor);
    const Remeshing_report& done = remesher.report();
    return done.cancelled ? infinity : done.absolute(done.distance.bound) / done.max_distance;
  } catch (const Invalid_input_error&) { // the samples are too few
    return infinity;
  }
}

} // namespace internal

/// The number of samples of which a run gives a mesh no farther from the input than
/// `options.max_distance` or `options.relative_max_distance`, about the smallest such number;
/// where none does, the largest that was tried: ten times the input's vertices, or as many as are
/// needed on a sphere. Where vertices are taken out afterwards, a large one may be a tenth larger.
///
/// \tparam Traits a model of `PowerRTFTraits_3`; where it is parallel, several runs go on at once
/// \param prepare `prepare(options, report)` returns the surface as `prepare_surface()`; called on
///   several threads, but on one at a time
/// \param visitor hears of the runs on this thread
/// \throws internal::Run_cancelled `visitor` stopped it
template <class Traits, class Prepare, class Visitor>
std::size_t samples_within_distance(const Remeshing_options& options, const Prepare& prepare,
                                    Visitor& visitor)
{
  double first, most, facets;
  bool is_coarsened;
  {
    Remeshing_report report;
    const Surface surface = prepare(options, report);
    facets = double(surface.triangles.size());
    is_coarsened = PowerRTF::is_coarsened(options, surface);
    first = samples_of_sphere(surface, report.max_distance);
    most = std::clamp(10 * std::max(first, double(surface.points.size())), 1000., 3e8);
  }
  std::mutex mutex;
  const auto prepare_alone = [&](const Remeshing_options& o, Remeshing_report& report) {
    const std::lock_guard<std::mutex> lock(mutex);
    return prepare(o, report);
  };
  const std::thread::id thread = std::this_thread::get_id();
  std::atomic<bool> is_stopped{false};
  const auto throw_if_stopped = [&] {
    if (is_stopped) throw internal::Run_cancelled();
  };
  const auto ratio = [&](std::size_t n, const auto& is_needed) {
    internal::Trial_visitor trial(visitor, thread, is_stopped, is_needed);
    double r = internal::infinity;
    try {
      r = internal::distance_ratio<Traits>(options, n, prepare_alone, trial);
    } catch (const internal::Run_cancelled&) { // as the surface was prepared
      is_stopped = true;
    }
    throw_if_stopped();
    return r;
  };
  const double best = internal::smallest_of_falling(
      first, std::floor(most), [&](std::size_t n) { return ratio(n, [] { return true; }); });
  if (best == internal::infinity) return static_cast<std::size_t>(most);
  if (is_coarsened && best >= internal::small_number) return static_cast<std::size_t>(best);
  return static_cast<std::size_t>(
      internal::smallest_by_luck(best, [&](const std::vector<std::size_t>& numbers) {
        constexpr double most_at_once = 1 << 21; // facets and samples: some GB
        const int at_once = numbers.empty() ? 1 : int(most_at_once / (facets + double(numbers[0])));
        const int at = internal::find_first(
            typename Traits::Concurrency_tag(), int(numbers.size()), at_once,
            [&](int i, const auto& is_needed) { return ratio(numbers[i], is_needed) <= 1; },
            [&] {
              if (!visitor.go_further()) is_stopped = true;
            });
        throw_if_stopped();
        return std::size_t(at);
      }));
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLES_WITHIN_DISTANCE_H
