// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sites on a torus, uniform or with a density, relaxed by Lloyd's method on the device: input for
// tests and benchmarks of the cells alone, of any size and regularity, without a mesh.
#ifndef CGAL_POWER_RTF_CUDA_TORUS_SITES_H
#define CGAL_POWER_RTF_CUDA_TORUS_SITES_H

#include "../backend/Cuda_backend.h"
#include <CGAL/PowerRTF/cells/Cell_arrays.h>
#include <CGAL/PowerRTF/geometry/hilbert_code.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <thread>
#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF::device {

/// Around the z axis, in the unit box.
template <class Real>
struct Torus {
  double ring = 0.3, tube = 0.15;
  double contrast = 1; ///< largest spacing over smallest

  CGAL_POWER_RTF_HD Vec3d normal(const Vec3d& p) const
  {
    const double l = std::sqrt(p.x * p.x + p.y * p.y), s = l > 0 ? ring / l : 0;
    return normalized(Vec3d{p.x - s * p.x, p.y - s * p.y, p.z});
  }
  CGAL_POWER_RTF_HD Vec3d project(const Vec3d& p) const
  {
    const double l = std::sqrt(p.x * p.x + p.y * p.y), s = l > 0 ? ring / l : 0;
    return Vec3d{s * p.x, s * p.y, 0} + normal(p) * tube;
  }
  /// rho: 1 / spacing^2, largest at one side of the torus.
  CGAL_POWER_RTF_HD double density(const Vec3d& p) const
  {
    const double t = (p.x / (ring + tube) + 1) / 2; // 0 .. 1
    const double spacing = std::exp(-std::log(contrast) * t);
    return 1 / (spacing * spacing);
  }
  CGAL_POWER_RTF_HD Real density_root(const Vec3d& p) const
  {
    return Real(std::cbrt(density(p) / density({0, 0, 0}) * density(p) / density({0, 0, 0})));
  }
};

template <class Real>
struct Host_sites {
  std::vector<Site<Real>> sites;
  std::vector<Vec3<Real>> normals;
  std::vector<Real> density_root;
};

/// `n` random sites with probabilities proportional to the density; the same for any number of
/// threads.
template <class Real>
Host_sites<Real> random_torus_sites(const Torus<Real>& torus, int n, unsigned seed)
{
  constexpr int chunks = 64;
  constexpr double pi = 3.14159265358979;
  const double largest = torus.density({torus.ring + torus.tube, 0, 0});
  Host_sites<Real> s{std::vector<Site<Real>>(n), std::vector<Vec3<Real>>(n), std::vector<Real>(n)};
  const auto fill_chunk = [&](int chunk) {
    std::mt19937_64 random(seed * 1000 + chunk);
    std::uniform_real_distribution<double> uniform(0, 1);
    const int end = int(std::int64_t(n) * (chunk + 1) / chunks);
    for (int i = int(std::int64_t(n) * chunk / chunks); i < end;) {
      const double a = 2 * pi * uniform(random), b = 2 * pi * uniform(random);
      const double r = torus.ring + torus.tube * std::cos(b);
      const Vec3d p{r * std::cos(a), r * std::sin(a), torus.tube * std::sin(b)};
      const double accept = r / (torus.ring + torus.tube) * torus.density(p) / largest;
      if (uniform(random) > accept) continue;
      const Vec3d normal = torus.normal(p);
      s.sites[i] = {{Real(p.x), Real(p.y), Real(p.z)}, 0};
      s.normals[i] = {Real(normal.x), Real(normal.y), Real(normal.z)};
      s.density_root[i++] = torus.density_root(p);
    }
  };
  const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  std::vector<std::thread> pool;
  for (unsigned t = 0; t < threads; ++t)
    pool.emplace_back([&, t] {
      for (int chunk = int(t); chunk < chunks; chunk += int(threads)) fill_chunk(chunk);
    });
  for (std::thread& t : pool) t.join();
  return s;
}

