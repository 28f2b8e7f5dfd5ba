// SPDX-License-Identifier: Apache-2.0
#include "engine/mapping_probe.hpp"

#include <vector>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/pdo.hpp"

namespace conform::engine {
namespace {

using Kind = steps::SdoAnswer::Kind;
using Why = std::optional<std::string>;

constexpr std::uint8_t most_entries = 64;

class Probe {
 public:
  Probe(steps::Session& session, Index communication)
      : session_(session), communication_(communication), mapping_(canopen::pdo_mapping(communication)) {}

  Result<Why> run() {
    const Multiplexer cob_id{communication_, SubIndex(1)};
    const auto number = Multiplexer{mapping_, SubIndex(0)};
    const auto before = read(cob_id, 4), count = read(number, 1);
    std::vector<Bytes> entries;
    if (before && count) {
      const auto mapped = load_le(*count);
      if (mapped == 0 || mapped > most_entries)
        return Why("there is nothing to try it with: " + to_string(number) + " is " + std::to_string(mapped));
      for (std::uint64_t i = 1; i <= mapped; ++i) {
        auto entry = read({mapping_, SubIndex(static_cast<std::uint8_t>(i))}, 4);
        if (!entry) break;
        entries.push_back(std::move(*entry));
      }
    }
    if (broken_) return std::unexpected(*broken_);
    if (why_) return why_;
    const auto valid = static_cast<std::uint32_t>(load_le(*before));
    const bool was_on = (valid & canopen::cob_id::bit31) == 0;
    if (was_on) write(cob_id, to_le(valid | canopen::cob_id::bit31, 4));
    const bool off = !why_ && !broken_;
    if (off) write(number, to_le(0, 1));
    const bool emptied = off && !why_ && !broken_;
    for (std::size_t i = 0; i < entries.size() && !why_; ++i)
      write({mapping_, SubIndex(static_cast<std::uint8_t>(i + 1))}, entries[i]);
    // Whatever was refused, the PDO shall be as it was.
    if (emptied) write(number, *count);
    if (off && was_on) write(cob_id, *before);
    if (broken_) return std::unexpected(*broken_);
    return why_;
  }

 private:
  std::optional<Bytes> read(Multiplexer object, std::size_t size) {
    if (why_ || broken_) return std::nullopt;
    auto answer = session_.upload(object, std::nullopt);
    if (!heed(answer, object, "read")) return std::nullopt;
    if (answer->data.size() == size) return std::move(answer->data);
    why_ = to_string(object) + " holds " + std::to_string(answer->data.size()) + " bytes";
    return std::nullopt;
  }

  void write(Multiplexer object, const Bytes& data) {
    if (broken_) return;
    auto answer = session_.download(object, data, canopen::SdoDownload::Mode::automatic, std::nullopt);
    (void)heed(answer, object, "written back");
  }

  bool heed(const Result<steps::SdoAnswer>& answer, Multiplexer object, std::string_view done) {
    if (!answer) {
      broken_ = answer.error();
    } else if (answer->kind == Kind::silence) {
      broken_ = fail_scenario("no answer when the mapping " + to_string(mapping_) + " was tried").error();
    } else if (answer->kind == Kind::confirmed) {
      return true;
    } else if (!why_) {
      why_ = to_string(object) + " could not be " + std::string(done) + ": " + answer->refusal();
    }
    return false;
  }

  steps::Session& session_;
  Index communication_, mapping_;
  Why why_;
  std::optional<Error> broken_;
};

}  // namespace

Result<std::optional<std::string>> why_mapping_is_fixed(steps::Session& session, Index communication) {
  return Probe(session, communication).run();
}

}  // namespace conform::engine
