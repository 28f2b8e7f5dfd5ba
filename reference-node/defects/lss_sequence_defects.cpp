// SPDX-License-Identifier: Apache-2.0
// Defects of the LSS slave (CiA 305) in what several frames make up: what one address leaves behind for the
// next, and what becomes of a node-ID that was configured.
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "defects/hooks.hpp"
#include "defects/lss_frames.hpp"
#include "defects/receivers.hpp"

namespace refnode {

using namespace defect;
using namespace defect::lss;

namespace {

constexpr std::uint8_t switch_state_global = 0x04;
constexpr std::uint8_t selective_vendor = 0x40;
constexpr std::uint8_t selective_serial = 0x43;
constexpr std::uint8_t selective_answer = 0x44;
constexpr std::uint8_t identify_vendor = 0x46;
constexpr std::uint8_t identify_revision_high = 0x49;
constexpr std::uint8_t identify_serial_high = 0x4B;
constexpr std::uint8_t identify_unconfigured = 0x4C;
constexpr std::uint8_t fastscan = 0x51;
constexpr std::uint8_t begin_of_scan = 0x80;
constexpr std::uint8_t last_part_of_scan = 3;

void answer(Parts& parts, std::uint8_t specifier, std::uint8_t value = 0) {
  parts.device.send(Service::lss, conform::can::data_frame(conform::CanId(answer_id),
                                                           {specifier, value, 0, 0, 0, 0, 0, 0}));
}
void identify(Parts& parts) { answer(parts, 0x4F); }

/// Behind `first` another frame of this kind is not taken before `last`.
Change begins_once(std::uint8_t first, std::uint8_t last) {
  return deaf_to([first, last, begun = false](Parts&, const Frame& frame) mutable {
    if (!is_request(frame)) return false;
    if (frame.data[0] == last) begun = false;
    if (frame.data[0] != first) return false;
    return std::exchange(begun, true);
  });
}

/// The last frame of ranges that were the slave's is answered once more.
Change answers_the_last_frame_again() {
  return misreads([last = std::uint8_t{0}](Parts& parts, Frame& frame) mutable {
    if (!is_request(frame)) return;
    const std::uint8_t before = std::exchange(last, frame.data[0]);
    if (before == identify_serial_high && last == identify_serial_high) identify(parts);
  });
}

/// The parts of an address stay behind one that was not the slave's: what comes alone stands for all of them.
Change keeps_the_address() {
  return [](Parts& parts) {
    parts.device.inbox.add_filter(
        [kept = std::array<std::optional<Frame>, 3>{}](std::vector<Frame>& frames) mutable {
          if (frames.size() != 1 || !is_request(frames[0])) return;
          const auto frame = frames[0];
          const unsigned part = frame.data[0] - unsigned{selective_vendor};
          if (part < 3) kept[part] = frame;
          if (part != 3 || !kept[0] || !kept[1] || !kept[2]) return;
          frames = {*kept[0], *kept[1], *kept[2], frame};
        });
  };
}

Frame request(std::uint8_t specifier, std::uint32_t number) {
  std::array<std::uint8_t, 8> data{specifier};
  conform::store_le(std::span(data).subspan(1, 4), number);
  return conform::can::data_frame(conform::CanId(request_id), data);
}

/// Of the frames of one service the first is the vendor-ID. Those of identify remote slave name two of the
/// parts twice: the lowest number and the highest.
class LssService {
 public:
  explicit LssService(bool selects) : selects_(selects) {}

  [[nodiscard]] unsigned first() const { return selects_ ? selective_vendor : identify_vendor; }
  [[nodiscard]] unsigned frames() const { return selects_ ? 4U : 6U; }
  [[nodiscard]] std::uint8_t part(unsigned step) const {
    constexpr std::array<std::uint8_t, 6> identified{0, 1, 2, 2, 3, 3};
    return selects_ ? static_cast<std::uint8_t>(step) : identified[step];
  }

