// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Algorithm 1: the restricted tangent face F_i of one sample, with a certificate that no sample was
// missed. The half-planes are clipped by increasing distance from the site; a cell is complete when
// its security radius R is no larger than the radius for which the candidates were gathered.
#ifndef CGAL_POWER_RTF_CELLS_CONSTRUCT_CELL_H
#define CGAL_POWER_RTF_CELLS_CONSTRUCT_CELL_H

#include <CGAL/PowerRTF/cells/Polygon_certificate.h>
#include <CGAL/PowerRTF/cells/Sites_view.h>
#include <CGAL/PowerRTF/cells/Tangent_polygon.h>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFSurface
/// What is known of a cell.
enum class Cell_status : unsigned char {
  ok,        ///< complete, proved
  guarded,   ///< too few compatible neighbors: cut by all neighbors and by the guard square
  empty,     ///< the power cell does not meet the tangent plane
  incomplete ///< more vertices than a polygon can hold
};

/// Gathers half-planes and clips them by increasing distance. `Filtered`: what is left out is left
/// out with a margin, so that `is_certain()` can answer.
template <class FT, bool Filtered = false>
class Cell_clipper {
public:
  /// Starts cell `i` from a square of half-size `radius`. `cos_angle`: cosine of Theta; neighbors
  /// whose normals differ by more are skipped (NVISPC); -2 or less: none is. Sites of other patches
  /// always are.
  CGAL_POWER_RTF_HD Cell_clipper(const Sites_view<FT>& view, int i, FT radius, FT cos_angle)
      : m_view(view), m_i(i), m_site(view.sites[i]), m_normal(view.normals[i]), m_frame(m_normal),
        m_radius(radius), m_cos_angle(cos_angle)
  {
    m_polygon.set_square(radius);
  }

  /// Starts again from the square of half-size `half` <= radius.
  CGAL_POWER_RTF_HD void set_square(FT half) { m_polygon.set_square(half); }

  /// Offers site `j`; cuts at once only when the buffer is full.
  CGAL_POWER_RTF_HD void add(int j)
  {
    if (j == m_i) return;
    const Site<FT> other = m_view.sites[j];
    const Vec3<FT> offset = other.point - m_site.point;
    const FT d2 = squared_length(offset);
    if (!m_view.same_patch(m_i, j)) return;
    if (d2 < m_nearest2) m_nearest2 = d2;
    const FT power = d2 + (m_site.weight - other.weight);
    // (power / 2d > R): the plane passes outside the radius.
    const bool is_far = power > 0 && power * power > 4 * d2 * m_radius * m_radius;
    if constexpr (Filtered) {
      if (is_far && power * power > 4 * d2 * m_radius * m_radius * FT(1.000001) &&
          is_large(power, d2, other.weight))
        return;
    } else if (is_far) {
      return;
    }
    if (!are_compatible(m_normal, m_view.normals[j], m_cos_angle)) return;
    const auto [a, b] = m_frame.components(offset, d2);
    const FT t2 = a * a + b * b;
    // A plane parallel to the tangent plane, or a duplicate: the first one wins.
    if (!(t2 > 0)) {
      if (power < 0 || (power == 0 && j < m_i)) m_polygon.size = 0;
      if constexpr (Filtered)
        if (!is_large(power - std::sqrt(d2) * m_radius * FT(1e-8), d2, other.weight))
          m_doubtful = true;
      return;
    }
    if (m_size == buffer_capacity) flush();
    m_buffer[m_size++] = {power / (2 * std::sqrt(t2)), a, b, power / 2, j};
  }

  /// Clips what is left; the polygon is final.
  CGAL_POWER_RTF_HD const Tangent_polygon<FT>& finish()
  {
    flush();
    return m_polygon;
  }

  /// Whether no site outside the gathered ones can cut: R <= radius and no side of the square left.
  CGAL_POWER_RTF_HD bool is_complete() const
  {
    return m_polygon.size == 0 ||
           (m_polygon.squared_radius() <= m_radius * m_radius && !m_polygon.touches_square());
  }

  /// Whether the polygon of `finish()`, complete, is proved to have the exact cycle of neighbors.
  CGAL_POWER_RTF_HD bool is_certain() const;

  /// Whether the buffer has been emptied more than once: then nothing is certain.
  CGAL_POWER_RTF_HD bool has_overflown() const { return m_flushes > 1; }

