// SPDX-License-Identifier: Apache-2.0
#include "canopen/sdo_fault.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "base/text.hpp"

namespace conform::canopen {
namespace {

using Kind = SdoFault::Kind;
using Part = SdoFrame::Part;

/// K is `at`, any other capital letter that stands alone is `other`.
struct Phrase {
  std::string_view words;
  Kind kind;
  Part part;
  std::size_t least_at = 1;
  std::size_t most_other = 0;
};

constexpr Phrase phrases[] = {
    {"lose segment K", Kind::lose, Part::segment},
    {"repeat segment K", Kind::repeat, Part::segment},
    {"swap segments K and L", Kind::swap, Part::segment, 1, 1'000'000},
    {"number segment K as S", Kind::number, Part::segment, 1, 127},
    {"wrong toggle in segment K", Kind::wrong_toggle, Part::segment},
    {"acknowledge S in sub-block K", Kind::acknowledge, Part::acknowledge, 1, 255},
    {"blksize B from sub-block K", Kind::blksize, Part::acknowledge, 2, 255},
    {"wrong crc", Kind::wrong_crc, Part::end},
    {"unused bytes N", Kind::unused, Part::end, 0, 7},
    {"short initiate", Kind::shorten, Part::initiate},
    {"short segment K", Kind::shorten, Part::segment},
    {"short end", Kind::shorten, Part::end},
    {"reserved bits in initiate", Kind::reserved_bits, Part::initiate},
    {"reserved bits in start", Kind::reserved_bits, Part::start},
    {"reserved bits in segment K", Kind::reserved_bits, Part::segment},
    {"reserved bits in acknowledge K", Kind::reserved_bits, Part::acknowledge},
    {"reserved bits in end", Kind::reserved_bits, Part::end},
    {"reserved bytes in initiate", Kind::reserved_bytes, Part::initiate},
    {"reserved bytes in start", Kind::reserved_bytes, Part::start},
    {"reserved bytes in segment K", Kind::reserved_bytes, Part::segment},
    {"reserved bytes in acknowledge K", Kind::reserved_bytes, Part::acknowledge},
    {"reserved bytes in end", Kind::reserved_bytes, Part::end},
    {"abort after segment K", Kind::abort, Part::segment, 0},
    {"abort instead of end", Kind::abort, Part::end},
    {"new initiate after segment K", Kind::new_initiate, Part::segment, 0},
    {"new initiate instead of end", Kind::new_initiate, Part::end},
    {"silence after segment K", Kind::silence, Part::segment, 0},
    {"no end", Kind::silence, Part::end},
};

bool is_placeholder(std::string_view word) {
  return word.size() == 1 && word.front() >= 'A' && word.front() <= 'Z';
}

std::vector<std::string_view> words_of(std::string_view text) {
  auto out = split(text, ' ');
  std::erase_if(out, [](std::string_view word) { return word.empty(); });
  return out;
}

/// The numbers of the phrase when the words fit it.
std::optional<SdoFault> match(const Phrase& phrase, std::span<const std::string_view> words) {
  const auto wanted = words_of(phrase.words);
  if (wanted.size() != words.size()) return std::nullopt;
  SdoFault out;
  out.kind = phrase.kind;
  out.part = phrase.part;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!is_placeholder(wanted[i])) {
      if (wanted[i] != words[i]) return std::nullopt;
      continue;
    }
    const auto number = parse_number(words[i]);
    if (!number) return std::nullopt;
    (wanted[i] == "K" ? out.at : out.other) = static_cast<std::size_t>(*number);
  }
  return out;
}

bool reads(SdoProtocol protocol) {
  return protocol == SdoProtocol::upload || protocol == SdoProtocol::block_upload;
}

bool by_block(SdoProtocol protocol) {
  return protocol == SdoProtocol::block_upload || protocol == SdoProtocol::block_download;
}

