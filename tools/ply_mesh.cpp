// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_mesh.h"

#include "ply_header.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace tools {
namespace {

using namespace ply;
using CGAL::PowerRTF::Invalid_input_error;
using CGAL::PowerRTF::internal::Cancellation;

/// \param item from 0
[[noreturn]] void reject(const std::string& reason, const Element& element, std::size_t item)
{
  throw Invalid_input_error(reason + ' ' + printable(element.name) + ' ' +
                            std::to_string(item + 1) + " of " + std::to_string(element.count));
}

/// The values of a text, one token each.
class Text_values {
public:
  explicit Text_values(const Tokenizer& tokens) : m_tokens(tokens) {}

  /// The least size of a value, in bytes.
  static std::size_t size(Type) { return 1; }
  std::string at() const { return m_tokens.at(); }
  std::size_t bytes_left() const { return m_tokens.rest().size(); }
  bool next(Type) { return m_tokens.next(); }
  bool skip(Type, std::size_t count)
  {
    while (count > 0 && m_tokens.next()) --count;
    return count == 0;
  }
  double number() const { return m_tokens.number(); }
  long long whole_number() const { return m_tokens.whole_number(); }

private:
  Tokenizer m_tokens;
};

/// The values of binary data.
class Binary_values {
public:
  Binary_values(std::string_view data, Body body)
      : m_data(data), m_big_endian(body == Body::big_endian)
  {}

  static std::size_t size(Type type)
  {
    constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<int>(type)];
  }
  static std::string at() { return {}; }
  std::size_t bytes_left() const { return m_data.size(); }
  bool next(Type type)
  {
    m_type = type;
    m_value = m_data.substr(0, size(type));
    return skip(type, 1);
  }
  bool skip(Type type, std::size_t count)
  {
    if (count > m_data.size() / size(type)) return false;
    m_data.remove_prefix(count * size(type));
    return true;
  }
  double number() const
  {
    // the same on machines of either byte order
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < m_value.size(); ++i) {
      const char byte = m_value[m_big_endian ? i : m_value.size() - 1 - i];
      bits = bits << 8 | static_cast<unsigned char>(byte);
    }
    switch (m_type) {
    case Type::int8:
      return static_cast<std::int8_t>(bits);
    case Type::int16:
      return static_cast<std::int16_t>(bits);
    case Type::int32:
      return static_cast<std::int32_t>(bits);
    case Type::float32:
      return bit_cast<float>(static_cast<std::uint32_t>(bits));
    case Type::float64:
      return bit_cast<double>(bits);
    default:
      return static_cast<double>(bits);
    }
  }
  long long whole_number() const { return static_cast<long long>(number()); }

private:
  template <class To, class From>
  static To bit_cast(From from)
  {
    static_assert(sizeof(To) == sizeof(From));
    To to;
    std::memcpy(&to, &from, sizeof(to));
    return to;
  }

  std::string_view m_data, m_value;
  bool m_big_endian;
  Type m_type = Type::int8;
};

/// Appends the elements that the header announces to the mesh. Memory is reserved only for as many
/// as the rest of the data can hold.
template <class Values>
class Body_reader {
public:
  Body_reader(Values values, Polygon_mesh& mesh)
      : m_values(std::move(values)), m_mesh(mesh), m_bytes(m_values.bytes_left())
  {}

  void read(const Element& element)
  {
    std::size_t smallest = 0;
    for (const Property& p : element.properties)
      smallest += Values::size(p.length.value_or(p.type));
    if (smallest == 0) return;
    const std::size_t most = m_values.bytes_left() / smallest;
    if (element.count > most) reject("the file is truncated: it has no room for", element, most);
    if (element.is_vertex() && m_mesh.points.empty()) m_mesh.points.reserve(element.count);
    if (element.is_face() && m_mesh.polygons.empty()) m_mesh.polygons.reserve(element.count);
    for (std::size_t i = 0; i < element.count; ++i) {
      if (i % 1024 == 0) Cancellation::poll(m_bytes - m_values.bytes_left(), m_bytes);
      read_item(element, i);
    }
  }

private:
  void read_item(const Element& element, std::size_t item)
  {
    const auto expect = [&](bool found) {
      if (!found) reject("the file is truncated: it ends in", element, item);
    };
    std::array<double, 3> xyz{};
    for (const Property& p : element.properties) {
      if (p.length) {
        expect(m_values.next(*p.length));
        const long long length = m_values.whole_number();
        if (length < 0) reject(m_values.at() + "a list has a negative length in", element, item);
        read_list(p, static_cast<std::size_t>(length), expect);
      } else if (p.role != Role::none) {
        expect(m_values.next(p.type));
        xyz[static_cast<std::size_t>(p.role) - static_cast<std::size_t>(Role::x)] =
            m_values.number();
      } else {
        expect(m_values.skip(p.type, 1));
      }
    }
    if (element.is_vertex()) m_mesh.points.push_back({xyz[0], xyz[1], xyz[2]});
  }

  template <class Expect>
  void read_list(const Property& property, std::size_t length, const Expect& expect)
  {
    if (property.role == Role::none) return expect(m_values.skip(property.type, length));
    expect(length <= m_values.bytes_left() / Values::size(property.type));
    m_mesh.polygons.emplace_back(length);
    for (std::size_t& corner : m_mesh.polygons.back()) {
      expect(m_values.next(property.type));
      corner = static_cast<std::size_t>(m_values.whole_number()); // below 0: out of range
    }
  }

  Values m_values;
  Polygon_mesh& m_mesh;
  std::size_t m_bytes;
};

template <class Values>
void read_body(Values values, const Header& header, Polygon_mesh& mesh)
{
  Body_reader<Values> reader(std::move(values), mesh);
  for (const Element& element : header.elements) reader.read(element);
}

} // namespace

Polygon_mesh parse_ply(std::string_view data)
{
  Tokenizer tokens(data, '\n');
  const Header header = read_header(tokens);
  Polygon_mesh mesh;
  mesh.attributes = attributes(header);
  tokens.skip_line();
  if (header.body == Body::text)
    read_body(Text_values(tokens), header, mesh);
  else // after the end of the line
    read_body(Binary_values(tokens.rest().substr(tokens.rest().empty() ? 0 : 1), *header.body),
              header, mesh);
  return mesh;
}

} // namespace tools
