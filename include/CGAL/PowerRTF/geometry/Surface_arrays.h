// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an engine knows of a surface, where its backend works. Each array of the host goes up once,
// and only where it is not there yet; the others are made there.
#ifndef CGAL_POWER_RTF_GEOMETRY_SURFACE_ARRAYS_H
#define CGAL_POWER_RTF_GEOMETRY_SURFACE_ARRAYS_H

#include <CGAL/PowerRTF/geometry/Surface_descent.h>
#include <CGAL/PowerRTF/geometry/Surface_facets.h>
#include <CGAL/PowerRTF/geometry/Surface_in_tree.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/geometry/curve_order.h>
#include <CGAL/PowerRTF/geometry/placed_facets.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>
#include <optional>
#include <type_traits>

namespace CGAL::PowerRTF {

namespace internal {

template <class Real>
struct Gather_attributes {
  const Vec3d* normals;
  const double* density;
  Vertex_attributes<Real>* attributes;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    attributes[v] = {to_real<Real>(normals[v]), Real(density[v])};
  }
};

template <class Real>
struct Round_points {
  const Vec3d* points;
  Vec3<Real>* rounded;

  CGAL_POWER_RTF_HD void operator()(int v) const { rounded[v] = to_real<Real>(points[v]); }
};

/// Takes what is known of the places in a tree to the facets.
struct Scatter_places {
  const int* order;
  const int* patches; ///< by place; null: all are of one
  int *places, *facet_patches;

  CGAL_POWER_RTF_HD void operator()(int place) const
  {
    places[order[place]] = place;
    if (patches) facet_patches[order[place]] = patches[place];
  }
};

} // namespace internal

template <class Real, class Backend>
class Surface_arrays {
public:
  /// On the host, what is in `in` is used where it is: it has to live as long. Where the facets are
  /// resident, they have to stay so.
  Surface_arrays(Backend& backend, const Surface_in_tree& in)
      : m_facets(internal::facets_there(backend, in.facets, in.resident.get(), m_facet_buffers))
  {
    internal::allocate_listed(backend, *this, std::size_t(in.facets.facets),
                              std::size_t(in.facets.vertices), in.tree.patches != nullptr,
                              in.has_vertex_tree());
    m_view.facet_tree = in.tree.facet_tree;
    m_order = there(backend, m_orders, in.order);
    m_view.facet_nodes = there(backend, m_facet_nodes, in.tree.facet_nodes);
    if (in.tree.patches) m_view.patches = there(backend, m_patches, in.tree.patches);
    backend.for_each(m_facets.facets,
                     internal::Order_corners{m_facets.corners, m_order, m_corners.data()});
    m_view.facet_vertices = m_corners.data();
    if constexpr (!makes_facets) {
      m_view.facets = in.tree.facets;
    } else {
      backend.for_each(
          m_facets.facets,
          internal::Place_facets<Real>{m_facets.points, m_corners.data(), m_tree_facets.data()});
      m_view.facets = m_tree_facets.data();
    }
    set_attributes(backend, in);
    if (in.has_vertex_tree()) set_vertex_tree(backend, in);
  }

  const Surface_view<Real>& view() const { return m_view; }
  /// By number.
  const Surface_facets& facets() const { return m_facets; }
  /// Not on the host.
  const Vec3d* vertex_normals() const { return m_normals.data(); }

  /// The facets alone, in double precision; none: the memory does not suffice.
  std::optional<Surface_view<double>> view_in_double(Backend& backend)
  {
    Surface_view<double> view;
    if constexpr (std::is_same<Real, double>::value) {
      view.facets = m_view.facets;
    } else {
      if (m_double_facets.size() == 0) {
        if (!backend.has_room(m_facets.facets * sizeof(Facet_corners<double>))) return {};
        m_double_facets.allocate(backend, m_facets.facets);
        backend.for_each(m_facets.facets,
                         internal::Place_facets<double>{m_facets.points, m_corners.data(),
                                                        m_double_facets.data()});
      }
      view.facets = m_double_facets.data();
    }
    view.facet_vertices = m_view.facet_vertices;
    view.patches = m_view.patches;
    view.facet_nodes = m_view.facet_nodes;
    view.facet_tree = m_view.facet_tree;
    return view;
  }

  /// What `surface`, of the host's arrays of this one, is where the backend works; none: the memory
  /// does not suffice. Not on the host.
  std::optional<Surface_descent> descent(Backend& backend, const Surface_descent& surface)
  {
    if (!backend.has_room(internal::bytes_of_listed<By_facet>(std::size_t(m_facets.facets),
                                                              m_view.patches != nullptr)))
      return {};
    const std::optional<Surface_view<double>> tree = view_in_double(backend);
    if (!tree) return {};
    if (m_by_facet.places.size() == 0) {
      internal::allocate_listed(backend, m_by_facet, std::size_t(m_facets.facets),
                                m_view.patches != nullptr);
      backend.for_each(m_facets.facets,
                       internal::Scatter_places{m_order, m_view.patches, m_by_facet.places.data(),
                                                m_by_facet.patches.data()});
    }
    Surface_descent there = surface; // its numbers
    there.corners = m_facets.corners;
    there.opposite = m_facets.opposite;
    there.patches = m_view.patches ? m_by_facet.patches.data() : nullptr;
    there.points = m_facets.points;
    there.vertex_normals = m_normals.data();
    there.facet_normals = m_facets.facet_normals;
    there.tree = *tree;
    there.order = m_order;
    there.places = m_by_facet.places.data();
    return there;
  }

