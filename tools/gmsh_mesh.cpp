// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "gmsh_mesh.h"

#include "Text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <string>

namespace tools {
namespace {

/// A string of the format, which has no quotes in it.
std::string quoted(std::string name)
{
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c == '"' || c == '\n' || c == '\r'; },
      '\'');
  return '"' + name + '"';
}

/// The physical groups of the triangles.
class Groups {
public:
  /// `labels`: a property with whole numbers, or null: there is one group.
  explicit Groups(const Mesh_property* labels) : m_labels(labels)
  {
    if (!labels || labels->values.empty()) return;
    const double least = *std::min_element(labels->values.begin(), labels->values.end());
    if (least < 1) m_shift = 1 - std::llround(least);
    for (std::size_t f = 0; f < labels->values.size(); ++f)
      if (std::string& name = m_names[of(f)]; name.empty()) name = name_of(f);
  }

  /// That of triangle `f`, at least 1.
  long long of(std::size_t f) const
  {
    return m_labels ? std::llround(m_labels->values[f]) + m_shift : 1;
  }

  void write_names(std::ostream& out) const
  {
    if (m_names.empty()) return;
    constexpr int dimension = 2; // of surfaces
    Text text;
    text << "$PhysicalNames\n" << m_names.size() << "\n";
    for (const auto& [group, name] : m_names)
      text << dimension << " " << group << " " << quoted(name) << "\n";
    text << "$EndPhysicalNames\n";
    text.flush(out);
  }

private:
  std::string name_of(std::size_t f) const
  {
    const long long value = std::llround(m_labels->values[f]);
    return m_labels->names.empty() ? m_labels->name + ' ' + std::to_string(value)
                                   : m_labels->names[std::size_t(value)];
  }

  const Mesh_property* m_labels;
  long long m_shift = 0;
  std::map<long long, std::string> m_names;
};

/// Rows that begin with their number, from 1 on. `section`: the name around them; `head`: lines
/// before their number; `row(text, i)`: what follows it
template <class Row>
void write_section(std::ostream& out, const std::string& section, const std::string& head,
                   std::size_t n, const Row& row)
{
  out << '$' << section << '\n' << head << n << '\n';
  write_rows(out, n, [&](Text& text, std::size_t i) {
    text << i + 1 << " ";
    row(text, i);
    text << "\n";
  });
  out << "$End" << section << '\n';
}

/// Values of nodes or elements.
void write_values(std::ostream& out, const std::string& section,
                  const std::vector<Mesh_property>& properties)
{
  for (const Mesh_property& p : properties) {
    // one string, the name; one real number, the time; three integers: the step, the components
    // and the number of values
    const std::string head = "1\n" + quoted(p.name) + "\n1\n0\n3\n0\n1\n";
    write_section(out, section, head, p.values.size(), [&](Text& text, std::size_t i) {
      visit_as(p.type, p.values[i], [&](auto x) { text << x; });
    });
  }
}

} // namespace

void write_msh(std::ostream& out, const std::vector<CGAL::PowerRTF::Vec3d>& points,
               const std::vector<CGAL::PowerRTF::Triangle>& triangles,
               const Mesh_properties& properties)
{
  const auto labels =
      std::find_if(properties.faces.begin(), properties.faces.end(),
                   [](const Mesh_property& p) { return !is_real(p.type) && !is_color(p.name); });
  const Groups groups(labels == properties.faces.end() ? nullptr : &*labels);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"; // the version, text, the size of a double
  groups.write_names(out);
  write_section(out, "Nodes", "", points.size(),
                [&](Text& text, std::size_t i) { text << points[i]; });
  constexpr int triangle = 2, tags = 2; // the type; the physical group and the surface of the model
  write_section(out, "Elements", "", triangles.size(), [&](Text& text, std::size_t i) {
    text << triangle << " " << tags << " " << groups.of(i) << " " << groups.of(i);
    for (const int v : triangles[i]) text << " " << v + 1;
  });
  write_values(out, "NodeData", properties.vertices);
  write_values(out, "ElementData", properties.faces);
}

} // namespace tools