 private:
  bool selects_;
};

/// Switch state selective and identify remote slave remember together which parts were the slave's, until the
/// last one has come, another vendor-ID of switch state selective, or switch state global.
void shares_the_parts(Parts& parts) {
  parts.device.inbox.add_filter([&parts, fits = std::array<bool, 4>{}](std::vector<Frame>& frames) mutable {
    if (frames.size() != 1 || !is_request(frames[0])) return;
    const std::uint8_t specifier = frames[0].data[0];
    if (specifier == switch_state_global || specifier == selective_vendor) fits = {};
    const bool selects = specifier >= selective_vendor && specifier <= selective_serial;
    if (!selects && (specifier < identify_vendor || specifier > identify_serial_high)) return;
    const LssService service(selects);
    const std::uint8_t part = service.part(specifier - service.first());
    const auto named = static_cast<std::uint32_t>(conform::load_le(frames[0].bytes().subspan(1, 4)));
    const std::uint32_t own = parts.lss.rules.address(part);
    if (selects || part < 2)
      fits[part] = named == own;
    else if (specifier == identify_revision_high || specifier == identify_serial_high)
      fits[part] = fits[part] && own <= named;
    else
      fits[part] = named <= own;
    if (specifier != selective_serial && specifier != identify_serial_high) return;
    const bool all = fits[0] && fits[1] && fits[2] && fits[3];
    fits = {};
    if (!all) return;
    // As if all of them had been of this service.
    frames.clear();
    for (unsigned step = 0; step < service.frames(); ++step)
      frames.push_back(request(static_cast<std::uint8_t>(service.first() + step),
                               parts.lss.rules.address(service.part(step))));
  });
}

/// Whether the slave is in the configuration state.
std::shared_ptr<bool> in_configuration(Parts& parts) {
  const auto configuration = std::make_shared<bool>(false);
  parts.device.outbox.add_filter(
      [configuration](const FilterContext& context, const std::vector<Outgoing>& frames) {
        if (context.service == Service::boot_up) *configuration = false;
        const bool answers = context.service == Service::lss && !frames.empty();
        if (answers && frames.front().frame.data[0] == selective_answer) *configuration = true;
      });
  parts.device.inbox.add_filter([configuration](const std::vector<Frame>& frames) {
    if (frames.size() != 1 || !is_request(frames[0])) return;
    const auto& data = frames[0].data;
    if (data[0] == switch_state_global) *configuration = data[1] == 1;
  });
  return configuration;
}

/// A slave in the configuration state takes each serial number for its own.
void answers_any_serial_in_configuration(Parts& parts) {
  parts.device.inbox.add_filter(
      [configuration = in_configuration(parts), &parts](std::vector<Frame>& frames) {
        if (frames.size() != 1 || !is_request(frames[0])) return;
        const auto& data = frames[0].data;
        if (!*configuration || data[0] != selective_serial) return;
        answer(parts, selective_answer);
        frames.clear();
      });
}

/// Also a waiting slave obeys "activate bit timing": it is off the bus for twice the time that is told.
void activates_while_waiting(Parts& parts) {
  constexpr std::uint8_t activate_bit_timing = 0x15;
  const auto back = std::make_shared<BusTime>();
  deaf_to([back, configuration = in_configuration(parts)](Parts& node, const Frame& frame) {
    if (node.device.now < *back) return true;
    if (!is_request(frame, activate_bit_timing) || *configuration) return false;
    *back = node.device.now + 2 * std::chrono::milliseconds(conform::load_le(frame.bytes().subspan(1, 2)));
    return true;
  })(parts);
  parts.device.outbox.add_filter([back](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.now < *back) frames.clear();
  });
}

/// In the configuration state a slave answers who asks for those without node-ID, though it has one.
void counts_as_unconfigured_in_configuration(Parts& parts) {
  parts.lss.rules.configured.replace(
      [configuration = in_configuration(parts)](const auto& former, const Frame& frame) {
        return former(frame) && (frame.data[0] != identify_unconfigured || !*configuration);
      });
}

/// A waiting slave does not hear who asks for those without node-ID.
void tells_in_configuration_that_it_has_no_node_id(Parts& parts) {
  deaf_to([configuration = in_configuration(parts)](Parts&, const Frame& frame) {
    return is_request(frame, identify_unconfigured) && !*configuration;
  })(parts);
}

/// An SDO request to this device makes it forget how far the frames from `first` to `last` had come.
Change forgets_with_an_sdo_request(std::uint8_t first, std::uint8_t last) {
  return deaf_to([first, last, forgotten = false](Parts& parts, const Frame& frame) mutable {
    if (frame.id == 0x600U + parts.device.node_id) forgotten = true;
    if (!is_request(frame) || frame.data[0] < first || frame.data[0] > last) return false;
    if (frame.data[0] == first) forgotten = false;
    return forgotten;
  });
}

/// A scan that begins behind one that was given up waits for the part that was due there, if it had found as
/// many as this.
Change goes_on_with_a_scan(int at_least) {
  return deaf_to([at_least, parts_found = 0](Parts& parts, const Frame& frame) mutable {
    if (!is_request(frame) || frame.data[0] != fastscan || parts.device.node_id <= 127) return false;
    if (frame.data[5] != begin_of_scan) {
      parts_found = frame.data[7];
      return false;
    }
    if (parts_found >= at_least) identify(parts);
    return parts_found >= at_least;
  });
}

/// Once found, the slave takes part in no other scan.
Change is_found_once() {
  return deaf_to([found = false](Parts& parts, const Frame& frame) mutable {
    if (!is_request(frame) || frame.data[0] != fastscan || parts.device.node_id <= 127) return false;
    const bool deaf = found;
    const std::uint32_t serial = parts.lss.rules.address(last_part_of_scan);
    const auto named = static_cast<std::uint32_t>(conform::load_le(frame.bytes().subspan(1, 4)));
    found = found || (frame.data[5] == 0 && frame.data[6] == last_part_of_scan && named == serial);
    return deaf;
  });
}

/// A slave without node-ID tells so once.
Change tells_once_that_it_has_no_node_id() {
  return deaf_to([told = false](Parts& parts, const Frame& frame) mutable {
    if (!is_request(frame) || frame.data[0] != identify_unconfigured) return false;
    return parts.device.node_id > 127 && std::exchange(told, true);
  });
}

/// A slave without node-ID begins with one as soon as it is told, in the configuration state.
void begins_in_configuration(Parts& parts) {
  constexpr std::uint8_t configure_node_id = 0x11;
  parts.device.outbox.add_filter([&parts](const FilterContext& context, const std::vector<Outgoing>& frames) {
    if (context.service != Service::lss || frames.empty() || parts.device.node_id <= 127) return;
    const auto& data = frames.front().frame.data;
    if (data[0] == configure_node_id && data[1] == 0) parts.lss.on_node_id();
  });
}

/// A slave without node-ID takes unknown commands for those of a scan.
void takes_unknown_for_scan(Parts& parts, Frame& frame) {
  if (is_request(frame) && frame.data[0] >= 0x60 && parts.device.node_id > 127) frame.data[0] = fastscan;
}

/// The default COB-IDs that a slave has when it loses its node-ID.
struct KeptCobIds {
  std::uint8_t node_id = 0;
  std::vector<Entry*> entries;
};

/// The default COB-IDs of EMCY and PDOs stay when the slave loses its node-ID, and also when it is given
/// another one, until it has the former one again.
void keeps_cob_ids_over_no_node_id(Parts& parts) {
  const auto kept = std::make_shared<KeptCobIds>();
  parts.lss.rules.after_reset_communication.replace(
      [&parts, kept](const auto& former, std::uint8_t active, std::uint8_t pending) -> std::uint8_t {
        const std::uint8_t next = former(active, pending);
        const bool loses = active != LssSlave::no_node_id && next == LssSlave::no_node_id;
        if (!loses || !kept->entries.empty()) return next;
        kept->node_id = active;
        for (auto& [index, object] : parts.device.dictionary.objects()) {
          const bool rpdo = index >= 0x1400 && index < 0x1600;
          const bool tpdo = index >= 0x1800 && index < 0x1A00;
          if (index != 0x1014 && !rpdo && !tpdo) continue;
          for (auto& [sub, entry] : object.entries) {
            if (!std::exchange(entry.adds_node_id, false)) continue;
            kept->entries.push_back(&entry);
          }
        }
        return next;
      });
  with_boot_up([kept](Parts& node) {
    if (node.device.node_id != kept->node_id) return;
    for (Entry* entry : kept->entries) entry->adds_node_id = true;
    kept->entries.clear();
  })(parts);
}

/// What the latest configure node-ID said; nothing: there was none.
struct Configured {
  std::optional<std::uint8_t> accepted;
  bool refused = false;  ///< behind the accepted one
};
std::shared_ptr<Configured> latest_configured(Parts& parts) {
  const auto latest = std::make_shared<Configured>();
  parts.lss.rules.node_id_allowed.replace([latest](const auto& former, std::uint8_t node_id) {
    const bool allowed = former(node_id);
    if (allowed) latest->accepted = node_id;
    latest->refused = !allowed;
    return allowed;
  });
  return latest;
}

std::shared_ptr<Configured> configured_since_boot_up(Parts& parts) {
  const auto latest = latest_configured(parts);
  with_boot_up([latest](Parts&) { *latest = {}; })(parts);
  return latest;
}

/// A node-ID that is refused takes the accepted one with it.
void forgets_with_a_refused_one(Parts& parts) {
  parts.lss.rules.after_reset_communication.replace(
      [latest = latest_configured(parts)](const auto& former, std::uint8_t active, std::uint8_t pending) {
        return latest->refused ? active : former(active, pending);
      });
}

/// Reset node leaves the node-ID that was configured and not stored for the next reset communication.
void remembers_over_reset_node(Parts& parts) {
  parts.lss.rules.after_reset_communication.replace(
      [latest = latest_configured(parts)](const auto& former, std::uint8_t active, std::uint8_t pending) {
        return latest->accepted.value_or(former(active, pending));
      });
}

/// Reset communication brings back the node-ID that the device was delivered with, unless another one waits
/// for it.
void forgets_the_stored_one(Parts& parts) {
  const auto latest = configured_since_boot_up(parts);
  parts.lss.rules.after_reset_communication.replace(
      [latest, first = parts.device.node_id](const auto& former, std::uint8_t active, std::uint8_t pending) {
        return latest->accepted ? former(active, pending) : first;
      });
}

/// A number in this part of an LSS address that stands for any.
Change takes_for_any(std::uint8_t part, std::uint32_t any) {
  return [part, any](Parts& parts) {
    parts.lss.address_rules.is_own.replace(
        [&parts, part, any](const auto& former, std::uint32_t named, std::uint32_t own) {
          return former(named, own) || (named == any && own == parts.lss.rules.address(part));
        });
  };
}

/// A slave that has identified itself answers the inquiry of its node-ID.
void is_selected_by_identifying(Parts& parts) {
  constexpr std::uint8_t inquire_node_id = 0x5E, identified = 0x4F;
  const auto open = std::make_shared<bool>(false);
  parts.device.outbox.add_filter([open](const FilterContext& context, const std::vector<Outgoing>& frames) {
    if (context.service == Service::lss && !frames.empty() && frames.front().frame.data[0] == identified)
      *open = true;
  });
  deaf_to([open](Parts& node, const Frame& frame) {
    if (!is_request(frame)) return false;
    if (frame.data[0] == switch_state_global) *open = false;
    if (!*open || frame.data[0] != inquire_node_id) return false;
    answer(node, inquire_node_id, node.device.node_id);
    return true;
  })(parts);
}

/// As soon as the configuration is stored, inquire node-ID tells what was.
void tells_the_stored_one(Parts& parts) {
  constexpr std::uint8_t inquire_node_id = 0x5E;
  const auto stored = since_boot_up<std::optional<std::uint8_t>>(parts);
  parts.lss.keep = [stored, former = parts.lss.keep](std::uint8_t node_id,
                                                     std::optional<std::uint8_t> bit_rate) {
    const bool kept = former(node_id, bit_rate);
    if (kept) *stored = node_id;
    return kept;
  };
  parts.device.outbox.add_filter([stored](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::lss || !*stored) return;
    for (Outgoing& each : frames) {
      if (each.frame.data[0] == inquire_node_id) each.frame.data[1] = **stored;
    }
  });
}

