// SPDX-License-Identifier: Apache-2.0
// Who asked, what is named, how a response looks; and what the client may do without a finding.
#include "trace.hpp"

using namespace conform;
using namespace conform::monitor::testing;
using result::Verdict;

TEST_CASE("Plain exchanges are right, and what was never seen is not applicable") {
  const auto cases =
      judged(trace(after_exchanges({"> 2B 17 10 00 E8 03 00 00", "< 60 17 10 00 00 00 00 00"})));
  CHECK(told(cases).empty());
  CHECK(verdict_of(cases, "monitor/sdo-responses") == Verdict::pass);
  CHECK(verdict_of(cases, "monitor/sdo-multiplexer") == Verdict::pass);
  CHECK(verdict_of(cases, "monitor/sdo-toggle") == Verdict::not_applicable);
  CHECK(verdict_of(cases, "monitor/heartbeat") == Verdict::not_applicable);
  for (const auto& each : judged({})) CHECK(each.verdict == Verdict::not_applicable);
}

TEST_CASE("A second response to one request is found") {
  CHECK(told(after_exchanges({"> 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00",
                              "< 43 00 10 00 91 01 00 00"})) == Told{"fail SDO-GEN-04 in frame 7"});
}

TEST_CASE("An abort behind the abort is a repeated abort") {
  CHECK(told(after_exchanges({"> 40 FF FF 00 00 00 00 00", "< 80 FF FF 00 00 00 02 06",
                              "< 80 FF FF 00 00 00 02 06"})) == Told{"fail SDO-ERR-10 in frame 7"});
}

TEST_CASE("A client abort is answered by nothing") {
  CHECK(told(after_exchanges({"> 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00",
                              "> 80 00 10 00 00 00 00 08", "< 80 00 10 00 00 00 00 08"})) ==
        Told{"fail SDO-ERR-03 in frame 8"});
  CHECK(told(after_exchanges({"> 21 17 10 00 02 00 00 00", "< 60 17 10 00 00 00 00 00",
                              "> 80 17 10 00 00 00 00 08", "< 80 17 10 00 00 00 00 08"})) ==
        Told{"fail SDO-GEN-04 in frame 8"});
}

TEST_CASE("Both sides may give up at the same time") {
  CHECK(told(after_exchanges({"> 21 17 10 00 02 00 00 00", "< 60 17 10 00 00 00 00 00",
                              "> 80 17 10 00 00 00 04 05", "< 80 17 10 00 00 00 04 05"}))
            .empty());
}

TEST_CASE("A server may abort an open transfer by itself, and only an open one") {
  CHECK(told(after_exchanges({"> 21 17 10 00 02 00 00 00", "< 60 17 10 00 00 00 00 00", "wait 30 s",
                              "< 80 17 10 00 00 00 04 05"}))
            .empty());
  CHECK(told(after_exchanges({"> 2B 17 10 00 E8 03 00 00", "< 60 17 10 00 00 00 00 00",
                              "> 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00",
                              "< 80 17 10 00 00 00 04 05"})) == Told{"fail SDO-GEN-04 in frame 9"});
}

TEST_CASE("A late answer to a request given up is no extra frame") {
  CHECK(told(after_exchanges({"> 40 08 10 00 00 00 00 00", "wait 1 s", "> 80 08 10 00 00 00 04 05",
                              "< 41 08 10 00 0A 00 00 00", "> 40 00 10 00 00 00 00 00",
                              "< 43 00 10 00 91 01 00 00"}))
            .empty());
  CHECK(told(after_exchanges({"> 40 08 10 00 00 00 00 00", "wait 1 s", "> 40 00 10 00 00 00 00 00",
                              "< 41 08 10 00 0A 00 00 00", "< 43 00 10 00 91 01 00 00",
                              "> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 00 00 00 00"}))
            .empty());
}

