// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Restricted cells by brute force, for tests of the exact cells: all n - 1 half-planes, explicit
// rational coordinates, O(n^2) per cell; shares nothing with the code under test. Weights (and the
// square's sides) may be perturbed explicitly by 2^(-bits (rank + 1)), which resolves ties as the
// symbolic perturbation does when `bits` is large enough for the coordinates; 0: none, ties are
// reported.
#ifndef CGAL_POWER_RTF_TEST_EXACT_BRUTE_FORCE_H
#define CGAL_POWER_RTF_TEST_EXACT_BRUTE_FORCE_H

#include "sample_families.h"

#include <CGAL/PowerRTF/exact/Exact_cells.h>

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace exact_test {

using CGAL::PowerRTF::Exact_square;
using CGAL::PowerRTF::Vec3d;
using sample_families::Cloud;
using Q = CGAL::Exact_rational;

struct Brute_cell {
  std::vector<int> neighbors;
  bool contains_site = false, tie = false;
  double area = 0;             // the next three when not empty
  Vec3d centroid{0, 0, 0};     // relative to s_i
  std::vector<double> lengths; // of the edges, in the order of `neighbors`
};

struct Q3 {
  Q x, y, z;
  explicit Q3(const Vec3d& v) : x(v.x), y(v.y), z(v.z) {}
  Q3(const Q& a, const Q& b, const Q& c) : x(a), y(b), z(c) {}
};
inline Q3 minus(const Q3& a, const Q3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Q dot(const Q3& a, const Q3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Q3 cross(const Q3& a, const Q3& b)
{
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Q power_of_two(int exponent)
{
  Q r(1), factor(exponent < 0 ? 0.5 : 2.);
  for (int e = std::abs(exponent); e > 0; e /= 2) {
    if (e % 2 == 1) r *= factor;
    factor *= factor;
  }
  return r;
}

struct Row { // a x + b y <= c
  int id;
  Q a, b, c;
};

struct Segment { // the part of a row's line inside the others, base + t (-b, a)
  const Row* row;
  Q base_x, base_y, t_min, t_max;
};

inline bool by_angle(const Segment& s, const Segment& t)
{
  const auto half = [](const Row& r) { return r.b > 0 || (r.b == 0 && r.a > 0) ? 0 : 1; };
  const int hs = half(*s.row), ht = half(*t.row);
  if (hs != ht) return hs < ht;
  return s.row->a * t.row->b - s.row->b * t.row->a > 0;
}

/// The part of row r's line inside all rows; nothing when empty or a point (`tie`: a point).
inline std::optional<Segment> segment(const std::vector<Row>& rows, const Row& r, bool& tie)
{
  const Q norm2 = r.a * r.a + r.b * r.b;
  if (norm2 == 0) {
    if (r.c == 0) tie = true;
    return std::nullopt;
  }
  Segment s{&r, Q(r.a * r.c / norm2), Q(r.b * r.c / norm2), Q(0), Q(0)};
  bool has_min = false, has_max = false, parallel_tie = false;
  for (const Row& o : rows) {
    if (&o == &r) continue;
    const Q slack = o.c - o.a * s.base_x - o.b * s.base_y;
    const Q rate = o.b * r.a - o.a * r.b;
    if (rate == 0) {
      if (slack < 0) return std::nullopt;
      if (slack == 0) parallel_tie = true;
      continue;
    }
    const Q t = slack / rate;
    if (rate > 0 && (!has_max || t < s.t_max)) {
      s.t_max = t;
      has_max = true;
    }
    if (rate < 0 && (!has_min || t > s.t_min)) {
      s.t_min = t;
      has_min = true;
    }
    if (has_min && has_max && s.t_min > s.t_max) return std::nullopt;
  }
  if (parallel_tie || s.t_min == s.t_max) tie = true;
  if (s.t_min == s.t_max) return std::nullopt;
  return s;
}

/// F_i of `c`, clipped by `square` or by a huge one with sides along the kept coordinate axes.
inline Brute_cell brute_force(const Cloud& c, int bits, int i, const Exact_square* square)
{
  const CGAL::PowerRTF::Samples& samples = c.samples;
  const int n_samples = int(samples.size());
  const Vec3d normal = samples.normals[i];
  const Q3 n(normal), s_i(samples.points[i]);
  const double abs_n[3] = {std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
  const double n_k[3] = {normal.x, normal.y, normal.z};
  const Vec3d axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const int largest = int(std::max_element(abs_n, abs_n + 3) - abs_n);
  const int smallest = int(std::min_element(abs_n, abs_n + 3) - abs_n);
  const Q3 u1 = cross(n, Q3(axes[smallest])), u2 = cross(n, u1);

  const auto eps = [&](int rank) { return bits == 0 ? Q(0) : power_of_two(-bits * (rank + 1)); };
  std::vector<Row> rows;
  const Q w_i = Q(samples.weights[i]) + eps(i);
  for (int j = 0; j < n_samples; ++j) {
    if (j == i || !(CGAL::PowerRTF::dot(normal, samples.normals[j]) > c.cos_angle)) continue;
    const Q3 v = minus(Q3(samples.points[j]), s_i);
    rows.push_back({j, Q(2 * dot(v, u1)), Q(2 * dot(v, u2)),
                    Q(dot(v, v) + w_i - Q(samples.weights[j]) - eps(j))});
  }
  const Vec3d first = n_k[largest] > 0 ? axes[(largest + 1) % 3] : axes[(largest + 2) % 3];
  const Vec3d second = n_k[largest] > 0 ? axes[(largest + 2) % 3] : axes[(largest + 1) % 3];
  const Vec3d t1 = square ? square->t1 : first, t2 = square ? square->t2 : second;
  const Q half_size = square ? Q(square->half_size) : power_of_two(800);
  int side = 0;
  for (const Vec3d& t : {t1, t2, -t1, -t2}) {
    rows.push_back({-1 - side, dot(Q3(t), u1), dot(Q3(t), u2), half_size + eps(n_samples + side)});
    ++side;
  }
  std::vector<Row*> by_offset; // near lines first: most searches below end early
  for (Row& r : rows) by_offset.push_back(&r);
  std::vector<double> key(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
    key[k] = rows[k].id < 0 ? 0 : CGAL::to_double(Q(rows[k].c));
  std::sort(by_offset.begin(), by_offset.end(),
            [&](Row* r, Row* s) { return key[r - rows.data()] < key[s - rows.data()]; });
  std::vector<Row> sorted;
  for (Row* r : by_offset) sorted.push_back(*r);

  Brute_cell result;
  bool empty = false;
  result.contains_site = true;
  for (const Row& r : sorted) {
    if (r.a == 0 && r.b == 0 && r.c < 0) empty = true;
    if (r.c < 0) result.contains_site = false;
    if (r.c == 0) result.tie = true;
  }
  std::vector<Segment> segments;
  for (const Row& r : sorted)
    if (const auto s = segment(sorted, r, result.tie)) segments.push_back(*s);
  if (empty || segments.empty()) {
    result.contains_site = false;
    return result;
  }
  std::sort(segments.begin(), segments.end(), by_angle);
  std::rotate(
      segments.begin(),
      std::min_element(segments.begin(), segments.end(),
                       [](const Segment& s, const Segment& t) { return s.row->id < t.row->id; }),
      segments.end());

  Q area2(0), mx(0), my(0);
  const double l1 = std::sqrt(CGAL::to_double(Q(dot(u1, u1))));
  const double l2 = std::sqrt(CGAL::to_double(Q(dot(u2, u2))));
  for (const Segment& s : segments) {
    result.neighbors.push_back(s.row->id);
    const Q px = s.base_x - s.t_min * s.row->b, py = s.base_y + s.t_min * s.row->a;
    const Q qx = s.base_x - s.t_max * s.row->b, qy = s.base_y + s.t_max * s.row->a;
    const Q t = px * qy - py * qx;
    area2 += t;
    mx += t * (px + qx);
    my += t * (py + qy);
    result.lengths.push_back(
        std::hypot(CGAL::to_double(Q(qx - px)) * l1, CGAL::to_double(Q(qy - py)) * l2));
  }
  if (area2 > 0) {
    result.area = CGAL::to_double(area2) / 2 * l1 * l2;
    const Q x = mx / (3 * area2), y = my / (3 * area2);
    result.centroid = {CGAL::to_double(Q(x * u1.x + y * u2.x)),
                       CGAL::to_double(Q(x * u1.y + y * u2.y)),
                       CGAL::to_double(Q(x * u1.z + y * u2.z))};
  }
  return result;
}

} // namespace exact_test

#endif // CGAL_POWER_RTF_TEST_EXACT_BRUTE_FORCE_H