template <class T>
struct Permute {
  T* to;
  const T* from;
  const int* order;
  __device__ void operator()(int i) const { to[i] = from[order ? order[i] : i]; }
};

/// Sites on the device with their cells.
template <class Real>
class Device_sites {
public:
  Device_sites(Cuda_backend& backend, const Host_sites<Real>& host) : m_backend(backend)
  {
    const int n = int(host.sites.size());
    sites.allocate(backend, n);
    normals.allocate(backend, n);
    density_root.allocate(backend, n);
    area.allocate(backend, n);
    mass.allocate(backend, n);
    offset.allocate(backend, n);
    status.allocate(backend, n);
    backend.upload(sites.data(), host.sites.data(), n);
    backend.upload(normals.data(), host.normals.data(), n);
    backend.upload(density_root.data(), host.density_root.data(), n);
  }

  int size() const { return int(sites.size()); }
  Sites_arrays<Real> arrays() const
  {
    Sites_arrays<Real> a;
    a.sites = sites.data();
    a.normals = normals.data();
    a.density_root = density_root.data();
    a.cells = a.sites_size = size();
    return a;
  }
  Cell_outputs<Real> outputs()
  {
    Cell_outputs<Real> o;
    o.area = area.data();
    o.mass = mass.data();
    o.offset = offset.data();
    o.status = status.data();
    return o;
  }
  Host_sites<Real> download()
  {
    Host_sites<Real> s{std::vector<Site<Real>>(size()), std::vector<Vec3<Real>>(size()),
                       std::vector<Real>(size())};
    m_backend.download(s.sites.data(), sites.data(), size());
    m_backend.download(s.normals.data(), normals.data(), size());
    m_backend.download(s.density_root.data(), density_root.data(), size());
    return s;
  }

  /// Takes the sites into Hilbert order.
  void sort()
  {
    Cuda_backend::Buffer<std::uint64_t> keys;
    Cuda_backend::Buffer<int> order;
    keys.allocate(m_backend, size());
    order.allocate(m_backend, size());
    const Site<Real>* const s = sites.data();
    std::uint64_t* const k = keys.data();
    m_backend.for_each(size(), [=] __device__(int i) { k[i] = hilbert_code(s[i].point); });
    m_backend.sort_order(size(), keys.data(), order.data(), true);
    const auto permute = [&](auto& buffer) {
      auto* const to = buffer.data();
      using T = std::remove_pointer_t<decltype(to)>;
      Cuda_backend::Buffer<T> copy;
      copy.allocate(m_backend, size());
      m_backend.for_each(size(), Permute<T>{copy.data(), to, order.data()});
      m_backend.for_each(size(), Permute<T>{to, copy.data(), nullptr});
      m_backend.synchronize();
    };
    permute(sites);
    permute(normals);
    permute(density_root);
  }

  /// Steps of Lloyd's method.
  template <class Cells>
  void relax(Cells& cells, const Torus<Real>& torus, int steps)
  {
    for (int step = 0; step < steps; ++step) {
      cells.set_sites(arrays());
      cells.build(outputs());
      Site<Real>* const s = sites.data();
      Vec3<Real>* const n = normals.data();
      Real* const root = density_root.data();
      const Vec3<Real>* const o = offset.data();
      m_backend.for_each(size(), [=] __device__(int i) {
        const Vec3<Real> moved = s[i].point + o[i];
        const Vec3d p = torus.project({moved.x, moved.y, moved.z}), normal = torus.normal(p);
        s[i].point = {Real(p.x), Real(p.y), Real(p.z)};
        n[i] = {Real(normal.x), Real(normal.y), Real(normal.z)};
        root[i] = torus.density_root(p);
      });
    }
  }

  Cuda_backend::Buffer<Site<Real>> sites;
  Cuda_backend::Buffer<Vec3<Real>> normals, offset;
  Cuda_backend::Buffer<Real> density_root, area, mass;
  Cuda_backend::Buffer<unsigned char> status;

private:
  Cuda_backend& m_backend;
};

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_TORUS_SITES_H
