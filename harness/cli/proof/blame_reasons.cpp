// SPDX-License-Identifier: Apache-2.0
// Defects that show several causes, or another rule first, and why that is so. The list may only become
// shorter.
#include <algorithm>
#include <array>

#include "cli/proof/blame.hpp"

namespace conform::cli {
namespace {

struct Reason {
  std::string_view defect, why;
};

constexpr auto reasons = std::to_array<Reason>({
    {"1403-missing",
     "an object that the description counts and another one that it names are two demands of it"},
    {"1804-undescribed",
     "a TPDO too many is found by counting, and by what a TPDO must have, wherever it comes from"},
    {"tpdo-last-mapped-object-lost",
     "what a TPDO carries behind a reset is a rule of resets, and the object that is not sent is missing there, too"},
    {"rpdo-waiting-outlives-reset",
     "what waits over the reset arrives with the first SYNC of whichever case sends one, whatever that is about"},
    {"lss-silent", "that there is no LSS breaks the rules of LSS, and what the description says"},
    {"restarts-when-flooded",
     "whichever burst of frames comes first makes it restart, whatever its case is about"},
    {"node-id-of-six-bits",
     "the node-ID of one LSS scenario is above 63: what the device sends there is wrong for LSS, too"},
    {"mux-stale-subindex",
     "what a response about another sub-index spoils is seen in PDO set-ups and a heartbeat "
     "test, which read nothing wrong themselves"},
    {"sdo-double-response",
     "a second copy of every frame is a frame of its own to each kind of block transfer"},
    {"sdo-drops-every-nth-request",
     "which request is lost is chance: each rule is broken once, and none more than another"},
    {"sdo-second-request-gets-data-of-the-first",
     "data of the request before is found in block uploads, too, where nobody sends two "
     "requests"},
    {"sdo-late-response", "an answer behind the time-out falls into the next case, whatever that is about"},
    {"abort-request-with-reserved-bits-hangs",
     "the frame that stops the server comes in one case only; the restart behind it clears the "
     "traces"},
    {"abort-repeated-later", "the second abort comes 100 ms later, into the next step of any case"},
    {"abort-code-always-general",
     "every refusal of the dictionary has the same wrong code; which rule comes first is the "
     "order of the run"},
    {"data-big-endian",
     "a wrong order of bytes is another value for each object, and each object has its own "
     "rules about values"},
    {"stale-data-returned",
     "set-ups of PDOs and TIME write what they read wrongly, and see the effect without an SDO "
     "answer"},
    {"expedited-size-one-too-low",
     "COB-IDs read one byte short are used by SYNC and TPDO scenarios, which see the effect "
     "without an SDO answer"},
    {"empty-entry-command-byte-53h",
     "an empty text after a download is the same impossible command byte, seen by the rule of "
     "that download"},
    {"upload-size-not-indicated",
     "numbers without their length are one fault in all entries; where one is uploaded in several ways, "
     "the rule that they agree is broken as well"},
    {"empty-entry-silent",
     "an empty entry has no rule of its own in the scenario that meets the silence, and its "
     "time-out falls into block uploads"},
    {"long-entries-silent",
     "the rule about empty entries meets the silence first; all long entries are silent"},
    {"new-initiate-returns-old-object",
     "the frame names another object and the answer is that of the transfer before: two rules, "
     "both broken"},
    {"expedited-length-ignored",
     "a length that is not heeded breaks the rules about stored values and those about wrong lengths"},
    {"four-bytes-taken-for-two",
     "a length that is misread breaks the rules about stored values and those about wrong lengths"},
    {"nmt-reset-communication-ignored-in-preop",
     "on the bus a reset that was not obeyed is one without its boot-up message, which the monitor sees first"},
    {"reset-communication-keeps-values", "mappings that are kept have a rule of their own"},
    {"foreign-heartbeat-ends-a-transfer",
     "the heartbeat that ends the transfer is not seen by the heartbeat consumer either: two "
     "services are broken"},
    {"client-abort-ignored-and-busy",
     "where a transfer cannot be ended and none begun, the first long upload fails before a "
     "rule about aborts is asked"},
    {"block-upload-never-closed", "the upload before blocks the next, which breaks the rule of that one"},
    {"block-upload-repeats-for-ever", "frames that never end fall into every case that follows"},
    {"block-upload-returns-old-data",
     "the old transfer's end frame carries a CRC that was not asked for, which the monitor "
     "sees"},
    {"missing-object-returns-zero",
     "absent objects with values are a cause for the absent ones, and one for the sub-indices "
     "below them"},
    {"ro-writable-by-segmented-download",
     "the strings of the device have rules of their own beside those of the manufacturer's "
     "entries"},
    {"heartbeat-stops-in-stopped",
     "Stopped is seen through the heartbeat: where none comes, the command is blamed"},
    {"block-upload-buffer-of-64-segments",
     "a sub-block that ends after 64 segments is met by the case that establishes block uploads; everything else rests on it"},
    {"block-upload-confirmed-times-out",
     "the abort that comes long after the end falls into the next case, whatever that is about"},
    {"1016-entry-not-stored",
     "a heartbeat that stays away is a way to raise an error, too, and then no EMCY comes"},
    {"1016-timeout-not-detected",
     "a heartbeat that stays away is a way to raise an error, too, and then no EMCY comes"},
    {"hbc-deaf-to-operational",
     "a heartbeat that stays away is a way to raise an error, too, and then no EMCY comes"},
    {"emcy-of-application-once",
     "an error that is not reported is missed first where EMCY is looked for in Pre-operational"},
    {"nmt-lost-under-load",
     "its own rule is a recommendation and only warns; a start that is lost behind the many requests of a set-up is one fault in each case of PDOs"},
    {"1800-valid-bit-polarity-inverted",
     "with the polarity inverted every TPDO is silent; which rule meets that first is the order of the run"},
    {"1010-save-rejected",
     "what was stored although it was refused is there after the next reset, in cases about other services"},
    {"1010-save-no-response",
     "what was stored without an answer is there after the next reset, in cases about other services"},
    {"1600-procedure-ignored-in-operational",
     "the new mapping is seen by what the next RPDO does, and the rules about RPDOs come first"},
    {"refused-segment-confirmed-as-well",
     "the confirmation beside the abort is a frame too many, and in a transfer that another one replaces it is "
     "the wrong answer"},
    {"block-upload-starts-at-once",
     "segments before the start answer no request, and the start behind them has nothing to begin"},
    {"emcy-without-error",
     "an EMCY behind each boot-up also stands behind the reset that ends the watch of a heartbeat consumer"},
    {"tpdo-inhibit-unit-1ms",
     "an inhibit time that lasts ten times as long holds back what the event timer is to send"},
    {"life-guarding-noticed-once",
     "which life guarding event is the second one, and not reported, is the order of the run"},
    {"lss-selective-incomplete-accepted",
     "the frames that select a slave and those that identify it are counted in the same way"},
    {"lss-identify-answered-twice", "the second answer is one that nobody asked for"},
    {"1a00-data-order-wrong",
     "the order is seen in the data of a TPDO that is sent on change, by the rule of that"},
    {"sync-tpdo-slow",
     "the rule about the delay is a recommendation and only warns; the rule about the transmission type fails beside it"},
    {"missing-object-silent",
     "an additional channel is silent about an object that is not there as well, and is an area of its own"},
    {"errors-never-clear",
     "an RPDO that is too short for the second time is no new error there, and RPDOs are an area of their own"},
    {"sync-ignored-above-127",
     "counters up to 240 are counted by a case that takes long; the others see it by the rule about any counter"},
    {"nmt-self-transition-resets",
     "cases that expect a state and cases that expect a message see a reset each in their way"},
    {"1a00-dlc-wrong",
     "a stored TPDO is held against what was stored, and what comes back with a reset is an area of its own"},
    {"sync-dead-after-reset",
     "a stored TPDO is held against what was stored, and what comes back with a reset is an area of its own"},
    {"rpdo-high-nibble-lost", "the services beside LSS are an area of their own, and an RPDO is one of them"},
    {"life-guarding-event-told-again",
     "told again while the case about its end is listening, it looks like an event that did not end"},
});

}  // namespace

std::optional<std::string_view> reason_of_blame(std::string_view defect) {
  const auto found = std::ranges::find(reasons, defect, &Reason::defect);
  return found == reasons.end() ? std::nullopt : std::optional(found->why);
}

}  // namespace conform::cli
