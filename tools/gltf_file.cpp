// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "gltf_file.h"

#include "Base64.h"
#include "Bytes.h"
#include "Tokenizer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

namespace tools {
namespace {

constexpr std::size_t most = std::numeric_limits<std::uint32_t>::max();

/// The JSON, which must not be nested so deeply that it cannot be written again.
Json parse_json(std::string_view text)
{
  constexpr int deepest = 100;
  const auto check_depth = [](int depth, Json::parse_event_t, Json&) {
    if (depth > deepest) reject("its JSON is nested too deeply");
    return true;
  };
  try {
    return Json::parse(text.begin(), text.end(), check_depth);
  } catch (const Json::exception& e) {
    reject(std::string("its JSON is wrong: ") + e.what());
  }
}

/// Of a number in a buffer: its size in bytes, whether it has a sign, is real, and the largest.
struct Component {
  std::size_t size;
  bool is_signed, is_real;
  double largest;
};

Component component_of(std::size_t type)
{
  switch (type) {
  case 5120:
    return {1, true, false, 127};
  case 5121:
    return {1, false, false, 255};
  case 5122:
    return {2, true, false, 32767};
  case 5123:
    return {2, false, false, 65535};
  case 5125:
    return {4, false, false, 4294967295.};
  case 5126:
    return {4, true, true, 1};
  }
  reject("an accessor has numbers of the unknown type " + std::to_string(type));
}

double number_of(std::string_view bytes, const Component& c)
{
  const std::uint64_t bits = bits_of_bytes(bytes, false);
  if (c.is_real) return bit_cast<float>(static_cast<std::uint32_t>(bits));
  if (!c.is_signed) return static_cast<double>(bits);
  return c.size == 1 ? double(static_cast<std::int8_t>(bits))
                     : double(static_cast<std::int16_t>(bits));
}

} // namespace

std::string name_of_uri(const std::string& uri)
{
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    const char* const begin = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(begin, begin + 2, code, 16).ptr == begin + 2) {
      name += static_cast<char>(code);
      i += 2;
    } else {
      name += uri[i];
    }
  }
  return name;
}

std::string bytes_of_file(const std::string& folder, const std::string& uri)
{
  const std::filesystem::path file = std::filesystem::path(folder) / name_of_uri(uri);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return {};
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string image_of_file(const std::string& folder, Json& image)
{
  const std::string uri = image.value("uri", "");
  const std::string end = std::filesystem::path(uri).extension().string();
  const char* const type = end == ".png"                     ? "image/png"
                           : end == ".jpg" || end == ".jpeg" ? "image/jpeg"
                                                             : nullptr;
  if (!type || uri.compare(0, 5, "data:") == 0) return {};
  std::string bytes = bytes_of_file(folder, uri);
  if (bytes.empty()) return {};
  image.erase("uri");
  image["mimeType"] = type;
  return bytes;
}

std::size_t gltf_number(const Json& json, const char* name, std::size_t none)
{
  const auto found = json.is_object() ? json.find(name) : json.end();
  if (found == json.end()) return none;
  const double x = found->is_number() ? found->get<double>() : -1;
  if (!(x >= 0 && x <= double(most)) || x != std::floor(x))
    reject(std::string(name) + " is not a whole number that can be used");
  return static_cast<std::size_t>(x);
}

Gltf_file::Gltf_file(std::string_view data, const std::string& folder) : m_folder(folder)
{
  std::string_view text = data, binary;
  if (data.substr(0, 4) == "glTF") {
    const auto number = [&](std::size_t at) {
      if (at + 4 > data.size()) reject("the file is truncated in its header");
      return static_cast<std::size_t>(bits_of_bytes(data.substr(at, 4), false));
    };
    if (number(4) != 2)
      reject("it is of version " + std::to_string(number(4)) + " of glTF, which is not read");
    const std::size_t length = number(12), next = 20 + length;
    if (number(8) > data.size() || next > data.size())
      reject("the file is truncated: it has only " + std::to_string(data.size()) + " bytes");
    text = data.substr(20, length);
    if (next + 8 <= data.size()) binary = data.substr(next + 8, number(next));
  }
  m_json = parse_json(text);
  if (!m_json.is_object() || !m_json.contains("asset"))
    reject("it is not a glTF file: it has no asset");
  for (const char* extension : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"})
    if (m_json.contains("extensionsRequired"))
      for (const Json& name : m_json["extensionsRequired"])
        if (name == extension)
          reject(std::string("it is compressed as ") + extension +
                 " has it, which is not read: save it uncompressed");
  read_buffers(binary);
}

void Gltf_file::read_buffers(std::string_view binary)
{
  if (!m_json.contains("buffers")) return;
  for (const Json& buffer : m_json["buffers"]) {
    const std::string uri = buffer.is_object() ? buffer.value("uri", "") : "";
    const std::size_t comma = uri.find(',');
    if (uri.empty()) {
      m_buffers.emplace_back(m_buffers.empty() ? binary : std::string_view());
    } else if (uri.compare(0, 5, "data:") == 0 && comma != std::string::npos) {
      m_buffers.push_back(from_base64(std::string_view(uri).substr(comma + 1), most));
    } else {
      m_buffers.push_back(bytes_of_file(m_folder, uri));
      if (m_buffers.back().empty()) reject("its file " + printable(uri) + " cannot be read");
    }
  }
}

const Json& Gltf_file::element(const char* name, std::size_t i) const
{
  const auto all = m_json.find(name);
  if (all == m_json.end() || !all->is_array() || i >= all->size() || !(*all)[i].is_object())
    reject(std::string("it refers to ") + name + " that do not exist: number " + std::to_string(i));
  return (*all)[i];
}

std::string_view Gltf_file::view(std::size_t i) const
{
  const Json& view = element("bufferViews", i);
  const std::size_t buffer = gltf_number(view, "buffer", most),
                    begin = gltf_number(view, "byteOffset", 0),
                    length = gltf_number(view, "byteLength", 0);
  if (buffer >= m_buffers.size() || begin + length > m_buffers[buffer].size())
    reject("a buffer is truncated, or does not exist");
  return std::string_view(m_buffers[buffer]).substr(begin, length);
}

Gltf_array Gltf_file::accessor(std::size_t i) const
{
  const Json& accessor = element("accessors", i);
  if (accessor.contains("sparse")) reject("it has sparse accessors, which are not read");
  const std::string type = accessor.value("type", "");
  const Component c = component_of(gltf_number(accessor, "componentType", 0));
  const bool is_normalized = accessor.value("normalized", false) && !c.is_real;
  Gltf_array array;
  array.rows = gltf_number(accessor, "count", 0);
  array.components = type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 1;
  const std::size_t row = array.components * c.size,
                    view_number = gltf_number(accessor, "bufferView", most);
  const std::string_view bytes = view(view_number);
  const std::size_t offset = gltf_number(accessor, "byteOffset", 0),
                    stride = gltf_number(element("bufferViews", view_number), "byteStride", row);
  if (array.rows == 0) return array;
  if (stride < row || offset + row > bytes.size() ||
      (array.rows - 1) > (bytes.size() - offset - row) / stride)
    reject("an accessor goes beyond its buffer");
  array.values.reserve(array.rows * array.components);
  for (std::size_t r = 0; r < array.rows; ++r)
    for (std::size_t k = 0; k < array.components; ++k) {
      const double x = number_of(bytes.substr(offset + r * stride + k * c.size, c.size), c);
      array.values.push_back(is_normalized ? std::max(-1., x / c.largest) : x);
    }
  return array;
}

} // namespace tools
