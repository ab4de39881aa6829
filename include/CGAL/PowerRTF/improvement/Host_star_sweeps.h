// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_IMPROVEMENT_HOST_STAR_SWEEPS_H
#define CGAL_POWER_RTF_IMPROVEMENT_HOST_STAR_SWEEPS_H

#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/Star_sweeps.h>

#include <memory>
#include <utility>

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

/// Where `first` works, if there is one that has the room; else where `second` works.
class Star_sweeps_of_two final : public Star_sweeps_base {
public:
  Star_sweeps_of_two(std::unique_ptr<Star_sweeps_base>&& first,
                     std::unique_ptr<Star_sweeps_base>&& second)
      : m_first(std::move(first)), m_second(std::move(second))
  {}

  bool smooth(Flat_stars& stars, int steps) override
  {
    return (m_first && m_first->smooth(stars, steps)) || m_second->smooth(stars, steps);
  }
  bool fit(Flat_stars& stars, Flat_fit& fit) override
  {
    return (m_first && m_first->fit(stars, fit)) || m_second->fit(stars, fit);
  }
  /// By `first` alone: who asks goes from face to face, which is quicker than `second`.
  bool find_faces(const Mesh_arrays& mesh, int n, const int* vertices, int* faces) override
  {
    return m_first && m_first->find_faces(mesh, n, vertices, faces);
  }

private:
  std::unique_ptr<Star_sweeps_base> m_first, m_second;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_HOST_STAR_SWEEPS_H
