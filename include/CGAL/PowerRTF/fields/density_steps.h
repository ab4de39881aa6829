// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steps to a density at a vertex, or a facet, for host and device.
#ifndef CGAL_POWER_RTF_FIELDS_DENSITY_STEPS_H
#define CGAL_POWER_RTF_FIELDS_DENSITY_STEPS_H

#include <CGAL/PowerRTF/fields/Diffusion_stage.h>
#include <CGAL/PowerRTF/geometry/Edges_view.h>
#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/Totals.h>
#include <CGAL/PowerRTF/internal/atomics.h>
#include <CGAL/PowerRTF/internal/host_device.h>

#include <cmath>
#include <cstddef>

namespace CGAL::PowerRTF::internal {

/// See `vertex_curvature()`.
struct Find_curvature {
  Edges_view edges;
  const Vec3d *points, *normals;
  double* curvature;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    double sum = 0;
    int count = 0;
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e) {
      const int u = edges.neighbor[e];
      const Vec3d d = points[u] - points[v];
      const double length_2 = squared_length(d);
      if (!(length_2 > 0)) continue;
      const double k = dot(normals[u] - normals[v], d) / length_2;
      sum += k * k;
      ++count;
    }
    curvature[v] = count > 0 ? std::sqrt(sum / count) : 0;
  }
};

/// The mean of a value and its neighbors' mean.
struct Smooth_over_edges {
  Edges_view edges;
  const double* values;
  double* smooth;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    double sum = 0;
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e) sum += values[edges.neighbor[e]];
    smooth[v] = (values[v] + sum / (edges.first[v + 1] - edges.first[v])) / 2;
  }
};

/// See `normalized_curvature()`.
struct Normalize_curvature {
  static constexpr int smoothing_passes = 3;
  static constexpr double smallest = 0.05;

  double unit;
  double* curvature;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    const double k = curvature[v] / unit, raised = smallest < k ? k : smallest;
    curvature[v] = raised < 1 ? raised : 1;
  }

  /// Of the 98th percentile among so many values.
  static std::size_t rank(std::size_t size) { return static_cast<std::size_t>(0.98 * (size - 1)); }
  /// Whether a curvature is rounding, on a surface of that area.
  static bool is_flat(double curvature, double area)
  {
    constexpr double flat = 1e-4; // a radius of 10^4 times the surface's size
    return curvature * std::sqrt(area) < flat;
  }
};

struct Raise_to_power {
  double power;
  double* values;

  CGAL_POWER_RTF_HD void operator()(int v) const { values[v] = std::pow(values[v], power); }
};

/// Divides by the largest density, and keeps away from the limits of double: nothing is sampled at
/// 1e-12 of the largest density.
struct Normalize_density {
  static constexpr double smallest = 1e-12;

  double largest;
  double* density;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    const double rho = density[v] / largest;
    density[v] = smallest < rho ? rho : smallest;
  }
};

/// The integral of the density over a facet, on which it is linear.
struct Density_integral {
  const int* vertices; ///< three per facet
  const double *areas, *density;

  CGAL_POWER_RTF_HD double operator()(int f) const
  {
    const int* const t = vertices + 3 * f;
    return areas[f] * (density[t[0]] + density[t[1]] + density[t[2]]) / 3;
  }
  CGAL_POWER_RTF_HD void operator()(int f, Totals<1, 0>& sum) const { sum.add(0, (*this)(f)); }
};

/// The spacing, but for a constant.
struct Find_relative_spacing {
  const double* density;
  double* spacing;

  CGAL_POWER_RTF_HD void operator()(int v) const { spacing[v] = 1 / std::sqrt(density[v]); }
};

struct Scale_spacing {
  double constant;
  const double* relative;
  double* spacing;

  CGAL_POWER_RTF_HD void operator()(int v) const { spacing[v] = constant * relative[v]; }
};

struct Find_density_of_spacing {
  double constant;
  const double* spacing;
  double* density;

  CGAL_POWER_RTF_HD void operator()(int v) const
  {
    density[v] = constant * constant / (spacing[v] * spacing[v]);
  }
};

/// Counts the vertices with a neighbor much nearer than samples ever are to each other.
struct Count_near {
  static constexpr double distance = 0.5; ///< of the least spacing, which gradation makes larger

  Edges_view edges;
  double longest;

  CGAL_POWER_RTF_HD void operator()(int v, Totals<1, 0>& count) const
  {
    for (int e = edges.first[v]; e < edges.first[v + 1]; ++e)
      if (edges.length[e] <= longest) return count.add(0, 1);
  }
};

/// What the growth of `h` allows at the other end of an edge from a vertex.
struct Growth_bound {
  Edges_view edges;
  double gradation;
  const double* h;

  CGAL_POWER_RTF_HD double operator()(int v, int e) const
  {
    return atomic_load(h + v) + gradation * edges.length[e];
  }
};

/// How the logarithms of densities are diffused.
struct Density_diffusion {
  static constexpr double longest = 4000; ///< shorter edges than a 45th of the width: less is done
  static constexpr int steps = 4;
};

struct Take_logarithm {
  double* values;
  CGAL_POWER_RTF_HD void operator()(int v) const { values[v] = std::log(values[v]); }
};

struct Take_exponential {
  double* values;
  CGAL_POWER_RTF_HD void operator()(int v) const { values[v] = std::exp(values[v]); }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_FIELDS_DENSITY_STEPS_H
