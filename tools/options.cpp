// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "options.h"

#include "input_fields.h"
#include "option_names.h"
#include "output_file.h"

#include <boost/program_options.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <type_traits>
#include <vector>

namespace tools {
namespace {

namespace po = boost::program_options;
using namespace CGAL::PowerRTF;

[[noreturn]] void reject(const std::string& option, const std::string& value,
                         const std::string& expected)
{
  throw Usage_error("--" + option + ": '" + value + "' is not " + expected);
}

/// The whole of `text` as a number, clamped to the limits of `T`.
template <class T>
T parse_number(const std::string& option, const std::string& text)
{
  constexpr bool whole = std::is_integral<T>::value;
  const char* const end = text.data() + text.size();
  T value{};
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc::invalid_argument || stop != end || std::isnan(double(value)))
    reject(option, text, whole ? "a whole number" : "a number");
  if (error == std::errc::result_out_of_range && whole)
    value = text[0] == '-' ? std::numeric_limits<T>::lowest() : std::numeric_limits<T>::max();
  else if (error == std::errc::result_out_of_range || std::isinf(double(value)))
    reject(option, text, "a number that can be used");
  return value;
}

template <class T>
T parse_value(const std::string& option, const std::string& text, const Option_range& range)
{
  if constexpr (std::is_enum<T>::value) {
    const Value_names names = value_names(T());
    const auto name = std::find(names.begin(), names.end(), text);
    if (name != names.end()) return static_cast<T>(name - names.begin());
  } else {
    using Number = std::conditional_t<std::is_integral<T>::value, long long, double>;
    const Number value = parse_number<Number>(option, text);
    // Too few or too many samples are an error of the input, not of the usage.
    if constexpr (std::is_same<T, std::size_t>::value) return value < 0 ? 0 : T(value);
    if (is_allowed(value, range)) return static_cast<T>(value);
  }
  reject(option, text, allowed_values<T>(range));
}

po::typed_value<std::string>* text(const std::string& value_name)
{
  return po::value<std::string>()->value_name(value_name);
}

/// The options that --help shows, by group, and their hidden synonyms.
class Descriptions {
public:
  Descriptions()
  {
    group("Main").add_options()("preset", text("NAME"),
                                "quality|fast|paper: this package's choice of all parameters, "
                                "the same with fewer steps, or the paper's; the other options "
                                "change single ones (quality)");
    const Remeshing_options quality, fast = Remeshing_options::fast_preset(),
                                     paper = Remeshing_options::paper_preset();
    for_each_option([&](const Option& option, auto member) {
      const auto value = quality.*member;
      using T = std::decay_t<decltype(value)>;
      constexpr bool is_switch = std::is_same<T, bool>::value; // off by default
      std::string argument, help = option.meaning;
      if constexpr (std::is_enum<T>::value) {
        argument = "NAME";
        help = choices(value) + ": " + help;
      } else if constexpr (!is_switch) {
        argument = std::is_integral<T>::value ? "N" : "X";
        help += " {" + to_text(option.range) + "}";
      }
      if (*option.symbol) help += " [" + std::string(option.symbol) + "]";
      if (!is_switch)
        help += " (" + to_text(value) + of_preset("fast", fast.*member, value) +
                of_preset("paper", paper.*member, value) + ")";
      const std::string name = option_name(option), other_name = member_name(option);
      add(group(option.group), name == "samples" ? "samples,n" : name, argument, help);
      if (other_name != name) add(m_hidden, other_name, argument, "");
    });
    add_fields();
    group("Files").add_options()("report", text("FILE.json"),
                                 "write what was done and what the result is worth")(
        "html", text("FILE.html"),
        "write a page that shows input and output, for any browser; it needs no network")(
        "cells", text("FILE"),
        "write the polygons F_i with weight, mass, density, status (PLY, VTP)")(
        "samples-out", text("FILE"), "write the samples with normals, weights, density (PLY, VTP)")(
        "fields", text("FILE"),
        "write the lattice that the samples begin as: its points, the directions of its rows, and "
        "where they do not fit (VTP)")(
        "provenance", text("FILE"),
        "write the mesh with the places of the input that its vertices and faces come from (PLY, "
        "VTP)")("ascii", "write PLY and STL as text, not as binary data")(
        "no-mesh", "stop at the samples: OUTPUT is not needed and not written")(
        "batch",
        "remesh many files: INPUT is a folder, or a text file with the name of one in each "
        "line; OUTPUT is a folder")(
        "format", text("NAME"),
        "off|obj|ply|stl|vtp|vtu|msh|gltf|glb: of a batch's outputs (that of each input)")(
        "resume", "a batch goes on: outputs that are there and newer than their inputs stay");
    group("Comparison with exact arithmetic")
        .add_options()("check", "compare the cells with the exact ones")(
            "check-every", text("N"),
            "compare them every N iterations, too; 0: only at the end (0)");
    group("Program").add_options()("traits", text("NAME"),
                                   "auto|cpu|exact|cuda: what runs the algorithm; auto: the GPU, "
                                   "if there is one and so many samples that it is faster, else "
                                   "the CPU (auto)")("threads", text("N"),
                                                     "number of threads; 0: all (0)")(
        "quiet,q", "no progress, no table")("help,h", "show this")("version", "show the version");
    m_hidden.add_options()("file", po::value<std::vector<std::string>>());
  }

