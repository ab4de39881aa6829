// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "outcome.h"

#include "Progress.h"
#include "output_file.h"

#include <CGAL/PowerRTF/internal/errors.h>

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <initializer_list>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>

namespace tools {

Failure current_failure(const std::string& input)
{
  try {
    throw;
  } catch (const Usage_error& e) {
    return {wrong_usage, e.what() + std::string("\npower_rtf_remesh --help shows the options")};
  } catch (const Cancelled&) {
    return {Exit_code(cancelled + interrupted), "cancelled; nothing was written"};
  } catch (const std::bad_alloc&) {
    return {unusable_input, input + ": cannot be remeshed: the memory does not suffice"};
  } catch (const CGAL::PowerRTF::Invalid_input_error& e) {
    return {unusable_input, e.what()};
  } catch (const Output_error& e) {
    return {unwritable_output, e.what()};
  } catch (const std::exception& e) {
    return {unusable_input, input + ": cannot be remeshed: " + e.what()};
  }
}

void end_where_threads_fail()
{
  // Where memory is short nothing may be allocated: what a terminate handler throws aborts.
  static const auto end = [](std::initializer_list<const char*> message) {
    for (const char* part : message) std::fputs(part, stderr);
    std::_Exit(unusable_input);
  };
  static const std::terminate_handler usual = std::get_terminate();
  std::set_terminate([] {
    static std::atomic_flag is_ending = ATOMIC_FLAG_INIT;
    while (is_ending.test_and_set()) ::pause(); // another thread ends the program
    try {
      if (std::current_exception()) throw;
    } catch (const std::runtime_error& e) {
      if (std::strstr(e.what(), "pthread_create"))
        end({"power_rtf_remesh: the system gives no more threads: ", e.what(),
             "; --threads N sets their number\n"});
    } catch (const std::bad_alloc&) {
      end({"power_rtf_remesh: the memory does not suffice\n"});
    } catch (...) {
    }
    usual(); // a bug
  });
}

Exit_code exit_code(const Run& run)
{
  for (const Check& c : run.checks)
    if (!c.result.passed()) return wrong_cell;
  return run.missed.empty() ? done : missed_guarantee;
}

void print_faults(const Run& run)
{
  const Program_options& options = run.options;
  for (const std::string& missed : run.missed)
    std::cerr << "power_rtf_remesh: " << options.output << ": a guarantee is missed: " << missed
              << '\n';
  for (const Check& c : run.checks)
    if (!c.result.passed())
      fail({wrong_cell, options.input + ": after " + std::to_string(c.iterations) + " iterations " +
                            std::to_string(c.result.certified_wrong) +
                            " cells are wrong that were certified: a bug of this program"});
}

void tell_of_gpu(const Run& run)
{
  std::cerr << "power_rtf_remesh: " << run.options.input
            << ": goes on with the CPU: " << run.gpu_not_used << '\n';
}

Exit_code fail(const Failure& failure)
{
  std::cerr << "power_rtf_remesh: " << failure.message << '\n';
  return failure.code;
}

} // namespace tools
