// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// All cells (Algorithm 1) on the CPU, from neighbor lists or by searches in a packed tree of the
// sites.
#ifndef CGAL_POWER_RTF_CELLS_TREE_CELLS_H
#define CGAL_POWER_RTF_CELLS_TREE_CELLS_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/cells/Cell_arrays.h>
#include <CGAL/PowerRTF/cells/Neighbor_cycles.h>
#include <CGAL/PowerRTF/cells/Neighbor_lists.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <mutex>
#include <vector>

namespace CGAL::PowerRTF {

struct Multiplicative_weight_rule;

/// Sites that all have cells.
struct Owned_sites {
  std::vector<Site<double>> sites;
  std::vector<Vec3d> normals; ///< unit
  std::vector<int> patches;   ///< empty: all are of one

  void add(const Vec3d& point, const Vec3d& normal, double weight)
  {
    sites.push_back({point, weight});
    normals.push_back(normal);
  }
  Sites_arrays<double> arrays() const
  {
    Sites_arrays<double> a;
    a.sites = sites.data();
    a.normals = normals.data();
    a.patches = patches.empty() ? nullptr : patches.data();
    a.cells = a.sites_size = static_cast<int>(sites.size());
    return a;
  }
};

/// Cells in floating point: what `Tree_cells` constructs if nothing else is asked for.
struct Inexact_construction {
  explicit Inexact_construction(const Remeshing_options&) {}

  template <class Cells, class Sink>
  void operator()(Cells& cells, Sink&& sink) const
  {
    cells.construct_by_leaves(sink);
  }
};

/// Models `PowerRTFCells`. The sites should come in spatial order.
///
/// \tparam Backend a `Host_backend`
/// \tparam Construction constructs the cells, with the tree or without it
template <class Real, class Backend, class Construction = Inexact_construction>
class Tree_cells {
public:
  /// Keeps a reference to `backend`. `cos_angle`: the cosine of Theta; -2: all sites are
  /// compatible. `radius`: the largest first guess of the cells' radii.
  Tree_cells(Backend& backend, int max_sites, Real cos_angle, Real radius,
             const Remeshing_options& options)
      : m_backend(backend), m_cos_angle(cos_angle), m_guard_factor(Real(options.guard_factor)),
        m_construction(options), m_radii(max_sites, radius)
  {
    const Packed_tree_layout tree(max_sites);
    m_boxes.resize(tree.nodes());
    m_max_weights.resize(tree.nodes());
  }

  /// The arrays must live until the next call. They are read again by every construction.
  void set_sites(const Sites_arrays<Real>& in)
  {
    m_in = in;
    m_tree = Packed_tree_layout(in.sites_size);
    for (int level = 0; level < m_tree.levels; ++level)
      m_backend.for_each(m_tree.nodes(level), [&](int k) {
        refit_sites_node(m_tree, level, k, m_in.sites, m_boxes.data(), m_max_weights.data());
      });
  }
  /// The same sites with new weights.
  void set_weights(const Sites_arrays<Real>& in) { set_sites(in); }

  /// Constructs the cells of the current sites.
  void build(const Cell_outputs<Real>& out)
  {
    for_each_cell(
        [&](int i, Cell_status status, const auto& polygon, const Tangent_frame<Real>& frame) {
          write_cell(m_in, out, i, status, polygon, frame);
        });
  }

  /// Null: passes over the weights are the engine's.
  const int* start_weight_passes(const Sites_arrays<Real>&, Site<Real>*, const Real*,
                                 const Multiplicative_weight_rule&, int, const Cell_outputs<Real>&)
  {
    return nullptr;
  }

  /// Calls `sink(i, status, polygon, frame)` for each cell, concurrently.
  template <class Sink>
  void for_each_cell(Sink&& sink)
  {
    m_construction(*this, sink);
  }

