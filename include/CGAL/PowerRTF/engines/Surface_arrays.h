// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Owns the arrays behind a `Surface_view`; they are uploaded once.
#ifndef CGAL_POWER_RTF_ENGINES_SURFACE_ARRAYS_H
#define CGAL_POWER_RTF_ENGINES_SURFACE_ARRAYS_H

#include <CGAL/PowerRTF/engines/Engine_base.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

template <class Real, class Backend>
class Surface_arrays {
public:
  Surface_arrays(Backend& backend, const Packed_surface& in)
  {
    std::vector<Facet_corners<Real>> facets;
    std::vector<int> corners, patches;
    facets.reserve(in.facets.size());
    corners.reserve(3 * in.facets.size());
    for (const auto& f : in.facets) {
      internal::Cancellation::poll_now_and_then();
      facets.push_back({to_real<Real>(f.corners[0]), to_real<Real>(f.corners[1]),
                        to_real<Real>(f.corners[2]), to_real<Real>(f.normal)});
      corners.insert(corners.end(), f.vertices, f.vertices + 3);
      if (in.has_patches) patches.push_back(f.patch);
    }
    std::vector<Vertex_attributes<Real>> attributes;
    std::vector<Vec3<Real>> vertices;
    attributes.reserve(in.vertices.size());
    for (const auto& v : in.vertices) {
      internal::Cancellation::poll_now_and_then();
      attributes.push_back({to_real<Real>(v.normal), Real(v.density)});
      if (!in.vertex_nodes.empty()) vertices.push_back(to_real<Real>(v.point));
    }
    m_view.facets = upload(backend, m_facets, facets);
    m_view.facet_vertices = upload(backend, m_corners, corners);
    m_view.patches = upload(backend, m_patches, patches);
    m_view.facet_nodes = upload(backend, m_facet_nodes, in.facet_nodes);
    m_view.facet_tree = Packed_tree_layout(int(facets.size()));
    m_view.attributes = upload(backend, m_attributes, attributes);
    m_view.vertices = upload(backend, m_vertices, vertices);
    m_view.vertex_nodes = upload(backend, m_vertex_nodes, in.vertex_nodes);
    m_view.vertex_tree = Packed_tree_layout(int(vertices.size()));
    m_view.first_facet = upload(backend, m_first_facet, in.first_facet);
    m_view.vertex_facets = upload(backend, m_vertex_facets, in.vertex_facets);
    if (Backend::works_by_warps && !vertices.empty()) list_near_vertices(backend);
  }

  const Surface_view<Real>& view() const { return m_view; }

  /// Makes the lists of near vertices, for searches by warps: 260 bytes per vertex (`float`).
  void list_near_vertices(Backend& backend)
  {
    constexpr int capacity = Surface_view<Real>::near_vertices;
    const int n = m_view.vertex_tree.items;
    m_near_lists.allocate(backend, std::size_t(n) * capacity);
    m_near_reach.allocate(backend, n);
    int* const lists = m_near_lists.data();
    Real* const reach = m_near_reach.data();
    const Surface_view<Real> view = m_view;
    backend.for_each(n, [=] CGAL_POWER_RTF_HD(int v) {
      const Vec3<Real> p = view.vertices[v];
      int* const list = lists + std::size_t(v) * capacity;
      const int count = nearest_vertices(view, p, capacity, list);
      for (int k = count; k < capacity; ++k) list[k] = -1;
      reach[v] = count < n ? length(view.vertices[list[count - 1]] - p) : Real(1e30);
    });
    m_view.near_lists = lists;
    m_view.near_reach = reach;
  }

private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  template <class T>
  static const T* upload(Backend& backend, Buffer<T>& buffer, const std::vector<T>& items)
  {
    if (items.empty()) return nullptr;
    buffer.allocate(backend, items.size());
    backend.upload(buffer.data(), items.data(), items.size());
    return buffer.data();
  }

  Surface_view<Real> m_view;
  Buffer<Facet_corners<Real>> m_facets;
  Buffer<int> m_corners, m_patches;
  Buffer<Child_boxes> m_facet_nodes, m_vertex_nodes;
  Buffer<Vertex_attributes<Real>> m_attributes;
  Buffer<Vec3<Real>> m_vertices;
  Buffer<int> m_first_facet, m_vertex_facets, m_near_lists;
  Buffer<Real> m_near_reach;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_SURFACE_ARRAYS_H
