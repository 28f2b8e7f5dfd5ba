// SPDX-License-Identifier: Apache-2.0
// The SDO server: what it offers, how it words its answers, and how long it takes.
#include <algorithm>
#include <vector>

#include "sdo/frames.hpp"
#include "variants/sdo_habits.hpp"
#include "variants/tools.hpp"

namespace refnode {

using namespace variant;

namespace {

How choose(void (*change)(SdoChoices&)) {
  return [change](Parts& parts) { change(parts.sdo.choices); };
}

How turnaround(std::chrono::milliseconds time) {
  return [time](Parts& parts) { parts.sdo.choices.turnaround = time; };
}

/// Who takes that long for an answer has nothing that would take hours, and does not soon lose patience with
/// a client.
How slow_turnaround(std::chrono::milliseconds time) {
  return [time](Parts& parts) {
    parts.sdo.choices.turnaround = time;
    parts.sdo.choices.time_out = std::chrono::seconds(10);
    absent({0x1021, 0x1022, 0x2008})(parts);
    gap(0x2000, 0x0F)(parts);
  };
}

How filter(Filter change) {
  return [change = std::move(change)](Parts& parts) { parts.device.outbox.add_filter(change); };
}

/// Another code in place of `usual`, in answers to these steps.
How code_at(std::initializer_list<SdoStep> steps, AbortCode usual, AbortCode other) {
  return filter([all = std::vector<SdoStep>(steps), usual, other](const FilterContext& context,
                                                                  std::vector<Outgoing>& frames) {
    if (context.sdo == nullptr || context.sdo->aborted != usual) return;
    if (std::ranges::find(all, context.sdo->step) == all.end()) return;
    for (Outgoing& outgoing : frames)
      conform::store_le(std::span(outgoing.frame.data).subspan(4, 4), other.value());
  });
}

constexpr std::initializer_list<SdoStep> out_of_place = {SdoStep::other,
                                                         SdoStep::upload_segment,
                                                         SdoStep::download_segment,
                                                         SdoStep::block_upload_segment,
                                                         SdoStep::block_upload_end,
                                                         SdoStep::block_download_segment,
                                                         SdoStep::block_download_end};

/// Frames that are no request where they come: CiA 301 names no code but 0504 0001h, and any refusal is one.
Variant out_of_place_refused(std::string_view id, std::string_view summary, AbortCode code) {
  return {.id = id,
          .summary = summary,
          .legal = "SDO-SUP-08, SDO-SDN-16, SDO-BUP-21, SDO-BDN-22, tolerated: any other abort",
          .how = code_at(out_of_place, abort_code::command_unknown, code),
          .group = "command-code",
          .warns = {"SDO-ERR-01", "SDO-ERR-02", "SDO-SUP-07", "SDO-SUP-08", "SDO-SUP-09", "SDO-SUP-10",
                    "SDO-SUP-13", "SDO-SUP-20", "SDO-SDN-16", "SDO-SDN-19", "SDO-SDN-20", "SDO-SDN-26",
                    "SDO-BUP-18", "SDO-BUP-20", "SDO-BUP-21", "SDO-BDN-20", "SDO-BDN-21", "SDO-BDN-22",
                    "SDO-ERR-06"}};
}

}  // namespace

VariantTable sdo_variants() {
  using enum SdoStep;
  using std::chrono::milliseconds;
  using std::chrono::seconds;
  return {
      {"1200-absent", "the default SDO is not described", "OD-1200-01", absent({0x1200})},
      {"1200-const", "1200h constant", "OD-1200-04", access_all(0x1200, Access::ro, Access::constant)},
      {"sdo-unused-bytes", "bytes without data are not 00h in uploads", "SDO-GEN-05", fill_unused_bytes},
      {"sdo-turnaround-5ms", "answers after 5 ms", "SDO-GEN-18: no limit is set", turnaround(milliseconds(5)),
       "turnaround"},
      {"sdo-turnaround-90ms", "answers after 90 ms", "SDO-GEN-18: no limit is set",
       turnaround(milliseconds(90)), "turnaround"},
      {.id = "sdo-turnaround-250ms",
       .summary = "answers after 250 ms",
       .legal = "SDO-GEN-18, tolerated: T_SDO is one second",
       // A client that takes three times that for silence needs more than the usual second in between.
       .how = both(turnaround(milliseconds(250)),
                   choose([](SdoChoices& c) { c.time_out = milliseconds(1500); })),
       .group = "turnaround",
       .warns = {"SDO-GEN-18"}},
      {.id = "sdo-turnaround-400ms",
       .summary = "answers after 400 ms",
       .legal = "SDO-GEN-18, tolerated: T_SDO is one second",
       .how = slow_turnaround(milliseconds(400)),
       .group = "turnaround",
       .excludes = {"sdo-time-out"},
       .warns = {"SDO-GEN-18", "SDO-BDN-25"}},
      {.id = "sdo-turnaround-1200ms",
       .summary = "answers after 1.2 s",
       .legal = "CiA 301 sets no limit; SDO-GEN-18 is a recommendation",
       .how = slow_turnaround(milliseconds(1200)),
       .group = "turnaround",
       // Storing would take longer than T_NVM, and a day of heartbeats is more than a run records.
       .excludes = {"sdo-time-out", "storing-takes-9s", "1017-10ms"},
       // OD-1013-05 looks at a clock twice, and each look may take seconds.
       .warns = {"SDO-GEN-18", "SDO-BDN-25", "OD-1013-05"}},
      {.id = "sdo-busy-0504-0001",
       .summary = "a new initiate request while a transfer is open is refused with 0504 0001h and ends it",
       .legal = "SDO-SUP-11, -12, SDO-SDN-17, SDO-BUP-29, tolerated",
       .how = choose([](SdoChoices& c) { c.initiate_while_busy = abort_code::command_unknown; }),
       .group = "sdo-busy",
       .warns = {"SDO-SUP-11", "SDO-SUP-12", "SDO-SDN-17", "SDO-BUP-29", "SDO-BUP-25", "SDO-BDN-25",
                 "SDO-SUP-18", "SDO-SDN-25", "SDO-GEN-20"}},
      {.id = "sdo-busy-0800-0022",
       .summary = "a new initiate request while a transfer is open is refused with 0800 0022h and ends it",
       .legal = "SDO-SUP-11, -12, SDO-SDN-17, SDO-BUP-29, tolerated",
       .how = choose([](SdoChoices& c) { c.initiate_while_busy = abort_code::device_state; }),
       .group = "sdo-busy",
       .warns = {"SDO-SUP-11", "SDO-SUP-12", "SDO-SDN-17", "SDO-BUP-29", "SDO-BDN-21", "SDO-BUP-25",
                 "SDO-BDN-25", "SDO-SUP-18", "SDO-SDN-25", "SDO-GEN-20"}},
      {.id = "sdo-expedited-without-size",
       .summary = "expedited uploads do not tell their size (42h)",
       .legal = "SDO-UPL-01 to -04; OD-LEN-04 and OD-GEN-10 warn",
       .how = leave_out_size,
       .group = "sdo-size",
       .warns = {"OD-LEN-04", "OD-GEN-10"}},
      {"sdo-segmented-without-size", "segmented and block uploads do not tell their size (40h, C4h)",
       "SDO-SUP-02, SDO-BUP-04", choose([](SdoChoices& c) { c.upload_size_indicated = false; })},
      {"sdo-short-in-segments",
       "one to four bytes are uploaded in segments",
       "SDO-SUP-15, SDO-UPL-01 to -04",
       choose([](SdoChoices& c) { c.expedited_upload = false; }),
       "sdo-size",
       {"sdo-expedited-only"}},
      {.id = "sdo-expedited-only",
       .summary = "neither segmented nor block transfer, no object longer than four bytes",
       .legal = "SDO-SDN-01",
       .how = expedited_only,
       .group = "sdo-expedited-only",
       .excludes = {"manufacturer", "sdo-block", "1008"},
       .lacks = {"segmented sdo", "block sdo", "time consumer"},
       .warns = {"OD-ACC-08"}},
      {.id = "sdo-expedited-only-0601-0000",
       .summary = "the same, and a segmented download is refused by 0601 0000h, whatever its entry",
       .legal = "SDO-SDN-01; SDO-SDN-22 warns",
       .how =
           [](Parts& parts) {
             expedited_only(parts);
             parts.sdo.choices.no_segmented = abort_code::unsupported_access;
           },
       .group = "sdo-expedited-only",
       .excludes = {"manufacturer", "sdo-block", "1008"},
       .lacks = {"segmented sdo", "block sdo", "time consumer"},
       .warns = {"OD-ACC-08", "SDO-SDN-22", "SDO-SDN-23"}},
      {"sdo-segments-of-four-bytes",
       "segments of an upload carry four bytes each",
       "7.2.4.3.6: n tells how many bytes of a segment hold no data",
       choose([](SdoChoices& c) { c.upload_segment = 4; }),
       "upload-segment",
       {"sdo-expedited-only"}},
      // A description in single bytes takes a slow server hours.
      {"sdo-segments-of-one-byte",
       "segments of an upload carry one byte each",
       "7.2.4.3.6: n tells how many bytes of a segment hold no data",
       choose([](SdoChoices& c) { c.upload_segment = 1; }),
       "upload-segment",
       // What is stored by itself is read behind each reset: that may be more frames than a run records.
       {"sdo-expedited-only", "turnaround", "1010-autonomous", "1010-autonomous-at-once",
        "1010-autonomous-01-only", "1010-autonomous-03-only"}},
      {"sdo-toggle-errors-ignored", "a segment with the wrong toggle bit is ignored",
       "SDO-SUP-05, -06; SDO-SDN-04, -05", choose([](SdoChoices& c) { c.toggle_errors_ignored = true; })},
      {"sdo-toggle-errors-ignored-in-downloads",
       "a download segment with the wrong toggle bit is ignored, a request for the wrong one refused",
       "SDO-SUP-05, -06; SDO-SDN-04, -05",
       choose([](SdoChoices& c) { c.wrong_toggle_ignored_in_downloads = true; })},
      {.id = "sdo-block-absent",
       .summary = "no block transfer",
       .legal = "SDO-BUP-01, SDO-BDN-01",
       .how = choose([](SdoChoices& c) { c.block = false; }),
       .group = "sdo-block",
       .lacks = {"block sdo"}},
      {.id = "sdo-block-unknown",
       .summary = "no block transfer: a request for it is an unknown command, refused without a multiplexer",
       .legal = "SDO-BUP-01, SDO-BDN-01: 0504 0001h; SDO-ERR-04 is about an object",
       .how = block_transfer_unknown,
       .group = "sdo-block",
       .lacks = {"block sdo"}},
      {"sdo-block-upload-from-eight-bytes",
       "objects of up to seven bytes have no block upload: 0504 0001h",
       "7.2.4.2.12: optional",
       choose([](SdoChoices& c) { c.block_upload_from = 8; }),
       "sdo-block-upload",
       {"sdo-block", "sdo-expedited-only"}},
      {"sdo-block-upload-from-fifty-bytes",
       "objects of fewer than 50 bytes have no block upload: 0504 0001h",
       "7.2.4.2.12: optional",
       choose([](SdoChoices& c) { c.block_upload_from = 50; }),
       "sdo-block-upload",
       {"sdo-block", "sdo-expedited-only"}},
      // Somewhere there has to be a DOMAIN.
      {"sdo-block-download-of-domains",
       "block download of DOMAINs only: 0504 0001h for anything else",
       "7.2.4.2.9: optional",
       block_download_of_domains,
       {},
       {"sdo-block", "sdo-expedited-only", "manufacturer", "sdo-turnaround-400ms", "sdo-turnaround-1200ms"}},
      // Together they may take longer than T_SDO, or than the server has patience.
      {.id = "sdo-block-download-erases",
       .summary = "a block download is begun after 800 ms: the memory is erased first",
       .legal = "SDO-GEN-18: no limit is set",
       .how = both(erases_before_block_download(milliseconds(800)),
                   choose([](SdoChoices& c) { c.time_out = seconds(3); })),
       .excludes = {"sdo-block", "sdo-expedited-only", "turnaround", "sdo-time-out", "program-cycle-20ms",
                    "sdo-sequence-spoils"},
       .warns = {"SDO-BDN-25"}},
      // What waits is not seen by a variant that looks at requests as they come.
      {.id = "oldest-frame-in-5ms",
       .summary = "requests are looked at once in 5 ms, and one that finds another waiting is lost",
       .legal = "CiA 301 gives no times; a client waits for the answer before its next request",
       .how = oldest_request_in(milliseconds(5)),
       .group = "late",
       .excludes = {"turnaround", "nmt-latency", "analog-inputs-noisy", "sdo-busy-names-transfer"},
       .warns = {"SDO-BUP-17"}},
      {.id = "oldest-frame-in-20ms",
       .summary = "requests are looked at once in 20 ms, and one that finds another waiting is lost",
       .legal = "CiA 301 gives no times; a client waits for the answer before its next request",
       .how = oldest_request_in(milliseconds(20)),
       .group = "late",
       .excludes = {"turnaround", "nmt-latency", "analog-inputs-noisy", "sdo-time-out",
                    "sdo-busy-names-transfer", "sdo-block-download-erases", "sdo-gap-at-once",
                    "sdo-sequence-spoils"},
       .warns = {"SDO-BUP-17"}},
      {"sdo-block-without-crc", "no CRC in block transfers", "7.2.4.3.9: sc = 0",
       choose([](SdoChoices& c) { c.crc = false; })},
      {"sdo-no-protocol-switch", "never goes on with a normal upload", "SDO-BUP-15",
       choose([](SdoChoices& c) { c.protocol_switch = false; })},
      {"sdo-block-size-1", "sub-blocks of one segment", "SDO-BDN-01: 1 to 127",
       choose([](SdoChoices& c) { c.block_size = 1; }), "block-size"},
      {"sdo-block-size-7", "sub-blocks of seven segments", "SDO-BDN-01: 1 to 127",
       choose([](SdoChoices& c) { c.block_size = 7; }), "block-size"},
      {"sdo-block-size-21", "sub-blocks of 21 segments", "SDO-BDN-01: 1 to 127",
       choose([](SdoChoices& c) { c.block_size = 21; }), "block-size"},
      {"sdo-block-size-changes", "the first sub-block has ten segments, the others four",
       "7.2.4.3.11: in each acknowledge", choose([](SdoChoices& c) {
         c.block_size = 10;
         c.next_block_size = 4;
       }),
       "block-size"},
      {"sdo-block-size-shrinks", "the first sub-block has ten segments, the others three",
       "7.2.4.3.11: in each acknowledge", choose([](SdoChoices& c) {
         c.block_size = 10;
         c.next_block_size = 3;
       }),
       "block-size"},
      // Acknowledged at a gap, the rest of the sub-block that is on its way has numbers above the new size.
      {.id = "sdo-block-size-falls-to-1",
       .summary = "the first sub-block has 127 segments, the others one",
       .legal = "7.2.4.3.11: in each acknowledge",
       .how = choose([](SdoChoices& c) { c.next_block_size = 1; }),
       .group = "block-size",
       .excludes = {"sdo-gap-at-once"}},
      // The client has sent its sub-block out by the time a slow acknowledge comes, and the rest of it is
      // then taken for the begin of the next: only a quick server can do that, and only with one block size.
      {.id = "sdo-segments-checked-at-the-end",
       .summary = "a segmented download to what cannot be written is refused with its last segment",
       .legal = "SDO-SDN-21; SDO-SDN-22 warns",
       .how = segments_checked_at_the_end,
       .excludes = {"sdo-expedited-only"},
       .warns = {"SDO-SDN-22"}},
      {.id = "sdo-blocks-checked-at-the-end",
       .summary = "a block download to what cannot be written is refused at its end",
       .legal = "SDO-BDN-23, tolerated",
       .how = blocks_checked_at_the_end,
       .excludes = {"sdo-block", "sdo-expedited-only"},
       .warns = {"SDO-BDN-23"}},
      {.id = "sdo-gap-refused",
       .summary = "a segment of a block download that is not the next one is refused at once: 0504 0003h",
       .legal = "SDO-BDN-07, tolerated; table 22",
       .how = gap_refused,
       .excludes = {"sdo-gap-at-once", "sdo-sequence-ignored", "sdo-sequence-spoils", "sdo-block",
                    "block-code"},
       .warns = {"SDO-BDN-07", "SDO-BDN-08", "SDO-BDN-09"}},
      // A client that sends anything does not know which absent object a block download was begun for.
      {"sdo-abort-of-its-object-only",
       "an abort that names another object than that of the transfer ends nothing",
       "7.2.4.3.17: the abort names the object of the transfer",
       aborts_of_its_object,
       {},
       {"sdo-blocks-checked-at-the-end"}},
      {.id = "sdo-busy-names-transfer",
       .summary = "a new initiate request while a transfer is open is refused by an abort of that transfer",
       .legal = "SDO-SUP-11, -12, SDO-SDN-17, SDO-BUP-29, tolerated",
       .how = both(busy_names_the_transfer,
                   choose([](SdoChoices& c) { c.initiate_while_busy = abort_code::command_unknown; })),
       .group = "sdo-busy",
       .warns = {"SDO-SUP-11", "SDO-SUP-12", "SDO-SDN-17", "SDO-BUP-29", "SDO-BUP-25", "SDO-BDN-25",
                 "SDO-SUP-18", "SDO-SDN-25", "SDO-GEN-20"}},
      {"sdo-gap-at-once",
       "a gap in a sub-block is acknowledged at once",
       "SDO-BDN-07",
       choose([](SdoChoices& c) { c.ack_gap_at_once = true; }),
       {},
       {"turnaround", "sdo-block-size-changes", "sdo-block-size-shrinks"}},
      {"sdo-sequence-ignored",
       "a sequence number that cannot be is ignored",
       "SDO-BDN-10, SDO-BDN-11",
       choose([](SdoChoices& c) { c.invalid_sequence_ignored = true; }),
       {},
       {"sdo-block-size-1"}},
      {.id = "sdo-no-time-out",
       .summary = "a transfer stays open for ever",
       .legal = "SDO-SUP-18, SDO-SDN-25: at most one abort",
       .how = choose([](SdoChoices& c) { c.time_out.reset(); }),
       .group = "sdo-time-out",
       .warns = {"SDO-BDN-25"}},
      // Whoever answers late, or hands over a whole sub-block, would give up before the client can go on.
      {.id = "sdo-time-out-25ms",
       .summary = "a transfer ends after 25 ms of silence",
       .legal = "SDO-SUP-18, SDO-SDN-25; SDO-SUP-17 warns",
       .how = choose([](SdoChoices& c) { c.time_out = milliseconds(25); }),
       .group = "sdo-time-out",
       .excludes = {"turnaround", "program-cycle-20ms", "newest-frame-in-5ms", "sdo-sequence-spoils",
                    "sdo-sub-block-queued"},
       .warns = {"SDO-SUP-17"}},
      {.id = "sdo-time-out-200ms",
       .summary = "a transfer ends after 200 ms of silence",
       .legal = "SDO-SUP-18, SDO-SDN-25; SDO-SUP-17 warns",
       .how = choose([](SdoChoices& c) { c.time_out = milliseconds(200); }),
       .group = "sdo-time-out",
       .excludes = {"turnaround", "program-cycle-20ms", "newest-frame-in-5ms", "sdo-sequence-spoils"},
       .warns = {"SDO-SUP-17"}},
      // With answers that take half of that time two channels at once could not be kept open.
      {"sdo-time-out-500ms",
       "a transfer ends after 500 ms of silence",
       "SDO-SUP-18, SDO-SDN-25",
       choose([](SdoChoices& c) { c.time_out = milliseconds(500); }),
       "sdo-time-out",
       {"sdo-turnaround-250ms"}},
      {.id = "sdo-time-out-10s",
       .summary = "a transfer ends after 10 s of silence",
       .legal = "SDO-SUP-18, SDO-SDN-25",
       .how = choose([](SdoChoices& c) { c.time_out = seconds(10); }),
       .group = "sdo-time-out",
       .warns = {"SDO-BDN-25"}},
      {.id = "sdo-servers-absent",
       .summary = "the default SDO server only",
       .legal = "7.5.2.33: optional",
       .how = absent({0x1201, 0x1202}),
       .lacks = {"additional sdo servers"}},
      {.id = "sdo-client-absent",
       .summary = "no SDO client",
       .legal = "7.5.2.34: optional",
       .how = absent({0x1280}),
       .lacks = {"sdo client"}},
      {.id = "abort-command-0800-0000",
       .summary = "unknown commands and frames out of place are a general error",
       .legal = "SDO-SUP-08, SDO-SDN-16, SDO-BUP-21, SDO-BDN-22; SDO-ERR-01 warns",
       .how = code_at(out_of_place, abort_code::command_unknown, abort_code::general_error),
       .group = "command-code",
       .warns = {"SDO-ERR-01", "SDO-ERR-02"}},
      out_of_place_refused("abort-command-0602-0000", "frames out of place: no object",
                           abort_code::no_object),
      out_of_place_refused("abort-command-0606-0000", "frames out of place: hardware error",
                           abort_code::hardware_error),
      out_of_place_refused("abort-command-0800-0020", "frames out of place: cannot be transferred",
                           abort_code::cannot_store),
      out_of_place_refused("abort-command-0800-0021", "frames out of place: local control",
                           AbortCode(0x08000021)),
      {"sdo-reserved-bits-refused", "reserved bits of a block initiate are refused, without a multiplexer",
       "SDO-BUP-28, SDO-BDN-27: 0504 0001h; SDO-ERR-04 is about an object", refuse_reserved_bits},
      {"sdo-all-reserved-bits-refused",
       "a request with reserved bits in its command byte is refused: 0504 0001h",
       "7.2.4.3: reserved bits are 0 in what a client sends",
       choose([](SdoChoices& c) { c.reserved_bits_refused = true; }),
       {},
       // Another code for it would have to be named by each rule about reserved bits.
       {"sdo-reserved-bits-refused", "command-code"}},
      {.id = "sdo-former-mux-in-aborts",
       .summary = "what names no entry is refused with the multiplexer of the last that did",
       .legal = "7.2.4.3.17: an abort has a multiplexer, an unknown command has none; SDO-ERR-04 warns",
       .how = choose([](SdoChoices& c) { c.former_mux_in_aborts = true; }),
       .warns = {"SDO-ERR-04"}},
      {.id = "sdo-entry-looked-at-late",
       .summary =
           "a segmented or block download is begun whatever its entry is, and refused with its first segment",
       .legal = "7.2.4.3.17: an abort may come at any time; SDO-SDN-22, SDO-BDN-23 warn",
       .how = choose([](SdoChoices& c) { c.entry_looked_at_late = true; }),
       // Whether block download is offered is asked of the initiate, and what a filter has refused behind the
       // server's back would go on there.
       .excludes = {"sdo-block-download-of-domains", "sdo-reserved-bits-refused"},
       .warns = {"SDO-SDN-22", "SDO-BDN-23"}},
      {.id = "sdo-unsized-refused-late",
       .summary = "a download that does not tell its size is begun, and refused with its first segment",
       .legal = "7.2.4.3.17: an abort may come at any time; SDO-SDN-02, SDO-BDN-16 warn",
       .how = choose([](SdoChoices& c) { c.unsized_refused_late = true; }),
       .warns = {"SDO-SDN-02", "SDO-BDN-16"}},
      {.id = "sdo-first-segment-awaited",
       .summary =
           "where segment 1 of a sub-block is lost, the others are no segments, and 700 ms later none is acknowledged",
       .legal = "7.2.4.3.10: an acknowledge of 0",
       .how = choose([](SdoChoices& c) {
         c.first_segment_awaited = true;
         c.sub_block_time_out = milliseconds(700);
       }),
       // Beside a variant whose patience ends before.
       .warns = {"SDO-BDN-08"}},
      {.id = "abort-block-0504-0001",
       .summary = "block sizes and sequence numbers that cannot be are unknown commands",
       .legal = "SDO-BUP-09 to -12, SDO-BDN-10, -11, tolerated",
       .how = both(code_at({block_upload_initiate, block_upload_segment}, abort_code::block_size_invalid,
                           abort_code::command_unknown),
                   code_at({block_upload_segment, block_download_segment}, abort_code::sequence_invalid,
                           abort_code::command_unknown)),
       .group = "block-code",
       .warns = {"SDO-BUP-09", "SDO-BUP-10", "SDO-BUP-11", "SDO-BUP-12", "SDO-BDN-10", "SDO-BDN-11"}},
      {.id = "abort-block-0800-0000",
       .summary = "what block transfer refuses is a general error",
       .legal = "SDO-BUP-09 to -12, SDO-BDN-03, -10, -11, tolerated",
       .how = both(both(code_at({block_upload_initiate, block_upload_segment}, abort_code::block_size_invalid,
                                abort_code::general_error),
                        code_at({block_upload_segment, block_download_segment}, abort_code::sequence_invalid,
                                abort_code::general_error)),
                   code_at({block_download_end}, abort_code::crc_wrong, abort_code::general_error)),
       .group = "block-code",
       .warns = {"SDO-BUP-09", "SDO-BUP-10", "SDO-BUP-11", "SDO-BUP-12", "SDO-BDN-03", "SDO-BDN-10",
                 "SDO-BDN-11"}},
      {.id = "abort-toggle-0800-0021",
       .summary = "a wrong toggle bit: local control",
       .legal = "SDO-SUP-05, -06, SDO-SDN-04, -05, tolerated",
       .how = code_at({upload_segment, download_segment}, abort_code::toggle_not_alternated,
                      AbortCode(0x08000021)),
       .warns = {"SDO-SUP-05", "SDO-SUP-06", "SDO-SDN-04", "SDO-SDN-05", "SDO-ERR-08"}},
      {.id = "abort-segments-length-0609-0030",
       .summary = "more or fewer segments than announced: an invalid value",
       .legal = "SDO-SDN-06 to -10, SDO-BDN-12 to -15, tolerated",
       .how = both(code_at({download_segment, block_download_end, block_download_segment},
                           abort_code::length_too_high, abort_code::invalid_value),
                   code_at({download_segment, block_download_end}, abort_code::length_too_low,
                           abort_code::invalid_value)),
       .group = "segments-length",
       .warns = {"SDO-SDN-06", "SDO-SDN-07", "SDO-SDN-08", "SDO-SDN-09", "SDO-SDN-10", "SDO-SDN-14",
                 "SDO-SDN-27", "SDO-BDN-12", "SDO-BDN-13", "SDO-BDN-14", "SDO-BDN-15", "SDO-SDN-15",
                 "OD-LEN-01", "OD-LEN-02"}},
      {.id = "sdo-sub-block-queued",
       .summary = "the driver takes up to 64 segments of a sub-block of an upload at once",
       .legal = "SDO-BUP-17, tolerated: what is queued still comes",
       .how = choose([](SdoChoices& c) { c.sub_block_queued = true; }),
       .warns = {"SDO-BUP-17", "SDO-BUP-27"}},
      {"sdo-sequence-spoils",
       "after a sequence number that cannot be the sub-block is asked for again",
       "SDO-BDN-10, SDO-BDN-11: an acknowledge of 0",
       choose([](SdoChoices& c) { c.invalid_sequence_ignored = c.invalid_sequence_spoils = true; }),
       {},
       {"sdo-block-size-1", "sdo-sequence-ignored"}},
      {"abort-segments-too-long-0607-0010", "more segments than announced: wrong length",
       "SDO-SDN-06, -09, -10, -27",
       code_at({download_segment, block_download_end, block_download_segment}, abort_code::length_too_high,
               abort_code::length_mismatch),
       "segments-length"},
      {"abort-segments-too-short-0607-0010", "fewer segments than announced: wrong length",
       "SDO-SDN-07, -08, -14",
       code_at({download_segment, block_download_end}, abort_code::length_too_low,
               abort_code::length_mismatch)},
  };
}

}  // namespace refnode
