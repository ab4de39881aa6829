// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The faces of a mesh by blocks of consecutive ones, which are mostly near each other, with the
// boxes around them: what is near to a few places is found without a look at all faces.
#ifndef CGAL_POWER_RTF_IMPROVEMENT_FACE_BLOCKS_H
#define CGAL_POWER_RTF_IMPROVEMENT_FACE_BLOCKS_H

#include <CGAL/PowerRTF/geometry/Packed_tree.h>
#include <CGAL/PowerRTF/improvement/Changed_vertices.h>
#include <CGAL/PowerRTF/improvement/Star_mesh.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace CGAL::PowerRTF::internal {

class Face_blocks {
public:
  using Face = Working_mesh::Face;

  /// `most`: a mesh of no more faces is looked at as a whole, which takes no longer.
  explicit Face_blocks(const Star_mesh& mesh, int most = 1 << 18)
      : m(&mesh), m_most(most), m_changed(mesh)
  {}

  /// The mesh has become another one.
  void add_all() { m_changed.add_all(); }

  Box3<double> box(Face f) const
  {
    const auto [a, b, c] = m->points(topology().halfedge(f));
    Box3<double> box{a, a};
    box.add(b);
    box.add(c);
    return box;
  }

  /// The faces of which `holds(face)`, sorted. \pre then `may_hold(box)` of each box around them
  template <class May_hold, class Holds>
  std::vector<Face> find(const May_hold& may_hold, const Holds& holds)
  {
    const int n = int(topology().num_faces());
    const auto is_wanted = [&](int f) {
      return f < n && !topology().is_removed(Face(f)) && holds(Face(f));
    };
    std::vector<Face> faces;
    if (n <= m_most) {
      for (const int f : select(m->concurrency(), n, is_wanted)) faces.push_back(Face(f));
      return faces;
    }
    fit();
    const std::vector<int> blocks = select(m->concurrency(), int(m_boxes.size()), [&](int b) {
      return m_boxes[b].lo.x <= m_boxes[b].hi.x && may_hold(m_boxes[b]);
    });
    const auto face = [&](int k) { return blocks[k / size] * size + k % size; };
    for (const int k : select(m->concurrency(), int(blocks.size()) * size,
                              [&](int k) { return is_wanted(face(k)); }))
      faces.push_back(Face(face(k)));
    return faces;
  }

private:
  static constexpr int size = 128; // faces of a block

  const Working_mesh::Mesh& topology() const { return m->working().mesh; }

  // The boxes of blocks whose faces have changed.
  void fit()
  {
    const std::vector<int> changed = m_changed.take();
    m_boxes.resize((topology().num_faces() + size - 1) / size);
    if (!m_changed.are_few(changed)) {
      for_each_chunk(m->concurrency(), int(m_boxes.size()), 4, [&](int begin, int end) {
        for (int b = begin; b < end; ++b) fit(b);
      });
      return;
    }
    int last = -1;
    for (const Face f : faces_around(*m, changed))
      if (const int b = int(f) / size; b != last) fit(last = b);
  }

  // A box of no faces ends before it begins.
  void fit(int b)
  {
    constexpr double far = std::numeric_limits<double>::max();
    m_boxes[b] = {{far, far, far}, {-far, -far, -far}};
    const int end = (std::min)((b + 1) * size, int(topology().num_faces()));
    for (int f = b * size; f < end; ++f)
      if (!topology().is_removed(Face(f))) m_boxes[b].add(box(Face(f)));
  }

  const Star_mesh* m;
  int m_most;
  Changed_vertices m_changed; // since the boxes were fit
  std::vector<Box3<double>> m_boxes;
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_IMPROVEMENT_FACE_BLOCKS_H
