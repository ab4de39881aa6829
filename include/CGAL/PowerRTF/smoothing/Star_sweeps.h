// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_SMOOTHING_STAR_SWEEPS_H
#define CGAL_POWER_RTF_SMOOTHING_STAR_SWEEPS_H

#include <CGAL/PowerRTF/smoothing/Fit_arrays.h>
#include <CGAL/PowerRTF/smoothing/Star_arrays.h>
#include <CGAL/PowerRTF/smoothing/Star_sweeps_base.h>
#include <CGAL/PowerRTF/smoothing/color_vertices.h>
#include <CGAL/PowerRTF/smoothing/doubtful_stars.h>
#include <CGAL/PowerRTF/smoothing/smooth_vertex.h>

#include <cstddef>
#include <vector>

namespace CGAL::PowerRTF {

namespace internal {

struct Smooth_vertices {
  Star_view stars;
  CGAL_POWER_RTF_HD void operator()(int v) const { smooth_vertex(stars, v); }
};

enum class Fit_part { centroid, middle, unknown, coupling, step, move };

/// What `Fit_equations` does to a face, an edge or a vertex.
template <Fit_part part>
struct Fit_rule {
  Fit_equations equations;

  CGAL_POWER_RTF_HD void operator()(int i) const
  {
    if constexpr (part == Fit_part::centroid) equations.set_centroid(i);
    if constexpr (part == Fit_part::middle) equations.set_middle(i);
    if constexpr (part == Fit_part::unknown) equations.set_unknown(i);
    if constexpr (part == Fit_part::coupling) equations.set_coupling(i);
    if constexpr (part == Fit_part::step) equations.relax(i);
    if constexpr (part == Fit_part::move) equations.move(i);
  }
};

/// Applies a rule to some vertices.
template <class Rule>
struct In_order {
  Rule rule;
  const int* order;
  CGAL_POWER_RTF_HD void operator()(int k) const { rule(order[k]); }
};

} // namespace internal

/// The result is the same for any number of threads.
template <class Backend>
class Star_sweeps : public Star_sweeps_base {
public:
  /// `surface`: where the backend works. Keeps a reference to `backend`.
  Star_sweeps(Backend& backend, const Surface_descent& surface, double grid)
      : m_backend(backend), m_surface(surface), m_grid(grid)
  {}

  bool take(const internal::Flat_stars& stars) override
  {
    m_first.clear();
    return stars.are_all ? m_stars.upload(m_backend, stars) : m_stars.update(m_backend, stars);
  }

  /// Where the stars are, for who makes them there.
  internal::Star_arrays<Backend>& stars()
  {
    m_first.clear();
    return m_stars;
  }

  void smooth(int steps) override
  {
    for (int step = 0; step < steps; ++step) for_each_vertex(internal::Smooth_vertices{view()});
  }

  bool fit(const internal::Flat_fit& fit) override
  {
    using Part = internal::Fit_part;
    using internal::Fit_rule;
    internal::Fit_arrays<Backend> arrays;
    internal::Fit_equations equations;
    if (!arrays.make(m_backend, view(), number_of_spokes(), fit, equations)) return false;
    const int faces = arrays.mesh.number_of_faces(), edges = arrays.mesh.number_of_edges();
    m_backend.for_each(faces, Fit_rule<Part::centroid>{equations});
    m_backend.for_each(edges, Fit_rule<Part::middle>{equations});
    m_backend.for_each(m_stars.size(), Fit_rule<Part::unknown>{equations});
    arrays.make_couplings(m_backend, equations);
    m_backend.for_each(edges, Fit_rule<Part::coupling>{equations});
    for (int sweep = 0; sweep < internal::Fitting_parameters::sweeps; ++sweep)
      for_each_vertex(Fit_rule<Part::step>{equations});
    for_each_vertex(Fit_rule<Part::move>{equations});
    return true;
  }

  void read(internal::Swept_vertices& result) override
  {
    m_first.clear(); // the order's memory gets another use
    unsigned char* const flags = coloring().flags.data();
    m_backend.for_each(m_stars.size(), internal::Find_doubtful_stars{view(), flags});
    result.doubtful.resize(m_backend.select(m_stars.size(), flags, m_stars.order.data()));
    m_backend.download(result.doubtful.data(), m_stars.order.data(), result.doubtful.size());
    const auto take_all = [&](auto& to, const auto& from) {
      to.resize(from.size());
      m_backend.download(to.data(), from.data(), from.size());
    };
    take_all(result.points, m_stars.points);
    take_all(result.normals, m_stars.normals);
    take_all(result.facets, m_stars.facets);
    take_all(result.heights, m_stars.heights);
  }

private:
  int number_of_spokes()
  {
    int spokes;
    m_backend.download(&spokes, m_stars.first.data() + m_stars.size(), 1);
    return spokes;
  }

  internal::Star_view view()
  {
    internal::Star_view view = m_stars.view();
    view.surface = m_surface;
    view.grid = m_grid;
    return view;
  }

  internal::Color_arrays<Backend>& coloring()
  {
    auto& colors = m_coloring.colors;
    if (int(colors.size()) != m_stars.size()) {
      allocate_listed(m_backend, m_coloring, std::size_t(m_stars.size()));
      m_backend.fill(colors.data(), internal::Color_vertices::none, colors.size());
    }
    return m_coloring;
  }

  /// Applies a rule to all vertices that may move, neighbors one after the other.
  template <class Rule>
  void for_each_vertex(const Rule& rule)
  {
    if (m_first.empty())
      m_first = internal::order_by_colors(m_backend, view(), coloring(), m_stars.order.data());
    for (std::size_t c = 0; c + 1 < m_first.size(); ++c)
      m_backend.for_each(m_first[c + 1] - m_first[c],
                         internal::In_order<Rule>{rule, m_stars.order.data() + m_first[c]});
  }

  Backend& m_backend;
  Surface_descent m_surface;
  double m_grid;
  internal::Star_arrays<Backend> m_stars;
  internal::Color_arrays<Backend> m_coloring; // of so many stars, with the colors they had last
  std::vector<int> m_first; // where in the order each color begins; empty: there is no order
};

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_SMOOTHING_STAR_SWEEPS_H
