// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engines of the CPU, sequential or with TBB.
#ifndef CGAL_POWER_RTF_ENGINES_HOST_ENGINE_H
#define CGAL_POWER_RTF_ENGINES_HOST_ENGINE_H

#include <CGAL/PowerRTF/cells/Tree_cells.h>
#include <CGAL/PowerRTF/engines/Engine.h>
#include <CGAL/PowerRTF/engines/Surface_engine.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>

#include <memory>

namespace CGAL::PowerRTF {

template <class Real, class Construction, class ConcurrencyTag>
struct Make_host_engine {
  static void check(const Remeshing_options&) {}
  static std::unique_ptr<Engine_base> make(const Packed_surface& surface,
                                           const Remeshing_options& options)
  {
    using Backend = Host_backend<ConcurrencyTag>;
    using Cells = Tree_cells<Real, Backend, Construction>;
    return std::make_unique<Engine<Real, Backend, Cells>>(surface, options);
  }
};

/// \tparam Construction of the cells; see `Tree_cells`
template <class Real, class Construction, class ConcurrencyTag>
using Host_engine = Surface_engine<Make_host_engine<Real, Construction, ConcurrencyTag>>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_HOST_ENGINE_H