/// A node-ID that waits for the reset is stored with the parameters.
void is_stored_with_the_parameters(Parts& parts) {
  const auto latest = configured_since_boot_up(parts);
  after_writing(0x1010, 1, [latest](Parts& node, const std::function<void()>& former) {
    former();
    if (latest->accepted) static_cast<void>(node.lss.keep(*latest->accepted, {}));
  })(parts);
}

/// A stored node-ID that is none is taken for nothing stored.
void never_stores_none(Parts& parts) {
  parts.lss.stored_node_id = [former = parts.lss.stored_node_id] {
    const auto stored = former();
    return stored == LssSlave::no_node_id ? std::nullopt : stored;
  };
}

void tells_the_configured_one(Parts& parts) {
  constexpr std::uint8_t inquire_node_id = 0x5E;
  const auto latest = configured_since_boot_up(parts);
  parts.device.outbox.add_filter([latest](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::lss || !latest->accepted) return;
    for (Outgoing& each : frames) {
      if (each.frame.data[0] == inquire_node_id) each.frame.data[1] = *latest->accepted;
    }
  });
}

/// The node-ID in such frames is compared with the one that the device was switched on with.
Change keeps_listening_to_its_first_node_id(bool (*holds_node_id)(const Frame&),
                                            void (*put)(Frame&, std::uint8_t node_id),
                                            std::uint8_t (*get)(const Frame&)) {
  return [=](Parts& parts) {
    constexpr std::uint8_t nobody = 0x7F;
    misreads([=, first = parts.device.node_id](Parts& node, Frame& frame) {
      const std::uint8_t present = node.device.node_id;
      if (present == first || !holds_node_id(frame) || get(frame) == 0) return;
      put(frame, get(frame) == first ? present : nobody);
    })(parts);
  };
}

