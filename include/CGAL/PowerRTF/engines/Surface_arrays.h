// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Owns the arrays behind a `Surface_view`; they are uploaded once.
#ifndef CGAL_POWER_RTF_ENGINES_SURFACE_ARRAYS_H
#define CGAL_POWER_RTF_ENGINES_SURFACE_ARRAYS_H

#include <CGAL/PowerRTF/engines/Engine_base.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <cstddef>
#include <type_traits>

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

  /// See listed_arrays.h. `has_vertex_tree`: for rules that ask for the nearest vertices.
  template <class F>
  static void for_each_array(F&& f, std::size_t facets, std::size_t vertices, bool has_patches,
                             bool has_vertex_tree)
  {
    using S = Surface_arrays;
    f(&S::m_facets, facets);
    f(&S::m_attributes, vertices);
    f(&S::m_corners, 3 * facets);
    f(&S::m_facet_nodes, Packed_tree_layout(int(facets)).nodes());
    if (has_patches) f(&S::m_patches, facets);
    if (!has_vertex_tree) return;
    f(&S::m_vertices, vertices);
    f(&S::m_vertex_nodes, Packed_tree_layout(int(vertices)).nodes());
    f(&S::m_first_facet, vertices + 1);
    f(&S::m_vertex_facets, 3 * facets);
  }
  /// What it takes on a device.
  static std::size_t bytes(const Run_sizes& sizes, const Remeshing_options& options)
  {
    const bool has_vertex_tree = asks_for_vertices(options);
    const std::size_t near = Backend::works_by_warps && has_vertex_tree
                                 ? internal::bytes_of_listed<Near_vertices>(sizes.vertices)
                                 : 0;
    return near + internal::bytes_of_listed<Surface_arrays>(sizes.facets, sizes.vertices,
                                                            sizes.has_patches, has_vertex_tree);
  }

  /// Makes the lists of near vertices, for searches by warps: 260 bytes per vertex (`float`).
  void list_near_vertices(Backend& backend)
  {
    constexpr int capacity = Surface_view<Real>::near_vertices;
    const int n = m_view.vertex_tree.items;
    internal::allocate_listed(backend, m_near, n);
    int* const lists = m_near.lists.data();
    Real* const reach = m_near.reach.data();
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

  struct Near_vertices {
    Buffer<int> lists;
    Buffer<Real> reach;

    template <class F>
    static void for_each_array(F&& f, std::size_t vertices)
    {
      f(&Near_vertices::lists, vertices * Surface_view<Real>::near_vertices);
      f(&Near_vertices::reach, vertices);
    }
  };

  void upload(Backend& backend, const Packed_surface& in)
  {
    const Surface_view<double> view = in.view();
    const bool has_tree = !in.vertices.empty();
    internal::allocate_listed(backend, *this, std::size_t(view.facet_tree.items),
                              in.attributes.size(), view.patches != nullptr, has_tree);
    m_view.facet_tree = view.facet_tree;
    m_view.vertex_tree = view.vertex_tree;
    m_view.facets = upload_each(backend, m_facets, [&](std::size_t k) {
      const Facet_corners<double>& f = view.facets[k];
      return Facet_corners<Real>{to_real<Real>(f.a), to_real<Real>(f.b), to_real<Real>(f.c),
                                 to_real<Real>(f.normal)};
    });
    m_view.attributes = upload_each(backend, m_attributes, [&](std::size_t v) {
      const Vertex_attributes<double>& a = view.attributes[v];
      return Vertex_attributes<Real>{to_real<Real>(a.normal), Real(a.density)};
    });
    m_view.facet_vertices = internal::uploaded(backend, m_corners, view.facet_vertices);
    m_view.facet_nodes = internal::uploaded(backend, m_facet_nodes, view.facet_nodes);
    if (view.patches) m_view.patches = internal::uploaded(backend, m_patches, view.patches);
    if (!has_tree) return;
    m_view.vertices = upload_each(backend, m_vertices,
                                  [&](std::size_t v) { return to_real<Real>(view.vertices[v]); });
    m_view.vertex_nodes = internal::uploaded(backend, m_vertex_nodes, view.vertex_nodes);
    m_view.first_facet = internal::uploaded(backend, m_first_facet, view.first_facet);
    m_view.vertex_facets = internal::uploaded(backend, m_vertex_facets, view.vertex_facets);
  }

  /// The items `item(i)`.
  template <class T, class Item>
  static const T* upload_each(Backend& backend, Buffer<T>& buffer, const Item& item)
  {
    internal::Unset_vector<T> items(buffer.size());
    internal::for_each_index(Backend::concurrency(), static_cast<int>(items.size()),
                             [&](int i) { items[i] = item(i); });
    return internal::uploaded(backend, buffer, items.data());
  }

  Surface_view<Real> m_view;
  Buffer<Facet_corners<Real>> m_facets;
  Buffer<int> m_corners, m_patches;
  Buffer<Child_boxes> m_facet_nodes, m_vertex_nodes;
  Buffer<Vertex_attributes<Real>> m_attributes;
  Buffer<Vec3<Real>> m_vertices;
  Buffer<int> m_first_facet, m_vertex_facets;
  Near_vertices m_near;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_SURFACE_ARRAYS_H
