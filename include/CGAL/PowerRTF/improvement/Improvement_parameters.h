// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The constants of the improvement, stage by stage. h = sqrt(area / n) is the spacing of the n
// samples. Angles between normals are given by their cosines. "Agreement" is the least cosine
// between the normals of triangles and those of the surface at their corners; "badness" is that of
// triangle_badness.h, whose own constants stand there.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_IMPROVEMENT_PARAMETERS_H
#define CGAL_POWER_RTF_IMPROVEMENT_IMPROVEMENT_PARAMETERS_H

#include <CGAL/PowerRTF/smoothing/Smoothing_parameters.h>
#include <CGAL/PowerRTF/smoothing/triangle_badness.h>

#include <array>

namespace CGAL::PowerRTF::internal {

struct Improvement_parameters {
  /// improve_mesh.h
  struct Schedule {
    static constexpr int max_attempts = 8;
    static constexpr int smoothing_passes = 5; ///< before the first fit
    static constexpr int optimization_rounds = 8;
    static constexpr int sliding_passes = 2, sliding_rounds = 4;
    static constexpr int rounding_rounds = 4, last_rounding_rounds = 8;
    static constexpr int reconnection_passes = 3, last_reconnection_passes = 2;
    /// Of the largest distance, in h: more is undone.
    static constexpr double max_distance_growth = 0.2;
    /// Share of the largest distance from which on a place is worth a vertex of its own.
    static constexpr double far_share = 0.7;
    /// In h: as long as places are farther away, vertices are relocated once more.
    static constexpr double relocation_distance = 0.4;
    /// Badness that a stage may bring upon a triangle, as the optimization after it heals it.
    static constexpr double healable_badness = 0.3;
    /// The same where a vertex has been relocated for the last time.
    static constexpr double healable_relocation_badness = 0.008;
  };

  /// Star_mesh.h
  struct Stars {
    /// A vertex with so many edges (of a needle) has no good triangles, and to look at all of them
    /// for each costs minutes.
    static constexpr int hub_degree = 24;
  };

  /// Surface_projector.h and Distance_tracker.h
  struct Projection {
    /// Between normals that agree: about 110 degrees.
    static constexpr double min_normal_cosine = -0.35;
    static constexpr int max_downhill_steps = 30; ///< from facet to facet
  };

  /// Distance_tracker.h
  struct Tracking {
    static constexpr int max_points_per_vertex = 16;     ///< of the mesh
    static constexpr double tree_search_distance = 0.25; ///< in h: larger ones are exact
    static constexpr int max_carriers = 8;    ///< vertices from which a far point is looked for
    static constexpr double nearly_all = 0.9; ///< of the vertices: then all points are looked at
  };

  using Smoothing = Smoothing_parameters;

  /// annihilate_dislocations.h
  struct Dislocations {
    static constexpr int max_glide = 6;         ///< edges
    static constexpr int irregular_degree = 10; ///< of vertices that take no part
    static constexpr int rings = 3;             ///< around the flips, of vertices that move
    static constexpr int rounds_per_flip = 1, rounds = 3; ///< of their moves
    static constexpr double min_step = 0.01; ///< of these, in the shortest edge of the star
    /// All that the rounds to come gain, at most, in the gain of the last one.
    static constexpr double gains_to_come = 1;
    static constexpr double min_agreement = 0.5;
  };

  /// optimize_bad_triangles.h
  struct Optimization {
    /// The search in the tangent plane: the first step in the mean edge of the star, how often it
    /// is halved, and the number of steps.
    static constexpr double first_step = 0.2;
    static constexpr int max_halvings = 3, max_steps = 8;
    static constexpr double min_agreement = 0.5;  ///< that a star must keep, if it had it
    static constexpr double agreement_loss = 0.1; ///< that a move may cost a star that has less
    /// Where the agreement is below `curved_agreement`, vertices are drawn to where they were, by
    /// so much: moves cost distance to the surface.
    static constexpr double anchor_weight = 0.25, curved_agreement = 0.8;
    /// Two rounds that leave more than this share of the badness are the last.
    static constexpr double stagnation_share = 0.95;
    /// Least shape (mean ratio) of the triangles that a flip makes, before the search; and where
    /// the flip heals a valence that allows no good angles.
    static constexpr double min_flip_shape = 0.6, min_healing_flip_shape = 0.35;
  };

