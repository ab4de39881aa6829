// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A part of a polygon soup that is remeshed while the rest stays.
#ifndef CGAL_POWER_RTF_INPUT_SOUP_REGION_H
#define CGAL_POWER_RTF_INPUT_SOUP_REGION_H

#include <CGAL/PowerRTF/Surface_fields.h>
#include <CGAL/PowerRTF/input/Polygon_soup.h>
#include <CGAL/PowerRTF/input/near_borders.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF::internal {

/// By point of a soup: the first of those that are one with it.
inline std::vector<int> places_of_points(const Polygon_soup& soup)
{
  if (soup.merges_vertices) return first_of_equal_points(soup.points);
  std::vector<int> places(soup.points.size());
  std::iota(places.begin(), places.end(), 0);
  return places;
}

/// Calls `f(a, b)` for the sides of polygon `k`, from corner to corner.
template <class F>
void for_each_side(const Polygon_soup& soup, std::size_t k, F&& f)
{
  for (int c = soup.first[k]; c < soup.first[k + 1]; ++c)
    f(soup.corners[c], soup.corners[c + 1 < soup.first[k + 1] ? c + 1 : soup.first[k]]);
}

/// Some polygons of a soup, and what is said about places there, as a soup of its own. The edges
/// between them and the others are to be kept.
class Soup_region {
public:
  Polygon_soup soup;
  Surface_fields fields;
  std::vector<int> points;   ///< the number in the whole of each point
  std::vector<int> polygons; ///< the same of each polygon, increasing
  std::vector<int> others;   ///< the polygons of the whole that stay, increasing

  Soup_region() = default;

  /// \param is_inside by polygon of `whole`
  /// \param all the fields of `whole`
  /// \throws Invalid_input_error `is_inside` has not an entry for each polygon, or no polygon is
  ///   inside
  Soup_region(const Polygon_soup& whole, const std::vector<char>& is_inside,
              const Surface_fields& all)
  {
    const std::size_t count = whole.first.size() - 1;
    if (is_inside.size() != count)
      throw Invalid_input_error("the region is told by " + std::to_string(is_inside.size()) +
                                " entries, but there are " + std::to_string(count) + " facets");
    for (std::size_t k = 0; k < count; ++k)
      (is_inside[k] ? polygons : others).push_back(static_cast<int>(k));
    if (polygons.empty()) throw Invalid_input_error("no facet is in the region");
    take_polygons(whole);
    take_fields(all);
    keep_edges(whole);
  }

private:
  void take_polygons(const Polygon_soup& whole)
  {
    m_names.assign(whole.points.size(), -1);
    for (const int k : polygons)
      for (int c = whole.first[k]; c < whole.first[k + 1]; ++c) m_names[whole.corners[c]] = 0;
    for (std::size_t v = 0; v < m_names.size(); ++v) {
      if (m_names[v] < 0) continue;
      m_names[v] = static_cast<int>(points.size());
      points.push_back(static_cast<int>(v));
      soup.points.push_back(whole.points[v]);
    }
    soup.merges_vertices = whole.merges_vertices;
    for (const int k : polygons) {
      for (int c = whole.first[k]; c < whole.first[k + 1]; ++c)
        soup.corners.push_back(m_names[whole.corners[c]]);
      soup.end_polygon();
    }
  }

  void take_fields(const Surface_fields& all)
  {
    const auto edges = [&](const std::vector<Edge>& from) {
      std::vector<Edge> result;
      for (const auto& [a, b] : from)
        if (m_names[a] >= 0 && m_names[b] >= 0) result.push_back({m_names[a], m_names[b]});
      return result;
    };
    const auto at = [](const auto& values, const std::vector<int>& numbers) {
      std::decay_t<decltype(values)> result;
      for (const int i : numbers) result.push_back(values[i]);
      return result;
    };
    if (all.creases) fields.creases = edges(*all.creases);
    if (all.densities) fields.densities = at(*all.densities, points);
    if (all.sizes) fields.sizes = at(*all.sizes, points);
    fields.refinements = all.refinements;
    fields.lines = edges(all.lines);
    if (!all.labels.empty()) fields.labels = at(all.labels, polygons);
    for (const int v : all.kept_vertices)
      if (m_names[v] >= 0) fields.kept_vertices.push_back(m_names[v]);
  }

  void keep_edges(const Polygon_soup& whole)
  {
    const std::vector<int> places = places_of_points(whole);
    std::vector<char> is_touched(places.size(), 0); // by the region
    for (const int v : points) is_touched[places[v]] = 1;
    std::vector<Edge> beside;
    for (const int k : others)
      for_each_side(whole, k, [&](int a, int b) {
        if (is_touched[places[a]] && is_touched[places[b]])
          beside.push_back(sorted_edge(places[a], places[b]));
      });
    sort_uniquely(beside);
    for (const int k : polygons)
      for_each_side(whole, k, [&](int a, int b) {
        if (std::binary_search(beside.begin(), beside.end(), sorted_edge(places[a], places[b])))
          fields.kept_edges.push_back(sorted_edge(m_names[a], m_names[b]));
      });
    sort_uniquely(fields.kept_edges);
  }

  std::vector<int> m_names; // by point of the whole: its number here, or -1
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INPUT_SOUP_REGION_H
