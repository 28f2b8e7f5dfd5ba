// SPDX-License-Identifier: Apache-2.0
// Where the journal of a run is, and what the journal of the run before says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "can/descriptor.hpp"
#include "journal/reader.hpp"
#include "journal/writer.hpp"

namespace conform::cli {

/// "$XDG_STATE_HOME/canopen-conform/can0-5.journal", or below ~/.local/state; empty where neither is set.
[[nodiscard]] std::string usual_journal(const std::string& interface, unsigned node);

class RunJournal {
 public:
  /// `wish`: the place the user wants it at. Without one, a run on an interface keeps it at the usual place,
  /// where the next run finds it, and a simulated run in memory.
  [[nodiscard]] static Result<RunJournal> open(const std::string& wish, const std::string& interface,
                                               unsigned node, bool simulated, const std::string& beside);

  /// Writes the first line, and what the run before has left changed. Error: the journal cannot be written.
  [[nodiscard]] Result<void> begin(journal::Writer& writer, const journal::Header& header,
                                   const result::RunResult& run) const;

  [[nodiscard]] int descriptor() const { return file_.get(); }
  /// Held as long as the run, and who watches over it, live; -1 where there is none.
  [[nodiscard]] int lock_descriptor() const { return lock_.get(); }
  [[nodiscard]] const std::string& path() const { return path_; }  ///< empty: in memory
  /// What the run before changed and did not put back. It stays so until somebody does.
  [[nodiscard]] const std::vector<journal::OldValue>& left() const { return left_; }
  /// The device of that run as it was read, as far as it was: "vendor-ID 00005AFEh, product code 00000301h".
  [[nodiscard]] const std::string& left_in() const { return left_in_; }
  [[nodiscard]] const std::string& why_not_usual() const { return why_not_usual_; }
  [[nodiscard]] bool earlier_was_killed() const { return earlier_was_killed_; }

 private:
  [[nodiscard]] Result<void> keep_in_memory();
  [[nodiscard]] Result<void> take_place(const std::string& wish, const std::string& home);
  void look_at_earlier(const std::string& home);

  can::Descriptor file_, lock_;
  std::string path_;
  std::vector<journal::OldValue> left_;
  std::string left_in_;
  bool earlier_was_killed_ = false;
  std::string why_not_usual_;
};

}  // namespace conform::cli
