// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef POWER_RTF_TEST_FLAT_LATTICE_H
#define POWER_RTF_TEST_FLAT_LATTICE_H

#include <CGAL/PowerRTF/sampling/lattice_nodes.h>
#include <CGAL/PowerRTF/sampling/random_source.h>

#include <cmath>
#include <cstddef>
#include <vector>

/// Random nodes of the square [-1/2, 1/2]^2, with arbitrary axes of a lattice with one point in
/// `origin`, a row at `angle` and the spacing `h`: the waves are those of the perfect lattice.
struct Flat_lattice {
  using Vec3d = CGAL::PowerRTF::Vec3d;
  using Vec3f = CGAL::PowerRTF::Vec3f;
  using Phasor = CGAL::PowerRTF::Phasor;
  using Waves = CGAL::PowerRTF::Waves;
  using Stored_waves = CGAL::PowerRTF::Stored_waves;
  static constexpr double pi = 3.14159265358979323846;

  std::vector<Vec3f> points;
  std::vector<double> angles; ///< of the axes
  std::vector<Vec3f> normals, turning;
  std::vector<float> axes;
  std::vector<int> components;
  std::vector<float> spacing;
  std::vector<Stored_waves> waves;

  Flat_lattice(int n, unsigned seed, double angle, float h, const Vec3d& origin)
  {
    CGAL::PowerRTF::Random_source random(seed);
    for (int i = 0; i < n; ++i) {
      const Vec3f p{float(random() - 0.5), float(random() - 0.5), 0};
      const double theta = angle + pi / 3 * std::floor(6 * random());
      points.push_back(p);
      angles.push_back(theta);
      normals.push_back({0, 0, 1});
      turning.push_back({0, 0, 0});
      axes.push_back(axis_at(theta));
      components.push_back(0);
      spacing.push_back(h);
      waves.push_back(waves_at(CGAL::PowerRTF::to_double(p) - origin, theta, h));
    }
  }

  /// Makes `sixths` sixths of a turn of the directions around the middle of the square. The waves
  /// do not follow.
  void wind_directions(int sixths)
  {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double theta = angles[i] + sixths * std::atan2(points[i].y, points[i].x) / 6;
      axes[i] = axis_at(theta);
    }
  }

  /// Shifts the lattice by `burgers`, a vector between two of its points, on the way around the
  /// middle of the square.
  void dislocate(const Vec3d& burgers)
  {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double turns = std::atan2(points[i].y, points[i].x) / (2 * pi);
      waves[i] =
          waves_at(CGAL::PowerRTF::to_double(points[i]) + turns * burgers, angles[i], spacing[i]);
    }
  }

  CGAL::PowerRTF::Lattice_view view()
  {
    CGAL::PowerRTF::Lattice_view v;
    v.size = v.free = static_cast<int>(points.size());
    v.points = points.data();
    v.normals = normals.data();
    v.components = components.data();
    v.node_spacing = spacing.data();
    v.turning = turning.data();
    v.axes = axes.data();
    v.waves = waves.data();
    return v;
  }

private:
  static float axis_at(double theta)
  {
    const CGAL::PowerRTF::Tangent_frame<float> frame(Vec3f{0, 0, 1});
    const Vec3f axis{float(std::cos(theta)), float(std::sin(theta)), 0};
    return CGAL::PowerRTF::quarter_tangent({dot(axis, frame.u), dot(axis, frame.v)});
  }
  /// `p`: from a point of the lattice
  static Stored_waves waves_at(const Vec3d& p, double theta, double h)
  {
    using CGAL::PowerRTF::phasor_at;
    const double x = std::cos(theta) * p.x + std::sin(theta) * p.y;
    const double y = std::cos(theta) * p.y - std::sin(theta) * p.x;
    const Phasor a = phasor_at(float((x - y / std::sqrt(3.)) / h));
    const Phasor b = phasor_at(float(2 * y / std::sqrt(3.) / h));
    return {{a, b, conjugate(a * b)}};
  }
};

#endif // POWER_RTF_TEST_FLAT_LATTICE_H
