// SPDX-License-Identifier: Apache-2.0
// Refusals of the COB-ID parameters, of which CiA 301 names hardly any code.
#include <cstdint>
#include <vector>

#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

template <typename Change>
How everywhere(Change change) {
  return [change](Parts& parts) {
    for (CobIdRules* each :
         {&parts.sync.cob_id_rules, &parts.time.cob_id_rules, &parts.emergency.cob_id_rules,
          &parts.emergencies.cob_id_rules, &parts.pdos.rpdo.parameters.cob_id_rules,
          &parts.pdos.tpdo.parameters.cob_id_rules})
      change(each->choices);
  };
}

How lock_code(AbortCode code) {
  return everywhere([code](CobIdChoices& c) { c.locked = code; });
}

How restricted_code(AbortCode code) {
  return everywhere([code](CobIdChoices& c) { c.restricted = code; });
}

/// COB-IDs of TPDOs take bit 29, and their frames have 29 bits then.
void extended_tpdos(Parts& node) {
  constexpr std::uint32_t frame_bit = 0x2000'0000;
  node.pdos.tpdo.parameters.cob_id_rules.frame_bit_allowed.replace(
      [](const auto&, std::uint32_t) { return true; });
  node.device.outbox.add_filter([&node](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.service != Service::tpdo) return;
    for (Outgoing& each : frames) {
      for (std::uint16_t index = 0x1800; index <= 0x19FF; ++index) {
        const auto value = static_cast<std::uint32_t>(node.device.dictionary.number(index, 1));
        if ((value & frame_bit) == 0 || (value & 0x7FFU) != each.frame.id) continue;
        each.frame.extended = true;
        each.frame.id = value & 0x1FFF'FFFFU;
        break;
      }
    }
  });
}

}  // namespace

VariantTable cob_id_variants() {
  return {
      {"abort-frame-bit-0800-0000", "bit 29 cannot be set: general error",
       "OD-1005-04, OD-1014-05, OD-1400-13",
       everywhere([](CobIdChoices& c) { c.frame_bit = abort_code::general_error; })},
      {"abort-upper-bits-0609-0031", "bits 28-11 of a base frame: value too high", "OD-1005-12, CAN-RID-08",
       everywhere([](CobIdChoices& c) { c.upper_bits = abort_code::value_too_high; })},
      {"abort-lock-0604-0043", "a COB-ID in use cannot be changed: incompatible", "OD-1014-06, OD-1400-10",
       lock_code(abort_code::parameter_incompatible), "lock-code"},
      {"abort-lock-0800-0000", "a COB-ID in use cannot be changed: general error", "OD-1014-06, OD-1400-10",
       lock_code(abort_code::general_error), "lock-code"},
      {"abort-lock-0800-0020", "a COB-ID in use cannot be changed: cannot be stored",
       "OD-1014-06, OD-1400-10", lock_code(abort_code::cannot_store), "lock-code"},
      {"abort-lock-0800-0021", "a COB-ID in use cannot be changed: local control", "OD-1014-06, OD-1400-10",
       lock_code(AbortCode(0x08000021)), "lock-code"},
      {"abort-lock-0800-0022", "a COB-ID in use cannot be changed: device state", "OD-1014-06, OD-1400-10",
       lock_code(abort_code::device_state), "lock-code"},
      {"abort-restricted-0609-0031", "a restricted CAN-ID: value too high", "CAN-RID-01 to -05",
       restricted_code(abort_code::value_too_high), "restricted-code"},
      {"abort-restricted-0609-0032", "a restricted CAN-ID: value too low", "CAN-RID-01 to -05",
       restricted_code(abort_code::value_too_low), "restricted-code"},
      {"abort-restricted-0604-0043", "a restricted CAN-ID: incompatible", "CAN-RID-01 to -05",
       restricted_code(abort_code::parameter_incompatible), "restricted-code"},
      {"abort-restricted-0800-0000", "a restricted CAN-ID: general error", "CAN-RID-01 to -05",
       restricted_code(abort_code::general_error), "restricted-code"},
      {"abort-static-0800-0000", "bit 30 of SYNC and TIME cannot be set: general error",
       "OD-1005-03, OD-1012-03",
       [](Parts& node) {
         node.sync.cob_id_rules.choices.fixed_bit = node.time.cob_id_rules.choices.fixed_bit =
             abort_code::general_error;
       }},
      {"abort-1014-bit-30-0609-0031", "reserved bit 30 of 1014h: value too high", "OD-1014-04",
       [](Parts& node) { node.emergency.cob_id_rules.choices.fixed_bit = abort_code::value_too_high; }},
      {"restricted-always", "a restricted CAN-ID is refused while the object is not valid, too",
       "CAN-RID-03 to -05", everywhere([](CobIdChoices& c) { c.restricted_always = true; })},
      {"locked-by-former-value", "switching off and moving in one write is a change while valid",
       "7.5.2.17, 7.5.2.35, 7.5.2.37: bits 29-0 stay while the object is valid",
       everywhere([](CobIdChoices& c) { c.locked_by_former_value = true; })},
      {"pdo-only-valid-bit",
       "PDOs can be switched off, their CAN-IDs cannot be changed",
       "OD-1400-12, OD-1800-12",
       [](Parts& node) {
         node.pdos.rpdo.parameters.cob_id_rules.choices.only_valid_bit =
             node.pdos.tpdo.parameters.cob_id_rules.choices.only_valid_bit = true;
       },
       {},
       {"lock-code"},
       {},
       {"fixed cob-ids"}},
      {.id = "tpdo-29-bit",
       .summary = "TPDOs can have 29-bit identifiers",
       .legal = "OD-1800-13, CAN-EXT-01: bit 29 is taken, and the frames have 29 bits",
       .how = extended_tpdos,
       .lacks = {"base frames only"}},
      {.id = "pdo-only-valid-bit-0800-0000",
       .summary = "the same, refused as a general error",
       .legal = "OD-1400-12, OD-1800-12",
       .how =
           [](Parts& node) {
             node.pdos.rpdo.parameters.cob_id_rules.choices.only_valid_bit =
                 node.pdos.tpdo.parameters.cob_id_rules.choices.only_valid_bit = true;
             node.pdos.rpdo.parameters.cob_id_rules.choices.locked =
                 node.pdos.tpdo.parameters.cob_id_rules.choices.locked = abort_code::general_error;
           },
       .excludes = {"lock-code", "pdo-only-valid-bit"},
       .gains = {"fixed cob-ids"}},
  };
}

}  // namespace refnode
