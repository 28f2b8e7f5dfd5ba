// SPDX-License-Identifier: Apache-2.0
// The reference node: a CANopen device (CiA 301) as a participant of a bus. It is conformant unless defects
// are named.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/time.hpp"
#include "can/participant.hpp"
#include "dictionary/object_dictionary.hpp"
#include "storage/memory.hpp"
#include "twin/remarks.hpp"

namespace conform::eds {
struct EdsFile;
}  // namespace conform::eds

namespace refnode {

struct Parts;

struct Options {
  std::uint8_t node_id = 1;            ///< 1..127, or 255: none, LSS gives one
  std::vector<std::string> defects{};  ///< ids of defects()
  std::shared_ptr<Storage> storage{};  ///< non-volatile memory; empty: fresh memory that lives with the node
  std::function<void(Parts&)> adjust{};  ///< what else to set before the node starts
  std::vector<std::string> variants{};   ///< ids of variants(), compatible with each other
  /// The device to be; empty: the reference node itself.
  std::shared_ptr<const conform::eds::EdsFile> description{};
};

class Node final : public conform::can::Participant {
 public:
  /// Fails with a hint on a node-ID out of range, an unknown or repeated defect, unknown variants or variants
  /// that exclude each other, and on a description that is too large.
  [[nodiscard]] static conform::Result<std::unique_ptr<Node>> create(Options options);
  ~Node() override;

  void attach(Sender sender, conform::BusTime now) override;
  void on_frame(const conform::can::Frame& frame, conform::BusTime now) override;
  void on_transmitted(conform::BusTime now) override;
  void on_time(conform::BusTime now) override;
  [[nodiscard]] std::optional<conform::BusTime> next_wakeup() const override;

  /// What the node holds at present; edits of defects included.
  [[nodiscard]] const ObjectDictionary& dictionary() const;
  /// What of the description could not be served as it is written.
  [[nodiscard]] const TwinRemarks& remarks() const;

 private:
  struct Impl;
  explicit Node(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace refnode
