// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The faces of a mesh that are nearest to vertices of a surface, where a backend works.
#ifndef CGAL_POWER_RTF_SMOOTHING_FACES_AT_VERTICES_H
#define CGAL_POWER_RTF_SMOOTHING_FACES_AT_VERTICES_H

#include <CGAL/PowerRTF/geometry/Find_distances.h>
#include <CGAL/PowerRTF/geometry/Surface_descent.h>
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

/// What `find_faces_at_vertices()` takes.
template <class Backend>
std::size_t faces_at_vertices_bytes(const Mesh_arrays& mesh, int n)
{
  return bytes_of_listed<Facet_arrays<Backend>>(mesh) +
         Mesh_tree_arrays<Backend>::bytes(Packed_tree_layout(mesh.faces)) +
         bytes_of_listed<Faces_at_vertices_arrays<Backend>>(std::size_t(n));
}

/// Of n `vertices` of `surface`, which is where the backend works, writes the nearest faces of
/// `mesh` to `faces`: of those whose normals agree; -1 where none does. \pre `mesh` has a face
template <class Backend>
void find_faces_at_vertices(Backend& backend, const Surface_descent& surface,
                            const Mesh_arrays& mesh, int n, const int* vertices, int* faces)
{
  Facet_arrays<Backend> facets;
  Mesh_tree_arrays<Backend> tree;
  Faces_at_vertices_arrays<Backend> a;
  allocate_listed(backend, facets, mesh);
  allocate_listed(backend, tree, Packed_tree_layout(mesh.faces));
  allocate_listed(backend, a, std::size_t(n));
  uploaded(backend, facets.points, mesh.points);
  uploaded(backend, a.found, vertices);
  const Surface_view<double> view = placed_mesh(backend, mesh, facets, tree);
  backend.for_each_by_lanes(n, Find_face_at_vertex{view, tree.order.data(), surface.points,
                                                   surface.vertex_normals, surface.min_cosine,
                                                   a.found.data()});
  backend.download(faces, a.found.data(), std::size_t(n));
}

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_SMOOTHING_FACES_AT_VERTICES_H
