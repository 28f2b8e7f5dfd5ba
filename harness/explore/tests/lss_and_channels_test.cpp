// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include "catch.hpp"

#include "canopen/lss.hpp"
#include "explore/tests/device.hpp"

using namespace conform;
using namespace conform::explore;

namespace {

using canopen::LssCommand;
using namespace std::chrono_literals;

Action lss(LssCommand command, std::uint8_t first = 0, std::uint8_t second = 0) {
  return frame(canopen::encode_lss(command, first, second));
}
Action number(LssCommand command, std::uint32_t value) {
  return frame(canopen::encode_lss_number(command, value));
}
Action on_channel(std::initializer_list<std::uint8_t> bytes) {
  return frame(can::data_frame(CanId(0x6A0), bytes));
}
Action cob_id(std::uint8_t sub, std::uint32_t value) {
  return download({Index(0x1201), SubIndex(sub)}, to_le(value, 4));
}

Vocabulary words_of_the_node() {
  auto words = words_of_the_standard();
  words.lss = true;
  const std::uint32_t identity[] = {0x5AFE, 0x0301, 0x0001'0000, 1};
  for (auto& entry : words.entries) {
    if (entry.mux.index == Index(0x1018) && entry.mux.sub.value() > 0)
      entry.default_value = to_le(identity[entry.mux.sub.value() - 1U], 4);
  }
  return words;
}

/// What a device with this defect is told to violate in this conversation.
std::string told(const std::string& defect, const Conversation& conversation) {
  const auto words = words_of_the_node();
  const auto played = play(bench_of({defect}), conversation, true);
  REQUIRE(played);
  if (!played->difference) return "no difference";
  const auto assigned = assign({words, conversation, *played});
  return assigned ? assigned->requirement : "no rule";
}

bool is_lss(const Action& action) { return action.kind == Action::Kind::frame && action.frame.id == 0x7E5; }

}  // namespace

TEST_CASE("LSS is talked about with a device that has it, and with no other") {
  auto words = words_of_the_node();
  for (const bool has : {true, false}) {
    words.lss = has;
    bool talked = false;
    for (std::uint64_t seed = 1; seed <= 100; ++seed)
      talked = talked || std::ranges::any_of(draw(words, seed, 80), is_lss);
    CHECK(talked == has);
  }
}

TEST_CASE("what an LSS slave answers wrongly is told by the rule of the service and the state") {
  const auto on = lss(LssCommand::switch_global, 1);
  const auto node = lss(LssCommand::inquire_node_id);
  const Conversation selection = {
      number(LssCommand::select_vendor, 0x5AFE), number(LssCommand::select_product, 0x0301),
      number(LssCommand::select_revision, 0x0001'0000), number(LssCommand::select_serial, 2)};
  auto swapped = selection;
  std::swap(swapped[0], swapped[1]);
  swapped[3] = number(LssCommand::select_serial, 1);
  struct Row {
    const char* defect;
    Conversation talk;
    const char* rule;
  };
  const Row rows[] = {
      {"lss-inquire-vendor-wrong", {on, lss(LssCommand::inquire_vendor)}, "LSS-INQ-01"},
      {"lss-global-switch-ignored", {on, node}, "LSS-SG-01"},
      {"lss-does-not-leave-configuration", {on, lss(LssCommand::switch_global, 0), node}, "LSS-SG-02"},
      {"lss-global-mode-unchecked", {lss(LssCommand::switch_global, 2), node}, "LSS-SG-03"},
      {"lss-answers-in-waiting", {node}, "LSS-INQ-06"},
      {"lss-selective-ignores-serial", selection, "LSS-SS-02"},
      {"lss-selective-order-unchecked", swapped, "LSS-SS-04"},
      {"lss-node-id-128-accepted", {on, lss(LssCommand::configure_node_id, 128)}, "LSS-CN-02"},
      {"lss-bit-rate-index-5-accepted", {on, lss(LssCommand::configure_bit_timing, 0, 5)}, "LSS-BT-02"},
      {"lss-configured-slave-answers-4c", {lss(LssCommand::identify_non_configured)}, "LSS-ID-03"},
      {"lss-node-id-never-active",
       {on, lss(LssCommand::configure_node_id, 7), nmt(NodeId(5), 0x82), wait(100ms)},
       "LSS-CN-04"},
      {"lss-unconfigured-silent",
       {on, lss(LssCommand::configure_node_id, 0xFF), nmt(NodeId(5), 0x82), wait(100ms),
        lss(LssCommand::identify_non_configured)},
       "LSS-ID-04"},
      {"lss-dlc-wrong", {on, node}, "LSS-GEN-01"},
  };
  for (const auto& row : rows) {
    INFO(row.defect);
    CHECK(told(row.defect, row.talk) == row.rule);
    CHECK(told("1000-writable", row.talk) == "no difference");
  }
}

TEST_CASE("what additional SDO channels do wrong is told by the rules of channels") {
  const auto read = on_channel({0x40, 0x00, 0x10, 0, 0, 0, 0, 0});
  const Conversation opened = {cob_id(1, 0x6A0), cob_id(2, 0x6B0), read};
  CHECK(told("additional-sdo-silent", opened) == "SDO-MUL-01");
  // The monitors see an answer that nobody has asked for there.
  CHECK(told("additional-sdo-answers-on-default-channel", opened) == "SDO-GEN-04");
  CHECK(told("1201-valid-with-one-cob-id", {cob_id(2, 0x8000'06B0), cob_id(1, 0x6A0), read}) == "OD-1201-04");
  const Conversation mixed = {cob_id(1, 0x6A0), cob_id(2, 0x6B0),
                              on_channel({0x40, 0x08, 0x10, 0, 0, 0, 0, 0}),
                              upload({Index(0x1008), SubIndex(0)}), on_channel({0x60, 0, 0, 0, 0, 0, 0, 0})};
  CHECK(told("additional-sdo-shares-transfer", mixed) == "SDO-MUL-04");
}

TEST_CASE("a model that says what the device never says, only later, does not agree with it") {
  const Conversation ranges = {
      number(LssCommand::identify_vendor, 0x5AFE),  number(LssCommand::identify_product, 0x0301),
      number(LssCommand::identify_revision_low, 0), number(LssCommand::identify_revision_high, 0x0001'0000),
      number(LssCommand::identify_serial_low, 0),   number(LssCommand::identify_serial_high, 1)};
  auto bench = bench_of({"lss-identify-range-excludes-ends"});
  const auto kept = play(bench, ranges, true);
  REQUIRE(kept);
  REQUIRE(kept->difference);
  bench.model = reference_node({}, {"lss-slow"});
  const auto slow = play(bench, ranges, *kept->recording);
  REQUIRE(slow);
  CHECK(slow->difference);
}
