// SPDX-License-Identifier: Apache-2.0
// Conditions in words, evaluated against a device that the test makes up.
#include "steps/condition.hpp"

#include "catch.hpp"
#include "steps/tests/fake_session.hpp"

namespace {

using namespace conform;
using namespace conform::steps;

std::string answer(std::string_view text, FakeSession& session) {
  const auto condition = Condition::parse(text);
  if (!condition) return "refused: " + condition.error().text();
  const auto holds = condition->evaluate(session);
  if (!holds) return "error: " + holds.error().what;
  return *holds ? "yes" : "no";
}

FakeSession device() {
  FakeSession out;
  out.entries[{Index(0x1003), SubIndex(0)}] = {2};
  out.entries[{Index(0x1005), SubIndex(0)}] = {0x80, 0, 0, 0x40};
  device::Entry entry;
  entry.mux = {Index(0x1003), SubIndex(0)};
  entry.access = device::Access::rw;
  entry.may_change = true;
  entry.type = canopen::DataType::unsigned8;
  out.known.add(entry);
  out.features = {"sync producer"};
  out.triggers = 2;
  out.names["object"] = Value::of_object({Index(0x1003), SubIndex(0)});
  out.names["count"] = Value::of_number(3);
  out.defaults[{Index(0x1003), SubIndex(0)}] = {0};
  out.low_limits[{Index(0x1003), SubIndex(0)}] = {0};
  return out;
}

TEST_CASE("Conditions about an entry ask the device and its description") {
  auto session = device();
  for (const char* text :
       {"1003h is present",       "object 1003h is present",      "1003h:00 is present",
        "1010h is absent",        "1010h is not present",         "object 1010h is absent",
        "1003h is claimed",       "1010h is not claimed",         "1003h:00 is readable",
        "1003h:00 is writable",   "1005h:00 is not writable",     "1003h:00 is rw",
        "1003h:00 is not const",  "$object may change by itself", "$object may change",
        "1003h:00 has a default", "$object is present",           "$object has a low limit",
        "$object is an integer",  "1005h:00 is not an integer"}) {
    CAPTURE(text);
    CHECK(answer(text, session) == "yes");
  }
  for (const char* text :
       {"1003h:01 is present", "1003h is absent", "1005h:00 is rw", "1005h:00 has a default",
        "$object has a high limit", "$object has limits", "$object is not an integer"}) {
    CAPTURE(text);
    CHECK(answer(text, session) == "no");
  }
}

TEST_CASE("Comparisons are written in words or signs") {
  auto session = device();
  for (const char* text :
       {"value of 1003h:00 is 2", "value of 1003h:00 is not 0", "value of 1003h:00 is at least 2",
        "value of 1003h:00 is at most 2", "$count is above 2", "$count is below 4", "bit 30 of 1005h:00 is 1",
        "$count = 3", "$count >= 3", "$count <= 3", "$count > 2", "$count < 4", "($count & 1) is 1",
        "$count + 1 is 4", "value of 1003h:00 is default of 1003h:00 + 2"}) {
    CAPTURE(text);
    CHECK(answer(text, session) == "yes");
  }
  CHECK(answer("$object is above 2", session) == "error: '1003h:00' and '02h' cannot be compared as numbers");
  CHECK(answer("value of 1001h:00 is 0", session) == "error: 1001h:00 cannot be read");
}

TEST_CASE("Conditions about device and bench are phrases") {
  auto session = device();
  for (const char* text :
       {"device claims sync producer", "error trigger is known", "an error trigger is known",
        "2 error triggers are known", "not device claims emcy", "not interface can send RTR",
        "not factory defaults are active", "not device description is given", "not all objects are tried",
        "not store fault is known", "not power switch is known", "not block upload is offered",
        "not block download is offered", "nobody else is heard on the bus"}) {
    CAPTURE(text);
    CHECK(answer(text, session) == "yes");
  }
  CHECK(answer("3 error triggers are known", session) == "no");
  CHECK(answer("$count error triggers are known", session) == "no");
  session.remote = session.factory = session.described = session.sweeps = true;
  CHECK(answer("interface can send RTR and factory defaults are active", session) == "yes");
  CHECK(answer("device description is given and all objects are tried", session) == "yes");
  session.others = "707h";
  CHECK(answer("nobody else is heard on the bus", session) == "no");
  session.device_profile.store_fault.emplace();
  CHECK(answer("store fault is known", session) == "yes");
  CHECK(answer("description tells lss", session) == "no");
  session.device_profile.device_info.lss = false;
  CHECK(answer("description tells lss", session) == "yes");
  session.power_switch = true;
  CHECK(answer("power switch is known", session) == "yes");
}

TEST_CASE("A condition that is false names the part, the entry and the value that made it so") {
  auto session = device();
  const auto why = [&session](std::string_view text, bool held = false) {
    const auto condition = Condition::parse(text);
    REQUIRE(condition);
    const auto answer = condition->evaluate(session);
    REQUIRE(answer);
    CHECK(*answer == held);
    return condition->why(session, held).text;
  };
  CHECK(why("$object is present and bit 30 of 1005h:00 is 0") ==
        "bit 30 of 1005h:00 is 1 (4000 0080h), not 0");
  CHECK(why("1010h:01 is present and value of 1010h:01 is 1") == "1010h:01 is absent");
  CHECK(why("1010h is present or 1011h is present") == "1010h is absent, and 1011h is absent");
  CHECK(why("value of $object is above 4") == "the value of 1003h:00 is 2, not above 4");
  CHECK(why("$count is at least 4") == "count is 3, not 4 or more");
  CHECK(why("$count + 1 is 9") == "3 + 1 is 4, not 9");
  CHECK(why("$object is const") == "1003h:00 is rw, not const");
  CHECK(why("$object has limits") == "1003h:00 has no limits in the description");
  CHECK(why("$object is not an integer") == "1003h:00 is an integer");
  CHECK(why("not $object is writable") == "1003h:00 is writable");
  CHECK(why("1010h:01 is present and device claims emcy") ==
        "1010h:01 is absent, and the device does not claim 'emcy'");
  CHECK(why("$object is an allowed placeholder") ==
        "1003h:00 is no placeholder by the word of profile or description");
  CHECK(why("$object is a forbidden placeholder") ==
        "1003h:00 is not forbidden as placeholder by profile or description");
  session.others = "707h";
  CHECK(why("nobody else is heard on the bus") == "somebody else is on the bus: 707h");
  // Of 'unless' it is the other way round.
  CHECK(why("1010h is present or $count is 3", true) == "count is 3");
  CHECK(why("1003h is present and device claims sync producer", true) ==
        "1003h is present, and the device claims 'sync producer'");
}

TEST_CASE("A condition that is false for want of something says what the user could give") {
  auto session = device();
  const auto wants = [&session](std::string_view text) {
    const auto condition = Condition::parse(text);
    REQUIRE(condition);
    std::string out;
    for (const auto& want : condition->why_not(session).wants) out += want.kind + ": " + want.text + "; ";
    return out;
  };
  CHECK(wants("device claims mpdo") == "claim: the claim 'mpdo', if the device has it; ");
  CHECK(wants("3 error triggers are known") == "profile: errors: 3 ways to raise an error, in the profile; ");
  CHECK(wants("factory defaults are active and store fault is known") ==
        "profile: factory_defaults: true in the profile, if nothing is stored in the device; "
        "profile: store_fault: in the profile, if the device can simulate one; ");
  CHECK(wants("device claims only node on the bus or device description is given") ==
        "claim: the claim 'only node on the bus', if it is so; description: the EDS of the device (--eds); ");
  CHECK(wants("power switch is known") ==
        "profile: power_cycle: a command that switches the power of the device off and on, in the profile; ");
  // Where the device itself lacks something nothing can be given.
  CHECK(wants("1010h is present and device claims mpdo").empty());
  CHECK(wants("1010h is present").empty());
  CHECK(wants("$object is an allowed placeholder").empty());
  CHECK(wants("not device claims sync producer").empty());
}

TEST_CASE("'and' binds before 'or', and parentheses before both") {
  auto session = device();
  CHECK(answer("1003h is present or 1003h is absent and 1010h is present", session) == "yes");
  CHECK(answer("(1003h is present or 1003h is absent) and 1010h is present", session) == "no");
  CHECK(answer("not (1010h is present or 1011h is present)", session) == "yes");
  CHECK(answer("((1003h is present))", session) == "yes");
  // What is not needed is not asked: 1001h:00 cannot be read.
  CHECK(answer("1003h is present or value of 1001h:00 is 0", session) == "yes");
  CHECK(answer("1003h is absent and value of 1001h:00 is 0", session) == "no");
}

TEST_CASE("A condition that cannot be read says why") {
  auto session = device();
  CHECK(answer("", session) == "refused: a value is missing");
  CHECK(answer("object 1003h is presemt", session) ==
        "refused: unknown property 'presemt' (did you mean 'present'?)");
  CHECK(answer("object 1003h", session) ==
        "refused: 'object' must be followed by an object and 'is present', 'is writable', ...");
  CHECK(answer("device claims hartbeat producer", session) ==
        "refused: unknown feature 'hartbeat producer' (did you mean 'heartbeat producer'?)");
  CHECK(answer("1003h is present 1014h is present", session) ==
        "refused: '1014h' is not expected here (join conditions with 'and' or 'or')");
  CHECK(answer("$count is at 3", session) == "refused: 'at' must be followed by 'least' or 'most'");
  CHECK(answer("interface can fly", session) == "refused: only 'interface can send RTR' is known");
  CHECK(answer("factory defaults", session) == "refused: 'are active' is missing");
  CHECK(answer("error trigger", session) == "refused: 'is known' or 'are known' is missing");
  CHECK(answer("(1003h is present", session) == "refused: ')' is missing");
  CHECK(answer("1003h is present and", session) == "refused: a value is missing");
}

TEST_CASE("A condition tells its names and whether its answer may write") {
  const auto condition = Condition::parse("$object is present and ($count is 3 or 1014h:$sub is writable)");
  REQUIRE(condition);
  CHECK(condition->names() == std::vector<std::string>{"object", "count", "sub"});
  CHECK(condition->may_write());
  CHECK_FALSE(Condition::parse("1014h:00 is readable")->may_write());
  CHECK_FALSE(Condition::parse("block upload is offered")->may_write());
  CHECK(Condition::parse("block download is offered")->may_write());
  FakeSession session;
  CHECK(*Condition().evaluate(session));
}

TEST_CASE("Every form of the reference page can be read") {
  for (const auto form : condition_forms()) {
    if (form.find(" A") != std::string_view::npos || form.front() == 'A')
      continue;  // "A and B, ..." is about joining
    CAPTURE(std::string(form));
    CHECK(Condition::parse(form));
  }
}

TEST_CASE("Nested parentheses are answered in no time, right or wrong") {
  auto session = device();
  const std::string open(300, '('), close(300, ')');
  CHECK(answer(open + "1003h is present" + close, session) == "yes");
  CHECK(answer(open + "1003h is", session).starts_with("refused: "));
}

}  // namespace
