// SPDX-License-Identifier: Apache-2.0
// The device is left as it was found: after each case, after a fault, and at the end; what is not is said.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/run_context.hpp"

namespace conform::engine {

class PuttingBack {
 public:
  explicit PuttingBack(RunContext& run) : run_(run) {}

  /// Takes down what the device holds before the first case, as far as there is time until `until`.
  [[nodiscard]] Result<void> look(std::optional<BusTime> until);

  /// Undoes what a case has written; by a reset where it cannot be written back.
  [[nodiscard]] Result<void> after_case(const result::CaseResult& result);
  /// The SDO server does not answer any more.
  void give_up(const std::string& why);
  /// A device that stores by itself (1010h, bit 1, or without saying so) may have stored what a test wrote,
  /// and a reset has brought it back since the last call; or it has restored (1011h) other values than it
  /// had.
  void after_resets();
  /// The bus broke or the user stopped: values are put back if that is still possible. `clean_up`: of the
  /// case that was stopped. Where the bus came back and goes away again meanwhile, the recorder tells the
  /// fault, and the next call puts back what this one could not.
  void after_fault(const std::function<Result<void>()>& clean_up, bool bus_is_back);
  /// At the end of the run; then compares with what was taken down.
  void finish();

 private:
  [[nodiscard]] Result<void> put_back(const result::CaseResult& result);
  [[nodiscard]] Result<void> end_life_guarding();
  [[nodiscard]] Result<bool> stores_by_itself();
  [[nodiscard]] std::vector<Change> take_changes();
  /// `restored`: by these entries of 1011h, before the reset.
  [[nodiscard]] std::vector<std::string> what_returned(const std::set<SubIndex>& restored = {});
  void note_left(const std::vector<std::string>& left);
  void leave_in_pre_operational();
  void look_for_unknown_tpdos();

  RunContext& run_;
  std::map<Multiplexer, Bytes> snapshot_;
  std::vector<Change> pending_;  ///< what a bus that went away has kept from being put back
  /// By cases, since the value that it had before the run was last found right behind a reset of the node.
  std::set<Multiplexer> written_;
  /// Entries of 1011h behind whose restore all values have been looked at: what they change that nobody wrote
  /// is among the written ones since.
  std::set<SubIndex> looked_at_behind_;
  std::set<std::string> left_;  ///< what the notes say of values that a reset brought back
  bool stores_by_itself_ = false;
  std::size_t resets_looked_at_ = 0;  ///< of session.resets(): what came back after them has been put right
};

}  // namespace conform::engine
