// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle: for samples, normals and weights taken as exact doubles, the restricted cells F_i
// with exact combinatorics. F_i = tangent plane of s_i, cut by the equal-power half-spaces of the
// samples compatible with i (NVISPC). Shares no clipping code with `cells/`.
//
// Two ways to the neighbors, both proved in doc/PowerRTF/exact.txt:
// - where all neighbors of i in the regular triangulation of all samples are compatible, these
//   make the cell. Ties, which the triangulation decides its own way, are found and left to the
//   second way;
// - otherwise all compatible samples are clipped with, but for those in tree nodes that are proved
//   not to touch the polygon: every vertex has less power with respect to s_i than to any of them.
#ifndef CGAL_POWER_RTF_EXACT_EXACT_CELLS_H
#define CGAL_POWER_RTF_EXACT_EXACT_CELLS_H

#include <CGAL/PowerRTF/exact/Power_neighbors.h>
#include <CGAL/PowerRTF/exact/Tangent_cell_clipper.h>
#include <CGAL/PowerRTF/exact/Weighted_site_tree.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFExact
/// One restricted cell's combinatorics.
struct Exact_cell {
  /// The neighbors around \f$F_i\f$, counter-clockwise seen from \f$n_i\f$, each once, the
  /// smallest id first; -1 .. -4 are the sides of the clipping square. Empty when \f$F_i\f$ is
  /// empty.
  std::vector<int> neighbors;
  bool contains_site = false; ///< \f$s_i\f$ lies in \f$F_i\f$
  bool degenerate = false;    ///< a tie was met on the way and decided by the symbolic perturbation
  bool by_triangulation = false; ///< neighbors from the regular triangulation

  bool is_empty() const { return neighbors.empty(); }
  /// A side of the square is an edge: \f$F_i\f$ is larger than the given square, or unbounded when
  /// none was given.
  bool reaches_square() const { return !is_empty() && neighbors.front() < 0; }
};

/// \ingroup PkgPowerRTFExact
/// Shape of a cell. Each coordinate of a vertex is the exact one up to a few units in the last
/// place of the coordinate relative to \f$s_i\f$; area and centroid follow by double arithmetic.
struct Exact_cell_geometry {
  std::vector<Vec3d> vertices; ///< relative to \f$s_i\f$; vertex k is where edges k and k + 1 cross
  std::vector<double> edge_lengths; ///< upper bounds, within 1e-12, of the exact lengths
  double area = 0;
  Vec3d centroid{0, 0, 0}; ///< relative to \f$s_i\f$; mean of the vertices when the area vanishes
};

/// \ingroup PkgPowerRTFExact
/// \tparam Kernel a CGAL kernel, see `Tangent_cell_traits_3`
/// \tparam Traits a model of `TangentCellTraits_3`
///
/// `cell()` may be called from several threads.
template <class Kernel, class Traits = Tangent_cell_traits_3<Kernel>>
class Exact_cells {
  using Exact_nt = typename Traits::Exact_nt;
  using Clipper = internal::Tangent_cell_clipper<Exact_nt>;

  std::vector<Vec3d> m_points, m_normals;
  std::vector<double> m_weights;
  std::vector<int> m_patches;
  double m_cos_theta;
  internal::Weighted_site_tree m_tree;
  internal::Power_neighbors m_power_neighbors;

public:
  /// `points`, `normals` (not zero; unit where NVISPC is used), `weights` (length squared): one per
  /// sample. `cos_theta`: j counts for i when `dot(n_i, n_j) > cos_theta`; anything below -1:
  /// always. `patches`: one per sample, samples of other patches do not count; or empty: all count.
  /// \throw Invalid_input_error for arrays of different sizes, zero normals, and values that are
  /// not finite.
  Exact_cells(std::vector<Vec3d> points, std::vector<Vec3d> normals, std::vector<double> weights,
              double cos_theta, std::vector<int> patches = {})
      : m_points(std::move(points)), m_normals(std::move(normals)), m_weights(std::move(weights)),
        m_patches(std::move(patches)), m_cos_theta(cos_theta),
        m_tree(checked(m_points, m_normals, m_weights), m_weights)
  {
    if (!m_patches.empty() && m_patches.size() != m_points.size())
      throw Invalid_input_error("points and patches differ in number");
  }

  /// From now on the candidates come from the samples' regular triangulation where that suffices:
  /// the same cells, sooner if all or most are asked for.
  void triangulate() { m_power_neighbors = internal::Power_neighbors(m_points, m_weights); }

