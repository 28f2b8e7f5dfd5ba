// SPDX-License-Identifier: Apache-2.0
#include "canopen/sdo_client.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/text.hpp"
#include "canopen/abort_code.hpp"

namespace conform::canopen {
namespace {

constexpr std::size_t max_remarks = 16;

}  // namespace

void SdoClient::violation(std::string detail, std::optional<AbortCode> reply) {
  result_.detail = std::move(detail);
  result_.reply = reply;
  finish(Kind::violation);
}

void SdoClient::remark(std::string text) {
  if (result_.remarks.size() >= max_remarks) return;
  if (std::ranges::find(result_.remarks, text) == result_.remarks.end())
    result_.remarks.push_back(std::move(text));
}

bool SdoClient::take_abort(ByteView bytes, Multiplexer mux, bool maybe_unknown) {
  const auto found = decode_abort(bytes);
  if (!found) return false;
  if (found->reserved_bits)
    remark(fmt::format("reserved bits of the abort command are set ({})", hex(bytes[0], 2)));
  result_.code = found->code;
  const bool unknown =
      maybe_unknown && found->code == abort::command_specifier && found->mux == Multiplexer{};
  if (found->mux != mux && !unknown) {
    violation(fmt::format("aborts {} instead of {} ({})", to_string(found->mux), to_string(mux),
                          describe(found->code)),
              std::nullopt);
  } else {
    finish(Kind::aborted);
  }
  return true;
}

void SdoClient::give_up_waiting() {
  result_.reply = abort::timed_out;
  finish(Kind::silence);
}

bool any_set(ByteView bytes) {
  return std::ranges::any_of(bytes, [](std::uint8_t byte) { return byte != 0; });
}

std::string too_short(ByteView bytes) {
  return fmt::format("answers with a frame of {} data byte{} instead of 8", bytes.size(),
                     bytes.size() == 1 ? "" : "s");
}

std::string wrong_command(std::uint8_t command, std::string_view due) {
  return fmt::format("answers with command {} where {} is due", hex(command, 2), due);
}

std::string wrong_object(Multiplexer got, Multiplexer wanted) {
  return fmt::format("answers {} instead of {}", to_string(got), to_string(wanted));
}

}  // namespace conform::canopen
