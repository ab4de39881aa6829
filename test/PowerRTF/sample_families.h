// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The catalog of samples that attack the cells, the fast ones and the exact ones: each family takes
// the number of samples and a source of random numbers.
#ifndef CGAL_POWER_RTF_TEST_SAMPLE_FAMILIES_H
#define CGAL_POWER_RTF_TEST_SAMPLE_FAMILIES_H

#include "random_input.h"

#include <CGAL/PowerRTF/geometry/Surface.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sample_families {

using CGAL::PowerRTF::Samples;
using CGAL::PowerRTF::Vec3d;
using random_input::Random;

constexpr double pi = 3.14159265358979323846;

inline double cosine_of_degrees(double angle) { return std::cos(angle * pi / 180); }

struct Cloud {
  Samples samples;
  double cos_angle = cosine_of_degrees(140); ///< of the compatibility angle; -2: all are compatible

  void add(const Vec3d& p, const Vec3d& n, double weight = 0)
  {
    samples.points.push_back(p);
    samples.normals.push_back(n);
    samples.weights.push_back(weight);
  }
  std::size_t size() const { return samples.size(); }
};

inline Cloud sphere(int n, Random& r)
{
  Cloud c;
  for (int k = 0; k < n; ++k) {
    const Vec3d d = r.direction();
    c.add(d * 0.5, d);
  }
  return c;
}

/// As even as a spiral is, jittered by `jitter` spacings.
inline Cloud even_sphere(int n, double jitter, Random& r)
{
  Cloud c;
  const double h = std::sqrt(4 * pi / n);
  for (int k = 0; k < n; ++k) {
    const double z = 1 - 2 * (k + 0.5) / n, q = std::sqrt(1 - z * z), t = k * 2.399963229728653;
    const Vec3d p = Vec3d{q * std::cos(t), q * std::sin(t), z} + r.direction() * (jitter * h);
    c.add(normalized(p) * 0.5, normalized(p));
  }
  return c;
}

/// Weights with root mean square `size` * h^2 that vary over the shape's size.
inline void add_smooth_weights(Cloud& c, double area, double size, Random& r)
{
  const double h2 = area / double(c.size());
  const Vec3d d = r.direction(), e = r.direction();
  const double f = r.real(2, 8), g = r.real(2, 8);
  double squares = 0;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Vec3d& p = c.samples.points[k];
    const double w = std::sin(f * dot(d, p)) + std::sin(g * dot(e, p) + 1);
    c.samples.weights[k] = w;
    squares += w * w;
  }
  const double scale = size * h2 / std::sqrt(squares / double(c.size()));
  for (double& w : c.samples.weights) w *= scale;
}

/// Uniform in [-size, size].
inline void add_random_weights(Cloud& c, double size, Random& r)
{
  for (double& w : c.samples.weights) w = r.real(-size, size);
}

inline void scale(Cloud& c, double factor)
{
  for (Vec3d& p : c.samples.points) p *= factor;
  for (double& w : c.samples.weights) w *= factor * factor;
}

/// With coordinates in {-1, 0, 1}.
inline Vec3d small_direction(Random& r)
{
  Vec3d v{0, 0, 0};
  while (v == Vec3d{0, 0, 0})
    v = {double(r.integer(-1, 1)), double(r.integer(-1, 1)), double(r.integer(-1, 1))};
  return v;
}

enum class Ties {
  rare,
  frequent,       ///< equal power distances, which only the order of the samples decides
  among_integers, ///< frequent; coordinates and weights are small integers
};

struct Family {
  std::string name;
  std::function<Cloud(int, Random&)> make;
  Ties ties = Ties::rare;
};

