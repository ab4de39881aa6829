// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a glTF file consists of: JSON, and arrays of numbers in buffers.
#ifndef POWER_RTF_TOOLS_GLTF_FILE_H
#define POWER_RTF_TOOLS_GLTF_FILE_H

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tools {

using Json = nlohmann::ordered_json;

/// Rows of numbers.
struct Gltf_array {
  std::size_t rows = 0, components = 1;
  std::vector<double> values; ///< normalized ones: from -1 or 0 to 1

  double operator()(std::size_t row, std::size_t component) const
  {
    return values[row * components + component];
  }
};

/// A file of glTF 2.0, as text (.gltf) or binary (.glb). The data must outlive it.
class Gltf_file {
public:
  /// \param folder where the files lie that hold buffers
  /// \throws Invalid_input_error it is no such file
  Gltf_file(std::string_view data, const std::string& folder);

  const Json& json() const { return m_json; }
  const std::string& folder() const { return m_folder; }
  /// The i-th of the elements of that name, "nodes".
  /// \throws Invalid_input_error there is none
  const Json& element(const char* name, std::size_t i) const;
  /// \throws Invalid_input_error it cannot be read
  Gltf_array accessor(std::size_t i) const;
  /// The bytes of a buffer view. \throws Invalid_input_error it cannot be read
  std::string_view view(std::size_t i) const;

private:
  void read_buffers(std::string_view binary);

  std::string m_folder;
  Json m_json;
  std::vector<std::string> m_buffers;
};

/// The file that a URI names: %20 is a blank.
std::string name_of_uri(const std::string& uri);

/// The bytes of a file that is named by a URI; none, if it cannot be read.
std::string bytes_of_file(const std::string& folder, const std::string& uri);

/// The bytes of the file that `image` names by its URI, which becomes its type; nothing, and the
/// URI stays, if that is data, of another type than PNG and JPEG, or cannot be read.
std::string image_of_file(const std::string& folder, Json& image);

/// The whole number of that name; `none` if there is none.
/// \throws Invalid_input_error it is not a whole number, or negative
std::size_t gltf_number(const Json& json, const char* name, std::size_t none);

} // namespace tools

#endif // POWER_RTF_TOOLS_GLTF_FILE_H
