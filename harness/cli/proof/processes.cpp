// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/processes.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <new>
#include <string_view>
#include <thread>

#include "base/check.hpp"
#include "base/sanitizer.hpp"

namespace conform::cli {
namespace {

// How a child says by its exit code what it could not say in words.
constexpr int threw = 70;
constexpr int no_memory = 71;

void limit(auto resource, rlim_t soft, rlim_t hard) {
  const rlimit value{soft, hard};
  CONFORM_CHECK(::setrlimit(resource, &value) == 0);
}

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const auto written = ::write(descriptor, text.data(), text.size());
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

[[noreturn]] void child(int descriptor, const ProcessLimits& limits, std::size_t number,
                        const std::function<std::string(std::size_t)>& work) {
  // What a crash says belongs to nobody; whoever hangs first gets SIGXCPU, then SIGKILL.
  if (const int null = ::open("/dev/null", O_WRONLY); null >= 0) ::dup2(null, STDERR_FILENO);
  limit(RLIMIT_CPU, limits.seconds, limits.seconds + 2);
  if (!address_sanitizer) limit(RLIMIT_AS, limits.memory, limits.memory);
  limit(RLIMIT_CORE, 0, 0);
  // Nobody but the parent is told of a crash.
  for (const int signal : {SIGXCPU, SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGTERM, SIGINT})
    std::signal(signal, SIG_DFL);
  try {
    write_all(descriptor, work(number));
    ::_exit(0);
  } catch (const std::bad_alloc&) {
    ::_exit(no_memory);
  } catch (const std::exception& error) {
    write_all(descriptor, error.what());
    ::_exit(threw);
  }
}

struct Running {
  pid_t process;
  int descriptor;
  std::size_t number;
  std::string text;
};

Running start(std::size_t number, const ProcessLimits& limits,
              const std::function<std::string(std::size_t)>& work) {
  std::array<int, 2> ends{};
  CONFORM_CHECK(::pipe2(ends.data(), O_CLOEXEC) == 0);
  const pid_t process = ::fork();
  CONFORM_CHECK(process >= 0);
  if (process == 0) {
    ::close(ends[0]);
    child(ends[1], limits, number, work);
  }
  ::close(ends[1]);
  return {process, ends[0], number, {}};
}

Ending ending_of(Running& running) {
  ::close(running.descriptor);
  int status = 0;
  while (::waitpid(running.process, &status, 0) < 0 && errno == EINTR) {
  }
  using Kind = Ending::Kind;
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU || signal == SIGKILL) return {Kind::hung, "ran until its time was over"};
    const char* name = ::sigabbrev_np(signal);
    return {Kind::crashed, name == nullptr ? "signal" : std::string("SIG") + name};
  }
  switch (WEXITSTATUS(status)) {
    case 0: return {Kind::returned, std::move(running.text)};
    case no_memory: return {Kind::out_of_memory, "asked for more memory than there is"};
    case threw: return {Kind::crashed, "exception: " + running.text};
    default: return {Kind::crashed, "exit code " + std::to_string(WEXITSTATUS(status))};
  }
}

/// Reads what there is; false at the end.
bool take(Running& running) {
  std::array<char, 4096> buffer{};
  const auto size = ::read(running.descriptor, buffer.data(), buffer.size());
  if (size < 0 && errno == EINTR) return true;
  if (size <= 0) return false;
  running.text.append(buffer.data(), static_cast<std::size_t>(size));
  return true;
}

}  // namespace

std::vector<Ending> in_processes(std::size_t count, unsigned jobs, const ProcessLimits& limits,
                                 const std::function<std::string(std::size_t)>& work,
                                 const std::function<void(std::size_t)>& ended) {
  if (jobs == 0) jobs = std::max(1U, std::thread::hardware_concurrency());
  std::vector<Ending> out(count);
  std::vector<Running> running;
  for (std::size_t next = 0; next < count || !running.empty();) {
    while (next < count && running.size() < jobs) running.push_back(start(next++, limits, work));
    std::vector<pollfd> waited;
    for (const auto& each : running) waited.push_back({each.descriptor, POLLIN, 0});
    if (::poll(waited.data(), waited.size(), -1) < 0) continue;  // a signal
    for (std::size_t i = waited.size(); i-- > 0;) {
      if (waited[i].revents == 0 || take(running[i])) continue;
      const std::size_t number = running[i].number;
      out[number] = ending_of(running[i]);
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
      if (ended) ended(number);
    }
  }
  return out;
}

}  // namespace conform::cli
