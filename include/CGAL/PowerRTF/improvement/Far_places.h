// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where mesh and surface are farther apart than they should be: the mesh is looked at in many
// points of its edges and faces, the surface at its vertices, along its edges and inside its
// facets. After changes of the mesh only what is near them is looked at anew.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_FAR_PLACES_H
#define CGAL_POWER_RTF_IMPROVEMENT_FAR_PLACES_H

#include <CGAL/PowerRTF/improvement/Changed_vertices.h>
#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Sampled_distance.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/Vertex_mover.h>
#include <CGAL/PowerRTF/improvement/tracked_points.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Far_places {
public:
  using Face = Working_mesh::Face;
  using Halfedge = Star_mesh::Halfedge;

  /// What is farthest at a face.
  struct Place {
    double distance;
    Face face;
    int tracked; ///< the point of the surface, or -1: it is a point of the face
  };

  /// `distance`: that is asked for.
  Far_places(Star_mesh& mesh, double distance)
      : m(mesh), m_goal(Parameters::goal * distance),
        m_tracker(mesh,
                  points_of_facets(mesh.projector().surface(), mesh.projector().tree(),
                                   Parameters::step * distance),
                  m_goal),
        m_distance(mesh, m_goal), m_changed(mesh), m_places(mesh.working().mesh.num_faces())
  {}

  /// A little less than is asked for, as between the points it may be more.
  double goal() const { return m_goal; }
  Distance_tracker& tracker() { return m_tracker; }
  const Distance_tracker& tracker() const { return m_tracker; }
  const Sampled_distance& sampled() const { return m_distance; }

  /// After any changes. \returns the vertices that have changed.
  std::vector<int> update()
  {
    m_tracker.update();
    std::vector<int> changed = m_changed.take();
    const std::vector<Face> faces = faces_around(m, changed);
    for_each_index(m.concurrency(), int(faces.size()),
                   [&](int k) { m_face_distance[faces[k]] = distance(faces[k]); });
    for_each_index(m.concurrency(), int(m_places.size()), [&](int f) {
      m_places[f] = {m.working().mesh.is_removed(Face(f)) ? 0 : m_face_distance[f], Face(f), -1};
    });
    for (const int i : m_tracker.farther_than(m_goal)) {
      Place& place = m_places[m.working().mesh.face(m_tracker[i].face)];
      if (m_tracker[i].distance > place.distance)
        place.distance = m_tracker[i].distance, place.tracked = i;
    }
    return changed;
  }

  /// Before an update: whether nothing is far at what has changed; rarely it is not, but is said
  /// to be.
  bool are_changes_near() const
  {
    const std::vector<Face> faces = faces_around(m, m_changed.find());
    return std::all_of(faces.begin(), faces.end(), [&](Face f) { return distance(f) <= m_goal; }) &&
           m_tracker.are_within(m_goal);
  }
  /// Instead of an update, where the mesh is again as it was at the last one.
  void skip_update()
  {
    m_tracker.skip_update();
    m_changed.take();
  }

  bool is_far(Face f) const { return m_places[f].distance > m_goal; }

  /// What all places are too far, in the goal: it grows with them and with their number.
  double excess() const
  {
    double sum = 0;
    for (const Place& place : m_places) sum += excess(place.face);
    return sum;
  }
  double excess(Face f) const { return std::max(0., m_places[f].distance / m_goal - 1); }

  /// The farthest first.
  std::vector<Place> find() const
  {
    std::vector<Face> faces;
    for (const int f :
         select(m.concurrency(), int(m_places.size()), [&](int f) { return is_far(Face(f)); }))
      faces.push_back(Face(f));
    return find(faces);
  }
  /// Those of these faces.
  std::vector<Place> find(const std::vector<Face>& faces) const
  {
    std::vector<Place> far;
    for (const Face f : faces)
      if (is_far(f)) far.push_back(m_places[f]);
    std::stable_sort(far.begin(), far.end(),
                     [](const Place& p, const Place& q) { return p.distance > q.distance; });
    return far;
  }

  /// The place of a vertex that would make it nearer.
  Missing_vertex missing_at(Face f) const
  {
    const Place& place = m_places[f];
    if (place.tracked >= 0)
      return {m_tracker.point(place.tracked), m_tracker[place.tracked].nearest,
              m_tracker[place.tracked].face};
    const auto& mesh = m.working().mesh;
    const Vec3d p = m_distance.farthest_point(f);
    return {m.projector().nearest(p, m.facet(mesh.source(mesh.halfedge(f)))).point, p,
            mesh.halfedge(f)};
  }

private:
  using Parameters = Improvement_parameters::Distance_keeping;

  // Most are near: the middles of the face and its edges tell.
  double distance(Face f) const
  {
    const auto& mesh = m.working().mesh;
    double farthest = m_distance.middle(f);
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      farthest = std::max(farthest, m_distance.middle(mesh.edge(h)));
    return farthest > Parameters::near_share * m_goal ? m_distance(f) : farthest;
  }

  Star_mesh& m;
  double m_goal;
  Distance_tracker m_tracker;
  Sampled_distance m_distance;
  Changed_vertices m_changed;  // since the last update
  std::vector<Place> m_places; // by face
  std::vector<double> m_face_distance = std::vector<double>(m_places.size()); // of its own points
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_FAR_PLACES_H
