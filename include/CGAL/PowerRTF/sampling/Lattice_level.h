// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SAMPLING_LATTICE_LEVEL_H
#define CGAL_POWER_RTF_SAMPLING_LATTICE_LEVEL_H

#include <CGAL/PowerRTF/geometry/Point_tree.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/sampling/Lattice_plan.h>
#include <CGAL/PowerRTF/sampling/lattice_nodes.h>

#include <cstddef>
#include <utility>

namespace CGAL::PowerRTF {

/// The nodes of one level of the hierarchy, and the fields on them.
template <class Backend>
class Lattice_level {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

public:
  int size = 0, free = 0;
  Buffer<Vec3f> points, normals;
  Buffer<int> components;
  Buffer<float> spacing;
  float scale = 1; ///< of the spacing
  float reach = 0; ///< see `Find_lattice_neighbors`
  const Lattice_sites* sites = nullptr;
  Buffer<unsigned char> is_directed; ///< of the sites
  Buffer<Vec3f> turning;
  Buffer<float> axes;
  Buffer<Lattice_edge> edges;
  Buffer<Stored_waves> waves;

  /// Keeps a reference to the sites.
  Lattice_level(std::size_t free_nodes, const Lattice_sites& its_sites, float neighbor_reach)
      : size(static_cast<int>(free_nodes + its_sites.size())), free(static_cast<int>(free_nodes)),
        reach(neighbor_reach), sites(&its_sites)
  {}

  /// Makes the nodes, if they are not there. `make(*this)` makes the free ones.
  template <class Make>
  void make_nodes(Backend& backend, const Make& make)
  {
    if (points.size() > 0) return;
    for_each_of_node([&](auto array, auto) { (this->*array).allocate(backend, size); });
    make(*this);
    if (sites->size() == 0) return;
    is_directed.allocate(backend, sites->size());
    internal::uploaded(backend, is_directed, sites->is_directed.data());
    for_each_of_node([&](auto to, auto from) {
      backend.upload((this->*to).data() + free, (sites->*from).data(), sites->size());
    });
  }

  Lattice_view view()
  {
    Lattice_view v;
    v.size = size;
    v.free = free;
    v.points = points.data();
    v.normals = normals.data();
    v.components = components.data();
    v.node_spacing = spacing.data();
    v.scale = scale;
    v.edges = edges.data();
    v.turning = turning.size() > 0 ? turning.data() : nullptr;
    v.axes = axes.data();
    v.waves = waves.data();
    return v;
  }

  // What n free nodes take on a device: from the beginning; from their neighbors on; once they are
  // solved.
  static std::size_t node_bytes(std::size_t n)
  {
    std::size_t bytes = 0;
    for_each_of_node([&](auto array, auto) { bytes += n * internal::item_size(array); });
    return bytes;
  }
  static std::size_t edges_bytes(std::size_t n)
  {
    return n * Lattice_view::degree * sizeof(Lattice_edge);
  }
  static std::size_t solved_bytes(std::size_t n, bool is_turning)
  {
    return n * ((is_turning ? sizeof(Vec3f) : 0) + sizeof(float) + sizeof(Stored_waves));
  }

  void find_turning(Backend& backend)
  {
    constexpr int sweeps = 3;
    turning.allocate(backend, size);
    backend.for_each(size, Set_turning{view()});
    Buffer<Vec3f> next_turning;
    next_turning.allocate(backend, size);
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      backend.for_each(size, Smooth_turning{view(), next_turning.data()});
      std::swap(turning, next_turning);
    }
  }

  /// If they are not known.
  void find_neighbors(Backend& backend)
  {
    constexpr float cos_angle = 0.2f; // nodes on the other side of a sheet are none
    if (edges.size() > 0) return;
    const Point_tree tree(backend, points.data(), size);
    edges.allocate(backend, static_cast<std::size_t>(size) * Lattice_view::degree);
    const Find_lattice_neighbors find{view(), tree.view(), cos_angle, reach};
    if constexpr (Backend::is_host)
      backend.for_each(tree.view().leaves(), Find_neighbors_of_leaf{find});
    else
      backend.for_each(size, Find_neighbors_of_node{find});
  }

  /// Frees the fields.
  void release()
  {
    turning = {};
    axes = {};
    waves = {};
  }
  /// Frees the nodes and the fields, which finer levels need no longer.
  void release_nodes()
  {
    release();
    for_each_of_node([&](auto array, auto) { this->*array = {}; });
  }

private:
  /// Calls `f(array, sites' array)` for what a node has from the beginning.
  template <class F>
  static void for_each_of_node(F&& f)
  {
    f(&Lattice_level::points, &Lattice_sites::points);
    f(&Lattice_level::normals, &Lattice_sites::normals);
    f(&Lattice_level::components, &Lattice_sites::components);
    f(&Lattice_level::spacing, &Lattice_sites::spacing);
  }
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SAMPLING_LATTICE_LEVEL_H
