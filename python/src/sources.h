// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the vertices and faces of a result come from, as arrays.
#ifndef POWER_RTF_PYTHON_SOURCES_H
#define POWER_RTF_PYTHON_SOURCES_H

#include "cells.h"

#include "transfer.h"

#include <CGAL/PowerRTF/transfer/find_sources.h>

#include <optional>
#include <utility>
#include <vector>

namespace powerrtf {

/// The face that each vertex of a result lies on, the corners of a triangle of that face and the
/// weights of these; and the face that the center of each face lies on. Faces and vertices have the
/// numbers of the input's. For each corner of each face three corners of the input and their
/// weights; None, if these have not been looked for.
/// \param input what they come from
inline nb::tuple to_python(const CGAL::PowerRTF::Sources& sources, const Polygon_soup& input)
{
  std::vector<int> of_vertices, of_faces;
  std::vector<CGAL::PowerRTF::Triangle> corners;
  std::vector<Vec3d> weights;
  for (const CGAL::PowerRTF::Source& s : sources.vertices) {
    of_vertices.push_back(s.face);
    corners.push_back(s.vertices);
    weights.push_back({s.weights[0], s.weights[1], s.weights[2]});
  }
  for (const CGAL::PowerRTF::Source& s : sources.faces) of_faces.push_back(s.face);
  std::vector<CGAL::PowerRTF::Triangle> numbers;
  std::vector<Vec3d> corner_weights;
  for (const auto& triangle : sources.corners)
    for (const CGAL::PowerRTF::Source& s : triangle) {
      numbers.emplace_back();
      for (int i = 0; i < 3; ++i)
        numbers.back()[i] = tools::corner_number(input, s.face, s.vertices[i]);
      corner_weights.push_back({s.weights[0], s.weights[1], s.weights[2]});
    }
  const bool has_corners = !sources.corners.empty();
  return nb::make_tuple(to_array<int>(std::move(of_vertices)), to_array<int>(std::move(corners)),
                        to_array<double>(std::move(weights)), to_array<int>(std::move(of_faces)),
                        has_corners ? to_array<int>(std::move(numbers)) : nb::none(),
                        has_corners ? to_array<double>(std::move(corner_weights)) : nb::none());
}

/// The sources of a result, and what they come from.
///
/// \param sites of the run: they tell the way into the unit box, and whether the surface faces as
///   the input does
template <class Concurrency>
std::pair<CGAL::PowerRTF::Sources, Polygon_soup>
found_sources(const Real_array& points, const Index_array& faces,
              const std::optional<Index_array>& sizes, const Real_array& vertices,
              const Index_array& triangles, const nb::dict& sites, bool finds_shares)
{
  const CGAL::PowerRTF::Normalization normalization = normalization_from_python(sites);
  const bool faces_as_input = nb::cast<bool>(sites["faces_as_input"]);
  const nb::gil_scoped_release release;
  Polygon_soup soup = soup_of_arrays(points, faces, sizes);
  std::vector<Vec3d> inside = points_of_array(vertices);
  for (Vec3d& p : inside) p = normalization.to_inside(p);
  CGAL::PowerRTF::Sources found =
      find_sources(soup, normalization, faces_as_input, inside, triangles_of_array(triangles),
                   Concurrency(), finds_shares);
  return {std::move(found), std::move(soup)};
}

/// The sources of a result. The parameters are those of `found_sources()`.
template <class Concurrency>
nb::tuple sources(const Real_array& points, const Index_array& faces,
                  const std::optional<Index_array>& sizes, const Real_array& vertices,
                  const Index_array& triangles, const nb::dict& sites)
{
  const auto [found, soup] =
      found_sources<Concurrency>(points, faces, sizes, vertices, triangles, sites, false);
  return to_python(found, soup);
}

/// By face of a result the input's faces under 16 points of it: see `Sources::shares`. The
/// parameters are those of `sources()`.
template <class Concurrency>
nb::object face_shares(const Real_array& points, const Index_array& faces,
                       const std::optional<Index_array>& sizes, const Real_array& vertices,
                       const Index_array& triangles, const nb::dict& sites)
{
  return to_array<int>(
      std::move(found_sources<Concurrency>(points, faces, sizes, vertices, triangles, sites, true)
                    .first.shares));
}

} // namespace powerrtf

#endif // POWER_RTF_PYTHON_SOURCES_H