/// SDO requests to the node-ID that the device was switched on with are served, too.
Change answers_sdo_of_its_first_node_id() {
  return [](Parts& parts) {
    misreads([first = parts.device.node_id](Parts& node, Frame& frame) {
      if (!frame.extended && frame.id == 0x600U + first) frame.id = 0x600U + node.device.node_id;
    })(parts);
  };
}

bool is_guard_request(const Frame& frame) {
  return frame.remote && !frame.extended && frame.id > 0x700 && frame.id <= 0x77F;
}

/// The default COB-IDs of all PDOs but the first ones are fixed.
DictionaryEdit later_pdos_keep_their_defaults() {
  return [](ObjectDictionary& od, std::uint8_t) {
    for (auto& [index, object] : od.objects()) {
      const bool later = (index > 0x1400 && index < 0x1600) || (index > 0x1800 && index < 0x1A00);
      for (auto& [sub, entry] : object.entries) entry.adds_node_id = entry.adds_node_id && !later;
    }
  };
}

}  // namespace

DefectTable lss_sequence_defects() {
  return {
      {"lss-second-address-not-taken",
       "Behind a vendor-ID no other LSS address is taken before the next switch state global",
       {"LSS-SS-01"},
       begins_once(selective_vendor, switch_state_global)},
      {"lss-second-ranges-not-taken",
       "Ranges that were not ended are not followed by others",
       {"LSS-ID-02"},
       begins_once(identify_vendor, identify_serial_high)},
      {"lss-last-range-alone-answered",
       "The last frame of identify remote slave is answered once more when it comes alone",
       {"LSS-GEN-08"},
       answers_the_last_frame_again()},
      {"lss-address-kept",
       "The first three parts of an LSS address stay, and the fourth one alone is answered",
       {"LSS-SS-03", "LSS-SS-04"},
       keeps_the_address()},
      {"lss-identification-shares-address",
       "What switch state selective and identify remote slave name counts for both",
       {"LSS-SS-03", "LSS-ID-02", "LSS-GEN-08"},
       Change(shares_the_parts)},
      {"lss-vendor-0-is-any",
       "Vendor-ID 0 in an LSS address stands for any",
       {"LSS-SS-02"},
       takes_for_any(0, 0)},
      {"lss-product-0-is-any",
       "Product code 0 in an LSS address stands for any",
       {"LSS-SS-02"},
       takes_for_any(1, 0)},
      {"lss-revision-of-all-ones-is-any",
       "Revision number FFFF FFFFh in an LSS address stands for any",
       {"LSS-SS-02"},
       takes_for_any(2, 0xFFFF'FFFF)},
      {"lss-identifying-selects",
       "A slave that has identified itself answers the inquiry of its node-ID",
       {"LSS-INQ-06"},
       Change(is_selected_by_identifying)},
      {"lss-stored-node-id-lost-with-reset-communication",
       "The stored node-ID is active after power-on, and with reset communication the delivered one is",
       {"LSS-ST-02"},
       Change(forgets_the_stored_one)},
      {"lss-selective-answered-in-configuration",
       "In the configuration state every serial number of switch state selective is answered",
       {"LSS-SS-02"},
       Change(answers_any_serial_in_configuration)},
      {"lss-fastscan-goes-on",
       "A fastscan that begins behind one that was given up goes on with that",
       {"LSS-FS-03"},
       goes_on_with_a_scan(1)},
      {"lss-fastscan-goes-on-behind-two-parts",
       "A fastscan that begins behind one that was given up after two parts or more goes on with that",
       {"LSS-FS-03"},
       goes_on_with_a_scan(2)},
      {"lss-fastscan-finds-once",
       "A slave that a fastscan has found is found by no other",
       {"LSS-FS-03"},
       is_found_once()},
      {"lss-unconfigured-answers-once",
       "A slave without node-ID answers 4Ch once, until power is switched",
       {"LSS-ID-04"},
       tells_once_that_it_has_no_node_id()},
      {.id = "lss-unconfigured-silent-in-waiting",
       .summary = "A slave without node-ID answers 4Ch in the configuration state only",
       .violates = {"LSS-ID-04"},
       .how = Change(tells_in_configuration_that_it_has_no_node_id),
       .lacks = {"lss identify non-configured"}},
      {"lss-configured-slave-answers-4c-in-configuration",
       "In the configuration state a slave with a node-ID answers 4Ch",
       {"LSS-ID-03"},
       Change(counts_as_unconfigured_in_configuration)},
      {"lss-sdo-request-forgets-address",
       "An SDO request between the parts of an LSS address makes the slave forget them",
       {"LSS-SS-01"},
       forgets_with_an_sdo_request(selective_vendor, selective_serial)},
      {"lss-sdo-request-forgets-ranges",
       "An SDO request between the frames of identify remote slave makes the slave forget them",
       {"LSS-ID-02"},
       forgets_with_an_sdo_request(identify_vendor, identify_serial_high)},
      {"lss-boots-in-configuration",
       "A slave without node-ID boots up with 11h, before it leaves the configuration state",
       {"LSS-CN-06"},
       Change(begins_in_configuration)},
      {"lss-does-not-boot-with-new-node-id",
       "A slave without node-ID that is given one goes on waiting, until power is switched",
       {"LSS-CN-06"},
       Change([](Parts& parts) { parts.lss.on_node_id = {}; })},
      {"lss-deaf-without-node-id",
       "A slave without node-ID does not listen, until power is switched",
       {"LSS-SS-01"},
       deaf_to([](Parts& parts, const Frame& frame) {
         return frame.id == request_id && parts.device.node_id > 127;
       })},
      {"lss-unknown-command-taken-for-fastscan",
       "A slave without node-ID takes unknown commands for fastscan",
       {"LSS-GEN-02"},
       misreads(takes_unknown_for_scan)},
      {"lss-refused-node-id-forgets-accepted",
       "A node-ID that is refused takes with it the one that was accepted before",
       {"LSS-CN-04"},
       Change(forgets_with_a_refused_one)},
      {"lss-node-id-outlives-reset-node",
       "A node-ID that was not stored is forgotten with reset node, and back with the next reset communication",
       {"LSS-CN-05"},
       Change(remembers_over_reset_node)},
      {"lss-configured-node-id-inquired",
       "Inquire node-ID tells the one that waits for the reset",
       {"LSS-INQ-05"},
       Change(tells_the_configured_one)},
      {"lss-stored-node-id-inquired",
       "Inquire node-ID tells the one that waits for the reset as soon as it is stored",
       {"LSS-INQ-05"},
       Change(tells_the_stored_one)},
      {"lss-node-id-stored-with-parameters",
       "A node-ID that waits for the reset is stored with 1010h:01",
       {"LSS-CN-05"},
       Change(is_stored_with_the_parameters)},
      {"lss-missing-node-id-not-stored",
       "With reset node a slave forgets that it has stored to have no node-ID",
       {"LSS-ST-02"},
       Change(never_stores_none)},
      {"lss-sdo-keeps-node-id",
       "With another node-ID SDO requests to the former one are answered",
       {"LSS-CN-04"},
       answers_sdo_of_its_first_node_id()},
      {"lss-guarding-keeps-node-id",
       "With another node-ID guard requests to the former one are answered",
       {"LSS-CN-04"},
       keeps_listening_to_its_first_node_id(
           is_guard_request, [](Frame& frame, std::uint8_t node_id) { frame.id = 0x700U + node_id; },
           [](const Frame& frame) { return static_cast<std::uint8_t>(frame.id - 0x700U); })},
      {"lss-nmt-keeps-node-id",
       "With another node-ID NMT commands to the former one are obeyed",
       {"LSS-CN-04", "LSS-ST-02"},
       keeps_listening_to_its_first_node_id(
           is_nmt_command, [](Frame& frame, std::uint8_t node_id) { frame.data[1] = node_id; },
           [](const Frame& frame) { return frame.data[1]; })},
      {"lss-cob-ids-kept-over-no-node-id",
       "A slave without node-ID that is given another one than it had keeps the default COB-IDs of that",
       {"OD-RST-06", "LSS-CN-06"},
       Change(keeps_cob_ids_over_no_node_id)},
      {"lss-activation-obeyed-while-waiting",
       "A waiting slave that hears 15h is off the bus until the bit rate has been switched",
       {"LSS-INQ-06"},
       Change(activates_while_waiting)},
      {"lss-later-pdos-keep-cob-ids",
       "With another node-ID the default COB-IDs of the second PDOs and of all later ones stay",
       {"OD-RST-06"},
       later_pdos_keep_their_defaults()},
  };
}

}  // namespace refnode
