// SPDX-License-Identifier: Apache-2.0
// The SDO channels on the bus: the default one and those that a scenario names. Keeps in mind in which state
// each was left, so that late answers are never taken for answers to what comes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "canopen/sdo_transfer.hpp"
#include "engine/recorder.hpp"
#include "steps/session.hpp"

namespace conform::engine {

class SdoChannel {
 public:
  SdoChannel(Recorder& recorder, NodeId node, Duration timeout, Duration quiet);

  /// Transfers at the same time, each on a channel of its own. Error (of the scenario) when two share one,
  /// or when a fault has no place.
  [[nodiscard]] Result<std::vector<steps::SdoAnswer>> run(std::span<const steps::SdoJob> jobs);
  [[nodiscard]] Result<steps::SdoAnswer> upload(Multiplexer object, std::optional<Duration> timeout);
  [[nodiscard]] Result<steps::SdoAnswer> download(Multiplexer object, Bytes data,
                                                  canopen::SdoDownload::Mode mode,
                                                  std::optional<Duration> timeout);
  /// Reads as much as tells what is there: of a value that is told to be long only the beginning, whereupon
  /// the client aborts (SdoAnswer::glanced_at).
  [[nodiscard]] Result<steps::SdoAnswer> glance(Multiplexer object);
  static constexpr std::size_t enough_to_see = 48;  ///< bytes
  /// How many bytes the entry holds, as the answer to the initiate request tells; the transfer is not carried
  /// through. nullopt: it cannot be read.
  [[nodiscard]] Result<std::optional<std::uint64_t>> held_bytes(Multiplexer object);
  /// What the server answers to the initiate request of a block transfer, which is then aborted. nullopt:
  /// silence.
  [[nodiscard]] Result<std::optional<std::array<std::uint8_t, 8>>> try_block_initiate(
      const std::array<std::uint8_t, 8>& request);
  /// The state of the default channel is unknown: abort before the next transfer. After a time-out or a
  /// broken answer late ones may follow, so the channel rests as well; after a conversation a short pause is
  /// enough.
  void dirty(bool late_answers) { dirty(default_line(), late_answers); }
  [[nodiscard]] bool is_open() const {
    return default_line().state == State::open || default_line().state == State::abandoned;
  }
  [[nodiscard]] bool expects_late_answers() const { return default_line().state == State::late_answers; }
  /// Ends what is open on any channel and lets late answers pass; nothing to do on idle ones.
  [[nodiscard]] Result<void> make_idle();
  /// How long an answer may take, and after which silence a request counts as ignored: CiA 301 sets no limit,
  /// so both grow with the slowest answer seen.
  [[nodiscard]] Duration timeout() const { return std::max(timeout_, 3 * slowest_); }
  [[nodiscard]] Duration quiet() const { return std::max(quiet_, 3 * slowest_); }
  [[nodiscard]] Duration slowest() const { return slowest_; }
  /// An answer took this long.
  void note_latency(Duration latency) {
    latest_ = latency;
    slowest_ = std::max(slowest_, latency);
    recently_ = std::max(latency, recently_ - recently_ / 32);
  }
  /// The device has started since: what was lost while it booted says nothing about its answers.
  void forget_silences() { mute_.clear(); }
  /// A data frame went out that no transfer sent: whatever it opened on a channel is ended before the next
  /// transfer.
  void note_sent(const can::Frame& frame);
  /// A request was aborted at this time by a frame that no transfer sent.
  void note_abort(BusTime time) { aborted_at_ = time; }
  /// An abort is not answered; a server that does it all the same gets the time for it, so that its answer is
  /// not taken for the answer to the request that comes next.
  [[nodiscard]] Result<void> rest_after_abort();
  /// Whether somebody else sent requests on a channel that was used, among these frames.
  [[nodiscard]] bool has_other_client(std::size_t first, std::size_t end) const;
  /// Requests of the latest transfer: index of the first, stamp of the last frame we sent.
  [[nodiscard]] std::size_t first_request() const { return first_request_; }
  [[nodiscard]] BusTime last_request() const { return last_request_; }

