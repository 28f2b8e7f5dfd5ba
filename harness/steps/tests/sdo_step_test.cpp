// SPDX-License-Identifier: Apache-2.0
// Transfers and faults as scenarios write them: what is read, and what is refused at which place.
#include "steps/sdo_step.hpp"

#include "catch.hpp"
#include "steps/tests/fake_session.hpp"
#include "yaml/loader.hpp"

namespace {

using namespace conform;
using namespace conform::steps;

struct Parsed {
  std::optional<SdoStep> step;
  std::string said;
};

Parsed parse(const std::string& text, bool upload, NameCheck names = {}) {
  const auto source = yaml::make_source("x.yaml", text);
  yaml::Diagnostics diagnostics(source);
  const auto root = yaml::load(*source, diagnostics);
  REQUIRE(root);
  ParseContext context{diagnostics, {}, {}, std::move(names), {}, {}};
  Parsed out;
  const yaml::Field field(&*root, diagnostics, "'transfer'");
  out.step = upload ? SdoStep::parse_upload(field, context) : SdoStep::parse_download(field, context);
  for (const auto& each : diagnostics.sorted())
    out.said += each.message + (each.hint.empty() ? "" : "; " + each.hint) + "\n";
  return out;
}

SdoJob job(const std::string& text, bool upload, FakeSession& session, NameCheck names = {}) {
  auto parsed = parse(text, upload, std::move(names));
  INFO(parsed.said);
  REQUIRE(parsed.said.empty());
  REQUIRE(parsed.step);
  auto out = parsed.step->job(session);
  INFO((out ? std::string() : out.error().text()));
  REQUIRE(out);
  return *out;
}

}  // namespace

TEST_CASE("A block upload is read with all its keys") {
  FakeSession session;
  session.names.insert_or_assign("size", Value::of_number(20));
  const auto out =
      job("{object: 1008h:00, transfer: block, blksize: $size, pst: 4, crc: false, timeout: 2 s,"
          " channel: {request: 640h + N, response: 5C5h}, fault: [lose segment 2, no end], wait: 50 ms}",
          true, session, {"size"});
  CHECK(out.request.block);
  CHECK(out.request.blksize == 20);
  CHECK(out.request.pst == 4);
  CHECK_FALSE(out.request.crc);
  CHECK(out.request.faults.size() == 2);
  CHECK(out.channel == SdoChannelIds{CanId(0x645), CanId(0x5C5)});
  CHECK(out.timeout == std::chrono::seconds(2));
  CHECK(out.wait == std::chrono::milliseconds(50));
}

TEST_CASE("A pattern has the length that was asked for and is the same every time") {
  FakeSession session;
  const auto out =
      job("{object: 2000h:0F, pattern: 300 bytes, transfer: block without size}", false, session);
  CHECK(out.request.data.size() == 300);
  CHECK(out.request.data == pattern_bytes(300, false));
  CHECK_FALSE(out.request.size_told);
  CHECK(job("{object: 2000h:0F, pattern: 1 byte}", false, session).request.data.size() == 1);
  // The beginning of a longer one, so that what a server kept can be told from what it lost.
  CHECK(std::ranges::equal(pattern_bytes(10, false), ByteView(pattern_bytes(300, false)).first(10)));
  for (const auto byte : pattern_bytes(500, true)) CHECK((byte >= 0x20 && byte <= 0x7E));
}

TEST_CASE("Numbers of a fault, and whole faults, may come from names") {
  FakeSession session;
  session.names.insert_or_assign("k", Value::of_number(3));
  session.names.insert_or_assign("mistake", Value::of_word("wrong crc"));
  const auto out =
      job("{object: 2000h:0F, pattern: 90 bytes, transfer: block, fault: [swap segments 2 and $k, $mistake]}",
          false, session, {"k", "mistake"});
  REQUIRE(out.request.faults.size() == 2);
  CHECK(out.request.faults[0].other == 3);
  CHECK(out.request.faults[1].kind == canopen::SdoFault::Kind::wrong_crc);
}

TEST_CASE("Mistakes are told where they are, with what would be right") {
  CHECK(parse("{object: 1008h:00, transfer: segmented}", true).said.find("segmented") != std::string::npos);
  CHECK(parse("{object: 1008h:00, blksize: 4}", true).said ==
        "'blksize' belongs to a block transfer; add transfer: block\n");
  CHECK(parse("{object: 1008h:00, fault: loose segment 2}", true)
            .said.starts_with("unknown fault 'loose segment 2'; known: "));
  CHECK(parse("{object: 1008h:00, fault: lose segment two}", true).said ==
        "unknown fault 'lose segment two'; known: lose segment K\n");
  CHECK(parse("{object: 1008h:00, fault: lose segment $k}", true).said.starts_with("unknown name $k"));
  CHECK(parse("{object: 1008h:00, wait: 5 s}", true)
            .said.starts_with("'wait' is the time to listen after a fault"));
  CHECK(parse("{object: 2000h:0F, pattern: 100}", false).said ==
        "'100' is no length; write pattern: 100 bytes\n");
  CHECK(parse("{object: 2000h:0F}", false).said.find("pattern") != std::string::npos);
  CHECK(parse("{object: 2000h:0F, value: 1, bytes: \"01\"}", false).said.size() > 0);
}

TEST_CASE("Values beyond what a frame holds are refused when the scenario runs") {
  FakeSession session;
  const auto refused = [&session](const std::string& text) {
    auto parsed = parse(text, true);
    REQUIRE(parsed.step);
    const auto out = parsed.step->job(session);
    REQUIRE_FALSE(out);
    return out.error().what;
  };
  CHECK(refused("{object: 1008h:00, transfer: block, blksize: 256}") == "blksize 256 is above 255");
  CHECK(refused("{object: 1008h:00, channel: {request: 800h, response: 581h}}") ==
        "the CAN-ID 2048 is above 2047");
}

TEST_CASE("What is measured is in the words of a report, and long data are cut") {
  FakeSession session;
  SdoAnswer answer;
  answer.kind = SdoAnswer::Kind::confirmed;
  answer.data = Bytes(1000);
  answer.counts.block = true;
  answer.counts.segments = 143;
  answer.counts.sub_blocks = 2;
  answer.counts.retransmitted = 5;
  const auto actual = to_actual(answer, session, {Index(0x2000), SubIndex(15)}, true);
  CHECK(actual.words().ends_with("00 ... (1000 bytes) (143 segments in 2 sub-blocks, 5 retransmitted)"));
  CHECK(actual.measured.at("retransmitted") == 5);
  CHECK_FALSE(actual.measured.contains("crc_ok"));
  CHECK_FALSE(actual.measured.contains("surplus"));
}
