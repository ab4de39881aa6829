// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Brings the mesh within a distance of the surface that is asked for, both ways, where few places
// are farther away: a single one would else ask for more samples everywhere. Vertices are put into
// such places, from the flattest parts that there are; edges there are flipped; and the vertices
// around them move, also to where the surface is too far, as long as triangles do not become bad.
// The mesh is looked at in many points of its edges and faces, the surface at its vertices and
// along its edges.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_KEEP_DISTANCE_H
#define CGAL_POWER_RTF_IMPROVEMENT_KEEP_DISTANCE_H

#include <CGAL/PowerRTF/improvement/Distance_tracker.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Sampled_distance.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/improvement/lower_distances.h>
#include <CGAL/PowerRTF/improvement/relocate_vertices.h>
#include <CGAL/PowerRTF/improvement/tracked_points.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/parallel.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Distance_keeper {
public:
  /// `distance`: that is asked for. `flat`: of the surface.
  Distance_keeper(Star_mesh& mesh, const Flat_patches& flat, double distance)
      : m(mesh), m_goal(Parameters::goal * distance),
        m_tracker(mesh,
                  points_of_edges(mesh.projector().surface(), mesh.projector().tree(),
                                  Parameters::step * distance),
                  m_goal),
        m_distance(mesh, m_goal),
        m_lowerer(mesh, m_tracker, flat,
                  {m_goal, Parameters::max_badness, Parameters::min_agreement,
                   Parameters::unroundness_weight})
  {
    m_lowerer.set_goal(m_goal);
  }

  /// Puts vertices into far places, several at a time or, where that helps no more, into the
  /// farthest.
  static void relocate(Vertex_relocator& relocator, double distance)
  {
    for (int run = 0; run < Parameters::relocations; ++run) {
      const double farthest = relocator.farthest();
      if (farthest <= distance) break;
      const double share = std::max(Parameters::far_share, distance / farthest);
      if (!relocator.run(share, Parameters::relocation_badness) &&
          !relocator.run(1, Parameters::relocation_badness))
        break;
    }
  }

  /// Lowers what is farther away. Where few places stay too far, vertices are put there, one by
  /// one, and all is lowered again.
  void run(Vertex_relocator& relocator)
  {
    lower();
    std::vector<Place> far = find_far();
    for (int left = Parameters::relocations;
         !far.empty() && int(far.size()) <= Parameters::places_per_relocation * left; --left) {
      Star_mesh::Checkpoint before(m);
      if (!relocator.run_once(Parameters::relocation_badness)) break;
      m_tracker.update();
      lower();
      const double then = far.front().distance;
      far = find_far();
      if (far.empty() || far.front().distance < Parameters::less * then) continue;
      before.restore();
      break;
    }
  }

private:
  using Edge = Star_mesh::Edge;
  using Halfedge = Star_mesh::Halfedge;
  using Face = Working_mesh::Face;
  using Parameters = Improvement_parameters::Distance_keeping;

  // Where mesh and surface are far apart.
  struct Place {
    double distance;
    int index; // of a face, or of a tracked point after the faces
  };

  // As long as the places clearly become fewer.
  void lower()
  {
    double most = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < Parameters::passes; ++pass) {
      const std::vector<Place> far = find_far();
      if (is_hopeless(far) || double(far.size()) > most) break;
      most = Parameters::fewer * double(far.size());
      bool has_changed = false;
      for (const Place& place : far) {
        Cancellation::poll();
        has_changed |= lower(place);
      }
      if (!has_changed) break;
      m_tracker.update();
    }
  }

  // Whether the places are too many or too far to be helped.
  bool is_hopeless(const std::vector<Place>& far) const
  {
    const std::size_t most = Parameters::max_places + m.size() / Parameters::vertices_per_place;
    return !far.empty() &&
           (far.size() > most || far.front().distance > Parameters::hopeless * m_goal);
  }

  // The farthest first.
  std::vector<Place> find_far() const
  {
    const int faces = int(m.working().mesh.num_faces());
    Unset_vector<double> distances(faces + m_tracker.size());
    for_each_index(m.concurrency(), int(distances.size()), [&](int i) {
      distances[i] = i < faces ? distance(Face(i)) : m_tracker[i - faces].distance;
    });
    std::vector<Place> far;
    for (const int i : select(m.concurrency(), int(distances.size()),
                              [&](int i) { return distances[i] > m_goal; }))
      far.push_back({distances[i], i});
    std::stable_sort(far.begin(), far.end(),
                     [](const Place& p, const Place& q) { return p.distance > q.distance; });
    std::vector<char> has_place(faces, false); // one for each face
    const auto comes_later = [&](const Place& p) {
      return std::exchange(has_place[p.index < faces ? p.index : face_of(p.index - faces)], true);
    };
    far.erase(std::remove_if(far.begin(), far.end(), comes_later), far.end());
    return far;
  }

  // The nearest one.
  int face_of(int tracked) const { return int(m.working().mesh.face(m_tracker[tracked].face)); }

  // Most are near: the middles of the face and its edges tell.
  double distance(Face f) const
  {
    const auto& mesh = m.working().mesh;
    double farthest = m_distance.middle(f);
    if (mesh.is_removed(f)) return 0;
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      farthest = std::max(farthest, m_distance.middle(mesh.edge(h)));
    return farthest > Parameters::near_share * m_goal ? m_distance(f) : farthest;
  }

  // \returns whether the mesh has changed.
  bool lower(const Place& place)
  {
    const auto& mesh = m.working().mesh;
    const int faces = int(mesh.num_faces());
    if (place.index >= faces) return m_lowerer.lower_tracked(place.index - faces);
    const Face f(place.index);
    if (!(m_distance(f) > m_goal)) return false;
    for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      if (flip(mesh.edge(h))) return true;
    return m_lowerer.lower(f);
  }

  // Where the other edge is nearer to the surface.
  bool flip(Edge e)
  {
    constexpr int least_degree = 4; // that is left
    const auto& mesh = m.working().mesh;
    if (!m.is_free(e) || !m.working().is_flippable(e)) return false;
    const auto [a, b, c, d] = m.corners(e);
    if (mesh.degree(a) <= least_degree || mesh.degree(b) <= least_degree) return false;
    const Cost before = cost(e);
    Star_mesh::Checkpoint now(m);
    m.flip(e);
    const Cost after = cost(e);
    if (after.badness > std::max(Parameters::max_badness, before.badness) ||
        after.agreement < std::min(Parameters::min_agreement, before.agreement) ||
        !(after.distance < Parameters::worthwhile_share * before.distance)) {
      now.restore();
      return false;
    }
    m_tracker.update();
    return true;
  }

  struct Cost {
    double badness, agreement, distance;
  };

  // Of an edge and its two faces.
  Cost cost(Edge e) const
  {
    const auto& mesh = m.working().mesh;
    Cost cost{0, 1, 0};
    for (const int side : {0, 1}) {
      const Face f = mesh.face(mesh.halfedge(e, side));
      const auto [a, b, c] = m.working().corners(f);
      cost.badness =
          std::max(cost.badness, triangle_badness(m.point(a), m.point(b), m.point(c)).badness);
      cost.agreement = std::min(cost.agreement, m.agreement(a, b, c));
      cost.distance = std::max(cost.distance, m_distance(f));
    }
    return cost;
  }

  Star_mesh& m;
  double m_goal; // a little less than is asked for, as between the points it may be more
  Distance_tracker m_tracker;
  Sampled_distance m_distance;
  Distance_lowerer m_lowerer;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_KEEP_DISTANCE_H
