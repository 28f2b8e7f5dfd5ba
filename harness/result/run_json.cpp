// SPDX-License-Identifier: Apache-2.0
#include "result/run_json.hpp"

#include <concepts>
#include <stdexcept>
#include <type_traits>

#include "base/text.hpp"
#include "base/text_bytes.hpp"

namespace conform::result {
namespace {

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  throw std::invalid_argument("no hexadecimal digit");
}

}  // namespace

std::string hex_text(ByteView bytes) {
  std::string out;
  for (const auto byte : bytes) {
    out += "0123456789abcdef"[byte >> 4U];
    out += "0123456789abcdef"[byte & 0xFU];
  }
  return out;
}

Bytes hex_value(const std::string& hex) {
  Bytes out;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    out.push_back(static_cast<std::uint8_t>(digit(hex[i]) * 16 + digit(hex[i + 1])));
  return out;
}

namespace {

template <typename T, typename Plain>
concept Same = std::same_as<std::remove_const_t<T>, Plain>;

// One function per structure: `see` gets each member with its name. The structured binding counts the
// members, so one that is added to the structure breaks the build here until it has a name, for writing and
// for reading.
void members(Same<can::Frame> auto& it, auto&& see) {
  auto& [id, extended, remote, error, dlc, data] = it;
  see("id", id), see("extended", extended), see("remote", remote), see("error", error), see("dlc", dlc),
      see("data", data);
}
void members(Same<EvidenceFrame> auto& it, auto&& see) {
  auto& [frame, time, direction, capture_index, meaning, decisive] = it;
  see("frame", frame), see("time", time), see("direction", direction), see("index", capture_index),
      see("meaning", meaning), see("decisive", decisive);
}
void members(Same<SourcePosition> auto& it, auto&& see) {
  auto& [file, line, column] = it;
  see("file", file), see("line", line), see("column", column);
}
void members(Same<Listening> auto& it, auto&& see) {
  auto& [from, until] = it;
  see("from", from), see("until", until);
}
void members(Same<Finding> auto& it, auto&& see) {
  auto& [verdict, requirement, position, step, accepts, tolerates, actual, actual_bytes, reason, evidence,
         declared_at, during, object, deviation, broken_rules, frames_seen, rests_on_time, listened,
         prepared] = it;
  see("verdict", verdict), see("requirement", requirement), see("position", position), see("step", step),
      see("accepts", accepts), see("tolerates", tolerates), see("actual", actual),
      see("actual_bytes", actual_bytes), see("reason", reason), see("evidence", evidence),
      see("declared_at", declared_at), see("during", during), see("object", object),
      see("deviation", deviation), see("broken_rules", broken_rules), see("frames_seen", frames_seen),
      see("rests_on_time", rests_on_time), see("listened", listened), see("prepared", prepared);
}
void members(Same<DecidingStep> auto& it, auto&& see) {
  auto& [position, step, actual, frame] = it;
  see("position", position), see("step", step), see("actual", actual), see("frame", frame);
}
void members(Same<Judgement> auto& it, auto&& see) {
  auto& [requirement, verdict, findings, expectations, frames_seen, decided_by, reason, waived] = it;
  see("requirement", requirement), see("verdict", verdict), see("findings", findings),
      see("expectations", expectations), see("frames_seen", frames_seen), see("decided_by", decided_by),
      see("reason", reason), see("waived", waived);
}
void members(Same<Want> auto& it, auto&& see) {
  auto& [kind, text] = it;
  see("kind", kind), see("text", text);
}
void members(Same<CaseResult> auto& it, auto&& see) {
  auto& [id, instance, title, suite, position, requirements, cct, judgements, setup_findings, verdict, reason,
         rests_on, wants, tried, finished, begin, end, first_frame, end_frame] = it;
  see("id", id), see("instance", instance), see("title", title), see("suite", suite),
      see("position", position), see("requirements", requirements), see("cct", cct),
      see("judgements", judgements), see("setup_findings", setup_findings), see("verdict", verdict),
      see("reason", reason), see("rests_on", rests_on), see("wants", wants), see("tried", tried),
      see("finished", finished), see("begin", begin), see("end", end), see("first_frame", first_frame),
      see("end_frame", end_frame);
}
void members(Same<RequirementInfo> auto& it, auto&& see) {
  auto& [id, clause, level, area, statement] = it;
  see("id", id), see("clause", clause), see("level", level), see("area", area), see("statement", statement);
}
void members(Same<Property> auto& it, auto&& see) {
  auto& [name, value] = it;
  see("name", name), see("value", value);
}
void members(Same<ComparedCase> auto& it, auto&& see) {
  auto& [number, group, title, outcome, because, cases] = it;
  see("number", number), see("group", group), see("title", title), see("outcome", outcome),
      see("because", because), see("cases", cases);
}
void members(Same<Sample> auto& it, auto&& see) {
  auto& [at, value] = it;
  see("at", at), see("value", value);
}
void members(Same<Measurement> auto& it, auto&& see) {
  auto& [kind, of, nominal, least, most, count, shortest, longest, mean, samples] = it;
  see("kind", kind), see("of", of), see("nominal", nominal), see("least", least), see("most", most),
      see("count", count), see("shortest", shortest), see("longest", longest), see("mean", mean),
      see("samples", samples);
}
void members(Same<BusLoad> auto& it, auto&& see) {
  auto& [from, span, frames, busy] = it;
  see("from", from), see("span", span), see("frames", frames), see("busy", busy);
}
void members(Same<Change> auto& it, auto&& see) {
  auto& [object, before, during, put_back] = it;
  see("object", object), see("before", before), see("during", during), see("put_back", put_back);
}
void members(Same<WaiverUse> auto& it, auto&& see) {
  auto& [requirement, case_name, object, reason, owner, ticket, expires, place, cases, state, verdict] = it;
  see("requirement", requirement), see("case", case_name), see("object", object), see("reason", reason),
      see("owner", owner), see("ticket", ticket), see("expires", expires), see("place", place),
      see("cases", cases), see("state", state), see("verdict", verdict);
}
void members(Same<EntryFacts> auto& it, auto&& see) {
  auto& [object, name, said_by, claimed, type, access, mappable, low, high, default_value, length, presence,
         refusal, size, value] = it;
  see("object", object), see("name", name), see("said_by", said_by), see("claimed", claimed),
      see("type", type), see("access", access), see("mappable", mappable), see("low", low), see("high", high),
      see("default", default_value), see("length", length), see("presence", presence),
      see("refusal", refusal), see("size", size), see("value", value);
}
void members(Same<Likeness> auto& it, auto&& see) {
  auto& [requirement, case_name, name, summary, percent] = it;
  see("requirement", requirement), see("case", case_name), see("name", name), see("summary", summary),
      see("percent", percent);
}
void members(Same<RunResult> auto& it, auto&& see) {
  auto& [tool, host, started_utc_ns, elapsed, device, properties, cases, requirements, notes, aborted, signal,
         unwritten, compared, measurements, load, changes, waivers, dictionary, likenesses] = it;
  see("tool", tool), see("host", host), see("started", started_utc_ns), see("elapsed", elapsed),
      see("device", device), see("properties", properties), see("cases", cases),
      see("requirements", requirements), see("notes", notes), see("aborted", aborted), see("signal", signal),
      see("unwritten", unwritten), see("compared", compared), see("measurements", measurements),
      see("load", load), see("changes", changes), see("waivers", waivers), see("dictionary", dictionary),
      see("likenesses", likenesses);
}

template <typename T>
struct ListTraits : std::false_type {};
template <typename T>
struct ListTraits<std::vector<T>> : std::true_type {};
template <typename T>
struct OptionalTraits : std::false_type {};
template <typename T>
struct OptionalTraits<std::optional<T>> : std::true_type {};
template <typename T>
concept Bytewise = std::same_as<T, std::vector<std::uint8_t>> || std::same_as<T, std::array<std::uint8_t, 8>>;

/// Empty lists and what is not there: both come back by themselves, and lines stay short.
bool is_left_out(const Json& json) { return json.is_null() || (json.is_array() && json.empty()); }

template <typename T>
Json write(const T& value) {
  if constexpr (std::same_as<T, std::string>) {
    return text_json(value);
  } else if constexpr (std::same_as<T, Verdict>) {
    return std::string(to_string(value));
  } else if constexpr (std::same_as<T, can::Direction>) {
    return value == can::Direction::transmitted ? "sent" : "received";
  } else if constexpr (std::same_as<T, BusTime>) {
    return value.time_since_epoch().count();
  } else if constexpr (std::same_as<T, Duration>) {
    return value.count();
  } else if constexpr (std::same_as<T, Index>) {
    return value.value();
  } else if constexpr (std::same_as<T, Multiplexer>) {
    return to_string(value);
  } else if constexpr (std::is_arithmetic_v<T>) {
    return value;
  } else if constexpr (Bytewise<T>) {
    return hex_text(value);
  } else if constexpr (OptionalTraits<T>::value) {
    return value ? write(*value) : Json();
  } else if constexpr (ListTraits<T>::value) {
    Json list = Json::array();
    for (const auto& each : value) list.push_back(write(each));
    return list;
  } else {
    Json object = Json::object();
    members(value, [&](const char* name, const auto& member) {
      Json json = write(member);
      if (!is_left_out(json)) object[name] = std::move(json);
    });
    return object;
  }
}

template <typename T>
void read(const Json& json, T& value) {
  if constexpr (std::same_as<T, std::string>) {
    value = text_of(json);
  } else if constexpr (std::same_as<T, Verdict>) {
    value = Verdict::error;
    const auto word = json.get<std::string>();
    for (const auto each : {Verdict::not_applicable, Verdict::pass, Verdict::waived, Verdict::warn,
                            Verdict::inconclusive, Verdict::error, Verdict::fail}) {
      if (to_string(each) == word) value = each;
    }
  } else if constexpr (std::same_as<T, can::Direction>) {
    value = json.get<std::string>() == "sent" ? can::Direction::transmitted : can::Direction::received;
  } else if constexpr (std::same_as<T, BusTime>) {
    value = BusTime(Duration(json.get<std::int64_t>()));
  } else if constexpr (std::same_as<T, Duration>) {
    value = Duration(json.get<std::int64_t>());
  } else if constexpr (std::same_as<T, Index>) {
    value = Index(json.get<std::uint16_t>());
  } else if constexpr (std::same_as<T, Multiplexer>) {
    const auto object = parse_multiplexer(json.get<std::string>());
    if (!object) throw std::invalid_argument("no multiplexer");
    value = *object;
  } else if constexpr (std::is_arithmetic_v<T>) {
    value = json.get<T>();
  } else if constexpr (std::same_as<T, Bytes>) {
    value = hex_value(json.get<std::string>());
  } else if constexpr (Bytewise<T>) {
    const auto bytes = hex_value(json.get<std::string>());
    std::copy_n(bytes.begin(), std::min(bytes.size(), value.size()), value.begin());
  } else if constexpr (OptionalTraits<T>::value) {
    value.reset();
    if (!json.is_null()) read(json, value.emplace());
  } else if constexpr (ListTraits<T>::value) {
    if (!json.is_array()) throw std::invalid_argument("no list where one belongs");
    value.clear();
    for (const auto& each : json) read(each, value.emplace_back());
  } else {
    if (!json.is_object()) throw std::invalid_argument("no object where one belongs");
    members(value, [&](const char* name, auto& member) {
      if (const auto found = json.find(name); found != json.end()) read(*found, member);
    });
  }
}

/// Whether the JSON library would take it: well-formed UTF-8.
bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<std::uint8_t>(text[i]);
    const std::size_t length = lead < 0x80          ? 1
                               : (lead >> 5U) == 6  ? 2
                               : (lead >> 4U) == 14 ? 3
                               : (lead >> 3U) == 30 ? 4
                                                    : 0;
    if (length == 0 || i + length > text.size()) return false;
    std::uint32_t code = length == 1 ? lead : lead & (0x7FU >> length);
    for (std::size_t k = 1; k < length; ++k) {
      const auto next = static_cast<std::uint8_t>(text[i + k]);
      if ((next & 0xC0U) != 0x80U) return false;
      code = (code << 6U) | (next & 0x3FU);
    }
    constexpr std::array<std::uint32_t, 5> least{0, 0, 0x80, 0x800, 0x10000};
    if (code < least[length] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return false;
    i += length;
  }
  return true;
}

}  // namespace

Json text_json(const std::string& text) {
  if (is_utf8(text)) return text;
  return {{"hex", hex_text(bytes_of(text))}};
}

std::string text_of(const Json& json) {
  if (!json.is_object()) return json.get<std::string>();
  const auto bytes = hex_value(json.at("hex").get<std::string>());
  return {bytes.begin(), bytes.end()};
}

Json to_json(const CaseResult& one) { return write(one); }
Json to_json(const EntryFacts& entry) { return write(entry); }
Json to_json(const RunResult& run) { return write(run); }

Json without_cases(const RunResult& run) {
  Json object = Json::object();
  members(run, [&](std::string_view name, const auto& member) {
    if (name == "cases") return;
    if (Json json = write(member); !is_left_out(json)) object[std::string(name)] = std::move(json);
  });
  return object;
}

void from_json(const Json& json, CaseResult& one) { read(json, one); }
void from_json(const Json& json, RunResult& run) { read(json, run); }

}  // namespace conform::result
