// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine of the CUDA traits: prepares the surface and the samples for the device, where
// everything stays until the final samples are asked for.
#ifndef CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_H
#define CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_H

#include <CGAL/PowerRTF/cells/cell_moments.h>
#include <CGAL/PowerRTF/engines/Cell_polygon.h>
#include <CGAL/PowerRTF/engines/Cuda_engine_api.h>
#include <CGAL/PowerRTF/engines/Facet_tree.h>
#include <CGAL/PowerRTF/engines/Spatial_order.h>
#include <CGAL/PowerRTF/surface/Surface.h>
#include <CGAL/PowerRTF/surface/feature_samples.h>
#include <CGAL/PowerRTF/surface/vertex_facets.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace internal
{

/// The surface in the order of its trees, and the place of each facet there.
class Device_surface_order
{
public:
  Device_surface_order(const Surface& surface, const Remeshing_options& options)
  {
    const Facet_tree tree(surface.points, surface.triangles, surface.facet_patches);
    const Facets_view<double> view = tree.view();
    const std::vector<int> vertices = spatial_order(surface.points);
    std::vector<int> vertex_places(vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) vertex_places[vertices[k]] = int(k);

    const std::size_t facets = surface.triangles.size();
    m_places.assign(view.places, view.places + facets);
    m_input.facets.resize(facets);
    m_input.has_patches = view.patches != nullptr;
    for (std::size_t k = 0; k < facets; ++k) {
      const auto& from = view.facets[k];
      auto& to = m_input.facets[k];
      m_facets.push_back(from.id);
      to.corners[0] = from.a;
      to.corners[1] = from.b;
      to.corners[2] = from.c;
      to.normal = view.normals[k];
      for (int c = 0; c < 3; ++c) to.vertices[c] = vertex_places[surface.triangles[from.id][c]];
      to.patch = view.patches ? view.patches[k] : 0;
    }
    m_input.facet_nodes.assign(view.nodes, view.nodes + view.tree.nodes());
    for (const int v : vertices)
      m_input.vertices.push_back(
          {surface.points[v], surface.vertex_normals[v], surface.vertex_density[v]});
    m_input.area = surface.area;
    if (options.projection == Projection::nearest_vertices ||
        options.attributes == Attributes::nearest_vertices)
      add_vertex_tree(surface, vertices);
  }

  const Device_surface_input& input() const { return m_input; }
  int place(int facet) const { return m_places[facet]; }
  int facet(int place) const { return m_facets[place]; }

private:
  void add_vertex_tree(const Surface& surface, const std::vector<int>& vertices)
  {
    const Packed_tree_layout tree(static_cast<int>(vertices.size()));
    std::vector<Box3<double>> boxes(tree.nodes());
    m_input.vertex_nodes.resize(tree.nodes());
    for (int level = 0; level < tree.levels; ++level)
      for (int k = 0; k < tree.nodes(level); ++k) {
        const int begin = tree.children_begin(k), end = tree.children_end(level, k);
        const int node = tree.first[level] + k;
        for (int c = begin; c < end; ++c) {
          const Vec3d* const p = level == 0 ? &surface.points[vertices[c]] : nullptr;
          const Box3<double> box = p ? Box3<double>{*p, *p} : boxes[tree.first[level - 1] + c];
          m_input.vertex_nodes[node].set(c - begin, box);
          if (c > begin)
            boxes[node].add(box);
          else
            boxes[node] = box;
        }
        for (int c = end - begin; c < Child_boxes::size; ++c) // unused
          m_input.vertex_nodes[node].set(c, boxes[node]);
      }
    const Vertex_facets around = vertex_facets(surface);
    m_input.first_facet.push_back(0);
    for (const int v : vertices) {
      for (int k = around.first[v]; k < around.first[v + 1]; ++k)
        m_input.vertex_facets.push_back(m_places[around.facet[k]]);
      m_input.first_facet.push_back(static_cast<int>(m_input.vertex_facets.size()));
    }
  }

  Device_surface_input m_input;
  std::vector<int> m_places, m_facets;
};

} // namespace internal

/// \cgalModels `PowerRTFEngine`
///
/// \tparam Maker makes the engine on the device: `Make_cuda_engine`.
///
/// The methods are those of `Host_engine`.
template <class Maker>
class Device_engine_adaptor
{
public:
  /// Keeps a reference to `surface`. \throws Cuda_error when no GPU can be used
  Device_engine_adaptor(const Surface& surface, const Remeshing_options& options)
      : m_options(options), m_surface(surface)
  {
    Maker::check(options);
  }

  void set_samples(const Samples& samples, const Feature_samples& features = {});
  void build_cells() { m_device->build_cells(); }
  void update_weights() { m_device->update_weights(); }
  /// Passes of the paper's rule until all capacities are inside the interval, at most `passes`.
  /// Returns whether they are.
  bool optimize_weights(int passes) { return m_device->optimize_weights(passes); }
  bool newton_weights() { return m_device->newton_weights(); }
  void clear_weights() { m_device->clear_weights(); }
  void move_samples(Position_method method) { m_device->move_samples(method); }
  void restore_best() { m_device->restore_best(); }

