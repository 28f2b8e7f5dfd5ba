// SPDX-License-Identifier: Apache-2.0
#include "cli/first_contact/claims.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "device/feature_objects.hpp"

namespace conform::cli {
namespace {

constexpr std::uint64_t bit30 = std::uint64_t{1} << 30U, bit31 = std::uint64_t{1} << 31U;
constexpr std::size_t expedited = 4;  ///< bytes of the longest value in one frame

class Claims {
 public:
  explicit Claims(const Acquaintance& device) : device_(device) {}

  FoundClaims all() {
    by_objects();
    by_values();
    by_behaviour();
    by_the_user();
    return std::move(out_);
  }

 private:
  void shown(std::string_view feature, std::string why) { out_.shown.push_back({feature, std::move(why)}); }
  void open(std::string_view feature, std::string why) { out_.open.push_back({feature, std::move(why)}); }

  void by_objects() {
    for (const auto& row : device::features_of_objects()) {
      if (row.feature == "life guarding") continue;  // its values tell more, see below
      const auto found = std::ranges::find_if(device_.objects, [&](const engine::ScannedObject& object) {
        return row.holds(object.index.value());
      });
      if (found != device_.objects.end()) shown(row.feature, to_string(found->index) + " is there");
    }
  }

  void by_values() {
    const auto type = device_.number(0x1000, 0);
    if (type && (*type & 0xFFFFU) != 0)
      shown("profile device", fmt::format("1000h: CiA {}", *type & 0xFFFFU));
    if (const auto sync = device_.number(0x1005, 0)) {
      if ((*sync & bit30) != 0) {
        shown("sync producer", "bit 30 of 1005h");
        open("sync consumer", "1005h is there");
      } else {
        shown("sync consumer", "1005h is there, its bit 30 is 0");
        if (device_.find(0x1006) != nullptr) open("sync producer", "1006h is there");
      }
    }
    if (const auto time = device_.number(0x1012, 0)) {
      if ((*time & bit31) != 0) shown("time consumer", "bit 31 of 1012h");
      if ((*time & bit30) != 0) shown("time producer", "bit 30 of 1012h");
    }
    // Both may be there, read-only and 0, in a device that does not guard.
    if (device_.number(0x100C, 0).value_or(0) != 0 && device_.number(0x100D, 0).value_or(0) != 0) {
      shown("life guarding", "100Ch and 100Dh are not 0");
    } else if (device_.find(0x100D) != nullptr) {
      open("life guarding", "100Dh is there");
    }
    for (std::uint8_t sub = 1; sub < 0x80; ++sub) {
      const auto store = device_.number(0x1010, sub);
      if (!store) break;
      if ((*store & 2U) == 0) continue;
      shown("autonomous storing", fmt::format("bit 1 of 1010h:{:02X}", sub));
      break;
    }
  }

  void by_behaviour() {
    for (const auto& object : device_.objects) {
      const auto is_long = [](const engine::ScannedEntry& entry) {
        return entry.value && entry.value->size() > expedited;
      };
      const auto found = std::ranges::find_if(object.entries, is_long);
      if (found == object.entries.end()) continue;
      shown("segmented sdo", to_string(found->mux) + " came in segments");
      break;
    }
    if (device_.block_upload && device_.block_download) {
      shown("block sdo", "uploads and downloads were begun");
    } else if (device_.block_upload) {
      open("block sdo", "an upload was begun; a download was not tried");
    }
    // Who guards without life guarding has 100Ch and 100Dh read-only: the two are claimed together.
    const auto is_open = [this](std::string_view feature) {
      return std::ranges::find(out_.open, feature, &FoundClaim::feature) != out_.open.end();
    };
    if (device_.node_guarding && !is_open("life guarding")) {
      shown("node guarding", "a guard request was answered");
    } else if (device_.node_guarding) {
      open("node guarding", "a guard request was answered; say life guarding, too, if it has it");
    } else {
      open("node guarding", "a guard request was not tried, or not answered");
    }
    if (device_.lss.value_or(false)) {
      shown("lss", "it answered to its address");
      shown("lss identify remote slave", "it answered to its address");
      open("lss identify non-configured", "needs a device without node-ID");
      open("lss fastscan", "needs a device without node-ID");
    } else {
      open("lss", device_.lss ? "it did not answer to its address" : "was not tried");
    }
  }

  void by_the_user() {
    const auto has = [this](std::string_view feature) {
      return std::ranges::find(out_.shown, feature, &FoundClaim::feature) != out_.shown.end();
    };
    const bool pdos = has("rpdo") || has("tpdo");
    if (pdos) open("variable mapping", "the mapping of PDOs can be changed");
    if (has("tpdo")) open("tpdo on change", "an event-driven TPDO is sent when an object in it changes");
    if (has("tpdo")) open("remote frames", "TPDOs answer remote frames");
    open("base frames only", "COB-IDs cannot have 29 bits");
    open("fixed cob-ids", "COB-IDs cannot be changed");
    open("only node on the bus", device_.others.empty()
                                     ? "nobody else was heard: allows commands to all nodes"
                                     : "others were heard: " + device_.others);
  }

  const Acquaintance& device_;
  FoundClaims out_;
};

}  // namespace

FoundClaims claims_of(const Acquaintance& device) { return Claims(device).all(); }

}  // namespace conform::cli
