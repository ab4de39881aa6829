// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The traits that run the optimization on an NVIDIA GPU. Programs that use them link
// PowerRTF::cuda.
#ifndef CGAL_POWER_RTF_CUDA_TRAITS_3_H
#define CGAL_POWER_RTF_CUDA_TRAITS_3_H

#include <CGAL/PowerRTF/engines/Cuda_engine.h>

#include <CGAL/tags.h>

namespace CGAL {

/// \ingroup PkgPowerRTFTraits
/// The traits that run the optimization on an NVIDIA GPU. Everything between the first samples and
/// the final ones happens on the device. The same input, seed and device give the same samples bit
/// for bit; they differ from those of the other traits by what rounding in single precision grows
/// to. The GPU is `PowerRTF::Remeshing_options::device`.
///
/// \cgalModels `PowerRTFTraits_3`
///
/// \tparam Kernel_ a CGAL kernel; the points of the input and the output are its `Point_3`.
/// \tparam Real `float`, or `double` for cells in double precision, about twice as slow where the
///   GPU has fast double precision and much slower elsewhere.
template <class Kernel_, class Real = float>
struct PowerRTF_cuda_traits_3 {
  using Kernel = Kernel_;
  /// Of what the host does: sampling, extraction, judging.
  using Concurrency_tag = Parallel_if_available_tag;
  using Engine = PowerRTF::Cuda_engine<Real>;
  /// The traits' name in reports.
  static const char* name() { return "cuda"; }
};

} // namespace CGAL

#endif // CGAL_POWER_RTF_CUDA_TRAITS_3_H
