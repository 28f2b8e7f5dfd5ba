// SPDX-License-Identifier: Apache-2.0
#include "cli/shell.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <ctime>

#include "base/text.hpp"

namespace conform::cli {
namespace {

[[noreturn]] void become(const char* command) {
  ::setpgid(0, 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
  if (const int nothing = ::open("/dev/null", O_RDONLY); nothing >= 0) ::dup2(nothing, 0);
  ::dup2(2, 1);
  ::execl("/bin/sh", "sh", "-c", command, nullptr);
  ::_exit(127);
}

/// Waits for the end of a child, no longer than until `end`. A kernel without pidfd (before 5.3) waits
/// without a limit.
bool ends_before(pid_t child, std::chrono::steady_clock::time_point end) {
  const auto watched = static_cast<int>(::syscall(SYS_pidfd_open, child, 0));
  if (watched < 0) return true;
  bool ended = false;
  for (auto now = std::chrono::steady_clock::now(); !ended && now < end;
       now = std::chrono::steady_clock::now()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - now);
    pollfd one{watched, POLLIN, 0};
    ended = ::poll(&one, 1, static_cast<int>(left.count())) > 0;
  }
  ::close(watched);
  return ended;
}

}  // namespace

Result<void> run_shell(const std::string& command, Duration limit) {
  const auto end = std::chrono::steady_clock::now() + limit;
  const pid_t child = ::fork();
  if (child < 0) return fail("the command could not be started: " + command);
  if (child == 0) become(command.c_str());
  ::setpgid(child, child);  // whoever of the two comes first
  int status = 0;
  if (!ends_before(child, end)) {
    ::kill(-child, SIGKILL);
    ::waitpid(child, &status, 0);
    return fail(fmt::format("the command did not end within {}: {}", to_string(limit), command));
  }
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) return fail("the command could not be waited for: " + command);
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return fail(WIFEXITED(status)
                  ? fmt::format("the command failed with exit code {}: {}", WEXITSTATUS(status), command)
                  : fmt::format("the command was killed by signal {}: {}", WTERMSIG(status), command));
}

}  // namespace conform::cli
