// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The comparison of any engine's cells with the oracle: first the cycles of
// neighbors, which must be equal but for edges shorter than a rounding bound; then areas and
// centroids.
#ifndef CGAL_POWER_RTF_EXACT_CHECK_CELLS_H
#define CGAL_POWER_RTF_EXACT_CHECK_CELLS_H

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/PowerRTF/cells/Cell_polygon.h>
#include <CGAL/PowerRTF/cells/Tree_cells.h>
#include <CGAL/PowerRTF/exact/Cell_comparison.h>
#include <CGAL/PowerRTF/exact/Exact_cells.h>
#include <CGAL/PowerRTF/exact/Rounding_bound.h>
#include <CGAL/PowerRTF/exact/construct_exact_cell.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

class Cell_checker {
  using Cells = Exact_cells<Exact_predicates_inexact_constructions_kernel>;

  const Cells& m_exact;
  const Sites_view<double>& m_view;
  double m_spacing, m_epsilon;

public:
  struct Answer {
    bool is_right = false, is_equal = false, has_errors = false;
    bool is_of_all = false; ///< compared with the cell of all neighbors, whatever their normals
    int differing_edges = 0;
    double worst_edge = 0, area_error = 0, centroid_error = 0;
    Filter_statistics predicates;
  };

  /// `spacing`: sqrt(mean area).
  Cell_checker(const Cells& exact, const Sites_view<double>& view, double spacing, double epsilon)
      : m_exact(exact), m_view(view), m_spacing(spacing), m_epsilon(epsilon)
  {}

  Answer check(int i, const Cell_polygon& cell) const
  {
    const double guard = guard_radius(m_view, i);
    if (!(guard > 0)) return check_site(i, cell.status);
    const Rounding_bound bound(m_view, i, 4 * (std::max)(guard, m_spacing), m_epsilon);
    Answer answer = check(i, cell, guard, bound, {});
    if (answer.is_right) return answer;
    std::vector<int> undecided;
    for (int j = 0; j < int(m_exact.size()); ++j)
      if (j != i && m_exact.same_patch(i, j) && bound.may_decide_of(j)) undecided.push_back(j);
    if (undecided.empty()) return answer;
    // Each of them leaves nothing of the cell, or all.
    Answer without = check(i, cell, guard, bound, undecided);
    without.is_equal = false;
    const auto counts = [&](int j) { return without.is_of_all || m_exact.compatible(i, j); };
    without.is_right |=
        cell.neighbors.empty() && std::any_of(undecided.begin(), undecided.end(), counts);
    without.predicates += answer.predicates;
    return without;
  }

private:
  /// Compares the status of a cell without room, which is its site or nothing: see
  /// `construct_exact_cell()`.
  Answer check_site(int i, Cell_status status) const
  {
    Answer answer;
    const auto status_of = [&](const auto& counts) {
      const bool is_here = m_exact.cell_of(i, nullptr, &answer.predicates, counts).contains_site;
      return is_here ? Cell_status::guarded : Cell_status::empty;
    };
    const auto is_other = [&](int j) { return j != i && m_exact.same_patch(i, j); };
    answer.is_right = answer.is_equal = status == status_of(is_other);
    if (answer.is_right) return answer;
    const Rounding_bound bound(m_view, i, 0, m_epsilon);
    const auto is_decided = [&](int j) { return is_other(j) && !bound.may_decide_of_site(j); };
    if (status == Cell_status::guarded) // even so without all that rounding may decide of
      answer.is_right = status == status_of(is_decided);
    else if (status == Cell_status::empty)
      for (int j = 0; j < int(m_exact.size()) && !answer.is_right; ++j)
        answer.is_right = is_other(j) && !is_decided(j);
    return answer;
  }

