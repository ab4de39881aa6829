// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "Cuda_backend.h"

#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_select.cuh>
#include <thrust/iterator/counting_iterator.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace CGAL::PowerRTF {
namespace device {
namespace {

std::string gibibytes(std::size_t bytes)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << double(bytes) / (1 << 30) << " GiB";
  return text.str();
}

} // namespace

Cuda_backend::Cuda_backend(int device) : m_device(device)
{
  const std::vector<Cuda_device> devices = cuda_devices(); // says why there is none
  if (device < 0 || device >= int(devices.size()))
    throw Cuda_error("there is no GPU number " + std::to_string(device) +
                     ": the number of GPUs is " + std::to_string(devices.size()));
  check(cudaSetDevice(device), "choosing the device");
  cudaDeviceProp properties;
  check(cudaGetDeviceProperties(&properties, device), "asking for its properties");
  m_name = properties.name;
  m_multiprocessors = properties.multiProcessorCount;
  check(cudaStreamCreateWithFlags(&m_stream, cudaStreamNonBlocking), "making a stream");
  try {
    check(cudaEventCreate(&m_begin), "making an event");
    check(cudaEventCreate(&m_end), "making an event");
    check(cudaMallocHost(&m_pinned, pinned_bytes), "taking memory of the host");
    m_partials.allocate(*this, std::size_t(reduction_blocks) * max_totals);
    m_ticket.allocate(*this, 1);
    fill(m_ticket.data(), 0u, 1);
    start_clock();
    stop_clock();
    synchronize(); // a kernel that this device cannot run says so here
  } catch (...) {
    release();
    throw;
  }
}

Cuda_backend::~Cuda_backend()
{
  cudaSetDevice(m_device);
  cudaStreamSynchronize(m_stream);
  release();
}

void Cuda_backend::release() noexcept
{
  if (m_pinned) cudaFreeHost(m_pinned);
  if (m_begin) cudaEventDestroy(m_begin);
  if (m_end) cudaEventDestroy(m_end);
  cudaStreamDestroy(m_stream);
}

void* Cuda_backend::take(std::size_t bytes)
{
  if (bytes == 0) bytes = 1;
  void* p = nullptr;
  const cudaError_t code = cudaMalloc(&p, bytes);
  if (code == cudaErrorMemoryAllocation) {
    cudaGetLastError();
    std::size_t free = 0, total = 0;
    cudaMemGetInfo(&free, &total);
    throw Cuda_error("the memory of the GPU does not suffice: " + gibibytes(bytes) +
                     " more were needed beside " + gibibytes(m_bytes) + " in use; " +
                     gibibytes(free) + " of " + gibibytes(total) + " are free");
  }
  check(code, "taking memory");
  m_bytes += bytes;
  return p;
}

void Cuda_backend::give_back(void* p, std::size_t bytes) noexcept
{
  cudaFree(p);
  m_bytes -= bytes == 0 ? 1 : bytes;
}

double Cuda_backend::seconds() const
{
  check(cudaEventSynchronize(m_end), "clock");
  float milliseconds = 0;
  check(cudaEventElapsedTime(&milliseconds, m_begin, m_end), "clock");
  return milliseconds * 1e-3;
}

void Cuda_backend::sort_order(int n, std::uint64_t* keys, int* order)
{
  // Cubes about a quarter of the samples' spacing wide; a pass of the sort takes eight bits.
  int levels = 2;
  while (levels < 21 && (1ll << 2 * (levels - 2)) < n) ++levels;
  const int begin = std::max(63 - (3 * levels + 7) / 8 * 8, 0);
  m_keys.allocate(*this, n);
  m_places.allocate(*this, n);
  int* const places = m_places.data();
  for_each(n, [=] __device__(int i) { places[i] = i; });
  std::size_t bytes = 0;
  check(cub::DeviceRadixSort::SortPairs(nullptr, bytes, keys, m_keys.data(), places, order, n,
                                        begin, 63, m_stream),
        "sorting");
  m_scratch.allocate(*this, bytes);
  check(cub::DeviceRadixSort::SortPairs(m_scratch.data(), bytes, keys, m_keys.data(), places, order,
                                        n, begin, 63, m_stream),
        "sorting");
}

int Cuda_backend::select(int n, const unsigned char* is_wanted, int* items)
{
  if (n <= 0) return 0;
  m_selected.allocate(*this, 1);
  const thrust::counting_iterator<int> all(0);
  std::size_t bytes = 0;
  check(cub::DeviceSelect::Flagged(nullptr, bytes, all, is_wanted, items, m_selected.data(), n,
                                   m_stream),
        "selecting");
  m_scratch.allocate(*this, bytes);
  check(cub::DeviceSelect::Flagged(m_scratch.data(), bytes, all, is_wanted, items,
                                   m_selected.data(), n, m_stream),
        "selecting");
  int count = 0;
  download(&count, m_selected.data(), 1);
  return count;
}

} // namespace device

std::vector<Cuda_device> cuda_devices()
{
  int count = 0, driver = 0, runtime = 0;
  cudaDriverGetVersion(&driver);
  cudaRuntimeGetVersion(&runtime);
  const auto version = [](int v) {
    return std::to_string(v / 1000) + "." + std::to_string(v % 1000 / 10);
  };
  const cudaError_t code = cudaGetDeviceCount(&count);
  if (code != cudaSuccess) cudaGetLastError();
  if (driver == 0) throw Cuda_error("no driver of an NVIDIA GPU is installed");
  if (code == cudaErrorInsufficientDriver)
    throw Cuda_error("the driver of the GPU is too old: it knows CUDA " + version(driver) +
                     ", this program was built with CUDA " + version(runtime));
  if (code == cudaErrorNoDevice || (code == cudaSuccess && count == 0))
    throw Cuda_error("no GPU that CUDA can use is in this machine");
  device::check(code, "looking for GPUs");
  std::vector<Cuda_device> devices;
  for (int d = 0; d < count; ++d) {
    cudaDeviceProp p;
    device::check(cudaGetDeviceProperties(&p, d), "asking for its properties");
    devices.push_back({p.name, p.totalGlobalMem, p.major * 10 + p.minor});
  }
  return devices;
}

} // namespace CGAL::PowerRTF
