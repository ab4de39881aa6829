// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The engine of all traits: takes a surface and its samples to an `Engine_base`, where everything
// stays until the final samples are asked for.
#ifndef CGAL_POWER_RTF_ENGINES_SURFACE_ENGINE_H
#define CGAL_POWER_RTF_ENGINES_SURFACE_ENGINE_H

#include <CGAL/PowerRTF/engines/Engine_base.h>
#include <CGAL/PowerRTF/features/feature_samples.h>
#include <CGAL/PowerRTF/geometry/Facet_tree.h>
#include <CGAL/PowerRTF/geometry/Spatial_order.h>
#include <CGAL/PowerRTF/geometry/Surface.h>
#include <CGAL/PowerRTF/geometry/vertex_facets.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF {
namespace internal {

/// The surface in the order of its trees.
class Surface_packer {
public:
  Surface_packer(const Surface& surface, const Facet_tree& tree, const Remeshing_options& options)
      : m_facets(tree.view())
  {
    const std::vector<int> vertices = spatial_order(surface.points);
    std::vector<int> vertex_places(vertices.size());
    for (std::size_t k = 0; k < vertices.size(); ++k) vertex_places[vertices[k]] = int(k);

    const std::size_t facets = surface.triangles.size();
    m_result.facets.resize(facets);
    m_result.has_patches = m_facets.patches != nullptr;
    for (std::size_t k = 0; k < facets; ++k) {
      const auto& from = m_facets.facets[k];
      auto& to = m_result.facets[k];
      to.corners[0] = from.a;
      to.corners[1] = from.b;
      to.corners[2] = from.c;
      to.normal = m_facets.normals[k];
      for (int c = 0; c < 3; ++c) to.vertices[c] = vertex_places[surface.triangles[from.id][c]];
      to.patch = m_facets.patches ? m_facets.patches[k] : 0;
    }
    m_result.facet_nodes.assign(m_facets.nodes, m_facets.nodes + m_facets.tree.nodes());
    for (const int v : vertices)
      m_result.vertices.push_back(
          {surface.points[v], surface.vertex_normals[v], surface.vertex_density[v]});
    m_result.area = surface.area;
    if (options.projection == Projection::nearest_vertices ||
        options.attributes == Attributes::nearest_vertices)
      add_vertex_tree(surface, vertices);
  }

  const Packed_surface& result() const { return m_result; }

private:
  void add_vertex_tree(const Surface& surface, const std::vector<int>& vertices)
  {
    const Packed_tree_layout tree(static_cast<int>(vertices.size()));
    std::vector<Box3<double>> boxes(tree.nodes());
    m_result.vertex_nodes.resize(tree.nodes());
    for (int level = 0; level < tree.levels; ++level)
      for (int k = 0; k < tree.nodes(level); ++k) {
        const int begin = tree.children_begin(k), end = tree.children_end(level, k);
        const int node = tree.first[level] + k;
        for (int c = begin; c < end; ++c) {
          const Vec3d* const p = level == 0 ? &surface.points[vertices[c]] : nullptr;
          const Box3<double> box = p ? Box3<double>{*p, *p} : boxes[tree.first[level - 1] + c];
          m_result.vertex_nodes[node].set(c - begin, box);
          if (c > begin)
            boxes[node].add(box);
          else
            boxes[node] = box;
        }
        for (int c = end - begin; c < Child_boxes::size; ++c) // unused
          m_result.vertex_nodes[node].set(c, boxes[node]);
      }
    const Vertex_facets around = vertex_facets(surface);
    m_result.first_facet.push_back(0);
    for (const int v : vertices) {
      for (int k = around.first[v]; k < around.first[v + 1]; ++k)
        m_result.vertex_facets.push_back(m_facets.places[around.facet[k]]);
      m_result.first_facet.push_back(static_cast<int>(m_result.vertex_facets.size()));
    }
  }

  Facets_view<double> m_facets;
  Packed_surface m_result;
};

} // namespace internal

