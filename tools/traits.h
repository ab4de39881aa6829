// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The traits that `auto|cpu|exact|cuda` name.
#ifndef POWER_RTF_TOOLS_TRAITS_H
#define POWER_RTF_TOOLS_TRAITS_H

#ifdef CGAL_POWER_RTF_WITH_CUDA
#include <CGAL/PowerRTF/PowerRTF_cuda_traits_3.h>
#endif
#include <CGAL/PowerRTF/PowerRTF_exact_traits_3.h>
#include <CGAL/PowerRTF/PowerRTF_traits_3.h>
#include <CGAL/PowerRTF/Remeshing_options.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cstddef>
#include <future>
#include <string>
#include <thread>

namespace tools {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Concurrency = CGAL::Parallel_if_available_tag;

/// A type as a value.
template <class T>
struct Type {
  using type = T;
};

#ifdef CGAL_POWER_RTF_WITH_CUDA
/// Whether a GPU saves so many like meshes more than the start of its context costs, .35 s. What it
/// saves is processor time: 120 us a sample, with the paper's rule for the weights 1.5 ms, but for
/// 35 ms a mesh. (Measured on an H100 beside 4 and 16 cores, and 600 meshes at a time.) `--threads`
/// does not count, as it is to change no result.
inline bool is_gpu_faster(const CGAL::PowerRTF::Remeshing_options& options, std::size_t meshes)
{
  constexpr double start = 0.35, per_mesh = 0.035; // seconds
  const double per_sample =
      options.weight_method == CGAL::PowerRTF::Weight_method::multiplicative ? 1.5e-3 : 1.2e-4;
  const unsigned cores = (std::max)(1u, std::thread::hardware_concurrency());
  const double saved = per_sample * static_cast<double>(options.number_of_samples) - per_mesh;
  return static_cast<double>(meshes) * saved > start * cores;
}

/// Whether the traits of that name will surely use a GPU, if there is one.
inline bool is_gpu_wanted(const std::string& name, const CGAL::PowerRTF::Remeshing_options& options,
                          std::size_t meshes)
{
  return name == "cuda" || (name == "auto" && is_gpu_faster(options, meshes));
}
#endif

/// Begins to start the GPU if the traits of that name will surely use it; the result waits for
/// that.
inline std::future<void>
start_gpu([[maybe_unused]] const std::string& name,
          [[maybe_unused]] const CGAL::PowerRTF::Remeshing_options& options,
          [[maybe_unused]] std::size_t meshes = 1)
{
#ifdef CGAL_POWER_RTF_WITH_CUDA
  if (is_gpu_wanted(name, options, meshes))
    return CGAL::PowerRTF::start_cuda_device(options.device);
#endif
  return {};
}

/// What is done to surfaces by the GPU, if the traits of that name will surely use it.
inline CGAL::PowerRTF::Surface_work
surface_work([[maybe_unused]] const std::string& name,
             [[maybe_unused]] const CGAL::PowerRTF::Remeshing_options& options,
             [[maybe_unused]] std::size_t meshes = 1)
{
#ifdef CGAL_POWER_RTF_WITH_CUDA
  if (is_gpu_wanted(name, options, meshes))
    return CGAL::PowerRTF::cuda_surface_work(options.device);
#endif
  return {};
}

/// Returns `run(Type<Traits>(), gpu_not_used, has_failed)` for the traits of that name. For "auto",
/// they are the faster of CPU and GPU for so many meshes like this one, and the CPU stands in for a
/// GPU that fails: `run` is called again, unless the GPU fails before. `gpu_not_used` says why no
/// GPU is used although any traits will do, `has_failed` whether it could not.
template <class Run>
auto with_traits(const std::string& name, const CGAL::PowerRTF::Remeshing_options& options,
                 const Run& run, [[maybe_unused]] std::size_t meshes = 1)
{
  using Cpu_traits = CGAL::PowerRTF_traits_3<Kernel, Concurrency>;
  if (name == "exact")
    return run(Type<CGAL::PowerRTF_exact_traits_3<Kernel, Concurrency>>(), std::string(), false);
  if (name == "cpu") return run(Type<Cpu_traits>(), std::string(), false);
#ifdef CGAL_POWER_RTF_WITH_CUDA
  if (name == "auto" && !is_gpu_faster(options, meshes))
    return run(Type<Cpu_traits>(), std::string("the CPU is faster for so few samples"), false);
  std::string gpu_not_used;
  try {
    CGAL::PowerRTF::cuda_devices(); // before any work is done
    return run(Type<CGAL::PowerRTF_cuda_traits_3<Kernel>>(), std::string(), false);
  } catch (const CGAL::PowerRTF::Cuda_error& e) {
    if (name == "cuda")
      throw CGAL::PowerRTF::Cuda_error(std::string("the CUDA traits cannot be used: ") + e.what());
    gpu_not_used = e.what();
  }
  return run(Type<Cpu_traits>(), gpu_not_used, true);
#else
  (void)options;
  return run(Type<Cpu_traits>(), std::string("the CUDA traits are not built in"), false);
#endif
}

} // namespace tools

#endif // POWER_RTF_TOOLS_TRAITS_H
