// SPDX-License-Identifier: Apache-2.0
// A bench without a bus: frames go straight into the node and come straight out, as text.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "catch.hpp"
#include "node/node.hpp"
#include "parts/parts.hpp"

namespace refnode::testing {

using namespace std::chrono_literals;

/// Node 5 unless said otherwise. Frames are written "605: 40 00 10 00 00 00 00 00"; what the node sent since
/// the last look is returned the same way.
class Bench {
 public:
  explicit Bench(std::vector<std::string> defects = {}, std::shared_ptr<Storage> storage = {},
                 std::uint8_t id = 5)
      : Bench(Wanted{{.node_id = id, .defects = std::move(defects), .storage = std::move(storage)}}) {}
  /// A node with all options; in a type of its own, as braces alone would also fit the other constructor.
  struct Wanted {
    Options options;
  };
  explicit Bench(Wanted wanted) {
    auto made = Node::create(std::move(wanted.options));
    REQUIRE(made.has_value());
    node_ = std::move(*made);
    node_->attach(
        [this](const conform::can::Frame& frame) {
          sent_.push_back(text(frame));
          ++unconfirmed_;
        },
        now_);
  }
  /// A node whose SDO server makes these choices.
  static Bench choosing(const SdoChoices& sdo) {
    return Bench(Wanted{{.node_id = 5, .adjust = [sdo](Parts& parts) { parts.sdo.choices = sdo; }}});
  }
  Bench(Bench&&) = delete;

  /// Lets time pass; every wake-up happens at its time. Each frame is stamped "@ms " when `stamped`.
  std::vector<std::string> wait(conform::Duration duration, bool stamped = false) {
    const auto end = now_ + duration;
    while (const auto next = node_->next_wakeup()) {
      if (*next > end) break;
      now_ = std::max(now_, *next);
      const std::size_t before = sent_.size();
      node_->on_time(now_);
      confirm();
      for (std::size_t i = before; stamped && i < sent_.size(); ++i) sent_[i] = stamp() + sent_[i];
    }
    now_ = end;
    return take();
  }
  /// Sends frames to the node, one per line, and returns what it sent at once.
  std::vector<std::string> send(std::string_view lines) {
    for (const auto line : conform::split(lines, '\n')) {
      if (!conform::trim(line).empty()) send(parse(line));
    }
    return take();
  }
  /// The same identifier as a 29-bit one; what the node sends waits for take().
  void send_extended(std::string_view line) {
    conform::can::Frame frame = parse(line);
    frame.extended = true;
    send(frame);
  }
  void send(const conform::can::Frame& frame) {
    node_->on_frame(frame, now_);
    confirm();
  }
  /// The data of the one answer to an SDO request on 605h, or "" when there was none.
  std::string sdo(std::string_view bytes) {
    const auto answers = send("605: " + std::string(bytes));
    std::string all;
    for (const auto& answer : answers) all += (all.empty() ? "" : " | ") + answer;
    constexpr std::string_view prefix = "585: ";
    return all.starts_with(prefix) && answers.size() == 1 ? all.substr(prefix.size()) : all;
  }
  std::vector<std::string> take() { return std::exchange(sent_, {}); }
  Node& node() { return *node_; }

 private:
  // A bus without length: whatever was sent has left at once.
  void confirm() {
    for (; unconfirmed_ > 0; --unconfirmed_) node_->on_transmitted(now_);
  }
  static conform::can::Frame parse(std::string_view line) {
    const auto colon = line.find(':');
    REQUIRE(colon != std::string_view::npos);
    const auto id = conform::parse_number("0x" + std::string(conform::trim(line.substr(0, colon))));
    const auto data = conform::trim(line.substr(colon + 1));
    const auto bytes = data.empty() ? conform::Bytes{} : conform::parse_bytes(data);
    REQUIRE((id && bytes));
    return conform::can::data_frame(conform::CanId(static_cast<std::uint32_t>(*id)), *bytes);
  }
  static std::string text(const conform::can::Frame& frame) {
    std::string id = conform::hex(frame.id, 3);
    id.pop_back();
    return conform::hex_bytes(frame.bytes()).insert(0, (frame.extended ? "ext " : "") + id + ": ");
  }
  std::string stamp() const {
    return "@" +
           std::to_string(
               std::chrono::duration_cast<std::chrono::milliseconds>(now_.time_since_epoch()).count()) +
           " ";
  }

  conform::BusTime now_{};
  std::vector<std::string> sent_;
  int unconfirmed_ = 0;
  std::unique_ptr<Node> node_;
};

using Frames = std::vector<std::string>;

}  // namespace refnode::testing
