// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Files that are written whole or not at all.
#ifndef POWER_RTF_TOOLS_OUTPUT_FILE_H
#define POWER_RTF_TOOLS_OUTPUT_FILE_H

#include <CGAL/PowerRTF/internal/Cancellation.h>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>

namespace tools {

/// An output cannot be written; the program ends with exit code 5.
class Output_error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// The file that `file` refers to when symbolic links are followed, whether it exists or not. (The
/// links stay when it is written.)
std::filesystem::path target_of(const std::string& file);

/// Checks that `file` can be made or replaced, without changing it.
/// \throws Output_error naming file and reason
void check_writable(const std::string& file);

/// A file's buffer that polls whenever it is full or given a large block. A stream that is
/// cancelled is bad and takes no more: what writes to it comes to its end soon.
class Polling_buffer : public std::filebuf {
protected:
  int_type overflow(int_type c) override
  {
    CGAL::PowerRTF::internal::Cancellation::poll();
    return std::filebuf::overflow(c);
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override
  {
    using CGAL::PowerRTF::internal::Cancellation;
    constexpr std::streamsize large = 1 << 12;
    size < large ? Cancellation::poll_now_and_then() : Cancellation::poll();
    return std::filebuf::xsputn(text, size);
  }
};

/// Writes to a temporary file in the target's folder, which replaces the target at `commit()`. It
/// has no name until then, where the file system allows that: nothing is left of it even when the
/// process is killed. Without `commit()` the target stays as it was. (A device, a pipe, and what is
/// open without a name are written directly.) Symbolic links are followed.
class Output_file {
public:
  /// \throws Output_error when the temporary file cannot be made
  explicit Output_file(const std::string& file);
  ~Output_file();
  Output_file(const Output_file&) = delete;
  Output_file& operator=(const Output_file&) = delete;

  std::ostream& stream() { return m_stream; }
  /// Flushes all that was written. \throws Output_error when that fails
  void close();
  /// Replaces the target; after `close()`. \throws Output_error when that fails
  void commit();

private:
  std::string m_name;                          ///< as the user gave it
  std::filesystem::path m_target, m_temporary; ///< empty: the temporary file has no name, or
  int m_unnamed = -1;                          ///< (-1) there is none, and the target is written
  Polling_buffer m_buffer;
  std::ostream m_stream{&m_buffer};
};

} // namespace tools

#endif // POWER_RTF_TOOLS_OUTPUT_FILE_H
