// SPDX-License-Identifier: Apache-2.0
#include "device/waiver.hpp"

#include <filesystem>

#include "base/files.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::device;

namespace {

/// The waivers of a file with this text, or what is wrong with it.
WaiverDocument load(const std::string& text) {
  const auto path = (std::filesystem::temp_directory_path() / "canopen-conform-waivers-test.yaml").string();
  REQUIRE(write_file_atomically(path, text));
  auto document = load_waiver_file(path);
  REQUIRE(document);
  return std::move(*document);
}
std::string mistakes(const std::string& text) {
  const auto document = load(text);
  CHECK(document.diagnostics.has_errors());
  return document.diagnostics.render(false);
}
bool says(const std::string& text, const std::string& part) {
  INFO(text);
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("A waiver says what is accepted, why, by whom and until when") {
  const auto document = load(R"(format: 1
waivers:
  - requirement: OD-1014-06
    case: cia301/cob-id/*
    object: 1014h
    reason: firmware 2.1
    owner: drives team
    ticket: FW-12
    expires: "2027-03-31"
  - {requirement: OD-1003-06, reason: later}
)");
  CHECK(document.diagnostics.empty());
  REQUIRE(document.waivers.size() == 2);
  const auto& one = document.waivers[0];
  CHECK(one.requirement == "OD-1014-06");
  CHECK(one.case_name == "cia301/cob-id/*");
  CHECK(one.object == Index(0x1014));
  CHECK(one.reason == "firmware 2.1");
  CHECK(one.owner == "drives team");
  CHECK(one.ticket == "FW-12");
  CHECK(to_string(*one.expires) == "2027-03-31");
  CHECK(one.place.ends_with("waivers-test.yaml:3"));
  CHECK_FALSE(document.waivers[1].expires);
  CHECK_FALSE(document.waivers[1].object);
}

TEST_CASE("Mistakes in a file of waivers are told with line and column") {
  const auto text = mistakes(R"(format: 1
waivers:
  - {requirement: OD-1014-06}
  - {requirement: A, reason: b, expires: "2027-02-29"}
  - {requirement: A, reason: b}
  - {requirement: A, reason: b, untill: 2027-01-01}
)");
  CHECK(says(text, "waivers-test.yaml:3:5: error: the waiver needs a key 'reason'"));
  CHECK(says(text, "waivers-test.yaml:4:42: error: is no date"));
  CHECK(says(text, "waivers-test.yaml:5:5: error: A is waived twice"));
  CHECK(says(text, "unknown key 'untill'"));
  CHECK(says(mistakes("waivers: []\n"), "needs a key 'format'"));
  CHECK(says(mistakes("format: 1\n"), "needs a key 'waivers'"));
  CHECK_FALSE(load_waiver_file("no-such-file.yaml"));
}

TEST_CASE("Dates are days that there are") {
  CHECK(to_string(*parse_date("2028-02-29")) == "2028-02-29");
  for (const auto* text :
       {"", "2027-2-28", "2027-02-30", "27-02-28", "2027/02/28", "2027-13-01", "2027-02-2x"})
    CHECK_FALSE(parse_date(text));
}
