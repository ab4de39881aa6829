// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh that decimation and flips work on: a half-edge mesh whose vertices know the surface's
// normal, and a measure of how well a triangle lies on the surface.
#ifndef CGAL_POWER_RTF_EXTRACTION_WORKING_MESH_H
#define CGAL_POWER_RTF_EXTRACTION_WORKING_MESH_H

#include <CGAL/PowerRTF/extraction/Seam_places.h>
#include <CGAL/PowerRTF/extraction/connect_halfedges.h>
#include <CGAL/PowerRTF/extraction/insert_samples.h>
#include <CGAL/PowerRTF/internal/Index_set.h>
#include <CGAL/PowerRTF/internal/Unset_vector.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

struct Working_mesh {
  using Point = Exact_predicates_inexact_constructions_kernel::Point_3;
  using Mesh = CGAL::Surface_mesh<Point>;
  using Vertex = Mesh::Vertex_index;
  using Halfedge = Mesh::Halfedge_index;
  using Edge = Mesh::Edge_index;
  using Face = Mesh::Face_index;
  using Corners = std::array<Vertex, 3>;

  Mesh mesh;
  Unset_vector<Vec3d> normals; ///< by vertex: unit normal of the surface
  std::vector<int> samples;    ///< by vertex: the sample that it is; -1: none
  std::vector<int> patches;    ///< by face: the surface's flat patch; -1, or empty: of none
  /// By vertex, of an opened surface: its place (see `Seam_places`). Empty: all are alone.
  std::vector<int> places;
  /// Of a half: its border there will be sewn to that of its image.
  std::optional<Mirror_plane> mirror;

  /// \throw Invalid_input_error if the triangles are no oriented 2-manifold
  explicit Working_mesh(Refined_surface&& surface, Concurrency concurrency = Sequential_tag())
      : Working_mesh(surface.points, surface.triangles, concurrency)
  {
    normals = std::move(surface.normals);
    samples = std::move(surface.samples);
    patches = std::move(surface.patches);
    patches.resize(surface.triangles.size(), -1);
    mirror = surface.mirror;
    for (const auto& [a, b] : surface.features) join_on_feature(Vertex(a), Vertex(b));
  }

  /// The same of triangles alone. `find`: what finds their links instead, where it does. `memory`:
  /// a mesh whose memory is used, or an empty one.
  Working_mesh(const std::vector<Vec3d>& points, const std::vector<Triangle>& triangles,
               Concurrency concurrency, const Find_links& find = {}, Mesh&& memory = Mesh())
      : mesh(std::move(memory))
  {
    if (!connect_halfedges(mesh, triangles, int(points.size()), concurrency, find))
      throw Invalid_input_error("the surface is not an oriented 2-manifold");
    for_each_index(concurrency, int(points.size()), [&](int v) {
      const Vec3d& p = points[v];
      mesh.point(Vertex(v)) = Point(p.x, p.y, p.z);
    });
  }

  /// Sets `places`; \pre the mesh is the surface, with or without its samples.
  void set_places(const Seam_places& seams)
  {
    if (seams.vertices.empty()) return;
    std::vector<int> all = seams.vertices; // the samples come after them
    for (std::size_t v = all.size(); v < samples.size(); ++v)
      all.push_back(seams.samples[samples[v]]);
    set_places(std::move(all));
  }
  /// The same; `all`: by vertex.
  void set_places(std::vector<int> all)
  {
    places = std::move(all);
    m_copies.clear();
    m_copy_counts.clear();
    for (const Vertex v : mesh.vertices())
      if (is_on_seam(v) && !mesh.is_isolated(v)) {
        m_copies[places[v]].push_back(v);
        ++m_copy_counts[places[v]];
      }
  }
  /// The vertices at a place.
  const std::vector<Vertex>& copies(int place) const { return m_copies.at(place); }
  /// The vertices that will be one with `v`, and itself.
  std::vector<Vertex> copies(Vertex v) const
  {
    return is_on_seam(v) ? copies(places[v]) : std::vector<Vertex>{v};
  }
  /// Whether copies of `v` have been collapsed, but not itself.
  bool is_torn(Vertex v) const
  {
    return is_on_seam(v) && copies(places[v]).size() < m_copy_counts.at(places[v]);
  }
  /// To be called when a collapse of `u` into `v` has kept one of them.
  void replace_copy(Vertex u, Vertex v, Vertex kept)
  {
    if (places.empty()) return;
    if (is_on_seam(u)) {
      std::vector<Vertex>& at_u = m_copies.at(places[u]);
      at_u.erase(std::find(at_u.begin(), at_u.end(), u));
    }
    if (is_on_seam(v)) {
      std::vector<Vertex>& at_v = m_copies.at(places[v]);
      std::replace(at_v.begin(), at_v.end(), v, kept);
    }
    places[kept] = places[v];
  }
  bool is_on_seam(Vertex v) const { return !places.empty() && places[v] >= 0; }
  bool is_at_mirror(Vertex v) const { return mirror && mirror->has(point(v)); }

