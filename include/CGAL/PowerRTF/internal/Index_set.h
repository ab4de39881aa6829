// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef CGAL_POWER_RTF_INTERNAL_INDEX_SET_H
#define CGAL_POWER_RTF_INTERNAL_INDEX_SET_H

#include <boost/container/small_vector.hpp>

#include <cstddef>
#include <cstdint>

namespace CGAL::PowerRTF::internal {

/// Some of many indices, none negative: a hash table with open addressing.
class Index_set {
public:
  /// Whether `i` was not there.
  bool insert(int i)
  {
    if (2 * m_size >= m_slots.size()) grow();
    int& slot = slot_of(i);
    if (slot == i) return false;
    slot = i;
    ++m_size;
    return true;
  }

private:
  static constexpr int none = -1;
  using Slots = boost::container::small_vector<int, 64>;

  // Where `i` is or will be.
  int& slot_of(int i)
  {
    const std::size_t last = m_slots.size() - 1; // a power of two less one
    std::size_t k = std::uint32_t(i) * 0x9e3779b1u >> m_shift;
    while (m_slots[k] != none && m_slots[k] != i) k = (k + 1) & last;
    return m_slots[k];
  }

  void grow()
  {
    Slots before(2 * m_slots.size(), none);
    before.swap(m_slots);
    --m_shift;
    for (const int i : before)
      if (i != none) slot_of(i) = i;
  }

  std::size_t m_size = 0;
  int m_shift = 26;
  Slots m_slots = Slots(64, none);
};

} // namespace CGAL::PowerRTF::internal

#endif // CGAL_POWER_RTF_INTERNAL_INDEX_SET_H
