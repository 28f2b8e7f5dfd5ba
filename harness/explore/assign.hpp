// SPDX-License-Identifier: Apache-2.0
// Which requirement a difference from the model violates. The model makes legal choices of its own, so a
// difference alone proves nothing: every rule here says what the standard accepts, and what no rule knows
// stays a difference without a name.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "explore/draw.hpp"
#include "explore/duel.hpp"

namespace conform::explore {

/// What a shrunk conversation has shown, with everything that came before the difference.
struct Evidence {
  const Vocabulary& words;
  std::span<const Action> conversation;  ///< up to the difference
  const Played& played;                  ///< of it, with answers; it has a difference

  [[nodiscard]] const Difference& difference() const { return *played.difference; }
  [[nodiscard]] const Action& last() const { return conversation[difference().action]; }
  /// The actions before the one at which it showed.
  [[nodiscard]] std::span<const Action> before() const { return conversation.first(difference().action); }
  /// The NMT command that was obeyed last, and the one before it; 80h where there was none.
  struct Commands {
    std::uint8_t last = 0x80, before = 0x80;
  };
  [[nodiscard]] Commands commands() const;
  [[nodiscard]] bool stopped() const { return commands().last == 2; }
  [[nodiscard]] bool operational() const { return commands().last == 1; }
  /// The device was up when the last NMT command came, and time was let pass behind it, so that it has obeyed
  /// (T_NMT).
  [[nodiscard]] bool settled() const;
  /// Between the reset and the command, by their places, the device has started; where nobody knows, a second
  /// went by.
  [[nodiscard]] bool was_up_between(std::size_t reset, std::size_t command) const;
  /// A transfer before it has got no answer where all are served: what comes now may be that one.
  [[nodiscard]] bool may_be_late() const;
  /// It was to produce SYNC with a period of a few frames.
  [[nodiscard]] bool floods() const;
  /// Some NMT command, or a power cycle, came.
  [[nodiscard]] bool commanded() const;
  /// What was written to the entry last, up to the difference, whether the device took it or not.
  [[nodiscard]] std::optional<std::uint64_t> wrote(std::uint16_t index, std::uint8_t sub) const;
  /// Some action is of this kind.
  template <typename F>
  [[nodiscard]] bool some(F holds) const {
    for (const auto& each : conversation) {
      if (holds(each)) return true;
    }
    return false;
  }
};

enum class Grade : std::uint8_t {
  violated,   ///< no reading of the rule accepts it
  tolerated,  ///< the rule is about this, but lets it pass with a warning, or may do so
  allowed,    ///< the rule lets it pass without a word: no finding
};

struct Assigned {
  std::string requirement;
  Grade grade = Grade::violated;
};

/// Violated in the state that was commanded; where the device may still be on its way into it, only strained.
[[nodiscard]] inline std::optional<Assigned> in_its_state(const Evidence& evidence, std::string requirement) {
  return Assigned{std::move(requirement), evidence.settled() ? Grade::violated : Grade::tolerated};
}

/// nullopt: differs from the model, no rule known.
[[nodiscard]] std::optional<Assigned> assign(const Evidence& evidence);

// The tables, by what differs.
[[nodiscard]] std::optional<Assigned> assign_answer(const Evidence& evidence);
[[nodiscard]] std::optional<Assigned> assign_fault(const Evidence& evidence);
[[nodiscard]] std::optional<Assigned> assign_request(const Evidence& evidence);
[[nodiscard]] std::optional<Assigned> assign_frame(const Evidence& evidence);
/// An EMCY.
[[nodiscard]] std::optional<Assigned> assign_emcy(const Evidence& evidence);
/// The error code of an EMCY; 0000h also of a frame that is too short for one.
[[nodiscard]] unsigned emcy_code(const can::Frame& emcy);
/// What comes of the state that the loss of another node has led to.
[[nodiscard]] std::optional<Assigned> assign_behind_a_loss(const Evidence& evidence);
/// The frame that it is all about.
[[nodiscard]] const can::Frame& frame_of(const Evidence& evidence);
/// A guard request to the device.
[[nodiscard]] bool guards(const Action& action, const Evidence& evidence);
/// An upload that was asked for in a frame of its own, and what came and was due.
[[nodiscard]] std::optional<Assigned> assign_single_upload(const Evidence& evidence, ByteView came,
                                                           ByteView due);
/// What came is on the CAN-ID of the answers of an additional SDO server.
[[nodiscard]] bool is_on_channel(const Evidence& evidence);
/// Additional SDO channels were used in the conversation.
[[nodiscard]] bool talks_of_channels(const Evidence& evidence);
/// A frame where something was asked on such a channel.
[[nodiscard]] std::optional<Assigned> assign_channel_frame(const Evidence& evidence);
/// Another answer on the default channel, which takes something asked on another one to show.
[[nodiscard]] std::optional<Assigned> assign_beside_channel(const Evidence& evidence);
/// LSS was used in the conversation.
[[nodiscard]] bool talks_of_lss(const Evidence& evidence);
/// LSS was to give the device another node-ID.
[[nodiscard]] bool gives_node_id(const Evidence& evidence);
/// A frame on 7E4h.
[[nodiscard]] std::optional<Assigned> assign_lss_answer(const Evidence& evidence);
/// Anything else in a conversation that needs LSS to show it.
[[nodiscard]] std::optional<Assigned> assign_beside_lss(const Evidence& evidence);

/// The rule for what the client did wrong in a transfer; empty: it did nothing, or no rule is known.
[[nodiscard]] std::string rule_of_fault(const Action& action);
/// "OD-1400-10"
[[nodiscard]] std::string id_of(std::string_view area, int number);
/// For the tables: a rule that is broken, and one that tolerates it.
[[nodiscard]] inline std::optional<Assigned> violates(std::string requirement) {
  return Assigned{std::move(requirement), Grade::violated};
}
[[nodiscard]] inline std::optional<Assigned> strains(std::string requirement) {
  return Assigned{std::move(requirement), Grade::tolerated};
}
[[nodiscard]] inline std::optional<Assigned> passes(std::string requirement) {
  return Assigned{std::move(requirement), Grade::allowed};
}

}  // namespace conform::explore
