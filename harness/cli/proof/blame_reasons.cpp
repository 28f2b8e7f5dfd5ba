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
    {"rpdo-waiting-outlives-reset",
     "what waits over the reset arrives with the first SYNC of whichever case sends one, whatever that is about"},
    {"restarts-when-flooded",
     "whichever burst of frames comes first makes it restart, whatever its case is about"},
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
    {"ro-writable-by-segmented-download",
     "the strings of the device have rules of their own beside those of the manufacturer's "
     "entries"},
    {"heartbeat-stops-in-stopped",
     "Stopped is seen through the heartbeat: where none comes, the command is blamed"},
    {"block-upload-buffer-of-64-segments",
     "a sub-block that ends after 64 segments is met by the case that establishes block uploads; everything else rests on it"},
    {"block-upload-confirmed-times-out",
     "the abort that comes long after the end falls into the next case, whatever that is about"},
    {"emcy-of-application-once",
     "an error that is not reported is missed first where EMCY is looked for in Pre-operational"},
    {"nmt-lost-under-load",
     "its own rule is a recommendation and only warns; a start that is lost behind the many requests of a set-up is one fault in each case of PDOs"},
    {"1800-valid-bit-polarity-inverted",
     "with the polarity inverted every TPDO is silent; which rule meets that first is the order of the run"},
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
    {"1a00-data-order-wrong",
     "the order is seen in the data of a TPDO that is sent on change, by the rule of that"},
    {"nmt-self-transition-resets",
     "cases that expect a state and cases that expect a message see a reset each in their way"},
    {"life-guarding-event-told-again",
     "told again while the case about its end is listening, it looks like an event that did not end"},
    {"response-cs-reserved-bit-set",
     "a frame that is no answer by its form keeps several kinds of requests from being seen to be refused"},
    {"extended-frame-accepted-as-standard",
     "an extended frame keeps the heartbeat consumer content, which then reports no loss: that is a rule of its own service"},
    {"block-upload-last-segment-twice",
     "the segment too many lies where the end is awaited: the case that establishes block uploads meets it first, and the others rest on it"},
    {"block-download-length-unchecked",
     "too many and too few bytes are two rules of entries and two of block downloads"},
    {"block-download-surplus-cut",
     "what was cut off is stored, which breaks the rule about refused writes as well"},
    {"block-download-range-unchecked",
     "values and lengths are refused by rules of their own in every object"},
    {"1201-restricted-response-id-accepted",
     "the restricted CAN-ID is written in the case that looks at the bits of a valid channel"},
    {"additional-sdo-answers-on-default-channel",
     "the answer is missing on one channel and one too many on the other"},
    {"u16-takes-three-bytes",
     "the write that should be refused is asked for where refused writes are looked at"},
    {"block-download-crc-left-to-next",
     "the download that is refused comes first in the case about block sizes"},
    {"segmented-write-not-looked-at",
     "each object has rules of its own about values, and 1016h is looked at in other cases than COB-IDs"},
    {"block-write-not-looked-at",
     "each object has rules of its own about values, and 1016h is looked at in other cases than COB-IDs"},
    {"transfer-stopped-times-out",
     "the abort that comes long after the end falls into the next case, whatever that is about"},
    {"additional-sdo-gives-up-on-default-channel",
     "the abort on the default channel is one that nobody waits for"},
    {"missing-object-wrong-abort",
     "mapping an absent object is refused by the same code, which the mappings tolerate with a warning"},
    {"long-write-accepted",
     "too many bytes are a rule of entries, of block downloads, and of entries of one byte"},
    {"emcy-silent-in-operational", "each service that reports by EMCY misses its own"},
    {"nmt-preop-ignored-in-operational",
     "what a case has left in Operational is seen by the services that are set up in Pre-operational"},
    {"guard-not-answered-in-stopped-by-error",
     "Stopped is seen through guarding: where no reply comes, the reaction is blamed"},
    {"1011-signature-byte-order",
     "defaults that nobody can restore are missed by each service that begins with them"},
    {"1011-cob-id-without-node-id", "behind a restore EMCY is looked for where its COB-ID should be"},
    {"tpdo-inhibit-time-from-the-start",
     "what an inhibit time holds back is sent on SYNC in the case that comes first"},
    {"tpdo-fifth-byte-on-lost", "what a TPDO carries is looked at first where it is sent on change"},
});

}  // namespace

std::optional<std::string_view> reason_of_blame(std::string_view defect) {
  const auto found = std::ranges::find(reasons, defect, &Reason::defect);
  return found == reasons.end() ? std::nullopt : std::optional(found->why);
}

}  // namespace conform::cli
