// SPDX-License-Identifier: Apache-2.0
// Abort codes where the standard names several, or none.
#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

How wrong_signature(AbortCode code) {
  return [code](Parts& node) { node.store.choices.wrong_signature = code; };
}

}  // namespace

VariantTable abort_variants() {
  return {
      {"abort-too-long-0607-0010", "too many bytes are refused as a wrong length", "OD-LEN-02",
       [](Parts& node) { node.device.dictionary.choices.value_too_long = abort_code::length_mismatch; }},
      {"abort-too-short-0607-0010", "too few bytes are refused as a wrong length", "OD-LEN-01",
       [](Parts& node) { node.device.dictionary.choices.value_too_short = abort_code::length_mismatch; }},
      {"abort-above-limit-0609-0030", "a value above its limit is an invalid value", "OD-RNG-01",
       [](Parts& node) { node.device.dictionary.choices.value_above_limit = abort_code::invalid_value; }},
      {"abort-below-limit-0609-0030", "a value below its limit is an invalid value", "OD-RNG-02",
       [](Parts& node) { node.device.dictionary.choices.value_below_limit = abort_code::invalid_value; }},
      {"abort-empty-history-0800-0000", "an empty history is a general error", "OD-1003-03",
       [](Parts& node) {
         node.emergency.history.choices.nothing_recorded = node.emergency.history.choices.unused_field =
             abort_code::general_error;
       }},
      {"abort-unused-history-0609-0011",
       "an unused field of the history does not exist",
       "OD-1003-05, OD-1003-09",
       [](Parts& node) { node.emergency.history.choices.unused_field = abort_code::no_sub_index; },
       {},
       {"abort-empty-history-0800-0000"}},
      {"abort-1016-reserved-0609-0031", "reserved bits of 1016h are a value too high", "OD-1016-12",
       [](Parts& node) { node.consumer.choices.reserved_bits = abort_code::value_too_high; },
       "1016-reserved"},
      {"abort-1016-reserved-0604-0043", "reserved bits of 1016h are incompatible", "OD-1016-12",
       [](Parts& node) { node.consumer.choices.reserved_bits = abort_code::parameter_incompatible; },
       "1016-reserved"},
      {"1016-reserved-cleared", "reserved bits of 1016h are taken and read back as 0", "OD-1016-12",
       [](Parts& node) { node.consumer.choices.reserved_bits_cleared = true; }, "1016-reserved"},
      {.id = "abort-1016-duplicate-0800-0000",
       .summary = "a second entry for one node is a general error",
       .legal = "OD-1016-06, tolerated",
       .how = [](Parts& node) { node.consumer.choices.duplicate = abort_code::general_error; },
       .warns = {"OD-1016-06"}},
      {"abort-signature-0800-0021", "a wrong signature: local control", "OD-1010-08, OD-1011-08",
       wrong_signature(conform::AbortCode(0x08000021)), "signature"},
      {"abort-signature-0800-0022", "a wrong signature: device state", "OD-1010-08, OD-1011-08",
       wrong_signature(abort_code::device_state), "signature"},
      {"abort-signature-0800-0024", "a wrong signature: no data", "OD-1010-08, OD-1011-08",
       wrong_signature(abort_code::no_data), "signature"},
      {"storing-in-pre-operational-only", "storing is refused in Operational", "STO-1010-12",
       [](Parts& node) { node.store.choices.storing_needs_pre_operational = true; }},
      {"abort-pdo-inhibit-0601-0000", "the locked inhibit time: unsupported access", "OD-1400-18, OD-1800-18",
       choose_of_pdos([](PdoChoices& c) { c.inhibit_locked = abort_code::unsupported_access; }),
       "inhibit-code"},
      {"abort-pdo-inhibit-0800-0022", "the locked inhibit time: device state", "OD-1400-18, OD-1800-18",
       choose_of_pdos([](PdoChoices& c) { c.inhibit_locked = abort_code::device_state; }), "inhibit-code"},
      {"abort-map-absent-0604-0041", "an absent object cannot be mapped", "OD-1600-06, OD-1A00-06",
       choose_of_pdos([](PdoChoices& c) { c.absent_object = abort_code::not_mappable; })},
      {"abort-map-unmappable-0602-0000", "an unmappable object does not exist for mapping",
       "OD-1600-07, OD-1A00-07",
       choose_of_pdos([](PdoChoices& c) { c.unmappable_object = abort_code::no_object; })},
      {"abort-map-length-0607-0010", "a wrong length in a mapping entry",
       "OD-1600-08, OD-1A00-08, PDO-MAP-10",
       choose_of_pdos([](PdoChoices& c) { c.wrong_length = abort_code::length_mismatch; }), "map-length"},
      {"abort-map-length-0604-0042", "a wrong length in a mapping entry exceeds the PDO",
       "OD-1600-08, OD-1A00-08, PDO-MAP-10",
       choose_of_pdos([](PdoChoices& c) { c.wrong_length = abort_code::mapping_too_long; }), "map-length"},
      {"abort-map-length-0609-0030", "a wrong length in a mapping entry is an invalid value",
       "OD-1600-08, OD-1A00-08, PDO-MAP-10",
       choose_of_pdos([](PdoChoices& c) { c.wrong_length = abort_code::invalid_value; }), "map-length"},
      {"abort-map-count-0609-0031", "more entries than there are: value too high", "OD-1600-10, OD-1A00-10",
       choose_of_pdos([](PdoChoices& c) { c.too_many = abort_code::value_too_high; }), "map-count"},
      {"abort-map-count-0602-0000", "more entries than there are: no object", "OD-1600-10, OD-1A00-10",
       choose_of_pdos([](PdoChoices& c) { c.too_many = abort_code::no_object; }), "map-count"},
      {"abort-map-long-0602-0000", "a mapping of more than eight bytes: no object", "OD-1600-09, OD-1A00-09",
       choose_of_pdos([](PdoChoices& c) { c.too_long = abort_code::no_object; })},
      {"abort-map-order-0604-0043", "a mapping changed out of order: incompatible", "OD-1600-11, OD-1600-12",
       choose_of_pdos([](PdoChoices& c) { c.out_of_order = abort_code::parameter_incompatible; }),
       "map-order"},
      {"abort-map-order-0800-0022", "a mapping changed out of order: device state", "OD-1600-11, OD-1600-12",
       choose_of_pdos([](PdoChoices& c) { c.out_of_order = abort_code::device_state; }), "map-order"},
      {"abort-map-order-0609-0030", "a mapping changed out of order: invalid value", "OD-1600-11, OD-1600-12",
       choose_of_pdos([](PdoChoices& c) { c.out_of_order = abort_code::invalid_value; }), "map-order"},
      {"map-checked-at-count",
       "a mapping is checked when sub-index 00h is set",
       "OD-1600-06: step 3 or step 4",
       choose_of_pdos([](PdoChoices& c) { c.checked_at_count = true; }),
       {},
       {"1600", "1A00"}},
  };
}

}  // namespace refnode
