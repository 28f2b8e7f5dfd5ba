// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include "catch.hpp"

#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "explore/tests/judged.hpp"

using namespace conform;
using namespace conform::explore;

namespace {

const Multiplexer device_type{Index(0x1000), SubIndex(0)};

}  // namespace

TEST_CASE("a read-only entry that takes a write violates its rule, another refusal only strains it") {
  namespace abort = canopen::abort;
  const Conversation talk = {download(device_type, {0, 0, 0, 0})};
  const auto taken = judged(talk, confirmed(), aborted(abort::read_only));
  REQUIRE(taken);
  CHECK(taken->requirement == "OD-1000-02");
  CHECK(taken->grade == Grade::violated);
  const auto reworded = judged(talk, aborted(abort::general), aborted(abort::read_only));
  REQUIRE(reworded);
  CHECK(reworded->grade == Grade::tolerated);
}

TEST_CASE("an answer in Stopped violates the rule of Stopped, whatever it is about") {
  const auto found = judged({nmt(NodeId(5), 2), upload(device_type)}, confirmed({1, 0, 0, 0}), silent());
  REQUIRE(found);
  CHECK(found->requirement == "SDO-GEN-15");
}

TEST_CASE("an object that the description does not tell of is no violation by itself") {
  const auto found =
      judged({upload({Index(0x1F90), SubIndex(0)})}, confirmed({0}), aborted(canopen::abort::no_object));
  REQUIRE(found);
  CHECK(found->grade == Grade::tolerated);
}

TEST_CASE("what no rule knows has no name") {
  CHECK(
      !judged({download({Index(0x1F90), SubIndex(0)}, {1})}, aborted(canopen::abort::general), confirmed()));
}

TEST_CASE("the phrase of a fault tells its rule") {
  auto action = upload({Index(0x1008), SubIndex(0)});
  action.fault = "wrong toggle in segment 1";
  CHECK(rule_of_fault(action) == "SDO-SUP-05");
  action.fault = "wrong toggle in segment 2";
  CHECK(rule_of_fault(action) == "SDO-SUP-06");
  action.transfer = Transfer::block;
  action.fault = "blksize 0 from sub-block 2";
  CHECK(rule_of_fault(action) == "SDO-BUP-11");
  action.fault = "";
  CHECK(rule_of_fault(action).empty());
}

TEST_CASE("a value of power-on that nobody has changed is no matter of a reset") {
  const Multiplexer heartbeat_time{Index(0x1017), SubIndex(0)};
  const auto device = confirmed({0xF4, 1}), model = confirmed({0, 0});
  const auto named = [&](Conversation talk) {
    talk.push_back(upload(heartbeat_time));
    return text_of(judged(talk, device, model));
  };
  const auto at_once = named({});
  CHECK(named({{.kind = Action::Kind::power}, wait(std::chrono::milliseconds(900))}) == at_once);
  CHECK(named({nmt(NodeId(5), 0x82), wait(std::chrono::milliseconds(300))}) == at_once);
  CHECK(named({download(heartbeat_time, {0xF4, 1}), nmt(NodeId(5), 0x82)}) == "NMT-FSA-24 violated");
}

TEST_CASE("what a device does wrong with the node-ID from LSS it does as wrong with another one") {
  const auto lss = [](std::initializer_list<std::uint8_t> bytes) {
    return frame(can::data_frame(canopen::lss_request_can_id, bytes));
  };
  const Conversation talk{lss({4, 1, 0, 0, 0, 0, 0, 0}), lss({0x11, 0x20, 0, 0, 0, 0, 0, 0}),
                          nmt(NodeId(5), 0x82), wait(std::chrono::milliseconds(200)),
                          frame(can::data_frame(CanId(0x620), {0x40, 0, 0x14, 1, 0, 0, 0, 0}))};
  using What = Difference::What;
  const auto heartbeat = can::data_frame(CanId(0x720), {std::uint8_t{0x7F}}),
             boot_up = can::data_frame(CanId(0x720), {std::uint8_t{0}});
  CHECK(text_of(judged_frames(talk, What::surplus, heartbeat, {})).empty());
  CHECK(text_of(judged_frames(talk, What::missing, {}, heartbeat)) == "LSS-CN-04 tolerated");
  CHECK(text_of(judged_frames(talk, What::missing, {}, boot_up)) == "LSS-CN-04 violated");
  // A COB-ID that stays with the old node-ID does not follow; one that is wrong anyway does not either.
  const auto cob_id = [](std::uint8_t low) {
    return can::data_frame(CanId(0x5A0), {0x43, 0, 0x14, 1, low, 2, 0, 0});
  };
  CHECK(text_of(judged_frames(talk, What::other_data, cob_id(0x05), cob_id(0x20))) == "LSS-CN-04 violated");
  CHECK(text_of(judged_frames(talk, What::other_data, cob_id(0), cob_id(0x20))).empty());
  // With the old node-ID it says nothing any more.
  CHECK(text_of(judged_frames(talk, What::surplus,
                              can::data_frame(CanId(0x585), {0x43, 0, 0x14, 1, 0, 2, 0, 0}), {})) ==
        "LSS-CN-04 violated");
}

