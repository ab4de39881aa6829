// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "outcome.h"

#include <doctest/doctest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

/// How a process ends in which several threads throw what nobody catches, and what it says.
struct End {
  int status;
  std::string message;
};

template <class Exception>
End end_of_process(const Exception& exception)
{
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(ends[1], STDERR_FILENO);
    std::signal(SIGABRT, SIG_DFL); // not doctest's
    tools::end_where_threads_fail();
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k) threads.emplace_back([&] { throw exception; });
    for (std::thread& thread : threads) thread.join();
    ::_exit(0);
  }
  ::close(ends[1]);
  End end{0, ""};
  char buffer[256];
  for (ssize_t n; (n = ::read(ends[0], buffer, sizeof buffer)) > 0;) end.message.append(buffer, n);
  ::close(ends[0]);
  REQUIRE(::waitpid(child, &end.status, 0) == child);
  return end;
}

} // namespace

TEST_CASE("a thread that cannot start another one ends the program with a message")
{
  const End end = end_of_process(std::runtime_error("pthread_create has failed: no memory"));
  CHECK(WIFEXITED(end.status));
  CHECK(WEXITSTATUS(end.status) == tools::unusable_input);
  CHECK(end.message == "power_rtf_remesh: the system gives no more threads: pthread_create has "
                       "failed: no memory; --threads N sets their number\n");
}

TEST_CASE("a thread without memory ends the program with a message")
{
  const End end = end_of_process(std::bad_alloc());
  CHECK(WIFEXITED(end.status));
  CHECK(WEXITSTATUS(end.status) == tools::unusable_input);
  CHECK(end.message == "power_rtf_remesh: the memory does not suffice\n");
}

TEST_CASE("what else nobody catches ends the program as usual")
{
  const End end = end_of_process(std::logic_error("a bug"));
  CHECK(WIFSIGNALED(end.status));
  CHECK(WTERMSIG(end.status) == SIGABRT);
  CHECK(end.message.find("a bug") != std::string::npos);
}
