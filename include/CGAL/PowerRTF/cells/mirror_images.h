// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// From the samples and cells of the half of a symmetric surface to those of the whole.
#ifndef CGAL_POWER_RTF_CELLS_MIRROR_IMAGES_H
#define CGAL_POWER_RTF_CELLS_MIRROR_IMAGES_H

#include <CGAL/PowerRTF/cells/Cell_polygon.h>
#include <CGAL/PowerRTF/geometry/Mirror_plane.h>
#include <CGAL/PowerRTF/geometry/Surface.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// `cells`, then their images in the same order. Samples on the plane have no cells. The neighbors
/// of an image have the numbers of those that they are the images of.
/// \param mirror in the unit box; none: there are no images
inline std::vector<Cell_polygon> with_images(std::vector<Cell_polygon> cells,
                                             const std::optional<Mirror_plane>& mirror)
{
  if (!mirror) return cells;
  const std::size_t count = cells.size();
  for (std::size_t i = 0; i < count; ++i) {
    Cell_polygon image = cells[i];
    std::vector<Vec3d>& vertices = image.vertices;
    for (Vec3d& p : vertices) p = mirror->image(p);
    std::reverse(vertices.begin(), vertices.end());
    if (!image.neighbors.empty()) // of edge k, from vertex k on
      std::reverse(image.neighbors.begin(), image.neighbors.end() - 1);
    cells.push_back(std::move(image));
  }
  return cells;
}

/// `samples`, then the images of those that are not on the plane, in the same order: the numbers of
/// the result's vertices. \param with_cells how many of them have cells, the first ones
inline Samples with_images(Samples samples, std::size_t with_cells,
                           const std::optional<Mirror_plane>& mirror)
{
  if (!mirror) return samples;
  const std::size_t count = samples.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (i >= with_cells && mirror->has(samples.points[i])) continue;
    samples.points.push_back(mirror->image(samples.points[i]));
    Vec3d n = samples.normals[i];
    Mirror_plane::coordinate(n, mirror->axis) *= -1;
    samples.normals.push_back(n);
    samples.facets.push_back(samples.facets[i]);
    samples.density.push_back(samples.density[i]);
    samples.weights.push_back(samples.weights[i]);
    if (!samples.patches.empty()) samples.patches.push_back(samples.patches[i]);
  }
  return samples;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_MIRROR_IMAGES_H
