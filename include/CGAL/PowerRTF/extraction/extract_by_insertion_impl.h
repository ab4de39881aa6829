// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for extract_by_insertion.h.
#ifndef CGAL_POWER_RTF_EXTRACTION_EXTRACT_BY_INSERTION_IMPL_H
#define CGAL_POWER_RTF_EXTRACTION_EXTRACT_BY_INSERTION_IMPL_H

#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/extraction/extract_by_insertion.h>
#include <CGAL/PowerRTF/extraction/extract_guarded.h>
#include <CGAL/PowerRTF/extraction/insert_samples.h>
#include <CGAL/PowerRTF/extraction/reduce_to_samples.h>
#include <CGAL/PowerRTF/extraction/separated_samples.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

inline Extracted_mesh to_extracted_mesh(const Working_mesh& working, const Samples& samples)
{
  const auto& mesh = working.mesh;
  Extracted_mesh result;
  result.points = samples.points;
  std::vector<int> name(working.samples);
  int names = int(samples.size()); // copies of exchanged ones come after them
  for (const int n : name) names = std::max(names, n + 1);
  result.points.resize(names);
  for (const auto v : mesh.vertices())
    if (name[v] >= 0)
      result.points[name[v]] = working.point(v); // another one if the sample was exchanged
    else if (!mesh.is_isolated(v)) {
      name[v] = int(result.points.size());
      result.points.push_back(working.point(v));
    }
  if (!working.places.empty()) {
    result.places.assign(result.points.size(), -1);
    for (const auto v : mesh.vertices())
      if (name[v] >= 0) result.places[name[v]] = working.places[v];
  }
  result.triangles = working.triangles();
  for (Triangle& t : result.triangles)
    for (int& v : t) v = name[v];
  result.sort_triangles();
  for (const auto v : mesh.vertices())
    for (const auto w : working.feature_neighbors(v))
      if (name[v] < name[w]) result.feature_edges.push_back({name[v], name[w]});
  std::sort(result.feature_edges.begin(), result.feature_edges.end());
  return result;
}

/// The number of them in the surface itself.
inline std::size_t intersections(const Surface& surface, const Seam_places& seams)
{
  Working_mesh mesh(surface.points, surface.triangles, Sequential_tag());
  mesh.set_places(seams);
  return Intersection_finder(mesh).all().size();
}

} // namespace internal

CGAL_POWER_RTF_INLINE Extracted_mesh extract_by_insertion(const Surface& surface,
                                                          const Samples& samples,
                                                          const Feature_samples& features,
                                                          const Seam_places& seams)
{
  internal::Progress_part part(0.3);
  internal::Working_mesh mesh(internal::insert_samples(surface, samples, features.places));
  part.next(0.95); // what follows is rare
  mesh.set_places(seams);
  const std::size_t defects = internal::reduce_to_samples(mesh);
  Extracted_mesh result = internal::to_extracted_mesh(mesh, samples);
  if (defects == 0) return result;

  // Where the samples are too sparse: more carefully there, and more widely if that does not help.
  internal::Sparse_places sparse = internal::sparse_places(mesh);
  if (sparse.balls.empty()) return result;
  std::pair<std::size_t, std::size_t> fewest = sparse.defects();
  std::vector<internal::Ball> guarded;
  const std::size_t input_intersections = internal::intersections(surface, seams);
  const Samples apart = internal::separated_samples(surface, samples, features.size());
  using Care = internal::Guarded_extraction::Care;
  struct Attempt {
    double reach;
    Care care;
  };
  bool was_everywhere = false;
  for (const auto& [reach, care] :
       {Attempt{2, Care::off_patches}, Attempt{8, Care::off_patches},
        Attempt{1e3, Care::off_patches}, Attempt{1e3, Care::everywhere}}) {
    if (was_everywhere && care == Care::off_patches) continue;
    guarded.insert(guarded.end(), sparse.balls.begin(), sparse.balls.end());
    internal::Guarded_extraction extraction(surface, apart, features, guarded, reach, seams, care);
    extraction.run();
    was_everywhere = extraction.was_everywhere();
    sparse = internal::sparse_places(extraction.mesh());
    if (sparse.defects() < fewest) {
      fewest = sparse.defects();
      result = internal::to_extracted_mesh(extraction.mesh(), apart);
    }
    // More care does not help where the surface intersects itself as much as the mesh.
    if (sparse.balls.empty() || sparse.intersections <= input_intersections ||
        (was_everywhere && input_intersections > 0) || extraction.has_too_few_samples())
      break;
  }
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXTRACTION_EXTRACT_BY_INSERTION_IMPL_H
