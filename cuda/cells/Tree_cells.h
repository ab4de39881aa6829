// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The cells by the functors that all engines share, one thread per cell over a packed tree of the
// sites: the plain version that the tuned kernels are compared with, on the host and on the device.
#ifndef CGAL_POWER_RTF_CUDA_TREE_CELLS_H
#define CGAL_POWER_RTF_CUDA_TREE_CELLS_H

#include "cell_arrays.h"

#include <CGAL/PowerRTF/cells/cell_moments.h>
#include <CGAL/PowerRTF/cells/clip_at_features.h>
#include <CGAL/PowerRTF/cells/construct_cell.h>

#include <cmath>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

/// The sites as the shared functors see them, without a tree: enough for what follows a search.
template <class Real>
CGAL_POWER_RTF_HD inline Sites_view<Real> view_without_tree(const Sites_arrays<Real>& in)
{
  Sites_view<Real> view;
  view.sites = in.sites;
  view.normals = in.normals;
  view.patches = in.patches;
  return view;
}

/// Cuts a cell's polygon at the boundary of its patch and writes what it says where `out` asks for
/// it.
template <class Real>
CGAL_POWER_RTF_HD inline void
write_cell(const Sites_arrays<Real>& in, const Cell_outputs<Real>& out, int i, Cell_status status,
           const Tangent_polygon<Real>& whole, const Tangent_frame<Real>& frame)
{
  Tangent_polygon<Real> polygon = whole;
  if (in.next) clip_at_features(view_without_tree(in), i, in.next, in.previous, frame, polygon);
  const Cell_moments<Real> m = cell_moments(polygon, i, [&](int j) { return in.density_root[j]; });
  if (out.area) out.area[i] = m.area;
  if (out.mass) out.mass[i] = m.mass;
  if (out.offset) out.offset[i] = frame.u * m.x + frame.v * m.y;
  if (out.status) out.status[i] = static_cast<unsigned char>(status);
  if (!out.edge_count) return;
  int count = 0;
  for (int k = 0; k < polygon.size && count < out.edge_capacity; ++k) {
    const int j = polygon.neighbor[k], l = polygon.next(k);
    if (j < 0) continue;
    const Vec3<Real> offset = in.sites[j].point - in.sites[i].point;
    const Real a = dot(offset, frame.u), b = dot(offset, frame.v);
    const Real x = polygon.x[l] - polygon.x[k], y = polygon.y[l] - polygon.y[k];
    out.edge_neighbor[std::size_t(count) * in.cells + i] = j;
    out.edge_ratio[std::size_t(count++) * in.cells + i] =
        std::sqrt((x * x + y * y) / (a * a + b * b));
  }
  out.edge_count[i] = count;
}

template <class Real, class Backend>
class Tree_cells
{
public:
  /// `cos_angle`: the cosine of Theta; -2: all sites are compatible.
  Tree_cells(Backend& backend, int max_sites, Real cos_angle, Real guard_factor)
      : m_backend(backend), m_cos_angle(cos_angle), m_guard_factor(guard_factor)
  {
    const Packed_tree_layout tree(max_sites);
    m_boxes.allocate(backend, tree.nodes());
    m_max_weights.allocate(backend, tree.nodes());
    m_radii.allocate(backend, max_sites);
  }

  void set_sites(const Sites_arrays<Real>& in)
  {
    const bool is_new = in.cells != m_in.cells;
    m_in = in;
    refit();
    if (is_new) neighbor_distances(false, nullptr, m_radii.data()); // a first guess
  }
  void set_weights(const Sites_arrays<Real>& in)
  {
    m_in = in;
    refit();
  }

  void build(const Cell_outputs<Real>& out)
  {
    const Sites_arrays<Real> in = m_in;
    for_each_cell(0, in.cells,
                  [=] CGAL_POWER_RTF_HD(int i, Cell_status status,
                                        const Tangent_polygon<Real>& polygon,
                                        const Tangent_frame<Real>& frame) {
                    write_cell(in, out, i, status, polygon, frame);
                  });
  }

  /// Distances of every cell's site to its nearest and to its sixth neighbour.
  void neighbor_distances(bool compatible, Real* first, Real* sixth)
  {
    const Sites_view<Real> v = view();
    const Real cos_angle = compatible ? m_cos_angle : Real(-2);
    m_backend.for_each(m_in.cells, [=] CGAL_POWER_RTF_HD(int i) {
      if (first) first[i] = distance_to_neighbor(v, i, 1, cos_angle);
      if (sixth) sixth[i] = distance_to_neighbor(v, i, 6, cos_angle);
    });
  }

  /// Cells [begin, end) in full; cell i at [64 (i - begin)].
  void polygons(int begin, int end, int* size, Real* x, Real* y, int* neighbor,
                unsigned char* status)
  {
    constexpr int stride = Tangent_polygon<Real>::capacity;
    for_each_cell(begin, end,
                  [=] CGAL_POWER_RTF_HD(int i, Cell_status s, const Tangent_polygon<Real>& polygon,
                                        const Tangent_frame<Real>&) {
                    size[i - begin] = polygon.size;
                    status[i - begin] = static_cast<unsigned char>(s);
                    for (int k = 0; k < polygon.size; ++k) {
                      const std::size_t place = std::size_t(i - begin) * stride + k;
                      x[place] = polygon.x[k];
                      y[place] = polygon.y[k];
                      neighbor[place] = polygon.neighbor[k];
                    }
                  });
  }

  Sites_view<Real> view() const
  {
    Sites_view<Real> v;
    v.sites = m_in.sites;
    v.normals = m_in.normals;
    v.boxes = m_boxes.data();
    v.max_weights = m_max_weights.data();
    v.tree = Packed_tree_layout(m_in.sites_size);
    v.guard_factor = m_guard_factor;
    v.patches = m_in.patches;
    return v;
  }

  void refit()
  {
    const Packed_tree_layout tree(m_in.sites_size);
    const Site<Real>* const sites = m_in.sites;
    Box3<Real>* const boxes = m_boxes.data();
    Real* const max_weights = m_max_weights.data();
    for (int level = 0; level < tree.levels; ++level)
      m_backend.for_each(tree.nodes(level), [=] CGAL_POWER_RTF_HD(int k) {
        refit_sites_node(tree, level, k, sites, boxes, max_weights);
      });
  }

  template <class Sink>
  void for_each_cell(int begin, int end, Sink sink)
  {
    const Sites_view<Real> v = view();
    const Real cos_angle = m_cos_angle;
    Real* const radii = m_radii.data();
    m_backend.for_each(end - begin, [=] CGAL_POWER_RTF_HD(int k) {
      const int i = begin + k;
      const auto candidates = [&](Real radius, auto&& f) {
        for_each_possible_neighbor(v, Box3<Real>{v.sites[i].point, v.sites[i].point},
                                   v.sites[i].weight, radius, f);
      };
      construct_cell(v, i, Real(1.1) * radii[i], cos_angle, candidates,
                     [&](int site, Cell_status status, const Tangent_polygon<Real>& polygon,
                         const Tangent_frame<Real>& frame) {
                       if (status == Cell_status::ok)
                         radii[site] = std::sqrt(polygon.squared_radius());
                       sink(site, status, polygon, frame);
                     });
    });
  }

private:
  Backend& m_backend;
  Real m_cos_angle, m_guard_factor;
  Sites_arrays<Real> m_in;
  typename Backend::template Buffer<Box3<Real>> m_boxes;
  typename Backend::template Buffer<Real> m_max_weights, m_radii;
};

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_TREE_CELLS_H
