// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "batch.h"

#include "Progress.h"
#include "output_file.h"
#include "remesh_file.h"

#include <CGAL/PowerRTF/internal/Stopwatch.h>
#include <CGAL/PowerRTF/internal/errors.h>
#include <CGAL/PowerRTF/internal/for_each_job.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <vector>

namespace tools {
namespace {

namespace fs = std::filesystem;
using CGAL::PowerRTF::Invalid_input_error;
using CGAL::PowerRTF::Remeshing_report;

[[noreturn]] void cannot_list(const std::string& list, const std::string& reason)
{
  throw Invalid_input_error(list + ": the files to remesh cannot be listed: " + reason);
}

/// The meshes in a folder, by their names.
std::vector<std::string> files_in(const std::string& folder)
{
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
    const std::string file = i->path().string();
    const Format format = format_of(file);
    if (is_read(format)) files.push_back(file);
  }
  if (error) cannot_list(folder, error.message());
  std::sort(files.begin(), files.end());
  return files;
}

/// The lines of a text file that are not empty.
std::vector<std::string> lines_of(const std::string& file)
{
  errno = 0;
  std::ifstream in(file);
  if (!in) cannot_list(file, std::strerror(errno));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (!line.empty()) lines.push_back(line);
  }
  return lines;
}

/// One file of the batch, and what became of it.
struct Item {
  std::string input, output;
  Failure failure;
  bool is_there = false, is_done = false; ///< before, and now
};

/// Whether `output` has been written after `input`.
bool is_newer(const std::string& output, const std::string& input)
{
  std::error_code error;
  if (!fs::is_regular_file(output, error)) return false;
  const fs::file_time_type written = fs::last_write_time(output, error),
                           changed = fs::last_write_time(input, error);
  return !error && written >= changed;
}

/// Where the mesh of a file goes: into the folder, by the same name.
std::string output_for(const std::string& input, const Program_options& options)
{
  fs::path name = fs::path(input).filename();
  if (!options.format.empty()) name.replace_extension(options.format);
  return (fs::path(options.output) / name).string();
}

std::vector<Item> items_of(const Program_options& options)
{
  std::error_code ignored;
  const bool is_folder = fs::is_directory(options.input, ignored);
  const auto files = is_folder ? files_in(options.input) : lines_of(options.input);
  if (files.empty()) cannot_list(options.input, is_folder ? "it has no mesh" : "it is empty");
  std::vector<Item> items;
  std::map<std::string, std::string> input_of;
  for (const std::string& file : files) {
    const std::string output = output_for(file, options);
    const auto [other, is_new] = input_of.emplace(output, file);
    if (!is_new)
      throw Usage_error("--batch: " + other->second + " and " + file +
                        " would both be written to " + output);
    items.push_back({file, output, {}});
    if (options.resumes) items.back().is_there = is_newer(output, file);
  }
  return items;
}

/// Opens the report for lines that follow. \param goes_on after those that are there: whole ones
std::ofstream open_report(const std::string& file, bool goes_on)
{
  std::error_code ignored;
  if (goes_on && fs::is_regular_file(file, ignored)) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    fs::resize_file(file, text.str().rfind('\n') + 1, ignored);
  }
  std::ofstream report(file, std::ios::binary | (goes_on ? std::ios::app : std::ios::trunc));
  if (!report) throw Output_error(file + ": cannot be written: " + std::strerror(errno));
  return report;
}

void make_folder(const std::string& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw Output_error(folder + ": cannot be made: " + error.message());
}

/// The batch as it goes on; its members may be called on several threads at once.
class Batch {
public:
  Batch(const Program_options& options, int threads)
      : m_options(options), m_threads(threads), m_items(items_of(options)),
        m_progress(options.quiet)
  {
    m_there = std::count_if(m_items.begin(), m_items.end(),
                            [](const Item& item) { return item.is_there; });
    m_progress.on_stage("batch");
    m_progress.on_progress(share());
  }

  std::size_t size() const { return m_items.size(); }

