// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "failures.h"

#include <iomanip>
#include <sstream>

namespace CGAL::PowerRTF::device {
namespace {

/// "9.0"
std::string capability(int tenfold)
{
  return std::to_string(tenfold / 10) + "." + std::to_string(tenfold % 10);
}

std::string version(int thousandfold)
{
  return std::to_string(thousandfold / 1000) + "." + std::to_string(thousandfold % 1000 / 10);
}

/// Of the GPU that is the current one, as far as it tells.
std::string capability_of_device()
{
  int device = 0, major = 0, minor = 0;
  cudaGetDevice(&device);
  cudaDeviceGetAttribute(&major, cudaDevAttrComputeCapabilityMajor, device);
  cudaDeviceGetAttribute(&minor, cudaDevAttrComputeCapabilityMinor, device);
  cudaGetLastError();
  return major > 0 ? capability(10 * major + minor) : "unknown";
}

/// Those that this library was compiled for.
std::string capabilities_of_library()
{
  std::string list;
  for (const int architecture : {__CUDA_ARCH_LIST__})
    list += (list.empty() ? "" : ", ") + capability(architecture / 10);
  return list;
}

enum class Kind { other, no_code, busy, lost, old_driver, unready };

Kind kind_of(cudaError_t code)
{
  switch (code) {
  case cudaErrorNoKernelImageForDevice:
  case cudaErrorInvalidDeviceFunction:
  case cudaErrorInvalidKernelImage:
    return Kind::no_code;
  case cudaErrorDevicesUnavailable:
    return Kind::busy;
  case cudaErrorECCUncorrectable:
  case cudaErrorNvlinkUncorrectable:
  case cudaErrorHardwareStackError:
  case cudaErrorIllegalAddress:
  case cudaErrorIllegalInstruction:
  case cudaErrorMisalignedAddress:
  case cudaErrorInvalidAddressSpace:
  case cudaErrorInvalidPc:
  case cudaErrorLaunchFailure:
  case cudaErrorLaunchTimeout:
  case cudaErrorContextIsDestroyed:
  case cudaErrorUnknown:
    return Kind::lost;
  case cudaErrorInsufficientDriver:
  case cudaErrorUnsupportedPtxVersion:
    return Kind::old_driver;
  case cudaErrorSystemNotReady:
  case cudaErrorSystemDriverMismatch:
  case cudaErrorCompatNotSupportedOnDevice:
  case cudaErrorInitializationError:
    return Kind::unready;
  default:
    return Kind::other;
  }
}

} // namespace

std::string gibibytes(std::size_t bytes)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << double(bytes) / (1 << 30) << " GiB";
  return text.str();
}

std::string failure(cudaError_t code, const char* what)
{
  const std::string said = std::string(" (") + what + ": " + cudaGetErrorString(code) + ")";
  switch (kind_of(code)) {
  case Kind::no_code:
    return "this program has no code for the GPU, whose compute capability is " +
           capability_of_device() + ": it was built for " + capabilities_of_library() + said;
  case Kind::busy:
    return "the GPU is busy, or others have it for themselves" + said;
  case Kind::lost:
    return "the GPU is lost to this process: it failed" + said;
  case Kind::old_driver:
    return "the driver of the GPU is too old for this program" + said;
  case Kind::unready:
    return "the GPU's driver is not ready, or its parts do not match" + said;
  case Kind::other:
    break;
  }
  return "the GPU failed" + said;
}

std::string reason_for_none(cudaError_t code, int count, int driver, int runtime)
{
  if (driver == 0) return "no driver of an NVIDIA GPU is installed";
  if (code == cudaErrorInsufficientDriver)
    return "the driver of the GPU is too old: it knows CUDA " + version(driver) +
           ", this program was built with CUDA " + version(runtime);
  if (code == cudaErrorNoDevice || (code == cudaSuccess && count == 0))
    return "no GPU that CUDA can use is in this machine";
  return code == cudaSuccess ? "" : failure(code, "looking for GPUs");
}

} // namespace CGAL::PowerRTF::device
