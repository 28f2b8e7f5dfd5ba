// SPDX-License-Identifier: Apache-2.0
// Which of several rules that are broken is the one to be told.
#include "catch.hpp"

#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "explore/tests/judged.hpp"

using namespace conform;
using namespace conform::explore;
using namespace std::chrono_literals;

namespace {

namespace abort = canopen::abort;
using What = Difference::What;

Multiplexer at(std::uint16_t index, std::uint8_t sub = 0) { return {Index(index), SubIndex(sub)}; }

Answer replied(Bytes bytes) {
  Answer out;
  out.kind = Answer::Kind::replied;
  out.data = std::move(bytes);
  return out;
}

Action sdo(std::uint32_t id, std::initializer_list<std::uint8_t> bytes) {
  return request(can::data_frame(CanId(id), bytes));
}

can::Frame emcy(std::uint16_t code, std::uint8_t error_register = 1) {
  return can::data_frame(CanId(0x085),
                         {static_cast<std::uint8_t>(code & 0xFFU), static_cast<std::uint8_t>(code >> 8U),
                          error_register, 0, 0, 0, 0, 0});
}

}  // namespace

TEST_CASE("an entry that is described and absent breaks the rule that it has to be there") {
  const auto gone = aborted(abort::no_object), no_sub = aborted(abort::no_sub_index);
  CHECK(text_of(judged({upload(at(0x1001))}, gone, confirmed({0}))) == "OD-1001-01 violated");
  CHECK(text_of(judged({download(at(0x1017), {1, 0})}, gone, confirmed())) == "OD-1017-01 violated");
  CHECK(text_of(judged({download(at(0x1017), {1})}, gone, aborted(abort::length_mismatch))) ==
        "OD-1017-01 violated");
  CHECK(text_of(judged({upload(at(0x1018, 1))}, no_sub, confirmed({1, 0, 0, 0}))) == "OD-1018-03 violated");
  CHECK(text_of(judged({upload(at(0x1010, 1))}, no_sub, confirmed({1, 0, 0, 0}))) == "OD-1010-03 violated");
  // An empty history has no first entry.
  CHECK(text_of(judged({upload(at(0x1003, 1))}, no_sub, confirmed({0x30, 0x81, 0, 0}))) ==
        "OD-1003-10 violated");
  // Refused for another reason, it is there.
  CHECK(text_of(judged({upload(at(0x1001))}, aborted(abort::general), confirmed({0}))) ==
        "OD-GEN-17 violated");
}

TEST_CASE("where a refusal is due and nothing comes, it is the refusal that is missing") {
  CHECK(text_of(judged({upload(at(0x1FFF))}, silent(), aborted(abort::no_object))) == "OD-GEN-04 violated");
  CHECK(text_of(judged({download(at(0x1000), {0, 0, 0, 0})}, silent(), aborted(abort::read_only))) ==
        "OD-1000-02 violated");
  CHECK(text_of(judged({upload(at(0x1000))}, silent(), confirmed({0, 0, 0, 0}))) == "SDO-GEN-01 violated");
}

TEST_CASE("a CRC that is right is no error") {
  const auto sent = download(at(0x1017), {1, 0}, Transfer::block);
  CHECK(text_of(judged({sent}, aborted(abort::crc), confirmed())) == "SDO-BDN-02 violated");
  CHECK(text_of(judged({sent}, aborted(abort::general), confirmed())) == "SDO-BDN-01 tolerated");
}

TEST_CASE("what only a transfer of another kind lets pass is a matter of that transfer") {
  const auto refused = aborted(abort::read_only);
  const auto named = [&](Transfer transfer) {
    return text_of(judged({download(at(0x1000), {0, 0, 0, 0}, transfer)}, confirmed(), refused));
  };
  // Nobody has looked whether it was kept.
  CHECK(named(Transfer::block) == "SDO-BDN-23 tolerated");
  CHECK(named(Transfer::segmented) == "OD-ACC-08 tolerated");
  CHECK(named(Transfer::automatic) == "OD-1000-02 violated");
}

TEST_CASE(
    "a value that is out of range may be refused as one of a wrong length, which says nothing of the type") {
  CHECK(text_of(judged({download(at(0x1019), {1})}, aborted(abort::length_mismatch),
                       aborted(abort::invalid_value))) == "OD-1019-04 tolerated");
}

