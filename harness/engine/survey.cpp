// SPDX-License-Identifier: Apache-2.0
#include "engine/survey.hpp"

#include <algorithm>
#include <utility>

#include "canopen/abort_code.hpp"
#include "canopen/data_type.hpp"
#include "engine/sdo_channel.hpp"

namespace conform::engine {
namespace {

using Kind = steps::SdoAnswer::Kind;

/// A device may hold a DOMAIN of a megabyte.
constexpr std::size_t most_kept = SdoChannel::enough_to_see;

bool says_absent(const steps::SdoAnswer& answer) {
  return answer.kind == Kind::aborted &&
         (answer.code == canopen::abort::no_object || answer.code == canopen::abort::no_sub_index);
}

std::string place_of(const device::Entry& entry, const device::Profile& profile) {
  const auto& places = profile.described_places;
  if (entry.described) {
    if (const auto found = places.entries.find(entry.mux); found != places.entries.end())
      return found->second;
    if (const auto found = places.objects.find(entry.mux.index); found != places.objects.end())
      return found->second;
    return profile.described_in;
  }
  return entry.claimed ? "device profile" : "CiA 301";
}

std::string words_of(const device::Entry& entry, const std::optional<Bytes>& value) {
  return value ? canopen::print(entry.type, *value) : std::string();
}

/// What is said of it.
result::EntryFacts said_of(const device::Entry& entry, const device::Profile& profile) {
  result::EntryFacts out;
  out.object = entry.mux;
  out.name = entry.name;
  out.said_by = place_of(entry, profile);
  out.claimed = entry.presence() != device::Presence::unclaimed;
  out.type = to_string(entry.type);
  out.length = entry.size();
  out.access = entry.access_open ? "rw or ro" : std::string(to_string(entry.access));
  out.mappable = entry.pdo_mappable;
  out.low = words_of(entry, entry.low);
  out.high = words_of(entry, entry.high);
  out.default_value = words_of(entry, entry.default_value);
  return out;
}

}  // namespace

void Survey::note(Multiplexer object, const steps::SdoAnswer& answer) {
  Seen seen{answer, answer.data.size(), says_absent(answer)};
  if (answer.glanced_at()) seen.size = *answer.announced;
  seen.answer.data.resize(std::min(seen.size, most_kept));
  seen_[object] = std::move(seen);
}

void Survey::note_absent(Multiplexer object, const steps::SdoAnswer& answer) {
  seen_[object] = {answer, 0, true};
}

void Survey::describe(const Seen& seen, const device::Entry& entry, result::EntryFacts& into) const {
  const auto& answer = seen.answer;
  if (seen.absent) {
    into.presence = result::absent;
    into.refusal = answer.refusal();
    return;
  }
  into.presence = answer.kind == Kind::silence ? result::unanswered : result::present;
  if (answer.kind != Kind::confirmed && !answer.glanced_at()) {
    into.refusal = answer.refusal();
    return;
  }
  // An expedited upload that tells no size brings as many bytes as are expected of it.
  if (answer.size_indicated) into.size = seen.size;
  into.value = seen.size > answer.data.size() ? canopen::print_untyped(answer.data) + " and more"
                                              : canopen::print(entry.type, answer.data);
}

std::vector<result::EntryFacts> Survey::rows(const device::Dictionary& known,
                                             const device::Profile& profile) const {
  std::vector<result::EntryFacts> out;
  for (const auto& entry : known.entries()) {
    if (out.size() == most_rows) break;
    auto row = said_of(entry, profile);
    if (const auto found = seen_.find(entry.mux); found != seen_.end()) describe(found->second, entry, row);
    out.push_back(std::move(row));
  }
  return out;
}

}  // namespace conform::engine
