// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Splits a text into tokens and reads numbers from them.
#ifndef POWER_RTF_TOOLS_TOKENIZER_H
#define POWER_RTF_TOOLS_TOKENIZER_H

#include <CGAL/PowerRTF/internal/Cancellation.h>
#include <CGAL/PowerRTF/internal/errors.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

namespace tools {

/// The beginning of a text from a file, with all that cannot be printed replaced by '?'.
inline std::string printable(std::string_view text)
{
  std::string shown(text.substr(0, 24));
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return shown;
}

/// Goes through the tokens of a text, which are separated by blanks and ends of lines. The text
/// must outlive it.
class Tokenizer {
public:
  /// \param comment begins a comment, which ends with its line; '\n': there are none
  explicit Tokenizer(std::string_view text, char comment = '#') : m_text(text), m_comment(comment)
  {}

  /// Goes to the next token; `false` at the end of the text.
  bool next()
  {
    while (!next_in_line()) {
      if (m_at == m_text.size()) return false;
      ++m_at; // the end of the line
      ++m_line;
    }
    return true;
  }
  /// Goes to the next token of the same line; `false` at its end.
  bool next_in_line()
  {
    while (m_at < m_text.size() && is_blank(m_text[m_at])) ++m_at;
    if (m_at < m_text.size() && m_text[m_at] == m_comment) skip_line();
    const std::size_t begin = m_at;
    while (m_at < m_text.size() && !is_blank(m_text[m_at]) && m_text[m_at] != '\n') ++m_at;
    m_token = m_text.substr(begin, m_at - begin);
    if (++m_tokens % 4096 == 0) CGAL::PowerRTF::internal::Cancellation::poll(m_at, m_text.size());
    return !m_token.empty();
  }
  void skip_line() { m_at = std::min(m_text.find('\n', m_at), m_text.size()); }

  std::string_view token() const { return m_token; }
  /// What follows the token.
  std::string_view rest() const { return m_text.substr(m_at); }

  /// The token as a finite number.
  double number() const
  {
    const std::string_view digits = m_token.substr(m_token[0] == '+');
    const char* const end = digits.data() + digits.size();
    double x = 0;
    const auto [stop, error] = std::from_chars(digits.data(), end, x);
    if (stop != end || error == std::errc::invalid_argument) reject("is not a number");
    if (error == std::errc::result_out_of_range) // too large, or so small that it is 0
      x = std::strtod(std::string(digits).c_str(), nullptr);
    if (!std::isfinite(x)) reject("is not a finite number");
    return x;
  }

  /// The token as a number; NaN if it is none.
  double number_or_nan() const
  {
    double x = 0;
    const char* const end = m_token.data() + m_token.size();
    const auto [stop, error] = std::from_chars(m_token.data(), end, x);
    return error == std::errc() && stop == end ? x : std::numeric_limits<double>::quiet_NaN();
  }

  /// The token, or its part before '/', as a whole number, clamped to the limits of the type.
  long long whole_number(bool before_slash = false) const
  {
    const char* const end = m_token.data() + m_token.size();
    long long x = 0;
    const auto [stop, error] = std::from_chars(m_token.data(), end, x);
    if (error == std::errc::invalid_argument || (stop != end && !(before_slash && *stop == '/')))
      reject("is not a whole number");
    if (error == std::errc::result_out_of_range)
      x = m_token[0] == '-' ? std::numeric_limits<long long>::min()
                            : std::numeric_limits<long long>::max();
    return x;
  }

  /// \throws Invalid_input_error always; its message says what the token `is`
  [[noreturn]] void reject(const std::string& is) const
  {
    throw CGAL::PowerRTF::Invalid_input_error(at() + "'" + printable(m_token) + "' " + is);
  }
  /// "line 7: "
  std::string at() const { return "line " + std::to_string(m_line) + ": "; }

private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

  std::string_view m_text, m_token;
  char m_comment;
  std::size_t m_at = 0, m_line = 1, m_tokens = 0;
};

/// The words in the rest of a line.
inline std::string rest_of_line(Tokenizer& tokens)
{
  std::string words;
  while (tokens.next_in_line()) words += (words.empty() ? "" : " ") + std::string(tokens.token());
  return words;
}

/// \throws Invalid_input_error always
[[noreturn]] inline void reject(const std::string& reason)
{
  throw CGAL::PowerRTF::Invalid_input_error(reason);
}

/// Why a facet (numbered from 0) is refused that refers to a vertex that does not exist.
inline std::string out_of_range(const Tokenizer& tokens, std::size_t facet, long long vertex,
                                std::size_t count)
{
  return tokens.at() + "facet " + std::to_string(facet + 1) + " refers to vertex " +
         std::to_string(vertex) + ": the index is out of range, there are " +
         std::to_string(count) + " vertices";
}

} // namespace tools

#endif // POWER_RTF_TOOLS_TOKENIZER_H
