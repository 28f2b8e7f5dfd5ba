// SPDX-License-Identifier: Apache-2.0
#include "engine/scan.hpp"

#include <algorithm>
#include <utility>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"

namespace conform::engine {
namespace {

using Kind = steps::SdoAnswer::Kind;

constexpr std::uint8_t sub_ff = 0xFF;  ///< structure of the object (CiA 301, 7.4.8.2), not one of its entries

class Scanner {
 public:
  explicit Scanner(RunSession& session) : session_(session) {}

  Result<void> look_at(Index index) {
    auto first = look({index, SubIndex(0)});
    if (!first) return std::unexpected(first.error());
    if (!*first) return {};
    const auto last = last_sub(**first);
    ScannedObject object{index, {}};
    object.entries.push_back(std::move(**first));
    for (unsigned sub = 1; sub <= last; ++sub) {
      auto entry = look({index, SubIndex(static_cast<std::uint8_t>(sub))});
      if (!entry) return std::unexpected(entry.error());
      if (*entry) object.entries.push_back(std::move(**entry));
      // A VAR of one byte with a large value would cost as many requests; arrays with gaps begin early.
      if (object.entries.size() == 1 && sub == 8) break;
    }
    objects.push_back(std::move(object));
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
    return Entry(std::move(out));
  }

  RunSession& session_;
  bool silent_ = false;
};

}  // namespace

Result<std::vector<ScannedObject>> scan(RunSession& session, std::span<const IndexRange> ranges,
                                        const std::function<void(Index)>& progress) {
  Scanner scanner(session);
  for (const auto& range : ranges) {
    for (unsigned index = range.first; index <= range.last; ++index) {
      const Index at(static_cast<std::uint16_t>(index));
      if (progress && (index == range.first || index % 0x100 == 0)) progress(at);
      if (auto done = scanner.look_at(at); !done) return std::unexpected(done.error());
    }
  }
  return std::move(scanner.objects);
}

}  // namespace conform::engine
