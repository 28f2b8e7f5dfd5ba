// SPDX-License-Identifier: Apache-2.0
#include "cli/replay/differences.hpp"

#include <algorithm>
#include <chrono>
#include <map>

#include <fmt/format.h>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "canopen/decode.hpp"

namespace conform::cli {
namespace {

using can::Direction;

/// Which frames are one kind, and what of them is compared beside their number.
struct Kind {
  enum class Content : std::uint8_t {
    events,  ///< each for itself, in their order
    late,    ///< the same, but those of then may answer what was asked before the section begins
    states,  ///< which contents there are
    length,  ///< only the lengths: values of the process, counters, the time
  };
  std::string name;
  Content content = Content::length;
  std::string not_compared{};
};

constexpr std::uint32_t error_control = 0x700;

/// nullopt: it is nothing of the device under test.
std::optional<Kind> kind_of(const can::Frame& frame, const std::string& meaning, NodeId node) {
  const auto is = [&meaning](std::string_view what) { return meaning.starts_with(what); };
  if (!frame.extended && frame.id > error_control && frame.id <= error_control + 127) {
    if (frame.id != error_control + node.value()) return std::nullopt;
    if (is("boot-up")) return Kind{fmt::format("boot-up of node {}", node.value()), Kind::Content::events};
    return Kind{fmt::format("heartbeat of node {}", node.value()), Kind::Content::states, "when each comes"};
  }
  // The pre-defined CAN-IDs of emergency messages and PDOs of other nodes.
  constexpr std::uint32_t first_of_nodes = 0x081, last_of_nodes = 0x57F, node_bits = 0x7F;
  if (!frame.extended && frame.id >= first_of_nodes && frame.id <= last_of_nodes &&
      (frame.id & node_bits) != 0 && (frame.id & node_bits) != node.value() && !is("EMCY") && !is("TPDO") &&
      !is("SYNC") && !is("TIME"))
    return std::nullopt;
  const bool of_sdo_channel =
      !frame.extended && ((frame.id > 0x580 && frame.id <= 0x5FF) || (frame.id > 0x600 && frame.id <= 0x67F));
  if (of_sdo_channel && !is("SDO ")) return std::nullopt;
  if (is("EMCY")) return Kind{"EMCY", Kind::Content::events};
  if (is("SDO ")) return Kind{"SDO response that nobody asked for", Kind::Content::late};
  if (is("SYNC")) return Kind{"SYNC", Kind::Content::length, "when each comes, and its counter"};
  if (is("TIME")) return Kind{"TIME", Kind::Content::length, "when each comes, and the time it tells"};
  if (is("TPDO")) return Kind{meaning, Kind::Content::length, "when each comes, and the values in it"};
  return Kind{meaning, Kind::Content::length, "when each comes, and its content"};
}

struct Group {
  Kind kind;
  std::vector<std::size_t> then, now;
};

/// In the order in which the kinds came first.
std::vector<Group> groups_of(const Side& then, const Side& now, NodeId node) {
  std::vector<Group> out;
  const auto sort_in = [&](const Side& side, std::vector<std::size_t> Group::* into) {
    const auto& dialogue = side.dialogue;
    for (const auto index : dialogue.unasked) {
      // What comes before the first frame of ours is of what was before.
      if (dialogue.power.empty() && (dialogue.sent.empty() || index < dialogue.sent.front().index)) continue;
      auto kind = kind_of(side.at(index).frame, side.meaning(index), node);
      if (!kind) continue;
      auto known = std::ranges::find(out, kind->name, [](const Group& group) { return group.kind.name; });
      if (known == out.end()) known = out.insert(out.end(), Group{std::move(*kind), {}, {}});
      ((*known).*into).push_back(index);
    }
  };
  sort_in(then, &Group::then);
  sort_in(now, &Group::now);
  return out;
}

std::string text_of(const Side& side, std::size_t index) {
  const auto& frame = side.at(index).frame;
  return fmt::format("{} ({})", side.meaning(index), hex_bytes(frame.bytes()));
}

/// "frame 120 of the capture": as Wireshark counts.
std::string place_of(std::size_t index) { return fmt::format("frame {}", index + 1); }

void compare_events(const Side& then, const Side& now, const Group& group, std::vector<std::string>& out) {
  for (std::size_t i = 0; i < std::max(group.then.size(), group.now.size()); ++i) {
    if (i >= group.now.size()) {
      if (group.kind.content == Kind::Content::late) return;
      out.push_back(
          fmt::format("{} does not come now: {}", place_of(group.then[i]), text_of(then, group.then[i])));
    } else if (i >= group.then.size()) {
      out.push_back("comes now and did not then: " + text_of(now, group.now[i]));
    } else if (then.at(group.then[i]).frame != now.at(group.now[i]).frame) {
      out.push_back(fmt::format("{} is another one now: {} instead of {}", place_of(group.then[i]),
                                text_of(now, group.now[i]), text_of(then, group.then[i])));
    }
  }
}

/// How often each content came, and one frame of it.
using Contents = std::map<Bytes, std::pair<std::size_t, std::size_t>>;
Contents contents_of(const Side& side, const std::vector<std::size_t>& indices) {
  Contents out;
  for (const auto index : indices) {
    const auto bytes = side.at(index).frame.bytes();
    auto& seen = out.try_emplace(Bytes(bytes.begin(), bytes.end()), 0, index).first->second;
    ++seen.first;
  }
  return out;
}

/// A content that came once only may have been missed by a hair, and tells nothing.
void compare_states(const Side& then, const Side& now, const Group& group, std::vector<std::string>& out) {
  const auto before = contents_of(then, group.then), after = contents_of(now, group.now);
  for (const auto& [bytes, seen] : before) {
    if (!after.contains(bytes) && seen.first > 1)
      out.push_back("does not come now: " + text_of(then, seen.second));
  }
  for (const auto& [bytes, seen] : after) {
    if (!before.contains(bytes) && seen.first > 1)
      out.push_back("comes now and did not then: " + text_of(now, seen.second));
  }
}

void compare_lengths(const Side& then, const Side& now, const Group& group, std::vector<std::string>& out) {
  const auto lengths = [](const Side& side, const std::vector<std::size_t>& indices) {
    std::vector<std::string> seen;
    for (const auto index : indices) {
      auto length = std::to_string(side.at(index).frame.dlc);
      if (std::ranges::find(seen, length) == seen.end()) seen.push_back(std::move(length));
    }
    std::ranges::sort(seen);
    return join(seen, ", ");
  };
  if (group.then.empty() || group.now.empty()) return;
  const auto before = lengths(then, group.then), after = lengths(now, group.now);
  if (before != after) out.push_back(fmt::format("has the length {} now, and had {} then", after, before));
}

Duration usual_distance(const Side& side, const std::vector<std::size_t>& indices) {
  std::vector<Duration> distances;
  for (std::size_t i = 1; i < indices.size(); ++i)
    distances.push_back(side.at(indices[i]).time - side.at(indices[i - 1]).time);
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::ranges::nth_element(distances, middle);
  return *middle;
}

/// Of what comes again and again one more or less, or a fifth, is no difference; nor is a tenth of the time
/// between two of them, or 5 ms.
void compare_rates(const Side& then, const Side& now, const Group& group, std::vector<std::string>& out) {
  constexpr std::size_t most_apart = 1, enough = 4, of_number = 5;
  constexpr std::int64_t of_distance = 10;
  constexpr Duration least_apart = std::chrono::milliseconds(5);
  const auto before = group.then.size(), after = group.now.size();
  const auto more = std::max(before, after), less = std::min(before, after);
  if (less == 0 || (more - less > most_apart && (more - less) * of_number > more))
    out.push_back(fmt::format("came {} times then, and {} now", before, after));
  if (less < enough) return;
  const auto was = usual_distance(then, group.then), is = usual_distance(now, group.now);
  const auto apart = was > is ? was - is : is - was;
  if (apart > std::max(least_apart, was / of_distance))
    out.push_back(fmt::format("comes every {} now, and did every {} then", to_string(is), to_string(was)));
}

Unasked compare_group(const Side& then, const Side& now, const Group& group) {
  Unasked out{group.kind.name, group.then.size(), group.now.size(), {}, group.kind.not_compared};
  switch (group.kind.content) {
    case Kind::Content::events:
    case Kind::Content::late: compare_events(then, now, group, out.differences); return out;
    case Kind::Content::states: compare_states(then, now, group, out.differences); break;
    case Kind::Content::length: compare_lengths(then, now, group, out.differences); break;
  }
  compare_rates(then, now, group, out.differences);
  // One single frame at the border of what was recorded is no news.
  if (group.then.size() + group.now.size() == 1) out.differences.clear();
  return out;
}

/// High resolution time stamp (CiA 301, 7.5.2.16): it is another one whenever it is read.
constexpr std::string_view clock_object = "1013h:00";

ComparedAnswer compare_answer(const Side& then, const Side& now, std::optional<std::size_t> was,
                              std::optional<std::size_t> is) {
  ComparedAnswer out{was, is};
  if (!was || !is) {
    out.differs = true;
    return out;
  }
  const auto& before = then.at(*was).frame;
  const auto& after = now.at(*is).frame;
  if (before == after) return out;
  const auto& meaning = then.meaning(*was);
  const auto value = fmt::format("SDO upload response {} = ", clock_object);
  if (meaning.starts_with(value) && now.meaning(*is).starts_with(value)) {
    out.not_compared = "1013h counts time";
    return out;
  }
  if (meaning.starts_with("TPDO ") && before.dlc == after.dlc) {
    out.not_compared = "values of the process";
    return out;
  }
  out.differs = true;
  out.fields =
      canopen::differences(canopen::fields_of(before, meaning), canopen::fields_of(after, now.meaning(*is)));
  return out;
}

/// The toggle bit of guarding goes on from the answer before (CiA 301, 7.2.8.2.2.1), which may stand before
/// the section: until a reset has set it to 0 only that it changes is compared.
class Guarding {
 public:
  explicit Guarding(NodeId node) : node_(node) {}