  std::size_t size() const { return m_points.size(); }

  /// NVISPC. The same double expression as the fast engines evaluate (no fused multiply-add: both
  /// are to be compiled with -ffp-contract=off), so that all engines agree on the compatible set.
  bool compatible(int i, int j) const
  {
    return same_patch(i, j) && dot(m_normals[i], m_normals[j]) > m_cos_theta;
  }

  bool same_patch(int i, int j) const { return m_patches.empty() || m_patches[i] == m_patches[j]; }

  /// \f$F_i\f$, clipped by `square` when given. Adds to `statistics` when given.
  /// \throw Invalid_input_error when the square is none.
  Exact_cell cell(int i, const Exact_square* square = nullptr,
                  Filter_statistics* statistics = nullptr) const
  {
    return cell_of(i, square, statistics, [&](int j) { return compatible(i, j); });
  }

  /// As `cell()`, but all samples of the patch count, whatever their normals.
  Exact_cell cell_of_all(int i, const Exact_square* square = nullptr,
                         Filter_statistics* statistics = nullptr) const
  {
    return cell_of(i, square, statistics, [&](int j) { return same_patch(i, j); });
  }

  /// The same of the samples for which `counts(j)` holds.
  template <class Counts>
  Exact_cell cell_of(int i, const Exact_square* square, Filter_statistics* statistics,
                     const Counts& counts) const
  {
    if (Exact_cell result; from_triangulation(i, square, result, statistics, counts)) return result;
    Clipper clipper(i, m_points[i], m_normals[i], m_weights[i], square);
    m_tree.visit(
        m_points[i], [&](const internal::Weighted_box& box) { return clipper.may_be_cut_by(box); },
        [&](int j) {
          if (j != i && counts(j)) clipper.clip(j, m_points[j], m_weights[j]);
        });
    return finish(clipper, statistics);
  }

  /// Shape of `cell`, a result of `cell(i, square)` with the same square. An unbounded cell
  /// (reaches the square, none given) has infinite area and no vertices; an empty one area 0.
  Exact_cell_geometry geometry(int i, const Exact_cell& cell,
                               const Exact_square* square = nullptr) const;

private:
  using Lines = std::vector<internal::Tangent_line<Exact_nt>>;

  // Of the edges, in the order of `cell.neighbors`.
  Lines edge_lines(const internal::Tangent_frame& f, int i, const Exact_cell& cell,
                   const Exact_square* square) const;

  /// Returns `points`, so that the check comes before what is built on them.
  static const std::vector<Vec3d>& checked(const std::vector<Vec3d>& points,
                                           const std::vector<Vec3d>& normals,
                                           const std::vector<double>& weights)
  {
    if (points.size() != normals.size() || points.size() != weights.size())
      throw Invalid_input_error("points, normals and weights differ in number");
    if (points.size() > std::size_t((std::numeric_limits<int>::max)()))
      throw Invalid_input_error("too many samples");
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!internal::is_finite(points[i]) || !std::isfinite(weights[i]))
        throw Invalid_input_error("a sample's position or weight is not finite");
      if (!internal::is_finite(normals[i]) || normals[i] == Vec3d{0, 0, 0})
        throw Invalid_input_error("a sample's normal is zero or not finite");
    }
    return points;
  }

  static Exact_cell finish(Clipper& clipper, Filter_statistics* statistics)
  {
    Exact_cell result;
    result.contains_site = clipper.contains_site();
    if (!clipper.is_empty()) result.neighbors = clipper.cycle();
    result.degenerate = clipper.statistics().ties > 0;
    if (statistics) *statistics += clipper.statistics();
    return result;
  }

  /// The first way; false when it cannot answer.
  template <class Counts>
  bool from_triangulation(int i, const Exact_square* square, Exact_cell& result,
                          Filter_statistics* statistics, const Counts& counts) const
  {
    if (m_power_neighbors.doubtful(i)) return false;
    const std::vector<int>& near = m_power_neighbors.of(i);
    for (int j : near)
      if (!counts(j)) return false;
    Clipper clipper(i, m_points[i], m_normals[i], m_weights[i], square);
    for (int j : near) clipper.clip(j, m_points[j], m_weights[j]);

    // A tie with a sample that is no neighbor of i in the triangulation would show at a vertex
    // (j, k) of the cell and with a neighbor of j or k.
    std::vector<int> others;
    if (!clipper.is_empty()) {
      for (int j : clipper.cycle()) {
        if (j < 0) continue;
        if (m_power_neighbors.doubtful(j)) return false;
        others.insert(others.end(), m_power_neighbors.of(j).begin(), m_power_neighbors.of(j).end());
      }
    }
    others.push_back(i);
    std::sort(others.begin(), others.end());
    others.erase(std::unique(others.begin(), others.end()), others.end());
    std::vector<int> tried(near);
    tried.push_back(i);
    std::sort(tried.begin(), tried.end());
    bool cut = false;
    for (int l : others) {
      if (!cut && !std::binary_search(tried.begin(), tried.end(), l))
        cut = clipper.clip(l, m_points[l], m_weights[l]);
    }
    if (cut || clipper.statistics().ties > 0) {
      if (statistics) *statistics += clipper.statistics();
      return false;
    }
    result = finish(clipper, statistics);
    result.by_triangulation = true;
    return true;
  }
};

