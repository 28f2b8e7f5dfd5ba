// SPDX-License-Identifier: Apache-2.0
#include "cli/run/run_journal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "base/files.hpp"
#include "cli/run/remains.hpp"
#include "cli/run/run_reports.hpp"

namespace conform::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t largest_journal = std::uint64_t{4} << 30U;

std::unexpected<Error> cannot(const std::string& what, const std::string& path) {
  return fail("cannot " + what + ": " + std::generic_category().message(errno), path,
              "--journal FILE puts the journal elsewhere");
}

can::Descriptor open_file(const std::string& path) {
  return can::Descriptor(
      ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600));
}

/// What watches over a run that was just killed still makes its reports: that takes a moment.
bool locked(int descriptor, bool patient) {
  for (int attempt = 0; attempt < (patient ? 40 : 1); ++attempt) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return true;
    if (errno != EWOULDBLOCK) return true;  // a file system without locks
    if (patient) ::poll(nullptr, 0, 50);
  }
  return false;
}

}  // namespace

std::string usual_journal(const std::string& interface, unsigned node) {
  std::string folder;
  if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/') {
    folder = state;
  } else if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
    folder = std::string(home) + "/.local/state";
  } else {
    return {};
  }
  return folder + "/canopen-conform/" + interface + "-" + std::to_string(node) + ".journal";
}

Result<RunJournal> RunJournal::open(const std::string& wish, const std::string& interface, unsigned node,
                                    bool simulated, const std::string& beside) {
  RunJournal out;
  if (simulated && wish.empty()) {
    if (auto done = out.keep_in_memory(); !done) return std::unexpected(done.error());
    return out;
  }
  if (!wish.empty()) {
    std::error_code ignored;
    const auto size = fs::file_size(wish, ignored);
    if (!ignored && size > 0 && !journal::read(wish))
      return fail("will not be overwritten: it is no journal", wish, "--journal FILE");
  }
  const auto home = simulated ? std::string() : usual_journal(interface, node);
  auto taken = home.empty() && wish.empty()
                   ? Result<void>(fail("neither XDG_STATE_HOME nor HOME says where journals are kept"))
                   : out.take_place(absolute(wish), home);
  if (taken) return out;
  if (!wish.empty()) return std::unexpected(taken.error());
  // A machine without a home for us can still test; only the next run will not know of this one.
  RunJournal other;
  other.why_not_usual_ = taken.error().text();
  taken = beside.empty() ? other.keep_in_memory() : other.take_place(beside + ".journal", {});
  if (!taken) return std::unexpected(taken.error());
  return other;
}

Result<void> RunJournal::keep_in_memory() {
  file_ = can::Descriptor(::memfd_create("canopen-conform-journal", MFD_CLOEXEC));
  if (!file_.valid()) return cannot("make room for the journal", "memory");
  return {};
}

Result<void> RunJournal::take_place(const std::string& wish, const std::string& home) {
  std::string usual = home;
  if (!home.empty()) {
    std::error_code failed;
    fs::create_directories(fs::path(home).parent_path(), failed);
    // Another network namespace may have an interface of this name; its runs have files of their own.
    for (int number = 1; number < 100; ++number) {
      if (number > 1) usual = home.substr(0, home.size() - 8) + "." + std::to_string(number) + ".journal";
      auto file = open_file(usual);
      if (!file.valid()) {
        if (wish.empty()) return cannot("open the journal", usual);
        break;
      }
      if (!locked(file.get(), number == 1)) continue;
      lock_ = std::move(file);
      break;
    }
    if (!lock_.valid() && wish.empty())
      return fail("too many runs keep a journal for this interface", home, "--journal FILE");
  }
  if (lock_.valid()) look_at_earlier(usual);
  path_ = wish.empty() ? usual : wish;
  if (wish.empty()) {
    file_ = can::Descriptor(::fcntl(lock_.get(), F_DUPFD_CLOEXEC, 0));
  } else {
    file_ = open_file(wish);
    if (!file_.valid()) return cannot("open the journal", wish);
  }
  // An empty file was just made by us, or left by somebody who came no further.
  if (::ftruncate(file_.get(), 0) != 0) return cannot("empty the journal", path_);
  if (!wish.empty() && lock_.valid()) {
    const auto pointer = journal::pointer_to(wish);
    if (::ftruncate(lock_.get(), 0) != 0 || ::write(lock_.get(), pointer.data(), pointer.size()) < 0)
      return cannot("write", usual);
  }
  return {};
}

void RunJournal::look_at_earlier(const std::string& home) {
  const auto earlier = journal::read(home);
  if (!earlier) return;  // empty, or nothing that concerns us
  left_ = earlier->outstanding;
  left_in_ = device_of(earlier->run);
  earlier_was_killed_ = !earlier->finished;
  if (earlier->finished && left_.empty()) return;
  // Reports can still be made from it.
  const auto text = read_file(earlier->path, largest_journal);
  if (!text) return;
  // Where it cannot be kept, the run is not held up for it.
  std::error_code ignored;
  if (!write_file_atomically(home + ".old", *text)) std::filesystem::remove(home + ".old", ignored);
}

Result<void> RunJournal::begin(journal::Writer& writer, const journal::Header& header,
                               const result::RunResult& run) const {
  writer.begin(header, run);
  for (auto value : left_) {
    value.during.clear();
    writer.changing(value);
  }
  if (writer.error() == 0) return {};
  return fail("cannot write the journal: " + std::generic_category().message(writer.error()), path_,
              "--journal FILE puts it elsewhere");
}

}  // namespace conform::cli
