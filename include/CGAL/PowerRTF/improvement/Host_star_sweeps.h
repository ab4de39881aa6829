// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_IMPROVEMENT_HOST_STAR_SWEEPS_H
#define CGAL_POWER_RTF_IMPROVEMENT_HOST_STAR_SWEEPS_H

#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/Star_sweeps.h>

#include <memory>

namespace CGAL::PowerRTF::internal {

/// On the host, with the backend that that takes.
template <class ConcurrencyTag>
class Host_star_sweeps final : private Host_backend<ConcurrencyTag>,
                               public Star_sweeps<Host_backend<ConcurrencyTag>> {
public:
  Host_star_sweeps(const Surface_descent& surface, double grid)
      : Star_sweeps<Host_backend<ConcurrencyTag>>(*this, surface, grid)
  {}
};

/// As `Make_star_sweeps`, on the host.
inline std::unique_ptr<Star_sweeps_base> make_host_star_sweeps(const Surface_descent& surface,
                                                               double grid, Concurrency concurrency)
{
  if (concurrency.is_parallel())
    return std::make_unique<Host_star_sweeps<Parallel_if_available_tag>>(surface, grid);
  return std::make_unique<Host_star_sweeps<Sequential_tag>>(surface, grid);
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_HOST_STAR_SWEEPS_H
