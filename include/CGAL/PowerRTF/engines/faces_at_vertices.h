// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The faces of a mesh that are nearest to vertices of a surface, where a backend works.
#ifndef CGAL_POWER_RTF_ENGINES_FACES_AT_VERTICES_H
#define CGAL_POWER_RTF_ENGINES_FACES_AT_VERTICES_H

#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface_view.h>
#include <CGAL/PowerRTF/geometry/placed_facets.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>

#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// Replaces vertices of a surface by the faces of a mesh.
struct Find_face_at_vertex {
  Surface_view<double> faces; ///< of the mesh, in the order of its tree
  const int* order;
  const Vec3d *points, *normals; ///< of the surface's vertices
  double min_cosine;
  int* found;

  template <class Lanes>
  CGAL_POWER_RTF_HD void operator()(int i, Lanes lanes) const
  {
    constexpr double all_agree = -2;
    const int v = found[i];
    int place = nearest(v, all_agree, lanes); // mostly it does
    if (!(dot(faces.facets[place].normal, normals[v]) > min_cosine))
      place = nearest(v, min_cosine, lanes);
    if (lanes.leads()) found[i] = place < 0 ? -1 : order[place];
  }

private:
  template <class Lanes>
  CGAL_POWER_RTF_HD int nearest(int v, double cosine, Lanes lanes) const
  {
    constexpr int any_face = 0; // to start with
    return project_to_nearest_facet(faces, points[v], normals[v], cosine, any_face, lanes).facet;
  }
};

template <class Backend>
struct Faces_at_vertices_arrays {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  Buffer<int> found;

  /// See listed_arrays.h. `n`: vertices.
  template <class F>
  static void for_each_array(F&& f, std::size_t n)
  {
    f(&Faces_at_vertices_arrays::found, n);
  }
};

/// As `Resident_mesh::find_faces()`, of a mesh that is where the backend works, as the `points` and
/// `normals` of the surface's vertices: `false` where the memory does not suffice.
template <class Backend>
bool find_faces_at_vertices(Backend& backend, const Vec3d* points, const Vec3d* normals,
                            const Mesh_arrays& mesh, double min_cosine, int n, const int* vertices,
                            int* faces)
{
  using Arrays = Faces_at_vertices_arrays<Backend>;
  if (!backend.has_room(Mesh_tree_arrays<Backend>::bytes(Packed_tree_layout(mesh.faces)) +
                        bytes_of_listed<Arrays>(std::size_t(n))))
    return false;
  Mesh_tree_arrays<Backend> tree;
  Arrays a;
  allocate_listed(backend, a, std::size_t(n));
  uploaded(backend, a.found, vertices);
  const Surface_view<double> view = placed_mesh(backend, mesh, tree);
  backend.for_each_by_lanes(
      n, Find_face_at_vertex{view, tree.order.data(), points, normals, min_cosine, a.found.data()});
  backend.download(faces, a.found.data(), std::size_t(n));
  return true;
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_ENGINES_FACES_AT_VERTICES_H
