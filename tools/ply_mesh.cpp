// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_mesh.h"

#include "Bytes.h"
#include "ply_header.h"

#include <CGAL/PowerRTF/internal/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace tools {
namespace {

using namespace ply;
using CGAL::PowerRTF::Invalid_input_error;
using CGAL::PowerRTF::internal::Cancellation;
using CGAL::PowerRTF::internal::for_each_index;
using CGAL::PowerRTF::internal::select;

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
  /// What is no number is not refused: only coordinates must be finite.
  double value() const { return m_tokens.number_or_nan(); }
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
  /// The values from that many bytes on.
  Binary_values after(std::size_t bytes) const
  {
    Binary_values rest = *this;
    rest.m_data.remove_prefix((std::min)(bytes, m_data.size()));
    return rest;
  }
  double number() const
  {
    const std::uint64_t bits = bits_of_bytes(m_value, m_big_endian);
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
  double value() const { return number(); }
  long long whole_number() const { return static_cast<long long>(number()); }

private:
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
      : m_values(std::move(values)), m_mesh(mesh), m_soup(mesh.soup), m_properties(mesh.properties),
        m_texture(mesh.properties.texture), m_bytes(m_values.bytes_left())
  {}

  void read(const Element& element)
  {
    std::size_t smallest = 0;
    for (const Property& p : element.properties)
      smallest += Values::size(p.length.value_or(p.type));
    if (smallest == 0) return;
    const std::size_t most = m_values.bytes_left() / smallest;
    if (element.count > most) reject("the file is truncated: it has no room for", element, most);
    for (const Property& p : element.properties)
      if (p.role == Role::value) properties_of(element).push_back({p.name, p.type, {}});
    if constexpr (std::is_same<Values, Binary_values>::value)
      if (read_even(element)) return;
    if (element.is_vertex() && m_soup.points.empty()) m_soup.points.reserve(element.count);
    if (element.is_face() && m_soup.corners.empty()) m_soup.reserve_polygons(element.count);
    for (std::size_t i = 0; i < element.count; ++i) {
      if (i % 1024 == 0) Cancellation::poll(m_bytes - m_values.bytes_left(), m_bytes);
      read_item(element, i);
    }
  }

private:
  /// A value of an item.
  struct Place {
    std::size_t offset;
    Type type;
    long long number = 0; ///< what stands there in the first item
  };
  /// What the items consist of, if their lists are as long as those of the first.
  struct Layout {
    std::vector<Place> lengths, corners, texture, values;
    std::array<Place, 3> xyz{};
    std::size_t size = 0; ///< of an item, in bytes
  };

  Values value(std::size_t offset, Type type) const
  {
    Values found = m_values.after(offset);
    return found.next(type) ? found : Values({}, Body::little_endian);
  }

  Layout layout_of_first(const Element& element) const
  {
    constexpr long long longest_list = 16; // as good as any: longer ones are hardly ever all alike
    Layout result;
    for (const Property& p : element.properties) {
      long long count = 1;
      if (p.length) {
        const long long length = value(result.size, *p.length).whole_number();
        result.lengths.push_back({result.size, *p.length, length});
        result.size += Values::size(*p.length);
        count = std::clamp(length, 0LL, longest_list);
        if (count != length) result.lengths.back().number = -1; // which no item has
      }
      for (; count > 0; --count) {
        const Place place{result.size, p.type};
        if (p.role == Role::corners)
          result.corners.push_back(place);
        else if (p.role == Role::texture)
          result.texture.push_back(place);
        else if (p.role == Role::value)
          result.values.push_back(place);
        else if (p.role != Role::none)
          result.xyz[static_cast<std::size_t>(p.role) - static_cast<std::size_t>(Role::x)] = place;
        result.size += Values::size(p.type);
      }
    }
    return result;
  }

  /// Reads the elements in parallel, if their lists are all as long as those of the first.
  /// \returns whether they are
  bool read_even(const Element& element)
  {
    constexpr CGAL::Parallel_if_available_tag concurrency;
    constexpr std::size_t most = std::numeric_limits<int>::max();
    if (element.is_edge()) return false;
    const Layout item = layout_of_first(element);
    const std::size_t sides = item.corners.size(), first = m_soup.corners.size();
    if (element.count > m_values.bytes_left() / item.size || element.count > most ||
        first + element.count * sides > most ||
        (!item.texture.empty() && item.texture.size() != 2 * sides))
      return false;
    const int n = static_cast<int>(element.count);
    const auto at = [&](int i, const Place& p) { return value(i * item.size + p.offset, p.type); };
    const auto is_odd = [&](int i) {
      return std::any_of(item.lengths.begin(), item.lengths.end(), [&](const Place& p) {
        return p.number < 0 || at(i, p).whole_number() != p.number;
      });
    };
    if (!item.lengths.empty() && !select(concurrency, n, is_odd).empty()) return false;
    if (element.is_vertex()) {
      const std::size_t begin = m_soup.points.size();
      m_soup.points.resize(begin + n);
      for_each_index(concurrency, n, [&](int i) {
        const auto x = [&](int k) { return at(i, item.xyz[k]).number(); };
        m_soup.points[begin + i] = {x(0), x(1), x(2)};
      });
    }
    if (element.is_face()) {
      const std::size_t begin = m_soup.first.size();
      m_soup.first.resize(begin + n);
      m_soup.corners.resize(first + n * sides);
      for_each_index(concurrency, n, [&](int i) {
        const std::size_t end = first + (i + 1) * sides;
        for (std::size_t k = 0; k < sides; ++k)
          m_soup.corners[end - sides + k] = corner(at(i, item.corners[k]).whole_number());
        m_soup.first[begin + i] = static_cast<int>(end);
      });
      if (!item.texture.empty()) read_even_texture(element, item, at);
    }
    for (std::size_t k = 0; k < item.values.size(); ++k) {
      std::vector<double>& values = properties_of(element)[k].values;
      values.resize(n);
      for_each_index(concurrency, n, [&](int i) { values[i] = at(i, item.values[k]).number(); });
    }
    m_values = m_values.after(n * item.size);
    return true;
  }

  /// The texture coordinates of facets with as many corners each. \param at `at(i, p)` is what
  /// stands at place p of item i
  template <class At>
  void read_even_texture(const Element& element, const Layout& item, const At& at)
  {
    constexpr CGAL::Parallel_if_available_tag concurrency;
    const int corners = static_cast<int>(element.count * item.corners.size()),
              sides = static_cast<int>(item.corners.size()),
              first = static_cast<int>(m_soup.corners.size()) - corners,
              old = static_cast<int>(m_texture.coordinates.size());
    m_texture.corners.resize(first, -1);
    m_texture.corners.resize(m_soup.corners.size());
    m_texture.coordinates.resize(old + corners);
    for_each_index(concurrency, corners, [&](int c) {
      const auto x = [&](int k) {
        return at(c / sides, item.texture[2 * (c % sides) + k]).number();
      };
      m_texture.corners[first + c] = old + c;
      m_texture.coordinates[old + c] = {x(0), x(1)};
    });
  }

  /// The texture coordinates of the last facet, which have been read. \param item from 0
  void end_texture(std::size_t item)
  {
    const std::size_t sides = m_soup.corners.size() - m_soup.first[m_soup.first.size() - 2];
    const bool has_all = m_numbers.size() == 2 * sides;
    if (!has_all && !m_numbers.empty() && m_mesh.texture_error.empty())
      m_mesh.texture_error = "facet " + std::to_string(item + 1) + " has " +
                             std::to_string(m_numbers.size()) + " numbers for " +
                             std::to_string(sides) + " corners";
    m_texture.corners.resize(m_soup.corners.size() - sides, -1);
    for (std::size_t k = 0; k < sides; ++k) {
      m_texture.corners.push_back(has_all ? static_cast<int>(m_texture.coordinates.size()) : -1);
      if (has_all) m_texture.coordinates.push_back({m_numbers[2 * k], m_numbers[2 * k + 1]});
    }
    m_numbers.clear();
  }

  void read_item(const Element& element, std::size_t item)
  {
    const auto expect = [&](bool found) {
      if (!found) reject("the file is truncated: it ends in", element, item);
    };
    std::array<double, 3> xyz{};
    CGAL::PowerRTF::Edge ends{};
    std::size_t column = 0;
    for (const Property& p : element.properties) {
      if (p.length) {
        expect(m_values.next(*p.length));
        const long long length = m_values.whole_number();
        if (length < 0) reject(m_values.at() + "a list has a negative length in", element, item);
        read_list(p, static_cast<std::size_t>(length), expect);
      } else if (p.role == Role::value) {
        expect(m_values.next(p.type));
        properties_of(element)[column++].values.push_back(m_values.value());
      } else if (p.role == Role::begin || p.role == Role::end) {
        expect(m_values.next(p.type));
        ends[p.role == Role::end] = corner(m_values.whole_number());
      } else if (p.role != Role::none) {
        expect(m_values.next(p.type));
        xyz[static_cast<std::size_t>(p.role) - static_cast<std::size_t>(Role::x)] =
            m_values.number();
      } else {
        expect(m_values.skip(p.type, 1));
      }
    }
    if (element.is_vertex()) m_soup.points.push_back({xyz[0], xyz[1], xyz[2]});
    if (element.is_edge()) m_mesh.lines.push_back(ends);
    if (element.is_face() && element.has(Role::texture)) end_texture(item);
  }

  template <class Expect>
  void read_list(const Property& property, std::size_t length, const Expect& expect)
  {
    if (property.role == Role::none) return expect(m_values.skip(property.type, length));
    expect(length <= m_values.bytes_left() / Values::size(property.type));
    for (std::size_t k = 0; k < length; ++k) {
      expect(m_values.next(property.type));
      if (property.role == Role::texture)
        m_numbers.push_back(m_values.value());
      else
        m_soup.corners.push_back(corner(m_values.whole_number()));
    }
    if (property.role == Role::corners) m_soup.end_polygon();
  }

  std::vector<Mesh_property>& properties_of(const Element& element)
  {
    return element.is_vertex() ? m_properties.vertices : m_properties.faces;
  }

  Values m_values;
  Polygon_mesh& m_mesh;
  CGAL::PowerRTF::Polygon_soup& m_soup;
  Mesh_properties& m_properties;
  Texture& m_texture;
  std::vector<double> m_numbers; // the texture coordinates of a facet
  std::size_t m_bytes;
};

template <class Values>
void read_body(Values values, const Header& header, Polygon_mesh& mesh)
{
  Body_reader<Values> reader(std::move(values), mesh);
  for (const Element& element : header.elements) reader.read(element);
}

/// Checks the texture coordinates, and makes a material of each texture.
void finish_texture(const std::vector<std::string>& files, Polygon_mesh& mesh)
{
  Texture& texture = mesh.properties.texture;
  if (texture.coordinates.empty()) texture = {};
  if (texture.empty() && mesh.texture_error.empty()) return;
  texture.corners.resize(mesh.soup.corners.size(), -1);
  const auto is_finite = [](const auto& x) { return std::isfinite(x[0]) && std::isfinite(x[1]); };
  if (!std::all_of(texture.coordinates.begin(), texture.coordinates.end(), is_finite))
    mesh.texture_error = "they are not finite";
  if (!mesh.texture_error.empty()) texture = {};
  std::vector<Mesh_property>& faces = mesh.properties.faces;
  if (files.empty() || find_property(faces, "material")) return;
  Mesh_property material{"material", Number_type::int32, {}, files};
  if (const Mesh_property* const numbers = find_property(faces, "texnumber")) {
    material.values = numbers->values;
    faces.erase(faces.begin() + (numbers - faces.data()));
  } else {
    material.values.assign(mesh.soup.first.size() - 1, 0);
  }
  const double count = static_cast<double>(files.size());
  bool has_others = false;
  for (double& x : material.values) {
    if (x >= 0 && x < count && x == std::floor(x)) continue;
    x = count;
    has_others = true;
  }
  if (has_others) material.names.emplace_back("none");
  mesh.properties.texture_files = files;
  faces.push_back(std::move(material));
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
  finish_texture(header.texture_files, mesh);
  return mesh;
}

} // namespace tools
