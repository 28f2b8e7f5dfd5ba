// SPDX-License-Identifier: Apache-2.0
// What a run leaves behind: plain data. Reports see this and the capture, nothing else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/strong.hpp"
#include "base/time.hpp"
#include "can/frame.hpp"
#include "can/transport.hpp"
#include "result/listening.hpp"
#include "result/verdict.hpp"

namespace conform::result {

/// One frame of the evidence of a finding, already decoded into words.
struct EvidenceFrame {
  can::Frame frame;
  BusTime time;
  can::Direction direction = can::Direction::received;
  std::size_t capture_index = 0;
  std::string meaning;    ///< "SDO upload 1003h:00 -> abort 0609 0030h invalid value"
  bool decisive = false;  ///< the frame that decided the verdict
};

/// Where a step stands in its scenario file.
struct SourcePosition {
  std::string file;  ///< as the user named it, relative to the suite's root
  int line = 0;      ///< 1-based
  int column = 0;    ///< 1-based
};

/// One expectation that did not simply pass, with all that is needed to understand it.
struct Finding {
  Verdict verdict = Verdict::fail;
  std::string requirement;  ///< empty for a set-up step
  SourcePosition position;
  std::string step;                        ///< the step in words: "download 1003h:00 = 02h"
  std::vector<std::string> accepts;        ///< outcomes that pass, in words
  std::vector<std::string> tolerates;      ///< outcomes that warn, in words
  std::string actual;                      ///< what came, in words
  std::vector<std::uint8_t> actual_bytes;  ///< data or frame bytes behind `actual`, may be empty
  std::string reason;                      ///< why this verdict, one sentence
  std::vector<EvidenceFrame> evidence;
  std::string declared_at;  ///< "device.eds:120", where the description of the device tells of the entry; may
                            ///< be empty
  std::string during;       ///< of monitors: the case that ran meanwhile; empty: none, or not known
  // What findings are grouped by (result/causes.hpp).
  std::optional<Index> object{};  ///< the object the step is about
  std::string
      deviation{};  ///< how it differs, without values that tell nothing about the cause: "abort 0800 0000h"
  std::vector<std::string>
      broken_rules{};  ///< rules that the deciding frame breaks by itself, as the monitors see it
  std::size_t frames_seen =
      0;  ///< length of the capture when it was judged: what came later shows that the device lived
  /// The step, or one before it in the case, waits, counts time or hears a silence: in doubt when the host
  /// was late.
  bool rests_on_time = false;
  /// Of a step that waits, and of a request that was not answered.
  std::optional<Listening> listened{};
  /// What the case had done to the device until then, in words; of many steps the last.
  std::vector<std::string> prepared{};
};

/// The step that decided a judgement: the one a reader looks at to agree or disagree.
struct DecidingStep {
  SourcePosition position;
  std::string step;    ///< in words: "upload 1003h:00"
  std::string actual;  ///< what came, in words
  std::optional<std::size_t>
      frame{};  ///< capture index of the frame that decided; none: a silence, a condition
};

/// The unit of judgement: one requirement in one case.
struct Judgement {
  std::string requirement;
  Verdict verdict = Verdict::pass;
  std::vector<Finding> findings;
  std::size_t expectations = 0;  ///< how many expectations decided it
  std::size_t frames_seen = 0;   ///< length of the capture when it was last judged
  /// Always there where the verdict is `pass`: a pass is earned by a step that was carried out and met.
  /// Monitors decide by the whole trace and name no step.
  std::optional<DecidingStep> decided_by{};
  /// Why it is not applicable or inconclusive, where that is not the case's own reason.
  std::string reason{};
  /// Why this failure is accepted, and by whom; its verdict is then `waived`.
  std::string waived{};
};

/// What a case wants that was left out for want of time.
inline constexpr std::string_view longer_budget = "a longer --budget, or none";

/// What the user could give so that a case is judged.
struct Want {
  std::string kind;  ///< "object", "profile", "claim", "description", "option", "bench"
  std::string text;  ///< "a writable string or DOMAIN of 29 bytes or more"
  friend auto operator<=>(const Want&, const Want&) = default;
};

/// One scenario instance, planned or run.
struct CaseResult {
  std::string id;        ///< "cia301/dictionary/1003-error-history/non-zero-write"
  std::string instance;  ///< "02h"; empty when the scenario has one instance only
  std::string title;
  std::string suite;  ///< path of the file without extension: "cia301/dictionary/1003-error-history"
  SourcePosition position;
  std::vector<std::string> requirements;  ///< every id the case can judge
  std::vector<std::string> cct;           ///< numbers of the matching cases of CiA's own tool
  std::vector<Judgement> judgements;
  std::vector<Finding> setup_findings;  ///< set-up steps that failed
  Verdict verdict = Verdict::error;     ///< planned cases start as "not run", an error
  std::string reason = "not run";       ///< for not_applicable, inconclusive, error
  std::string rests_on{};  ///< of an inconclusive case: the requirement whose failure left it without ground
  std::vector<Want> wants{};  ///< of a case that is not applicable for want of something; all are needed
  std::string tried{};        ///< "2 times: the host was late ..."; empty: once
  bool finished = false;
  BusTime begin;
  BusTime end;
  std::size_t first_frame = 0;  ///< range [first_frame, end_frame) of the capture
  std::size_t end_frame = 0;

