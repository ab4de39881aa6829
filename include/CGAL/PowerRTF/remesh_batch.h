// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Many meshes at a time.
#ifndef CGAL_POWER_RTF_REMESH_BATCH_H
#define CGAL_POWER_RTF_REMESH_BATCH_H

#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/internal/for_each_job.h>

#include <CGAL/tags.h>

#include <cstddef>
#include <exception>
#include <vector>

namespace CGAL::PowerRTF {

/// \ingroup PkgPowerRTFReport
/// What became of one of many meshes.
struct Batch_result {
  Remeshing_report report;  ///< as it was when `error` was thrown: empty
  std::exception_ptr error; ///< null: the mesh is done
};

/// \ingroup PkgPowerRTFRef
/// Remeshes many meshes, several at a time: as long as there are more of them than threads, each on
/// one thread. Every result is that of a run alone, bit for bit. With the CUDA traits the runs
/// share the GPU.
///
/// \tparam ConcurrencyTag `Sequential_tag`, `Parallel_tag` or `Parallel_if_available_tag`
/// \param n the number of meshes, up to \f$2^{31} - 1\f$
/// \param remesh `remesh(i)` returns the report of mesh i: it reads it, calls
///   `power_rtf_remeshing()` and writes the result, say. Called for each i in [0, n), begun in this
///   order, from several threads at once; what it throws is the error of this mesh only.
/// \returns a result for each mesh
template <class ConcurrencyTag = Parallel_if_available_tag, class Remesh>
std::vector<Batch_result> remesh_batch(std::size_t n, const Remesh& remesh)
{
  std::vector<Batch_result> results(n);
  internal::for_each_job(ConcurrencyTag(), static_cast<int>(n), [&](int i) {
    try {
      results[i].report = remesh(static_cast<std::size_t>(i));
    } catch (...) {
      results[i].error = std::current_exception();
    }
  });
  return results;
}

} // namespace CGAL::PowerRTF

#endif // CGAL_POWER_RTF_REMESH_BATCH_H
