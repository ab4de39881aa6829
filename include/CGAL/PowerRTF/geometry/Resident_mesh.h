// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A mesh where an engine works, and what can be found there.
#ifndef CGAL_POWER_RTF_GEOMETRY_RESIDENT_MESH_H
#define CGAL_POWER_RTF_GEOMETRY_RESIDENT_MESH_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/geometry/Triangle_links.h>
#include <CGAL/PowerRTF/geometry/vector.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// A mesh as plain arrays. Non-owning.
struct Mesh_arrays {
  int vertices;
  const Vec3d* points;
  int faces;
  const int* corners; ///< three per face
};

/// What is known of the distances of a surface's points from another one.
struct Sampled_distances {
  double sum = 0, sum_of_squares = 0; ///< over samples
  double max_squared = 0;             ///< of the samples and the vertices
  Vec3d farthest{0, 0, 0};            ///< the first of those, when it is not 0
};

/// From a surface to a mesh, and back.
struct Two_sided_distances {
  Sampled_distances from_surface, from_mesh;
};

/// Pairs of faces, by number.
using Face_pairs = std::vector<std::pair<int, int>>;

class Star_sweeps_base;

/// What is known of the vertices of a mesh on a surface. Non-owning.
struct Vertex_places {
  const unsigned char* kinds; ///< flags of `Star_kind`
  const Vec3d* normals;       ///< of the surface
  const int* facets;          ///< of the surface, that carry them
};

/// A mesh that has gone up to where an engine works, once for all that is asked of it; as long as
/// the engine lives. What returns `false`, or none, has found nothing, as the memory does not
/// suffice: that is left to the caller.
class Resident_mesh {
public:
  virtual ~Resident_mesh() = default;

  /// Counts what there is of the triangles, if they are an oriented 2-manifold; else none. `links`:
  /// gets those of the triangles; or null.
  virtual std::optional<Topology_statistics> topology(Triangle_links* links) = 0;

  /// Writes the halfedges (of each edge the smaller one), sorted, whose flip may lower the sum of
  /// the triangles' `shape_energy()`: all but those where it is clear that it does not. \pre
  /// `topology()` has found the links
  virtual bool find_flips(std::vector<int>& halfedges) = 0;

  /// Writes the pairs of faces that may intersect: all but those where it is clear that they do
  /// not; and, as a pair with itself, each face that may have no area. They come in any order, each
  /// once. `false`, too, where they are more than the faces. \pre the points are finite
  virtual bool find_close_faces(Face_pairs& pairs) = 0;

  /// Finds the distances between the engine's surface and the mesh, both with a face, from so many
  /// samples each way.
  virtual bool find_distances(int samples, Two_sided_distances& result) = 0;

  /// Of `n` vertices of the engine's surface, writes the faces that are nearest, of those whose
  /// normals have at least `min_cosine` with the surface's there; -1 where none does. \pre there is
  /// a face
  virtual bool find_faces(double min_cosine, int n, const int* vertices, int* faces) = 0;

  /// Gives its stars to `sweeps` of the same engine, instead of `Star_sweeps_base::take()`. \pre
  /// `topology()` has found the links
  virtual bool give_stars(const Vertex_places& vertices, Star_sweeps_base& sweeps) = 0;

  /// Frees the memory: from now on nothing is found.
  virtual void release() = 0;
};

/// Takes a mesh to where an engine works; the one before is there no more. Null, if the memory does
/// not suffice.
using Bring_mesh = std::function<std::shared_ptr<Resident_mesh>(const Mesh_arrays& mesh)>;

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_GEOMETRY_RESIDENT_MESH_H
