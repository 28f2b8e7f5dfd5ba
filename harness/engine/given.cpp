// SPDX-License-Identifier: Apache-2.0
#include "engine/given.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"
#include "steps/sdo_step.hpp"

namespace conform::engine {
namespace {

using Kind = steps::SdoAnswer::Kind;

/// An upload of so many bytes costs little even at 50 kbit/s: up to here more is better.
constexpr std::uint64_t quickly_read = 256;

bool fits(const scenario::Query::Holding& wanted, std::uint64_t size) {
  return size >= wanted.least && size <= wanted.most;
}

std::string with_article(const std::string& words) {
  return (std::string_view("aeio").find(words.front()) == std::string_view::npos ? "a " : "an ") + words;
}

}  // namespace

std::vector<result::Want> wants_of(const scenario::Query& query) {
  if (query.says("safe")) return {{"object", with_article(query.words()) + ", named in safe_objects"}};
  if (query.holding() && query.holding()->most > 0) return {{"object", with_article(query.words())}};
  return {};
}

Result<Given> Givens::find(const std::string& text) {
  const auto query = scenario::Query::parse(text);
  if (!query) return std::unexpected(query.error());
  Given out;
  if (!query->holding()) {
    const auto described = query->select(session_.dictionary());
    for (const auto object : described) {
      auto present = session_.is_present(object, false);
      if (!present) return std::unexpected(present.error());
      if (*present) {
        out.object = object;
        return out;
      }
    }
    out.why_not = "the device has no " + query->words();
    if (!described.empty()) {
      const auto grounds = session_.grounds(steps::Asked::presence, described.front());
      out.why_not +=
          ": " + to_string(described.front()) + " is absent" + (grounds.empty() ? "" : ", " + grounds);
    }
    out.wants = wants_of(*query);
    return out;
  }
  auto all = candidates(*query);
  if (!all) return std::unexpected(all.error());
  auto found = query->says("safe") && may_write_ ? writable(*query, *all) : readable(*query, *all);
  if (!found) return std::unexpected(found.error());
  out.object = *found;
  if (!out.object) {
    out.why_not = why_none(*query, *all);
    out.wants = wants_of(*query);
  }
  return out;
}

Result<Givens::Candidates> Givens::candidates(const scenario::Query& query) {
  Candidates out;
  for (const auto object : query.select(session_.dictionary())) {
    const auto* entry = session_.dictionary().find(object);
    if (entry == nullptr || !entry->readable()) continue;
    // A fixed length need not be asked for; what it is on the wire is for the scenarios to judge.
    if (entry->size()) {
      auto present = session_.is_present(object, false);
      if (!present) return std::unexpected(present.error());
      if (*present) out.emplace_back(object, *entry->size());
      continue;
    }
    auto held = held_.find(object);
    if (held == held_.end()) {
      auto asked = session_.channel().held_bytes(object);
      if (!asked) return std::unexpected(asked.error());
      held = held_.emplace(object, *asked).first;
    }
    if (held->second) {
      out.emplace_back(object, *held->second);
    } else if (may_fill(object)) {
      // Nothing to be read yet, perhaps: an empty DOMAIN may refuse an upload.
      auto present = session_.is_present(object, false);
      if (!present) return std::unexpected(present.error());
      if (*present) out.emplace_back(object, 0);
    }
  }
  return out;
}

bool Givens::may_fill(Multiplexer object) const {
  const auto* entry = session_.dictionary().find(object);
  return may_write_ && entry != nullptr && entry->safe && entry->readable() && entry->writable() &&
         !entry->command && !entry->may_change && !entry->untouchable && !entry->size();
}

/// Writes a pattern and reads it back. What the entry held before is put back after the case.
Result<bool> Givens::stores(Multiplexer object, std::uint64_t size) {
  auto& known = stores_[object];
  if (size <= known.takes) return true;
  if (known.refused && size >= *known.refused) return false;
  const auto* entry = session_.dictionary().find(object);
  const bool visible = entry != nullptr && entry->type == canopen::DataType::visible_string;
  const auto pattern = steps::pattern_bytes(static_cast<std::size_t>(size), visible);
  auto written = session_.prepare(object, pattern);
  if (!written) return std::unexpected(written.error());
  const auto refuse = [&](std::string why) {
    known.refused = size;
    known.why = std::move(why);
    return false;
  };
  if (written->kind != Kind::confirmed)
    return refuse("takes no " + std::to_string(size) + " bytes: " + written->refusal());
  auto back = session_.peek(object);
  if (!back) return std::unexpected(back.error());
  if (back->kind != Kind::confirmed) return refuse("cannot be read back: " + back->refusal());
  if (back->data != pattern) {
    known.window = back->data.size() > size && std::ranges::equal(ByteView(back->data).first(size), pattern);
    return refuse("takes " + std::to_string(size) + " bytes and reads back " +
                  (back->data.size() == size ? "others" : std::to_string(back->data.size())));
  }
  known.takes = size;
  return true;
}

/// Scenarios that write: what the entry holds now does not matter.
Result<std::optional<Multiplexer>> Givens::writable(const scenario::Query& query, const Candidates& all) {
  auto ranked = all;
  // A DOMAIN has no longest value of its own: the one with the least in it is put back soonest, but an empty
  // one perhaps never. Of the others the longest at present is the best guess.
  const auto rank = [this](const auto& one) {
    const auto* entry = session_.dictionary().find(one.first);
    const bool is_domain = entry != nullptr && entry->type == canopen::DataType::domain;
    const auto held = one.second;
    return std::tuple(is_domain, is_domain && held > 0, is_domain ? ~held : held);
  };
  std::ranges::stable_sort(ranked, std::greater{}, rank);
  for (const auto& [object, holds] : ranked) {
    if (!may_fill(object)) {
      if (fits(*query.holding(), holds)) return std::optional(object);
      continue;
    }
    auto stored = stores(object, query.holding()->least);
    if (!stored) return std::unexpected(stored.error());
    if (*stored) return std::optional(object);
  }
  // A window on a memory is no store of any length, but takes the transfer.
  for (const auto& [object, holds] : ranked) {
    if (stores_[object].window) return std::optional(object);
  }
  return std::optional<Multiplexer>();
}

Result<std::optional<Multiplexer>> Givens::readable(const scenario::Query& query, const Candidates& all) {
  const auto& wanted = *query.holding();
  const std::pair<Multiplexer, std::uint64_t>* best = nullptr;
  for (const auto& each : all) {
    if (!fits(wanted, each.second)) continue;
    const bool better = best == nullptr || (each.second <= quickly_read
                                                ? best->second > quickly_read || each.second > best->second
                                                : each.second < best->second);
    if (better) best = &each;
  }
  if (best != nullptr) return std::optional(best->first);
  if (wanted.most == 0) return std::optional<Multiplexer>();
  for (const auto& [object, holds] : all) {
    if (!may_fill(object)) continue;
    const auto size = wanted.least;
    const bool filled_before = stores_.contains(object) && stores_.at(object).takes >= size;
    auto stored = stores(object, size);
    if (!stored) return std::unexpected(stored.error());
    if (!*stored) continue;
    if (filled_before) {
      // It was put back after the case that found out.
      const auto* entry = session_.dictionary().find(object);
      auto written =
          session_.prepare(object, steps::pattern_bytes(static_cast<std::size_t>(size),
                                                        entry->type == canopen::DataType::visible_string));
      if (!written) return std::unexpected(written.error());
      if (written->kind != Kind::confirmed) continue;
    }
    return std::optional(object);
  }
  return std::optional<Multiplexer>();
}

std::string Givens::why_none(const scenario::Query& query, const Candidates& all) const {
  std::string out = "the device has no " + query.words();
  if (all.empty()) {
    return out + (query.says("safe") ? ": safe_objects names none of variable length" : "");
  }
  const auto largest = std::ranges::max_element(all, {}, [](const auto& each) { return each.second; });
  for (const auto& [object, store] : stores_) {
    const bool asked =
        std::ranges::find(all, object, &std::pair<Multiplexer, std::uint64_t>::first) != all.end();
    if (asked && store.refused && *store.refused <= query.holding()->least)
      return out + ": " + to_string(object) + " " + store.why;
  }
  const bool many = all.size() > 1;
  return out + ": " + (many ? "the largest, " : "") + to_string(largest->first) + (many ? "," : "") +
         " holds " + std::to_string(largest->second);
}

}  // namespace conform::engine
