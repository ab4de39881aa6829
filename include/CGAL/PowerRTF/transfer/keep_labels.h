// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_TRANSFER_KEEP_LABELS_H
#define CGAL_POWER_RTF_TRANSFER_KEEP_LABELS_H

#include <CGAL/PowerRTF/extraction/mesh_patches.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/transfer/Source_triangles.h>
#include <CGAL/PowerRTF/transfer/Sources.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// The label that most of the area of each part of `mesh` has. \param labels of the triangles
inline std::vector<int> labels_of_parts(const Extracted_mesh& mesh, const std::vector<int>& parts,
                                        int count, const std::vector<int>& labels)
{
  std::vector<std::map<int, double>> areas(count); // of a part, by label
  for (std::size_t f = 0; f < parts.size(); ++f)
    areas[parts[f]].emplace(labels[f], 0).first->second +=
        length(area_vector(mesh, static_cast<int>(f)));
  std::vector<int> result;
  for (const auto& of_part : areas)
    result.push_back(std::max_element(of_part.begin(), of_part.end(), [](auto& x, auto& y) {
                       return x.second < y.second;
                     })->first);
  return result;
}

/// Moves the sources of triangles beside lines between labels to the sides that they are on, as
/// `keep_labels()`.
inline void move_over_lines(Sources& sources, const Polygon_soup& input,
                            const std::vector<int>& labels, const Normalization& normalization,
                            const Extracted_mesh& mesh, Concurrency concurrency)
{
  const std::pair<std::vector<int>, int> numbered = mesh_parts(mesh, concurrency);
  const std::vector<int>& parts = numbered.first;
  const std::vector<int> found = values_at(labels, sources.faces),
                         wanted = labels_of_parts(mesh, parts, numbered.second, found);
  std::vector<char> is_on_feature(mesh.points.size(), false);
  for (const auto& [a, b] : mesh.feature_edges) is_on_feature[a] = is_on_feature[b] = true;
  std::vector<int> beyond;
  std::vector<char> is_mixed(numbered.second, false);
  for (std::size_t f = 0; f < parts.size(); ++f) {
    if (found[f] == wanted[parts[f]]) continue;
    const auto [a, b, c] = mesh.triangles[f];
    if (is_on_feature[a] || is_on_feature[b] || is_on_feature[c])
      beyond.push_back(static_cast<int>(f));
    else
      is_mixed[parts[f]] = true;
  }
  beyond.erase(
      std::remove_if(beyond.begin(), beyond.end(), [&](int f) { return is_mixed[parts[f]]; }),
      beyond.end());
  if (beyond.empty()) return;
  const Source_triangles triangles(input, normalization);
  std::vector<int> labels_of_triangles;
  std::map<int, int> some; // triangle of each label
  for (const int polygon : triangles.polygons) {
    some.emplace(labels[polygon], static_cast<int>(labels_of_triangles.size()));
    labels_of_triangles.push_back(labels[polygon]);
  }
  const Facet_tree tree(triangles.points, triangles.triangles, labels_of_triangles, concurrency);
  for_each_index(concurrency, static_cast<int>(beyond.size()), [&](int k) {
    const int f = beyond[k];
    const Vec3d middle = center(mesh, f);
    const int with_label = some.at(wanted[parts[f]]);
    Surface_point<double> nearest = tree.nearest(middle, area_vector(mesh, f), 0, with_label);
    if (nearest.facet < 0) nearest = tree.nearest(middle, with_label);
    sources.faces[f] = triangles.source(nearest.facet, nearest.point);
  });
}

} // namespace internal

/// Makes the triangles on both sides of a line between labels come from the sides that they are on:
/// where the surface is bent, or an edge cuts a corner off its line, what is nearest to the center
/// of a triangle may lie beyond. Such a triangle gets the nearest place with the label that most of
/// its part has, the triangles that no feature edge parts; but not where triangles farther inside
/// have several labels, too, as those of a symmetric mesh may, whose lines are those of one half.
/// Nor do shares of it come from beyond.
///
/// \param sources of `mesh` in `input`, as `find_sources()` finds them
/// \param labels of the polygons of `input`; empty: nothing is done
/// \param mesh the result, in coordinates of the unit box, with its feature edges
inline void keep_labels(Sources& sources, const Polygon_soup& input, const std::vector<int>& labels,
                        const Normalization& normalization, const Extracted_mesh& mesh,
                        internal::Concurrency concurrency = Sequential_tag())
{
  if (labels.empty() || mesh.feature_edges.empty()) return;
  internal::move_over_lines(sources, input, labels, normalization, mesh, concurrency);
  for (std::size_t f = 0; f < sources.shares.size(); ++f) {
    const int own = sources.faces[f].face;
    for (int& polygon : sources.shares[f])
      if (labels[polygon] != labels[own]) polygon = own;
  }
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_TRANSFER_KEEP_LABELS_H