  std::string help() const
  {
    std::ostringstream out;
    out << "power_rtf_remesh INPUT OUTPUT [options]\n"
           "power_rtf_remesh --batch INPUTS FOLDER [options]\n"
           "Remeshes a surface by power diagrams restricted to tangent planes (PowerRTF).\n"
           "Reads OFF, OBJ, PLY, STL, VTP, glTF; writes these, VTU and Gmsh's MSH, as the name "
           "ends.\n"
           "In {braces}: what is allowed; in [brackets]: the paper's symbol; in (parentheses): the "
           "default.\n";
    po::options_description all(line_length, description_length);
    for (const po::options_description& g : m_groups) all.add(g); // together, so that they align
    out << all;
    out << "\nExit codes: 0 done, every guarantee met; 1 the input cannot be used; 2 wrong usage;\n"
           "3 written, but a guarantee was missed; 4 written, but a cell is wrong that was "
           "certified\n"
           "(--check); 5 an output cannot be written; 130 cancelled by Ctrl-C, 143 by SIGTERM.\n"
           "--batch: 5 or 1 where one of the meshes is not written, else 4, 3 or 0; --report is a\n"
           "JSON object a line then, each written as soon as its mesh is.\n";
    return out.str();
  }

  po::variables_map parse(int argc, const char* const* argv) const
  {
    po::options_description all;
    for (const po::options_description& g : m_groups) all.add(g);
    all.add(m_hidden);
    po::positional_options_description files;
    files.add("file", -1);
    po::variables_map values;
    const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
    try {
      po::store(
          po::command_line_parser(argc, argv).options(all).positional(files).style(style).run(),
          values);
    } catch (const po::error& e) {
      throw Usage_error(e.what());
    }
    return values;
  }

private:
  /// What a preset has instead of the default.
  template <class T>
  static std::string of_preset(const std::string& preset, const T& value, const T& usual)
  {
    return value == usual ? "" : "; " + preset + ": " + to_text(value);
  }

  /// What is said about places of the input.
  void add_fields()
  {
    group("Fields and regions of the input")
        .add_options()("size-field", text("NAME"),
                       "the edge lengths that are wanted: a property of the input's vertices, or a "
                       "file with a number a line; without a number of samples it gives that, too")(
            "density-field", text("NAME"),
            "the same for the density, instead of --density; only its ratios matter")(
            "refine", po::value<std::vector<std::string>>()->composing()->value_name("REGION"),
            "sphere:x,y,z,r,h or box:x0,y0,z0,x1,y1,z1,h: edges are no longer than about h inside; "
            "may be given several times")(
            "region", text("NAME=VALUE"),
            "remesh only the input's faces of which that property has that value (PLY, VTP), or "
            "whose material or group has that name (OBJ), N vertices in all; the others stay as "
            "they are, with the border between")(
            "labels", text("NAME"),
            "a property of the input's faces, of whole numbers (PLY, VTP), or material or group "
            "(OBJ): "
            "creases are kept between different ones, and the output's faces have them (PLY, VTP, "
            "VTU; names: OBJ; physical groups: MSH)")(
            "lines", "the lines of an OBJ or VTP input, or edges of PLY, are creases, too")(
            "creases", text("FILE"),
            "edges that are creases, too: a file with the two vertices of one, numbered from 0, a "
            "line")(
            "corners", text("NAME"),
            "vertices of the input that stay as they are: those whose value of that property, or "
            "line of that file, is not 0; N counts them, too")(
            "points", "the points of an OBJ or VTP input stay, too")(
            "texture", "keep the texture coordinates of the input's faces, with their materials; "
                       "the seams of the texture are creases, too (OBJ, glTF)")(
            "patches", "number the output's faces by the patches between creases: their property "
                       "\"patch\" (PLY, VTP, VTU, MSH)");
  }

  /// Adds an option; without an `argument` it is a switch.
  static void add(po::options_description& options, const std::string& name,
                  const std::string& argument, const std::string& help)
  {
    if (argument.empty())
      options.add_options()(name.c_str(), help.c_str());
    else
      options.add_options()(name.c_str(), text(argument), help.c_str());
  }