TEST_CASE("Two requests at once may have one answer or two, in any order") {
  const std::vector<std::string> both{"> 40 00 10 00 00 00 00 00", "> 40 18 10 01 00 00 00 00"};
  const auto with = [&](std::vector<std::string> answers) {
    auto lines = both;
    lines.insert(lines.end(), answers.begin(), answers.end());
    lines.insert(lines.end(), {"> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 00 00 00 00",
                               "> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 00 00 00 00"});
    return told(after_exchanges(lines));
  };
  const std::string first = "< 43 00 10 00 91 01 00 00", second = "< 43 18 10 01 01 00 00 00";
  CHECK(with({first, second}).empty());
  CHECK(with({second, first}).empty());
  CHECK(with({first}).empty());
  CHECK(with({second}).empty());
  CHECK(with({"< 80 18 10 01 01 00 04 05", first}).empty());
  CHECK(with({"< 43 19 10 01 01 00 00 00"}) == Told{"fail SDO-GEN-03 in frame 7"});
}

TEST_CASE("An answer about another object is found, in responses and aborts") {
  CHECK(told(after_exchanges({"> 40 00 10 00 00 00 00 00", "< 43 10 00 00 91 01 00 00"})) ==
        Told{"fail SDO-GEN-03 in frame 6"});
  CHECK(told(after_exchanges({"> 40 FF FF 03 00 00 00 00", "< 80 00 00 00 00 00 02 06"})) ==
        Told{"fail SDO-ERR-04 in frame 6"});
}

TEST_CASE(
    "The abort of an unknown command may name nothing, and that of a segment without transfer anything") {
  CHECK(told(after_exchanges({"> E0 00 10 00 00 00 00 00", "< 80 00 00 00 01 00 04 05",
                              "> 60 00 00 00 00 00 00 00", "< 80 34 12 00 00 00 00 08",
                              "> A4 00 10 00 7F 00 00 00", "< 80 00 00 00 01 00 04 05"}))
            .empty());
}

TEST_CASE("Requests that are none may be answered or not") {
  const std::vector<std::string> lines{"> 601: 40 00 10 00",
                                       "> 601: remote",
                                       "> 601: ",
                                       "< 80 00 10 00 01 00 04 05",
                                       "> 40 00 10 00 00 00 00 00",
                                       "< 43 00 10 00 91 01 00 00",
                                       "> 40 00 10 00 00 00 00 00",
                                       "< 43 00 10 00 91 01 00 00"};
  CHECK(told(after_exchanges(lines)).empty());
}

TEST_CASE("A burst of requests is no reason for findings") {
  std::vector<std::string> lines;
  for (int i = 0; i < 40; ++i) lines.emplace_back("> 40 00 10 00 00 00 00 00");
  for (int i = 0; i < 30; ++i) lines.emplace_back("< 43 00 10 00 91 01 00 00");
  lines.insert(lines.end(), {"> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 00 00 00 00"});
  CHECK(told(after_exchanges(lines)).empty());
}

TEST_CASE("After plain exchanges the follower knows again") {
  std::vector<std::string> lines;
  for (int i = 0; i < 40; ++i) lines.emplace_back("> 40 00 10 00 00 00 00 00");
  for (int i = 0; i < 4; ++i) {
    lines.insert(lines.end(), {"> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 00 00 00 00"});
  }
  lines.emplace_back("< 4F 01 10 00 00 00 00 00");
  CHECK(told(after_exchanges(lines)) == Told{"fail SDO-GEN-04 in frame 53"});
}

TEST_CASE("After silence one exchange is enough, so that a server which doubles every frame is found") {
  CHECK(told({"> 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00", "< 43 00 10 00 91 01 00 00",
              "wait 300 ms", "> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 00 00 00 00",
              "< 4F 01 10 00 00 00 00 00"}) == Told{"fail SDO-GEN-04 in frame 6"});
}