TEST_CASE("bytes that are reserved are told as such on every channel and behind every request") {
  const Conversation write{sdo(0x605, {0x2B, 0x17, 0x10, 0, 1, 0, 0, 0})};
  CHECK(text_of(judged(write, replied({0x60, 0x17, 0x10, 0, 1, 0, 0, 0}),
                       replied({0x60, 0x17, 0x10, 0, 0, 0, 0, 0}))) == "SDO-GEN-05 violated");
  const Conversation read{sdo(0x605, {0x40, 0x08, 0x10, 0, 0, 0, 0, 0})};
  CHECK(text_of(judged(read, replied({0x40, 0x08, 0x10, 0, 9, 0, 0, 0}),
                       replied({0x41, 0x08, 0x10, 0, 9, 0, 0, 0}))) == "SDO-GEN-05 violated");
  // The answer to another request is none with reserved bytes.
  CHECK(text_of(judged(write, replied({0x60, 0x18, 0x10, 0, 1, 0, 0, 0}),
                       replied({0x60, 0x17, 0x10, 0, 0, 0, 0, 0}))) != "SDO-GEN-05 violated");
}

TEST_CASE("values that no device may have are wrong whatever the model has") {
  CHECK(text_of(judged({upload(at(0x1010, 1))}, confirmed({1, 0, 0, 0x80}), confirmed({1, 0, 0, 0}))) ==
        "OD-1010-04 violated");
  CHECK(text_of(judged({upload(at(0x1011, 1))}, confirmed({3, 0, 0, 0}), confirmed({1, 0, 0, 0}))) ==
        "OD-1011-04 violated");
}

TEST_CASE("a constant that is read twice must not have changed") {
  const auto words = words_of_the_standard();
  const Conversation talk{upload(at(0x1008)), upload(at(0x1008))};
  const auto named = [&](Bytes first) {
    Played played;
    played.difference.emplace();
    played.difference->action = 1;
    played.difference->device = confirmed({'a', 'b', 'c', 'd', '1'});
    played.difference->model = confirmed({'a', 'b', 'c', 'd', '0'});
    played.answers = {confirmed(std::move(first)), played.difference->device};
    played.due.assign(2, played.difference->model);
    return text_of(assign({words, talk, played}));
  };
  CHECK(named({'a', 'b', 'c', 'd', '0'}) == "OD-1008-03 violated");
  CHECK(named({'a', 'b', 'c', 'd', '1'}) != "OD-1008-03 violated");
}

TEST_CASE("a write to the number of errors that is refused leaves the history as it was") {
  const auto words = words_of_the_standard();
  const Conversation talk{download(at(0x1003), {1}), upload(at(0x1003))};
  const auto named = [&](const Answer& first) {
    Played played;
    played.difference.emplace();
    played.difference->action = 1;
    played.difference->device = confirmed({0});
    played.difference->model = confirmed({1});
    played.answers = {first, played.difference->device};
    played.due = {aborted(abort::invalid_value), played.difference->model};
    return text_of(assign({words, talk, played}));
  };
  CHECK(named(aborted(abort::invalid_value)) == "OD-1003-07 violated");
  CHECK(named(confirmed()) != "OD-1003-07 violated");
}

TEST_CASE("an error of power-on may be one that the device really has") {
  CHECK(text_of(judged({upload(at(0x1003))}, confirmed({1}), confirmed({0}))) == "OD-1003-04 tolerated");
}

TEST_CASE("an answer where the model has none may be a late one, unless nobody was left without an answer") {
  const auto words = words_of_the_standard();
  const auto named = [&](Conversation talk, const Answer& first) {
    Played played;
    played.difference.emplace();
    played.difference->action = talk.size() - 1;
    played.difference->device = aborted(abort::length_too_low);
    played.difference->model = silent();
    played.answers.assign(talk.size(), first);
    played.due.assign(talk.size(), first);
    return text_of(assign({words, talk, played}));
  };
  CHECK(named({download(at(0x1017), {1}), upload(at(0x1017))}, silent()) == "SDO-GEN-18 tolerated");
  CHECK(named({nmt(NodeId(5), 2), wait(200ms), upload(at(0x1017)), upload(at(0x1017))}, silent()) ==
        "SDO-GEN-15 violated");
  // What nobody has stopped is not in Stopped, unless an error leads there.
  CHECK(named({wait(200ms), upload(at(0x1017))}, {}) == "SDO-GEN-18 tolerated");
  CHECK(named({download(at(0x1029, 1), {2}), wait(200ms), upload(at(0x1017))}, confirmed()) ==
        "SDO-GEN-15 violated");
}

