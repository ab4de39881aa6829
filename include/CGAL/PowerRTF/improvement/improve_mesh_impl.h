// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Improvement of an extracted mesh (an addition to the paper): rounder triangles, and a mesh nearer
// to the surface. `optimize` stands for a targeted search for better places of the vertices around
// the bad triangles (optimize_bad_triangles.h). "Far" is in comparison with the farthest.
//
//   repeat, at most 8 times:
//     start from the extracted mesh, with some vertices locked (at first none)
//     flip edges                                                           flip_edges.h
//     unless dislocations are to be kept:
//       annihilate dislocations of the lattice; flip edges     annihilate_dislocations.h
//     smooth vertices five times (the second attempt: four times)       smooth_vertex.h
//     if there are creases or borders:
//       optimize; twice: slide vertices along them; optimize             slide_features.h
//     if there are creases:
//       make triangles rounder on average             round_mesh.h, reconnect_mesh.h
//       move vertices off bent creases, so that their edges come near      fit_creases.h
//     fit the mesh to the surface by least squares, smooth vertices once, fit it again; optimize
//                                                                        fit_to_surface.h
//     move vertices to far tips of the surface and pin them; optimize      cover_tips.h
//     release the pinned vertices of bad triangles; optimize
//     if there are bad triangles, and creases or borders, twice: slide; optimize
//     put vertices from flat parts into far places                         relocate_vertices.h
//     if places are still very far: once more
//     if there are bad triangles: optimize
//     else if places are still very far: once more, allowing worse triangles; optimize;
//       undo that if bad triangles are left
//     put vertices where triangles are still bad, if that makes them good
//     if there are creases: make triangles rounder on average, fit the creases
//     move vertices to far tips where that makes no triangle bad
//     if there are creases: lower the largest distances                    lower_distances.h
//     if a largest distance is asked for: bring the mesh within it               keep_distance.h
//     if there are labels: give them their areas                                keep_areas.h
//     if no faces intersect and the largest distance has hardly grown:
//       unlock all vertices; optimize, with only what makes no faces intersect; done
//     else lock vertices of the faces that do: the one that has moved farthest, then all corners,
//       then more and more rings around them
//   the extracted mesh stays as it is
#ifndef CGAL_POWER_RTF_IMPROVEMENT_IMPROVE_MESH_IMPL_H
#define CGAL_POWER_RTF_IMPROVEMENT_IMPROVE_MESH_IMPL_H

#include <CGAL/PowerRTF/extraction/intersecting_faces.h>
#include <CGAL/PowerRTF/features/flat_patches.h>
#include <CGAL/PowerRTF/improvement/Host_star_sweeps.h>
#include <CGAL/PowerRTF/improvement/Improvement_parameters.h>
#include <CGAL/PowerRTF/improvement/Mesh_sweeper.h>
#include <CGAL/PowerRTF/improvement/annihilate_dislocations.h>
#include <CGAL/PowerRTF/improvement/cover_tips.h>
#include <CGAL/PowerRTF/improvement/fit_creases.h>
#include <CGAL/PowerRTF/improvement/fit_to_surface.h>
#include <CGAL/PowerRTF/improvement/flat_stars.h>
#include <CGAL/PowerRTF/improvement/flip_edges.h>
#include <CGAL/PowerRTF/improvement/improve_mesh.h>
#include <CGAL/PowerRTF/improvement/keep_areas.h>
#include <CGAL/PowerRTF/improvement/keep_distance.h>
#include <CGAL/PowerRTF/improvement/lower_distances.h>
#include <CGAL/PowerRTF/improvement/optimize_bad_triangles.h>
#include <CGAL/PowerRTF/improvement/reconnect_mesh.h>
#include <CGAL/PowerRTF/improvement/relocate_vertices.h>
#include <CGAL/PowerRTF/improvement/round_mesh.h>
#include <CGAL/PowerRTF/improvement/slide_features.h>
#include <CGAL/PowerRTF/improvement/tracked_points.h>
#include <CGAL/PowerRTF/internal/Background_work.h>
#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

struct Improvement_preparation {
  Flat_patches flat;
  internal::Unset_vector<internal::Tracked_point> points; ///< until they are tracked
  internal::Working_mesh::Mesh memory;                    ///< of the mesh, to be filled; or none
  Extracted_mesh result;                                  ///< the same of the improved one