  po::options_description& group(const std::string& name)
  {
    if (m_names.empty() || m_names.back() != name) {
      m_names.push_back(name);
      m_groups.emplace_back(name, line_length, description_length);
    }
    return m_groups.back();
  }

  static constexpr unsigned line_length = 100, description_length = 60;
  std::vector<std::string> m_names;
  std::vector<po::options_description> m_groups;
  po::options_description m_hidden;
};

/// What a percentage is given to instead, as a share: of the input's vertices, or of the diagonal.
double* share_of_input(const Option& option, Remeshing_options& o)
{
  const std::string name = option.name;
  return name == "number_of_samples" ? &o.vertex_share
         : name == "edge_length"     ? &o.relative_edge_length
         : name == "max_distance"    ? &o.relative_max_distance
                                     : nullptr;
}

/// The option that says how fine, or an empty text. \throws Usage_error there is more than one
std::string resolution_option(const po::variables_map& values)
{
  std::string other;
  for (const std::string name :
       {"samples", "number-of-samples", "vertex-share", "edge-length", "relative-edge-length",
        "size-factor", "max-distance", "relative-max-distance"}) {
    if (!values.count(name)) continue;
    if (!other.empty()) throw Usage_error("--" + other + " and --" + name + " exclude each other");
    other = name;
  }
  return other;
}

/// The parameters of the preset, changed by the options for single parameters.
Remeshing_options remeshing_options(const po::variables_map& values)
{
  Remeshing_options o;
  if (values.count("preset"))
    o = Remeshing_options::of(
        parse_value<Preset>("preset", values["preset"].as<std::string>(), {}));
  for_each_option([&](const Option& option, auto member) {
    using T = std::decay_t<decltype(o.*member)>;
    const std::string name = option_name(option), other_name = member_name(option);
    if (name != other_name && values.count(name) && values.count(other_name))
      throw Usage_error("--" + name + " and --" + other_name + " are the same option");
    const std::string& given = values.count(other_name) ? other_name : name;
    if (!values.count(given)) return;
    if constexpr (std::is_same<T, bool>::value) {
      o.*member = true;
    } else {
      const std::string text = values[given].as<std::string>();
      double* const share = share_of_input(option, o);
      if (share && !text.empty() && text.back() == '%')
        *share = parse_value<double>(given, text.substr(0, text.size() - 1),
                                     {Option_range::above_zero, 1e4}) /
                 100;
      else
        o.*member = parse_value<T>(given, text, option.range);
    }
  });
  resolution_option(values);
  return o;
}

/// \throws Usage_error
void set_fields(const po::variables_map& values, Program_options& o)
{
  o.keeps_lines = values.count("lines") > 0;
  o.keeps_points = values.count("points") > 0;
  o.keeps_texture = values.count("texture") > 0;
  o.writes_patches = values.count("patches") > 0;
  for (const auto& [option, name] :
       {std::pair{"size-field", &o.size_field}, std::pair{"density-field", &o.density_field},
        std::pair{"creases", &o.creases}, std::pair{"corners", &o.corners},
        std::pair{"labels", &o.labels}}) {
    if (!values.count(option)) continue;
    *name = values[option].as<std::string>();
    if (name->empty()) throw Usage_error("--" + std::string(option) + ": the name is empty");
  }
  if (values.count("region")) {
    const std::string& text = values["region"].as<std::string>();
    const std::size_t equal = text.find('=');
    if (equal == 0 || equal == std::string::npos) reject("region", text, "NAME=VALUE");
    o.region_name = text.substr(0, equal);
    o.region_value = text.substr(equal + 1);
    if (o.writes_patches) throw Usage_error("--patches: what --region leaves as it is has none");
  } else if (o.remeshing.region_border != CGAL::PowerRTF::Region_border::keep) {
    throw Usage_error("--region-border: there is no --region");
  }
  if (o.keeps_texture && o.remeshing.symmetry != CGAL::PowerRTF::Symmetry::none)
    throw Usage_error("--texture and --symmetry exclude each other: the seams of a texture have no "
                      "mirror images");
  if (!o.size_field.empty() && !o.density_field.empty())
    throw Usage_error("--size-field and --density-field exclude each other");
  if (o.remeshing.size_factor > 0 && o.size_field.empty())
    throw Usage_error("--size-factor: there is no --size-field");
  if (!o.size_field.empty() && resolution_option(values).empty()) o.remeshing.size_factor = 1;
  if (!values.count("refine")) return;
  o.refine = values["refine"].as<std::vector<std::string>>();
  for (const std::string& region : o.refine) try {
      parse_refinement(region);
    } catch (const Invalid_input_error& e) {
      throw Usage_error(std::string("--refine: ") + e.what());
    }
}

/// \throws Usage_error
void set_batch(const po::variables_map& values, Program_options& o)
{
  o.is_batch = values.count("batch") > 0;
  if (values.count("format")) {
    o.format = values["format"].as<std::string>();
    if (!o.is_batch) throw Usage_error("--format: for --batch; else OUTPUT's name says it");
    const std::vector<std::string> names{"off", "obj", "ply",  "stl", "vtp",
                                         "vtu", "msh", "gltf", "glb"};
    if (std::find(names.begin(), names.end(), o.format) == names.end())
      reject("format", o.format, "one of off|obj|ply|stl|vtp|vtu|msh|gltf|glb");
  }
  o.resumes = values.count("resume") > 0;
  if (o.resumes && !o.is_batch) throw Usage_error("--resume: for --batch");
  if (!o.is_batch) return;
  for (const char* other : {"cells", "samples-out", "fields", "provenance", "no-mesh"})
    if (values.count(other))
      throw Usage_error("--batch writes meshes and a report: not with --" + std::string(other));
}

void set_files(const po::variables_map& values, Program_options& o)
{
  std::vector<std::string> files;
  if (values.count("file")) files = values["file"].as<std::vector<std::string>>();
  o.write_mesh = !values.count("no-mesh");
  if (values.count("ascii")) o.encoding = Encoding::text;
  if (files.empty()) throw Usage_error("INPUT is missing");
  if (files.size() == 1 && o.write_mesh) throw Usage_error("OUTPUT is missing");
  if (files.size() > 2) throw Usage_error("one argument too many: '" + files[2] + "'");
  o.input = files[0];
  if (files.size() == 2) o.output = files[1];

  std::vector<std::pair<std::string, std::string>> written;
  if (o.write_mesh) written.emplace_back("OUTPUT", o.output);
  for (const auto& [option, file] :
       {std::pair{"report", &o.report_file}, std::pair{"html", &o.html_file},
        std::pair{"cells", &o.cells_file}, std::pair{"samples-out", &o.samples_file},
        std::pair{"fields", &o.fields_file}, std::pair{"provenance", &o.provenance_file}}) {
    if (!values.count(option)) continue;
    *file = values[option].as<std::string>();
    written.emplace_back("--" + std::string(option), *file);
  }
  if (written.empty())
    throw Usage_error(
        "--no-mesh leaves nothing to write: give --samples-out, --cells, --fields or --report");
  if (!o.html_file.empty() && !o.write_mesh)
    throw Usage_error("--html: there is no mesh to show with --no-mesh");
  if (!o.provenance_file.empty() && !o.write_mesh)
    throw Usage_error("--provenance: with --no-mesh there is none");
  if (!o.fields_file.empty() && o.remeshing.sampling != Sampling::lattice)
    throw Usage_error("--fields: only the samples of --sampling lattice begin as a lattice");
  for (std::size_t i = 0; i < written.size(); ++i) {
    if (written[i].second.empty())
      throw Usage_error(written[i].first + ": the file's name is empty");
    for (std::size_t j = 0; j < i; ++j)
      if (target_of(written[i].second) == target_of(written[j].second))
        throw Usage_error(written[j].first + " and " + written[i].first + " are the same file");
  }
}

} // namespace

