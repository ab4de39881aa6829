// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Takes the vertices out of a mesh that it can spare within a distance.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_COARSEN_MESH_H
#define CGAL_POWER_RTF_IMPROVEMENT_COARSEN_MESH_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/compiled.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>

namespace CGAL::PowerRTF {

class Facet_tree;

/// Takes vertices out of `mesh` where it stays within `distance` of `surface`, both ways, as far as
/// points of both tell, no triangle becomes bad and none meets another: until no vertex can be
/// spared. Those on creases and borders and those that are kept stay, as the topology does.
///
/// \param mesh an oriented 2-manifold; else nothing is done
/// \param tree of the facets of `surface` and their patches
/// \param distance in coordinates of the unit box
/// \param concurrency a tag of CGAL's; the result is the same for all
/// \returns the number of vertices that were taken out
std::size_t coarsen_mesh(const Surface& surface, const Facet_tree& tree, Extracted_mesh& mesh,
                         double distance, internal::Concurrency concurrency = Sequential_tag());

} // namespace CGAL::PowerRTF

#ifndef CGAL_POWER_RTF_COMPILED
#include <CGAL/PowerRTF/improvement/coarsen_mesh_impl.h>
#endif

#endif // CGAL_POWER_RTF_IMPROVEMENT_COARSEN_MESH_H