  Improvement_preparation(const Surface& surface, const Facet_tree& tree, std::size_t vertices,
                          internal::Concurrency concurrency)
      : flat(surface, Flat_patches::level_sine, concurrency),
        points(internal::tracked_points(surface, tree, vertices, concurrency))
  {}
};

namespace internal {

class Mesh_improver {
public:
  /// \throw Invalid_input_error if `mesh` is not an oriented 2-manifold
  Mesh_improver(const Surface& surface, const Facet_tree& tree, Extracted_mesh& mesh,
                Concurrency concurrency, const Improvement_settings& settings)
      : m_surface(surface), m_projector(surface, tree), m_mesh(mesh), m_settings(settings),
        m_concurrency(concurrency), m_prepared(settings.prepared),
        m_sweeps(settings.make_sweeps
                     ? settings.make_sweeps(m_projector.descent(), surface.normalization.grid)
                     : nullptr),
        m_host_sweeps(
            make_host_star_sweeps(m_projector.descent(), surface.normalization.grid, concurrency)),
        m_locked(mesh.points.size(), false), m_tracker(begin()),
        m_spacing(std::sqrt(surface.area / double(mesh.points.size()))),
        m_largest_distance(m_tracker.max_distance() + Schedule::max_distance_growth * m_spacing)
  {}

  /// Improves the mesh. If an improvement has broken something, it is made anew: at first with less
  /// smoothing, which may already do, then with what was broken locked, as little of it as does.
  void run()
  {
    Progress_part part(0.93); // the first attempt, which mostly does
    for (int attempt = 0; attempt < Schedule::max_attempts; ++attempt) {
      if (attempt > 0) {
        m_stars.emplace(m_mesh, m_projector, m_settings.carriers, m_concurrency);
        m_tracker.update_all();
      }
      Star_mesh& stars = *m_stars;
      stars.lock(m_locked);
      improve(stars, attempt == 1 ? 1 : 0);
      if (attempt == 0) part.next(0.97);
      Extracted_mesh result = written(stars);
      const std::vector<Face> broken = find_broken(stars, result);
      if (broken.empty()) {
        if (attempt > 1) {
          optimize_locked(stars);
          result = written(stars);
        }
        m_mesh.take(std::move(result));
        return;
      }
      if (attempt == 1)
        lock_farthest(stars, broken);
      else if (attempt > 1)
        lock(stars, broken, attempt - 2);
    }
    m_mesh.sort_triangles(m_concurrency); // as others are
  }

  /// See `improve_mesh()`; of the last attempt.
  std::size_t changes() const { return m_changes; }

private:
  using Mesh = Working_mesh::Mesh;
  using Vertex = Working_mesh::Vertex;
  using Face = Mesh::Face_index;

  using Schedule = Improvement_parameters::Schedule;

  Improvement_preparation& prepared()
  {
    if (!m_prepared)
      m_prepared = std::make_shared<Improvement_preparation>(m_surface, m_projector.tree(),
                                                             m_mesh.points.size(), m_concurrency);
    return *m_prepared;
  }

  // Makes the stars of the extracted mesh, while it is looked at where the engine works; then the
  // memory there is needed.
  Distance_tracker begin()
  {
    const std::shared_ptr<Resident_mesh> there = m_mesh.there(m_settings.bring);
    Triangle_links links;
    const bool has_links = there && there->topology(&links);
    const auto take_links = [&](Triangle_links& result) {
      if (has_links) result = std::move(links);
      return has_links;
    };
    Improvement_preparation& prepared = this->prepared();
    const auto make_stars = [&] {
      m_stars.emplace(m_mesh, m_projector, m_settings.carriers, m_concurrency, take_links,
                      std::move(prepared.memory));
    };
    Unset_vector<int> faces; // else the tracker's way from face to face is quicker than the host's
    if (!there) {
      make_stars();
    } else {
      Background_work making(m_concurrency, make_stars);
      std::vector<int> halfedges;
      if (!find_faces(*there, prepared.points, faces)) faces.clear();
      const bool has_flips = there->find_flips(halfedges);
      making.finish();
      if (has_flips) set_flips(halfedges);
      m_has_given_stars = m_sweeps && give_stars(*there);
      there->release();
      m_mesh.resident = {};
    }
    return Distance_tracker(*m_stars, std::move(prepared.points), faces);
  }

