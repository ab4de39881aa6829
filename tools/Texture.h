// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Texture coordinates: values of the corners of polygons, which jump at seams.
#ifndef POWER_RTF_TOOLS_TEXTURE_H
#define POWER_RTF_TOOLS_TEXTURE_H

#include <array>
#include <string>
#include <vector>

namespace tools {

struct Texture {
  std::vector<std::array<double, 2>> coordinates; ///< u and v, which goes up
  std::vector<int> corners; ///< by corner of the polygons: its coordinates; -1: it has none

  bool empty() const { return corners.empty(); }
  /// Makes equal coordinates one, sorted; those of no corner go.
  void merge_equal();
};

} // namespace tools

#endif // POWER_RTF_TOOLS_TEXTURE_H
