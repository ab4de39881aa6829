// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Texture.h"

#include <algorithm>
#include <utility>

namespace tools {

void Texture::merge_equal()
{
  std::vector<std::array<double, 2>> merged;
  for (const int c : corners)
    if (c >= 0) merged.push_back(coordinates[c]);
  std::sort(merged.begin(), merged.end());
  merged.erase(std::unique(merged.begin(), merged.end()), merged.end());
  for (int& c : corners)
    if (c >= 0)
      c = static_cast<int>(std::lower_bound(merged.begin(), merged.end(), coordinates[c]) -
                           merged.begin());
  coordinates = std::move(merged);
}

} // namespace tools
