// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Vtk_arrays.h"

#include "Base64.h"
#include "Bytes.h"
#include "Tokenizer.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace tools {
namespace {

struct Vtk_type {
  std::string_view name;
  std::size_t size;
  Number_type type; ///< of the values
  double (*number)(std::uint64_t bits);
};

template <class Unsigned, class Number>
double as(std::uint64_t bits)
{
  return static_cast<double>(bit_cast<Number>(static_cast<Unsigned>(bits)));
}

constexpr Vtk_type types[] = {
    {"Int8", 1, Number_type::int8, as<std::uint8_t, std::int8_t>},
    {"UInt8", 1, Number_type::uint8, as<std::uint8_t, std::uint8_t>},
    {"Int16", 2, Number_type::int16, as<std::uint16_t, std::int16_t>},
    {"UInt16", 2, Number_type::uint16, as<std::uint16_t, std::uint16_t>},
    {"Int32", 4, Number_type::int32, as<std::uint32_t, std::int32_t>},
    {"UInt32", 4, Number_type::uint32, as<std::uint32_t, std::uint32_t>},
    {"Int64", 8, Number_type::int32, as<std::uint64_t, std::int64_t>},
    {"UInt64", 8, Number_type::uint32, as<std::uint64_t, std::uint64_t>},
    {"Float32", 4, Number_type::float32, as<std::uint32_t, float>},
    {"Float64", 8, Number_type::float64, as<std::uint64_t, double>},
};

/// Adds what a block of zlib becomes.
void inflate_to(std::string_view block, std::size_t size, std::string& bytes)
{
  constexpr std::size_t largest_ratio = 1032; // of deflate
  if (size / largest_ratio > block.size()) reject("it is truncated");
  const std::size_t begin = bytes.size();
  bytes.resize(begin + size);
  uLongf length = static_cast<uLongf>(size);
  const int code =
      uncompress(reinterpret_cast<Bytef*>(&bytes[begin]), &length,
                 reinterpret_cast<const Bytef*>(block.data()), static_cast<uLong>(block.size()));
  if (code != Z_OK || length != size) reject("its compressed data is damaged");
}

} // namespace

std::vector<double> Vtk_array::column(std::size_t k) const
{
  std::vector<double> result;
  for (std::size_t i = k; i < rows() * components; i += components) result.push_back(values[i]);
  return result;
}

Vtk_file::Vtk_file(std::string_view data) : m_data(data)
{
  const std::size_t appended = data.find("<AppendedData"); // what follows need not be XML
  std::string text(data.substr(0, appended));
  if (appended != std::string_view::npos) {
    const std::size_t end = data.find('>', appended), begin = data.find('_', end);
    if (begin == std::string_view::npos) reject("the file is truncated in its appended data");
    m_appended = data.substr(begin + 1);
    text += std::string(data.substr(appended, end + 1 - appended)) + "</AppendedData></VTKFile>";
  }
  const pugi::xml_parse_result result = m_document.load_buffer(text.data(), text.size());
  if (!result) {
    const auto begin = data.begin();
    const auto end = begin + std::min<std::ptrdiff_t>(result.offset, std::ptrdiff_t(data.size()));
    reject("line " + std::to_string(1 + std::count(begin, end, '\n')) + ": " +
           result.description());
  }
  if (!root()) reject("it is not a VTK file: there is no VTKFile");
  m_compressor = root().attribute("compressor").value();
  if (!m_compressor.empty() && m_compressor != "vtkZLibDataCompressor")
    reject("it is compressed by " + printable(m_compressor) +
           ", which is not read: save it with vtkZLibDataCompressor, or uncompressed");
  m_big_endian = root().attribute("byte_order").value() == std::string("BigEndian");
  m_is_base64 = root().child("AppendedData").attribute("encoding").value() != std::string("raw");
  if (root().attribute("header_type").value() == std::string("UInt64")) m_header_size = 8;
}

std::string Vtk_file::at(pugi::xml_node node) const
{
  const std::size_t offset = std::min(
      m_data.size(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, node.offset_debug())));
  return "line " + std::to_string(1 + std::count(m_data.begin(), m_data.begin() + offset, '\n')) +
         ": ";
}

Vtk_array Vtk_file::read(pugi::xml_node array) const
{
  const std::string name = array.attribute("Name").value(),
                    type_name = array.attribute("type").value(),
                    format = array.attribute("format").value();
  Vtk_array result{name, Number_type::float64, 1, {}};
  const auto type = std::find_if(std::begin(types), std::end(types),
                                 [&](const Vtk_type& t) { return t.name == type_name; });
  if (type == std::end(types)) return result;
  result.type = type->type;
  result.components = std::max(1u, array.attribute("NumberOfComponents").as_uint(1));
  try {
    if (format == "ascii") {
      Tokenizer tokens(array.child_value(), '\n');
      while (tokens.next()) result.values.push_back(tokens.number_or_nan());
    } else {
      const std::string bytes = bytes_of(array);
      result.values.reserve(bytes.size() / type->size);
      for (std::size_t i = 0; i + type->size <= bytes.size(); i += type->size)
        result.values.push_back(type->number(
            bits_of_bytes(std::string_view(bytes).substr(i, type->size), m_big_endian)));
    }
  } catch (const CGAL::PowerRTF::Invalid_input_error& e) {
    reject(at(array) + "the array " + printable(name) + " cannot be read: " + e.what());
  }
  const auto is_kept = [&](double x) { // of eight bytes, not all are
    bool kept = false;
    visit_as(result.type, x, [&](auto y) { kept = double(y) == x; });
    return kept;
  };
  if (type->size == 8 && !std::all_of(result.values.begin(), result.values.end(), is_kept))
    result.type = Number_type::float64;
  return result;
}

std::string Vtk_file::bytes_of(pugi::xml_node array) const
{
  const bool is_appended = array.attribute("format").value() == std::string("appended");
  std::string_view text = array.child_value();
  if (is_appended) {
    const auto offset = static_cast<std::size_t>(array.attribute("offset").as_ullong());
    if (offset >= m_appended.size()) reject("it is truncated");
    text = m_appended.substr(offset);
  }
  const auto first = [&](std::size_t count) {
    std::string bytes =
        is_appended && !m_is_base64 ? std::string(text.substr(0, count)) : from_base64(text, count);
    if (bytes.size() < count) reject("it is truncated");
    return bytes;
  };
  const std::size_t largest = text.size(); // more than can be meant
  const auto number = [&](const std::string& header, std::size_t i) {
    const std::string_view all = header;
    return bits_of_bytes(all.substr(i * m_header_size, m_header_size), m_big_endian);
  };
  const std::size_t count = number(first(m_header_size), 0);
  if (count > largest) reject("it is truncated");
  if (m_compressor.empty()) return first(m_header_size + count).substr(m_header_size);

  // numbers of blocks, of bytes of each and of the last (0: as many), compressed bytes of each
  const std::string header = first((3 + count) * m_header_size);
  const std::size_t size = number(header, 1), last = number(header, 2);
  std::size_t end = header.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t compressed = number(header, 3 + i);
    if (compressed > largest || (end += compressed) > largest) reject("it is truncated");
  }
  const std::string blocks = first(end);
  std::string bytes;
  std::size_t begin = header.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t compressed = number(header, 3 + i);
    inflate_to(std::string_view(blocks).substr(begin, compressed),
               i + 1 == count && last > 0 ? last : size, bytes);
    begin += compressed;
  }
  return bytes;
}

} // namespace tools
