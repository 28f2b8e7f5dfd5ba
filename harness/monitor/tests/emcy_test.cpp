// SPDX-License-Identifier: Apache-2.0
// Emergency messages, and what 1001h and 1003h say behind them.
#include "trace.hpp"

using namespace conform;
using namespace conform::monitor::testing;
using result::Verdict;

namespace {
const std::string start = "> 000: 01 01", stop = "> 000: 02 01", reset = "> 000: 82 01",
                  boot_up = "< 701: 00";
const std::string emcy = "< 081: 30 81 11 00 00 00 00 00", gone = "< 081: 00 00 00 00 00 00 00 00";
}  // namespace

TEST_CASE("No emergency message comes in Stopped") {
  CHECK(Story().line(start).later(emcy).told().empty());
  CHECK(Story().line(stop).later(emcy).told() == Told{"fail EMCY-NMT-01"});
  CHECK(Story().line(stop).line(emcy).told().empty());
  CHECK(Story().line(stop).later("> 081: 30 81 11 00 00 00 00 00").told().empty());
  CHECK(Story().line(stop).later("< 082: 30 81 11 00 00 00 00 00").told().empty());
}

TEST_CASE("Emergency messages have eight bytes, a known class, and bit 0 of the error register") {
  CHECK(Story().line("< 081: 30 81 11").told() == Told{"fail EMCY-FMT-01"});
  CHECK(Story().line("< 081: 30 A1 11 00 00 00 00 00").told() == Told{"fail EMCY-FMT-02"});
  CHECK(Story().line("< 081: 30 81 51 00 00 00 00 00").told() == Told{"fail EMCY-FMT-04"});
  CHECK(Story().line("< 081: 30 81 10 00 00 00 00 00").told() == Told{"warn EMCY-FMT-04"});
  CHECK(Story().line(emcy).line(gone).verdict("monitor/emergencies") == Verdict::pass);
}

