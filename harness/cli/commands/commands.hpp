// SPDX-License-Identifier: Apache-2.0
// The sub-commands: options in, exit code out. They are the only code that prints, besides the reference
// node's main.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/run/choice.hpp"

namespace conform::device {
struct Profile;
}
namespace conform::result {
struct RunResult;
}

namespace conform::cli {

struct LoadedSuites;
struct Proof;

inline constexpr int exit_usage = 2;
inline constexpr int exit_environment = 3;

/// Files of reports, by the name of the format; empty: not asked for.
using Reports = std::map<std::string, std::string>;

struct RunCommand {
  std::vector<std::string> select;
  std::vector<std::string> requirements;
  std::vector<std::string> exclude;
  std::vector<std::string> suites;
  std::string interface;
  bool simulate = false;
  std::vector<std::string> defects;   ///< of the simulated reference node
  std::vector<std::string> variants;  ///< legal ones, of the same node
  std::optional<std::uint32_t> node;
  std::vector<std::uint32_t> nodes;  ///< several, one after the other; then `node` is none
  std::string device;                ///< profile file
  std::string eds;                   ///< description of the device
  std::string allow;                 ///< risk tier; empty: by interface
  std::uint64_t seed = 1;
  std::string shuffle;               ///< "true": a random order by `seed`; a number: by this one
  std::vector<std::string> waivers;  ///< files
  bool strict = false;
  bool all_objects = false;
  bool cct = false;  ///< the cases of CiA's tool, in its order
  Choice choice;
  std::string wait_for_bus = "10 s";  ///< how long a run waits for a bus that went away
  double timeout_scale = 1;           ///< of all times of the profile
  bool slow = false;
  bool dry_run = false;
  bool annotate = false;  ///< workflow commands of GitHub Actions
  bool quiet = false;
  std::string color = "auto";  ///< auto, always, never
  Reports reports;
  std::string capture, candump;
  std::string captures;  ///< folder for one capture per cause
  std::string bundle;    ///< archive with all of it; empty: none
  std::string sign;      ///< private key that signs it; empty: not signed
  std::string journal;   ///< file; empty: the usual place
  std::string command;   ///< the command line itself, for the reports
  std::string baseline;  ///< result.json or journal of an earlier run: red is only what is new; empty: none
};
/// `done` may be null: what the run found; nothing where it was refused, or was only planned.
[[nodiscard]] int run_command(const RunCommand& options, std::optional<result::RunResult>* done = nullptr);
/// The same for each of `nodes`, with a report for each and one for all: the exit code is that of the matrix.
[[nodiscard]] int run_nodes(const RunCommand& options);

struct DoctorCommand {
  std::string interface;  ///< empty: all are told
  bool simulate = false;
  bool ask = false;  ///< every node-ID for 1000h
  std::uint32_t listen_ms = 2000;
  std::string color = "auto";
};
/// 0: the bus can be used; 3: it cannot, and why was told.
[[nodiscard]] int doctor_command(const DoctorCommand& options);

struct InitCommand {
  std::string interface;
  bool simulate = false;               ///< the reference node
  std::optional<std::uint32_t> node;   ///< absent: the only one that answers; in the simulation 5
  std::string output = "device.yaml";  ///< "-": standard output
  bool force = false;                  ///< write over a file that is there
  std::string allow = "read-only";     ///< the highest tier; from config on the device is reset
  std::vector<std::string> ranges;     ///< as ScanCommand::ranges
};
/// 0: the profile is written; exit_environment: the bus, or no device answers.
[[nodiscard]] int init_command(const InitCommand& options);

struct ReportCommand {
  std::vector<std::string> sources;  ///< result.json or journal; several are merged
  bool merge = false;                ///< parts of a run become the run, several devices a matrix
  Reports reports;  ///< all empty, and no capture and bundle: those that the run was asked for
  std::string capture;
  std::string captures;  ///< folder; from `capture`
  std::string bundle, sign;
  bool quiet = false;
  std::string color = "auto";
};
/// The exit code of the run that the journal tells of.
[[nodiscard]] int report_command(const ReportCommand& options);

struct VerifyCommand {
  std::string bundle;   ///< file
  std::string key;      ///< public key; empty: the signature is not looked at
  std::string extract;  ///< folder; empty: nothing is unpacked
  bool json = false;
};
/// 0: it is as it was sealed; 1: it is not, or is not signed by the key; exit_usage: it is none.
[[nodiscard]] int verify_command(const VerifyCommand& options);

struct WaiveCommand {
  std::string result;  ///< result.json or journal of the run that failed
  std::string requirement, case_name, object;
  std::string reason, owner, ticket, expires;
  std::string file = "waivers.yaml";  ///< to which the entry is added
};
/// 0: it is written; exit_usage: nothing of the run is covered by it, or the file cannot take it.
[[nodiscard]] int waive_command(const WaiveCommand& options);

struct CompareCommand {
  std::string before, after;    ///< result.json or journal
  std::string format = "text";  ///< text, markdown, json
  std::string html;             ///< file of the page, beside what is printed; empty: none
  bool strict = false;          ///< new warnings are worse
  std::string color = "auto";
};
/// 0: the same, better, or different only; 1: worse; exit_environment: not worse as far as it was judged.
[[nodiscard]] int compare_command(const CompareCommand& options);

struct RecoverCommand {
  std::string journal;    ///< empty: the usual place for interface and node
  std::string interface;  ///< empty: that of the journal
  std::optional<std::uint32_t> node;
  std::string device, eds;  ///< instead of those that the run was given
  bool all = false;         ///< also what has been put back already
  bool no_store = false;    ///< leave alone what outlives a reset
};
[[nodiscard]] int recover_command(const RecoverCommand& options);

struct ScanCommand {
  std::string interface;
  bool simulate = false;  ///< the reference node
  std::string twin;       ///< device description: with `simulate` the node is its twin
  std::optional<std::uint32_t> node;
  std::vector<std::string> ranges;  ///< "2000h..2FFFh"; empty: all that devices use
  std::string allow = "read-only";  ///< the highest tier: what it lets be written gets its own value back
  std::string compare;              ///< description to compare with; empty: none
  std::string format = "text";      ///< of the comparison: text or json
  std::string output;  ///< file of the draft; empty: standard output, or none beside a comparison
};
/// With `compare` 1 where device and description differ, else 0.
[[nodiscard]] int scan_command(const ScanCommand& options);

struct LssScanCommand {
  std::string interface;
  std::uint32_t simulate = 0;           ///< so many reference nodes without node-ID
  std::optional<std::uint32_t> assign;  ///< the first node-ID to give; absent: none is given
  std::uint32_t timeout_ms = 100;       ///< how long an answer may take
};
[[nodiscard]] int lss_scan_command(const LssScanCommand& options);

struct JudgeCommand {
  std::string capture;  ///< pcapng or candump log
  std::vector<std::string> select;
  std::vector<std::string> requirements;
  std::vector<std::string> exclude;
  std::vector<std::string> suites;
  std::optional<std::uint32_t> node;
  std::string profile;               ///< device profile file
  std::string eds;                   ///< description of the device
  std::string interface;             ///< of a capture with several
  std::vector<std::string> waivers;  ///< files
  bool strict = false;
  bool quiet = false;
  std::string color = "auto";
  std::string command;  ///< the command line itself, for the reports
  Reports reports;
  std::string bundle, sign;
};
[[nodiscard]] int judge_command(const JudgeCommand& options);

struct ReplayCommand {
  std::string capture;    ///< pcapng or candump log
  std::string case_name;  ///< as reports name it, with its instance; empty: `frames`
  std::string frames;     ///< "120-180", from 1
  std::string interface;
  bool simulate = false;
  std::vector<std::string> defects;   ///< of the simulated reference node
  std::vector<std::string> variants;  ///< legal ones, of the same node
  std::optional<std::uint32_t> node;  ///< absent: the one that the frames speak to
  std::string device, eds;            ///< profile and description of the device
  std::string allow;                  ///< risk tier; empty: by interface
  std::uint64_t seed = 1;             ///< of the simulation
  std::string record;                 ///< file for the frames of the replay
  bool quiet = false;                 ///< print only what differs
  std::string color = "auto";
};
/// 0: the same answers; 1: other ones; exit_environment: the bus failed, nothing was heard, or nothing was
/// there to be compared.
[[nodiscard]] int replay_command(const ReplayCommand& options);

struct LintCommand {
  std::vector<std::string> files;  ///< empty: all of the suites
  std::vector<std::string> suites;
  std::string color = "auto";
};
[[nodiscard]] int lint_command(const LintCommand& options);

struct EdsLintCommand {
  std::vector<std::string> files;     ///< and folders
  std::vector<std::string> allow;     ///< codes of rules that are off
  std::vector<std::string> severity;  ///< "EDS210=note"
  std::string config;                 ///< instead of the .canopen-conform.yaml that is found
  bool no_config = false;
  std::string baseline;         ///< file of findings that are known, or empty
  bool write_baseline = false;  ///< put what is found into it
  bool fix = false;             ///< mend what is mechanical
  bool dry_run = false;         ///< only show what would be mended
  bool verbose = false;         ///< findings alike one by one
  std::string rules_uri;        ///< where docs/eds-lint.md is published
  std::string format = "text";  ///< text, json, github, sarif
  bool strict = false;          ///< warnings count as errors
  bool rules = false;           ///< print the page of all rules instead
  std::string color = "auto";
};
/// 0: no errors; 2: errors, or usage and configuration; 3: no errors, but a file cannot be read or written.
[[nodiscard]] int eds_lint_command(const EdsLintCommand& options);

struct EdsShowCommand {
  std::string file;
  std::string format = "text";  ///< text, json
  std::string html;             ///< file of the page to write instead; empty: none
};
[[nodiscard]] int eds_show_command(const EdsShowCommand& options);

struct EdsDiffCommand {
  std::string before, after;
  std::string format = "text";  ///< text, json
  bool file_info = false;       ///< what only describes the file counts, too
};
/// 0: they say the same; 1: they do not.
[[nodiscard]] int eds_diff_command(const EdsDiffCommand& options);

struct ListCommand {
  std::vector<std::string> select;
  std::vector<std::string> requirements;
  std::vector<std::string> suites;
  bool cct = false;
};
[[nodiscard]] int list_command(const ListCommand& options);

struct ExplainCommand {
  std::vector<std::string> topics;
  bool markdown = false;  ///< of verbs: the page docs/verbs.md
  std::vector<std::string> suites;
};
[[nodiscard]] int explain_command(const ExplainCommand& options);

struct SelftestCommand {
  std::vector<std::string> suites;
  std::uint64_t seed = 1;
  bool verbose = false;
  std::vector<std::string> defects;
  bool whole = false;
  bool blame = false;
  std::size_t pairs = 0;            ///< with blame
  std::string blame_page;           ///< file for docs/blame.md
  std::string worth;                ///< file for suites/patterns/worth.json
  std::string patterns;             ///< file for suites/patterns/reference-node.json
  std::string budget;               ///< instead of the kill matrix: what a run of this time finds
  bool variants = false;            ///< legal variants instead of the defects: none may be failed
  bool full = false;                ///< the defects with blame, and legal variants and edits beside them
  bool edits = false;               ///< edits of every entry of the dictionary instead of the defects
  bool mutants = false;             ///< mutants instead of the defects
  std::vector<std::string> mutant;  ///< with mutants: only these numbers, rooms, files
  std::size_t sample = 0;           ///< with mutants: so many, drawn by the seed
  bool quick = false;               ///< with mutants: without the scenarios that take long
  unsigned jobs = 0;                ///< 0: the machine's cores
  std::string markdown;             ///< file for docs/proof.md, with mutants for docs/mutants.md
  std::string html;                 ///< file of the page
};
[[nodiscard]] int selftest_command(const SelftestCommand& options);
/// Its --mutants; what became of them is added to the proof.
[[nodiscard]] int mutants_command(const SelftestCommand& options, const device::Profile& profile,
                                  const LoadedSuites& suites, Proof& proof);

/// Hidden: benchmark helpers used by scripts/benchmark.
struct BenchCommand {
  std::vector<std::string> suites;
  std::string interface;
  std::uint32_t node = 5;
  std::uint64_t round_trips = 20000;
  std::uint64_t bytes = 0;     ///< throughput instead: of a block transfer, at most 1 MiB
  std::uint32_t simulate = 0;  ///< throughput on a simulated bus of this bit rate
};
[[nodiscard]] int bench_command(const BenchCommand& options);

}  // namespace conform::cli
