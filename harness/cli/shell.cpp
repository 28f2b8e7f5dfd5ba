// SPDX-License-Identifier: Apache-2.0
#include "cli/shell.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>

#include "base/text.hpp"

namespace conform::cli {
namespace {

constexpr long between_looks_ns = 10'000'000;

[[noreturn]] void become(const char* command) {
  ::setpgid(0, 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
  if (const int nothing = ::open("/dev/null", O_RDONLY); nothing >= 0) ::dup2(nothing, 0);
  ::dup2(2, 1);
  ::execl("/bin/sh", "sh", "-c", command, nullptr);
  ::_exit(127);
}

}  // namespace

Result<void> run_shell(const std::string& command, Duration limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  const pid_t child = ::fork();
  if (child < 0) return fail("the command could not be started: " + command);
  if (child == 0) become(command.c_str());
  ::setpgid(child, child);  // whoever of the two comes first
  int status = 0;
  while (true) {
    const pid_t done = ::waitpid(child, &status, WNOHANG);
    if (done == child) break;
    if (done < 0 && errno != EINTR) return fail("the command could not be waited for: " + command);
    if (std::chrono::steady_clock::now() >= end) {
      ::kill(-child, SIGKILL);
      ::waitpid(child, &status, 0);
      return fail(fmt::format("the command did not end within {}: {}", to_string(limit), command));
    }
    const timespec pause{0, between_looks_ns};
    ::nanosleep(&pause, nullptr);
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return fail(WIFEXITED(status)
                  ? fmt::format("the command failed with exit code {}: {}", WEXITSTATUS(status), command)
                  : fmt::format("the command was killed by signal {}: {}", WTERMSIG(status), command));
}

}  // namespace conform::cli