  // Of the extracted mesh, those nearest to the points.
  bool find_faces(Resident_mesh& there, const Unset_vector<Tracked_point>& points,
                  Unset_vector<int>& faces)
  {
    faces.resize(points.size());
    for_each_index(m_concurrency, int(faces.size()), [&](int i) { faces[i] = points[i].vertex; });
    return there.find_faces(Improvement_parameters::Projection::min_normal_cosine,
                            int(faces.size()), faces.data(), faces.data());
  }

  bool give_stars(Resident_mesh& there)
  {
    Unset_vector<unsigned char> kinds(m_stars->size());
    for_each_index(m_concurrency, int(kinds.size()),
                   [&](int v) { kinds[v] = star_kind(*m_stars, Vertex(v)); });
    return there.give_stars(
        {kinds.data(), m_stars->working().normals.data(), m_stars->facets().data()}, *m_sweeps);
  }

  void set_flips(const std::vector<int>& halfedges)
  {
    const Mesh& mesh = m_stars->working().mesh;
    m_flips.emplace(halfedges.size());
    for_each_index(m_concurrency, int(halfedges.size()), [&](int k) {
      Working_mesh::Halfedge h = mesh.halfedge(Face(halfedges[k] / 3));
      for (int i = halfedges[k] % 3; i > 0; --i) h = mesh.next(h);
      (*m_flips)[k] = mesh.edge(h);
    });
  }

  // One attempt; see the head of this file.
  void improve(Star_mesh& stars, int passes_less)
  {
    Progress_part part(0.1);
    Shape_flipper flipper(stars);
    if (m_flips) flipper.expect(std::vector<Working_mesh::Edge>(*m_flips));
    Mesh_sweeper sweeper(stars, m_sweeps.get(), *m_host_sweeps,
                         std::exchange(m_has_given_stars, false));
    flipper.run();
    if (m_settings.dislocations == Dislocations::annihilate) {
      Dislocation_annihilator(stars).run();
      flipper.run();
    }
    part.next(0.3);
    Bad_triangle_optimizer optimizer(stars);
    const auto optimize = [&] { optimizer.run(Schedule::optimization_rounds); };
    const auto slide = [&] {
      Feature_slider slider(stars, m_surface);
      for (int pass = 0; pass < Schedule::sliding_passes; ++pass) {
        slider.run(Schedule::sliding_rounds);
        optimize();
      }
    };
    const int passes = Schedule::smoothing_passes - passes_less;
    const bool has_features = !m_mesh.feature_edges.empty();
    const bool is_creased = has_features && has_creases(stars);
    if (has_features) {
      optimizer.expect_at(smooth(sweeper, passes));
      optimize();
      slide();
      if (is_creased) round(stars, false);
      m_tracker.update_all();
    }
    part.next(0.5);
    optimizer.expect_at(fit(stars, sweeper, has_features ? 0 : passes));
    part.next(0.7);
    optimize();
    m_tracker.update_all();
    part.next(0.8);
    Tip_coverer(stars, m_tracker, Schedule::healable_badness).run(Schedule::far_share);
    optimize();
    if (optimizer.release_pinned() > 0) optimize();
    if (has_features && optimizer.is_needed()) slide();
    m_tracker.update();
    part.next(1);
    relocate(stars, optimizer);
    if (is_creased) {
      round(stars, true);
      m_tracker.update();
    }
    Tip_coverer(stars, m_tracker, Triangle_badness::tolerable).run(Schedule::far_share);
    if (is_creased) {
      m_tracker.update();
      Distance_lowerer(stars, m_tracker, m_prepared->flat).run(Schedule::far_share);
      m_tracker.update();
    }
    if (m_settings.max_distance > 0) {
      Distance_keeper(stars, optimizer, m_prepared->flat, m_settings.max_distance).run();
      m_tracker.update();
    }
    if (!m_surface.facet_labels.empty()) {
      Area_keeper(stars, Triangle_badness::tolerable).run();
      m_tracker.update();
    }
    m_changes = sweeper.changes();
  }

  // Moves all vertices so many times. Returns those that are left doubtful.
  static std::vector<int> smooth(Mesh_sweeper& sweeper, int passes)
  {
    return sweeper.sweep([passes](Star_sweeps_base& sweeps) {
      sweeps.smooth(passes);
      return true;
    });
  }

  // After that moves all vertices nearer to the surface. Returns those that are left doubtful.
  std::vector<int> fit(const Star_mesh& stars, Mesh_sweeper& sweeper, int passes) const
  {
    const Flat_fit fit = flat_fit(stars, m_tracker, m_prepared->flat, Schedule::healable_badness);
    return sweeper.sweep([&](Star_sweeps_base& sweeps) {
      sweeps.smooth(passes);
      if (!sweeps.fit(fit)) return false;
      sweeps.smooth(1);
      return sweeps.fit(fit);
    });
  }

