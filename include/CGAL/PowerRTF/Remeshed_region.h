// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A region of a mesh that is remeshed: what of the mesh is replaced, and what is remeshed for that.
// The two differ where the region's border changes, and the faces beside it with it.
#ifndef CGAL_POWER_RTF_REMESHED_REGION_H
#define CGAL_POWER_RTF_REMESHED_REGION_H

#include <CGAL/PowerRTF/change_border.h>
#include <CGAL/PowerRTF/extraction/Extracted_mesh.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/input/Soup_region.h>
#include <CGAL/PowerRTF/transfer/Source_triangles.h>
#include <CGAL/PowerRTF/transfer/find_sources.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Remeshed_region {
public:
  /// \param is_inside by polygon of `whole`: whether it is in the region
  /// \param fields what is said about places of `whole`
  /// \throws Invalid_input_error as `Soup_region` and `change_border()`
  Remeshed_region(const Polygon_soup& whole, const std::vector<char>& is_inside,
                  const Surface_fields& fields, const Remeshing_options& options,
                  Concurrency concurrency)
      : m_replaced(whole, is_inside, fields)
  {
    if (options.region_border == Region_border::keep || m_replaced.fields.kept_edges.empty())
      return;
    m_changed = change_border(whole, fields, m_replaced, options, concurrency);
    const std::size_t count = m_changed->polygons.size();
    std::vector<char> is_remeshed(count), is_replaced(is_inside.size(), 1);
    for (std::size_t k = 0; k < count; ++k) {
      const int old = m_changed->polygons[k];
      is_remeshed[k] = is_inside[old];
      if (is_inside[old]) continue;
      if (m_changed->is_new[k])
        m_beside.push_back(static_cast<int>(k));
      else
        is_replaced[old] = 0;
    }
    m_remeshed.emplace(m_changed->soup, is_remeshed, m_changed->fields);
    m_own = std::exchange(m_replaced, Soup_region(whole, is_replaced, fields));
  }

  /// The polygons that give way to the result.
  const Soup_region& replaced() const { return m_replaced; }
  /// Those of them that are in the region: what its new faces come from.
  const Soup_region& own() const { return m_own ? *m_own : m_replaced; }
  /// What is remeshed, and what is said about places there.
  Polygon_soup& soup() { return m_remeshed ? m_remeshed->soup : m_replaced.soup; }
  const Polygon_soup& soup() const { return m_remeshed ? m_remeshed->soup : m_replaced.soup; }
  const Surface_fields& fields() const
  {
    return m_remeshed ? m_remeshed->fields : m_replaced.fields;
  }
  /// The triangles beside the border that change with it.
  std::size_t changed_faces() const { return m_beside.size(); }

  /// Makes of what has become of the region what replaces `replaced()`: adds the triangles that
  /// change with the border. \param mesh in the unit box of `normalization`
  void complete(Extracted_mesh& mesh, const Normalization& normalization) const
  {
    if (!m_remeshed) return;
    const std::vector<int>& places = m_changed->places;
    std::map<int, int> replaced_at; // by place
    for (std::size_t v = 0; v < m_replaced.points.size(); ++v)
      replaced_at.insert({places[m_replaced.points[v]], static_cast<int>(v)});
    const auto name = [&](int v) { // among the points that are replaced; -1: it is a new one
      return v < static_cast<int>(places.size()) ? replaced_at.at(places[v]) : -1;
    };
    const auto place = [&](int v) { return v < static_cast<int>(places.size()) ? places[v] : v; };
    std::map<int, int> vertex_at; // by place
    mesh.input_points.resize(mesh.points.size());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      int& number = mesh.input_points[v].number;
      if (number < 0) continue;
      const int old = m_remeshed->points[number];
      vertex_at.insert({place(old), static_cast<int>(v)});
      number = name(old);
    }
    const Polygon_soup& soup = m_changed->soup;
    for (const int k : m_beside) {
      Triangle t{};
      for (int i = 0; i < 3; ++i) {
        const int old = soup.corners[soup.first[k] + i];
        const auto [at, is_new] =
            vertex_at.insert({place(old), static_cast<int>(mesh.points.size())});
        if (is_new) {
          mesh.points.push_back(normalization.to_inside(soup.points[old]));
          mesh.input_points.push_back({name(old), soup.points[old]});
        }
        t[i] = at->second;
      }
      mesh.triangles.push_back(t);
    }
  }

  /// Makes of the sources in `own()` of the mesh as it was before `complete()` those of it in
  /// `replaced()`.
  void complete_sources(const Extracted_mesh& mesh, const Normalization& normalization,
                        Sources& sources) const
  {
    if (!m_own) return;
    const bool has_corners = !sources.corners.empty(), has_shares = !sources.shares.empty();
    for (std::vector<Source>* of : {&sources.vertices, &sources.faces})
      for (Source& s : *of) renumber(s);
    for (auto& polygons : sources.shares)
      for (int& k : polygons) k = place_in(m_replaced.polygons, m_own->polygons[k]);
    for (auto& corners : sources.corners)
      for (Source& s : corners) renumber(s);
    sources.vertices.resize(mesh.points.size());
    const Source_triangles all(m_replaced.soup, normalization);
    std::map<int, std::vector<int>> triangles; // by polygon
    for (std::size_t t = 0; t < all.polygons.size(); ++t)
      triangles[all.polygons[t]].push_back(static_cast<int>(t));
    for (const int k : m_beside) {
      const std::vector<int>& own =
          triangles[place_in(m_replaced.polygons, m_changed->polygons[k])];
      std::array<Vec3d, 3> p;
      std::array<Source, 3> corners;
      const Triangle& t = mesh.triangles[sources.faces.size()];
      for (int i = 0; i < 3; ++i) {
        p[i] = mesh.points[t[i]];
        corners[i] = nearest(all, own, p[i]);
        if (sources.vertices[t[i]].face < 0) sources.vertices[t[i]] = corners[i];
      }
      sources.faces.push_back(nearest(all, own, (p[0] + p[1] + p[2]) * (1. / 3)));
      if (has_shares) sources.shares.emplace_back().fill(sources.faces.back().face);
      if (has_corners) sources.corners.push_back(corners);
    }
  }

private:
  static int place_in(const std::vector<int>& sorted, int item)
  {
    return static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), item) - sorted.begin());
  }

  /// From the numbers of `own()` to those of `replaced()`.
  void renumber(Source& s) const
  {
    s.face = place_in(m_replaced.polygons, m_own->polygons[s.face]);
    for (int& v : s.vertices) v = place_in(m_replaced.points, m_own->points[v]);
  }

  /// The place on some triangles that is nearest to `p`.
  static Source nearest(const Source_triangles& all, const std::vector<int>& triangles,
                        const Vec3d& p)
  {
    double least = std::numeric_limits<double>::infinity();
    Source result;
    for (const int t : triangles) {
      const auto& [a, b, c] = all.triangles[t];
      const Vec3d q = nearest_point_on_triangle(p, all.points[a], all.points[b], all.points[c]);
      if (squared_length(q - p) >= least) continue;
      least = squared_length(q - p);
      result = all.source(t, q);
    }
    return result;
  }

  Soup_region m_replaced;
  std::optional<Soup_region> m_own, m_remeshed; ///< none: it is what is replaced
  std::optional<Changed_soup> m_changed;
  std::vector<int> m_beside; ///< polygons of `m_changed` outside of the region that are new
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_REMESHED_REGION_H