  void forgive(const can::Frame& sent, const Side& then, const Side& now, ComparedAnswer& answer) {
    const auto kind = answer_of(sent, node_);
    if (!kind || !answer.then || !answer.now) return;
    if (kind->of == AnswerKind::Of::reset) {
      known_ = true;
      apart_ = false;
    }
    if (kind->of != AnswerKind::Of::remote || kind->id != error_control + node_.value()) return;
    constexpr unsigned toggle = 0x80;
    const auto& before = then.at(*answer.then).frame;
    const auto& after = now.at(*answer.now).frame;
    if (before.dlc != 1 || after.dlc != 1) return;
    const unsigned changed = before.data[0] ^ after.data[0];
    // A heartbeat, which has no toggle bit, may come in place of an answer; what toggles then shows in the
    // next one.
    if (changed == 0 && (after.data[0] & toggle) == 0) apart_ = false;
    if (!known_) apart_ = (changed & toggle) != 0;
    known_ = true;
    answer.differs = changed != (apart_ ? toggle : 0U);
    if (!answer.differs && apart_) answer.not_compared = "the toggle bit goes on from what was before";
    if (answer.differs && answer.fields.empty()) {
      answer.fields = canopen::differences(canopen::fields_of(before, then.meaning(*answer.then)),
                                           canopen::fields_of(after, now.meaning(*answer.now)));
    }
  }