  /// The neighbors of all cells.
  Neighbor_cycles neighbors()
  {
    constexpr int usual = 12;
    struct Cycle {
      int size, neighbors[usual];
    };
    internal::Unset_vector<Cycle> cycles(size());
    std::map<int, std::vector<int>> longer;
    std::mutex mutex; // of these
    for_each_cell([&](int i, Cell_status, const auto& polygon, const auto&) {
      const auto first = std::begin(polygon.neighbor);
      cycles[i].size = polygon.size;
      if (polygon.size <= usual) {
        std::copy(first, first + polygon.size, cycles[i].neighbors);
      } else {
        const std::lock_guard<std::mutex> lock(mutex);
        longer[i].assign(first, first + polygon.size);
      }
    });
    const auto cycle = [&](int i) {
      const int size = cycles[i].size;
      const int* const begin = size <= usual ? cycles[i].neighbors : longer.at(i).data();
      return Neighbor_cycles::Cycle(begin, begin + size);
    };
    return Neighbor_cycles(size(), cycle, m_backend.concurrency());
  }

  /// Distances of every cell's site to its nearest and to its sixth compatible neighbor.
  void neighbor_distances(Real* first, Real* sixth)
  {
    m_backend.for_each(m_in.cells, [&, v = view()](int i) {
      first[i] = distance_to_neighbor(v, i, 1, m_cos_angle);
      sixth[i] = distance_to_neighbor(v, i, 6, m_cos_angle);
    });
  }
  /// The same among all sites, of those with empty cells.
  void empty_cells_distances(const unsigned char* status, Real* first, Real* sixth)
  {
    m_backend.for_each(m_in.cells, [&, v = view()](int i) {
      if (Cell_status(status[i]) != Cell_status::empty) return;
      first[i] = distance_to_neighbor(v, i, 1);
      sixth[i] = distance_to_neighbor(v, i, 6);
    });
  }

  Sites_view<Real> view() const
  {
    return {m_in.sites, m_in.normals,   m_boxes.data(), m_max_weights.data(),
            m_tree,     m_guard_factor, m_in.patches};
  }
  Backend& backend() { return m_backend; }
  const Neighbor_lists<Real, Backend>& lists() const { return m_lists; }
  /// The number of cells: sites from there on only clip.
  int size() const { return m_in.cells; }
  Real cos_angle() const { return m_cos_angle; }

  /// `for_each_cell()` in floating point. `Filtered`: see `construct_cell()`.
  template <bool Filtered = false, class Sink>
  void construct_by_leaves(Sink&& sink)
  {
    constexpr int leaves_per_chunk = 32, arity = Packed_tree_layout::arity;
    const Sites_view<Real> v = view();
    if (!m_are_radii_known) guess_radii();
    m_lists.update(m_backend, v, size(), m_radii);
    m_backend.for_each_chunk(size(), leaves_per_chunk * arity, [&](int begin, int end) {
      std::vector<int> gathered;
      for (int leaf = begin; leaf < end; leaf += arity)
        construct_leaf<Filtered>(v, leaf, (std::min)(end, leaf + arity), gathered, sink);
    });
    m_lists.finish(m_backend);
  }

private:
  using Edge_polygon = typename Neighbor_lists<Real, Backend>::Edge_polygon;
  static constexpr Real growth = Real(1.1); // after a step the radii differ by a few per cent

  /// In proportion to the boxes of leaves, but no larger than the constructor's. A guess that is
  /// too small is doubled, cell by cell.
  void guess_radii()
  {
    constexpr Real share = Real(0.25) / growth, least = Real(1) / 16;
    m_backend.for_each(size(), [&](int i) {
      const Box3<Real>& box = m_boxes[i / Packed_tree_layout::arity];
      m_radii[i] *= std::clamp(share * length(box.hi - box.lo) / m_radii[i], least, Real(1));
    });
    m_are_radii_known = true;
  }

