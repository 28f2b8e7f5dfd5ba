// SPDX-License-Identifier: Apache-2.0
#include "cli/exploring/model_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

#include "base/text.hpp"
#include "canopen/data_type.hpp"
#include "cli/descriptions/draft_eds.hpp"
#include "device/dictionary.hpp"
#include "eds/read.hpp"
#include "steps/tier.hpp"

namespace conform::cli {
namespace {

void put(eds::Field& field, std::string text) {
  field.text = std::move(text);
  field.present = true;
}

/// As an EDS writes it; nullopt: it has no way to.
std::optional<std::string> written(const Bytes& value, canopen::DataType type) {
  using canopen::DataType;
  if (type == DataType::visible_string) {
    const bool plain = std::ranges::all_of(value, [](auto byte) { return byte >= 0x20 && byte < 0x7F; });
    return plain ? std::optional(std::string(value.begin(), value.end())) : std::nullopt;
  }
  const auto size = canopen::size_bytes(type);
  if (!size || value.size() < *size || *size > 8) return std::nullopt;
  // A device that does not tell the size has given four bytes.
  return fmt::format("0x{:0{}X}", load_le(ByteView(value).first(*size)), *size * 2);
}

class Fitter {
 public:
  Fitter(const LiveDevice& device, const device::Profile& profile, bool drafted)
      : device_(device), known_(device::dictionary_of(profile)), drafted_(drafted) {}

  void fit(eds::Entry& entry, Multiplexer mux) const {
    const auto* known = known_.find(mux);
    const bool claimed = known != nullptr && known->claimed;
    // A draft guesses what only people know.
    if (drafted_ && claimed) {
      put(entry.access_type, std::string(device::to_string(known->access)));
      put(entry.data_type, fmt::format("0x{:04X}", static_cast<unsigned>(known->type)));
      // What of the standard's own entries is mapped is the device's choice.
      if (steps::is_of_application(mux.index)) put(entry.pdo_mapping, known->pdo_mappable ? "1" : "0");
      for (const auto& [limit, field] :
           {std::pair(&known->low, &entry.low_limit), std::pair(&known->high, &entry.high_limit)}) {
        const auto text = *limit ? written(**limit, known->type) : std::nullopt;
        if (text) put(*field, *text);
      }
    }
    const auto* value = device_.value_of(mux);
    if (value == nullptr || known == nullptr || known->may_change || !is_plain(entry)) return;
    // A default that is right stays as it is written: with $NODEID.
    if (!drafted_ && known->default_value == *value) return;
    if (auto text = written(*value, known->type)) put(entry.default_value, std::move(*text));
  }

 private:
  /// DOMAINs have no default.
  [[nodiscard]] static bool is_plain(const eds::Entry& entry) { return entry.upload_file.empty(); }

  const LiveDevice& device_;
  device::Dictionary known_;
  bool drafted_;
};

}  // namespace

Result<std::shared_ptr<const eds::EdsFile>> model_description(const LiveDevice& device,
                                                              const device::Profile& profile,
                                                              const eds::EdsFile* given) {
  eds::EdsFile out;
  if (given != nullptr) {
    out = *given;
  } else {
    DraftInfo info;
    info.file_name = "what the device shows";
    info.node = profile.node;
    auto drafted = eds::read(draft_eds(device.seen(), info), info.file_name);
    if (!drafted) return std::unexpected(drafted.error());
    out = std::move(*drafted);
  }
  const Fitter fitter(device, profile, given == nullptr);
  for (auto& object : out.objects) {
    if (object.described && object.subs.empty()) fitter.fit(object.entry, {object.index, SubIndex(0)});
    for (auto& sub : object.subs) fitter.fit(sub.entry, {object.index, sub.sub});
  }
  return std::make_shared<const eds::EdsFile>(std::move(out));
}

}  // namespace conform::cli