  // Whether there are features that are no borders.
  static bool has_creases(const Star_mesh& stars)
  {
    const auto& mesh = stars.working().mesh;
    const auto edges = mesh.edges();
    return std::any_of(edges.begin(), edges.end(), [&](Working_mesh::Edge e) {
      return stars.is_feature(e) && !mesh.is_border(e);
    });
  }

  // Makes triangles rounder on average; `at_last`: so that none is bad, as nothing mends them.
  void round(Star_mesh& stars, bool at_last)
  {
    using Rounding = Improvement_parameters::Rounding;
    Feature_slider slider(stars, m_surface);
    Mesh_rounder rounder(stars, slider, Rounding::badness_weight);
    rounder.run(Schedule::rounding_rounds);
    if (at_last) {
      Mesh_reconnector(stars, rounder, Improvement_parameters::Reconnection::bad)
          .run(Schedule::last_reconnection_passes);
      Mesh_rounder(stars, slider, Rounding::last_badness_weight)
          .run(Schedule::last_rounding_rounds);
    } else {
      Mesh_reconnector(stars, rounder, std::numeric_limits<double>::infinity())
          .run(Schedule::reconnection_passes);
    }
    Crease_fitter(stars, slider, at_last ? Triangle_badness::tolerable : Schedule::healable_badness)
        .run();
  }

  // The triangles between locked vertices, too, as far as no faces intersect.
  void optimize_locked(Star_mesh& stars)
  {
    Star_mesh::Checkpoint before(stars);
    stars.unlock();
    Intersection_guard guard(stars.working(), std::vector<Intersection_guard::Sight>(
                                                  stars.size(), Intersection_guard::watched));
    Bad_triangle_optimizer(stars, &guard).run(Schedule::optimization_rounds);
    m_tracker.update();
    if (!find_too_far(stars).empty()) before.restore();
  }

  // Puts vertices from flat parts into far places.
  void relocate(Star_mesh& stars, Bad_triangle_optimizer& optimizer)
  {
    const double very_far = Schedule::relocation_distance * m_spacing;
    Vertex_relocator relocator(stars, optimizer, m_tracker);
    if (relocator.run(Schedule::far_share) && relocator.farthest() > very_far)
      relocator.run(Schedule::far_share);
    if (optimizer.is_needed()) {
      optimizer.run(Schedule::optimization_rounds);
      m_tracker.update();
    }
    if (relocator.farthest() > very_far && !optimizer.is_needed()) {
      Star_mesh::Checkpoint before(stars);
      if (relocator.run(Schedule::far_share, Schedule::healable_relocation_badness))
        optimizer.run(Schedule::optimization_rounds);
      if (optimizer.is_needed()) before.restore();
      m_tracker.update();
    }
    if (optimizer.is_needed()) {
      Star_mesh::Checkpoint before(stars);
      if (relocator.mend() && !find_too_far(stars).empty()) {
        before.restore();
        m_tracker.update();
      }
    }
  }

  // The faces whose part of the surface is too far away.
  std::vector<Face> find_too_far(const Star_mesh& stars) const
  {
    std::vector<Face> faces;
    for (const int i : m_tracker.farther_than(m_largest_distance))
      faces.push_back(stars.working().mesh.face(m_tracker[i].face));
    return faces;
  }

  // The improved mesh.
  Extracted_mesh written(const Star_mesh& stars) const
  {
    Extracted_mesh result = std::move(m_prepared->result);
    const auto resize = [this](auto& items, std::size_t n) {
      if (n > items.capacity())
        resize_in_parallel(m_concurrency, items, n);
      else
        items.resize(n);
    };
    call_at_once(
        m_concurrency, [&] { resize(result.points, m_mesh.points.size()); },
        [&] { resize(result.triangles, m_mesh.triangles.size()); });
    stars.write(result);
    result.sort_triangles(m_concurrency);
    return result;
  }