  /// Compares with the exact cell of the sites that are not in `left_out`.
  Answer check(int i, const Cell_polygon& cell, double guard, const Rounding_bound& bound,
               const std::vector<int>& left_out) const
  {
    Answer answer;
    const auto counts = [&](int j) {
      return !std::binary_search(left_out.begin(), left_out.end(), j) &&
             (answer.is_of_all ? m_exact.same_patch(i, j) : m_exact.compatible(i, j));
    };
    const auto sites = [&]() {
      std::vector<int> result;
      for (int j = 0; j < int(m_exact.size()); ++j)
        if (j != i && counts(j)) result.push_back(j);
      return result;
    };
    const auto displaced_radius = [&](double half, int side) {
      return bound.radius(sites(), half, side);
    };
    const PowerRTF::Tangent_frame<double> frame(m_view.normals[i]);
    const Exact_square square{frame.u, frame.v, guard};
    // A status may differ by the rounding of R alone.
    const double slack = (std::max)(1e-9, 64 * m_epsilon);
    Exact_cell exact = m_exact.cell_of(i, &square, &answer.predicates, counts);
    Exact_cell_geometry geometry = m_exact.geometry(i, exact, &square);
    const double radius = radius_of(geometry);
    const bool is_large = exact.reaches_square() || radius > guard * (1 + slack);
    const bool is_small = !exact.reaches_square() && radius < guard * (1 - slack);
    // In a cell as thin as a needle, R depends much on the lines: it must be on the wrong side of
    // the guard radius with all of them displaced, too.
    bool is_status_right = true;
    switch (cell.status) {
    case Cell_status::ok:
      is_status_right = !(is_large && displaced_radius(2 * guard, -1) > guard);
      break;
    case Cell_status::guarded: // of an empty cell `compare()` tells whether it has an area
      is_status_right = exact.is_empty() || !(is_small && displaced_radius(2 * guard, 1) < guard);
      break;
    case Cell_status::empty: // the whole cell, or else the guarded one
    case Cell_status::incomplete:
      break;
    }
    if (cell.status == Cell_status::guarded || (cell.status != Cell_status::ok && is_large)) {
      answer.is_of_all = true;
      exact = m_exact.cell_of(i, &square, &answer.predicates, counts);
      geometry = m_exact.geometry(i, exact, &square);
    }
    compare(i, cell, exact, geometry, bound, sites, answer);
    // Displaced lines must leave nothing of the one, or something of the other.
    if (answer.is_right && cell.neighbors.empty() != exact.is_empty())
      answer.is_right =
          exact.is_empty() ? displaced_radius(guard, 1) > 0 : !(displaced_radius(guard, -1) > 0);
    answer.is_right = answer.is_right && is_status_right;
    if (answer.is_right && cell.vertices.size() > 2 && geometry.area > 0)
      measure(i, cell, geometry, answer);
    return answer;
  }

  /// The farthest vertex's distance from the site.
  static double radius_of(const Exact_cell_geometry& geometry)
  {
    double radius = 0;
    for (const Vec3d& v : geometry.vertices) radius = (std::max)(radius, length(v));
    return radius;
  }

  /// `sites()`: all that count.
  template <class Sites>
  void compare(int i, const Cell_polygon& cell, const Exact_cell& exact,
               const Exact_cell_geometry& geometry, const Rounding_bound& bound, const Sites& sites,
               Answer& answer) const
  {
    std::vector<int> cycle = cell.neighbors;
    std::rotate(cycle.begin(), std::min_element(cycle.begin(), cycle.end()), cycle.end());
    answer.is_right = answer.is_equal = cycle == exact.neighbors;
    if (answer.is_equal) return;

    // The vertices were rounded once more when the site was added to them.
    const Vec3d& s = m_view.sites[i].point;
    const double unit =
        internal::epsilon<double>() * (std::fabs(s.x) + std::fabs(s.y) + std::fabs(s.z));
    std::vector<double> lengths; // at least
    double perimeter = 0;        // at most
    const int n = int(cell.vertices.size());
    for (int k = 0; k < n; ++k) {
      const double l = length(cell.vertices[(k + 1) % n] - cell.vertices[k]);
      lengths.push_back(l - 2 * unit);
      perimeter += l + 2 * unit;
    }
    if (cycle.empty() || exact.is_empty()) {
      const std::vector<int>& edges = cycle.empty() ? exact.neighbors : cycle;
      for (const double l : geometry.edge_lengths) perimeter += l; // the other one has none
      double radius = radius_of(geometry);
      for (const Vec3d& v : cell.vertices) radius = (std::max)(radius, length(v - s) + unit);
      const double most = perimeter * bound.displacement(edges, sites(), radius);
      const double area = cycle.empty() ? geometry.area : cell.area;
      answer.worst_edge = area > 0 ? area / most : 0; // a polygon that is a point has no perimeter
      answer.differing_edges = int(edges.size());
    } else {
      const std::vector<int> common = common_cycle(exact.neighbors, cell.neighbors);
      add_missing(exact.neighbors, geometry.edge_lengths, common, cell.neighbors, bound, answer);
      add_missing(cell.neighbors, lengths, common, exact.neighbors, bound, answer);
    }
    answer.is_right = answer.differing_edges > 0 && answer.worst_edge <= 1;
  }

  /// The longest cycle that both contain in the same order.
  static std::vector<int> common_cycle(const std::vector<int>& a, std::vector<int> b)
  {
    const std::size_t n = a.size(), m = b.size();
    std::vector<int> longest;
    std::vector<std::vector<int>> length(n + 1, std::vector<int>(m + 1, 0)); // of the ends of a, b
    for (std::size_t turn = 0; turn < m; ++turn) {
      for (std::size_t k = n; k-- > 0;)
        for (std::size_t l = m; l-- > 0;)
          length[k][l] = a[k] == b[l] ? length[k + 1][l + 1] + 1
                                      : (std::max)(length[k + 1][l], length[k][l + 1]);
      if (length[0][0] > int(longest.size())) {
        longest.clear();
        for (std::size_t k = 0, l = 0; k < n && l < m;) {
          if (a[k] == b[l]) {
            longest.push_back(a[k++]);
            ++l;
          } else {
            ++(length[k + 1][l] >= length[k][l + 1] ? k : l);
          }
        }
      }
      std::rotate(b.begin(), b.begin() + 1, b.end());
    }
    return longest;
  }