  /// How many bytes an entry has by its type, where that is fixed: decides what an upload means that leaves
  /// its size open.
  using KnownSize = std::function<std::optional<std::size_t>(Multiplexer)>;
  void set_known_size(KnownSize known_size) { known_size_ = std::move(known_size); }

  struct Told {
    Multiplexer object;
    const Bytes& value;
    bool written = false;
    /// On the default channel of another node-ID, which the device has for a while (CiA 305): what follows
    /// from the node-ID is another value there.
    bool under_another_node_id = false;
  };
  /// Told of the value of an entry whenever an upload brought it or a download was confirmed, whoever asked.
  using OnValue = std::function<void(const Told& told)>;
  void set_on_value(OnValue on_value) { on_value_ = std::move(on_value); }

 private:
  enum class State : std::uint8_t {
    idle,
    open,          ///< a conversation has left it
    late_answers,  ///< an answer is overdue
    abandoned,     ///< a client fell silent on purpose: the next transfer begins without an abort
  };
  /// What conversations sent on a channel since the last transfer.
  struct ByHand {
    std::size_t begin = 0;             ///< index behind the first frame
    std::set<Multiplexer> asked;       ///< all entries that requests named
    std::vector<Multiplexer> entries;  ///< those that were likely opened
  };
  struct Line {
    State state = State::idle;
    std::optional<Multiplexer> stale;   ///< entry whose answer is overdue
    std::optional<Multiplexer> latest;  ///< entry of the latest transfer, for the abort that ends it
    ByHand by_hand;                     ///< what may have left transfers open
    BusTime asked_at{};                 ///< when the request went out whose answer is overdue
  };
  [[nodiscard]] Line& default_line() { return lines_.at(default_ids_); }
  [[nodiscard]] const Line& default_line() const { return lines_.at(default_ids_); }
  static void dirty(Line& line, bool late_answers);
  /// Whatever a frame that no transfer sent has opened on the line counts as open from now on.
  void heed_sent_by_hand(const steps::SdoChannelIds& ids, Line& line);
  /// The abort of a transfer of this entry; the index of its frame.
  [[nodiscard]] Result<std::size_t> give_up(CanId request, Multiplexer object);
  [[nodiscard]] Result<void> make_idle(const steps::SdoChannelIds& ids, Line& line);
  [[nodiscard]] bool is_default_of_another(const steps::SdoChannelIds& ids) const;
  /// Behind an abort on this channel, before the next request.
  [[nodiscard]] Duration rest(const steps::SdoChannelIds& ids) const;
  [[nodiscard]] bool owes_nothing(const steps::SdoChannelIds& ids) const;
  [[nodiscard]] bool is_patient(Multiplexer object) const;
  void waited_in_vain(Multiplexer object, Duration time);
  /// The answer to one frame on the default channel; nullopt: silence. What remains of it is ended.
  [[nodiscard]] Result<std::optional<std::array<std::uint8_t, 8>>> ask(
      const std::array<std::uint8_t, 8>& request);
  [[nodiscard]] Result<steps::SdoAnswer> run_one(canopen::SdoRequest request,
                                                 std::optional<Duration> timeout);
  void trim(Multiplexer object, Bytes& data) const;

  Recorder& recorder_;
  KnownSize known_size_;
  OnValue on_value_;
  Duration timeout_, quiet_;
  Duration slowest_{}, latest_{};  ///< answers: the slowest, and the latest one
  Duration recently_{};            ///< the slowest of late: one that is long ago counts less and less
  /// The entry of the transfer that the server said last it has begun, in the frames from index `begin` on.
  [[nodiscard]] std::optional<Multiplexer> confirmed_last(CanId response, const ByHand& sent,
                                                          std::size_t begin) const;
  std::map<CanId, ByHand> sent_by_hand_;
  Duration patience_spent_{};          ///< on answers that never came
  std::map<Multiplexer, int> mute_;    ///< entries for which all patience was in vain, and how often
  std::optional<BusTime> aborted_at_;  ///< by a conversation; the server has not been given time since
  steps::SdoChannelIds default_ids_;
  std::map<steps::SdoChannelIds, Line> lines_;
  std::size_t first_request_ = 0;
  BusTime last_request_{};
};

}  // namespace conform::engine