Program_options parse_command_line(int argc, const char* const* argv, std::string& information)
{
  const Descriptions descriptions;
  const po::variables_map values = descriptions.parse(argc, argv);
  Program_options o;
  if (values.count("help"))
    information = descriptions.help();
  else if (values.count("version"))
    information = "power_rtf_remesh " POWER_RTF_VERSION "\n";
  if (!information.empty()) return o;

  o.remeshing = remeshing_options(values);
  const std::string traits = values.count("traits") ? values["traits"].as<std::string>() : "auto";
#ifndef CGAL_POWER_RTF_WITH_CUDA
  if (traits == "cuda")
    throw Usage_error("--traits cuda: these traits are not built into this program");
#endif
  if (traits != "auto" && traits != "cpu" && traits != "exact" && traits != "cuda")
    reject("traits", traits, "one of auto|cpu|exact|cuda");
  o.traits = traits;
  if (values.count("check-every"))
    o.check_every = parse_value<int>("check-every", values["check-every"].as<std::string>(),
                                     {0, double(std::numeric_limits<int>::max())});
  o.check = values.count("check") > 0 || o.check_every > 0;
  const std::string threads = values.count("threads") ? values["threads"].as<std::string>() : "0";
  o.threads = parse_value<int>("threads", threads, {0, 4096});
  o.quiet = values.count("quiet") > 0;
  set_fields(values, o);
  set_batch(values, o);
  set_files(values, o);
  return o;
}

} // namespace tools