TEST_CASE("Without a valid 1014h there is no EMCY") {
  CHECK(Story().write(0x1014, 0, 0x8000'0081).later(emcy).told() == Told{"fail OD-1014-08"});
  CHECK(Story().write(0x1014, 0, 0x8000'0081).line(emcy).told().empty());
  CHECK(Story().write(0x1014, 0, 0x8000'0081).later(reset).line(boot_up).later(emcy).told().empty());
  // A TPDO has that CAN-ID now.
  CHECK(Story()
            .write(0x1014, 0, 0x8000'0081)
            .write(0x1800, 1, 0x8000'0081)
            .read(0x1800, 1, 0x81)
            .later(emcy)
            .told()
            .empty());
  auto moved = [] { return Story().write(0x1014, 0, 0x8000'06A1).write(0x1014, 0, 0x6A1).later(stop); };
  CHECK(moved().later("< 6A1: 30 81 11 00 00 00 00 00").told() == Told{"fail EMCY-NMT-01"});
  CHECK(moved().later("< 6A1: 30 81 11 00 00 00 00 00").line("< 702: 05").told().empty());
}

TEST_CASE("Who sends emergency messages has 1014h") {
  const auto without = [] { return Story().read(0x1000, 0, 0x191).absent(0x1014, 0); };
  const Told found{"fail OD-1014-01"};
  CHECK(without().later(emcy).told() == found);
  CHECK(Story().line(emcy).read(0x1000, 0, 0x191).absent(0x1014, 0).told() == found);
  CHECK(without().refuse(0x23, 0x1014, 0, 0x0602'0000).later(emcy).told() == found);
  CHECK(without().later("< 081: 00 00 00 00 00 00 00 00").told().empty());
  // No error code of CiA 301, not the length of an emergency message, another node, another object.
  CHECK(without().later("< 081: 30 A1 11 00 00 00 00 00").told().empty());
  CHECK(without().later("< 081: 30 81 11 00").told().empty());
  CHECK(without().later("< 082: 30 81 11 00 00 00 00 00").told().empty());
  CHECK(without().later(emcy).line("< 702: 05").told().empty());
  CHECK(without().later(emcy).read(0x1800, 1, 0x4000'0081).told().empty());
  CHECK(Story().line("< 701: 7F").later(emcy).told().empty());
}

TEST_CASE("Where 1014h may hold the CAN-ID of SYNC, a SYNC is not taken for an emergency message") {
  // Behind the reset nobody has read 1014h; 1005h is no producer's, so the SYNC is wrong as a SYNC.
  CHECK(Story()
            .read(0x1005, 0, 0x80)
            .write(0x1014, 0, 0x80)
            .later(reset)
            .line(boot_up)
            .later("< 080: 04")
            .verdict("monitor/emergencies") != Verdict::fail);
}

TEST_CASE("The inhibit time of EMCY is kept") {
  CHECK(Story().write(0x1015, 0, 1000).later(emcy).line("wait 20 ms").line(gone).told() ==
        Told{"fail EMCY-INH-01"});
  CHECK(Story().write(0x1015, 0, 1000).later(emcy).line("wait 99 ms").line(gone).told().empty());
  CHECK(Story().write(0x1015, 0, 0).later(emcy).line(gone).told().empty());
  CHECK(Story().later(emcy).write(0x1015, 0, 5000).line(gone).told().empty());
}

TEST_CASE("An EMCY that waited for a flood of NMT commands may have been due before them") {
  auto told_behind = [](int commands) {
    auto story = Story().write(0x1015, 0, 1000).line("wait 2 s");
    for (int i = 0; i < commands; ++i) story.line("> 000: 80 01");
    return story.line(emcy).line("wait 60 ms").line(gone).told();
  };
  CHECK(told_behind(100).empty());
  CHECK(told_behind(1) == Told{"fail EMCY-INH-01"});
}

TEST_CASE("Several EMCYs that waited for a flood of NMT commands come one behind the other") {
  auto told_behind = [](int commands) {
    auto story = Story().write(0x1015, 0, 1000).line("wait 2 s");
    for (int i = 0; i < commands; ++i) story.line("> 000: 80 01");
    return story.line(emcy).line("wait 1 ms").line(emcy).line("wait 1 ms").line(emcy).told();
  };
  CHECK(told_behind(300).empty());
  CHECK(told_behind(1) == Told{"fail EMCY-INH-01"});
}

TEST_CASE("What another node sends on a CAN-ID that 1014h may hold does not begin an inhibit time") {
  // Behind the reset nobody has read 1014h.
  const auto inhibited = [] {
    return Story()
        .write(0x1014, 0, 0xB3)
        .later(reset)
        .line(boot_up)
        .write(0x1015, 0, 5000)
        .later("< 702: 05");
  };
  const std::string foreign = "< 0B3: 00 FF 81 00 00 00 00 00";
  CHECK(inhibited().line(foreign).line("wait 200 ms").line(gone).told().empty());
  CHECK(inhibited().line(emcy).line("wait 200 ms").line(foreign).told().empty());
  CHECK(inhibited().line(emcy).line("wait 200 ms").line(gone).told() == Told{"fail EMCY-INH-01"});
}

TEST_CASE("1001h has no error that EMCY did not tell") {
  CHECK(Story().line(emcy).read(0x1001, 0, 0x11).line("wait 2 s").line(gone).told().empty());
  // Whether a further message has to wait for an inhibit time, nobody has said.
  CHECK(Story().line(emcy).read(0x1001, 0, 0x15).line("wait 2 s").line(gone).told() ==
        Told{"warn EMCY-FMT-03"});
  CHECK(Story()
            .read(0x1000, 0, 0x191)
            .absent(0x1015, 0)
            .line(emcy)
            .read(0x1001, 0, 0x15)
            .line("wait 2 s")
            .line(gone)
            .told() == Told{"fail EMCY-FMT-03"});
  CHECK(Story().read(0x1015, 0, 0).line(emcy).read(0x1001, 0, 0x15).line("wait 2 s").line(gone).told() ==
        Told{"fail EMCY-FMT-03"});
  // Less is left of it; the message about more is to come; it cannot come.
  CHECK(Story().line(emcy).read(0x1001, 0, 0x01).line("wait 2 s").line(gone).told().empty());
  CHECK(Story().line(emcy).read(0x1001, 0, 0x15).line(emcy).line("wait 2 s").line(gone).told().empty());
  CHECK(Story()
            .line(emcy)
            .line("> 000: 80 01")
            .read(0x1001, 0, 0x15)
            .line("wait 2 s")
            .line(gone)
            .told()
            .empty());
  CHECK(Story()
            .line(emcy)
            .write(0x1014, 0, 0x8000'0081)
            .read(0x1001, 0, 0x15)
            .line("wait 2 s")
            .line("< 701: 7F")
            .told()
            .empty());
  CHECK(Story()
            .write(0x1015, 0, 30000)
            .later(emcy)
            .read(0x1001, 0, 0x15)
            .line("wait 4 s")
            .line("< 701: 7F")
            .told()
            .empty());
}

TEST_CASE("What another node sends on a CAN-ID that 1014h held for a while says nothing about 1001h") {
  CHECK(Story()
            .write(0x1014, 0, 0x8000'0083)
            .write(0x1014, 0, 0x83)
            .write(0x1014, 0, 0x81)
            .later(reset)
            .line(boot_up)
            .line("< 083: 00 FF 80 00 00 00 00 00")
            .line("wait 100 ms")
            .read(0x1001, 0, 0x03)
            .line("wait 2 s")
            .line("< 701: 7F")
            .verdict("monitor/error-objects") != Verdict::fail);
}

TEST_CASE("A message that may be a TPDO of the device leaves open what 1001h is to hold") {
  CHECK(Story()
            .line("< 081: 00 00 00 00 00 00 00 00")
            .line("> 23 00 18 01 81 00 00 40")
            .line("< 80 00 18 01 30 00 09 06")
            .line("< 081: 30 81 11 7E 01 00 00 00")
            .line("wait 100 ms")
            .read(0x1001, 0, 0x11)
            .line("wait 2 s")
            .line("< 701: 7F")
            .told()
            .empty());
}

TEST_CASE("1003h begins with the error of the last EMCY") {
  const std::string long_after = "wait 1200 ms", end = "< 701: 7F";
  CHECK(
      Story().line(emcy).line(long_after).read(0x1003, 1, 0x8130).line("wait 2 s").line(end).told().empty());
  CHECK(Story()
            .read(0x1000, 0, 0x191)
            .absent(0x1015, 0)
            .line(emcy)
            .line(long_after)
            .read(0x1003, 1, 0x3081)
            .line("wait 2 s")
            .line(end)
            .told() == Told{"fail OD-1003-11"});
  CHECK(Story().line(emcy).read(0x1003, 1, 0x3081).line("wait 2 s").line(end).told().empty());
  CHECK(Story()
            .line(emcy)
            .line(long_after)
            .write(0x1003, 0, 0)
            .read(0x1003, 1, 0x3081)
            .line("wait 2 s")
            .line(end)
            .told()
            .empty());
}
