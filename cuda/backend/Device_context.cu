// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Device_context.h"

#include <map>
#include <memory>
#include <new>

namespace CGAL::PowerRTF {
namespace device {

void* Device_memory::take(std::size_t bytes)
{
  void* block = nullptr;
  const cudaError_t code = cudaMalloc(&block, bytes);
  if (code == cudaErrorMemoryAllocation) return cudaGetLastError(), nullptr;
  check(code, "taking memory");
  return block;
}

void* Pinned_memory::take(std::size_t bytes)
{
  void* block = nullptr;
  const cudaError_t code = cudaHostAlloc(&block, bytes, cudaHostAllocPortable);
  if (code == cudaErrorMemoryAllocation) return cudaGetLastError(), nullptr;
  check(code, "taking memory of the host");
  return block;
}

Device_context& Device_context::of(int device)
{
  // Never destroyed: at the end of the process the runtime, which does that itself, may be gone.
  static std::mutex& mutex = *new std::mutex;
  static auto& contexts = *new std::map<int, std::unique_ptr<Device_context>>;
  const std::lock_guard<std::mutex> lock(mutex);
  std::unique_ptr<Device_context>& context = contexts[device];
  if (!context) context.reset(new Device_context(device));
  check(cudaSetDevice(device), "choosing the device");
  return *context;
}

Device_context::Device_context(int device) : m_device(device)
{
  const std::vector<Cuda_device> devices = cuda_devices(); // says why there is none
  if (device < 0 || device >= int(devices.size()))
    throw Cuda_error("there is no GPU number " + std::to_string(device) +
                     ": the number of GPUs is " + std::to_string(devices.size()));
  m_name = devices[device].name;
  check(cudaDeviceGetAttribute(&m_multiprocessors, cudaDevAttrMultiProcessorCount, device),
        "asking for its properties");
}

Timed_stream Device_context::take_stream()
{
  {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (!m_streams.empty()) {
      const Timed_stream kept = m_streams.back();
      m_streams.pop_back();
      return kept;
    }
  }
  Timed_stream s;
  try {
    check(cudaStreamCreateWithFlags(&s.stream, cudaStreamNonBlocking), "making a stream");
    check(cudaEventCreate(&s.begin), "making an event");
    check(cudaEventCreate(&s.end), "making an event");
  } catch (...) {
    destroy(s);
    throw;
  }
  return s;
}

void Device_context::give_back(const Timed_stream& stream) noexcept
{
  try {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_streams.push_back(stream);
  } catch (const std::bad_alloc&) {
    destroy(stream);
  }
}

void Device_context::destroy(const Timed_stream& s) noexcept
{
  if (s.begin) cudaEventDestroy(s.begin);
  if (s.end) cudaEventDestroy(s.end);
  if (s.stream) cudaStreamDestroy(s.stream);
}

std::size_t Device_context::free_bytes() const
{
  std::size_t free = 0, total = 0;
  check(cudaMemGetInfo(&free, &total), "asking for its memory");
  return free + m_memory.kept();
}

} // namespace device

std::vector<Cuda_device> cuda_devices()
{
  int count = 0, driver = 0, runtime = 0;
  cudaDriverGetVersion(&driver);
  cudaRuntimeGetVersion(&runtime);
  const cudaError_t code = cudaGetDeviceCount(&count);
  if (code != cudaSuccess) cudaGetLastError();
  const std::string reason = device::reason_for_none(code, count, driver, runtime);
  if (!reason.empty()) throw Cuda_error(reason);
  std::vector<Cuda_device> devices;
  for (int d = 0; d < count; ++d) {
    cudaDeviceProp p;
    device::check(cudaGetDeviceProperties(&p, d), "asking for its properties");
    devices.push_back({p.name, p.totalGlobalMem, p.major * 10 + p.minor});
  }
  return devices;
}

std::future<void> start_cuda_device(int device)
{
  return std::async([device] { // without a thread to be had: not ahead
    try {
      device::Device_context::of(device);
    } catch (const Cuda_error&) { // told to who uses it
    }
  });
}

void release_cuda_memory(int device)
{
  device::Device_context& context = device::Device_context::of(device);
  context.memory().release();
  context.pinned_memory().release();
}

} // namespace CGAL::PowerRTF