TEST_CASE("an EMCY that another node has sent is no EMCY of the device") {
  using What = Difference::What;
  const auto of_other = can::data_frame(CanId(0x083), {0, 0x10, 1, 0, 0, 0xAC, 0, 0});
  auto of_device = of_other;
  of_device.id = 0x085;
  CHECK(text_of(judged_frames({frame(of_other)}, What::surplus, of_device, {})) == "EMCY-CON-02 violated");
  CHECK(text_of(judged_frames({frame(of_other)}, What::other_data, of_device,
                              can::data_frame(CanId(0x085), {0, 0, 0, 0, 2, 0, 0, 0}))) ==
        "EMCY-CON-02 violated");
  CHECK(text_of(judged_frames({wait(std::chrono::milliseconds(1))}, What::surplus, of_device, {})) ==
        "EMCY-SEQ-03 violated");
}

TEST_CASE("an error code with its bytes in the other order is a matter of form, whatever it says") {
  using What = Difference::What;
  const auto code = [](std::uint8_t low, std::uint8_t high) {
    return can::data_frame(CanId(0x085), {low, high, 0x11, 0, 0, 0, 0, 0});
  };
  const Conversation talk{wait(std::chrono::milliseconds(200))};
  CHECK(text_of(judged_frames(talk, What::other_data, code(0x81, 0x30), code(0x30, 0x81))) ==
        "EMCY-FMT-01 violated");
  CHECK(text_of(judged_frames(talk, What::other_data, code(0, 0x10), code(0x30, 0x81))) ==
        "EC-HBC-03 violated");
}

TEST_CASE("to begin a block upload is no sub-command without one") {
  const auto ask = [](std::uint8_t command, std::uint8_t blksize) {
    return Conversation{request(can::data_frame(CanId(0x605), {command, 0, 0x10, 0, blksize, 0, 0, 0}))};
  };
  Answer served;
  served.kind = Answer::Kind::replied;
  served.data = {0xC6, 0, 0x10, 0, 4, 0, 0, 0};
  const auto refused = aborted(canopen::abort::general);
  CHECK(text_of(judged(ask(0xA4, 0), served, refused)) == "SDO-BUP-09 violated");
  CHECK(text_of(judged(ask(0xA0, 128), served, refused)) == "SDO-BUP-10 violated");
  CHECK(text_of(judged(ask(0xA4, 5), served, refused)) == "SDO-BUP-01 tolerated");
  CHECK(text_of(judged(ask(0xA3, 0), served, refused)) == "SDO-BUP-21 violated");
}

TEST_CASE("a start behind what was asked is no second boot-up message of power-on") {
  const auto words = words_of_the_standard();
  const Conversation talk{request(can::data_frame(CanId(0x605), {0x40, 0, 0x10, 0, 0}))};
  const auto named = [&](int at) {
    Played played;
    played.difference.emplace();
    played.difference->what = Difference::What::surplus;
    played.difference->came = can::data_frame(CanId(0x705), {std::uint8_t{0}});
    played.difference->time = BusTime(std::chrono::milliseconds(at));
    played.begins = {BusTime(std::chrono::milliseconds(70))};
    return text_of(assign({words, talk, played}));
  };
  CHECK(named(90) == "NMT-BOOT-10 violated");
  CHECK(named(40) == "NMT-BOOT-01 violated");
}

