// SPDX-License-Identifier: Apache-2.0
// Conversations that are kept from one search to the next: a folder of texts that people can read, one
// conversation a file, one action a line.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "explore/action.hpp"

namespace conform::explore {

/// "upload 1018h:01", "send 000h 01 05", ... under a head that names the node.
[[nodiscard]] std::string corpus_text(std::span<const Action> conversation, NodeId node);
/// `where`: of the text, for messages.
[[nodiscard]] Result<Conversation> parse_corpus_text(std::string_view text, const std::string& where,
                                                     NodeId node);

/// All conversations of a folder (*.txt): those that found something, then the others, each in the order of
/// their names. None where there is no such folder yet.
[[nodiscard]] Result<std::vector<Conversation>> read_corpus(const std::string& folder, NodeId node);
/// Adds them, each in a file that is named by its content; the folder is made. `found`: something was found
/// by them. Returns how many were new.
[[nodiscard]] Result<std::size_t> add_to_corpus(const std::string& folder,
                                                std::span<const Conversation> conversations, NodeId node,
                                                bool found = false);

}  // namespace conform::explore
