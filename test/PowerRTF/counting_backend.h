// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An engine as on a device, on the host: its arrays are copies, and what is held and what goes up
// is counted.
#ifndef POWER_RTF_TEST_COUNTING_BACKEND_H
#define POWER_RTF_TEST_COUNTING_BACKEND_H

#include <CGAL/PowerRTF/cells/Tree_cells.h>
#include <CGAL/PowerRTF/engines/Engine.h>
#include <CGAL/PowerRTF/engines/Surface_engine.h>
#include <CGAL/PowerRTF/internal/Host_backend.h>

#include <algorithm>
#include <cstddef>
#include <memory>

namespace counting {

using namespace CGAL::PowerRTF;

/// Its loops run on the host.
template <class Tag>
class Backend : public Host_backend<Tag> {
  using Base = Host_backend<Tag>;

public:
  static constexpr bool is_host = false;
  static constexpr int device = 7;
  inline static std::size_t uploaded = 0; ///< bytes, by all of them

  /// Bytes that count for as long as it lives.
  struct Uncount {
    std::size_t bytes;
    void operator()(Backend* backend) const { backend->m_bytes -= bytes; }
  };
  using Count = std::unique_ptr<Backend, Uncount>;

  template <class T>
  class Buffer {
  public:
    void allocate(Backend& backend, std::size_t n)
    {
      m_items.allocate(backend, n);
      if (n * sizeof(T) > m_count.get_deleter().bytes) {
        m_count.reset();
        m_count = backend.counted(n * sizeof(T));
      }
    }
    T* data() { return m_items.data(); }
    const T* data() const { return m_items.data(); }
    std::size_t size() const { return m_items.size(); }

  private:
    typename Base::template Buffer<T> m_items;
    Count m_count;
  };

  static bool has(const Resident_surface& surface) { return surface.device == device; }
  template <class T>
  void upload(T* to, const T* from, std::size_t n)
  {
    uploaded += n * sizeof(T);
    Base::upload(to, from, n);
  }
  std::size_t bytes() const { return m_most; }
  static std::size_t least_bytes() { return 0; }

private:
  Count counted(std::size_t bytes)
  {
    m_bytes += bytes;
    m_most = std::max(m_most, m_bytes);
    return {this, {bytes}};
  }

  std::size_t m_bytes = 0, m_most = 0;
};

/// Those of the host, which are not counted.
template <class Real, class Tag>
class Host_cells : public Tree_cells<Real, Host_backend<Tag>> {
public:
  using Tree_cells<Real, Host_backend<Tag>>::Tree_cells;
  static std::size_t bytes(int, bool) { return 0; }
  static std::size_t neighbors_bytes(int) { return 0; }
};

template <class Real, class Tag>
using Engine_of = Engine<Real, Backend<Tag>, Host_cells<Real, Tag>>;

template <class Real, class Tag>
struct Make_counted {
  using Concurrency_tag = Tag;
  static void check(const Run_sizes&, const Remeshing_options&) {}
  static Surface_work surface_work(const Remeshing_options&) { return {}; }
  static std::unique_ptr<Engine_base> make(const Surface_in_tree& surface,
                                           const Remeshing_options& options)
  {
    return std::make_unique<Engine_of<Real, Tag>>(surface, options);
  }
};

template <class Real, class Tag = CGAL::Sequential_tag>
using Counted_engine = Surface_engine<Make_counted<Real, Tag>>;

} // namespace counting

#endif // POWER_RTF_TEST_COUNTING_BACKEND_H
