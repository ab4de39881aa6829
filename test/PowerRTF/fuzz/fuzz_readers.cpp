// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Any bytes are read, or refused with the reason. An input is a line with the name of the format,
// or "refine", and what is to be read.
#include "engine.h"
#include "promise.h"

#include "input_fields.h"
#include "mesh_io.h"

#include <cmath>

namespace {

using namespace CGAL::PowerRTF;

void check(const tools::Polygon_mesh& mesh)
{
  const Polygon_soup& soup = mesh.soup;
  fuzz::promise(soup.first.size() > 1 && soup.first.front() == 0 &&
                    soup.first.back() == int(soup.corners.size()),
                "a mesh has facets");
  for (std::size_t k = 1; k < soup.first.size(); ++k)
    fuzz::promise(soup.first[k - 1] <= soup.first[k], "facets follow one another");
  for (const int v : soup.corners)
    fuzz::promise(v >= 0 && v < int(soup.points.size()), "corners are points");
  for (const Vec3d& p : soup.points)
    fuzz::promise(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                  "coordinates are finite");
  for (const auto& property : mesh.properties.vertices)
    fuzz::promise(soup.points.empty() ? property.values.empty()
                                      : property.values.size() % soup.points.size() == 0,
                  "all vertices have values");
  const tools::Texture& texture = mesh.properties.texture;
  fuzz::promise(texture.empty() || texture.corners.size() == soup.corners.size(),
                "a texture is of all corners");
  for (const int c : texture.corners)
    fuzz::promise(c >= -1 && c < int(texture.coordinates.size()), "corners have coordinates");
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string text = fuzz::text_of(data, size);
  const std::size_t line = text.find('\n');
  if (line == std::string::npos) return -1;
  const std::string name = text.substr(0, line), content = text.substr(line + 1);
  const tools::Format format = tools::format_of("a." + name);
  if (format == tools::Format::unknown && name != "refine") return -1;
  try {
    if (name == "refine")
      tools::parse_refinement(content);
    else
      check(tools::parse_mesh(format, content));
  } catch (const Invalid_input_error& e) {
    fuzz::promise(e.what()[0] != 0, "a refusal has a reason");
  }
  return 0;
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                    unsigned)
{
  return LLVMFuzzerMutate(data, size, max_size);
}