  Vec3d point(Vertex v) const
  {
    const Point& p = mesh.point(v);
    return {p.x(), p.y(), p.z()};
  }

  /// False for vertices that have been removed, too: those have no halfedge.
  bool has_edges(Vertex v) const { return !mesh.is_removed(v) && !mesh.is_isolated(v); }

  /// The corner of the face at `h` that is not on it.
  Vertex apex(Halfedge h) const { return mesh.target(mesh.next(h)); }
  /// Of the face at `h`: its source, its target, the apex.
  Corners corners(Halfedge h) const { return {mesh.source(h), mesh.target(h), apex(h)}; }
  Corners corners(Face f) const { return corners(mesh.halfedge(f)); }

  std::vector<Triangle> triangles() const
  {
    std::vector<Triangle> result;
    write(result, Sequential_tag());
    return result;
  }
  /// The same into memory that may be there.
  void write(std::vector<Triangle>& triangles, Concurrency concurrency) const
  {
    select(
        concurrency, int(mesh.num_faces()), [&](int f) { return !mesh.is_removed(Face(f)); },
        [&](int faces) { triangles.resize(faces); },
        [&](int k, int f) {
          const auto [a, b, c] = corners(Face(f));
          triangles[k] = {int(a), int(b), int(c)};
        });
  }

  /// The faces at the vertices, sorted.
  template <class Vertices>
  boost::container::small_vector<Face, 48> faces_at(const Vertices& vertices) const
  {
    boost::container::small_vector<Face, 48> faces;
    Index_set seen;
    for (const Vertex v : vertices)
      for (const Halfedge h : halfedges_around_target(v, mesh))
        if (!mesh.is_border(h) && seen.insert(int(mesh.face(h)))) faces.push_back(mesh.face(h));
    std::sort(faces.begin(), faces.end());
    return faces;
  }
  /// The faces at `v` and at its neighbors, sorted.
  boost::container::small_vector<Face, 48> faces_near(Vertex v) const
  {
    return faces_at(mesh.vertices_around_target(mesh.halfedge(v)));
  }

  /// Adds the vertices that are at most so many edges away, and sorts all.
  void add_neighbors(std::vector<Vertex>& vertices, int rings = 1) const
  {
    add_neighbors(vertices, rings, [](Vertex) { return true; });
  }
  /// The same for those that `is_wanted()`, and only through such.
  template <class IsWanted>
  void add_neighbors(std::vector<Vertex>& vertices, int rings, IsWanted&& is_wanted) const
  {
    sort_uniquely(vertices);
    Index_set seen;
    for (const Vertex v : vertices) seen.insert(int(v));
    std::size_t begin = 0;
    for (int ring = 0; ring < rings; ++ring) {
      const std::size_t end = vertices.size();
      for (; begin < end; ++begin)
        for (const Halfedge h : halfedges_around_target(vertices[begin], mesh)) {
          const Vertex v = mesh.source(h);
          if (seen.insert(int(v)) && is_wanted(v)) vertices.push_back(v);
        }
    }
    std::sort(vertices.begin(), vertices.end());
  }

  /// The neighbors of `v` along creases and borders that must stay.
  const std::vector<Vertex>& feature_neighbors(Vertex v) const
  {
    static const std::vector<Vertex> none;
    const auto found = m_features.find(v);
    return found == m_features.end() ? none : found->second;
  }
  bool is_on_feature(Vertex v) const { return m_features.count(v) > 0; }
  bool is_feature(Vertex a, Vertex b) const
  {
    const std::vector<Vertex>& near = feature_neighbors(a);
    return std::find(near.begin(), near.end(), b) != near.end();
  }
  bool is_feature(Edge e) const
  {
    return !m_features.empty() && is_feature(mesh.vertex(e, 0), mesh.vertex(e, 1));
  }

  /// Takes `u`, which has two neighbors along features, out of its curve; \pre `v` is one of them.
  void shorten_feature(Vertex u, Vertex v)
  {
    const std::vector<Vertex>& ends = feature_neighbors(u);
    const Vertex w = ends[0] == v ? ends[1] : ends[0];
    std::vector<Vertex>&at_v = m_features[v], &at_w = m_features[w];
    *std::find(at_v.begin(), at_v.end(), u) = w;
    *std::find(at_w.begin(), at_w.end(), u) = v;
    m_features.erase(u);
  }
  /// Gives the place of `from` on its curves to `to`.
  void rename_on_features(Vertex from, Vertex to)
  {
    const auto found = m_features.find(from);
    if (found == m_features.end()) return;
    for (const Vertex v : found->second) {
      std::vector<Vertex>& at_v = m_features[v];
      *std::find(at_v.begin(), at_v.end(), from) = to;
    }
    std::vector<Vertex> near = std::move(found->second);
    m_features.erase(from);
    m_features[to] = std::move(near);
  }

