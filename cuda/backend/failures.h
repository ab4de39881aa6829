// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What keeps a GPU from working, in words that its user understands.
#ifndef CGAL_POWER_RTF_CUDA_FAILURES_H
#define CGAL_POWER_RTF_CUDA_FAILURES_H

#include <CGAL/PowerRTF/engines/Cuda_engine_api.h>

#include <cuda_runtime.h>

#include <cstddef>
#include <string>

namespace CGAL::PowerRTF::device {

/// "1.50 GiB"
std::string gibibytes(std::size_t bytes);

/// Why the runtime returned `code` while it was at `what`: "starting a kernel".
std::string failure(cudaError_t code, const char* what);

/// Why there are no GPUs, from the result of cudaGetDeviceCount() and the versions that driver and
/// runtime have of CUDA (0: there is no driver). Empty: there are.
std::string reason_for_none(cudaError_t code, int count, int driver, int runtime);

/// \throws Cuda_error with `failure()`
inline void check(cudaError_t code, const char* what)
{
  if (code == cudaSuccess) return;
  cudaGetLastError(); // an error that is not sticky is forgotten
  throw Cuda_error(failure(code, what));
}

} // namespace CGAL::PowerRTF::device

#endif // CGAL_POWER_RTF_CUDA_FAILURES_H
