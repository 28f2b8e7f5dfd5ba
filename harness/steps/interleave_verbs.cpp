// SPDX-License-Identifier: Apache-2.0
// The verb `interleave`: SDO transfers on several channels at the same time.
#include "base/text.hpp"
#include "steps/sdo_step.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

class Interleave final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<Interleave>();
    const auto items = value.items();
    for (const auto& item : items) {
      auto fields = item.fields("transfer of 'interleave'");
      const auto verb = fields.exactly_one_of({"upload", "download"});
      if (!verb) continue;
      auto parsed = fields.has("upload") ? SdoStep::parse_upload(verb, context)
                                         : SdoStep::parse_download(verb, context);
      if (parsed) out->transfers_.push_back(std::move(*parsed));
    }
    if (value.node()->is_sequence() && items.size() < 2)
      value.error("'interleave' needs two transfers or more", "one alone is an upload or download");
    return out->transfers_.size() >= 2 ? std::move(out) : nullptr;
  }

  std::string words(Session& session) const override {
    std::vector<std::string> parts;
    for (const auto& transfer : transfers_) parts.push_back(transfer.words(session));
    return "at the same time: " + join(parts, "; ");
  }
  const ObjectReference* object() const override { return &transfers_.front().object(); }
  Need need() const override {
    Need most;
    for (const auto& transfer : transfers_) {
      if (const auto need = transfer.need(); !need.covered_by(most.tier)) most = need;
    }
    return most;
  }

  Measures measures() const override { return {"count"}; }
  Channels rests_on() const override {
    Channels out;
    for (const auto& transfer : transfers_) add_channels(out, transfer.rests_on());
    return out;
  }
  Result<Actual> run(Session& session) const override {
    std::vector<SdoJob> jobs;
    for (const auto& transfer : transfers_) {
      auto job = transfer.job(session);
      if (!job) return std::unexpected(job.error());
      jobs.push_back(std::move(*job));
    }
    auto answers = session.transfer(jobs);
    if (!answers) return std::unexpected(answers.error());
    // The first that did not go through tells; of those that did, the last to end is the evidence.
    std::optional<Actual> out;
    std::uint64_t confirmed = 0;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      auto actual = transfers_[i].conclude(session, jobs[i], (*answers)[i]);
      const bool good = actual.kind == Actual::Kind::confirmed || actual.kind == Actual::Kind::matched;
      if (good) ++confirmed;
      actual.has_data = false;
      if (!good) {
        const auto name = "transfer " + std::to_string(i + 1) + " (" + transfers_[i].words(session) + ")";
        actual.detail = name + ": " + actual.words();
      }
      const bool so_far_good = !out || out->kind == Actual::Kind::confirmed;
      if (!good ? so_far_good : (so_far_good && (!out || *out->decisive < *actual.decisive))) out = actual;
    }
    if (confirmed == jobs.size()) out->detail = "all confirmed";
    out->measured.clear();
    out->measured["count"] = confirmed;
    return *out;
  }

 private:
  std::vector<SdoStep> transfers_;
};

constexpr Verb table[] = {
    {"interleave", "Run SDO transfers on several channels at the same time, frame by frame in turn.",
     "a list of `upload: {...}` and `download: {...}`, each on a channel of its own (channel:)\nmeasured: count (transfers that went "
     "through)",
     "- interleave:\n    - upload: {object: 1000h:00, save: type}\n    - upload: {object: 1008h:00, channel: {request: 640h + N, response: "
     "5C0h + N}}\n  expect: ok",
     &Interleave::parse},
};

}  // namespace

std::span<const Verb> interleave_verbs() { return table; }

}  // namespace conform::steps