  Capacity_statistics capacity() const { return m_device->summary().capacity; }
  Cell_counts cell_counts() const
  {
    const Device_summary s = m_device->summary();
    const auto count = [&](Cell_status status) { return std::size_t(s.counts[int(status)]); };
    Cell_counts counts;
    counts.ok = count(Cell_status::ok);
    counts.guarded = count(Cell_status::guarded);
    counts.empty = count(Cell_status::empty);
    counts.incomplete = count(Cell_status::incomplete);
    return counts;
  }
  double displacement() const
  {
    return std::sqrt(m_device->summary().displacement / m_surface.area);
  }
  std::size_t constructions() const { return m_device->constructions(); }

  Samples samples() const { return download(m_size); }
  /// The samples and the feature samples' sites, as the device has them.
  Samples sites() const { return download(m_sites); }
  std::vector<Cell_polygon> cells();

  /// Name, time and memory of the device.
  Device_report device_report() const
  {
    return {m_device->device_name(), m_device->seconds(), m_device->bytes()};
  }

private:
  Samples download(std::size_t count) const;

  Remeshing_options m_options;
  const Surface& m_surface;
  std::unique_ptr<internal::Device_surface_order> m_order;
  std::unique_ptr<Device_engine_base> m_device;
  std::size_t m_size = 0, m_sites = 0; // cells; and with the feature samples' sites
};

template <class Maker>
void Device_engine_adaptor<Maker>::set_samples(const Samples& samples,
                                               const Feature_samples& features)
{
  if (!m_device) { // only now the surface's normals and density are what they will be
    m_order = std::make_unique<internal::Device_surface_order>(m_surface, m_options);
    m_device = Maker::make(m_order->input(), m_options);
  }
  m_size = samples.size();
  const Samples sites = joined(samples, features.sites);
  m_sites = sites.size();
  Device_samples to;
  to.points = sites.points;
  to.normals = sites.normals;
  to.density = sites.density;
  for (const int f : sites.facets) to.facets.push_back(m_order->place(f));
  if (!m_surface.facet_patches.empty())
    for (const int f : sites.facets) to.patches.push_back(m_surface.facet_patches[f]);
  to.cells = static_cast<int>(m_size);
  if (features.sites.size() > 0) {
    to.next.assign(sites.size(), -1);
    for (std::size_t k = 0; k < features.next.size(); ++k)
      to.next[m_size + k] = static_cast<int>(m_size) + features.next[k];
  }
  m_device->set_samples(to);
}

template <class Maker>
Samples Device_engine_adaptor<Maker>::download(std::size_t count) const
{
  const Device_samples from = m_device->samples();
  Samples to;
  for (std::size_t i = 0; i < count; ++i) {
    to.points.push_back(from.points[i]);
    to.normals.push_back(from.normals[i]);
    to.density.push_back(from.density[i]);
    to.weights.push_back(from.weights[i]);
    to.facets.push_back(m_order->facet(from.facets[i]));
    if (!from.patches.empty()) to.patches.push_back(from.patches[i]);
  }
  return to;
}

template <class Maker>
std::vector<Cell_polygon> Device_engine_adaptor<Maker>::cells()
{
  constexpr int chunk = 1 << 16;
  const Samples sites = samples();
  std::vector<Cell_polygon> cells(m_size);
  for (int begin = 0; begin < int(m_size); begin += chunk) {
    const int end = (std::min)(begin + chunk, int(m_size));
    const Device_polygons p = m_device->polygons(begin, end);
    for (int i = begin; i < end; ++i) {
      Cell_polygon& cell = cells[i];
      const Tangent_frame<double> frame(sites.normals[i]);
      Tangent_polygon<double> polygon;
      polygon.size = p.size[i - begin];
      for (int k = 0; k < polygon.size; ++k) {
        const std::size_t place = std::size_t(i - begin) * Device_polygons::stride + k;
        polygon.x[k] = p.x[place];
        polygon.y[k] = p.y[place];
        polygon.neighbor[k] = p.neighbor[place];
        cell.vertices.push_back(sites.points[i] + frame.u * polygon.x[k] + frame.v * polygon.y[k]);
        cell.neighbors.push_back(polygon.neighbor[k]);
      }
      cell.area = cell_moments(polygon).area;
      cell.density = sites.density[i];
      cell.mass = cell.area * cell.density;
      cell.weight = sites.weights[i];
      cell.status = static_cast<Cell_status>(p.status[i - begin]);
    }
  }
  return cells;
}

/// Engines on a GPU that compute their cells in `Real`: `float` or `double`.
template <class Real>
struct Make_cuda_engine {
  static void check(const Remeshing_options& options)
  {
    const std::vector<Cuda_device> devices = cuda_devices();
    if (options.device < 0 || options.device >= int(devices.size()))
      throw Cuda_error("there is no GPU number " + std::to_string(options.device) +
                       ": this machine has " + std::to_string(devices.size()));
  }
  static std::unique_ptr<Device_engine_base> make(const Device_surface_input& surface,
                                                  const Remeshing_options& options)
  {
    return make_cuda_engine(surface, options,
                            sizeof(Real) == sizeof(float) ? Cuda_precision::single_precision
                                                          : Cuda_precision::double_precision);
  }
};

/// \ingroup PkgPowerRTFTraits
/// Cells on an NVIDIA GPU, in the precision `Real`.
///
/// \cgalModels `PowerRTFEngine`
template <class Real = float>
using Cuda_engine = Device_engine_adaptor<Make_cuda_engine<Real>>;

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_H