TEST_CASE("After silence the requests that were not answered may still be") {
  CHECK(told(after_exchanges({"> 601: ", "> A3 00 00 00 00 00 00 00", "> 40 00 10 00 00 00 00 00",
                              "wait 300 ms", "> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 00 00 00 00",
                              "< 43 00 10 00 91 01 00 00", "< 80 00 00 00 01 00 04 05"}))
            .empty());
  auto frames = trace({"> 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00", "wait 300 ms",
                       "> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00",
                       "< 43 00 10 00 91 01 00 00"});
  CHECK(told(judged(frames, {{0, 2}})).empty());
}

TEST_CASE("What the host sends on the response CAN-ID is not the device's") {
  CHECK(told(after_exchanges({"> 581: 43 00 10 00 91 01 00 00", "> 581: 12"})).empty());
}

TEST_CASE("Answers to what is not for the device are told as such") {
  CHECK(told(after_exchanges({"> 602: 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00"})) ==
        Told{"fail SDO-GEN-08 in frame 6"});
  CHECK(told(after_exchanges({"> 600: 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00"})) ==
        Told{"fail SDO-GEN-09 in frame 6"});
  CHECK(told(after_exchanges({"> ext 601: 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00"})) ==
        Told{"fail SDO-GEN-11 in frame 6"});
  CHECK(told(after_exchanges({"> 602: 40 00 10 00 00 00 00 00", "< 582: 43 00 10 00 91 01 00 00"})).empty());
}

TEST_CASE("Form and bits of a response") {
  CHECK(told(after_exchanges({"> 40 01 10 00 00 00 00 00", "< 581: 4F 01 10 00 05"})) ==
        Told{"fail SDO-GEN-02 in frame 6"});
  CHECK(told(after_exchanges({"> 40 00 10 00 00 00 00 00", "< 53 00 10 00 91 01 00 00"})) ==
        Told{"fail SDO-GEN-06 in frame 6"});
  CHECK(told(after_exchanges({"> 40 00 10 00 00 00 00 00", "< 46 00 10 00 91 01 00 00"})) ==
        Told{"fail SDO-GEN-07 in frame 6"});
  CHECK(told(after_exchanges({"> 2B 17 10 00 E8 03 00 00", "< 61 17 10 00 00 00 00 00"})) ==
        Told{"fail SDO-GEN-06 in frame 6"});
  CHECK(told(after_exchanges({"> 2B 17 10 00 E8 03 00 00", "< 60 17 10 00 E8 03 00 00"})) ==
        Told{"warn SDO-GEN-05 in frame 6"});
  CHECK(told(after_exchanges({"> 40 01 10 00 00 00 00 00", "< 4F 01 10 00 05 77 77 77"})).empty());
}

TEST_CASE("Abort codes are those of CiA 301") {
  CHECK(told(after_exchanges({"> 40 FF FF 00 00 00 00 00", "< 80 FF FF 00 06 02 00 00"})) ==
        Told{"fail SDO-ERR-05 in frame 6"});
  CHECK(told(after_exchanges({"> 40 FF FF 00 00 00 00 00", "< 80 FF FF 00 34 12 00 08"})) ==
        Told{"warn SDO-ERR-05 in frame 6"});
}

TEST_CASE("Many violations are kept in part and counted") {
  std::vector<std::string> lines;
  for (int i = 0; i < 20; ++i) {
    lines.insert(lines.end(), {"> 40 00 10 00 00 00 00 00", "< 43 01 10 00 91 01 00 00"});
  }
  const auto cases = judged(trace(after_exchanges(lines)));
  const auto found = std::ranges::find(cases, "monitor/sdo-multiplexer", &result::CaseResult::id);
  const auto& judgement = found->judgements.front();
  CHECK(judgement.findings.size() == 3);
  CHECK(judgement.expectations == 21);
  CHECK_THAT(judgement.findings.back().reason, Catch::Contains("17 more"));
  CHECK(judgement.findings.front().evidence.size() == 8);
}

