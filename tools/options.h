// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The command line of power_rtf_remesh.
#ifndef POWER_RTF_TOOLS_OPTIONS_H
#define POWER_RTF_TOOLS_OPTIONS_H

#include "Format.h"

#include <CGAL/PowerRTF/Remeshing_options.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace tools {

/// The command line cannot be understood; the program ends with exit code 2.
class Usage_error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

struct Program_options {
  std::string input, output;
  std::string report_file, html_file, cells_file, samples_file, fields_file,
      provenance_file; ///< empty: not asked for
  CGAL::PowerRTF::Remeshing_options remeshing;
  std::string size_field, density_field, corners; ///< names of properties or files; empty: none
  std::vector<std::string> refine;                ///< regions, see `parse_refinement()`
  std::string labels;                             ///< name of a property of the faces; empty: none
  /// Only faces with that value of that property are remeshed. No name: all are.
  std::string region_name, region_value;
  std::string creases;         ///< name of a file with pairs of vertices; empty: none
  bool keeps_lines = false;    ///< of the input's file
  bool keeps_points = false;   ///< of the input's file
  bool keeps_texture = false;  ///< of the input's file
  bool writes_patches = false; ///< as a property of the output's faces
  std::string traits;  ///< "cpu", "exact", "cuda", or "auto": the faster of "cpu" and "cuda"
  bool check = false;  ///< compare the cells with the exact ones at the end
  int check_every = 0; ///< and every so many iterations; 0: only at the end
  int threads = 0;     ///< 0: all
  bool write_mesh = true;
  bool is_batch = false;  ///< the input lists files or is a folder, the output is a folder
  bool resumes = false;   ///< a batch leaves outputs that are there and newer than their inputs
  std::size_t meshes = 1; ///< that are remeshed with these options
  std::string format;     ///< of a batch's outputs, as "off"; empty: as each input
  Encoding encoding = Encoding::binary; ///< of PLY and STL
  bool quiet = false;
};

/// Reads the command line. `information` receives the text of --help or --version, which leave
/// nothing else to do.
/// \throws Usage_error for anything that cannot be understood
Program_options parse_command_line(int argc, const char* const* argv, std::string& information);

} // namespace tools

#endif // POWER_RTF_TOOLS_OPTIONS_H