inline const std::vector<Family>& families()
{
  static const std::vector<Family> all = {
      {"white noise on a sphere", [](int n, Random& r) { return sphere(n, r); }},
      {"white noise with normals of white noise",
       [](int n, Random& r) {
         Cloud c;
         for (int k = 0; k < n; ++k)
           c.add({r.real(-.5, .5), r.real(-.5, .5), r.real(-.5, .5)}, r.direction());
         c.cos_angle = cosine_of_degrees(r.real(60, 180));
         return c;
       }},
      {"volume with weights, just incompatible normals",
       [](int n, Random& r) {
         Cloud c;
         for (int k = 0; k < n; ++k) c.add(r.in_box(), r.direction());
         add_random_weights(c, 0.02, r);
         c.cos_angle = n > 1 && r.integer(0, 1) ? dot(c.samples.normals[0], c.samples.normals[1])
                                                : r.real(-0.9, 0.7);
         return c;
       }},
      {"graded 1:1000",
       [](int n, Random& r) {
         Cloud c; // spacing proportional to the distance from the pole
         for (int k = 0; k < n; ++k) {
           const double a = pi * std::pow(10., -3 * r.real(0, 1)), b = r.real(0, 2 * pi);
           const Vec3d d{std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
           c.add(d * 0.5, d);
         }
         return c;
       }},
      {"even, smooth weights of rms up to 50 h^2",
       [](int n, Random& r) {
         Cloud c = even_sphere(n, 0.1, r);
         add_smooth_weights(c, pi, std::pow(50., r.real(0, 1)), r);
         return c;
       }},
      {"white noise, smooth weights of rms 50 h^2",
       [](int n, Random& r) {
         Cloud c = sphere(n, r);
         add_smooth_weights(c, pi, 50, r);
         return c;
       }},
      {"white noise, wild weights",
       [](int n, Random& r) {
         Cloud c = sphere(n, r);
         const double size = std::pow(10., r.real(-1, 1.7)) * pi / n;
         add_random_weights(c, size, r);
         c.cos_angle = r.integer(0, 1) ? 0 : -2;
         return c;
       }},
      {"nearly coincident",
       [](int n, Random& r) {
         Cloud c;
         const double gap = std::pow(10., r.real(-16, -4));
         while (int(c.size()) < n) {
           const Vec3d d = r.direction();
           for (int k = r.integer(1, 9); k > 0 && int(c.size()) < n; --k)
             c.add(d * 0.5 + r.direction() * gap, d);
         }
         return c;
       }},
      {"coincident",
       [](int n, Random& r) {
         Cloud c;
         while (int(c.size()) < n) {
           const Vec3d d = r.direction();
           for (int k = r.integer(1, 9); k > 0 && int(c.size()) < n; --k) c.add(d * 0.5, d);
         }
         return c;
       },
       Ties::frequent},
      {"two sheets at h / 1000",
       [](int n, Random& r) {
         Cloud c;
         const double h = std::sqrt(2. / n);
         for (int k = 0; k < n; ++k)
           c.add({r.real(-.5, .5), r.real(-.5, .5), k % 2 ? h / 1000 : 0},
                 {0, 0, k % 2 ? 1. : -1.});
         return c;
       }},
      {"two even sheets at h / 1000",
       [](int n, Random& r) {
         Cloud c;
         const int side = int(std::sqrt(n / 2.));
         for (int k = 0; k < 2 * side * side; ++k) {
           const int a = k / 2 % side, b = k / 2 / side;
           c.add({(a + r.real(.3, .7)) / side - .5, (b + r.real(.3, .7)) / side - .5,
                  k % 2 ? 1e-3 / side : 0},
                 {0, 0, k % 2 ? 1. : -1.});
         }
         return c;
       }},
      {"sphere, even", [](int n, Random& r) { return even_sphere(n, 0.2, r); }},
      {"plane, white noise",
       [](int n, Random& r) {
         Cloud c;
         const Vec3d u = r.direction(), v = normalized(cross(u, r.direction()));
         for (int k = 0; k < n; ++k)
           c.add(u * r.real(-.5, .5) + v * r.real(-.5, .5), normalized(cross(u, v)));
         return c;
       }},
      {"coordinate plane, white noise with weights",
       [](int n, Random& r) {
         Cloud c;
         for (int k = 0; k < n; ++k) c.add({r.real(-1, 1), 0.25, r.real(-1, 1)}, {0, -1, 0});
         add_random_weights(c, 1. / n, r);
         return c;
       }},
      {"plane, nearly cocircular",
       [](int n, Random& r) {
         Cloud c;
         const int side = int(std::sqrt(double(n)));
         const Vec3d u = r.direction(), v = normalized(cross(u, r.direction()));
         for (int k = 0; k < n; ++k)
           c.add(u * (0.1 * r.integer(0, side)) + v * (0.1 * r.integer(0, side)) +
                     u * r.real(0, 1e-15),
                 normalized(cross(u, v)));
         return c;
       }},
      {"plane, square grid: cocircular",
       [](int n, Random&) {
         Cloud c;
         const int side = int(std::sqrt(double(n)));
         for (int k = 0; k < side * side; ++k)
           c.add({double(k % side) / side - .5, double(k / side) / side - .5, 0.1}, {0, 0, 1});
         return c;
       },
       Ties::frequent},
      {"plane, tight clusters",
       [](int n, Random& r) {
         Cloud c;
         const double gap = std::pow(10., r.real(-15, -12));
         while (int(c.size()) < n) {
           const double x = r.real(-.5, .5), y = r.real(-.5, .5);
           for (int k = 0; k < 24 && int(c.size()) < n; ++k)
             c.add({x + r.real(-gap, gap), y + r.real(-gap, gap), 0.25}, {0, 0, 1});
         }
         return c;
       }},
      {"cylinder",
       [](int n, Random& r) {
         Cloud c;
         for (int k = 0; k < n; ++k) {
           const double a = r.real(0, 2 * pi);
           const Vec3d d{std::cos(a), std::sin(a), 0};
           c.add(d * 0.2 + Vec3d{0, 0, r.real(-.5, .5)}, d);
         }
         return c;
       }},
      {"cube with samples on its edges",
       [](int n, Random& r) {
         Cloud c;
         for (int k = 0; k < n; ++k) {
           double x[3] = {r.real(-.5, .5), r.real(-.5, .5), r.real(-.5, .5)}, m[3] = {0, 0, 0};
           const int axis = r.integer(0, 2), side = r.integer(0, 1);
           x[axis] = side ? .5 : -.5;
           m[axis] = side ? 1 : -1;
           if (r.integer(0, 3) == 0) { // on an edge, the normal of either side or between
             x[(axis + 1) % 3] = .5;
             if (r.integer(0, 1)) m[(axis + 1) % 3] = 1;
           }
           c.add({x[0], x[1], x[2]}, normalized(Vec3d{m[0], m[1], m[2]}));
         }
         return c;
       }},
      {"cube, grids on its sides",
       [](int n, Random&) {
         Cloud c;
         const int side = std::max(1, int(std::sqrt(n / 6.)));
         for (int f = 0; f < 6; ++f)
           for (int k = 0; k < side * side; ++k) {
             const int s = f / 2;
             const double y[3] = {f % 2 ? .5 : -.5, (k % side + .5) / side - .5,
                                  (k / side + .5) / side - .5};
             const double m[3] = {f % 2 ? 1. : -1., 0, 0};
             c.add({y[(3 - s) % 3], y[(4 - s) % 3], y[(5 - s) % 3]},
                   {m[(3 - s) % 3], m[(4 - s) % 3], m[(5 - s) % 3]});
           }
         return c;
       },
       Ties::frequent},
      {"coordinates of 1e-12",
       [](int n, Random& r) {
         Cloud c = even_sphere(n, 0.3, r);
         add_smooth_weights(c, pi, 5, r);
         scale(c, 1e-12);
         return c;
       }},
      {"coordinates of 1e12",
       [](int n, Random& r) {
         Cloud c = even_sphere(n, 0.3, r);
         add_smooth_weights(c, pi, 5, r);
         scale(c, 1e12);
         return c;
       }},
      {"far from the origin",
       [](int n, Random& r) {
         Cloud c = even_sphere(n, 0.3, r);
         for (Vec3d& p : c.samples.points) p = p * 1e-6 + Vec3d{.1, .2, .3};
         return c;
       }},
      {"lattice",
       [](int n, Random& r) {
         Cloud c;
         const int side = r.integer(2, 4);
         for (int k = 0; k < n; ++k)
           c.add({double(k % side), double(k / side % side), double(k / side / side)},
                 small_direction(r));
         c.cos_angle = -2;
         return c;
       },
       Ties::among_integers},
      {"flat lattice",
       [](int n, Random&) {
         Cloud c;
         for (int k = 0; k < n; ++k) c.add({double(k % 6), double(k / 6), 0}, {0, 0, 1});
         return c;
       },
       Ties::among_integers},
      {"lattice with weights and duplicates",
       [](int n, Random& r) {
         Cloud c;
         for (int k = 0; k < n; ++k)
           c.add({double(r.integer(0, 2)), double(r.integer(0, 2)), double(r.integer(0, 1))},
                 small_direction(r), r.integer(-1, 1));
         c.cos_angle = r.integer(0, 1) ? -2 : -0.5;
         return c;
       },
       Ties::among_integers},
      {"collinear lattice with weights",
       [](int n, Random& r) {
         Cloud c;
         const Vec3d d = small_direction(r), normal = small_direction(r);
         for (int k = 0; k < n; ++k)
           c.add(d * double(r.integer(-8, 8)), normal, r.integer(0, 1) ? 0 : r.integer(-9, 9));
         return c;
       },
       Ties::among_integers},
  };
  return all;
}

/// The family of this name.
inline const Family& family(const std::string& name)
{
  for (const Family& f : families())
    if (f.name == name) return f;
  throw std::out_of_range(name);
}

} // namespace sample_families

#endif // CGAL_POWER_RTF_TEST_SAMPLE_FAMILIES_H