TEST_CASE("an error is told once, and an RPDO that is late by its own code") {
  const Conversation pause{wait(200ms)};
  CHECK(text_of(judged_frames(pause, What::surplus, emcy(0x8130), {}, {emcy(0x8130)})) ==
        "EMCY-SEQ-01 violated");
  // It has gone in between, and is another one.
  CHECK(text_of(judged_frames(pause, What::surplus, emcy(0x8130), {}, {emcy(0x8130), emcy(0, 0)})) ==
        "EC-HBC-02 violated");
  CHECK(text_of(judged_frames(pause, What::other_data, emcy(0x8250), emcy(0x8210))) == "PDO-RX-14 violated");
  CHECK(text_of(judged_frames(pause, What::other_data, emcy(0x8130, 0x41), emcy(0x8130))) ==
        "OD-1001-03 violated");
  CHECK(text_of(judged_frames({download(at(0x1003), {0})}, What::surplus, emcy(0, 0), {})) ==
        "OD-1003-16 violated");
}

TEST_CASE("the loss of SYNC is told where a period was set") {
  const Conversation talk{download(at(0x1006), {0x10, 0x27, 0, 0}), wait(200ms)};
  CHECK(text_of(judged_frames(talk, What::surplus, emcy(0x8100), {})) == "SYNC-CON-10 violated");
  CHECK(text_of(judged_frames(talk, What::missing, {}, emcy(0, 0))) == "SYNC-CON-10 violated");
}

TEST_CASE("a reset behind a reset, and a command for the state that it is in, have rules of their own") {
  const auto boot_up = can::data_frame(CanId(0x705), {std::uint8_t{0}});
  const auto reset = nmt(NodeId(5), 0x82);
  CHECK(text_of(judged_frames({reset, reset}, What::missing, {}, boot_up)) == "NMT-BOOT-09 violated");
  CHECK(text_of(judged_frames({reset, wait(200ms), reset}, What::missing, {}, boot_up)) ==
        "NMT-BOOT-03 violated");
  CHECK(text_of(judged_frames({nmt(NodeId(5), 1), nmt(NodeId(5), 1)}, What::surplus, boot_up, {})) ==
        "NMT-FSA-13 violated");
  CHECK(text_of(judged_frames({nmt(NodeId(5), 1)}, What::surplus, boot_up, {})) == "NMT-BOOT-06 violated");
}

TEST_CASE("a producer of SYNC is late with the first, late with a new period, or deaf to its own") {
  const auto sync = can::data_frame(canopen::sync_can_id, {});
  const auto period = [](std::uint8_t low) { return download(at(0x1006), {low, 0x27, 0, 0}); };
  const Conversation talk{period(0x10), download(at(0x1005), {0x80, 0, 0, 0x40}), wait(200ms)};
  auto changed = talk;
  changed.insert(changed.end() - 1, period(0x20));
  const auto heartbeat = can::data_frame(CanId(0x705), {std::uint8_t{0x7F}});
  CHECK(text_of(judged_frames(talk, What::missing, {}, sync, {heartbeat})) == "SYNC-PRO-02 violated");
  CHECK(text_of(judged_frames(talk, What::missing, {}, sync, {sync})) == "SYNC-PRO-01 violated");
  CHECK(text_of(judged_frames(changed, What::missing, {}, sync, {sync})) == "OD-1006-05 violated");
  // It has a period that nobody has set.
  CHECK(text_of(judged_frames({talk[1], talk[2]}, What::surplus, sync, {})) == "OD-1006-02 violated");
  const Conversation with_tpdo{nmt(NodeId(5), 1), download(at(0x1800, 2), {1}), talk[0], talk[1], talk[2]};
  CHECK(text_of(judged_frames(with_tpdo, What::missing, {}, can::data_frame(CanId(0x185), {0}))) ==
        "SYNC-PRO-08 violated");
}

