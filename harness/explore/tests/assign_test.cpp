// SPDX-License-Identifier: Apache-2.0
#include "explore/assign.hpp"

#include "catch.hpp"

#include "canopen/abort_code.hpp"
#include "explore/tests/device.hpp"

using namespace conform;
using namespace conform::explore;

namespace {

Answer confirmed(Bytes data = {}) {
  Answer out;
  out.kind = Answer::Kind::confirmed;
  out.data = std::move(data);
  return out;
}
Answer aborted(AbortCode code) {
  Answer out;
  out.kind = Answer::Kind::aborted;
  out.code = code;
  return out;
}
Answer silent() {
  Answer out;
  out.kind = Answer::Kind::silence;
  return out;
}

/// The last action of `talk` was answered by the device and by the model like this.
std::optional<Assigned> judged(const Conversation& talk, const Answer& device, const Answer& model) {
  const auto words = words_of_the_standard();
  Played played;
  played.difference.emplace();
  played.difference->action = talk.size() - 1;
  played.difference->device = device;
  played.difference->model = model;
  played.answers.assign(talk.size(), confirmed());
  played.due.assign(talk.size(), confirmed());
  return assign({words, talk, played});
}

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