TEST_CASE("Frames that the host lost make findings inconclusive, and the follower starts anew") {
  auto frames = trace(after_exchanges({"> 40 00 10 00 00 00 00 00", "< 43 00 10 00 91 01 00 00",
                                       "< 43 01 10 00 91 01 00 00", "< 43 02 10 00 91 01 00 00"}));
  CHECK(told(judged(frames, {{5, 7}})) == Told{"inconclusive SDO-GEN-04 in frame 7"});
}

TEST_CASE("A channel that a download configures is watched like the default one") {
  const std::vector<std::string> configured{"> 23 01 12 01 A0 06 00 00", "< 60 01 12 01 00 00 00 00",
                                            "> 23 01 12 02 A1 06 00 00", "< 60 01 12 02 00 00 00 00"};
  auto lines = configured;
  for (int i = 0; i < 4; ++i) {
    lines.insert(lines.end(), {"> 6A0: 40 00 10 00 00 00 00 00", "< 6A1: 43 00 10 00 91 01 00 00"});
  }
  lines.emplace_back("< 6A1: 43 00 10 00 91 01 00 00");
  CHECK(told(after_exchanges(lines)) == Told{"fail SDO-GEN-04 in frame 17"});
  auto refused = lines;
  refused[3] = "< 80 01 12 02 00 00 00 08";
  CHECK(told(after_exchanges(refused)).empty());
}

TEST_CASE("On restricted CAN-IDs, and those of other services of the device, there is no SDO channel") {
  const auto configured = [](const std::string& request, const std::string& response,
                             const std::vector<std::string>& rest) {
    std::vector<std::string> lines{"> 23 01 12 01 " + request, "< 60 01 12 01 00 00 00 00",
                                   "> 23 01 12 02 " + response, "< 60 01 12 02 00 00 00 00"};
    lines.insert(lines.end(), rest.begin(), rest.end());
    return told(after_exchanges(lines));
  };
  // NMT commands are no requests, ...
  CHECK(configured("00 00 00 00", "C1 06 00 00", {"> 000: 81 01", "< 701: 00"}).empty());
  // ... heartbeats and emergency messages no responses.
  CHECK(configured("A0 06 00 00", "01 07 00 00", {"> 000: 81 01", "< 701: 00"}).empty());
  CHECK(configured("A0 06 00 00", "01 07 00 00", {"< 701: 7F"}).empty());
  CHECK(configured("A0 06 00 00", "81 00 00 00", {"> 6A0: 40 00 10 00 00 00 00 00", "< 081: 00 10 81 00 00"})
            .empty());
  CHECK(
      configured("A0 06 00 00", "A1 06 00 00", {"> 6A0: 40 00 10 00 00 00 00 00", "< 6A1: 43 00 10 00 91"}) ==
      Told{"fail SDO-GEN-02 in frame 10"});
}

TEST_CASE("A CAN-ID with which another service of the device may send is no place to judge SDO") {
  // 1201h answers on 281h, the CAN-ID of the second TPDO, or on one that a TPDO is given later.
  const auto channel = [](std::uint32_t response) {
    return Story().write(0x1201, 1, 0x690).write(0x1201, 2, response);
  };
  const std::string request = "> 690: 40 00 10 00 00 00 00 00", of_pdo = "00 00 3F";
  CHECK(channel(0x281).line(request).line("< 281: " + of_pdo).told().empty());
  CHECK(channel(0x691).write(0x1801, 1, 0x691).line(request).line("< 691: " + of_pdo).told().empty());
  CHECK(channel(0x691).line(request).line("< 691: " + of_pdo).told() == Told{"fail SDO-GEN-02"});
  // A TPDO that is not valid sends nothing.
  CHECK(channel(0x691).write(0x1801, 1, 0x8000'0691).line(request).line("< 691: " + of_pdo).told() ==
        Told{"fail SDO-GEN-02"});
}