  /// id, followed by "[instance]" where there is one.
  [[nodiscard]] std::string name() const { return instance.empty() ? id : id + "[" + instance + "]"; }
};

/// A requirement as reports print it.
struct RequirementInfo {
  std::string id;
  std::string clause;  ///< "CiA 301 v4.2.0, 7.5.2.4"
  std::string level;   ///< mandatory, conditional, optional, recommended
  std::string area;    ///< group for the summary: "Pre-defined error field (1003h)"
  std::string statement;
};

/// A named fact about device, bus or run, printed in this order.
struct Property {
  std::string name;   ///< dotted: "dut.node_id", "can.interface", "run.seed"
  std::string value;  ///< may hold anything the device sent; every writer sanitises
};

/// What the scenarios here say for one case of another tool, CiA's.
struct ComparedCase {
  std::string number;  ///< "2.10"
  std::string group, title;
  std::string outcome;             ///< passed, warning, failed, skipped, not decided, no counterpart
  std::string because;             ///< one sentence; empty for what passed
  std::vector<std::string> cases;  ///< names of the cases here that it rests on
};

/// One value of a series: when it was measured, and how long it was.
struct Sample {
  BusTime at;
  Duration value{};
  friend auto operator<=>(const Sample&, const Sample&) = default;
};

/// Times of one kind that the run saw, whatever it judged.
struct Measurement {
  std::string kind;                   ///< "SDO answer", "heartbeat", "boot-up", "SYNC", "TPDO"
  std::string of;                     ///< the object, the CAN-ID or the setting: "1018h:01", "1017h = 100 ms"
  std::optional<Duration> nominal{};  ///< what the device was told or is said to keep
  std::optional<Duration> least{}, most{};  ///< what is tolerated
  std::size_t count = 0;                    ///< how many there were
  Duration shortest{}, longest{}, mean{};   ///< of all of them
  std::vector<Sample> samples{};            ///< every one, or of very many a part, evenly drawn
};

/// A stretch of the run and what the bus carried meanwhile.
struct BusLoad {
  BusTime from;
  Duration span{};
  std::size_t frames = 0;
  Duration busy{};  ///< the time that these frames take at the bit rate of the bus; 0: it is not known
};

/// An entry of the device that the run changed.
struct Change {
  Multiplexer object;
  std::vector<std::uint8_t> before;
  std::string during;     ///< the case that changed it first
  bool put_back = false;  ///< it holds `before` again
};

/// What `EntryFacts::presence` says.
inline constexpr std::string_view present = "present", absent = "absent", unanswered = "no answer",
                                  not_looked_at = "not looked at";

/// An entry of the object dictionary: what is said of it, and what the device showed at the start of the run.
struct EntryFacts {
  Multiplexer object;
  std::string name;
  std::string said_by;                   ///< who tells of it: "device.eds:120", "device profile", "CiA 301"
  bool claimed = false;                  ///< that says that it is there: an absent one is a difference
  std::string type;                      ///< "UNSIGNED32"
  std::string access;                    ///< "rw", "const", "rw or ro"
  bool mappable = false;                 ///< into PDOs
  std::string low, high, default_value;  ///< in words; empty: not said
  std::optional<std::size_t> length{};   ///< bytes of the type; none: it varies
  std::string presence{not_looked_at};   ///< present, absent, no answer, not looked at
  std::string refusal;                   ///< why it could not be read, in words
  std::optional<std::size_t> size{};     ///< bytes that the device said it delivers
  std::string value;                     ///< what it held, in words; of a long one the beginning
};

/// A failure that somebody answers for, and what became of it in the run.
struct WaiverUse {
  std::string requirement;
  std::string case_name;          ///< pattern; empty: every case
  std::optional<Index> object{};  ///< only findings about it
  std::string reason, owner, ticket;
  std::string expires;                        ///< "2027-03-31", the last day; empty: for ever
  std::string place;                          ///< "waivers.yaml:7"
  std::vector<std::string> cases;             ///< whose failure it covers
  std::string state{};                        ///< "used", "expired", "not needed any more: ..."
  Verdict verdict = Verdict::not_applicable;  ///< waived: used; warn: to be looked at; fail: it fails the run
};

/// A cause that shows as a known mistake does (result/patterns.hpp).
struct Likeness {
  std::string requirement, case_name;  ///< of the cause: its primary finding
  std::string name;                    ///< id of a defect of the reference node
  std::string summary;                 ///< what is wrong there, in words
  int percent = 0;                     ///< how alike they are; 100: all that both could show
};

struct Counts {
  std::size_t pass = 0, waived = 0, warn = 0, fail = 0, inconclusive = 0, not_applicable = 0, error = 0;
  [[nodiscard]] std::size_t total() const {
    return pass + waived + warn + fail + inconclusive + not_applicable + error;
  }
  void add(Verdict verdict);  ///< one more of it
  Counts& operator+=(const Counts& more);
};

struct RunResult {
  std::string tool;                 ///< "canopen-conform 0.1.0"
  std::string host;                 ///< host name; fixed in simulation
  std::int64_t started_utc_ns = 0;  ///< 0 (1970-01-01) in simulation
  Duration elapsed{};               ///< bus time
  std::string device;               ///< what to call the device under test in headings
  std::vector<Property> properties;
  std::vector<CaseResult> cases;
  std::vector<RequirementInfo> requirements;  ///< those the cases mention, sorted by id
  std::vector<std::string> notes;             ///< remarks about the run as a whole
  std::optional<std::string> aborted;         ///< why the run stopped early
  int signal = 0;                             ///< SIGINT or SIGTERM that ended it, else 0
  std::vector<std::string> unwritten{};       ///< reports that could not be written, with the reason
  std::vector<ComparedCase> compared{};       ///< in the order of the other tool; empty: not asked for
  std::vector<Measurement> measurements{};    ///< by kind, then by what they are of
  std::vector<BusLoad> load{};                ///< over the run, in stretches of one length
  std::vector<Change> changes{};              ///< in the order in which they were made, each entry once
  std::vector<WaiverUse> waivers{};           ///< in the order in which they are written down
  std::vector<EntryFacts> dictionary{};       ///< ascending; empty: the device was not surveyed
  std::vector<Likeness> likenesses{};         ///< by cause, then the most alike first

  [[nodiscard]] Counts counts() const;
  /// Requirements whose failure is waived, sorted, each once: a run with some does not simply conform.
  [[nodiscard]] std::vector<std::string> waived() const;
  /// Cases were left out for want of time (--budget).
  [[nodiscard]] bool without_time() const;
  /// A waiver has expired or, with --strict, asks for a look: that fails the run by itself.
  [[nodiscard]] bool has_wrong_waiver() const;
  [[nodiscard]] const RequirementInfo* requirement(const std::string& id) const;
};

/// 0 everything planned was judged and nothing failed; 1 a requirement failed; 2 nothing applicable; 3 no
/// failure, but something is inconclusive or the environment failed; 130/143 ended by a signal.
[[nodiscard]] int exit_code(const RunResult& run);

}  // namespace conform::result
