// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the library PowerRTF::cuda offers to C++: plain types and an opaque engine, no type of CUDA
// and none of CGAL. `Cuda_engine` makes the engine of the remesher from it.
#ifndef CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_API_H
#define CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_API_H

#include <CGAL/PowerRTF/engines/Engine_base.h>
#include <CGAL/PowerRTF/fields/Surface_work.h>
#include <CGAL/PowerRTF/geometry/Surface_in_tree.h>

#include <cstddef>
#include <future>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFTraits
/// No GPU can be used, its driver is too old, its memory does not suffice (the message says how
/// much was needed), it failed, or an option asks for more than the device engine can.
class Cuda_error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// \ingroup PkgPowerRTFTraits
/// A GPU.
struct Cuda_device {
  std::string name;
  std::size_t memory;         ///< bytes
  int compute_capability = 0; ///< 90: 9.0
};

/// \ingroup PkgPowerRTFTraits
/// The GPUs that can be used, at least one. \throws Cuda_error when there is none, saying why
std::vector<Cuda_device> cuda_devices();

/// \ingroup PkgPowerRTFTraits
/// Begins to start a GPU, which takes a process some .2 seconds the first time, in a thread that
/// the result waits for, if the system gives one. Who uses the GPU meanwhile waits, too, and is
/// told of its failures.
std::future<void> start_cuda_device(int device = 0);

/// \ingroup PkgPowerRTFTraits
/// Frees the memory of a GPU that a process keeps between its runs for the next one.
/// \throws Cuda_error when there is no such GPU
void release_cuda_memory(int device = 0);

/// Numbers that cells are computed in; sums are always double.
enum class Cuda_precision { single_precision, double_precision };

/// The memory of the GPU in bytes that a run takes, but for some per cent.
std::size_t cuda_memory(const Run_sizes& sizes, const Remeshing_options& options,
                        Cuda_precision precision);
/// \throws Cuda_error when GPU number `options.device` cannot be used or has less memory free than
/// the run takes, with how many samples would fit
void check_cuda_device(const Run_sizes& sizes, const Remeshing_options& options,
                       Cuda_precision precision);

/// An engine on GPU number `options.device`. \throws Cuda_error
std::unique_ptr<Engine_base> make_cuda_engine(const Surface_in_tree& surface,
                                              const Remeshing_options& options,
                                              Cuda_precision precision);

/// What is done to surfaces on a GPU. Where that fails, the host does it: engines say why.
Surface_work cuda_surface_work(int device);

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_API_H
