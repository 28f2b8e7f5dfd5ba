// SPDX-License-Identifier: Apache-2.0
#include "cli/run/guardian.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>

#include "base/sanitizer.hpp"
#include "base/text.hpp"
#include "cli/commands/commands.hpp"
#include "cli/run/run_reports.hpp"
#include "cli/run/terminal.hpp"
#include "cli/suite_folder.hpp"
#include "journal/reader.hpp"

namespace conform::cli {
namespace {

// Descriptors in the guardian.
constexpr int journal_place = 3;
constexpr int pipe_place = 4;
constexpr int lock_place = 5;

/// The processor time after which a run without a single frame or moment of bus time is taken to hang.
constexpr int hang_seconds = 60;

std::atomic<int> faulty_journal{-1};
std::atomic<std::uint64_t> progress{0};
std::uint64_t progress_seen = 0;
// AddressSanitizer tells of crashes itself: there the handler and its stack are not used.
[[maybe_unused]] std::array<std::uint8_t, 65536> fault_stack;

void write_line(int journal, const char* line) { journal::Writer::dying(journal, line, std::strlen(line)); }

[[maybe_unused]] void on_fault(int signal) {
  const int journal = faulty_journal.load();
  const char* line = nullptr;
  switch (signal) {
    case SIGSEGV: line = "{\"died\":11,\"why\":\"the runner crashed (SIGSEGV)\"}\n"; break;
    case SIGBUS: line = "{\"died\":7,\"why\":\"the runner crashed (SIGBUS)\"}\n"; break;
    case SIGFPE: line = "{\"died\":8,\"why\":\"the runner crashed (SIGFPE)\"}\n"; break;
    case SIGILL: line = "{\"died\":4,\"why\":\"the runner crashed (SIGILL)\"}\n"; break;
    default: line = "{\"died\":6,\"why\":\"the runner stopped itself (SIGABRT)\"}\n"; break;
  }
  write_line(journal, line);
  // The default action, set back when this handler was entered, ends the process.
  ::raise(signal);
}

void on_processor_time(int) {
  const auto now = progress.load();
  if (now != progress_seen) {
    progress_seen = now;
    return;
  }
  write_line(
      faulty_journal.load(),
      "{\"died\":0,\"why\":\"the simulated node hangs: for 60 s of processor time no frame came and no time passed\"}\n");
  ::_exit(exit_environment);
}

/// All of it, also where it has no name.
std::string text_of(int journal) {
  std::string text;
  std::array<char, 65536> buffer;
  off_t at = 0;
  for (;;) {
    const auto count = ::pread(journal, buffer.data(), buffer.size(), at);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(count));
    at += count;
  }
}

/// A byte says that the run ended by itself; the end of the pipe, without one, that the runner is gone.
void wait_for_the_end(int pipe) {
  char byte = 0;
  while (::read(pipe, &byte, 1) < 0 && errno == EINTR) {
  }
}

/// In the child, between fork and exec: only what may be called there.
[[noreturn]] void become_guardian(int journal, int pipe, int lock, const char* path) {
  ::setsid();  // what is sent to the terminal's group, Ctrl-C or kill -9, is not for it
  // First out of the way of the places where they go.
  const int a = ::fcntl(journal, F_DUPFD, 16);
  const int b = ::fcntl(pipe, F_DUPFD, 16);
  const int c = lock >= 0 ? ::fcntl(lock, F_DUPFD, 16) : -1;
  const int nothing = ::open("/dev/null", O_RDONLY);
  if (::dup2(a, journal_place) < 0 || ::dup2(b, pipe_place) < 0 || (c >= 0 && ::dup2(c, lock_place) < 0) ||
      ::dup2(nothing, 0) < 0)
    ::_exit(127);
  for (const int each : {a, b, c, nothing}) {
    if (each > lock_place) ::close(each);
  }
  ::execl("/proc/self/exe", "canopen-conform", "guard", "--journal", path, static_cast<char*>(nullptr));
  ::_exit(127);
}

}  // namespace

Guardian::Guardian(const RunJournal& journal) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return;
  const can::Descriptor theirs(ends[0]);
  life_ = can::Descriptor(ends[1]);
  const std::string path = journal.path().empty() ? "(in memory)" : journal.path();
  process_ = ::fork();
  if (process_ == 0)
    become_guardian(journal.descriptor(), theirs.get(), journal.lock_descriptor(), path.c_str());
}

Guardian::~Guardian() {
  if (process_ <= 0) return;
  // A close that fails may leave the pipe open: the guardian would then wait for this process, and this one
  // for it.
  const char over = 0;
  while (::write(life_.get(), &over, 1) < 0 && errno == EINTR) {
  }
  life_ = {};
  while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

int guard_command(const std::string& path) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT}) ::signal(signal, SIG_IGN);
  wait_for_the_end(pipe_place);
  auto left = journal::parse(text_of(journal_place), path);
  if (!left) return report_error(left.error(), exit_environment);
  if (left->reported) return 0;
  RunReports reports(left->header.reports);
  if (!left->finished) {
    const auto counts = left->run.counts();
    std::string places = reports.none() ? "" : "; its reports say so";
    if (!left->outstanding.empty() && !left->header.simulated)
      places += "; what it changed in the device is put back by: canopen-conform recover " + path;
    report_error({left->run.aborted.value_or("the runner was killed") + " (" +
                      std::to_string(counts.total() - counts.error) + " of " +
                      std::to_string(counts.total()) + " cases have a verdict)" + places,
                  {},
                  {}},
                 0);
  }
  if (!left->finished) name_known_mistakes(left->run, left->header.suites);
  reports.write_left(left->run);
  journal::Writer(journal_place).reported();
  return 0;
}

void record_faults_in(int journal) {
  if (address_sanitizer) return;  // its own handlers say more
  faulty_journal = journal;
  // Where the stack is exhausted the handler needs another one.
  stack_t stack{};
  stack.ss_sp = fault_stack.data();
  stack.ss_size = fault_stack.size();
  ::sigaltstack(&stack, nullptr);
  struct sigaction action{};
  action.sa_handler = on_fault;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_ONSTACK | SA_NODEFER);
  ::sigemptyset(&action.sa_mask);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) ::sigaction(signal, &action, nullptr);
}

void watch_progress(int journal) {
  faulty_journal = journal;
  struct sigaction action{};
  action.sa_handler = on_processor_time;
  action.sa_flags = SA_RESTART;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(SIGVTALRM, &action, nullptr);
  itimerval timer{};
  timer.it_interval.tv_sec = timer.it_value.tv_sec = hang_seconds;
  ::setitimer(ITIMER_VIRTUAL, &timer, nullptr);
}

void stop_watching() {
  const itimerval never{};
  ::setitimer(ITIMER_VIRTUAL, &never, nullptr);
}

void note_progress() { progress.fetch_add(1, std::memory_order_relaxed); }

}  // namespace conform::cli