  /// \throws Output_error the report cannot be written
  void begin_report()
  {
    if (!m_options.report_file.empty())
      m_report = open_report(m_options.report_file, m_options.resumes);
  }

  void remesh(std::size_t i)
  {
    Item& item = m_items[i];
    if (interrupted || item.is_there) return;
    Run run;
    run.options = m_options;
    run.options.is_batch = false;
    run.options.meshes = size();
    run.options.input = item.input;
    run.options.output = item.output;
    run.options.report_file.clear();
    run.options.quiet = true; // its progress would be drawn over that of others
    try {
      run = remesh_file(run.options, m_threads);
      item.failure.code = exit_code(run);
      item.is_done = true;
    } catch (...) {
      item.failure = current_failure(item.input);
      run.error = item.failure.message;
    }
    if (!interrupted || item.is_done) finish(item, run);
  }

  /// Tells how it went and writes the report.
  Exit_code conclude(double seconds)
  {
    m_progress.clear();
    if (interrupted)
      return fail({Exit_code(cancelled + interrupted), "cancelled; " + std::to_string(m_written) +
                                                           " of " + std::to_string(size()) +
                                                           " meshes are written"});
    if (!m_options.quiet)
      std::cout << m_written << " of " << size() << " meshes in " << rounded("%.2f", seconds)
                << " s, " << rounded("%.1f", double(m_written) / seconds) << " a second"
                << (m_options.resumes ? "; " + std::to_string(m_there) + " were there" : "")
                << '\n';
    if (!m_report) return fail({unwritable_output, m_options.report_file + ": cannot be written"});
    for (const Exit_code code : {unwritable_output, unusable_input, wrong_cell, missed_guarantee})
      for (const Item& item : m_items)
        if (item.failure.code == code) return code;
    return done;
  }

private:
  static std::string rounded(const char* format, double x)
  {
    char text[64];
    std::snprintf(text, sizeof(text), format, x);
    return text;
  }

  void finish(const Item& item, const Run& run)
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    ++m_finished;
    if (m_report.is_open()) {
      write_json_line(m_report, run);
      m_report.flush();
    }
    if (item.is_done) ++m_written;
    m_progress.clear();
    if (run.has_gpu_failed && !m_options.quiet && m_told_of_gpu.insert(run.gpu_not_used).second)
      tell_of_gpu(run);
    if (!item.is_done)
      fail(item.failure);
    else if (!m_options.quiet)
      print_line(run);
    print_faults(run);
    m_progress.on_progress(share());
  }

  double share() const { return double(m_there + m_finished) / double(size()); }

  void print_line(const Run& run) const
  {
    const Remeshing_report& r = run.report;
    std::cout << run.options.input << " -> " << run.options.output << ": " << r.topology.vertices
              << " vertices, least quality " << rounded("%.3f", r.quality.q_min)
              << ", largest distance " << rounded("%.3f", r.distance.max) << " %, "
              << rounded("%.2f", r.seconds.total) << " s\n";
  }

  const Program_options& m_options;
  int m_threads;
  std::vector<Item> m_items;
  std::ofstream m_report;              // not open: none is asked for
  std::set<std::string> m_told_of_gpu; // why it failed: for the first mesh that it did
  std::size_t m_there = 0, m_finished = 0, m_written = 0;
  Progress m_progress;
  std::mutex m_mutex;
};

} // namespace

Exit_code remesh_files(const Program_options& options, int threads)
{
  double seconds = 0;
  if (!options.report_file.empty()) check_writable(options.report_file);
  Batch batch(options, threads);
  make_folder(options.output);
  batch.begin_report();
  {
    const CGAL::PowerRTF::internal::Stopwatch watch(seconds);
    CGAL::PowerRTF::internal::for_each_job(CGAL::Parallel_if_available_tag(),
                                           static_cast<int>(batch.size()),
                                           [&](int i) { batch.remesh(i); });
  }
  return batch.conclude(seconds);
}

} // namespace tools
