// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the stages are measured on: a smooth surface of 81920 facets with its density, and samples.
#ifndef POWER_RTF_BENCHMARK_WORKLOAD_H
#define POWER_RTF_BENCHMARK_WORKLOAD_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/geometry/Surface.h>

#include <string>
#include <vector>

struct Workload {
  struct Kind {
    int n;
    bool regular;  ///< after ten steps of Lloyd's method from spread samples, or random
    bool adaptive; ///< by curvature, or uniform
    std::string name() const
    {
      return std::string(regular ? "regular/" : "random/") + (adaptive ? "adaptive/" : "uniform/") +
             std::to_string(n);
    }
    bool operator==(const Kind& k) const
    {
      return n == k.n && regular == k.regular && adaptive == k.adaptive;
    }
  };

  Kind kind;
  CGAL::PowerRTF::Remeshing_options options;
  CGAL::PowerRTF::Surface surface; ///< with smoothed normals, as the engines want it
  CGAL::PowerRTF::Samples samples;

  /// The workload, made when it is not the last one asked for.
  static const Workload& get(const Kind& kind);
  /// All kinds up to `largest` samples, uniform ones first, n = 1000, 10000, ...
  static std::vector<Kind> kinds(int largest);
};

#endif // POWER_RTF_BENCHMARK_WORKLOAD_H
