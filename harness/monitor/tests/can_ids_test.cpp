// SPDX-License-Identifier: Apache-2.0
// Frames that are not the device's to send, and whose they may be.
#include "trace.hpp"

using namespace conform;
using namespace conform::monitor::testing;
using result::Verdict;

namespace {
const std::string heartbeat = "< 701: 7F", other_node = "< 702: 05";
}

TEST_CASE("A device sends with its own CAN-IDs") {
  CHECK(Story().line(heartbeat).verdict("monitor/can-ids") == Verdict::pass);
  for (const std::string id : {"001", "101", "6E0", "7C0", "582", "702"}) {
    INFO(id);
    const bool of_a_node = id == "582" || id == "702";
    CHECK(Story().line(heartbeat).line("< " + id + ": 01").told() ==
          (of_a_node ? Told{} : Told{"fail CAN-TRF-02"}));
    CHECK(Story().line(heartbeat).line("< " + id + ": 01").line(other_node).told().empty());
    CHECK(Story().line(heartbeat).line("> " + id + ": 01").told().empty());
    monitor::Facts alone;
    alone.alone = true;
    CHECK(Story().line(heartbeat).line("< " + id + ": 01").told(alone) == Told{"fail CAN-TRF-02"});
  }
  CHECK(Story().line(heartbeat).line("< 6B0: 01").told() == Told{"warn CAN-TRF-02"});
  CHECK(Story().line(heartbeat).line("< 6B0: 01").read(0x1804, 1, 0x6B0).told().empty());
  CHECK(Story().line(heartbeat).line("< 481: 01").told().empty());
}

TEST_CASE("A slave commands nobody") {
  CHECK(Story().line(heartbeat).line("< 000: 01 00").told() == Told{"fail NMT-SVC-05"});
  CHECK(Story().line(heartbeat).line("< 000: 01 00").line(other_node).told().empty());
  CHECK(Story().line(heartbeat).line("< 000: 01 00").read(0x1F80, 0, 1).told().empty());
  CHECK(Story().line(heartbeat).line("< 7E5: 04 00 00 00 00 00 00 00").told() == Told{"fail NMT-SVC-05"});
  CHECK(Story().line(heartbeat).line("< 77E: remote").told() == Told{"fail NMT-SVC-05"});
  CHECK(Story().line(heartbeat).line("< 701: remote").told().empty());
  // Nor does a COB-ID that held the CAN-ID once make a frame of NMT or a guard request another one.
  CHECK(Story().read(0x1800, 1, 0).line(heartbeat).line("< 000: 01 00").told() == Told{"fail NMT-SVC-05"});
  CHECK(Story().read(0x1400, 1, 0x77E).line(heartbeat).line("< 77E: remote").told() ==
        Told{"fail NMT-SVC-05"});
}

TEST_CASE("29-bit frames and remote frames need an entry that says so") {
  CHECK(Story().line(heartbeat).line("< ext 18FF0001: 01").told() == Told{"fail CAN-TRF-03"});
  CHECK(Story().line(heartbeat).line("< ext 18FF0001: 01").read(0x1800, 1, 0x38FF'0001).told().empty());
  CHECK(Story().line(heartbeat).line("< 080: remote").told() == Told{"fail CAN-TRF-04"});
  CHECK(Story().line(heartbeat).line("< 2A0: remote").read(0x1400, 1, 0x2A0).told().empty());
}

TEST_CASE("An LSS slave answers once") {
  const std::string later = "wait 3 s", inquire = "> 7E5: 5E 00 00 00 00 00 00 00",
                    answer = "< 7E4: 5E 01 00 00 00 00 00 00";
  CHECK(Story().line(later).line(inquire).line(answer).line(inquire).line(answer).told().empty());
  CHECK(Story().line(later).line(inquire).line(answer).line(answer).told() == Told{"fail LSS-GEN-08"});
  CHECK(Story()
            .line(later)
            .line(inquire)
            .line(answer)
            .line("> 7E5: 04 00 00 00 00 00 00 00")
            .line(answer)
            .told() == Told{"fail LSS-GEN-08"});
  CHECK(Story().line(answer).told().empty());
  CHECK(Story().line(inquire).line("< 7E4: 5E 01").told() == Told{"fail LSS-GEN-01"});
  CHECK(Story().line(later).line(inquire).line(answer).line(answer).line(other_node).told().empty());
}

TEST_CASE("The node-ID that LSS gives is the device's, too") {
  CHECK(Story()
            .line("> 7E5: 11 07 00 00 00 00 00 00")
            .line("< 7E4: 11 00 00 00 00 00 00 00")
            .line("> 000: 82 01")
            .line("< 707: 00")
            .later("< 000: 01 00")
            .told() == Told{"fail NMT-SVC-05"});
}

TEST_CASE("The abort of an unknown command names the object of the request, or none") {
  const std::string unknown = "> E0 00 10 00 00 00 00 00";
  CHECK(told(after_exchanges({unknown, "< 80 04 10 00 01 00 04 05"})) == Told{"warn SDO-ERR-04 in frame 6"});
  CHECK(told(after_exchanges({unknown, "< 80 00 10 00 01 00 04 05"})).empty());
  CHECK(told(after_exchanges({unknown, "< 80 00 00 00 01 00 04 05"})).empty());
  CHECK(told(after_exchanges({"> 40 08 10 00 00 00 00 00", "< 41 08 10 00 0E 00 00 00", unknown,
                              "< 80 08 10 00 01 00 04 05"}))
            .empty());
}