  /// slide_features.h
  struct Sliding {
    /// The search along the curve: the first step in its edges, how often it is halved, and the
    /// number of steps.
    static constexpr double first_step = 0.2;
    static constexpr int max_halvings = 4, max_steps = 10;
    /// The search of two vertices at once: the step, and the number of steps to each side.
    static constexpr double pair_step = 0.05;
    static constexpr int pair_steps = 10;
    static constexpr double min_spacing = 0.4; ///< of neighbors, in edges of the curve
    /// The same at most, where a crease is not straight: the distance to it grows with the square.
    static constexpr double max_spacing = 1.05;
    static constexpr double straight = 1e-6;        ///< 1 - cosine of its turn
    static constexpr double corner_cosine = 0.7071; ///< curves that turn more have a corner
    static constexpr double max_turn_cosine = 0.9;  ///< of a triangle
  };

  /// fit_creases.h
  struct Crease_fitting {
    static constexpr int rounds = 3;
    static constexpr int points_per_edge = 7; ///< where its distance is measured
    /// In edges: how far from its middle an edge looks for its part of the curve.
    static constexpr double reach = 0.75;
    static constexpr double straight = 1e-4; ///< least move, in edges: along a line there is none
    static constexpr double max_turn_cosine = 0.9; ///< of a triangle by one move
  };

  /// keep_areas.h
  struct Areas {
    static constexpr int rounds = 3, line_rounds = 8;
    /// Of the gradient of the area, that a vertex moves by at once. Chords of length h lose h^2 /
    /// 24 r^2 of a cylinder's area, and at a vertex, with its share sqrt(3) / 2 h^2 of it, that
    /// takes .05; much more would make bumps grow.
    static constexpr double most = 1 / 12.;
    /// The same across a line: a quarter of an edge of length h at once.
    static constexpr double most_of_lines = 1 / 2.;
    static constexpr double max_turn_cosine = 0.9; ///< of a triangle by one move
    /// Part of the area of a label that may be lacking without its lines being moved.
    static constexpr double tolerance = 0.005;
    /// That this may bring upon a triangle: Q .51, or 26.7 degrees, or 94.8 degrees.
    static constexpr double line_badness = 0.3;
    /// Between what the patches beside a line add up to: it is no crease of more than 18 degrees.
    static constexpr double smooth_cosine = 0.95;
  };

  /// round_mesh.h
  struct Rounding {
    /// Of the badness, where 1 - Q has 1: as long as what is bad can be mended, and at last.
    static constexpr double badness_weight = 1.2, last_badness_weight = 9;
    static constexpr double tolerated_badness = 0.02; ///< Q .71, or 38.9 degrees, or 86.2 degrees
    static constexpr double good = 0.01;              ///< mean unroundness in a star that stays
    /// The search in the tangent plane: the first step in the mean edge of the star, how often it
    /// is halved, and the number of steps.
    static constexpr double first_step = 0.03;
    static constexpr int max_halvings = 3, max_steps = 4;
    static constexpr double min_agreement = 0.75; ///< that a star or a flip must keep, if it had it
  };

  /// reconnect_mesh.h
  struct Reconnection {
    /// Unroundness of a triangle whose edges stay; that none may get.
    static constexpr double round = 0.1, bad = 0.6;
    /// Excess around an edge that may be flipped, split or collapsed.
    static constexpr double min_flip_excess = 1.5, min_split_excess = 0.75,
                            max_collapse_excess = -1.5;
    static constexpr double min_split_length = 1.1; ///< in the mean edge around
    /// What a collapse may cost: a split that follows gains more.
    static constexpr double vertex_worth = 0.1;
    static constexpr double min_agreement = 0.999; ///< that a change must keep, if it was there
    static constexpr double first_step = 0.15;     ///< of the search: see above
    static constexpr int passes = 4;               ///< of that search
    /// Where it ends: what the change has cost when the corners, and when all have moved once and
    /// twice.
    static constexpr std::array<double, 3> hopeless{1.5, 1.5, 0.4}, hopeless_split{5, 5, 3};
  };

  /// cover_tips.h
  struct Tips {
    /// Share of the farthest distance around a vertex to which a move must bring it down.
    static constexpr double worthwhile_share = 0.85;
    static constexpr double min_agreement = 0.1;
    /// Places that are tried: so many, and one more for each so many vertices of the mesh.
    static constexpr int max_places = 10;
    static constexpr int vertices_per_place = 100;
  };