  /// Constructs the cells of one leaf, where the lists do not suffice from candidates gathered for
  /// all of them at once.
  template <bool Filtered, class Sink>
  void construct_leaf(const Sites_view<Real>& v, int begin, int end, std::vector<int>& gathered,
                      Sink& sink)
  {
    const int leaf = begin / Packed_tree_layout::arity;
    const auto near = m_lists.near_changes(leaf);
    Real gathered_radius = -1; // not gathered yet
    const auto gather = [&] {
      if (gathered_radius < 0) gathered_radius = gather_near_leaf(v, begin, end, gathered);
    };
    int misses = 0;
    for (int i = begin; i < end; ++i) {
      const Real listed_radius = m_lists.radius(v, i, near), radius = growth * m_radii[i];
      bool is_missed = radius > listed_radius, is_made = false;
      if constexpr (!Filtered) {
        Edge_polygon edges;
        const Tangent_frame<Real> frame(v.normals[i]);
        const auto is_cell = [&](Real max_radius, auto&& for_each_other) {
          return m_lists.is_cell(v, i, max_radius, m_cos_angle, frame, edges, for_each_other);
        };
        if (const Real edges_radius = radius_by_edges(v, i, frame, edges); edges_radius > 0) {
          is_missed = edges_radius > listed_radius;
          if (is_missed) gather();
          is_made =
              is_missed
                  ? is_cell(gathered_radius,
                            [&](auto&& f) { std::for_each(gathered.begin(), gathered.end(), f); })
                  : is_cell(listed_radius, [&](auto&& f) { m_lists.for_each_but_edges(i, f); });
          if (is_made) {
            m_radii[i] = edges_radius;
            sink(i, Cell_status::ok, edges.polygon, frame);
          }
        }
      }
      misses += is_missed;
      if (is_made) continue;
      const auto candidates = [&](Real wanted, auto&& f) {
        if (wanted <= listed_radius) return m_lists.for_each(i, f);
        gather();
        if (wanted <= gathered_radius) {
          for (const int j : gathered) f(j);
          return;
        }
        const Site<Real>& site = m_in.sites[i];
        for_each_possible_neighbor(v, Box3<Real>{site.point, site.point}, site.weight, wanted, f);
      };
      construct_cell<Filtered>(v, i, radius, m_cos_angle, candidates,
                               [&](int site, Cell_status status,
                                   const Tangent_polygon<Real>& polygon,
                                   const Tangent_frame<Real>& frame, auto... certain) {
                                 if (status == Cell_status::ok) {
                                   m_radii[site] = std::sqrt(polygon.squared_radius());
                                   m_lists.set_edges(site, polygon);
                                 }
                                 sink(site, status, polygon, frame, certain...);
                               });
    }
    m_lists.set_misses(leaf, misses);
  }

  /// The radius of the polygon that the cell's former edges make now; 0 if they make none, or one
  /// that is much larger than the cell was.
  Real radius_by_edges(const Sites_view<Real>& v, int i, const Tangent_frame<Real>& frame,
                       Edge_polygon& edges) const
  {
    constexpr Real rounded_up = 1 + 4 * internal::epsilon<Real>(), most = 4;
    if (!m_lists.chain_edges(v, i, m_cos_angle, frame, edges)) return 0;
    const Real radius = rounded_up * std::sqrt(edges.squared_radius);
    return radius < most * m_radii[i] ? radius : 0;
  }

  /// Finds the sites that may cut the cells of a leaf. \returns the radius up to which the cells
  /// may be as large
  Real gather_near_leaf(const Sites_view<Real>& v, int begin, int end,
                        std::vector<int>& gathered) const
  {
    Real radius = 0, min_weight = std::numeric_limits<Real>::infinity();
    for (int i = begin; i < end; ++i) {
      Edge_polygon edges; // weights may have made it larger than it was
      radius = (std::max)({radius, growth * m_radii[i],
                           radius_by_edges(v, i, Tangent_frame<Real>(v.normals[i]), edges)});
      min_weight = (std::min)(min_weight, m_in.sites[i].weight);
    }
    gathered.clear();
    for_each_possible_neighbor(v, m_boxes[begin / Packed_tree_layout::arity], min_weight, radius,
                               [&](int j) { gathered.push_back(j); });
    return radius;
  }

  Backend& m_backend;
  Real m_cos_angle, m_guard_factor;
  Construction m_construction;
  Sites_arrays<Real> m_in;
  Packed_tree_layout m_tree;
  std::vector<Box3<Real>> m_boxes;
  std::vector<Real> m_max_weights;
  std::vector<Real> m_radii;      // of the last construction: the next one's guess
  bool m_are_radii_known = false; // or first guesses
  Neighbor_lists<Real, Backend> m_lists;
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_TREE_CELLS_H
