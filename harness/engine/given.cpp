// SPDX-License-Identifier: Apache-2.0
#include "engine/given.hpp"

#include "scenario/query.hpp"

namespace conform::engine {

Result<std::optional<Multiplexer>> Givens::find(const std::string& text) {
  const auto query = scenario::Query::parse(text);
  if (!query) return std::unexpected(query.error());
  for (const auto object : query->select(session_.dictionary())) {
    const auto* entry = session_.dictionary().find(object);
    if (query->holding() && entry != nullptr) {
      const auto wanted = *query->holding();
      const auto fits = [wanted](std::uint64_t size) { return size >= wanted.least && size <= wanted.most; };
      // A fixed length need not be asked for; what it is on the wire is for the scenarios to judge.
      if (!entry->readable() || (entry->size() && !fits(*entry->size()))) continue;
      if (!entry->size()) {
        auto held = held_.find(object);
        if (held == held_.end()) {
          auto asked = session_.channel().held_bytes(object);
          if (!asked) return std::unexpected(asked.error());
          held = held_.emplace(object, *asked).first;
        }
        if (held->second && fits(*held->second)) return std::optional(object);
        continue;
      }
    }
    auto present = session_.is_present(object, false);
    if (!present) return std::unexpected(present.error());
    if (*present) return std::optional(object);
  }
  return std::optional<Multiplexer>();
}

}  // namespace conform::engine
