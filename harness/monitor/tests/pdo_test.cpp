// SPDX-License-Identifier: Apache-2.0
// TPDOs: states, validity, length, causes.
#include "trace.hpp"

using namespace conform;
using namespace conform::monitor::testing;
using result::Verdict;

namespace {
const std::string start = "> 000: 01 01", pre_operational = "> 000: 80 01", stop = "> 000: 02 01",
                  reset = "> 000: 82 01", boot_up = "< 701: 00";
const std::string tpdo = "< 181: 01 02", sync_frame = "> 080:";

/// The first TPDO is valid, of this type, and has two bytes; the device is Operational.
Story configured(std::uint8_t type) {
  Story out;
  out.write(0x1800, 1, 0x8000'0181)
      .write(0x1A00, 0, 0)
      .write(0x1A00, 1, 0x6000'0108)
      .write(0x1A00, 2, 0x6000'0208);
  out.write(0x1A00, 0, 2).write(0x1800, 2, type).read(0x1005, 0, 0x80).read(0x1800, 3, 0);
  return out.write(0x1800, 1, 0x181).later(start).line("wait 2 s");
}
}  // namespace

TEST_CASE("A TPDO comes in Operational only") {
  CHECK(Story().line(start).later(tpdo).told().empty());
  CHECK(Story().line(start).later(tpdo).verdict("monitor/tpdos") == Verdict::pass);
  CHECK(Story().line(pre_operational).later(tpdo).told() == Told{"fail PDO-TX-02"});
  CHECK(Story().line(stop).later("< 481: 01").told() == Told{"fail PDO-TX-02"});
  // On its way already, of a device that may start by itself, of another node.
  CHECK(Story().line(stop).line(tpdo).told().empty());
  CHECK(Story().line(boot_up).later(tpdo).told().empty());
  CHECK(Story().line(stop).later("< 182: 01 02").told().empty());
  CHECK(Story().line(stop).later("> 181: 01 02").told().empty());
}

TEST_CASE("What was asked and answered since says that a TPDO has not waited in a queue") {
  const std::string request = "> 40 00 10 00 00 00 00 00", answer = "< 43 00 10 00 00 00 00 00";
  // An SDO conversation without a pause, which began before the command: 6 ms for an exchange.
  const auto conversation = [&](const std::string& command, int exchanges) {
    auto out = Story().write(0x1801, 1, 0x6A0).line(command);
    for (int i = 0; i < exchanges; ++i) out.line(request).line("wait 5 ms").line(answer);
    return out;
  };
  CHECK(conversation(pre_operational, 40).line(tpdo).told() == Told{"fail PDO-TX-02"});
  CHECK(conversation(start, 40).line(tpdo).told().empty());
  // Within T_NMT, and before the answer to what came behind it.
  CHECK(conversation(pre_operational, 10).line(tpdo).told().empty());
  CHECK(conversation(pre_operational, 40).line(request).line("wait 5 ms").line(tpdo).told() ==
        Told{"fail PDO-TX-02"});
  // Answers may keep back what has to give way to them.
  CHECK(conversation(pre_operational, 40).line("< 6A0: 01 02").told().empty());
}

TEST_CASE("A TPDO may have waited for as long as the bus was taken without a pause") {
  // Frames of a millisecond each, made in one go 90 ms after the command: the last one comes 21 ms too late.
  auto burst = [](const std::string& pause, int frames) {
    auto out = Story().line(pre_operational).line(pause);
    for (int i = 0; i < frames; ++i) out.line("< 1E2: 01 02");
    return out.line(tpdo);
  };
  CHECK(burst("wait 90 ms", 30).told().empty());
  // The bus was idle between, so that what was made before the end of T_NMT was sent before, too.
  CHECK(burst("wait 90 ms", 30).line("wait 2 ms").line(tpdo).told() == Told{"fail PDO-TX-02"});
  CHECK(burst("wait 105 ms", 3).told() == Told{"fail PDO-TX-02"});
}

TEST_CASE("A TPDO that is not valid is not sent, as far as anybody knows") {
  CHECK(Story().line(start).read(0x1800, 1, 0x8000'0181).later(tpdo).told() == Told{"fail OD-1800-09"});
  CHECK(Story().line(start).write(0x1800, 1, 0x8000'0181).line(tpdo).told().empty());
  CHECK(Story().line(start).read(0x1800, 1, 0x8000'0181).write(0x1800, 1, 0x181).later(tpdo).told().empty());
  // A reset brings back what nobody has seen.
  CHECK(Story()
            .line(start)
            .write(0x1800, 1, 0x8000'0181)
            .later(reset)
            .line(boot_up)
            .later(tpdo)
            .told()
            .empty());
  // Another TPDO has the same CAN-ID.
  CHECK(Story().line(start).read(0x1800, 1, 0x8000'0181).read(0x1801, 1, 0x181).later(tpdo).told().empty());
  // A download that has no answer may have been executed, and one that was refused has not.
  CHECK(Story()
            .line(start)
            .read(0x1800, 1, 0x8000'0181)
            .line("> 23 00 18 01 81 01 00 00")
            .later(tpdo)
            .told()
            .empty());
  CHECK(Story()
            .line(start)
            .read(0x1800, 1, 0x8000'0181)
            .refuse(0x23, 0x1800, 1, 0x0609'0030)
            .later(tpdo)
            .told() == Told{"fail OD-1800-09"});
  // Without mapped objects it may have read as not valid.
  CHECK(Story().line(start).read(0x1800, 1, 0x8000'0181).write(0x1A00, 0, 1).later(tpdo).told().empty());
}

TEST_CASE("A TPDO that was moved is judged with its new CAN-ID, where nobody else is heard") {
  auto moved = [] {
    return Story().line(start).write(0x1800, 1, 0x8000'01E1).write(0x1800, 1, 0x1E1).later(stop);
  };
  CHECK(moved().later("< 1E1: 01").told() == Told{"fail PDO-TX-02"});
  CHECK(moved().later("< 1E1: 01").later("< 702: 05").told().empty());
  CHECK(moved().later("< 481: 01").told() == Told{"fail PDO-TX-02"});
}

TEST_CASE("A late EMCY on the CAN-ID that 1014h had is no TPDO that had it once, too") {
  // The second has the node-ID of the device in its lower bits, as nobody else's has.
  const auto [id, message] = GENERATE(table<std::uint32_t, const char*>(
      {{0x6A0, "< 6A0: 00 00 00 00 00 00 00 00"}, {0x681, "< 681: 00 00 00 00 00 00 00 00"}}));
  auto moved = [&id = id] { return Story().write(0x1800, 1, id); };
  auto both = [&, &id = id] { return moved().write(0x1014, 0, id).write(0x1014, 0, 0x81); };
  CHECK(both().later(reset).line(boot_up).later(pre_operational).later(message).told().empty());
  CHECK(moved().later(reset).line(boot_up).later(pre_operational).later(message).told() ==
        Told{"fail PDO-TX-02"});
}

TEST_CASE("A TPDO is as long as its mapping") {
  CHECK(configured(255).line(tpdo).told().empty());
  CHECK(configured(255).line("< 181: 01 02 03").told() == Told{"fail PDO-TX-01"});
  CHECK(configured(255).line("< 181: 01").told() == Told{"fail PDO-TX-01"});
  // Written while it is valid: it may count at once, later, or never.
  CHECK(configured(255).write(0x1A00, 0, 1).later("< 181: 01").line(tpdo).told().empty());
  CHECK(configured(255).write(0x1A00, 0, 0).later("< 181:").told().empty());
}

TEST_CASE("A synchronous TPDO needs a SYNC") {
  CHECK(configured(1).line(sync_frame).line(tpdo).line(sync_frame).line(tpdo).told().empty());
  CHECK(configured(1).line(sync_frame).line(tpdo).later(tpdo).told() == Told{"fail PDO-TX-05"});
  CHECK(configured(0).line(sync_frame).line(tpdo).later(tpdo).told() == Told{"fail PDO-TX-07"});
  CHECK(configured(4).line(sync_frame).line(sync_frame).line(tpdo).later(tpdo).told() ==
        Told{"fail PDO-TX-06"});
  // Late ones, and one that was asked for.
  CHECK(configured(1).line(sync_frame).line(sync_frame).line(tpdo).line(tpdo).told().empty());
  CHECK(configured(1).line(sync_frame).line(tpdo).line("> 181: remote").line(tpdo).told().empty());
  CHECK(configured(1)
            .line(sync_frame)
            .line(tpdo)
            .write(0x1005, 0, 0x90)
            .line("> 090:")
            .line(tpdo)
            .told()
            .empty());
  // With others on the bus the SYNC may be theirs, and so may be the TPDO.
  CHECK(configured(1).line(sync_frame).line(tpdo).line(tpdo).later("< 702: 05").told().empty());
}

TEST_CASE("Requests for the CAN-ID that a TPDO had before are not its requests now") {
  auto moved = configured(1);
  moved.line("> 181: remote").line(tpdo).later(sync_frame).line(tpdo);
  moved.write(0x1800, 1, 0x8000'0181).write(0x1800, 1, 0x8000'06A0).write(0x1800, 1, 0x6A0);
  CHECK(moved.later(sync_frame).line("< 6A0: 01 02").told().empty());
}

TEST_CASE("A TPDO on request waits for the request") {
  CHECK(configured(253).line("> 181: remote").line(tpdo).told().empty());
  CHECK(configured(253).line("> 181: remote").line(tpdo).later(tpdo).told() == Told{"fail PDO-TX-19"});
  CHECK(configured(252).line("> 181: remote").line(tpdo).line(sync_frame).line(tpdo).told() ==
        Told{"fail PDO-TX-20"});
}

TEST_CASE("The inhibit time is kept") {
  auto inhibited = [] {
    return configured(255)
        .write(0x1800, 1, 0x8000'0181)
        .write(0x1800, 3, 1000)
        .write(0x1800, 1, 0x181)
        .line("wait 500 ms")
        .line(tpdo);
  };
  CHECK(inhibited().line("wait 100 ms").line(tpdo).told().empty());
  CHECK(inhibited().line("wait 20 ms").line(tpdo).told() == Told{"fail PDO-TX-12"});
  // Asked for, begun anew, and made long before behind what the device had to send.
  CHECK(inhibited().line("> 181: remote").line(tpdo).told().empty());
  CHECK(inhibited().line(start).line(tpdo).told().empty());
  CHECK(inhibited()
            .line("> 2B 00 18 05 0A 00 00 00")
            .line("< 60 00 18 05 00 00 00 00")
            .line(tpdo)
            .told()
            .empty());
}

TEST_CASE("Where the machine was late that the device shares, only violations that rest on time are open") {
  const std::vector<monitor::Loss> late = {{0, 1000}}, before = {{0, 3}};
  const auto soon = [] {
    return configured(255)
        .write(0x1800, 1, 0x8000'0181)
        .write(0x1800, 3, 1000)
        .write(0x1800, 1, 0x181)
        .line("wait 500 ms")
        .line(tpdo)
        .line("wait 20 ms")
        .line(tpdo);
  };
  CHECK(soon().told({}, late) == Told{"inconclusive PDO-TX-12"});
  CHECK(soon().told({}, before) == Told{"fail PDO-TX-12"});
  CHECK(Story().line(pre_operational).later(tpdo).told({}, late) == Told{"inconclusive PDO-TX-02"});
  CHECK(Story().line(start).read(0x1800, 1, 0x8000'0181).later(tpdo).told({}, late) ==
        Told{"fail OD-1800-09"});
}
