// SPDX-License-Identifier: Apache-2.0
#include "engine/witness.hpp"

#include <algorithm>
#include <iterator>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/decode.hpp"
#include "canopen/sdo_initiate.hpp"
#include "result/services.hpp"

namespace conform::engine {
namespace {

using result::Verdict;
using steps::Actual;
using steps::Grade;
using steps::Outcome;
using steps::Step;

constexpr std::size_t evidence_before = 6;
constexpr std::size_t evidence_after = 2;
constexpr std::size_t evidence_in_silence = 6;

/// The entry a step is about, or the first of those it looks at.
std::optional<Multiplexer> object_of(const Step& step, RunSession& session) {
  if (step.action == nullptr) return std::nullopt;
  if (const auto* own = step.action->object()) {
    const auto object = own->resolve(session);
    return object ? std::optional(*object) : std::nullopt;
  }
  for (const auto& reference : step.action->concerns()) {
    if (const auto object = reference.resolve(session)) return *object;
  }
  return std::nullopt;
}

std::optional<canopen::DataType> type_of(const Step& step, RunSession& session) {
  if (step.action == nullptr || step.action->object() == nullptr) return std::nullopt;
  const auto object = object_of(step, session);
  const auto* entry = object ? session.dictionary().find(*object) : nullptr;
  return entry == nullptr ? std::nullopt : std::optional(entry->type);
}

/// The abort by which the server decided; nullopt: it was another frame, or none.
std::optional<AbortCode> deciding_abort(const Actual& actual, const RunSession& session) {
  if (!actual.decisive) return std::nullopt;
  const auto& frame = session.capture().frames()[*actual.decisive].frame;
  if (!frame.is_data(canopen::connection_set(session.node()).sdo_response)) return std::nullopt;
  const auto abort = canopen::decode_abort(frame.bytes());
  return abort ? std::optional(abort->code) : std::nullopt;
}

/// What the answer to an initiate request, or an abort, says it is about.
std::optional<Index> object_in_answer(const RunSession& session, std::size_t frame) {
  const auto& answer = session.capture().frames()[frame].frame;
  if (!answer.is_data(canopen::connection_set(session.node()).sdo_response) || answer.size() < 4)
    return std::nullopt;
  constexpr std::uint8_t upload = 0x40, download = 0x60, abort = 0x80;
  const auto command = answer.data[0];
  const bool names_object = (command & 0xF0U) == upload || command == download || command == abort;
  const auto index = static_cast<std::uint16_t>(load_le(ByteView(answer.data).subspan(1, 2)));
  return names_object && index != 0 ? std::optional(Index(index)) : std::nullopt;
}

/// An answer of another service than the request's, by the command specifiers of both: "60h after 40h". Empty
/// where they fit, and the content is what differs.
std::string foreign_answer(std::size_t decisive, const RunSession& session) {
  constexpr std::uint8_t specifier = 0xE0;
  constexpr std::pair<std::uint8_t, std::uint8_t> fitting[] = {{0x40, 0x40}, {0x20, 0x60}, {0x60, 0x00},
                                                               {0x00, 0x20}, {0xA0, 0xC0}, {0xC0, 0xA0}};
  const auto& frames = session.capture().frames();
  const auto sdo = canopen::connection_set(session.node());
  if (!frames[decisive].frame.is_data(sdo.sdo_response) || frames[decisive].frame.size() == 0) return {};
  const auto answer = static_cast<std::uint8_t>(frames[decisive].frame.data[0] & specifier);
  for (auto i = decisive; i-- > 0;) {
    const auto& frame = frames[i].frame;
    if (!frame.is_data(sdo.sdo_request) || frame.size() == 0) continue;
    const auto request = static_cast<std::uint8_t>(frame.data[0] & specifier);
    if (std::ranges::find(fitting, std::pair(request, answer)) != std::end(fitting)) return {};
    return hex(answer, 2) + " after " + hex(request, 2);
  }
  return {};
}

/// How what came differs, as a kind: what many parts of a device have in common when one thing is wrong with
/// it.
std::string deviation_of(const Step& step, const Actual& actual, RunSession& session) {
  const auto refusal = std::ranges::find_if(step.expectation.pass, [](const Outcome& outcome) {
    return outcome.kind == Outcome::Kind::abort_code || outcome.kind == Outcome::Kind::abort_any ||
           outcome.kind == Outcome::Kind::abort_defined;
  });
  // A conversation meets aborts as frames.
  const bool frames = actual.kind == Actual::Kind::mismatched || actual.kind == Actual::Kind::matched;
  if (frames && actual.decisive) {
    if (const auto abort = deciding_abort(actual, session)) return "abort " + to_string(*abort);
    if (actual.kind == Actual::Kind::mismatched) return foreign_answer(*actual.decisive, session);
  }
  const bool waits = step.action != nullptr && !step.action->acts();
  switch (actual.kind) {
    case Actual::Kind::confirmed: {
      // What it should have been refused for tells one fault from another.
      if (refusal != step.expectation.pass.end())
        return "confirmed instead of " + refusal->words(session, std::nullopt);
      const auto object = step.verb == "upload" ? object_of(step, session) : std::nullopt;
      if (!object || !session.before_last_write(*object)) return "";
      return session.write_was_refused() ? "a refused value is stored" : "not what was written";
    }
    case Actual::Kind::aborted: return "abort " + to_string(actual.code);
    case Actual::Kind::silence: return waits ? "no " + step.verb : "no answer";
    case Actual::Kind::violation: return "protocol violation";
    default: return "";
  }
}

}  // namespace

/// An answer that did not come, or that says that ours came too late.
bool is_late(const Actual& actual, const RunSession& session) {
  return actual.kind == Actual::Kind::silence || actual.code == canopen::abort::timed_out ||
         deciding_abort(actual, session) == canopen::abort::timed_out;
}

std::string Witness::declared_at(const Step& step, const Actual& actual) const {
  const auto& file = session_.profile().described_in;
  if (file.empty() || step.action == nullptr) return {};
  std::vector<Multiplexer> about;
  const auto add = [&](const steps::ObjectReference& reference) {
    if (const auto mux = reference.resolve(session_)) about.push_back(*mux);
  };
  if (step.action->object() != nullptr) add(*step.action->object());
  if (about.empty() && actual.decisive && *actual.decisive < session_.capture().size()) {
    // Of several transfers in one step it is the refused one that matters.
    const auto& frame = session_.capture().frames()[*actual.decisive].frame;
    const auto abort = frame.is_data(canopen::connection_set(session_.node()).sdo_response)
                           ? canopen::decode_abort(frame.bytes())
                           : std::nullopt;
    if (abort) about.push_back(abort->mux);
  }
  if (about.empty()) {
    for (const auto& reference : step.action->concerns()) add(reference);
  }
  if (about.empty() && walked_) about.push_back(*walked_);
  if (about.empty() && about_) about.push_back(*about_);
  std::vector<std::string> places;
  for (const auto mux : about) {
    auto place = session_.profile().place_of(mux);
    if (std::ranges::find(places, place) == places.end()) places.push_back(std::move(place));
  }
  if (places.empty()) {
    const auto words = step.action->words(session_);
    for (const auto& [asked, place] : session_.profile().described_places.info) {
      if (words.contains(asked)) places.push_back(place);
    }
  }
  if (places.empty()) {
    // What is awaited on the bus follows what was written before.
    const auto written = std::ranges::find_if(done_.rbegin(), done_.rend(), [](const Step* each) {
      return each->verb == "download" && each->action->object() != nullptr;
    });
    if (written != done_.rend()) {
      if (const auto mux = (*written)->action->object()->resolve(session_))
        places.push_back(session_.profile().place_of(*mux));
    }
  }
  return join(places, "; ");
}

result::Finding Witness::finding(const Step& step, const std::string& requirement, const Grade& grade,
                                 const Actual& actual) {
  const auto type = type_of(step, session_);
  result::Finding out;
  out.verdict = grade.verdict;
  out.requirement = requirement;
  out.position = {result_->position.file, step.position.line, step.position.column};
  out.step = step.action != nullptr ? step.action->words(session_)
                                    : "over " + (step.walk ? step.walk->name : step.verb);
  if (step.branches.empty()) {
    const auto success = step.action != nullptr ? step.action->success_words() : std::string("success");
    const auto& accepted = step.expectation.pass;
    if (accepted.size() <= 1 && std::ranges::all_of(accepted, [](const Outcome& outcome) {
          return outcome.kind == Outcome::Kind::ok;
        })) {
      out.accepts = {success};
    } else {
      out.accepts = step.expectation.pass_words(session_, type);
    }
    out.tolerates = step.expectation.warn_words(session_, type);
  } else {
    for (const auto& branch : step.branches) {
      for (const auto& outcome : branch.on) {
        auto& set = branch.verdict == Verdict::pass ? out.accepts : out.tolerates;
        if (branch.verdict != Verdict::fail) set.push_back(outcome.words(session_, type));
      }
      if (branch.on.empty()) out.accepts.push_back(branch.steps.front().action->words(session_));
    }
  }
  out.actual = actual.words();
  out.actual_bytes.assign(actual.data.begin(), actual.data.end());
  out.reason = grade.reason;
  out.declared_at = declared_at(step, actual);
  attribution_.follow(session_.capture().frames());
  out.broken_rules = attribution_.rules_broken(actual);
  if (const auto object = object_of(step, session_)) out.object = object->index;
  if (!out.object && actual.decisive) out.object = object_in_answer(session_, *actual.decisive);
  out.deviation = deviation_of(step, actual, session_);
  out.listened = listened(actual);
  out.evidence = evidence(result_->first_frame, step_begin_, actual.decisive, out.listened);
  out.frames_seen = session_.capture().size();
  out.rests_on_time = timed_;
  out.prepared = prepared(step);
  return out;
}

std::vector<std::string> Witness::prepared(const Step& deciding) const {
  constexpr std::size_t most = 8;
  std::vector<const Step*> told;
  for (auto at = done_.rbegin(); at != done_.rend() && told.size() < most; ++at) {
    if (*at != &deciding) told.push_back(*at);
  }
  std::vector<std::string> out;
  for (auto at = told.rbegin(); at != told.rend(); ++at) out.push_back((*at)->action->words(session_));
  return out;
}

std::optional<result::Listening> Witness::listened(const Actual& actual) const {
  if (actual.listened) return actual.listened;
  if (actual.kind != Actual::Kind::silence) return std::nullopt;
  auto from = step_began_at_;
  const auto& frames = session_.capture().frames();
  // The request that nobody answered.
  if (actual.decisive) return result::Listening{frames[*actual.decisive].time, session_.now()};
  for (auto i = step_begin_; i < frames.size(); ++i) {
    if (frames[i].direction == can::Direction::transmitted) from = frames[i].time;
  }
  return result::Listening{from, session_.now()};
}

std::vector<result::EvidenceFrame> Witness::evidence(std::size_t first_frame, std::size_t begin,
                                                     std::optional<std::size_t> decisive,
                                                     const std::optional<result::Listening>& listened) const {
  std::vector<result::EvidenceFrame> out;
  const auto& frames = session_.capture().frames();
  if (frames.empty()) return out;
  auto centre = decisive.value_or(frames.size() - 1);
  auto behind = evidence_after;
  // Of a silence what was to be answered, and what came instead.
  const bool is_silence =
      listened && (!decisive || frames[*decisive].direction == can::Direction::transmitted);
  if (is_silence) behind = evidence_in_silence;
  if (is_silence && !decisive) {
    while (centre > first_frame && frames[centre].time > listened->from) --centre;
  }
  auto first = std::max(first_frame, centre > evidence_before ? centre - evidence_before : 0);
  if (begin >= first && begin <= centre && centre - begin < evidence_before)
    first = std::max(first_frame, begin > 2 ? begin - 2 : 0);
  const auto last = std::min(frames.size() - 1, centre + behind);
  // The decoder must see the case from its beginning to name segments.
  canopen::Decoder decoder(session_.node());
  decoder.set_emcy_can_id(session_.emcy_can_id());
  for (auto i = first_frame; i <= last; ++i) {
    auto meaning = decoder.meaning(frames[i].frame, frames[i].direction);
    if (i < first) continue;
    result::EvidenceFrame frame;
    frame.frame = frames[i].frame;
    frame.time = frames[i].time;
    frame.direction = frames[i].direction;
    frame.capture_index = i;
    frame.meaning = std::move(meaning);
    frame.decisive = decisive == i;
    out.push_back(std::move(frame));
  }
  return out;
}

std::optional<std::string> Witness::rule_below(const std::string& requirement, const Actual& actual,
                                               const scenario::Catalogue& catalogue) {
  attribution_.follow(session_.capture().frames());
  const auto depth = result::depth_of_requirement(requirement);
  for (auto& rule : attribution_.rules_below(actual)) {
    if (rule == requirement) return std::nullopt;
    if (result::depth_of_requirement(rule) < depth && catalogue.find(rule) != nullptr) return std::move(rule);
  }
  return std::nullopt;
}

}  // namespace conform::engine