  CGAL_POWER_RTF_HD const Tangent_polygon<FT>& polygon() const { return m_polygon; }
  CGAL_POWER_RTF_HD const Tangent_frame<FT>& frame() const { return m_frame; }
  /// Squared distance of the nearest site offered.
  CGAL_POWER_RTF_HD FT squared_nearest() const { return m_nearest2; }

private:
  /// a x + b y <= c, at signed distance `distance` from the site.
  struct Half_plane {
    FT distance, a, b, c;
    int neighbor;
  };
  static constexpr int buffer_capacity = 64;

  CGAL_POWER_RTF_HD void flush()
  {
    for (int k = 1; k < m_size; ++k) { // insertion sort; ties by index
      const Half_plane h = m_buffer[k];
      int place = k;
      for (; place > 0 && before(h, m_buffer[place - 1]); --place)
        m_buffer[place] = m_buffer[place - 1];
      m_buffer[place] = h;
    }
    FT radius2 = m_polygon.squared_radius();
    for (int k = 0; k < m_size && m_polygon.size > 0; ++k) {
      const Half_plane& h = m_buffer[k];
      if (h.distance > 0 && h.distance * h.distance > radius2) break;
      if (m_polygon.clip(h.a, h.b, h.c, h.neighbor)) radius2 = m_polygon.squared_radius();
    }
    m_last_size = m_size;
    m_size = 0;
    ++m_flushes;
  }

  /// Whether twice a line's offset is far above its rounding error.
  CGAL_POWER_RTF_HD bool is_large(FT power, FT d2, FT weight) const
  {
    const FT w_i = m_site.weight;
    return power > FT(1e-8) * (d2 + (w_i < 0 ? -w_i : w_i) + (weight < 0 ? -weight : weight));
  }

  CGAL_POWER_RTF_HD static bool before(const Half_plane& g, const Half_plane& h)
  {
    return g.distance < h.distance || (g.distance == h.distance && g.neighbor < h.neighbor);
  }

  const Sites_view<FT>& m_view;
  int m_i;
  Site<FT> m_site;
  Vec3<FT> m_normal;
  Tangent_frame<FT> m_frame;
  FT m_radius, m_cos_angle;
  FT m_nearest2 = FT(1e30);
  Tangent_polygon<FT> m_polygon;
  Half_plane m_buffer[buffer_capacity];
  int m_size = 0, m_last_size = 0, m_flushes = 0;
  bool m_doubtful = false; // a plane parallel to the tangent plane is too near
};

template <class FT, bool Filtered>
CGAL_POWER_RTF_HD inline bool Cell_clipper<FT, Filtered>::is_certain() const
{
  static_assert(Filtered, "the lines left out must be left out with a margin");
  if (m_flushes > 1 || m_doubtful || m_polygon.size < 3) return false;
  Polygon_certificate<FT> certificate(m_normal, m_frame);
  if (!certificate.is_frame_usable()) return false;
  int edge[buffer_capacity]; // of the polygon, made by line k; -1: none
  int line[Tangent_polygon<FT>::capacity];
  for (int k = 0; k < m_last_size; ++k) edge[k] = -1;
  for (int e = 0; e < m_polygon.size; ++e) {
    int k = 0;
    while (k < m_last_size && m_buffer[k].neighbor != m_polygon.neighbor[e]) ++k;
    if (k == m_last_size || edge[k] >= 0) return false;
    edge[k] = e;
    line[e] = k;
  }
  const auto rounded = [&](int k) {
    const Half_plane& h = m_buffer[k];
    const Site<FT>& other = m_view.sites[h.neighbor];
    return Polygon_certificate<FT>::line(h.a, h.b, h.c, squared_length(other.point - m_site.point),
                                         m_site.weight, other.weight);
  };
  auto here = rounded(line[0]);
  const auto first = here;
  for (int e = 0; e < m_polygon.size; ++e) {
    const auto next = e + 1 < m_polygon.size ? rounded(line[e + 1]) : first;
    if (!certificate.add_vertex(here, next)) return false;
    here = next;
  }
  if (!(certificate.radius() * FT(1.000002) < m_radius)) return false;
  for (int k = 0; k < m_last_size; ++k)
    if (!certificate.is_outside_polygon(rounded(k), edge[k])) return false;
  return true;
}