template <class Kernel, class Traits>
typename Exact_cells<Kernel, Traits>::Lines
Exact_cells<Kernel, Traits>::edge_lines(const internal::Tangent_frame& f, int i,
                                        const Exact_cell& cell, const Exact_square* square) const
{
  Lines lines;
  for (int id : cell.neighbors) {
    if (id >= 0) {
      lines.push_back(internal::sample_line<Exact_nt>(f, m_points[i], m_weights[i], m_points[id],
                                                      m_weights[id]));
    } else {
      const Vec3d t = id == -1 || id == -3 ? square->t1 : square->t2;
      lines.push_back(
          internal::side_line<Exact_nt>(f, id >= -2 ? t : -t, square->half_size, false));
    }
  }
  return lines;
}

template <class Kernel, class Traits>
Exact_cell_geometry Exact_cells<Kernel, Traits>::geometry(int i, const Exact_cell& cell,
                                                          const Exact_square* square) const
{
  Exact_cell_geometry g;
  if (cell.is_empty()) return g;
  if (!square && cell.reaches_square()) {
    g.area = std::numeric_limits<double>::infinity();
    return g;
  }
  const internal::Tangent_frame f(m_normals[i]);
  const int n = int(cell.neighbors.size());
  const Lines lines = edge_lines(f, i, cell, square);
  const auto lift = [&](double p, double q) {
    double x[3];
    x[f.p] = p;
    x[f.q] = q;
    x[f.axis] = -(f.n_p * p + f.n_q * q) / f.n_axis;
    return Vec3d{x[0], x[1], x[2]};
  };
  std::vector<internal::Tangent_vertex<Exact_nt>> exact;
  std::vector<Vec3d> planar; // z = 0
  for (int k = 0; k < n; ++k) {
    exact.push_back(internal::crossing(lines[k], lines[(k + 1) % n]));
    const double w = CGAL::to_double(exact[k].w);
    planar.push_back({CGAL::to_double(exact[k].x) / w, CGAL::to_double(exact[k].y) / w, 0});
    g.vertices.push_back(lift(planar[k].x, planar[k].y));
  }

  // Edge k runs from vertex k - 1 to vertex k along (-b, a) det(k - 1, k, k + 1) / (w w'): no
  // difference of nearly equal vertices.
  for (int k = 0; k < n; ++k) {
    const auto& l = lines[(k + 1) % n];
    const auto& e = exact[(k + n - 1) % n];
    const Exact_nt det = l.c * e.w - l.a * e.x - l.b * e.y;
    const double scale = CGAL::to_double(det) / CGAL::to_double(e.w) / CGAL::to_double(exact[k].w);
    const Vec3d along = lift(-CGAL::to_double(lines[k].b), CGAL::to_double(lines[k].a));
    g.edge_lengths.push_back((std::max)(0., scale) * length(along) * (1 + 1e-13));
  }

  double area2 = 0, cx = 0, cy = 0;
  for (int k = 1; k + 1 < n; ++k) {
    const Vec3d a = planar[k] - planar[0], b = planar[k + 1] - planar[0];
    const double t = a.x * b.y - a.y * b.x;
    area2 += t;
    cx += t * (a.x + b.x) / 3;
    cy += t * (a.y + b.y) / 3;
  }
  g.area = (std::max)(0., area2) / 2 * length(m_normals[i]) / f.n_axis;
  if (area2 > 0) {
    g.centroid = lift(planar[0].x + cx / area2, planar[0].y + cy / area2);
  } else {
    for (const Vec3d& v : g.vertices) g.centroid += v * (1. / n);
  }
  return g;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXACT_EXACT_CELLS_H