 private:
  NodeId node_;
  bool known_ = false;
  bool apart_ = false;  ///< the toggle bits are the opposite of each other
};

}  // namespace

Side::Side(std::span<const can::CapturedFrame> all, std::size_t from, std::size_t to, NodeId node)
    : frames(all), first(from), end(to), dialogue(dialogue_of(all, from, to, node)) {
  canopen::Decoder decoder(node);
  meanings_.reserve(end - first);
  for (auto i = first; i < end; ++i)
    meanings_.push_back(decoder.meaning(frames[i].frame, frames[i].direction));
}

bool Exchange::differs() const { return !now || std::ranges::any_of(answers, &ComparedAnswer::differs); }

std::size_t ReplayComparison::exchanges_that_differ() const {
  return static_cast<std::size_t>(std::ranges::count_if(exchanges, &Exchange::differs));
}

std::size_t ReplayComparison::unasked_that_differ() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(unasked, [](const Unasked& each) { return !each.differences.empty(); }));
}

bool ReplayComparison::compares_something() const {
  return differs() ||
         std::ranges::any_of(exchanges, [](const Exchange& each) { return !each.answers.empty(); }) ||
         std::ranges::any_of(unasked, [](const Unasked& each) { return each.then > 0 && each.now > 0; });
}

Result<ReplayComparison> compare_replay(const Side& then, const Side& now, NodeId node,
                                        const std::vector<std::size_t>& skipped,
                                        const std::vector<std::size_t>& aborts) {
  ReplayComparison out;
  const auto& before = then.dialogue.sent;
  auto after = now.dialogue.sent;
  std::erase_if(after,
                [&aborts](const Sent& sent) { return std::ranges::binary_search(aborts, sent.index); });
  const auto wanted = before.size() - skipped.size();
  constexpr auto* busy = "the host lost frames: is the machine busy?";
  if (after.size() != wanted)
    return fail(fmt::format("of {} frames {} are seen to be sent", wanted, after.size()), {}, busy);
  Guarding guarding(node);
  std::size_t sent = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    Exchange exchange{before[i].index, std::nullopt, {}};
    if (std::ranges::binary_search(skipped, i)) {
      out.exchanges.push_back(std::move(exchange));
      continue;
    }
    const auto& frame = then.at(before[i].index).frame;
    const auto& again = after[sent++];
    if (frame != now.at(again.index).frame)
      return fail(fmt::format("frame {} was not sent in its place", before[i].index + 1), {}, busy);
    exchange.now = again.index;
    const auto count = std::max(before[i].answers.size(), again.answers.size());
    const auto nth = [](const Sent& one, std::size_t n) {
      return n < one.answers.size() ? std::optional(one.answers[n]) : std::nullopt;
    };
    for (std::size_t n = 0; n < count; ++n) {
      exchange.answers.push_back(compare_answer(then, now, nth(before[i], n), nth(again, n)));
      guarding.forgive(frame, then, now, exchange.answers.back());
    }
    out.exchanges.push_back(std::move(exchange));
  }
  for (const auto& group : groups_of(then, now, node)) out.unasked.push_back(compare_group(then, now, group));
  return out;
}

}  // namespace conform::cli
