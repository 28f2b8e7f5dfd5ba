// SPDX-License-Identifier: Apache-2.0
// Traffic of one TPDO (CiA 301, 7.2.2): in Operational only.
#pragma once

#include <cstdint>
#include <optional>

#include "device/device.hpp"
#include "pdo/parameters.hpp"

namespace refnode {

struct TransmitPdoChoices {
  bool initial_event = false;        ///< entering Operational is an event
  bool sends_at_first_sync = false;  ///< type n sends at SYNC 1, n + 1, ...
  bool sends_at_start_value =
      true;                     ///< and with a SYNC start value at that one, else it only begins to count
  bool change_is_event = true;  ///< of what is mapped; types 00h, FEh and FFh
  bool first_alone_is_sent = false;  ///< of several that carry what has changed, not every one
  bool sent_empty = false;           ///< without mapped objects it is sent, with no data
  bool heeds_remote_dlc = false;     ///< a remote frame of another length than its own is none for it
  bool sent_when_set = false;        ///< a write of its parameters in Operational is an event
  bool sends_in_the_middle = false;  ///< type n sends at SYNC n / 2 + 1 first
  bool timer_goes_on = false;        ///< a new event time counts from the last TPDO
  bool write_is_event = false;       ///< of what is mapped, also where the value is the same
  bool timer_is_event = false;       ///< of type 00h: sent with the SYNC behind the end of its event timer
};

/// What lets a TPDO be sent by itself.
enum class TransmitCause : std::uint8_t { change, timer };

struct TransmitPdoRules {
  /// Bit 31 of the COB-ID says whether the PDO exists and is used.
  Rule<bool(const PdoParameters&)> valid;
  /// Types 01h to F0h: with every n-th SYNC; type 00h: with the SYNC after an event. `syncs`: since it was
  /// sent last.
  Rule<bool(const PdoParameters&, std::uint32_t syncs, bool event)> sent_at_sync;
  /// Where SYNCs are counted, counting begins at the one that has the start value; else it means nothing.
  Rule<bool(const PdoParameters&, std::optional<std::uint8_t> counter)> counting_begins;
  /// Types FEh and FFh are sent with the event; type 00h waits for the SYNC.
  Rule<bool(const PdoParameters&)> sent_with_event;
  /// Types FEh and FFh are also sent when the event timer has elapsed.
  Rule<bool(const PdoParameters&)> has_event_timer;
  /// It is an event when what is mapped differs from what was sent last.
  Rule<bool(const PdoParameters&, const Bytes& sent, const Bytes& now)> is_event;
  /// The inhibit time holds back whatever the type sends by itself, on a change or by the event timer.
  Rule<bool(const PdoParameters&, TransmitCause)> held_back;
  /// What was held back is sent when the inhibit time is over.
  Rule<bool(const PdoParameters&)> made_up_for;
  /// A remote frame is answered in every type, where the PDO is valid and bit 30 allows it.
  Rule<bool(const PdoParameters&, bool enabled)> answers_remote;
  /// Type FCh: the SYNC samples, whether or not what was sampled before has been asked for.
  Rule<Bytes(const PdoParameters&, const Bytes& held, const Bytes& now)> sampled;
  /// It carries what the mapped objects hold at the moment; type FCh: with the last SYNC.
  Rule<Bytes(const PdoParameters&, const Bytes& due)> carried;
  /// Parameters that are written in Operational take effect there.
  Rule<bool(const PdoParameters&)> takes_effect;
  TransmitPdoRules();
};

/// What holds for all TPDOs.
struct TransmitPdoTerms {
  explicit TransmitPdoTerms(const ObjectDictionary& dictionary)
      : parameters(dictionary, PdoDirection::transmit) {}

  PdoTerms parameters;
  TransmitPdoChoices choices;
  TransmitPdoRules rules;
};

class TransmitPdo {
 public:
  /// `number` 0 is that of 1800h. `terms` outlive the PDO.
  TransmitPdo(Device& device, const TransmitPdoTerms& terms, std::uint16_t number);

  /// Something mapped may have changed. Whether it has, and no event waits to be sent.
  bool on_application_change();
  /// Whether both carry an object.
  [[nodiscard]] bool shares_an_object_with(const TransmitPdo& other) const;
  /// Another one has told what has changed.
  void take_as_told() { reported_ = content(); }
  /// `counter`: of a SYNC that has one.
  void on_sync(std::optional<std::uint8_t> counter);
  /// True when the remote frame asks for this PDO.
  bool on_remote(const Frame& frame);
  void on_state_change();
  void on_time();

 private:
  [[nodiscard]] Bytes content() const;
  [[nodiscard]] bool event_driven() const { return terms_->rules.sent_with_event(parameters_); }
  [[nodiscard]] bool held_back(TransmitCause cause) const;
  [[nodiscard]] bool timed() const;
  [[nodiscard]] bool timer_waits_for_sync() const;
  [[nodiscard]] bool enabled() const;
  void transmit(const Bytes& due);
  void start_event_timer();
  void on_parameters();
  void restart();

  Device* device_;
  const TransmitPdoTerms* terms_;
  PdoParameters parameters_;
  Bytes reported_;             ///< content of the last TPDO, or at the start of Operational
  Bytes sampled_;              ///< type FCh: content at the last SYNC
  bool event_ = false;         ///< type 00h, or an event waiting for the inhibit time
  std::uint32_t syncs_ = 0;    ///< SYNCs since the last TPDO
  bool awaits_start_ = false;  ///< for the SYNC whose counter is the SYNC start value
  BusTime sent_{};             ///< when the last one was
  Alarms::Alarm timer_;
  Alarms::Alarm inhibited_until_;
};

}  // namespace refnode