bool has_place(const SdoFault& fault, SdoProtocol protocol) {
  const bool block = by_block(protocol);
  switch (fault.kind) {
    case Kind::lose: return protocol != SdoProtocol::upload;
    case Kind::repeat: return protocol != SdoProtocol::block_upload;
    case Kind::swap:
    case Kind::number:
    case Kind::wrong_crc: return protocol == SdoProtocol::block_download;
    case Kind::wrong_toggle: return !block;
    case Kind::acknowledge:
    case Kind::blksize: return protocol == SdoProtocol::block_upload;
    case Kind::unused: return !reads(protocol);
    case Kind::shorten:
    case Kind::reserved_bits:
    case Kind::reserved_bytes: break;
    case Kind::silence: return fault.part == Part::segment || protocol != SdoProtocol::upload;
    case Kind::abort:
    case Kind::new_initiate: return fault.part == Part::segment || block;
  }
  switch (fault.part) {
    case Part::initiate: return true;
    case Part::start:
    case Part::acknowledge: return protocol == SdoProtocol::block_upload;
    case Part::end: return block;
    case Part::segment:
      // The segments of a download are full of data; its client sends none in a block upload.
      return protocol == SdoProtocol::upload || (fault.kind == Kind::shorten && !reads(protocol));
    case Part::abort: break;
  }
  return false;
}

std::string_view name_of(SdoProtocol protocol) {
  switch (protocol) {
    case SdoProtocol::upload: return "an upload";
    case SdoProtocol::download: return "a download";
    case SdoProtocol::block_upload: return "a block upload";
    case SdoProtocol::block_download: return "a block download";
  }
  return "";
}

}  // namespace

std::vector<std::string_view> sdo_fault_phrases() {
  std::vector<std::string_view> out;
  for (const auto& phrase : phrases) out.push_back(phrase.words);
  return out;
}

Result<SdoFault> SdoFault::parse(std::string_view text) {
  const auto words = words_of(text);
  for (const auto& phrase : phrases) {
    auto found = match(phrase, words);
    if (!found) continue;
    found->text = std::string(text);
    const bool counts = phrase.words.find(" K") != std::string_view::npos;
    if (counts && found->at < phrase.least_at)
      return fail(fmt::format("'{}': K counts from {}", text, phrase.least_at));
    if (found->other > phrase.most_other)
      return fail(fmt::format("'{}': {} is above {}", text, found->other, phrase.most_other));
    if (found->kind == Kind::swap && found->other <= found->at)
      return fail(fmt::format("'{}': the second segment comes after the first", text));
    return *found;
  }
  std::vector<std::string> near;
  for (const auto& phrase : phrases) {
    if (!words.empty() && words_of(phrase.words).front() == words.front()) near.emplace_back(phrase.words);
  }
  if (near.empty()) {
    for (const auto& phrase : phrases) near.emplace_back(phrase.words);
  }
  return fail(fmt::format("unknown fault '{}'", text), "", "known: " + join(near, "; "));
}

Result<void> check_fault(const SdoFault& fault, SdoProtocol protocol, std::optional<std::size_t> segments) {
  if (!has_place(fault, protocol)) {
    return fail_scenario(fmt::format("{} has no place for '{}'", name_of(protocol), fault.text));
  }
  const bool counts_segments = fault.part == Part::segment;
  const auto highest = fault.kind == Kind::swap ? fault.other : fault.at;
  // An expedited transfer has no segment to count from, not even one that the initiate precedes.
  const bool expedited = segments == std::size_t{0};
  if (segments && counts_segments && (highest > *segments || expedited)) {
    return fail_scenario(fmt::format("the transfer has {} segment{} only: '{}'", *segments,
                                     *segments == 1 ? "" : "s", fault.text));
  }
  if (expedited && fault.part == Part::end)
    return fail_scenario(fmt::format("an expedited transfer has no place for '{}'", fault.text));
  // The answer to the last segment ends a segmented transfer.
  if (segments && fault.stops() && counts_segments && protocol == SdoProtocol::download &&
      fault.at == *segments) {
    return fail_scenario(fmt::format("the transfer is over after segment {}: '{}'", *segments, fault.text));
  }
  return {};
}

const SdoFault* SdoFaultPlan::take(SdoFault::Kind kind, SdoFrame::Part part, std::size_t at) {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const auto& fault = faults_[i];
    if (done_[i] || fault.kind != kind || fault.part != part || (fault.at != 0 && fault.at != at)) continue;
    done_[i] = true;
    return &fault;
  }
  return nullptr;
}

const SdoFault* SdoFaultPlan::take_stop(std::size_t settled) {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const auto& fault = faults_[i];
    if (done_[i] || !fault.stops() || fault.part != Part::segment || fault.at > settled) continue;
    done_[i] = true;
    return &fault;
  }
  return nullptr;
}

const SdoFault* SdoFaultPlan::left() const {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    if (!done_[i]) return &faults_[i];
  }
  return nullptr;
}

}  // namespace conform::canopen
