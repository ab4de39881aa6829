// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// power_rtf_remesh INPUT OUTPUT [options]: remeshes a surface from file to file, or many of them.
#include "program.h"

#include "Progress.h"
#include "batch.h"
#include "options.h"
#include "outcome.h"
#include "remesh_file.h"

#ifdef CGAL_LINKED_WITH_TBB
#include <tbb/global_control.h>
#include <tbb/info.h>
#endif

#include <cstddef>
#include <iostream>
#include <string>

namespace tools {
namespace {

/// Tells what the input has that the output does not have.
void print_losses(const Run& run)
{
  if (!run.options.write_mesh || run.not_carried_over.empty()) return;
  std::string list;
  for (const std::string& name : run.not_carried_over) list += (list.empty() ? "" : ", ") + name;
  std::cerr << "power_rtf_remesh: " << run.options.input
            << ": not carried over to the output: " << list << '\n';
}

/// Tells the user how the run ended.
Exit_code conclude(const Run& run)
{
  if (!run.options.quiet) {
    print_table(std::cout, run);
    print_losses(run);
  }
  print_faults(run);
  return exit_code(run);
}

Exit_code remesh(const Program_options& options)
{
  int threads = 1;
#ifdef CGAL_LINKED_WITH_TBB
  threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
#endif
  return options.is_batch ? remesh_files(options, threads)
                          : conclude(remesh_file(options, threads));
}

} // namespace

int run_program(int argc, const char* const* argv)
{
  handle_interrupts();
  end_where_threads_fail();
  std::string input;
  try {
    std::string information;
    const Program_options options = parse_command_line(argc, argv, information);
    if (!information.empty()) return std::cout << information, done;
    input = options.input;
    return remesh(options);
  } catch (...) {
    return fail(current_failure(input));
  }
}

} // namespace tools
