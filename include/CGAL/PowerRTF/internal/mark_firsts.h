// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_MARK_FIRSTS_H
#define CGAL_POWER_RTF_INTERNAL_MARK_FIRSTS_H

#include <CGAL/PowerRTF/internal/host_device.h>

#include <cstdint>

namespace CGAL::PowerRTF::internal {

/// Of items in the order of their buckets: where those of the buckets begin that do so at place k.
/// For all places, and the end.
struct Mark_firsts {
  const int *bucket, *order;
  int items, buckets;
  int* first; ///< of each bucket, and the end

  CGAL_POWER_RTF_HD void operator()(int k) const
  {
    const int before = k > 0 ? bucket[order[k - 1]] : -1,
              here = k < items ? bucket[order[k]] : buckets;
    for (int b = before + 1; b <= here; ++b) first[b] = k;
  }
};

struct Set_key {
  const int* bucket;
  std::uint64_t* keys;
  CGAL_POWER_RTF_HD void operator()(int i) const { keys[i] = std::uint64_t(bucket[i]); }
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_MARK_FIRSTS_H