  /// Looks around both in turn, as one of them may have very many neighbors.
  bool are_adjacent(Vertex a, Vertex b) const
  {
    const Halfedge first_a = mesh.halfedge(a), first_b = mesh.halfedge(b);
    if (!first_a.is_valid() || !first_b.is_valid()) return false;
    Halfedge h = first_a, g = first_b;
    do {
      if (mesh.source(h) == b || mesh.source(g) == a) return true;
      h = mesh.next_around_target(h);
      g = mesh.next_around_target(g);
    } while (h != first_a && g != first_b);
    return false;
  }

  /// Whether there is an edge between other copies of both, or they are copies of one: sewn up, an
  /// edge between them would be there twice, or none. `as_seam`: other edges of seams do not count.
  /// The image of an edge whose ends are at the mirror has the same ends.
  bool are_joined_elsewhere(Vertex a, Vertex b, bool as_seam = false) const
  {
    if (is_at_mirror(a) && is_at_mirror(b)) return !as_seam;
    if (!is_on_seam(a) && !is_on_seam(b)) return false;
    if (places[a] == places[b]) return true;
    for (const Vertex c : copies(a))
      for (const Vertex d : copies(b)) {
        if ((c == a && d == b) || !are_adjacent(c, d)) continue;
        if (!as_seam || !mesh.is_border(mesh.edge(mesh.halfedge(c, d)))) return true;
      }
    return false;
  }
  /// Whether an edge between them can be added to the mesh, and to what it becomes sewn up.
  bool can_be_joined(Vertex a, Vertex b) const
  {
    return !are_adjacent(a, b) && !are_joined_elsewhere(a, b);
  }
  /// Whether a collapse of the source of `h` into its target joins what is joined elsewhere.
  bool joins_twice(Halfedge h) const
  {
    if (places.empty() && !mirror) return false;
    const Vertex v = mesh.target(h);
    for (const Halfedge g : halfedges_around_source(mesh.source(h), mesh)) {
      const Vertex w = mesh.target(g);
      if (w != v && !are_adjacent(v, w) &&
          are_joined_elsewhere(v, w, mesh.is_border(mesh.edge(g)) && mesh.is_border(mesh.edge(h))))
        return true;
    }
    return false;
  }

  /// The number of edges at `v`; `most` if there are more.
  int degree_up_to(int most, Vertex v) const
  {
    int degree = 0;
    for (const Halfedge h : halfedges_around_target(v, mesh)) {
      (void)h;
      if (++degree == most) break;
    }
    return degree;
  }

  /// True if the edge can be flipped without a change of topology.
  bool is_flippable(Edge e) const
  {
    if (mesh.is_removed(e) || mesh.is_border(e)) return false;
    const Halfedge h = mesh.halfedge(e);
    return can_be_joined(apex(h), apex(mesh.opposite(h)));
  }

  /// Twice the area times the normal.
  Vec3d area_vector(Vertex a, Vertex b, Vertex c) const
  {
    return cross(point(b) - point(a), point(c) - point(a));
  }

  /// The smallest cosine between the triangle's normal and the surface's normals at its corners;
  /// -1 for a triangle without area.
  double agreement(Vertex a, Vertex b, Vertex c) const
  {
    const Vec3d n = area_vector(a, b, c);
    const double l = length(n);
    if (!(l > 0)) return -1;
    return std::min({agreement(n, l, a), agreement(n, l, b), agreement(n, l, c)});
  }

  /// The cosine between a vector of length `l` and the normal at `v`; 1 on creases and borders,
  /// where a normal says little about the triangles.
  double agreement(const Vec3d& n, double l, Vertex v) const
  {
    return !m_features.empty() && is_on_feature(v) ? 1 : dot(n, normals[v]) / l;
  }

  /// Shape of a triangle: 1 equilateral, 0 without area (mean ratio).
  double shape(Vertex a, Vertex b, Vertex c) const
  {
    const double l = squared_length(point(b) - point(a)) + squared_length(point(c) - point(b)) +
                     squared_length(point(a) - point(c));
    return l > 0 ? 2 * std::sqrt(3.) * length(area_vector(a, b, c)) / l : 0;
  }

private:
  void join_on_feature(Vertex a, Vertex b)
  {
    m_features[a].push_back(b);
    m_features[b].push_back(a);
  }

  std::unordered_map<Vertex, std::vector<Vertex>> m_features;
  std::unordered_map<int, std::vector<Vertex>> m_copies; // by place
  std::unordered_map<int, std::size_t> m_copy_counts;    // at the beginning
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_EXTRACTION_WORKING_MESH_H
