// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the library PowerRTF::cuda offers to C++: plain types and an opaque engine, no type of CUDA
// and none of CGAL. `Cuda_engine` makes the engine of the remesher from it.
#ifndef CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_API_H
#define CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_API_H

#include <CGAL/PowerRTF/Remeshing_options.h>
#include <CGAL/PowerRTF/Remeshing_report.h>
#include <CGAL/PowerRTF/cells/nearest_facet.h>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace CGAL
{
namespace PowerRTF
{

/// \ingroup PkgPowerRTFTraits
/// No GPU can be used, its driver is too old, its memory does not suffice (the message says how
/// much was needed), it failed, or an option asks for more than the device engine can.
class Cuda_error : public std::runtime_error
{
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

/// Numbers that cells are computed in; sums are always double.
enum class Cuda_precision { single_precision, double_precision };

/// The surface as the device gets it: all facets and vertices in the order of their trees.
struct Device_surface_input {
  struct Facet {
    Vec3d corners[3], normal; ///< the normal is of length 1
    int vertices[3];          ///< places in the tree of the vertices
    int patch;                ///< a sample is projected only onto facets of its own patch
  };
  struct Vertex {
    Vec3d point, normal;
    double density;
  };
  std::vector<Facet> facets;
  std::vector<Child_boxes> facet_nodes; ///< of a `Packed_tree_layout` over the facets
  std::vector<Vertex> vertices;
  std::vector<Child_boxes> vertex_nodes; ///< of one over the vertices; empty: not needed
  /// The facets at vertex v are `vertex_facets[first_facet[v]]` and so on to `first_facet[v + 1]`
  /// (places in the tree, by increasing number in the surface); empty: not needed.
  std::vector<int> first_facet, vertex_facets;
  double area = 0;
  bool has_patches = false;
};

/// The samples as arrays: the first `cells` have cells and move; the others only clip.
struct Device_samples {
  std::vector<Vec3d> points, normals;
  std::vector<int> facets;  ///< places in the tree
  std::vector<int> patches; ///< empty: all on one patch
  std::vector<double> density, weights;
  /// Of each sample the next one along its patch's boundary, or -1; empty when all have cells.
  std::vector<int> next;
  std::vector<int> order; ///< the place of each in the input of `set_samples()`
  int cells = 0;

  std::size_t size() const { return points.size(); }
};

/// A summary of the current cells: the one thing that is copied from the device per iteration.
struct Device_summary {
  double mass = 0;         ///< sum of m_i = rho_i A(F_i)
  Capacity_statistics capacity;
  double residual = 0;     ///< sum of |s_i - c_i|^2 over the cells that are ok and have a mass
  double displacement = 0; ///< sum of |s_i - c_i|^2
  double counts[4] = {};   ///< by `Cell_status`
};

/// A range of cells in full; the polygon of the k-th one has `size[k]` vertices at [64 k].
struct Device_polygons {
  static constexpr int stride = 64;
  std::vector<int> size, neighbor;
  std::vector<double> x, y; ///< in the tangent frame
  std::vector<unsigned char> status;
};

/// The steps of Algorithms 1 to 3 on the device; see `Host_engine` for what each does.
class Device_engine_base
{
public:
  virtual ~Device_engine_base() = default;
  virtual void set_samples(const Device_samples& samples) = 0;
  virtual void build_cells() = 0;
  virtual void update_weights() = 0;
  /// Passes of the paper's rule, each followed by a construction, until all masses are inside the
  /// interval, at most `passes`. Returns whether they are.
  virtual bool optimize_weights(int passes) = 0;
  virtual bool newton_weights() = 0;
  virtual void clear_weights() = 0;
  virtual void move_samples(Position_method method) = 0;
  virtual void restore_best() = 0;
  virtual Device_summary summary() = 0;
  virtual std::size_t constructions() const = 0;
  virtual Device_samples samples() = 0;
  virtual Device_polygons polygons(int begin, int end) = 0;

  virtual std::string device_name() const = 0;
  /// Seconds on the device from the end of `set_samples()`, which uploads them, to the last
  /// summary.
  virtual double seconds() = 0;
  /// Bytes of memory held on the device.
  virtual std::size_t bytes() const = 0;
};

/// \throws Cuda_error
std::unique_ptr<Device_engine_base> make_cuda_engine(const Device_surface_input& surface,
                                                     const Remeshing_options& options,
                                                     Cuda_precision precision);

} // namespace PowerRTF
} // namespace CGAL

#endif // CGAL_POWER_RTF_ENGINES_CUDA_ENGINE_API_H
