// SPDX-License-Identifier: Apache-2.0
#include "cli/replay/lss_state.hpp"

#include <optional>
#include <string>

#include <fmt/format.h>

#include "can/capture_marks.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/lss.hpp"
#include "cli/replay/dialogue.hpp"

namespace conform::cli {
namespace {

using canopen::LssCommand;

bool needs_configuration(LssCommand command) {
  switch (command) {
    case LssCommand::configure_node_id:
    case LssCommand::configure_bit_timing:
    case LssCommand::activate_bit_timing:
    case LssCommand::store:
    case LssCommand::inquire_vendor:
    case LssCommand::inquire_product:
    case LssCommand::inquire_revision:
    case LssCommand::inquire_serial:
    case LssCommand::inquire_node_id: return true;
    default: return false;
  }
}

/// Where the state of the slaves was told last, frame by frame.
class Follower {
 public:
  explicit Follower(NodeId node) : node_(node) {}

  /// A frame that was sent, by its index.
  void see(const can::Frame& frame, std::size_t index) {
    const auto answer = answer_of(frame, node_);
    if (answer && answer->of == AnswerKind::Of::reset) return tell(index);
    if (!frame.is_data(canopen::lss_request_can_id) || frame.size() == 0) return;
    const auto command = static_cast<LssCommand>(frame.data[0]);
    if (command == LssCommand::switch_global) return tell(index);
    if (command == LssCommand::fastscan && frame.size() > 5 && frame.data[5] == canopen::LssFastscan::begin)
      return tell(index);
    if (command == LssCommand::select_vendor) {
      selects_from_ = index;
      selected_ = 0;
    }
    constexpr auto first = static_cast<unsigned>(LssCommand::select_vendor);
    if (!selects_from_ || frame.data[0] != first + selected_) return;
    ++selected_;
    if (selected_ == canopen::lss_parts) tell(*selects_from_);
  }
  void power_was_switched(std::size_t index) { tell(index); }

  /// The first frame of what told it; nullopt: nothing did.
  [[nodiscard]] std::optional<std::size_t> told_from() const { return told_from_; }

 private:
  void tell(std::size_t index) {
    told_from_ = index;
    selects_from_.reset();
  }

  NodeId node_;
  std::optional<std::size_t> told_from_, selects_from_;
  unsigned selected_ = 0;  ///< parts of the selection under way
};

}  // namespace

Result<void> lss_state_is_known(const Side& then, NodeId node) {
  Follower inside(node), before(node);
  const auto see = [&then](Follower& follower, std::size_t index) {
    const auto& captured = then.frames[index];
    if (captured.comment.contains(can::power_was_switched)) follower.power_was_switched(index);
    if (captured.direction == can::Direction::transmitted) follower.see(captured.frame, index);
  };
  for (auto i = then.first; i < then.end; ++i) {
    see(inside, i);
    const auto& frame = then.frames[i].frame;
    const bool asks = then.frames[i].direction == can::Direction::transmitted &&
                      frame.is_data(canopen::lss_request_can_id) && frame.size() > 0 &&
                      needs_configuration(static_cast<LssCommand>(frame.data[0]));
    if (!asks || inside.told_from()) continue;
    for (std::size_t k = 0; k < i; ++k) see(before, k);
    const auto from = before.told_from();
    return fail(
        fmt::format("is LSS '{}', and no frame before it that would be sent says which slave obeys it",
                    canopen::lss_command_name(frame.data[0])),
        fmt::format("frame {}", i + 1),
        from ? fmt::format("begin with frame {}, which does; nothing was sent", *from + 1)
             : std::string("nor does any other frame of the capture; nothing was sent"));
  }
  return {};
}

}  // namespace conform::cli
