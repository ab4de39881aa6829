// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps of Algorithms 1 to 3 over all samples at once on the CPU, sequential or with TBB, for
// any construction of the cells. The result is the same bit for bit for any number of threads.
#ifndef CGAL_POWER_RTF_ENGINES_HOST_ENGINE_H
#define CGAL_POWER_RTF_ENGINES_HOST_ENGINE_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/cells/cell_moments.h>
#include <CGAL/PowerRTF/cells/clip_at_features.h>
#include <CGAL/PowerRTF/engines/Cell_polygon.h>
#include <CGAL/PowerRTF/engines/Spatial_order.h>
#include <CGAL/PowerRTF/engines/Surface_sampler.h>
#include <CGAL/PowerRTF/optimization/Lbfgs.h>
#include <CGAL/PowerRTF/optimization/capacity_statistics.h>
#include <CGAL/PowerRTF/optimization/multiplicative_weights.h>
#include <CGAL/PowerRTF/optimization/newton_step_rules.h>
#include <CGAL/PowerRTF/optimization/newton_weights.h>
#include <CGAL/PowerRTF/optimization/usable_cells.h>
#include <CGAL/PowerRTF/surface/feature_samples.h>

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace CGAL {
namespace PowerRTF {

/// \cgalModels `PowerRTFEngine`
///
/// \tparam Cell_tree owns the sites and constructs their cells; `Site_tree` with a constructor from
/// the options.
///
/// The sites are the samples and, fixed, the feature samples: these bound cells and have none.
template <class Cell_tree, class ConcurrencyTag>
class Host_engine {
public:
  /// Keeps a reference to `surface`.
  Host_engine(const Surface& surface, const Remeshing_options& options)
      : m_options(options), m_surface(surface), m_sampler(surface, options),
        m_cos_angle(compatibility_cosine(options.normal_angle)), m_tree(options),
        m_lbfgs(options.lbfgs_memory)
  { m_tree.guard_factor = options.guard_factor; }

  /// Takes the samples' points and facets into spatial order; their weights become 0. `features`:
  /// samples that stay where they are, without weights.
  void set_samples(const Samples& samples, const Feature_samples& features = {});

  /// Constructs all cells (Algorithm 1) and their moments.
  void build_cells();

  /// One pass of the paper's rule over all weights (Algorithm 2, lines 3 to 10).
  void update_weights();

  /// One damped Newton step on the weights; the cells are those of the new weights. Cells that no
  /// weights make equal keep their areas, nearly, and are left out of `capacity()` until the samples
  /// move: those that are not `is_equalizable()`, and up to one in a hundred that would vanish.
  /// `false`: no step made the masses more equal, nothing has changed.
  bool newton_weights();

  /// All weights become 0, and the cells are built again.
  void clear_weights();

  /// Moves the samples by one step and projects them (Algorithm 3, lines 15 to 19). The cells must
  /// be those of the current samples.
  void move_samples(Position_method method);

  /// Goes back to the most centroidal samples that L-BFGS has passed, when the current ones are
  /// less so (it descends by leaps); the cells are built again.
  void restore_best();

  Capacity_statistics capacity() const
  {
    return capacity_statistics<ConcurrencyTag>(
        size(), [&](int k) { return mass(m_free[k]); }, [&](int k) { return is_left_out(k); },
        m_options.capacity_tolerance);
  }
  Cell_counts cell_counts() const;
  /// Root mean square of |s_i - c_i| over the cells, in units of sqrt(area / n).
  double displacement() const;
  std::size_t constructions() const { return m_constructions; }

  /// The facets of the surface and their patches.
  const Facet_tree& facet_tree() const { return m_sampler.facet_tree(); }

  /// The samples, without the feature samples.
  Samples samples() const;
  /// The cells of the samples. They are not cut at creases and borders. Neighbours from the number
  /// of samples on are the sites of the feature samples.
  std::vector<Cell_polygon> cells();

private:
  using Frame = Tangent_frame<double>;

  int size() const { return static_cast<int>(m_free.size()); }
  int sites() const { return static_cast<int>(m_tree.sites.size()); }
  bool has_features() const { return size() < sites(); }
  /// m_i = rho_i A(F_i)
  double mass(int i) const { return m_density[i] * m_moments[i].area; }
  template <class F>
  void for_each_sample(F&& f)
  {
    internal::for_each_index<ConcurrencyTag>(size(), [&](int k) { f(m_free[k]); });
  }
  template <class F>
  double sum(F&& f) const
  { return internal::sum<ConcurrencyTag>(size(), [&](int k) { return f(m_free[k]); }); }
  double density_root(double density) const
  { return std::cbrt(std::pow(density, m_options.centroid_density_power)); }
  /// Of sample number `k`.
  bool is_left_out(int k) const { return !m_left_out.empty() && m_left_out[k]; }
  void choose_left_out();
  /// The numbers of the samples whose cells are not larger.
  std::vector<int> vanishing_samples(double least) const;
  bool usable(int i) const
  { return is_usable(m_status[i], m_moments[i].mass, mass(i), m_mean_mass); }
  void update_attributes();
  /// Calls `f` with the part of the cell that lies on the sample's patch.
  template <class Polygon, class F>
  void within_patch(int i, const Polygon& polygon, const Frame& frame, F&& f) const;
  void center_weights();
  std::vector<Capacity_edge> capacity_edges();
  std::vector<Vec3d> lbfgs_steps();
  /// A sample with an empty cell stays, unless it lies on another sample: no weight could part them.
  Vec3d step_apart(int i) const;
  /// Returns the residual, the sum of |s_i - c_i|^2, over the least one so far.
  double remember_best();

  Remeshing_options m_options;
  const Surface& m_surface;
  Surface_sampler m_sampler;
  double m_cos_angle;

  Cell_tree m_tree;
  std::vector<int> m_free;            // the sites that are samples, in their order
  std::vector<int> m_numbers;         // of the sites: samples, then feature sites
  std::vector<int> m_next, m_previous; // see `clip_at_features()`; empty: no features
  std::vector<int> m_facets;          // that carry the samples
  std::vector<double> m_density;      // rho_i
  std::vector<double> m_density_root; // cube root of the density that weights the centroids
  std::vector<Cell_status> m_status;
  std::vector<Cell_moments<double>> m_moments;
  std::vector<Vec3d> m_offsets;     // c_i - s_i
  double m_mean_mass = 0;           // of the first cells; 0: there were none yet
  std::vector<char> m_left_out;     // by sample, of Newton's steps; empty: none was made since a move
  std::vector<double> m_nearest;    // D_i, for the weights; empty after the samples have moved
  Lbfgs<ConcurrencyTag> m_lbfgs;
  struct Best_state { // where the residual of L-BFGS was least
    double residual = std::numeric_limits<double>::infinity();
    std::vector<Site<double>> sites;
    std::vector<int> facets;
  } m_best;
  std::size_t m_constructions = 0;
};

template <class Tree, class Tag>
void Host_engine<Tree, Tag>::set_samples(const Samples& samples, const Feature_samples& features)
{
  const std::size_t free = samples.size(), n = free + features.sites.size();
  m_mean_mass = 0;
  // The first neighbour search: a ball of radius 2 R that holds k samples.
  m_tree.resize(n, std::sqrt(m_options.neighbors * m_surface.area / (4 * 3.14159265358979 * n)));
  m_facets.resize(n);
  m_density.resize(n);
  m_density_root.resize(n);
  m_status.assign(n, Cell_status::ok);
  m_moments.assign(n, {});
  m_offsets.assign(n, {0, 0, 0});
  m_lbfgs.clear();
  m_best = {};
  m_free.clear();
  m_numbers.resize(n);
  std::vector<Vec3d> points = samples.points;
  points.insert(points.end(), features.sites.points.begin(), features.sites.points.end());
  std::vector<int> places(n);
  m_tree.is_fixed.assign(free < n ? n : 0, 0);
  int i = 0;
  for (const int k : internal::spatial_order(points)) {
    places[k] = i;
    m_tree.sites[i] = {points[k], 0};
    if (k < int(free)) {
      m_numbers[i] = static_cast<int>(m_free.size());
      m_free.push_back(i);
      m_facets[i++] = samples.facets[k];
      continue;
    }
    const std::size_t site = k - free;
    m_numbers[i] = k;
    m_facets[i] = features.sites.facets[site];
    m_tree.is_fixed[i] = 1;
    m_tree.normals[i] = features.sites.normals[site];
    m_density[i] = features.sites.density[site];
    m_density_root[i++] = density_root(features.sites.density[site]);
  }
  m_next.assign(free < n ? n : 0, -1);
  m_previous = m_next;
  for (std::size_t site = 0; site < features.next.size(); ++site) {
    const int a = places[free + site], b = places[free + features.next[site]];
    m_next[a] = b;
    m_previous[b] = a;
  }
  m_tree.patches.clear();
  if (!m_surface.facet_patches.empty())
    for (const int f : m_facets) m_tree.patches.push_back(m_surface.facet_patches[f]);
  update_attributes();
}

template <class Tree, class Tag>
void Host_engine<Tree, Tag>::update_attributes()
{
  for_each_sample([&](int i) {
    m_sampler.attributes(m_tree.sites[i].point, m_facets[i], m_tree.normals[i], m_density[i]);
    m_density_root[i] = density_root(m_density[i]);
  });
  m_nearest.clear();
  m_left_out.clear();
  m_tree.refit();
}

template <class Tree, class Tag>
void Host_engine<Tree, Tag>::build_cells()
{
  ++m_constructions;
  m_tree.construct_cells(
      m_cos_angle, [&](int i, Cell_status status, const auto& polygon, const Frame& frame) {
        m_status[i] = status;
        within_patch(i, polygon, frame, [&](const auto& part) {
          m_moments[i] = cell_moments(part, i, [&](int j) { return m_density_root[j]; });
        });
        m_offsets[i] = frame.u * m_moments[i].x + frame.v * m_moments[i].y;
      });
  if (m_mean_mass == 0) m_mean_mass = sum([&](int i) { return mass(i); }) / size();
}

template <class Tree, class Tag>
template <class Polygon, class F>
void Host_engine<Tree, Tag>::within_patch(int i, const Polygon& polygon, const Frame& frame,
                                          F&& f) const
{
  if (!has_features() || polygon.size > Tangent_polygon<double>::capacity) return f(polygon);
  Tangent_polygon<double> part;
  part.size = polygon.size;
  for (int k = 0; k < polygon.size; ++k) {
    part.x[k] = polygon.x[k];
    part.y[k] = polygon.y[k];
    part.neighbor[k] = polygon.neighbor[k];
  }
  clip_at_features(m_tree.view(), i, m_next.data(), m_previous.data(), frame, part);
  f(part);
}

template <class Tree, class Tag>
void Host_engine<Tree, Tag>::center_weights()
{
  if (!has_features()) { // otherwise the weights are relative to those of the features
    const double mean = sum([&](int i) { return m_tree.sites[i].weight; }) / size();
    for_each_sample([&](int i) { m_tree.sites[i].weight -= mean; });
  }
  m_tree.refit();
}

template <class Tree, class Tag>
void Host_engine<Tree, Tag>::update_weights()
{
  if (m_nearest.empty()) {
    m_nearest.resize(sites());
    for_each_sample([&](int i) {
      m_nearest[i] = distance_to_neighbor(m_tree.view(), i, 1, m_cos_angle);
    });
  }
  const double mean = sum([&](int i) { return mass(i); }) / size();
  const Multiplicative_weight_rule change{m_options.capacity_tolerance, m_options.weight_step,
                                          m_options.weight_operator == Weight_operator::floor,
                                          mean};
  for_each_sample([&](int i) {
    // An empty cell often lies close to the sample that displaced it, where D_i says nothing.
    const double distance =
        mass(i) > 0 ? m_nearest[i] : distance_to_neighbor(m_tree.view(), i, 6, m_cos_angle);
    m_tree.sites[i].weight += change(mass(i), distance);
  });
  center_weights();
}

template <class Tree, class Tag>
void Host_engine<Tree, Tag>::clear_weights()
{
  for_each_sample([&](int i) { m_tree.sites[i].weight = 0; });
  m_tree.refit();
  build_cells();
}

template <class Tree, class Tag>
std::vector<Capacity_edge> Host_engine<Tree, Tag>::capacity_edges()
{
  std::vector<boost::container::small_vector<Capacity_edge, 8>> of_cell(sites());
  ++m_constructions;
  m_tree.construct_cells(
      m_cos_angle, [&](int i, Cell_status, const auto& polygon, const Frame& frame) {
        within_patch(i, polygon, frame, [&](const auto& part) {
          for (int k = 0; k < part.size; ++k) {
            const int j = part.neighbor[k], l = part.next(k);
            if (j < 0) continue;
            const Vec3d offset = m_tree.sites[j].point - m_tree.sites[i].point;
            const double distance = std::hypot(dot(offset, frame.u), dot(offset, frame.v));
            const double edge = std::hypot(part.x[l] - part.x[k], part.y[l] - part.y[k]);
            const int other = m_numbers[j] < size() ? m_numbers[j] : Capacity_edge::fixed;
            of_cell[i].push_back({m_numbers[i], other, edge / distance});
          }
        });
      });
  std::vector<Capacity_edge> edges;
  for (const auto& own : of_cell) edges.insert(edges.end(), own.begin(), own.end());
  return edges;
}

template <class Tree, class Tag>
void Host_engine<Tree, Tag>::choose_left_out()
{
  if (!m_left_out.empty()) return;
  const auto is_ok = [&](int i) { return m_status[i] == Cell_status::ok; };
  const double count = sum([&](int i) { return double(is_ok(i)); });
  const double mean = sum([&](int i) { return is_ok(i) ? mass(i) : 0; }) / count;
  for (const int i : m_free) m_left_out.push_back(!is_equalizable(m_status[i], mass(i), mean));
}

template <class Tree, class Tag>
std::vector<int> Host_engine<Tree, Tag>::vanishing_samples(double least) const
{
  std::vector<int> found;
  for (int k = 0; k < size(); ++k)
    if (!is_left_out(k) && !(mass(m_free[k]) > least)) found.push_back(k);
  return found;
}

template <class Tree, class Tag>
bool Host_engine<Tree, Tag>::newton_weights()
{
  choose_left_out();
  while (true) {
    std::vector<double> areas, densities;
    for (const int i : m_free) {
      areas.push_back(m_moments[i].area);
      densities.push_back(m_density[i]);
    }
    const std::vector<double> direction =
        newton_weights_direction<Tag>(areas, densities, capacity_edges(), m_left_out);
    if (direction.empty()) return false;

    const Capacity_statistics before = capacity();
    const double least = least_capacity(before);
    const std::vector<Site<double>> sites = m_tree.sites;
    std::vector<int> vanishing;
    for (const double step : newton_weight_steps) {
      for (int k = 0; k < size(); ++k)
        m_tree.sites[m_free[k]].weight = sites[m_free[k]].weight + step * direction[k];
      center_weights();
      build_cells();
      vanishing = vanishing_samples(least);
      if (vanishing.empty() && capacity().rms < before.rms) return true;
    }
    m_tree.sites = sites;
    m_tree.refit();
    build_cells();
    if (!may_leave_out(vanishing.size(), before.left_out, size())) return false;
    for (const int k : vanishing) m_left_out[k] = 1;
  }
}

template <class Tree, class Tag>
std::vector<Vec3d> Host_engine<Tree, Tag>::lbfgs_steps()
{
  // The energy is the sum of int rho |x - s_i|^2 over the cells: gradient 2 m_i (s_i - c_i).
  std::vector<Vec3d> positions(sites()), gradient(sites(), {0, 0, 0});
  std::vector<double> inverse_diagonal(sites(), 0);
  for_each_sample([&](int i) {
    positions[i] = m_tree.sites[i].point;
    if (!usable(i)) return;
    gradient[i] = m_offsets[i] * (-2 * m_moments[i].mass);
    inverse_diagonal[i] = 1 / (2 * m_moments[i].mass);
  });
  return m_lbfgs.direction(positions, gradient, inverse_diagonal);
}

template <class Tree, class Tag>
double Host_engine<Tree, Tag>::remember_best()
{
  const double residual =
      sum([&](int i) { return usable(i) ? squared_length(m_offsets[i]) : 0; });
  if (residual < m_best.residual) {
    m_best.residual = residual;
    m_best.sites = m_tree.sites;
    m_best.facets = m_facets;
  }
  return residual / m_best.residual;
}

template <class Tree, class Tag>
void Host_engine<Tree, Tag>::restore_best()
{
  if (!(remember_best() > 1)) return;
  m_tree.sites = m_best.sites;
  m_facets = m_best.facets;
  update_attributes();
  build_cells();
  m_lbfgs.clear();
}

template <class Tree, class Tag>
void Host_engine<Tree, Tag>::move_samples(Position_method method)
{
  bool lbfgs = method == Position_method::lbfgs;
  constexpr double explosion = 16;
  if (lbfgs && remember_best() > explosion) { // back, and on from there by Lloyd's method
    restore_best();
    lbfgs = false;
  }
  std::vector<Vec3d> steps = lbfgs ? lbfgs_steps() : m_offsets; // Lloyd: to the centre of mass
  for_each_sample([&](int i) {
    if (m_status[i] == Cell_status::empty) {
      steps[i] = step_apart(i);
    } else if (!usable(i)) {
      steps[i] = cautious_step(m_offsets[i], m_moments[i].area, m_mean_mass / m_density[i]);
    } else if (lbfgs) {
      steps[i] = shortened(steps[i], m_moments[i].area);
    }
  });
  for_each_sample([&](int i) {
    Site<double>& site = m_tree.sites[i];
    const Surface_point<double> q =
        m_sampler.project(site.point + steps[i], m_tree.normals[i], m_facets[i]);
    if (q.facet < 0) return;
    site.point = q.point;
    m_facets[i] = q.facet;
  });
  update_attributes();
}

template <class Tree, class Tag>
Vec3d Host_engine<Tree, Tag>::step_apart(int i) const
{
  const auto view = m_tree.view();
  if (distance_to_neighbor(view, i, 1) > 0) return {0, 0, 0};
  const double angle = 2.399963229728653 * i; // the golden angle: all directions differ
  const Frame frame(view.normals[i]);
  return (frame.u * std::cos(angle) + frame.v * std::sin(angle)) *
         (0.5 * distance_to_neighbor(view, i, 6));
}

template <class Tree, class Tag>
Cell_counts Host_engine<Tree, Tag>::cell_counts() const
{
  Cell_counts counts;
  for (const int i : m_free) {
    const Cell_status s = m_status[i];
    counts.ok += s == Cell_status::ok;
    counts.guarded += s == Cell_status::guarded;
    counts.empty += s == Cell_status::empty;
    counts.incomplete += s == Cell_status::incomplete;
  }
  return counts;
}

template <class Tree, class Tag>
double Host_engine<Tree, Tag>::displacement() const
{
  const double squares = sum([&](int i) { return squared_length(m_offsets[i]); });
  return std::sqrt(squares / m_surface.area);
}

template <class Tree, class Tag>
Samples Host_engine<Tree, Tag>::samples() const
{
  Samples s;
  for (const int i : m_free) {
    s.points.push_back(m_tree.sites[i].point);
    s.facets.push_back(m_facets[i]);
    s.normals.push_back(m_tree.normals[i]);
    s.density.push_back(m_density[i]);
    s.weights.push_back(m_tree.sites[i].weight);
    if (!m_tree.patches.empty()) s.patches.push_back(m_tree.patches[i]);
  }
  return s;
}

template <class Tree, class Tag>
std::vector<Cell_polygon> Host_engine<Tree, Tag>::cells()
{
  std::vector<Cell_polygon> cells(size());
  m_tree.construct_cells(
      m_cos_angle, [&](int i, Cell_status status, const auto& polygon, const Frame& frame) {
        Cell_polygon& cell = cells[m_numbers[i]];
        for (int k = 0; k < polygon.size; ++k) {
          cell.vertices.push_back(m_tree.sites[i].point + frame.u * polygon.x[k] +
                                  frame.v * polygon.y[k]);
          const int j = polygon.neighbor[k];
          cell.neighbors.push_back(j < 0 ? j : m_numbers[j]);
        }
        cell.area = cell_moments(polygon).area;
        cell.density = m_density[i];
        cell.mass = cell.area * cell.density;
        cell.weight = m_tree.sites[i].weight;
        cell.status = status;
      });
  return cells;
}

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_ENGINES_HOST_ENGINE_H
