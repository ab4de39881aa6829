// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Numbers as text, written fast.
#ifndef POWER_RTF_TOOLS_TEXT_H
#define POWER_RTF_TOOLS_TEXT_H

#include <CGAL/PowerRTF/geometry/vector.h>
#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

/// Text in memory. Numbers take their shortest form that reads back the same.
class Text {
public:
  Text& operator<<(std::string_view s)
  {
    m_text += s;
    return *this;
  }
  Text& operator<<(const char* s) { return *this << std::string_view(s); }
  Text& operator<<(const std::string& s) { return *this << std::string_view(s); }
  template <class Number>
  Text& operator<<(Number x)
  {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof(digits), x).ptr;
    return *this << std::string_view(digits, static_cast<std::size_t>(end - digits));
  }
  Text& operator<<(const CGAL::PowerRTF::Vec3d& p)
  {
    return *this << p.x << " " << p.y << " " << p.z;
  }

  std::size_t size() const { return m_text.size(); }
  /// Moves all to `out`.
  void flush(std::ostream& out)
  {
    out.write(m_text.data(), static_cast<std::streamsize>(m_text.size()));
    m_text.clear();
  }

private:
  std::string m_text;
};

/// Writes the rows `row(text, i)` for i in [0, n), in order; all threads make them.
template <class Row>
void write_rows(std::ostream& out, std::size_t n, const Row& row)
{
  constexpr std::size_t chunk = 4096, chunks_at_once = 256; // some 64 MB
  std::vector<Text> texts(chunks_at_once);
  for (std::size_t begin = 0; begin < n; begin += chunks_at_once * chunk) {
    const std::size_t size = (std::min)(n - begin, chunks_at_once * chunk);
    CGAL::PowerRTF::internal::for_each_chunk(CGAL::Parallel_if_available_tag(),
                                             static_cast<int>(size), static_cast<int>(chunk),
                                             [&](int first, int last) {
                                               for (int i = first; i < last; ++i)
                                                 row(texts[first / chunk], begin + i);
                                             });
    for (Text& text : texts) text.flush(out);
  }
}

} // namespace tools

#endif // POWER_RTF_TOOLS_TEXT_H
