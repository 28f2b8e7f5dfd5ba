// SPDX-License-Identifier: Apache-2.0
// One entry of a device description, made an entry that can be served.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "dictionary/object_dictionary.hpp"
#include "eds/eds.hpp"
#include "twin/remarks.hpp"

namespace refnode {

class TwinEntryMaker {
 public:
  /// `info` of the same file says who the device is where 1018h does not; it must outlive the maker.
  TwinEntryMaker(std::uint8_t node_id, const conform::eds::DeviceInfo& info, TwinRemarks& remarks)
      : node_id_(node_id), info_(&info), remarks_(&remarks) {}

  /// `object` is the one that holds the entry. `is_sub`: the entry is described as a sub-index.
  [[nodiscard]] Entry make(const conform::eds::Object& object, std::uint8_t sub,
                           const conform::eds::Entry& from, bool is_sub);

 private:
  /// What is being made.
  struct Job {
    const conform::eds::Object& object;
    const conform::eds::Entry& from;
    std::uint16_t index;
    std::uint8_t sub;
    bool is_sub;
  };

  void set_type(const Job& job, Entry& entry);
  void set_access(const Job& job, Entry& entry);
  void set_limits(const Job& job, Entry& entry);
  void set_value(const Job& job, Entry& entry);
  void look_at_service(const Job& job, const Entry& entry, conform::eds::Position at);
  /// The value of an entry of which the file says nothing.
  [[nodiscard]] Bytes silent_value(const Job& job, const Entry& entry) const;
  /// What [DeviceInfo] says of the vendor, the product and its revision (1018h:01 to 03).
  [[nodiscard]] std::optional<std::uint64_t> identity_value(const Job& job, DataType type) const;
  /// A limit that is missing or cannot be understood is none.
  template <typename Value, typename Read>
  void take_limits(const Job& job, DataType type, const Read& read, std::optional<Value>& low,
                   std::optional<Value>& high);
  /// Once for each place and topic: an implied entry repeats the texts of another.
  void remark(const Job& job, conform::eds::Position at, std::string_view topic, std::string_view text);

  std::uint8_t node_id_;
  const conform::eds::DeviceInfo* info_;
  TwinRemarks* remarks_;
  std::set<std::tuple<conform::eds::Position, std::string>> remarked_;
};

}  // namespace refnode
