// SPDX-License-Identifier: Apache-2.0
// What each case is worth where there is no time for all: how long it takes, and how many known mistakes it
// finds that the cases before it do not. It decides no verdict, only what is played first and how long a run
// is said to last.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"

namespace conform::result {

/// A case as the reference node met it.
struct Worth {
  std::string name;       ///< with its instance: "cia301/sdo/upload/known[1008h:00]"
  Duration takes{};       ///< bus time
  std::size_t finds = 0;  ///< defects of the reference node that the cases before it in the list do not find
};

/// The cases of the suites, the most worth per time first.
class Worths {
 public:
  Worths() = default;
  explicit Worths(std::vector<Worth> cases);

  /// Places of these cases, by name, in the list: equal ones are worth the same. Another device has other
  /// objects: an instance that the list does not know takes the place of one of the same scenario that this
  /// device does not have.
  [[nodiscard]] std::vector<std::size_t> places(std::span<const std::string> names) const;
  /// What to expect: as the list says of the case, else the mean of its scenario, else the mean of all.
  [[nodiscard]] Duration takes(std::string_view name) const;

  [[nodiscard]] const std::vector<Worth>& cases() const { return cases_; }

 private:
  std::vector<Worth> cases_;
  std::map<std::string, std::size_t, std::less<>> by_name_;
  std::map<std::string, std::vector<std::size_t>, std::less<>> by_scenario_;  ///< ascending
  Duration mean_ = std::chrono::milliseconds(300);
};

/// How much longer the cases of a run take than expected, learnt from those that were played.
class Pace {
 public:
  void took(Duration expected, Duration needed) {
    expected_ += expected;
    needed_ += needed;
  }
  [[nodiscard]] Duration of(Duration expected) const;

 private:
  Duration expected_{}, needed_{};
};

/// suites/patterns/worth.json, made by `canopen-conform selftest --patterns`: a line for each case.
[[nodiscard]] std::string worth_file(std::span<const Worth> cases);
/// Error: no such file, with the place of the mistake; `where` is its name.
[[nodiscard]] Result<Worths> read_worths(std::string_view text, const std::string& where);

}  // namespace conform::result
