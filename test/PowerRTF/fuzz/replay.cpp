// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A fuzz target without a fuzzing engine: runs the files of a corpus and mutants of each, always
// the same ones, in chains of one from another. What fails is left in the file failed_input.
//
// Usage: TARGET CORPUS MUTANTS
#include "engine.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_size = 16384;
constexpr int chain_length = 20;

std::string input; // the one that runs

void keep_input(int)
{
  std::ofstream("failed_input", std::ios::binary) << input;
  std::cerr << "The input is in " << fs::absolute("failed_input") << std::endl;
}

void run()
{
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

void mutate(unsigned seed)
{
  const std::size_t size = input.size();
  input.resize(std::max(size, max_size));
  input.resize(LLVMFuzzerCustomMutator(reinterpret_cast<std::uint8_t*>(input.data()), size,
                                       input.size(), seed));
}

} // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t)
{
  static std::minstd_rand random;
  if (size > 0) data[random() % size] = static_cast<std::uint8_t>(random());
  return size;
}

int main(int argc, char** argv)
{
  if (argc != 3) {
    std::cerr << "Usage: " << argv[0] << " CORPUS MUTANTS\n";
    return 2;
  }
  std::signal(SIGABRT, keep_input);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(argv[1])) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  const int mutants = std::atoi(argv[2]);
  for (const fs::path& file : files) {
    std::ifstream in(file, std::ios::binary);
    const std::string content(std::istreambuf_iterator<char>(in), {});
    input = content;
    run();
    for (int k = 0; k < mutants; ++k) {
      if (k % chain_length == 0) input = content;
      mutate(static_cast<unsigned>(k));
      run();
    }
  }
  std::cout << files.size() << " files, " << mutants << " mutants of each\n";
  return files.empty();
}
