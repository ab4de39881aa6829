// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_IMPROVEMENT_MESH_SWEEPER_H
#define CGAL_POWER_RTF_IMPROVEMENT_MESH_SWEEPER_H

#include <CGAL/PowerRTF/improvement/Changed_vertices.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/flat_stars.h>
#include <CGAL/PowerRTF/smoothing/Star_sweeps_base.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// Sweeps over a mesh where an engine works, if it has the room; else on the host. Each has the
/// stars from when it was last asked: then only those go there that have changed.
class Mesh_sweeper {
public:
  /// `there`: null, if no engine does that. `has_stars`: it has those of the mesh as it is.
  Mesh_sweeper(Star_mesh& mesh, Star_sweeps_base* there, Star_sweeps_base& here,
               bool has_stars = false)
      : m(mesh), m_there{there, has_stars, {}}, m_here{&here, false, {}}
  {
    m_last->changed.emplace(mesh).assign({});
  }
  Mesh_sweeper(const Mesh_sweeper&) = delete;

  /// Where `f(sweeps)` does not return `false`, the vertices go to where it has moved them.
  /// \returns those that are left doubtful.
  template <class F>
  std::vector<int> sweep(const F& f)
  {
    Swept_vertices swept;
    if (!m_there.sweeps || !is_swept(m_there, f, swept)) is_swept(m_here, f, swept);
    return std::move(swept.doubtful);
  }

  /// How many vertices, or their edges, have changed otherwise, before sweeps and since the last.
  std::size_t changes() const { return m_changes + (m_last ? m_last->changed->find().size() : 0); }

private:
  struct Place {
    Star_sweeps_base* sweeps;
    bool has_stars;                          // as they were before the changes
    std::optional<Changed_vertices> changed; // since the last sweeps here; none: not known
  };

  template <class F>
  bool is_swept(Place& place, const F& f, Swept_vertices& swept)
  {
    constexpr std::size_t vertices_per_change = 2;
    std::vector<int> changed;
    if (place.changed) changed = place.changed->find();
    if (std::exchange(m_last, nullptr) == &place) m_changes += changed.size();
    const bool are_few = place.changed && place.changed->are_few(changed, vertices_per_change);
    place.has_stars =
        place.sweeps->take(place.has_stars && are_few ? flat_stars(m, std::move(changed))
                                                      : flat_stars(m)) &&
        f(*place.sweeps);
    if (!place.has_stars) return false;
    place.sweeps->read(swept);
    m.move_all(swept);
    if (!place.changed) place.changed.emplace(m);
    place.changed->assign({});
    m_last = &place;
    return true;
  }

  Star_mesh& m;
  Place m_there, m_here;
  Place* m_last = m_there.sweeps ? &m_there : &m_here; // where the mesh was swept, or will be
  std::size_t m_changes = 0;                           // before the last sweeps
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_MESH_SWEEPER_H