  // The faces that intersect others or are too far from the surface, but for those between locked
  // vertices: they are as in the raw mesh. `result`: the same mesh.
  std::vector<Face> find_broken(const Star_mesh& stars, const Extracted_mesh& result) const
  {
    const Mesh& mesh = stars.working().mesh;
    std::vector<Face> broken;
    const auto is_locked = [&](Face f) {
      for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
        if (!m_locked[v]) return false;
      return true;
    };
    for (const Face f : find_too_far(stars))
      if (!is_locked(f)) broken.push_back(f);
    const std::shared_ptr<Resident_mesh> there = result.there(m_settings.bring);
    const Intersection_finder finder(stars.working(), stars.concurrency());
    for (const auto& [f, g] : there ? finder.all(result.triangles, *there) : finder.all())
      if (!is_locked(f) || !is_locked(g)) broken.insert(broken.end(), {f, g});
    return broken;
  }

  // Locks the vertex of each face that has moved farthest.
  void lock_farthest(const Star_mesh& stars, const std::vector<Face>& broken)
  {
    const auto moved = [&](Vertex v) { return squared_length(stars.point(v) - m_mesh.points[v]); };
    const Mesh& mesh = stars.working().mesh;
    for (const Face f : broken) {
      const auto corners = mesh.vertices_around_face(mesh.halfedge(f));
      const Vertex v = *std::max_element(corners.begin(), corners.end(),
                                         [&](Vertex a, Vertex b) { return moved(a) < moved(b); });
      m_locked[v] = true;
    }
  }

  // Locks the vertices of the faces and those so many edges around them.
  void lock(const Star_mesh& stars, const std::vector<Face>& broken, int rings)
  {
    const Mesh& mesh = stars.working().mesh;
    std::vector<Vertex> locked;
    for (const Face f : broken)
      for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) locked.push_back(v);
    stars.working().add_neighbors(locked, rings);
    for (const Vertex v : locked) m_locked[v] = true;
  }

  const Surface& m_surface;
  Surface_projector m_projector;
  Extracted_mesh& m_mesh; // as it was extracted, until it is improved
  const Improvement_settings& m_settings;
  Concurrency m_concurrency;
  std::shared_ptr<Improvement_preparation> m_prepared;
  std::unique_ptr<Star_sweeps_base> m_sweeps, m_host_sweeps; // the engine's may be null
  std::vector<char> m_locked;
  bool m_has_given_stars = false;                         // to `m_sweeps`, as they are
  std::size_t m_changes = 0;                              // of the last attempt
  std::optional<Star_mesh> m_stars;                       // of the attempt
  std::optional<std::vector<Working_mesh::Edge>> m_flips; // of the extracted mesh; none: not known
  Distance_tracker m_tracker;
  double m_spacing;
  double m_largest_distance;
};

} // namespace internal

CGAL_POWER_RTF_INLINE std::shared_ptr<Improvement_preparation>
prepare_improvement(const Surface& surface, const Facet_tree& tree, std::size_t vertices,
                    internal::Concurrency concurrency)
{
  std::shared_ptr<Improvement_preparation> prepared;
  internal::Working_mesh::Mesh memory;
  Extracted_mesh result;
  internal::call_at_once(
      concurrency,
      [&] {
        prepared = std::make_shared<Improvement_preparation>(surface, tree, vertices, concurrency);
      },
      [&] { memory.resize(vertices, 3 * vertices + vertices / 16, 2 * vertices + vertices / 32); },
      [&] { internal::resize_in_parallel(concurrency, result.points, vertices); },
      [&] {
        internal::resize_in_parallel(concurrency, result.triangles, 2 * vertices + vertices / 32);
      });
  prepared->memory = std::move(memory);
  prepared->result = std::move(result);
  return prepared;
}

CGAL_POWER_RTF_INLINE bool improve_mesh(const Surface& surface, const Facet_tree& tree,
                                        Extracted_mesh& mesh, internal::Concurrency concurrency,
                                        const Improvement_settings& settings, std::size_t* changes)
{
  if (mesh.triangles.empty()) return true;
  try {
    internal::Progress_part part(0.12);
    internal::Mesh_improver improver(surface, tree, mesh, concurrency, settings);
    part.next(0.98);
    improver.run();
    if (changes) *changes = improver.changes();
  } catch (const Invalid_input_error&) {
    return false;
  }
  return true;
}

CGAL_POWER_RTF_INLINE bool improve_mesh(const Surface& surface, Extracted_mesh& mesh,
                                        internal::Concurrency concurrency)
{
  return improve_mesh(
      surface, Facet_tree(surface.points, surface.triangles, surface.facet_patches, concurrency),
      mesh, concurrency);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_IMPROVEMENT_IMPROVE_MESH_IMPL_H
