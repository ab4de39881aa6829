// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_header.h"

#include <algorithm>
#include <iterator>

namespace tools::ply {
namespace {

using CGAL::PowerRTF::Invalid_input_error;

Role role_of(const Element& element, const Property& property)
{
  const std::string& name = property.name;
  if (element.is_face() && property.length && (name == "vertex_indices" || name == "vertex_index"))
    return Role::corners;
  if (element.is_face() && property.length && is_real(property.type) && name == "texcoord")
    return Role::texture;
  if (element.name == "edge" && !property.length && !is_real(property.type)) {
    if (name == "vertex1") return Role::begin;
    if (name == "vertex2") return Role::end;
  }
  if (property.length || (!element.is_vertex() && !element.is_face())) return Role::none;
  if (element.is_vertex() && name == "x") return Role::x;
  if (element.is_vertex() && name == "y") return Role::y;
  if (element.is_vertex() && name == "z") return Role::z;
  return Role::value;
}

/// Reads the header; the tokenizer stays at its last token.
class Header_reader {
public:
  explicit Header_reader(Tokenizer& tokens) : m_tokens(tokens) {}

  Header read()
  {
    if (!m_tokens.next() || m_tokens.token() != "ply")
      throw Invalid_input_error("it is not a PLY file: it does not begin with ply");
    while (next_line() != "end_header") {
      const std::string_view keyword = m_tokens.token();
      if (keyword == "format")
        m_header.body = body();
      else if (keyword == "element")
        add_element();
      else if (keyword == "property")
        add_property();
      else if (keyword == "comment")
        read_comment();
      else if (keyword != "obj_info")
        m_tokens.reject("is not known in the header of a PLY file");
    }
    check();
    drop_values();
    return std::move(m_header);
  }

private:
  /// The first token of the next line.
  std::string_view next_line()
  {
    m_tokens.skip_line();
    if (!m_tokens.next()) throw Invalid_input_error("the file is truncated in its header");
    return m_tokens.token();
  }

  /// The next token of the line.
  std::string_view next(const char* what)
  {
    if (!m_tokens.next_in_line()) throw Invalid_input_error(m_tokens.at() + what + " is missing");
    return m_tokens.token();
  }

  /// "TextureFile" and a name, as MeshLab writes it, or anything else.
  void read_comment()
  {
    if (!m_tokens.next_in_line() || m_tokens.token() != "TextureFile") return;
    m_header.texture_files.push_back(rest_of_line(m_tokens));
  }

  Body body()
  {
    const std::string_view format = next("the format");
    if (format == "ascii") return Body::text;
    if (format == "binary_little_endian") return Body::little_endian;
    if (format == "binary_big_endian") return Body::big_endian;
    m_tokens.reject("is not a format of PLY");
  }

  /// The type that the token names.
  Type type() const
  {
    constexpr const char* names[][2] = {
        {"char", "int8"}, {"uchar", "uint8"}, {"short", "int16"},   {"ushort", "uint16"},
        {"int", "int32"}, {"uint", "uint32"}, {"float", "float32"}, {"double", "float64"}};
    for (std::size_t i = 0; i < std::size(names); ++i)
      if (m_tokens.token() == names[i][0] || m_tokens.token() == names[i][1])
        return static_cast<Type>(i);
    m_tokens.reject("is not a type of PLY");
  }

  void add_element()
  {
    Element element;
    element.name = next("the element's name");
    next("the number of elements");
    const long long count = m_tokens.whole_number();
    if (count < 0) m_tokens.reject("is not a number of elements");
    element.count = static_cast<std::size_t>(count);
    m_header.elements.push_back(std::move(element));
  }

  void add_property()
  {
    if (m_header.elements.empty())
      throw Invalid_input_error(m_tokens.at() + "a property stands before the first element");
    Element& element = m_header.elements.back();
    Property property;
    if (next("the property's type") == "list") {
      next("the type of the list's length");
      property.length = type();
      if (is_real(*property.length)) m_tokens.reject("is not a type of whole numbers");
      next("the type of the list's entries");
    }
    property.type = type();
    property.name = next("the property's name");
    property.role = role_of(element, property);
    if (property.role >= Role::corners && element.has(property.role))
      m_tokens.reject("occurs twice");
    if (property.role == Role::corners && is_real(property.type))
      m_tokens.reject("is no list of whole numbers");
    element.properties.push_back(std::move(property));
  }

  /// All vertices have coordinates, all facets have corners, and there are some.
  void check() const
  {
    if (!m_header.body) throw Invalid_input_error("its header names no format");
    std::size_t facets = 0;
    for (const Element& e : m_header.elements) {
      if (e.is_vertex() && !(e.has(Role::x) && e.has(Role::y) && e.has(Role::z)))
        throw Invalid_input_error("its vertices have no coordinates x, y, z");
      if (e.is_face() && !e.has(Role::corners))
        throw Invalid_input_error("its facets have no list vertex_indices");
      if (e.is_face()) facets += e.count;
    }
    if (facets == 0) throw Invalid_input_error("it has no facets");
  }

  /// Takes the role from values that vertices or facets do not all have, or have twice; from
  /// texture coordinates but for those of corners: where they jump, linear interpolation is wrong;
  /// and from one end of edges without the other.
  void drop_values()
  {
    const auto is_alone = [this](const Element& element) {
      return std::none_of(m_header.elements.begin(), m_header.elements.end(),
                          [&](const Element& e) {
                            return &e != &element && e.count > 0 &&
                                   (element.is_vertex() ? e.is_vertex() : e.is_face());
                          });
    };
    for (Element& element : m_header.elements) {
      std::set<std::string> names;
      const bool is_edge = element.is_edge();
      for (Property& p : element.properties) {
        if (!is_edge && (p.role == Role::begin || p.role == Role::end)) p.role = Role::none;
        if (p.role == Role::value &&
            (!is_alone(element) || !names.insert(p.name).second ||
             in_words(p.name, element.is_vertex()) == "texture coordinates"))
          p.role = Role::none;
      }
    }
  }

  Tokenizer& m_tokens;
  Header m_header;
};

} // namespace

Header read_header(Tokenizer& tokens) { return Header_reader(tokens).read(); }

std::set<std::string> attributes(const Header& header)
{
  std::set<std::string> found;
  for (const Element& e : header.elements) {
    if (e.count == 0 || e.properties.empty()) continue;
    if (!e.is_vertex() && !e.is_face()) {
      found.insert(e.is_edge() ? "lines" : "elements " + printable(e.name));
      continue;
    }
    for (const Property& p : e.properties) {
      if (p.role != Role::none && p.role != Role::texture) continue;
      found.insert(in_words(p.name, e.is_vertex()));
    }
  }
  return found;
}

} // namespace tools::ply
