// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_ENGINES_ENGINE_MESH_H
#define CGAL_POWER_RTF_ENGINES_ENGINE_MESH_H

#include <CGAL/PowerRTF/engines/close_faces.h>
#include <CGAL/PowerRTF/engines/faces_at_vertices.h>
#include <CGAL/PowerRTF/engines/flip_candidates.h>
#include <CGAL/PowerRTF/engines/oriented_topology.h>
#include <CGAL/PowerRTF/engines/stars_of_mesh.h>
#include <CGAL/PowerRTF/engines/surface_distances.h>
#include <CGAL/PowerRTF/geometry/Resident_mesh.h>
#include <CGAL/PowerRTF/geometry/Surface_arrays.h>
#include <CGAL/PowerRTF/internal/listed_arrays.h>
#include <CGAL/PowerRTF/smoothing/Star_sweeps.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace CGAL::PowerRTF {

/// A mesh where the backend of an engine works.
template <class Real, class Backend>
class Engine_mesh final : public Resident_mesh {
public:
  using Surface = Surface_arrays<Real, Backend>;

  /// `mesh`: the host's. Keeps references to the others.
  Engine_mesh(Backend& backend, Surface& surface, const Mesh_arrays& mesh)
      : m_backend(backend), m_surface(surface)
  {
    internal::allocate_listed(backend, *this, mesh);
    m_mesh = {mesh.vertices, internal::uploaded(backend, m_points, mesh.points), mesh.faces,
              internal::uploaded(backend, m_corners, mesh.corners)};
  }

  /// See listed_arrays.h.
  template <class F>
  static void for_each_array(F&& f, const Mesh_arrays& mesh)
  {
    f(&Engine_mesh::m_points, std::size_t(mesh.vertices));
    f(&Engine_mesh::m_corners, 3 * std::size_t(mesh.faces));
  }

  std::optional<Topology_statistics> topology(Triangle_links* links) override
  {
    if (!is_there()) return {};
    return internal::oriented_topology(m_backend, m_mesh.vertices, m_mesh.faces, m_mesh.corners,
                                       links, &m_links);
  }
  bool find_flips(std::vector<int>& halfedges) override
  {
    return m_links.are_known() &&
           internal::find_flip_candidates(m_backend, m_mesh, m_links.opposite.data(), halfedges);
  }
  bool find_close_faces(Face_pairs& pairs) override
  {
    if (!is_there()) return false;
    if (!m_close_faces && !internal::close_faces(m_backend, m_mesh, m_close_faces.emplace()))
      m_close_faces.reset();
    if (m_close_faces) pairs = *m_close_faces;
    return m_close_faces.has_value();
  }
  bool find_distances(int samples, Two_sided_distances& result) override
  {
    if (!is_there()) return false;
    const std::optional<Surface_view<double>> surface = m_surface.view_in_double(m_backend);
    return surface && internal::surface_distances(m_backend, m_surface.facets(), *surface, m_mesh,
                                                  samples, result);
  }
  bool find_faces(double min_cosine, int n, const int* vertices, int* faces) override
  {
    return is_there() && internal::find_faces_at_vertices(m_backend, m_surface.facets().points,
                                                          m_surface.vertex_normals(), m_mesh,
                                                          min_cosine, n, vertices, faces);
  }
  bool give_stars(const Vertex_places& vertices, Star_sweeps_base& sweeps) override
  {
    auto* const here = dynamic_cast<Star_sweeps<Backend>*>(&sweeps);
    return here && m_links.are_known() &&
           internal::make_stars(m_backend, m_mesh, m_links.opposite.data(),
                                m_links.last_corner.data(), vertices, here->stars());
  }
  void release() override
  {
    m_points = {};
    m_corners = {};
    m_links = {};
    m_close_faces.reset();
    m_mesh = {};
  }

private:
  bool is_there() const { return m_mesh.points != nullptr; }

  Backend& m_backend;
  Surface& m_surface;
  typename Backend::template Buffer<Vec3d> m_points;
  typename Backend::template Buffer<int> m_corners;
  internal::Link_buffers<Backend> m_links; // once they were asked for
  std::optional<Face_pairs> m_close_faces; // once they were asked for
  Mesh_arrays m_mesh{};                    // there
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_ENGINE_MESH_H