  /// lower_distances.h
  struct Lowering {
    /// Places that are tried: so many, and one more for each so many vertices of the mesh.
    static constexpr int max_places = 50;
    static constexpr int vertices_per_place = 25;
    static constexpr int rounds = 4;              ///< of searches around a place
    static constexpr double min_distance = 0.025; ///< in h: nearer places stay
    /// The search in the tangent plane: the first step in the mean edge of the star, how often it
    /// is halved, and the number of steps.
    static constexpr double first_step = 0.1;
    static constexpr int max_halvings = 3, max_steps = 6;
    static constexpr double first_lift = 0.5; ///< step along the normal, in the largest distance
    /// Mean unroundness of the triangles of a star, where the largest distance, in that of the
    /// goal, has 1; and what a move must gain.
    static constexpr double unroundness_weight = 4, worthwhile = 0.01;
    /// Badness that a move may bring upon a star, and the growth of more where it has that.
    static constexpr double max_badness = 0.003, badness_growth = 1.01;
    static constexpr double min_agreement = 0.75; ///< that a star must keep, if it had it
  };

  /// keep_distance.h
  struct Distance_keeping {
    /// In the distance that is asked for: what the points that are looked at must keep, as between
    /// them there is more, and how dense they are along edges of the surface.
    static constexpr double goal = 0.93, step = 0.15;
    /// In the goal: faces whose middles, and those of their edges, are nearer are so everywhere.
    static constexpr double near_share = 0.3;
    static constexpr int passes = 4;
    static constexpr double fewer = 0.7; ///< of the places, that a pass must leave for another one
    /// Places at most: so many, of small meshes one for each so many vertices, and of all one more
    /// for each so many.
    static constexpr int max_places = 40, min_vertices_per_place = 5, vertices_per_place = 20;
    static constexpr double hopeless = 3; ///< distance, in the goal
    /// Badness that a change may bring upon a triangle: Q .6, or 32 degrees, or 91 degrees.
    static constexpr double max_badness = 0.13;
    static constexpr double min_agreement = 0.1; ///< that a star must keep, if it had it
    /// Mean unroundness of the triangles of a star, where the largest distance, in that of the
    /// goal, has 1.
    static constexpr double unroundness_weight = 0.5;
    static constexpr double worthwhile_share = 0.9; ///< of the distance, that a flip must leave
    /// The same of the places that get a vertex.
    static constexpr int max_moves = 40, vertices_per_move = 100;
    /// Places in vain, or spare vertices, after which a round ends: so many, and more for each
    /// vertex that has moved.
    static constexpr int max_failures = 10, failures_per_move = 3;
    /// Passes around a place at which a vertex was taken or put.
    static constexpr int passes_around = 2;
    static constexpr double spare_agreement = 0.3; ///< of stars that can spare their vertex here
    /// What a vertex must gain, in what its place is too far; and what a round must leave at most
    /// of what all places are too far, for another one.
    static constexpr double worthwhile_part = 0.5, less = 0.9;
  };

  /// coarsen_mesh_impl.h
  struct Coarsening {
    /// Badness that a change may bring upon a triangle.
    static constexpr double max_badness = Triangle_badness::tolerable;
    static constexpr double max_collapse_badness = 6; ///< right after a collapse
    static constexpr double min_agreement = 0.3;      ///< of a star that can spare its vertex
    static constexpr double hopeless = 1.4;           ///< distance right after that, in the goal
  };

  using Fitting = Fitting_parameters;

  /// relocate_vertices.h
  struct Relocation {
    static constexpr int max_tips = 4, max_tries = 3;      ///< whatever the size of the mesh
    static constexpr std::size_t max_candidates = 1 << 17; ///< of the vertices to be spared
    static constexpr double min_distance = 0.2;            ///< in h: nearer places stay
    static constexpr double min_separation = 3;            ///< in h, of places that change
    static constexpr double intersection_radius = 4; ///< in h, around a change: what is checked
    static constexpr double steep_sine = 0.5;        ///< of the angle of edge and surface
    static constexpr double flat_agreement = 0.9;    ///< of stars that can spare their vertex
    static constexpr double bend_cost = 10;          ///< badness, of agreement that lacks to that
    static constexpr double worthwhile_share = 0.85; ///< of the distance, that a flip must leave
    /// Badness right after the change that can be healed.
    static constexpr double max_collapse_badness = 1, max_split_badness = 5;
    static constexpr int optimization_rounds = 16;
  };
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_IMPROVEMENT_PARAMETERS_H