TEST_CASE("only who was asked by its own CAN-ID was asked by a remote frame") {
  using What = Difference::What;
  const auto tpdo = can::data_frame(CanId(0x185), {0, 0, 0, 0});
  const auto named = [&](std::uint32_t id) {
    return text_of(judged_frames(
        {nmt(NodeId(5), 1), wait(std::chrono::milliseconds(200)), frame(can::remote_frame(CanId(id), 8))},
        What::surplus, tpdo, {}));
  };
  CHECK(named(0x185) == "OD-1800-14 violated");
  CHECK(named(0x710) == "PDO-TX-08 tolerated");
}

TEST_CASE("an RPDO of another length is blamed for its length where it is dropped or taken by that") {
  auto words = words_of_the_standard();
  const auto put = [&](std::uint8_t sub, Bytes value) {
    device::Entry entry;
    entry.mux = {Index(0x1600), SubIndex(sub)};
    entry.default_value = std::move(value);
    words.entries.push_back(entry);
  };
  put(0, {1});
  put(1, {0x10, 1, 0, 0x62});
  std::ranges::sort(words.entries, {}, &device::Entry::mux);
  const auto named = [&](std::initializer_list<std::uint8_t> rpdo, std::uint8_t came, std::uint8_t due) {
    const Conversation talk{nmt(NodeId(5), 1), wait(std::chrono::milliseconds(200)),
                            frame(can::data_frame(CanId(0x205), rpdo))};
    Played played;
    played.difference.emplace();
    played.difference->what = Difference::What::other_data;
    played.difference->action = 2;
    played.difference->came = can::data_frame(CanId(0x185), {came});
    played.difference->due = can::data_frame(CanId(0x185), {due});
    return text_of(assign({words, talk, played}));
  };
  CHECK(named({7, 0, 1}, 0, 7) == "PDO-RX-07 violated");
  CHECK(named({7, 0, 1}, 9, 7) == "PDO-RX-01 violated");
  CHECK(named({7}, 7, 0) == "PDO-RX-06 violated");
  CHECK(named({7, 0}, 0, 7) == "PDO-RX-01 violated");
}

TEST_CASE("a value of the wrong length is wrong, also where the model has none") {
  const auto refused = aborted(canopen::abort::no_data);
  CHECK(text_of(judged({upload(device_type)}, confirmed({0}), refused)) == "OD-LEN-04 violated");
  CHECK(text_of(judged({upload(device_type)}, confirmed({0, 0, 0, 0}), refused)).empty());
}

TEST_CASE("behind the loss of another node it is the error behaviour that is wrong, and no service") {
  using namespace std::chrono_literals;
  const auto lose = [](Conversation last) {
    Conversation out{nmt(NodeId(5), 1), wait(200ms), download({Index(0x1016), SubIndex(1)}, {20, 0, 0x10, 0}),
                     frame(can::data_frame(CanId(0x710), {std::uint8_t{5}})), wait(200ms)};
    out.insert(out.end(), last.begin(), last.end());
    return out;
  };
  const auto beat = [](std::uint8_t state) { return can::data_frame(CanId(0x705), {state}); };
  using What = Difference::What;
  CHECK(text_of(judged_frames(lose({wait(1ms)}), What::other_data, beat(4), beat(0x7F))) ==
        "EC-EB-01 violated");
  CHECK(text_of(judged_frames(lose({download({Index(0x1029), SubIndex(1)}, {2})}), What::other_data, beat(5),
                              beat(4))) == "EC-EB-03 violated");
  CHECK(text_of(judged(lose({upload(device_type)}), silent(), confirmed({0}))) == "EC-EB-01 tolerated");
  const auto sync = can::data_frame(CanId(0x080), {});
  CHECK(text_of(judged_frames(lose({wait(1ms)}), What::missing, {}, sync)) == "EC-EB-01 tolerated");
  // A command behind it decides, and where nobody is monitored nobody is lost.
  CHECK(text_of(judged(lose({nmt(NodeId(5), 1), upload(device_type)}), silent(), confirmed({0}))) ==
        "SDO-GEN-14 violated");
  CHECK(text_of(judged({nmt(NodeId(5), 1), wait(200ms), upload(device_type)}, silent(), confirmed({0}))) ==
        "SDO-GEN-14 violated");
}