TEST_CASE("an abort about another object is what is wrong, unless it ends the transfer before") {
  Answer other;
  other.kind = Answer::Kind::violation;
  other.code = abort::length_too_low;
  const auto due = aborted(abort::length_too_low);
  CHECK(text_of(judged({download(at(0x1017), {1})}, other, due)) == "SDO-ERR-04 violated");
  other.code = abort::timed_out;
  CHECK(text_of(judged({download(at(0x1017), {1})}, other, due)) != "SDO-ERR-04 violated");
  // Of a request that begins nothing nobody knows what it is about.
  const auto unknown = [](std::uint8_t low) {
    auto out = aborted(abort::command_specifier);
    out.data = {0x80, low, 0x10, 0, 1, 0, 4, 5};
    return out;
  };
  CHECK(text_of(judged({sdo(0x605, {0xE0, 0, 0x10, 0, 0, 0, 0, 0})}, unknown(1), unknown(0))) ==
        "SDO-ERR-04 tolerated");
}

TEST_CASE("the communication object of a PDO that has a mapping is missed as one of a pair") {
  auto words = words_of_the_standard();
  device::Entry mapping;
  mapping.mux = at(0x1600);
  words.entries.push_back(mapping);
  std::ranges::sort(words.entries, {}, &device::Entry::mux);
  const auto named = [&](std::uint16_t index, AbortCode code) {
    const Conversation talk{upload(at(index, 1))};
    Played played;
    played.difference.emplace();
    played.difference->device = aborted(code);
    played.difference->model = confirmed({5, 2, 0, 0});
    played.answers = {played.difference->device};
    played.due = {played.difference->model};
    return text_of(assign({words, talk, played}));
  };
  CHECK(named(0x1400, abort::no_object) == "OD-1400-03 violated");
  CHECK(named(0x1400, abort::no_sub_index) == "OD-1400-01 violated");
}

TEST_CASE("sub-index FFh may be there, and says what its object is") {
  const auto named = [](std::uint16_t index, Bytes value) {
    return text_of(
        judged({upload(at(index, 0xFF))}, confirmed(std::move(value)), aborted(abort::no_sub_index)));
  };
  CHECK(named(0x1018, {9, 0x23, 0, 0}).empty());
  CHECK(named(0x1018, {9, 0x23}) == "OD-OBJ-01 violated");
  CHECK(named(0x1018, {9, 0x23, 0, 1}) == "OD-OBJ-02 violated");
  CHECK(named(0x1018, {8, 0x23, 0, 0}) == "OD-OBJ-03 violated");
  CHECK(named(0x1018, {9, 0x22, 0, 0}) == "OD-OBJ-04 violated");
  // Of an object of the manufacturer everything can be true that is a code of an object.
  CHECK(named(0x2000, {8, 5, 0, 0}).empty());
}

TEST_CASE("a signature that was refused has neither stored nor restored") {
  const auto words = words_of_the_standard();
  const auto named = [&](std::uint16_t index, const Answer& due) {
    const Conversation talk{download(at(0x1017), {100, 0}), download(at(index, 1), {1, 2, 3, 4}),
                            nmt(NodeId(5), 0x82), upload(at(0x1017))};
    Played played;
    played.difference.emplace();
    played.difference->action = 3;
    played.difference->device = confirmed({100, 0});
    played.difference->model = confirmed({0, 0});
    played.answers.assign(4, confirmed());
    played.due = {confirmed(), due, {}, played.difference->model};
    return text_of(assign({words, talk, played}));
  };
  CHECK(named(0x1010, aborted(abort::general)) == "OD-1010-09 violated");
  CHECK(named(0x1011, aborted(abort::general)) == "OD-1011-09 violated");
  CHECK(named(0x1011, confirmed()) == "OD-1011-12 violated");
}

