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
#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF {

template <class Real, class Backend>
class Surface_arrays {
public:
  /// On the host in double precision, what is in `in` is used where it is: it has to live as long.
  Surface_arrays(Backend& backend, const Packed_surface& in)
  {
    if constexpr (Backend::is_host && std::is_same<Real, double>::value)
      m_view = in.view();
    else
      upload(backend, in);
    if (Backend::works_by_warps && !in.vertices.empty()) list_near_vertices(backend);
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

  void upload(Backend& backend, const Packed_surface& in)
  {
    const Surface_view<double> view = in.view();
    const std::size_t facets = view.facet_tree.items, vertices = in.attributes.size();
    m_view.facet_tree = view.facet_tree;
    m_view.vertex_tree = view.vertex_tree;
    m_view.facets = upload(backend, m_facets, facets, [&](std::size_t k) {
      const Facet_corners<double>& f = view.facets[k];
      return Facet_corners<Real>{to_real<Real>(f.a), to_real<Real>(f.b), to_real<Real>(f.c),
                                 to_real<Real>(f.normal)};
    });
    m_view.attributes = upload(backend, m_attributes, vertices, [&](std::size_t v) {
      const Vertex_attributes<double>& a = view.attributes[v];
      return Vertex_attributes<Real>{to_real<Real>(a.normal), Real(a.density)};
    });
    m_view.vertices = upload(backend, m_vertices, in.vertices.size(),
                             [&](std::size_t v) { return to_real<Real>(view.vertices[v]); });
    m_view.facet_vertices = upload(backend, m_corners, view.facet_vertices, 3 * facets);
    m_view.patches = upload(backend, m_patches, view.patches, view.patches ? facets : 0);
    m_view.facet_nodes = upload(backend, m_facet_nodes, view.facet_nodes, view.facet_tree.nodes());
    m_view.vertex_nodes =
        upload(backend, m_vertex_nodes, view.vertex_nodes, in.vertex_nodes.size());
    m_view.first_facet = upload(backend, m_first_facet, view.first_facet, in.first_facet.size());
    m_view.vertex_facets =
        upload(backend, m_vertex_facets, view.vertex_facets, in.vertex_facets.size());
  }

  template <class T>
  static const T* upload(Backend& backend, Buffer<T>& buffer, const T* items, std::size_t n)
  {
    if (n == 0) return nullptr;
    buffer.allocate(backend, n);
    backend.upload(buffer.data(), items, n);
    return buffer.data();
  }
  /// The items `item(i)`, i in [0, n).
  template <class T, class Item>
  static const T* upload(Backend& backend, Buffer<T>& buffer, std::size_t n, const Item& item)
  {
    std::vector<T> items;
    items.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      internal::Cancellation::poll_now_and_then();
      items.push_back(item(i));
    }
    return upload(backend, buffer, items.data(), n);
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
