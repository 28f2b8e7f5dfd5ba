// SPDX-License-Identifier: Apache-2.0
#include "cli/run/shell.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>

#include "base/text.hpp"

namespace conform::cli {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void become(const char* command) {
  if (const int nothing = ::open("/dev/null", O_RDONLY); nothing >= 0) ::dup2(nothing, 0);
  ::dup2(2, 1);
  ::execl("/bin/sh", "sh", "-c", command, nullptr);
  ::_exit(127);
}

/// Runs the command in a process group of its own and writes how it ended to `told`. A process between,
/// because waiting for a child has no limit, reading from a pipe has, and what the command leaves in the
/// background must not hold the pipe. Also on kernels that have no pidfd.
[[noreturn]] void attend(const char* command, int told) {
  ::setpgid(0, 0);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
  const pid_t shell = ::fork();
  if (shell == 0) become(command);
  int status = 0;
  const bool ended = shell > 0 && ::waitpid(shell, &status, 0) == shell;
  ::_exit(ended && ::write(told, &status, sizeof status) == sizeof status ? 0 : 1);
}

enum class End : std::uint8_t { known, late, unknown };

/// How the command ended, when that comes before `limit`.
End read_end(int from, Clock::time_point limit, int& status) {
  for (auto now = Clock::now(); now < limit; now = Clock::now()) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(limit - now);
    pollfd one{from, POLLIN, 0};
    if (::poll(&one, 1, static_cast<int>(left.count())) <= 0) continue;
    return ::read(from, &status, sizeof status) == sizeof status ? End::known : End::unknown;
  }
  return End::late;
}

}  // namespace

Result<void> run_shell(const std::string& command, Duration limit) {
  const auto latest = Clock::now() + limit;
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return fail("the command could not be started: " + command);
  const pid_t child = ::fork();
  if (child == 0) attend(command.c_str(), ends[1]);
  ::close(ends[1]);
  int status = 0;
  auto end = End::unknown;
  if (child > 0) {
    ::setpgid(child, child);  // whoever of the two comes first
    end = read_end(ends[0], latest, status);
    if (end == End::late) ::kill(-child, SIGKILL);
    while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  ::close(ends[0]);
  if (end == End::late)
    return fail(fmt::format("the command did not end within {}: {}", to_string(limit), command));
  if (end == End::unknown) return fail("the command could not be started: " + command);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return fail(WIFEXITED(status)
                  ? fmt::format("the command failed with exit code {}: {}", WEXITSTATUS(status), command)
                  : fmt::format("the command was killed by signal {}: {}", WTERMSIG(status), command));
}

}  // namespace conform::cli
