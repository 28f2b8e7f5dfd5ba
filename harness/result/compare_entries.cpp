// SPDX-License-Identifier: Apache-2.0
// What two runs saw of the object dictionary.
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "base/text.hpp"
#include "result/compare_observed.hpp"
#include "result/compare_steps.hpp"

namespace conform::result {
namespace {

/// "2003h:05"
constexpr std::size_t multiplexer_length = 8;
constexpr std::array<std::string_view, 2> absences{"abort 0602 0000h", "abort 0609 0011h"};

bool is_value(std::string_view step, std::string_view actual) {
  return answer_kind(step, actual) == "a value";
}

std::string bytes_text(ByteView bytes) { return bytes.empty() ? "(no data)" : hex_bytes(bytes); }

/// What a run knows of an entry.
struct Entry {
  bool is_there = false, is_absent = false;
  std::set<std::string> values;    ///< that were read of it
  const Change* change = nullptr;  ///< what it held before it was written
};

class Dictionary {
 public:
  explicit Dictionary(const RunResult& run) : steps(seen_in(run)) {
    for (const auto& [key, seen] : steps) look(seen);
    for (const auto& change : run.changes) {
      auto& entry = entries_[change.object];
      entry.is_there = true;
      entry.change = &change;
    }
    for (const auto& one : run.cases) {
      // "2003h:05 is absent: abort 0609 0011h (sub-index does not exist)"
      const auto object = parse_multiplexer(std::string_view(one.reason).substr(0, multiplexer_length));
      if (object && one.reason.find(" is absent: abort ") == multiplexer_length)
        entries_[*object].is_absent = true;
      for (const auto& finding : one.setup_findings)
        look({&one, finding.verdict, {}, finding.step, finding.actual});
    }
  }

  [[nodiscard]] const std::map<Multiplexer, Entry>& entries() const { return entries_; }
  const SeenByStep steps;

 private:
  void look(const Seen& seen) {
    // A step that was played for many entries names those that are not as they should be:
    // "1 of 74 values: 2003h:05: abort 0609 0011h (sub-index does not exist)"
    for (const auto absence : absences) {
      for (auto at = seen.actual.find(absence); at != std::string_view::npos;
           at = seen.actual.find(absence, at + 1)) {
        const std::size_t front = multiplexer_length + 2;
        if (at < front || seen.actual.substr(at - 2, 2) != ": ") continue;
        if (const auto object = parse_multiplexer(seen.actual.substr(at - front, multiplexer_length)))
          entries_[*object].is_absent = true;
      }
    }
    const auto object = uploaded(seen.step);
    if (!object || seen.actual.find(" values: ") != std::string_view::npos) return;
    auto& entry = entries_[*object];
    const auto says_absent = [&](std::string_view absence) { return seen.actual.starts_with(absence); };
    if (std::ranges::any_of(absences, says_absent)) entry.is_absent = true;
    if (!is_value(seen.step, seen.actual)) return;
    entry.is_there = true;
    entry.values.emplace(value_of(seen.actual));
  }

  std::map<Multiplexer, Entry> entries_;
};

class Comparing {
 public:
  Comparing(const RunResult& before, const RunResult& after) : old_(before), new_(after) {}

  std::vector<EntryChange> all() {
    for (const auto& [object, now] : new_.entries()) {
      const auto found = old_.entries().find(object);
      if (found == old_.entries().end() || is_restless(object.index)) continue;
      compare_presence(object, found->second, now);
    }
    compare_uploads();
    for (const auto& [object, now] : new_.entries()) {
      const auto found = old_.entries().find(object);
      if (found != old_.entries().end() && found->second.change != nullptr && now.change != nullptr)
        compare_changes(*found->second.change, *now.change);
    }
    std::vector<EntryChange> list;
    for (auto& [object, change] : out_) list.push_back(std::move(change));
    return list;
  }

 private:
  /// What held it, of what is there.
  static std::string held(const Entry& entry) {
    if (entry.values.size() == 1) return *entry.values.begin();
    if (entry.change != nullptr) return bytes_text(entry.change->before);
    return "(there)";
  }

  void compare_presence(const Multiplexer& object, const Entry& was, const Entry& now) {
    // What comes and goes within a run says nothing.
    const bool was_there = was.is_there && !was.is_absent, was_absent = was.is_absent && !was.is_there;
    const bool is_there = now.is_there && !now.is_absent, is_absent = now.is_absent && !now.is_there;
    if (was_there && is_absent) out_.emplace(object, EntryChange{object, held(was), {}, false});
    if (was_absent && is_there) out_.emplace(object, EntryChange{object, {}, held(now), false});
  }

  void compare_uploads() {
    for (const auto& [key, now] : new_.steps) {
      const auto found = old_.steps.find(key);
      const auto object = uploaded(now.step);
      if (found == old_.steps.end() || !object || is_restless(object->index)) continue;
      const auto& was = found->second;
      if (!is_value(was.step, was.actual) || !is_value(now.step, now.actual)) continue;
      const auto before = value_of(was.actual), after = value_of(now.actual);
      if (before == after) continue;
      const bool is_parameter = area_of(object->index) == Area::communication;
      if (!is_parameter && !stays(*object)) continue;
      out_.try_emplace(*object, EntryChange{*object, std::string(before), std::string(after), !is_parameter});
    }
  }
  /// Neither run saw it with two values, and neither wrote it: of what is written the value before is told.
  [[nodiscard]] bool stays(const Multiplexer& object) const {
    const auto& was = old_.entries().at(object);
    const auto& now = new_.entries().at(object);
    return was.values.size() == 1 && now.values.size() == 1 && was.change == nullptr && now.change == nullptr;
  }

  /// What a run wrote, it had looked at before.
  void compare_changes(const Change& was, const Change& now) {
    if (was.before == now.before || is_restless(now.object.index)) return;
    const auto area = area_of(now.object.index);
    // What did not come back to its value is moved by more than the run.
    const bool is_process =
        area != Area::communication && (area != Area::manufacturer || !was.put_back || !now.put_back);
    out_.try_emplace(now.object,
                     EntryChange{now.object, bytes_text(was.before), bytes_text(now.before), is_process});
  }

  Dictionary old_, new_;
  std::map<Multiplexer, EntryChange> out_;
};

}  // namespace

Area area_of(Index index) {
  constexpr std::uint16_t communication = 0x1000, manufacturer = 0x2000, profile = 0x6000, other = 0xA000;
  const auto value = index.value();
  if (value < communication || value >= other) return Area::other;
  if (value < manufacturer) return Area::communication;
  return value < profile ? Area::manufacturer : Area::profile;
}

std::string_view to_string(Area area) {
  switch (area) {
    case Area::communication: return "communication profile (1000h-1FFFh)";
    case Area::manufacturer: return "manufacturer-specific (2000h-5FFFh)";
    case Area::profile: return "device profile (6000h-9FFFh)";
    case Area::other: break;
  }
  return "other objects";
}

std::vector<EntryChange> entry_changes(const RunResult& before, const RunResult& after) {
  return Comparing(before, after).all();
}

}  // namespace conform::result
