// SPDX-License-Identifier: Apache-2.0
// Conditions in words: "object 1003h is present and 1014h:00 is writable". `when`, `unless` and `require` use
// them.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "device/profile.hpp"
#include "result/run_result.hpp"
#include "steps/expression.hpp"

namespace conform::steps {

/// A question whose answer has grounds beyond the answer itself.
enum class Asked : std::uint8_t {
  presence,
  reading,
  writing,
  block_upload,
  block_download,
  mapping,
  factory_defaults,  ///< why they may not be active
  values_put_back    ///< why some may not be
};

/// What conditions may ask of the device and the bench.
class Facts : public Scope {
 public:
  /// Whether the device has shown the entry (sub_given) or any entry of the index. Asks the device if
  /// unknown.
  [[nodiscard]] virtual Result<bool> is_present(Multiplexer object, bool whole_object) = 0;
  /// Whether standard, EDS or profile say that the device has it.
  [[nodiscard]] virtual bool is_claimed(Multiplexer object, bool whole_object) const = 0;
  /// Access as claimed; where the standard leaves rw or const open, `writable` is found out by rewriting the
  /// value.
  [[nodiscard]] virtual Result<bool> is_readable(Multiplexer object) = 0;
  [[nodiscard]] virtual Result<bool> is_writable(Multiplexer object) = 0;
  /// Access word of the dictionary ("ro", "const", ...), empty when unknown.
  [[nodiscard]] virtual std::string access_of(Multiplexer object) const = 0;
  [[nodiscard]] virtual bool may_change(Multiplexer object) const = 0;
  /// Whether the device description says that a data type can be mapped to an RPDO in place of an object;
  /// nullopt where it says nothing.
  [[nodiscard]] virtual std::optional<bool> is_placeholder(Index /*type*/) const { return std::nullopt; }
  /// Whether its type is an INTEGERxx or UNSIGNEDxx; false where it is not known.
  [[nodiscard]] virtual bool is_integer(Multiplexer object) const = 0;
  [[nodiscard]] virtual bool claims(std::string_view feature) const = 0;
  /// The triggers of the profile that work with this device: a heartbeat can stay away only from a consumer
  /// of heartbeats, and from a run that may play one.
  [[nodiscard]] virtual Result<std::vector<device::ErrorTrigger>> error_triggers() = 0;
  /// Whether the profile says how storing is made to fail.
  [[nodiscard]] virtual bool store_fault_known() const { return false; }
  /// Whether the power of the device can be switched without a hand.
  [[nodiscard]] virtual bool power_switch_known() const { return false; }
  /// Whether the description says how many PDOs there are ("rpdos", "tpdos"), whether there is LSS ("lss"),
  /// and which bit rates ("bit rates").
  [[nodiscard]] virtual bool is_told(std::string_view /*what*/) const { return false; }
  /// Of the bus, in bit/s; nullopt: the interface does not tell.
  [[nodiscard]] virtual std::optional<std::uint32_t> bus_bit_rate() const { return std::nullopt; }
  /// Whether the description has the bit rate of the bus.
  [[nodiscard]] virtual bool bus_bit_rate_is_told() const { return false; }
  /// Whether nothing is stored in the device, so that the values after a reset are the defaults.
  [[nodiscard]] virtual bool factory_defaults() const { return false; }
  [[nodiscard]] virtual bool can_send_remote_frames() const = 0;
  /// An EDS or a profile lists the entries of the device.
  [[nodiscard]] virtual bool is_described() const { return false; }
  /// The last download of the scenario was answered by an abort.
  [[nodiscard]] virtual bool write_was_refused() const { return false; }
  /// Whether the device carries out SDO block uploads (or downloads) at all: both are optional. Tries it
  /// once.
  [[nodiscard]] virtual Result<bool> offers_block_transfer(bool /*upload*/) { return false; }
  /// Whether the entries of a PDO's mapping (or of the PDO whose parameters are named) can be changed: as
  /// claimed, else found out by writing what is there, in the order of 7.5.2.36.
  [[nodiscard]] virtual Result<bool> has_variable_mapping(Multiplexer /*object*/) { return false; }
  /// What was heard since the beginning of the run that neither we nor the device sent, in words; empty:
  /// nothing. Waits until there was some time to hear it.
  [[nodiscard]] virtual Result<std::string> others_heard() { return std::string(); }
  /// On what the latest answer to a question about the entry (of presence, reading and writing) or the device
  /// rests: "abort 0601 0002h (read-only)", "const, pump.eds:120". May be empty. Asks the device nothing.
  [[nodiscard]] virtual std::string grounds(Asked /*asked*/, Multiplexer /*object*/) const { return {}; }
  /// The user wants full sweeps instead of samples.
  [[nodiscard]] virtual bool tries_all_objects() const { return false; }
};

/// Why a condition holds or does not, for a person: the parts that decided it, with the values of names, and
/// what the user could give to change it.
struct Why {
  std::string text;
  std::vector<result::Want> wants;
};

class Condition {
 public:
  Condition() = default;
  static Result<Condition> parse(std::string_view text);
  [[nodiscard]] Result<bool> evaluate(Facts& facts) const;
  [[nodiscard]] const std::string& text() const { return text_; }
  /// Explains an answer that evaluate() gave. Values that decided it are read again.
  [[nodiscard]] Why why(Facts& facts, bool held) const;
  [[nodiscard]] Why why_not(Facts& facts) const { return why(facts, false); }
  [[nodiscard]] std::vector<std::string> names() const;
  /// The entries it asks about ("is present", "is writable"), in the order of the text.
  [[nodiscard]] std::vector<ObjectReference> objects() const;
  [[nodiscard]] bool empty() const { return tree_ == nullptr; }
  /// Whether finding the answer may write to the device ("is writable" rewrites a value).
  [[nodiscard]] bool may_write() const;

  struct Tree;

 private:
  std::string text_;
  std::shared_ptr<const Tree> tree_;
};

/// Forms a condition can take, for messages and the reference page.
[[nodiscard]] std::vector<std::string_view> condition_forms();

}  // namespace conform::steps
