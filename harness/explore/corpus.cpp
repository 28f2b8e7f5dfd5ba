// SPDX-License-Identifier: Apache-2.0
#include "explore/corpus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <optional>
#include <system_error>
#include <utility>

#include "base/files.hpp"
#include "base/fnv1a.hpp"
#include "base/text.hpp"
#include "canopen/sdo_fault.hpp"

namespace conform::explore {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view head =
    "# One conversation with a device, an action a line, kept by 'canopen-conform explore --corpus'.\n";
constexpr std::uint64_t most_bytes = 256 * 1024;
constexpr std::size_t most_actions = 10'000, most_files = 100'000;
/// Of the names of conversations that found something.
constexpr std::string_view of_findings = "found-";
constexpr std::size_t longest_value = 64 * 1024;

constexpr std::array transfers{Transfer::expedited_unsized, Transfer::segmented, Transfer::segmented_unsized,
                               Transfer::block, Transfer::block_unsized};

std::string frame_text(const can::Frame& frame) {
  const auto id = frame.extended ? "29-bit " + hex(frame.id, 8) : hex(frame.id, 3);
  if (frame.remote) return fmt::format("{} remote {}", id, frame.dlc);
  return frame.size() == 0 ? id : fmt::format("{} {}", id, hex_bytes(frame.bytes()));
}

std::string action_text(const Action& action) {
  switch (action.kind) {
    case Action::Kind::upload:
    case Action::Kind::download: {
      auto out = action.kind == Action::Kind::upload ? "upload " + to_string(action.object)
                                                     : "download " + to_string(action.object) + " =";
      if (!action.data.empty()) out += " " + hex_bytes(action.data);
      if (action.transfer != Transfer::automatic) out += fmt::format(", {}", word_of(action.transfer));
      if (action.blksize != 127) out += fmt::format(", blksize {}", action.blksize);
      if (!action.fault.empty()) out += ", " + action.fault;
      return out;
    }
    case Action::Kind::request: return "request " + frame_text(action.frame);
    case Action::Kind::frame: return "send " + frame_text(action.frame);
    case Action::Kind::power: return "power cycle";
    case Action::Kind::wait: return "wait " + to_string(action.time);
  }
  return "";
}

/// Cuts the first word off.
std::string_view take_word(std::string_view& rest) {
  const auto end = std::min(rest.find(' '), rest.size());
  const auto word = rest.substr(0, end);
  rest = trim(rest.substr(end));
  return word;
}

Result<can::Frame> parse_frame(std::string_view rest) {
  can::Frame out;
  auto word = take_word(rest);
  if (word == "29-bit") {
    out.extended = true;
    word = take_word(rest);
  }
  const auto id = parse_number(word);
  if (!id || *id > (out.extended ? 0x1FFF'FFFFU : 0x7FFU))
    return fail(fmt::format("'{}' is no CAN-ID", word), {}, "701h, 29-bit 00000601h");
  out.id = static_cast<std::uint32_t>(*id);
  if (rest.starts_with("remote")) {
    out.remote = true;
    take_word(rest);
    const auto dlc = parse_number(rest);
    if (!dlc || *dlc > 8) return fail(fmt::format("'{}' is no length", rest), {}, "701h remote 1");
    out.dlc = static_cast<std::uint8_t>(*dlc);
    return out;
  }
  const auto bytes = parse_bytes(rest);
  if (!rest.empty() && (!bytes || bytes->size() > 8))
    return fail(fmt::format("'{}' is not up to eight bytes", rest), {}, "send 000h 01 05");
  if (rest.empty()) return out;
  out.dlc = static_cast<std::uint8_t>(bytes->size());
  std::ranges::copy(*bytes, out.data.begin());
  return out;
}

/// What stands behind a comma: how the bytes are moved, or what the client does wrong.
Result<void> add_detail(Action& action, std::string_view detail) {
  for (const auto transfer : transfers) {
    if (detail != word_of(transfer)) continue;
    action.transfer = transfer;
    return {};
  }
  if (detail.starts_with("blksize ")) {
    if (const auto size = parse_number(detail.substr(8)); size && *size <= 0xFF) {
      action.blksize = static_cast<std::uint8_t>(*size);
      return {};
    }
  }
  if (!action.fault.empty())
    return fail(fmt::format("'{}' is one mistake too many", detail), {}, "one for each transfer");
  if (auto fault = canopen::SdoFault::parse(detail); !fault) return std::unexpected(fault.error());
  action.fault = detail;
  return {};
}

Result<Action> parse_transfer(Action::Kind kind, std::string_view rest) {
  const auto parts = split(rest, ',');
  const auto equals = parts.front().find('=');
  const auto name = trim(parts.front().substr(0, equals));
  const auto object = parse_multiplexer(name);
  if (!object) return fail(fmt::format("'{}' is no entry", name), {}, "1018h:01");
  Action out{.kind = kind, .object = *object};
  const bool has_value = equals != std::string_view::npos;
  if (has_value != (kind == Action::Kind::download))
    return fail(has_value ? "an upload has no value" : "a download has a value", {},
                "download 1017h:00 = E8 03");
  if (has_value) {
    const auto bytes = parse_bytes(trim(parts.front().substr(equals + 1)));
    const bool empty = trim(parts.front().substr(equals + 1)).empty();
    if (!empty && (!bytes || bytes->size() > longest_value))
      return fail("what is written is not made of bytes", {}, "download 1017h:00 = E8 03");
    if (!empty) out.data = *bytes;
  }
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (auto done = add_detail(out, trim(parts[i])); !done) return std::unexpected(done.error());
  }
  return out;
}

Result<Action> parse_action(std::string_view line) {
  auto rest = line;
  const auto word = take_word(rest);
  if (word == "upload") return parse_transfer(Action::Kind::upload, rest);
  if (word == "download") return parse_transfer(Action::Kind::download, rest);
  if (word == "power" && rest == "cycle") return Action{.kind = Action::Kind::power};
  if (word == "wait") {
    const auto time = parse_duration(rest);
    if (!time) return fail(fmt::format("'{}' is no time", rest), {}, "200 ms, 1.5 s");
    return wait(*time);
  }
  if (word == "send" || word == "request") {
    const auto parsed = parse_frame(rest);
    if (!parsed) return std::unexpected(parsed.error());
    return word == "send" ? frame(*parsed) : request(*parsed);
  }
  constexpr std::string_view words[] = {"upload", "download", "request", "send", "power cycle", "wait"};
  const auto near = did_you_mean(word, words);
  return fail(fmt::format("'{}' is no action", word), {},
              near.empty() ? "upload, download, request, send, power cycle, wait"
                           : fmt::format("did you mean '{}'?", near));
}

Result<void> check_node(std::string_view text, NodeId node) {
  const auto number = parse_number(text);
  if (!number || *number < 1 || *number > 127)
    return fail(fmt::format("'{}' is no node-ID", text), {}, "node 5");
  if (*number != node.value())
    return fail(
        fmt::format("the conversation is with node {}, and the device is node {}", *number, node.value()), {},
        "a corpus is for one node-ID");
  return {};
}

/// The same on every machine, so that a conversation has the same name wherever it is kept.
std::string name_of(std::string_view text) { return fmt::format("{:016x}.txt", fnv1a(text)); }

}  // namespace

std::string corpus_text(std::span<const Action> conversation, NodeId node) {
  std::string out(head);
  out += fmt::format("node {}\n", node.value());
  for (const auto& action : conversation) out += action_text(action) + "\n";
  return out;
}

Result<Conversation> parse_corpus_text(std::string_view text, const std::string& where, NodeId node) {
  Conversation out;
  bool has_node = false;
  std::size_t number = 0;
  for (const auto whole : split(text, '\n')) {
    ++number;
    const auto line = trim(whole);
    if (line.empty() || line.starts_with('#')) continue;
    const auto at = [&](Error error) {
      error.where = fmt::format("{}:{}", where, number);
      return std::unexpected(std::move(error));
    };
    if (!has_node) {
      if (!line.starts_with("node ")) return at({"the node is not named", {}, "node 5, before the actions"});
      if (auto right = check_node(trim(line.substr(5)), node); !right) return at(right.error());
      has_node = true;
      continue;
    }
    auto action = parse_action(line);
    if (!action) return at(action.error());
    if (out.size() == most_actions)
      return at({fmt::format("more than {} actions", most_actions), {}, "conversations are short"});
    out.push_back(std::move(*action));
  }
  if (out.empty()) return fail("no action", where, "every file of a corpus is a conversation");
  return out;
}

Result<std::vector<Conversation>> read_corpus(const std::string& folder, NodeId node) {
  std::vector<Conversation> out;
  std::error_code error;
  if (!fs::exists(folder, error)) return out;
  std::vector<std::string> files;
  for (auto each = fs::directory_iterator(folder, error); !error && each != fs::directory_iterator();
       each.increment(error)) {
    if (each->path().extension() == ".txt") files.push_back(each->path().string());
    if (files.size() > most_files) return fail("too many files", folder, "begin another corpus");
  }
  if (error) return fail("not readable as a folder: " + error.message(), folder);
  std::ranges::sort(files, {}, [](const std::string& file) {
    return std::pair(!fs::path(file).filename().string().starts_with(of_findings), file);
  });
  for (const auto& file : files) {
    const auto text = read_file(file, most_bytes);
    if (!text) return std::unexpected(text.error());
    auto conversation = parse_corpus_text(*text, file, node);
    if (!conversation) return std::unexpected(conversation.error());
    out.push_back(std::move(*conversation));
  }
  return out;
}

Result<std::size_t> add_to_corpus(const std::string& folder, std::span<const Conversation> conversations,
                                  NodeId node, bool found) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return fail("the folder cannot be made: " + error.message(), folder);
  std::size_t added = 0;
  for (const auto& each : conversations) {
    const auto text = corpus_text(each, node);
    const auto path = (fs::path(folder) / (std::string(found ? of_findings : "") + name_of(text))).string();
    if (fs::exists(path, error)) continue;
    if (auto written = write_file_atomically(path, text); !written) return std::unexpected(written.error());
    ++added;
  }
  return added;
}

}  // namespace conform::explore