  /// Measures the edges that are not in `common`.
  static void add_missing(const std::vector<int>& edges, const std::vector<double>& lengths,
                          const std::vector<int>& common, const std::vector<int>& others,
                          const Rounding_bound& bound, Answer& answer)
  {
    for (std::size_t k = 0; k < edges.size(); ++k) {
      if (std::find(common.begin(), common.end(), edges[k]) != common.end()) continue;
      ++answer.differing_edges;
      std::vector<int> rest; // in the other cycle the edge may stand at another place
      for (int id : others)
        if (id != edges[k]) rest.push_back(id);
      const double most = rest.empty() ? 0 : bound.length_of(edges[k], rest);
      answer.worst_edge =
          (std::max)(answer.worst_edge,
                     most > 0 ? lengths[k] / most : std::numeric_limits<double>::infinity());
    }
  }

  void measure(int i, const Cell_polygon& cell, const Exact_cell_geometry& geometry,
               Answer& answer) const
  {
    const Vec3d& s = m_view.sites[i].point;
    const Vec3d origin = cell.vertices[0] - s;
    Vec3d moment{0, 0, 0};
    double twice_area = 0;
    for (std::size_t k = 1; k + 1 < cell.vertices.size(); ++k) {
      const Vec3d a = cell.vertices[k] - cell.vertices[0];
      const Vec3d b = cell.vertices[k + 1] - cell.vertices[0];
      const double t = dot(cross(a, b), m_view.normals[i]);
      twice_area += t;
      moment += (a + b) * (t / 3);
    }
    if (!(twice_area > 0)) return;
    const Vec3d centroid = origin + moment * (1 / twice_area);
    answer.has_errors = true;
    answer.area_error = std::fabs(cell.area - geometry.area) / geometry.area;
    answer.centroid_error = length(centroid - geometry.centroid) / std::sqrt(geometry.area);
  }
};

inline Error_distribution distribution(std::vector<double>& errors)
{
  Error_distribution d;
  if (errors.empty()) return d;
  std::sort(errors.begin(), errors.end());
  d.p50 = errors[errors.size() / 2];
  d.p99 = errors[errors.size() * 99 / 100];
  d.max = errors.back();
  return d;
}

} // namespace internal

/// \ingroup PkgPowerRTFExact
/// Compares `cells`, an engine's cells of `samples`, with the oracle.
///
/// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`
/// \param samples points, unit normals and weights; the engine's order (any order is right, but a
/// spatial one is fast)
/// \param cells one per sample; none for the last ones, if these only bound cells
/// \param cos_angle the cosine of \f$\Theta\f$, as the engine uses it: `compatibility_cosine()`
/// \param epsilon the precision of the engine's arithmetic: that of double, or of float
/// \param guard_factor as in `Remeshing_options`
/// \throw Invalid_input_error when the arrays differ in size
template <class ConcurrencyTag>
Cell_comparison check_cells(const Samples& samples, const std::vector<Cell_polygon>& cells,
                            double cos_angle, double epsilon = internal::epsilon<double>(),
                            double guard_factor = 3)
{
  const std::size_t n = samples.size();
  if (cells.size() > n || samples.normals.size() != n || samples.weights.size() != n)
    throw Invalid_input_error("samples and cells differ in number");
  Owned_sites sites;
  sites.patches = samples.patches;
  for (std::size_t i = 0; i < n; ++i)
    sites.add(samples.points[i], samples.normals[i], samples.weights[i]);
  Remeshing_options options;
  options.guard_factor = guard_factor;
  Host_backend<ConcurrencyTag> backend;
  Tree_cells<double, Host_backend<ConcurrencyTag>> tree(backend, int(n), cos_angle, 1, options);
  tree.set_sites(sites.arrays());
  double area = 0;
  for (const Cell_polygon& cell : cells) area += cell.area;
  const auto view = tree.view();
  Exact_cells<Exact_predicates_inexact_constructions_kernel> exact(
      samples.points, samples.normals, samples.weights, cos_angle, samples.patches);
  exact.triangulate();
  const internal::Cell_checker checker(exact, view, std::sqrt(area / double(cells.size())),
                                       epsilon);

  std::vector<internal::Cell_checker::Answer> answers(cells.size());
  internal::for_each_index<ConcurrencyTag>(int(cells.size()),
                                           [&](int i) { answers[i] = checker.check(i, cells[i]); });
  Cell_comparison result;
  std::vector<double> area_errors, centroid_errors;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto& a = answers[i];
    ++result.cells;
    result.equal_cycles += a.is_equal;
    result.predicates += a.predicates;
    if (cells[i].status == Cell_status::incomplete) {
      ++(a.is_right ? result.uncertified_right : result.uncertified_wrong);
    } else if (!a.is_right) {
      ++result.certified_wrong;
      result.wrong.push_back(int(i));
    }
    if (!a.is_right) continue;
    result.differing_edges += a.differing_edges;
    result.worst_edge = (std::max)(result.worst_edge, a.worst_edge);
    if (!a.has_errors) continue;
    area_errors.push_back(a.area_error);
    centroid_errors.push_back(a.centroid_error);
  }
  result.area = internal::distribution(area_errors);
  result.centroid = internal::distribution(centroid_errors);
  return result;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_EXACT_CHECK_CELLS_H