  /// See listed_arrays.h. `has_vertex_tree`: for rules that ask for the nearest vertices.
  template <class F>
  static void for_each_array(F&& f, std::size_t facets, std::size_t vertices, bool has_patches,
                             bool has_vertex_tree)
  {
    using S = Surface_arrays;
    if (makes_facets) f(&S::m_tree_facets, facets);
    f(&S::m_attributes, vertices);
    f(&S::m_corners, 3 * facets);
    if (!Backend::is_host) {
      f(&S::m_orders, facets);
      f(&S::m_normals, vertices);
      f(&S::m_facet_nodes, Packed_tree_layout(int(facets)).nodes());
      if (has_patches) f(&S::m_patches, facets);
    }
    if (!has_vertex_tree) return;
    if (makes_facets) f(&S::m_vertices, vertices);
    if (Backend::is_host) return;
    f(&S::m_vertex_nodes, Packed_tree_layout(int(vertices)).nodes());
    f(&S::m_vertex_facets, 3 * facets);
  }
  /// What it takes on a device, that of the facets included, which may be there already.
  static std::size_t bytes(std::size_t facets, std::size_t vertices, bool has_patches,
                           bool has_vertex_tree)
  {
    const std::size_t near = Backend::works_by_warps && has_vertex_tree
                                 ? internal::bytes_of_listed<Near_vertices>(vertices)
                                 : 0;
    return near + internal::bytes_of_listed<internal::Facet_buffers<Backend>>(vertices, facets) +
           internal::bytes_of_listed<Surface_arrays>(facets, vertices, has_patches,
                                                     has_vertex_tree);
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
  /// Else those of the tree serve.
  static constexpr bool makes_facets = !Backend::is_host || !std::is_same<Real, double>::value;

  /// What only descents from facet to facet need.
  struct By_facet {
    Buffer<int> places, patches;

    template <class F>
    static void for_each_array(F&& f, std::size_t facets, bool has_patches)
    {
      f(&By_facet::places, facets);
      if (has_patches) f(&By_facet::patches, facets);
    }
  };

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

  /// The host's items where the backend works.
  template <class T>
  static const T* there(Backend& backend, Buffer<T>& buffer, const T* items)
  {
    if constexpr (Backend::is_host)
      return items;
    else
      return internal::uploaded(backend, buffer, items);
  }

  void set_attributes(Backend& backend, const Surface_in_tree& in)
  {
    Buffer<double> density;
    if constexpr (!Backend::is_host) density.allocate(backend, in.facets.vertices);
    backend.for_each(in.facets.vertices,
                     internal::Gather_attributes<Real>{there(backend, m_normals, in.vertex_normals),
                                                       there(backend, density, in.vertex_density),
                                                       m_attributes.data()});
    m_view.attributes = m_attributes.data();
  }

  void set_vertex_tree(Backend& backend, const Surface_in_tree& in)
  {
    const int n = in.facets.vertices;
    m_view.vertex_tree = Packed_tree_layout(n);
    m_view.vertex_nodes = there(backend, m_vertex_nodes, in.vertex_nodes.data());
    m_view.first_facet = m_facets.first_corner;
    m_view.vertex_facets = there(backend, m_vertex_facets, in.vertex_facets.data());
    if constexpr (makes_facets) {
      backend.for_each(n, internal::Round_points<Real>{m_facets.points, m_vertices.data()});
      m_view.vertices = m_vertices.data();
    } else {
      m_view.vertices = m_facets.points;
    }
    if (Backend::works_by_warps) list_near_vertices(backend);
  }

  internal::Facet_buffers<Backend> m_facet_buffers; // of facets that are not there already
  Surface_facets m_facets;
  Surface_view<Real> m_view;
  const int* m_order = nullptr;
  Buffer<int> m_corners, m_orders, m_patches; // by place
  Buffer<Facet_corners<Real>> m_tree_facets;
  Buffer<Child_boxes> m_facet_nodes, m_vertex_nodes;
  Buffer<Vec3d> m_normals;
  Buffer<Vertex_attributes<Real>> m_attributes;
  Buffer<Vec3<Real>> m_vertices;
  Buffer<int> m_vertex_facets;
  Near_vertices m_near;
  // Made when they are asked for:
  Buffer<Facet_corners<double>> m_double_facets;
  By_facet m_by_facet;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_SURFACE_ARRAYS_H
