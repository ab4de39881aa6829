// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The member functions of `Device_engine` that take the samples to the device and back, and the
// cells from there.
#ifndef CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_SAMPLES_H
#define CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_SAMPLES_H

#include "Device_engine.h"
#include "morton_code.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{
namespace device
{

template <class R, class B, class C>
void Device_engine<R, B, C>::set_samples(const Device_samples& samples)
{
  m_cells = samples.cells;
  m_size = int(samples.size());
  const std::size_t n = m_cells, m = m_size;
  for (Buffer<R>* b : {&m_density, &m_density_root}) b->allocate(m_backend, m);
  for (Buffer<R>* b : {&m_area, &m_mass, &m_nearest, &m_sixth, &m_weights_before})
    b->allocate(m_backend, n);
  m_sites.allocate(m_backend, m);
  m_normals.allocate(m_backend, m);
  m_facets.allocate(m_backend, m);
  m_has_patches = !samples.patches.empty();
  if (m_has_patches) m_patches.allocate(m_backend, m);
  m_offset.allocate(m_backend, n);
  m_step.allocate(m_backend, n);
  m_status.allocate(m_backend, n);
  if (m_options.position_method == Position_method::lbfgs) {
    if (has_short_memory())
      m_lbfgs.resize(m_cells, m_options.lbfgs_memory);
    else
      m_long_lbfgs.resize(m_cells, m_options.lbfgs_memory);
    m_best.sites.allocate(m_backend, m);
    m_best.facets.allocate(m_backend, m);
  }
  m_best.residual = std::numeric_limits<double>::infinity();
  m_cell_builder.reset(new C(m_backend, m_size, m_cos_angle, R(m_options.guard_factor)));
  m_constructions = 0;
  m_mean_mass = 0;
  sort(samples);
  m_backend.start_clock();
  update_attributes();
}

/// The samples with cells along a space-filling curve.
template <class R, class B, class C>
void Device_engine<R, B, C>::sort(const Device_samples& samples)
{
  const int n = m_cells, m = m_size;
  const auto real_sites = [&]() {
    std::vector<Site<R>> sites(m);
    for (int i = 0; i < m; ++i) sites[i] = {to_real<R>(samples.points[i]), R(0)};
    return sites;
  };
  std::vector<Site<R>> sites = real_sites();
  m_backend.upload(m_sites.data(), sites.data(), m);
  Buffer<std::uint64_t> keys;
  Buffer<int> order;
  keys.allocate(m_backend, n);
  order.allocate(m_backend, n);
  std::uint64_t* const key = keys.data();
  const Site<R>* const at = m_sites.data();
  m_backend.for_each(n, [=] CGAL_POWER_RTF_HD(int i) { key[i] = morton_code(at[i].point); });
  m_backend.sort_order(n, key, order.data());
  m_order.resize(m);
  std::iota(m_order.begin(), m_order.end(), 0);
  m_backend.download(m_order.data(), order.data(), n);

  std::vector<int> facets(m), patches;
  std::vector<Vec3<R>> normals(m);
  std::vector<R> density(m);
  for (int i = 0; i < m; ++i) {
    const int k = m_order[i];
    sites[i] = {to_real<R>(samples.points[k]), R(0)};
    facets[i] = samples.facets[k];
    normals[i] = to_real<R>(samples.normals[k]);
    density[i] = R(samples.density[k]);
    if (m_has_patches) patches.push_back(samples.patches[k]);
  }
  m_backend.upload(m_sites.data(), sites.data(), m);
  m_backend.upload(m_facets.data(), facets.data(), m);
  m_backend.upload(m_normals.data(), normals.data(), m);
  m_backend.upload(m_density.data(), density.data(), m);
  if (m_has_patches) m_backend.upload(m_patches.data(), patches.data(), m);
  if (m > n) upload_boundaries(samples);
  const Attribute_rule<R> rule = attribute_rule();
  m_backend.for_each(
      m, [=] CGAL_POWER_RTF_HD(int i) { rule.density_root[i] = rule.root(rule.density[i]); });
}

/// The sites that only clip are not sorted, so that their numbers stay.
template <class R, class B, class C>
void Device_engine<R, B, C>::upload_boundaries(const Device_samples& samples)
{
  std::vector<int> previous(m_size, -1);
  for (int i = 0; i < m_size; ++i)
    if (samples.next[i] >= 0) previous[samples.next[i]] = i;
  m_next.allocate(m_backend, m_size);
  m_previous.allocate(m_backend, m_size);
  m_backend.upload(m_next.data(), samples.next.data(), m_size);
  m_backend.upload(m_previous.data(), previous.data(), m_size);
}

template <class R, class B, class C>
Device_samples Device_engine<R, B, C>::samples()
{
  Device_samples s;
  s.cells = m_cells;
  s.order = m_order;
  std::vector<Site<R>> sites(m_size);
  std::vector<Vec3<R>> normals(m_size);
  std::vector<R> density(m_size);
  s.facets.resize(m_size);
  m_backend.download(sites.data(), m_sites.data(), m_size);
  m_backend.download(normals.data(), m_normals.data(), m_size);
  m_backend.download(density.data(), m_density.data(), m_size);
  m_backend.download(s.facets.data(), m_facets.data(), m_size);
  if (m_has_patches) {
    s.patches.resize(m_size);
    m_backend.download(s.patches.data(), m_patches.data(), m_size);
  }
  for (int i = 0; i < m_size; ++i) {
    s.points.push_back(to_double(sites[i].point));
    s.weights.push_back(sites[i].weight);
    s.normals.push_back(to_double(normals[i]));
    s.density.push_back(density[i]);
  }
  return s;
}

template <class R, class B, class C>
Device_polygons Device_engine<R, B, C>::polygons(int begin, int end)
{
  const std::size_t n = end - begin, most = n * Device_polygons::stride;
  Buffer<R> x, y;
  Buffer<int> size, neighbor;
  Buffer<unsigned char> status;
  for (Buffer<R>* b : {&x, &y}) b->allocate(m_backend, most);
  size.allocate(m_backend, n);
  neighbor.allocate(m_backend, most);
  status.allocate(m_backend, n);
  m_cell_builder->polygons(begin, end, size.data(), x.data(), y.data(), neighbor.data(),
                           status.data());
  Device_polygons p;
  p.size.resize(n);
  p.neighbor.resize(most);
  p.status.resize(n);
  m_backend.download(p.size.data(), size.data(), n);
  m_backend.download(p.neighbor.data(), neighbor.data(), most);
  m_backend.download(p.status.data(), status.data(), n);
  std::vector<R> numbers(most);
  m_backend.download(numbers.data(), x.data(), most);
  p.x.assign(numbers.begin(), numbers.end());
  m_backend.download(numbers.data(), y.data(), most);
  p.y.assign(numbers.begin(), numbers.end());
  return p;
}

} // namespace device
} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_DEVICE_ENGINE_SAMPLES_H
