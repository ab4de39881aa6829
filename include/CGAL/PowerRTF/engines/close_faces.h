// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pairs of a mesh's faces that may intersect, found where a backend works: a packed tree of the
// faces along a Hilbert curve, then proofs in floating point that most pairs are apart.
#ifndef CGAL_POWER_RTF_ENGINES_CLOSE_FACES_H
#define CGAL_POWER_RTF_ENGINES_CLOSE_FACES_H

#include <CGAL/PowerRTF/geometry/Parting_plane.h>
#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/curve_order.h>
#include <CGAL/PowerRTF/geometry/nearest_facet.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace CGAL::PowerRTF::internal {

/// Takes all points into the unit box. It never changes the order of numbers, so boxes that overlap
/// still do.
struct Into_unit_box {
  Vec3d middle;
  double scale;

  CGAL_POWER_RTF_HD Vec3d operator()(const Vec3d& p) const { return scale * (p - middle); }
  CGAL_POWER_RTF_HD Box3<double> operator()(const Numbered_face& f) const
  {
    Box3<double> box{f.points[0], f.points[0]};
    box.add(f.points[1]);
    box.add(f.points[2]);
    return {(*this)(box.lo), (*this)(box.hi)};
  }
};

/// The one for points in a box.
inline Into_unit_box into_unit_box(const Box3<double>& box)
{
  const Vec3d half = 0.5 * box.hi - 0.5 * box.lo;
  const double reach = std::max({half.x, half.y, half.z});
  return {0.5 * box.lo + 0.5 * box.hi, reach > 0 ? 1 / reach : 1};
}

struct Gather_faces {
  const Vec3d* points;
  const int* corners;
  const int* order;
  Numbered_face* faces;

  CGAL_POWER_RTF_HD void operator()(int k) const
  {
    const int* const v = corners + 3 * std::size_t(order[k]);
    Numbered_face f;
    for (int i = 0; i < 3; ++i) {
      f.points[i] = points[v[i]];
      f.vertices[i] = v[i];
    }
    f.face = order[k];
    faces[k] = f;
  }
};

struct Box_of_face {
  const Numbered_face* faces;
  Into_unit_box into;
  CGAL_POWER_RTF_HD Box3<double> operator()(int k) const { return into(faces[k]); }
};

/// Of a face, the pairs with those that come after it.
struct Close_faces_rule {
  Packed_tree_layout tree;
  const Child_boxes* nodes;
  Box_of_face box_of;
  int capacity;
  int* count; ///< of all pairs, perhaps more than there is room for
  int* pairs;

  CGAL_POWER_RTF_HD void operator()(int k) const
  {
    const Numbered_face& f = box_of.faces[k];
    if (!clearly_has_area(f)) add(f, f);
    constexpr int most = 32;
    int near[most]; // a GPU's threads come by them at different times, and judge them together
    int count = 0;
    const auto judge = [&] {
      for (int i = 0; i < count; ++i)
        if (!are_clearly_apart(f, box_of.faces[near[i]])) add(f, box_of.faces[near[i]]);
      count = 0;
    };
    visit_near(
        tree, nodes, Box_query(box_of(k)), [] { return 0.f; },
        [&](int l) {
          if (l <= k) return;
          near[count++] = l;
          if (count == most) judge();
        });
    judge();
  }

private:
  CGAL_POWER_RTF_HD void add(const Numbered_face& f, const Numbered_face& g) const
  {
    const int place = atomic_add(count, 1);
    if (place >= capacity) return;
    pairs[2 * place] = f.face;
    pairs[2 * place + 1] = g.face;
  }
};

template <class Backend>
struct Close_faces_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> order, count, pairs;
  Buffer<Numbered_face> faces;
  Buffer<Box3<double>> boxes; // the root's is that of all points, first of all
  Buffer<Child_boxes> nodes;

  /// See listed_arrays.h. `n`: faces.
  template <class F>
  static void for_each_array(F&& f, std::size_t n, std::size_t pairs)
  {
    using A = Close_faces_arrays;
    const std::size_t nodes = Packed_tree_layout(static_cast<int>(n)).nodes();
    f(&A::order, n);
    f(&A::count, std::size_t(1));
    f(&A::pairs, 2 * pairs);
    f(&A::faces, n);
    f(&A::boxes, nodes);
    f(&A::nodes, nodes);
  }
};

/// As `Resident_mesh::find_close_faces()`, of a mesh that is where the backend works: `false` where
/// the memory does not suffice, or there is more than one pair for each face.
template <class Backend>
bool close_faces(Backend& backend, const Mesh_arrays& mesh, Face_pairs& pairs)
{
  using Arrays = Close_faces_arrays<Backend>;
  pairs.clear();
  const int n = mesh.faces;
  if (n == 0) return true;
  const std::size_t capacity = n, bytes = bytes_of_listed<Arrays>(n, capacity);
  if (!backend.has_room(bytes + order_bytes<Backend>(n))) return false;
  Arrays a;
  allocate_listed(backend, a, n, capacity);
  order_along_curve(backend, n, Face_centers{mesh.points, mesh.corners}, a.order.data());
  backend.for_each(n, Gather_faces{mesh.points, mesh.corners, a.order.data(), a.faces.data()});
  const Packed_tree_layout tree(n);
  backend.template reduce<0, 6>(mesh.vertices,
                                Raise_box<Points_themselves>{Points_themselves{mesh.points}},
                                Keep_box{a.boxes.data()});
  Box3<double> box;
  backend.download(&box, a.boxes.data(), 1);
  const Into_unit_box into = into_unit_box(box);
  const Box_of_face box_of{a.faces.data(), into};
  fit_tree(backend, tree, box_of, a.boxes.data(), a.nodes.data());
  backend.fill(a.count.data(), 0, 1);
  backend.for_each(n, Close_faces_rule{tree, a.nodes.data(), box_of, static_cast<int>(capacity),
                                       a.count.data(), a.pairs.data()});
  int count = 0;
  backend.download(&count, a.count.data(), 1);
  if (count > static_cast<int>(capacity)) return false;
  Unset_vector<int> found(2 * std::size_t(count));
  if (count > 0) backend.download(found.data(), a.pairs.data(), found.size());
  pairs.reserve(count);
  for (int k = 0; k < count; ++k) pairs.emplace_back(found[2 * k], found[2 * k + 1]);
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_CLOSE_FACES_H
