// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for Host_engine.h.
#ifndef CGAL_POWER_RTF_ENGINES_HOST_ENGINE_IMPL_H
#define CGAL_POWER_RTF_ENGINES_HOST_ENGINE_IMPL_H

#include <CGAL/PowerRTF/cells/Tree_cells.h>
#include <CGAL/PowerRTF/engines/Engine.h>
#include <CGAL/PowerRTF/engines/Host_engine.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>

#include <memory>

namespace CGAL::PowerRTF {

template <class Real, class Construction, class ConcurrencyTag>
std::unique_ptr<Engine_base>
Make_host_engine<Real, Construction, ConcurrencyTag>::make(const Surface_in_tree& surface,
                                                           const Remeshing_options& options)
{
  using Backend = Host_backend<ConcurrencyTag>;
  using Cells = Tree_cells<Real, Backend, Construction>;
  return std::make_unique<Engine<Real, Backend, Cells>>(surface, options);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_HOST_ENGINE_IMPL_H
