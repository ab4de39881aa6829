// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definition for prepare_surface.h.
#ifndef CGAL_POWER_RTF_PREPARE_SURFACE_IMPL_H
#define CGAL_POWER_RTF_PREPARE_SURFACE_IMPL_H

#include <CGAL/PowerRTF/features/kept_edges.h>
#include <CGAL/PowerRTF/features/kept_vertices.h>
#include <CGAL/PowerRTF/features/refine_narrow_patches.h>
#include <CGAL/PowerRTF/features/sample_features.h>
#include <CGAL/PowerRTF/fields/density.h>
#include <CGAL/PowerRTF/fields/resolution.h>
#include <CGAL/PowerRTF/fields/sizing.h>
#include <CGAL/PowerRTF/fields/thin_parts.h>
#include <CGAL/PowerRTF/input/clean_surface.h>
#include <CGAL/PowerRTF/input/cured_soup.h>
#include <CGAL/PowerRTF/input/merge_near.h>
#include <CGAL/PowerRTF/input/soup_triangles.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/prepare_surface.h>
#include <CGAL/PowerRTF/quality/topology.h>
#include <CGAL/PowerRTF/transfer/find_sources.h>

#include <string>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

/// \throws Invalid_input_error `options` and `fields` do not go together
inline void check_fields(const Remeshing_options& options, const Surface_fields& fields)
{
  if (fields.sizes && fields.densities)
    throw Invalid_input_error("densities and edge lengths at the vertices exclude each other");
  if (options.size_factor > 0 && !fields.sizes)
    throw Invalid_input_error("size_factor needs a sizing field, but there is none");
  if (options.symmetry != Symmetry::none && !fields.kept_edges.empty())
    throw Invalid_input_error("symmetry is that of a whole: a region has to fit what stays");
  if (options.symmetry != Symmetry::none && !fields.kept_vertices.empty())
    throw Invalid_input_error("symmetry and vertices that are to stay exclude each other: the "
                              "mirror images of these need not be vertices of the input");
  if (is_distance_asked_for(options) && has_wanted_lengths(options, fields))
    throw Invalid_input_error("a largest distance and wanted edge lengths exclude each other");
}

/// \throws Invalid_input_error `fields` are those of vertices and facets that a cure makes anew
inline void check_cure(const Remeshing_options& options, const Surface_fields& fields)
{
  if (fields.creases || fields.densities || fields.sizes || !fields.lines.empty() ||
      !fields.labels.empty() || !fields.kept_edges.empty() || !fields.kept_vertices.empty())
    throw Invalid_input_error("what is given for vertices and facets is for those of the input; "
                              "intersections = " +
                              to_text(options.intersections) + " makes others");
}

/// What those of `points` have become where vertices are merged.
inline std::vector<int> merged_points(std::vector<int> points, const Polygon_soup& soup,
                                      Concurrency concurrency)
{
  if (!soup.merges_vertices || points.empty()) return points;
  const std::vector<int> vertex =
      merged_vertices(soup, used_points(soup, concurrency), concurrency);
  for (int& v : points) v = vertex[v];
  return points;
}

/// The same of the ends of edges.
inline std::vector<Edge> merged_edges(std::vector<Edge> edges, const Polygon_soup& soup,
                                      Concurrency concurrency)
{
  std::vector<int> ends;
  for (const Edge& e : edges) ends.insert(ends.end(), e.begin(), e.end());
  ends = merged_points(std::move(ends), soup, concurrency);
  for (std::size_t k = 0; k < edges.size(); ++k)
    edges[k] = sorted_edge(ends[2 * k], ends[2 * k + 1]);
  return edges;
}

/// Keeps the edges and vertices of `fields`.
/// \param soup what the surface has become of
/// \throws Invalid_input_error as `keep_edges()` and `keep_vertices()`
inline void keep_places(Surface& surface, const Polygon_soup& soup, const Surface_fields& fields,
                        const Remeshing_options& options, Concurrency concurrency)
{
  if (!fields.kept_edges.empty())
    keep_edges(surface, fields.kept_edges, merged_edges(fields.kept_edges, soup, concurrency));
  if (!fields.kept_vertices.empty())
    keep_vertices(surface, fields.kept_vertices,
                  merged_points(fields.kept_vertices, soup, concurrency), soup.points.size());
  for (const int v : surface.kept_vertices) {
    const Vec3d& p = soup.points[surface.input_vertices[v]];
    const bool is_single = options.coordinates == Coordinates::single_precision;
    surface.kept_points.push_back(is_single ? to_double(to_real<float>(p)) : p);
  }
}

/// The lines of `fields`, as edges of the surface.
/// \param soup what the surface has become of
inline std::vector<Edge> line_edges(const Surface& surface, const Polygon_soup& soup,
                                    const Surface_fields& fields, Concurrency concurrency)
{
  std::vector<Edge> lines = merged_edges(fields.lines, soup, concurrency);
  lines.insert(lines.end(), fields.lines.begin(), fields.lines.end());
  return lines.empty() ? lines : marked_edges(surface, std::move(lines), concurrency);
}

