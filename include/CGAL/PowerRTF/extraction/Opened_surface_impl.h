// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Definitions for Opened_surface.h.
#ifndef CGAL_POWER_RTF_EXTRACTION_OPENED_SURFACE_IMPL_H
#define CGAL_POWER_RTF_EXTRACTION_OPENED_SURFACE_IMPL_H

#include <CGAL/PowerRTF/extraction/Opened_surface.h>
#include <CGAL/PowerRTF/geometry/cut_surface.h>
#include <CGAL/PowerRTF/geometry/degenerate_facets.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

CGAL_POWER_RTF_INLINE
Opened_surface::Opened_surface(const Surface& surface, const Samples& samples,
                               const Feature_samples& features)
    : m_samples(samples)
{
  Surface seams_only = surface;
  seams_only.creases = surface.seams;
  Cut_surface cut = cut_along_creases(seams_only);
  m_surface = std::move(cut.surface);
  m_surface.facet_patches.clear();
  m_surface.seams.clear();
  m_surface.contacts.clear();
  const std::size_t first_feature = samples.size() - features.size();

  std::vector<std::vector<int>> copies(surface.points.size());
  for (std::size_t v = 0; v < cut.originals.size(); ++v)
    copies[cut.originals[v]].push_back(static_cast<int>(v));
  for (const int v : cut.originals) m_seams.vertices.push_back(copies[v].size() > 1 ? v : -1);
  move_off_seams(first_feature);
  std::map<Edge, std::vector<Edge>> edge_copies;
  for (std::size_t f = 0; f < surface.triangles.size(); ++f)
    for (int i = 0; i < 3; ++i) {
      internal::Cancellation::poll_now_and_then();
      const int a = m_surface.triangles[f][i], b = m_surface.triangles[f][(i + 1) % 3];
      const Edge original = sorted_edge(surface.triangles[f][i], surface.triangles[f][(i + 1) % 3]);
      const Edge copy = cut.originals[a] == original[0] ? Edge{a, b} : Edge{b, a};
      std::vector<Edge>& list = edge_copies[original];
      if (std::find(list.begin(), list.end(), copy) == list.end()) list.push_back(copy);
    }
  for (const Edge& e : surface.creases) {
    if (std::binary_search(surface.seams.begin(), surface.seams.end(), e)) continue;
    for (const Edge& copy : edge_copies[e])
      m_surface.creases.push_back(sorted_edge(copy[0], copy[1]));
  }
  std::sort(m_surface.creases.begin(), m_surface.creases.end());

  std::vector<Edge_place> twins;
  m_seams.samples.assign(samples.size(), -1);
  for (std::size_t k = 0; k < features.size(); ++k) {
    const Edge_place& p = features.places[k];
    std::vector<Edge_place> places;
    if (p.from == p.to)
      for (const int v : copies[p.from]) places.push_back({v, v, 0});
    else
      for (const Edge& e : edge_copies[sorted_edge(p.from, p.to)])
        places.push_back(p.from < p.to ? Edge_place{e[0], e[1], p.at}
                                       : Edge_place{e[1], e[0], p.at});
    m_features.places.push_back(places.front());
    if (places.size() > 1)
      m_seams.samples[first_feature + k] =
          p.from == p.to ? p.from : static_cast<int>(surface.points.size() + k);
    for (std::size_t c = 1; c < places.size(); ++c) {
      twins.push_back(places[c]);
      const std::size_t s = first_feature + k;
      m_samples.points.push_back(samples.points[s]);
      m_samples.facets.push_back(samples.facets[s]);
      m_samples.normals.push_back(samples.normals[s]);
      m_samples.density.push_back(samples.density[s]);
      m_samples.weights.push_back(samples.weights[s]);
      m_seams.samples.push_back(m_seams.samples[s]);
    }
  }
  m_features.places.insert(m_features.places.end(), twins.begin(), twins.end());
  m_features.samples.points.assign(m_features.places.size(), {0, 0, 0}); // for their number
}

// The first samples, so many, into their facets where these touch a seam: a vertex that is inserted
// on the seam would be there in one sheet only.
CGAL_POWER_RTF_INLINE void Opened_surface::move_off_seams(std::size_t count)
{
  constexpr double share = 1e-5; // a third of it is more than what counts as on an edge, 1e-6
  for (std::size_t s = 0; s < count; ++s) {
    const auto [a, b, c] = m_surface.triangles[m_samples.facets[s]];
    if (m_seams.vertices[a] < 0 && m_seams.vertices[b] < 0 && m_seams.vertices[c] < 0) continue;
    const std::vector<Vec3d>& p = m_surface.points;
    const Vec3d center = (1. / 3) * (p[a] + p[b] + p[c]);
    m_samples.points[s] += share * (center - m_samples.points[s]);
  }
}

CGAL_POWER_RTF_INLINE void Opened_surface::sew_up(Extracted_mesh& mesh)
{
  std::vector<int> name(mesh.points.size());
  std::vector<Vec3d> points;
  std::unordered_map<int, int> name_of_place;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    name[v] = static_cast<int>(points.size());
    const int place = mesh.places.empty() ? -1 : mesh.places[v];
    if (place >= 0) name[v] = name_of_place.emplace(place, name[v]).first->second;
    if (name[v] == static_cast<int>(points.size())) points.push_back(mesh.points[v]);
  }
  mesh.points.swap(points);
  mesh.resident = {};
  mesh.places.clear();
  for (Triangle& t : mesh.triangles)
    for (int& v : t) v = name[v];
  for (Edge& e : mesh.feature_edges) e = sorted_edge(name[e[0]], name[e[1]]);
  // Where an edge joins two copies, it and its facets collapse.
  const auto is_point = [](const Edge& e) { return e[0] == e[1]; };
  mesh.feature_edges.erase(
      std::remove_if(mesh.feature_edges.begin(), mesh.feature_edges.end(), is_point),
      mesh.feature_edges.end());
  internal::drop_collapsed(mesh.triangles);
  sort_uniquely(mesh.feature_edges);
  mesh.sort_triangles();
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXTRACTION_OPENED_SURFACE_IMPL_H
