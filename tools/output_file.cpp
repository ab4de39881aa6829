// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "output_file.h"

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& file, const std::string& reason)
{
  throw Output_error(file + ": cannot be written: " + reason);
}

// Whether `target` is no file that another could replace: a device, a pipe, or what is open but has
// no name (of which target_of() leaves the link, as /dev/stdout).
bool is_written_directly(const fs::path& target)
{
  std::error_code ignored;
  return fs::is_other(target, ignored) ||
         (fs::is_symlink(target, ignored) && fs::exists(target, ignored));
}

fs::path temporary_for(const fs::path& target)
{
  static std::atomic<int> count{0};
  return target.parent_path() /
         (".power_rtf_" + std::to_string(::getpid()) + '_' + std::to_string(count++) + ".tmp");
}

// A file without a name in the folder of `target`, which goes with the process whatever ends it; -1
// where the system has none.
int open_unnamed(const fs::path& target)
{
#ifdef O_TMPFILE
  constexpr mode_t all = 0666; // less the user's mask
  return ::open(target.parent_path().c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, all);
#else
  (void)target;
  return -1;
#endif
}

// The path of a file that is open.
fs::path path_of(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

} // namespace

fs::path target_of(const std::string& file)
{
  std::error_code error;
  fs::path path = fs::absolute(file, error);
  if (error) return file;
  if (fs::exists(path, error)) { // a pipe has no path but this
    const fs::path canonical = fs::canonical(path, error);
    return error ? path : canonical;
  }
  constexpr int max_links = 40; // as the system follows
  for (int i = 0; i < max_links && fs::is_symlink(path, error); ++i)
    path = path.parent_path() / fs::read_symlink(path, error);
  const fs::path canonical = fs::weakly_canonical(path, error);
  return error ? path : canonical;
}

void check_writable(const std::string& file)
{
  const fs::path target = target_of(file);
  std::error_code ignored;
  if (fs::is_directory(target, ignored)) fail(file, "it is a directory");
  if (fs::exists(target, ignored) && ::access(target.c_str(), W_OK) != 0)
    fail(file, std::strerror(errno));
  if (is_written_directly(target)) return;
  if (fs::is_symlink(target, ignored)) fail(file, std::strerror(ELOOP));
  const fs::path folder = target.parent_path();
  if (!fs::exists(folder, ignored)) fail(file, "there is no directory " + folder.string());
  if (!fs::is_directory(folder, ignored)) fail(file, folder.string() + " is not a directory");
  if (const int trial = open_unnamed(target); trial >= 0) {
    ::close(trial);
    return;
  }
  const fs::path trial = temporary_for(target);
  errno = 0;
  if (!std::ofstream(trial)) fail(file, folder.string() + ": " + std::strerror(errno));
  fs::remove(trial, ignored);
}

Output_file::Output_file(const std::string& file) : m_name(file), m_target(target_of(file))
{
  constexpr std::ios::openmode mode = std::ios::out | std::ios::binary;
  if (!is_written_directly(m_target)) {
    m_unnamed = open_unnamed(m_target);
    if (m_unnamed >= 0 && m_buffer.open(path_of(m_unnamed), mode)) return;
    m_temporary = temporary_for(m_target);
  }
  errno = 0;
  if (!m_buffer.open(m_temporary.empty() ? m_target : m_temporary, mode))
    fail(m_name, std::strerror(errno));
}

Output_file::~Output_file()
{
  std::error_code ignored;
  if (m_unnamed >= 0) ::close(m_unnamed);
  if (!m_temporary.empty()) fs::remove(m_temporary, ignored);
}

void Output_file::close()
{
  errno = 0;
  if (!m_buffer.close() || !m_stream)
    fail(m_name, errno != 0 ? std::strerror(errno) : "not all could be written");
}

void Output_file::commit()
{
  if (m_temporary.empty()) {
    if (m_unnamed < 0) return;
    m_temporary = temporary_for(m_target); // as no name can be taken from another file
    if (::linkat(AT_FDCWD, path_of(m_unnamed).c_str(), AT_FDCWD, m_temporary.c_str(),
                 AT_SYMLINK_FOLLOW) != 0)
      fail(m_name, std::strerror(errno));
  }
  std::error_code error;
  if (fs::exists(m_target, error))
    fs::permissions(m_temporary, fs::status(m_target).permissions(), error);
  fs::rename(m_temporary, m_target, error);
  if (error) fail(m_name, error.message());
  m_temporary.clear();
}

} // namespace tools