/// Gives the facets of the surface their labels, if there are several.
/// \param soup what the surface has become of
/// \returns the edges between facets with different labels
/// \throws Invalid_input_error there are not as many labels as polygons
inline std::vector<Edge> set_labels(Surface& surface, const Polygon_soup& soup,
                                    const Surface_fields& fields, bool is_oriented,
                                    Concurrency concurrency)
{
  if (fields.labels.empty()) return {};
  if (fields.labels.size() + 1 != soup.first.size())
    throw Invalid_input_error("there are " + std::to_string(fields.labels.size()) + " labels for " +
                              std::to_string(soup.first.size() - 1) + " facets");
  const Sources sources = find_sources(soup, surface.normalization, is_oriented, surface.points,
                                       surface.triangles, concurrency);
  std::vector<int> labels = values_at(fields.labels, sources.faces);
  std::vector<Edge> boundaries = label_boundaries(surface, labels, concurrency);
  if (!boundaries.empty()) surface.facet_labels = std::move(labels);
  return boundaries;
}

} // namespace internal

CGAL_POWER_RTF_INLINE Surface prepare_surface(Polygon_soup&& soup, const Surface_fields& fields,
                                              const Remeshing_options& options,
                                              Remeshing_report& report,
                                              internal::Concurrency concurrency,
                                              const Surface_work& work)
{
  const internal::Stopwatch watch(report.seconds.surface);
  internal::check_fields(options, fields);
  internal::Progress_part part(0.1);
  if (options.merge_distance > 0) {
    if (fields.creases || !fields.lines.empty() || !fields.labels.empty() ||
        !fields.kept_edges.empty() || !fields.kept_vertices.empty())
      throw Invalid_input_error("creases, labels, regions and vertices that are to stay are those "
                                "of the input, which merge_distance may join or cut");
    internal::merge_near(soup, options.merge_distance, report.repairs, concurrency);
  }
  if (options.intersections != Intersections::keep) {
    internal::check_cure(options, fields);
    soup = internal::cured_soup(soup, options, report.cure, concurrency);
  }
  Surface surface = internal::clean_surface(soup, options.repair, options.non_manifold,
                                            report.repairs, concurrency, work.build);
  if (!fields.kept_edges.empty()) {
    if (!report.faces_as_input())
      throw Invalid_input_error("the facets of the region do not all face the same way, so that "
                                "the new ones could not go on as those around it");
  }
  internal::keep_places(surface, soup, fields, options, concurrency);
  const std::vector<Edge> lines = internal::line_edges(surface, soup, fields, concurrency),
                          label_edges = internal::set_labels(surface, soup, fields,
                                                             report.faces_as_input(), concurrency);
  soup = {}; // its memory
  part.next(0.2);
  Remeshing_options with_number = options;
  const auto set_density_by_fields = [&] {
    fields.sizes       ? set_density_by_sizes(surface, *fields.sizes)
    : fields.densities ? set_density(surface, with_number, *fields.densities, concurrency)
                       : set_density(surface, with_number, concurrency, work.compute_density);
  };
  const auto set_fields = [&] {
    with_number.number_of_samples = number_of_samples(surface, options, concurrency);
    fields.creases ? set_creases(surface, *fields.creases, concurrency)
                   : set_creases(surface, with_number, concurrency);
    add_creases(surface, lines);
    add_creases(surface, label_edges);
    set_density_by_fields();
  };
  part.next(0.75);
  if (fields.sizes) set_density_by_fields(); // which gives the number
  set_fields();                              // the density is still uniform, unless by sizes
  if (is_number_of_samples_open(options) && !has_uniform_density(surface)) set_fields();
  surface.has_own_density = fields.densities.has_value();
  report.max_distance = max_distance(surface, options, concurrency);
  report.samples_asked = number_of_samples(surface, options, concurrency);
  const bool is_refined = options.thin == Thin::refine,
             has_lengths = has_wanted_lengths(options, fields) || !surface.kept_edges.empty();
  const bool follows_width = !has_lengths && !fields.densities && !surface.creases.empty() &&
                             !(options.edge_length > 0 || options.relative_edge_length > 0);
  if (has_lengths || is_refined || follows_width)
    report.input_topology =
        internal::manifold_topology(surface, concurrency); // before facets are split
  if (!has_lengths)
    report.median_edge_length =
        median_length(surface, options, concurrency) / surface.normalization.scale;
  else
    report.samples_asked =
        set_wanted_lengths(surface, options, fields, report.samples_asked, concurrency);
  if (follows_width)
    refine_narrow_patches(surface, report.samples_asked, options.gradation, concurrency);
  if (is_refined) refine_thin_parts(surface, report.samples_asked, concurrency);
  return surface;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_PREPARE_SURFACE_IMPL_H
