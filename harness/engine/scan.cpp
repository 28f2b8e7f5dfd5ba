// SPDX-License-Identifier: Apache-2.0
#include "engine/scan.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/pdo.hpp"
#include "canopen/program_control.hpp"
#include "device/standard_objects.hpp"
#include "steps/tier.hpp"

namespace conform::engine {
namespace {

using Kind = steps::SdoAnswer::Kind;

constexpr std::uint8_t sub_ff = 0xFF;  ///< structure of the object (CiA 301, 7.4.8.2), not one of its entries

constexpr std::uint8_t last_mapped = 0x40;  ///< of a mapping (CiA 301, 7.5.2.36)

bool is_mapping(Index index) {
  const auto communication = canopen::pdo_communication(index);
  return communication && *communication != index;
}

/// Whether a write does more than to keep a value.
bool has_effect(Multiplexer mux) {
  if (canopen::is_program_control(mux.index)) return true;
  const auto known = device::standard_entry(mux);
  return known && known->command;
}

class Scanner {
 public:
  Scanner(RunSession& session, const ScanOptions& options)
      : session_(session), allow_(options.allow), skip_(options.skip) {
    session_.begin_case(allow_);
  }

  Result<void> look_at(Index index) {
    if (skip_.contains({index, SubIndex(0)})) return {};
    auto first = look({index, SubIndex(0)});
    if (!first) return std::unexpected(first.error());
    if (!*first) return {};
    // What 00h counts there are mapped objects and errors; there may be more sub-indices.
    const unsigned to_try = is_mapping(index) ? last_mapped : index == Index(0x1003) ? sub_ff - 1U : 0;
    const auto counted = last_sub(**first);
    ScannedObject object{index, {}};
    object.entries.push_back(std::move(**first));
    for (unsigned sub = 1; sub <= std::max(counted, to_try); ++sub) {
      const Multiplexer mux{index, SubIndex(static_cast<std::uint8_t>(sub))};
      if (skip_.contains(mux)) continue;
      auto entry = look(mux);
      if (!entry) return std::unexpected(entry.error());
      if (!*entry && sub > counted) break;
      if (*entry) object.entries.push_back(std::move(**entry));
      // A VAR of one byte with a large value would cost as many requests; arrays with gaps begin early.
      if (object.entries.size() == 1 && sub == 8) break;
    }
    objects.push_back(std::move(object));
    return {};
  }

  /// An entry that nothing has led to so far.
  Result<void> look_also(Multiplexer mux) {
    const auto place = std::ranges::lower_bound(objects, mux.index, {}, &ScannedObject::index);
    const bool known = place != objects.end() && place->index == mux.index;
    if (skip_.contains(mux)) return {};
    if (known && std::ranges::find(place->entries, mux, &ScannedEntry::mux) != place->entries.end())
      return {};
    auto entry = look(mux);
    if (!entry) return std::unexpected(entry.error());
    if (!*entry) return {};
    auto& entries = (known ? place : objects.insert(place, ScannedObject{mux.index, {}}))->entries;
    entries.insert(std::ranges::lower_bound(entries, mux, {}, &ScannedEntry::mux), std::move(**entry));
    return {};
  }

  std::vector<ScannedObject> objects;

 private:
  /// How far to look behind sub-index 00h. A value of one byte may count sub-indices, or be that of a VAR,
  /// which 01h tells; so does 01h where there is no value.
  static unsigned last_sub(const ScannedEntry& head) {
    if (!head.value) return 1;
    if (head.value->size() != 1 && !head.size_open) return 0;
    const unsigned count = head.value->empty() ? 0 : head.value->front();
    return std::clamp(count, 1U, sub_ff - 1U);
  }

  /// nullopt: the entry is not there.
  Result<std::optional<ScannedEntry>> look(Multiplexer mux) {
    using Entry = std::optional<ScannedEntry>;
    auto answer = session_.peek(mux);
    if (!answer) return std::unexpected(answer.error());
    if (answer->kind == Kind::aborted &&
        (answer->code == canopen::abort::no_object || answer->code == canopen::abort::no_sub_index))
      return Entry();
    ScannedEntry out;
    out.mux = mux;
    switch (answer->kind) {
      case Kind::confirmed:
        out.value = std::move(answer->data);
        out.size_open = !answer->size_indicated;
        break;
      case Kind::aborted: out.abort = answer->code; break;
      case Kind::silence:
        // One entry may be mute; two requests in a row mean that the device is gone.
        if (std::exchange(silent_, true)) return fail("the device fell silent at " + to_string(mux));
        return Entry(std::move(out));
      case Kind::violation:
      case Kind::gave_up: break;
    }
    silent_ = false;
    if (auto tried = write_back(out); !tried) return std::unexpected(tried.error());
    return Entry(std::move(out));
  }

  Result<void> write_back(ScannedEntry& entry) {
    const bool application = steps::is_of_application(entry.mux.index);
    const auto needed = application ? steps::Tier::motion : steps::Tier::config;
    if (allow_ < needed || !entry.value || entry.value->empty() || has_effect(entry.mux)) return {};
    auto data = *entry.value;
    const auto known = device::standard_entry(entry.mux);
    // A value whose length is open can be written in no length that is known to be right.
    if (entry.size_open && !(known && known->size() && *known->size() <= data.size())) return {};
    if (entry.size_open) data.resize(*known->size());
    if (application) {
      device::Entry open;
      open.mux = entry.mux;
      session_.known().add(open);
    }
    auto answer = session_.download(entry.mux, data, canopen::SdoDownload::Mode::automatic, std::nullopt);
    (void)session_.take_journal();  // nothing is to be put back
    // A transfer that was given up says nothing, and is no reason to end the scan.
    if (!answer && answer.error().of == Error::Of::scenario) return {};
    if (!answer) return std::unexpected(answer.error());
    if (answer->kind == Kind::confirmed) entry.writable = true;
    // Any other reason is one of the moment: the state, a PDO that is valid.
    if (answer->kind == Kind::aborted && answer->code == canopen::abort::read_only) entry.writable = false;
    return {};
  }

  RunSession& session_;
  steps::Tier allow_;
  const std::set<Multiplexer>& skip_;
  bool silent_ = false;
};

}  // namespace

Result<std::vector<ScannedObject>> scan(RunSession& session, const ScanOptions& options) {
  Scanner scanner(session, options);
  for (const auto& range : options.ranges) {
    for (unsigned index = range.first; index <= range.last; ++index) {
      const Index at(static_cast<std::uint16_t>(index));
      if (options.progress && (index == range.first || index % 0x100 == 0)) options.progress(at);
      if (auto done = scanner.look_at(at); !done) return std::unexpected(done.error());
    }
  }
  for (const auto mux : options.also) {
    if (auto done = scanner.look_also(mux); !done) return std::unexpected(done.error());
  }
  return std::move(scanner.objects);
}

}  // namespace conform::engine