/// \cgalModels `PowerRTFEngine`
///
/// \tparam Maker `Maker::check(options)` throws what keeps the engine from working;
/// `Maker::make(packed_surface, options)` returns a `std::unique_ptr<Engine_base>`.
template <class Maker>
class Surface_engine {
public:
  /// Keeps a reference to `surface`.
  Surface_engine(const Surface& surface, const Remeshing_options& options)
      : m_options(options), m_surface(surface)
  {
    Maker::check(options);
  }

  void set_samples(const Samples& samples, const Feature_samples& features = {});
  void build_cells() { m_engine->build_cells(); }
  bool optimize_weights(int passes) { return m_engine->optimize_weights(passes); }
  bool newton_weights() { return m_engine->newton_weights(); }
  void clear_weights() { m_engine->clear_weights(); }
  void move_samples(Position_method method) { m_engine->move_samples(method); }
  void restore_best() { m_engine->restore_best(); }

  Capacity_statistics capacity() const { return m_engine->summary().capacity; }
  Cell_counts cell_counts() const
  {
    const Cell_summary s = m_engine->summary();
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
    return std::sqrt(m_engine->summary().displacement / m_surface.area);
  }
  std::size_t constructions() const { return m_engine->constructions(); }

  Samples samples() const { return gather(m_size); }
  Samples sites() const { return gather(m_sites); }
  std::vector<Cell_polygon> cells() { return m_engine->cells(); }
  double epsilon() const { return m_engine->epsilon(); }
  Device_report device_report() const { return m_engine->device_report(); }
  const Facet_tree& facet_tree()
  {
    if (!m_tree)
      m_tree = std::make_unique<Facet_tree>(m_surface.points, m_surface.triangles,
                                            m_surface.facet_patches);
    return *m_tree;
  }

private:
  Samples gather(std::size_t count) const;

  Remeshing_options m_options;
  const Surface& m_surface;
  std::unique_ptr<Facet_tree> m_tree;
  std::unique_ptr<Engine_base> m_engine;
  std::size_t m_size = 0, m_sites = 0; // cells; and with the feature samples' sites
};

template <class Maker>
void Surface_engine<Maker>::set_samples(const Samples& samples, const Feature_samples& features)
{
  const Facets_view<double> facets = facet_tree().view();
  if (!m_engine) // only now the surface's normals and density are what they will be
    m_engine = Maker::make(internal::Surface_packer(m_surface, facet_tree(), m_options).result(),
                           m_options);
  m_size = samples.size();
  const Samples sites = joined(samples, features.sites);
  m_sites = sites.size();
  Engine_samples to;
  to.points = sites.points;
  to.normals = sites.normals;
  to.density = sites.density;
  for (const int f : sites.facets) to.facets.push_back(facets.places[f]);
  if (!m_surface.facet_patches.empty())
    for (const int f : sites.facets) to.patches.push_back(m_surface.facet_patches[f]);
  to.cells = static_cast<int>(m_size);
  if (features.sites.size() > 0) {
    to.next.assign(sites.size(), -1);
    for (std::size_t k = 0; k < features.next.size(); ++k)
      to.next[m_size + k] = static_cast<int>(m_size) + features.next[k];
  }
  m_engine->set_samples(to);
}

template <class Maker>
Samples Surface_engine<Maker>::gather(std::size_t count) const
{
  const Engine_samples from = m_engine->samples();
  const auto first = [&](const auto& items) {
    return std::decay_t<decltype(items)>(items.begin(),
                                         items.begin() + (items.empty() ? 0 : count));
  };
  Samples to;
  to.points = first(from.points);
  to.normals = first(from.normals);
  to.density = first(from.density);
  to.weights = first(from.weights);
  to.patches = first(from.patches);
  const Facets_view<double> facets = m_tree->view();
  for (std::size_t i = 0; i < count; ++i) to.facets.push_back(facets.facets[from.facets[i]].id);
  return to;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_SURFACE_ENGINE_H
