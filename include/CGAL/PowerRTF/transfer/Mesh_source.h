// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where the elements of a result come from, in terms of the input mesh, and with that the transfer
// of any values of the input's vertices and faces.
#ifndef CGAL_POWER_RTF_TRANSFER_MESH_SOURCE_H
#define CGAL_POWER_RTF_TRANSFER_MESH_SOURCE_H

#include <CGAL/PowerRTF/transfer/Sources.h>

#include <CGAL/IO/Color.h>
#include <CGAL/boost/graph/iterator.h>

#include <boost/graph/graph_traits.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace CGAL::PowerRTF {

/// \addtogroup PkgPowerRTFTransfer
/// @{

/// A place on a mesh: a point of a triangle of one of its faces.
template <class FaceGraph>
struct Mesh_source {
  using Graph_traits = boost::graph_traits<FaceGraph>;

  typename Graph_traits::face_descriptor face{};
  /// The corners of the triangle: those of the face, if that is one.
  std::array<typename Graph_traits::vertex_descriptor, 3> vertices{};
  std::array<double, 3> weights{0, 0, 0}; ///< barycentric coordinates: none negative, sum 1
  /// Of a face, whose center is that place, the faces under 16 points spread evenly over it; else
  /// empty.
  std::vector<typename Graph_traits::face_descriptor> faces{};
};

/// The linear interpolation of the values at the corners of a triangle: of floating-point numbers,
/// of arrays of them, of vectors (that can be added and multiplied by a `double` from the right)
/// and of colors. Of other numbers, as integers, which may be labels, that with the largest weight.
template <class Value>
Value interpolated(const Value& a, const Value& b, const Value& c,
                   const std::array<double, 3>& weights)
{
  if constexpr (std::is_floating_point<Value>::value) {
    return static_cast<Value>(weights[0] * a + weights[1] * b + weights[2] * c);
  } else if constexpr (std::is_arithmetic<Value>::value || std::is_enum<Value>::value) {
    const auto largest = std::max_element(weights.begin(), weights.end()) - weights.begin();
    return largest == 0 ? a : largest == 1 ? b : c;
  } else {
    return a * weights[0] + b * weights[1] + c * weights[2];
  }
}

template <class Number, std::size_t size>
std::array<Number, size>
interpolated(const std::array<Number, size>& a, const std::array<Number, size>& b,
             const std::array<Number, size>& c, const std::array<double, 3>& weights)
{
  std::array<Number, size> result;
  for (std::size_t i = 0; i < size; ++i) result[i] = interpolated(a[i], b[i], c[i], weights);
  return result;
}

inline IO::Color interpolated(const IO::Color& a, const IO::Color& b, const IO::Color& c,
                              const std::array<double, 3>& weights)
{
  const auto channel = [&](int i) {
    const double mean = interpolated(double(a[i]), double(b[i]), double(c[i]), weights);
    return static_cast<unsigned char>(std::lround(mean));
  };
  return {channel(0), channel(1), channel(2), channel(3)};
}

/// Gives the vertices of a result the values of the input's vertices, interpolated linearly.
///
/// \param sources readable: from the vertices of `output` to `Mesh_source`, as the named parameter
///   `vertex_source_map` has set it
/// \param from readable: from the input's vertices to values, see `interpolated()`
/// \param to writable: from the vertices of `output` to the same type
template <class OutputMesh, class SourceMap, class FromMap, class ToMap>
void transfer_vertex_values(const OutputMesh& output, const SourceMap& sources, const FromMap& from,
                            ToMap to)
{
  for (const auto v : vertices(output)) {
    const auto& source = get(sources, v);
    put(to, v,
        interpolated(get(from, source.vertices[0]), get(from, source.vertices[1]),
                     get(from, source.vertices[2]), source.weights));
  }
}

/// Gives the faces of a result the values of the input's faces: each that which the largest share
/// of it comes from, as seen from 16 points of it; where a source has no such faces, that at its
/// center.
///
/// \param sources readable: from the faces of `output` to `Mesh_source`, as the named parameter
///   `face_source_map` has set it
/// \param from readable: from the input's faces to values that can be compared by `==`
template <class OutputMesh, class SourceMap, class FromMap, class ToMap>
void transfer_face_values(const OutputMesh& output, const SourceMap& sources, const FromMap& from,
                          ToMap to)
{
  for (const auto f : faces(output)) {
    const auto& source = get(sources, f);
    const int points = static_cast<int>(source.faces.size());
    const auto value = [&](int k) { return get(from, points > 0 ? source.faces[k] : source.face); };
    put(to, f, value(most_frequent(points, value)));
  }
}

/// Gives the corners of a result's faces the values of the input's corners, interpolated linearly
/// in the face on their side of the constrained edges. A halfedge stands for the corner at its
/// target.
///
/// \param sources readable: from the halfedges of `output` to `Mesh_source` of `input`, as the
///   named parameter `corner_source_map` has set it
/// \param from readable: from the halfedges of `input` to values, see `interpolated()`
/// \param to writable: from the halfedges of `output` to the same type
template <class OutputMesh, class SourceMap, class InputMesh, class FromMap, class ToMap>
void transfer_corner_values(const OutputMesh& output, const SourceMap& sources,
                            const InputMesh& input, const FromMap& from, ToMap to)
{
  for (const auto f : faces(output))
    for (const auto h : halfedges_around_face(halfedge(f, output), output)) {
      const auto& source = get(sources, h);
      const auto value = [&](int i) {
        auto corner = halfedge(source.face, input);
        while (target(corner, input) != source.vertices[i]) corner = next(corner, input);
        return get(from, corner);
      };
      put(to, h, interpolated(value(0), value(1), value(2), source.weights));
    }
}

/// @}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_TRANSFER_MESH_SOURCE_H