/// Hands the cell of all neighbors, whatever their normals, within the square of half-size `half`
/// to `deliver(status, clipper, false)`.
template <bool Filtered, class FT, class Candidates, class Deliver>
CGAL_POWER_RTF_HD inline void construct_guarded_cell(const Sites_view<FT>& view, int i, FT half,
                                                     Candidates&& candidates, Deliver&& deliver)
{
  Cell_clipper<FT, Filtered> clipper(view, i, half * FT(1.41421357), FT(-2));
  clipper.set_square(half);
  candidates(half * FT(1.41421357), [&](int j) { clipper.add(j); });
  const Tangent_polygon<FT>& polygon = clipper.finish();
  deliver(polygon.size == 0  ? Cell_status::empty
          : polygon.overflow ? Cell_status::incomplete
                             : Cell_status::guarded,
          clipper, false);
}

/// Constructs cell `i` and hands it to `sink(i, status, polygon, frame)`.
///
/// `radius` is the first guess of R; `candidates(radius, f)` calls `f(j)` for a superset of the
/// sites that can cut a cell of that radius. The result does not depend on the guess: the radius
/// grows until the cell is complete or is known to exceed the guard radius.
///
/// `Filtered`: `sink(i, status, polygon, frame, certain)`; `certain` when the status and the cycle
/// of neighbors are proved to be the exact ones.
template <bool Filtered = false, class FT, class Candidates, class Sink>
CGAL_POWER_RTF_HD inline void construct_cell(const Sites_view<FT>& view, int i, FT radius,
                                             FT cos_angle, Candidates&& candidates, Sink&& sink)
{
  FT guard = -1; // not computed yet: needed only for suspicious cells
  const auto guard_radius = [&]() {
    if (guard < 0) guard = view.guard_factor * distance_to_neighbor(view, i, 6);
    return guard;
  };
  const auto deliver = [&](Cell_status status, const auto& clipper, bool certain) {
    if constexpr (Filtered)
      sink(i, status, clipper.polygon(), clipper.frame(), certain);
    else
      sink(i, status, clipper.polygon(), clipper.frame());
    (void)certain;
  };
  FT smallest = FT(1e30); // of the squares that it was begun from once more
  for (;;) {
    Cell_clipper<FT, Filtered> clipper(view, i, radius, cos_angle);
    candidates(radius, [&](int j) { clipper.add(j); });
    const Tangent_polygon<FT>& polygon = clipper.finish();
    if (polygon.overflow) return deliver(Cell_status::incomplete, clipper, false);
    const FT r2 = polygon.squared_radius();
    // In so large a square rounding may have left nothing of it.
    if (!(r2 > 0) && radius > 8 * guard_radius() && guard_radius() > 0) {
      radius = guard_radius();
      continue;
    }
    if (polygon.size > 0 && clipper.is_complete()) {
      const FT f = view.guard_factor, smaller = FT(1.1) * std::sqrt(r2);
      // Once more from a smaller square where the size of this one costs digits, or where there are
      // too many candidates to be certain of.
      const bool is_far_off = 8 * r2 < radius * radius;
      if (r2 > 0 && smaller < FT(0.9) * smallest &&
          (is_far_off || (Filtered && clipper.has_overflown()))) {
        radius = smallest = smaller;
        continue;
      }
      // The 6th neighbor is no nearer than the nearest one. Where seven sites coincide no cell has
      // room, not even one without extent.
      const FT nearest2 = clipper.squared_nearest();
      const bool is_small = nearest2 > 0 && r2 <= f * f * nearest2;
      if (!is_small && !(guard_radius() > 0 && r2 <= guard_radius() * guard_radius())) break;
      bool certain = false;
      if constexpr (Filtered)
        certain = clipper.is_certain() &&
                  (is_small ? r2 <= f * f * nearest2 * (1 - FT(1e-9))
                            : r2 <= guard_radius() * guard_radius() * (1 - FT(1e-9)));
      return deliver(Cell_status::ok, clipper, certain);
    }
    if (radius >= guard_radius()) { // R > guard radius, or nothing within it
      if (polygon.size == 0) return deliver(Cell_status::empty, clipper, false);
      break;
    }
    // (Doubled, a radius of 0, which a cell without extent has left, would stay so.)
    radius = radius > 0 && 2 * radius < guard_radius() ? 2 * radius : guard_radius();
  }

  construct_guarded_cell<Filtered>(view, i, guard_radius(), candidates, deliver);
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_CELLS_CONSTRUCT_CELL_H