TEST_CASE("a COB-ID that is refused for what means nothing in it, or for its neighbours, is told so") {
  const auto refused = [](std::uint16_t index, std::uint8_t sub, std::uint32_t value) {
    return text_of(
        judged({download(at(index, sub), to_le(value, 4))}, aborted(abort::invalid_value), confirmed()));
  };
  CHECK(refused(0x1005, 0, 0x8000'0080) == "OD-1005-11 tolerated");
  CHECK(refused(0x1400, 1, 0xC000'0205) == "OD-1400-14 tolerated");
  CHECK(refused(0x1400, 1, 0x181) == "CAN-RID-07 tolerated");
  CHECK(refused(0x1400, 1, 0x6DF) == "CAN-RID-07 tolerated");
  CHECK(refused(0x1400, 1, 0x300) == "OD-1400-11 tolerated");
  CHECK(refused(0x1016, 1, 0x10'0000) == "OD-1016-07 tolerated");
}

TEST_CASE("what is longer than four bytes is never sent in one") {
  CHECK(text_of(judged({upload(at(0x1008))}, confirmed({'a', 'b'}), confirmed({'a', 'b', 'c', 'd', 'e'}))) !=
        "SDO-UPL-05 violated");  // a text may be short
  auto words = words_of_the_standard();
  device::Entry number;
  number.mux = at(0x2000);
  number.type = canopen::DataType::unsigned64;
  words.entries.push_back(number);
  const Conversation talk{upload(at(0x2000))};
  Played played;
  played.difference.emplace();
  played.difference->device = confirmed({1, 2, 3, 4});
  played.difference->model = confirmed({1, 2, 3, 4, 5, 6, 7, 8});
  CHECK(text_of(assign({words, talk, played})) == "SDO-UPL-05 violated");
}

TEST_CASE("a server that gives up a transfer before its time is told so") {
  const Conversation talk{sdo(0x605, {0x40, 0x08, 0x10, 0, 0, 0, 0, 0}), wait(200ms),
                          sdo(0x605, {0x60, 0, 0, 0, 0, 0, 0, 0})};
  CHECK(text_of(judged(talk, aborted(abort::timed_out), replied({1, 'a', 'b', 'c', 'd', 'e', 'f', 'g'}))) ==
        "SDO-SUP-17 tolerated");
}

TEST_CASE(
    "what depends on the counter of SYNC, on an entry of 1016h, or on 16 bits of a time has its own rule") {
  const auto tpdo = can::data_frame(CanId(0x185), {0});
  const auto sync = [](std::uint8_t counter) {
    return frame(can::data_frame(canopen::sync_can_id, {counter}));
  };
  const auto counted = [&](std::uint8_t counter) {
    return text_of(judged_frames({nmt(NodeId(5), 1), wait(200ms), download(at(0x1019), {10}),
                                  download(at(0x1800, 2), {1}), sync(counter)},
                                 What::missing, {}, tpdo));
  };
  CHECK(counted(11) == "SYNC-CON-06 violated");
  CHECK(counted(10) == "PDO-TX-05 violated");
  const auto lost = [&](std::uint8_t sub) {
    return text_of(judged_frames({download(at(0x1016, sub), {100, 0, 0x10, 0}), wait(200ms)}, What::missing,
                                 {}, emcy(0x8130)));
  };
  CHECK(lost(1) == "EC-HBC-03 violated");
  CHECK(lost(2) == "EC-HBC-13 violated");
  const auto heartbeat = can::data_frame(CanId(0x705), {std::uint8_t{0x7F}});
  CHECK(text_of(judged_frames({download(at(0x1017), {0, 0x80}), wait(200ms)}, What::surplus, heartbeat,
                              {})) == "EC-HBP-11 violated");
}

TEST_CASE("a command that came while the device was starting may have been missed") {
  const auto words = words_of_the_standard();
  const Conversation talk{nmt(NodeId(5), 0x82), nmt(NodeId(5), 2), wait(200ms), upload(at(0x1000))};
  const auto named = [&](int boot_up) {
    Played played;
    played.difference.emplace();
    played.difference->action = 3;
    played.difference->device = confirmed({0, 0, 0, 0});
    played.difference->model = silent();
    played.answers.assign(4, {});
    played.due.assign(4, {});
    played.begins = {BusTime(100ms), BusTime(120ms), BusTime(121ms), BusTime(321ms)};
    can::CapturedFrame boots;
    boots.frame = can::data_frame(CanId(0x705), {std::uint8_t{0}});
    boots.time = BusTime(std::chrono::milliseconds(boot_up));
    played.trace = {boots};
    return text_of(assign({words, talk, played}));
  };
  CHECK(named(110) == "SDO-GEN-15 violated");
  CHECK(named(190) == "SDO-GEN-15 tolerated");
}

TEST_CASE("an answer in Stopped to what was asked before it is a late one") {
  const auto words = words_of_the_standard();
  const Conversation talk{upload(at(0x1006)), nmt(NodeId(5), 2), wait(200ms), upload(at(0x1000))};
  Played played;
  played.difference.emplace();
  played.difference->action = 3;
  played.difference->device = confirmed();
  played.difference->model = silent();
  played.answers = {silent(), {}, {}, confirmed()};
  played.due = {confirmed(), {}, {}, silent()};
  CHECK(text_of(assign({words, talk, played})) == "SDO-GEN-18 tolerated");
  // Behind a single request as well.
  auto single = talk;
  single.back() = request(can::remote_frame(CanId(0x605), 8));
  CHECK(text_of(assign({words, single, played})) == "SDO-GEN-18 tolerated");
}

TEST_CASE("a channel that is switched off takes no NMT command for a request") {
  const Conversation talk{nmt(NodeId(5), 2), wait(200ms), download(at(0x1202, 1), {0, 0, 0, 0x80})};
  CHECK(text_of(judged(talk, confirmed(), silent())) == "SDO-GEN-15 violated");
}

TEST_CASE("on a bus that the device fills everything is late, and nothing but strained") {
  const Conversation talk{download(at(0x1006), {47, 0, 0, 0}), upload(at(0x1000))};
  CHECK(text_of(judged(talk, silent(), confirmed({0, 0, 0, 0}))).ends_with(" tolerated"));
  const Conversation slower{download(at(0x1006), {0x10, 0x27, 0, 0}), upload(at(0x1000))};
  CHECK(text_of(judged(slower, silent(), confirmed({0, 0, 0, 0}))).ends_with(" violated"));
}

TEST_CASE("a guard request of the device is a command, another remote frame asks for a PDO") {
  const auto nothing = can::Frame{};
  const Conversation talk{wait(20ms)};
  CHECK(text_of(judged_frames(talk, What::surplus, can::remote_frame(CanId(0x77E), 1), nothing)) ==
        "NMT-SVC-05 violated");
  CHECK(text_of(judged_frames(talk, What::surplus, can::remote_frame(CanId(0x181), 8), nothing)) ==
        "CAN-TRF-04 tolerated");
}

TEST_CASE("a bit of a COB-ID that the device cannot serve may be refused") {
  const auto refused = aborted(abort::invalid_value);
  const auto named = [&](std::uint16_t index, std::uint8_t sub, std::uint32_t value, const Answer& answer) {
    Bytes data(4);
    store_le(data, value);
    return text_of(judged({download(at(index, sub), data)}, answer, confirmed()));
  };
  // To produce, and remote frames: no word about the CAN-ID, which stays as it is.
  CHECK(named(0x1005, 0, 0x4000'0080, refused) == "OD-1005-03 allowed");
  CHECK(named(0x1005, 0, 0x4000'0080, aborted(abort::unsupported_access)) == "OD-1005-03 tolerated");
  CHECK(named(0x1012, 0, 0x4000'0100, refused) == "OD-1012-03 allowed");
  CHECK(named(0x1400, 1, 0x4000'0205, refused) == "OD-1400-14 tolerated");
  // Another CAN-ID.
  CHECK(named(0x1005, 0, 0x0000'0081, refused) == "OD-1005-06 tolerated");
}

TEST_CASE("EMCY 8220h behind an RPDO that is too long is nothing to speak of") {
  const auto rpdo = frame(can::data_frame(CanId(0x205), {1, 2, 3, 4, 5, 6, 7, 8}));
  CHECK(text_of(judged_frames({nmt(NodeId(5), 1), rpdo}, What::surplus, emcy(0x8220), {})) ==
        "PDO-RX-07 allowed");
  CHECK(text_of(judged_frames({nmt(NodeId(5), 1)}, What::surplus, emcy(0x8220), {})) ==
        "PDO-RX-07 tolerated");
}
