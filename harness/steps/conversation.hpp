// SPDX-License-Identifier: Apache-2.0
// Frames as the standard prints them: lines that are sent, lines that must come, silences. Pure: parsing and
// matching.
//
//   > 600+N: 40 {m} 00 00 00 00          sent; `..` fills with 00
//   < 580+N: 41 {m} {size:4}             must come next on that CAN-ID; {size:4} is remembered
//   < 580+N: 80 {m} {abort: 0503 0000h; warn 0504 0001h}
//   silence 580+N for T_QUIET
//
// Bytes: HH exact, x as a digit any, xx any, zz 00 expected (other values warn), N the node-ID, {m} the
// multiplexer of the conversation's object, {name:n} n bytes, {name@from:n} a slice (where the data end
// before it does, its last bytes are unused ones: any), .. the rest. IDs are hexadecimal. Behind the bytes:
// `within 200 ms`, `RTR`, `EXT`, `DLC3`.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "can/frame.hpp"
#include "steps/outcome.hpp"
#include "steps/step.hpp"

namespace conform::steps {

/// One element of a line's bytes.
struct BytePattern {
  enum class Kind : std::uint8_t { exact, node, any, reserved, multiplexer, name, abort, rest };
  Kind kind = Kind::exact;
  std::uint8_t value = 0, mask = 0xFF;  ///< exact; a digit x clears four bits of the mask
  std::string name;
  std::size_t from = 0, size = 0;               ///< name: bytes from..from+size; size 0: all that remain
  bool slice = false;                           ///< name: written with '@'
  std::vector<AbortCode> passes, warns, fails;  ///< abort
  bool warns_any = false;                       ///< abort: any code that is not named warns
  int column = 0, length = 1;                   ///< code points in the line, for messages

  /// Number of bytes, or nullopt for "the rest".
  [[nodiscard]] std::optional<std::size_t> width() const;
};

struct Line {
  enum class Kind : std::uint8_t { send, receive, silence };
  Kind kind = Kind::send;
  std::uint32_t id = 0;
  bool add_node = false;
  std::vector<BytePattern> bytes;
  bool remote = false, extended = false;
  std::optional<std::uint8_t> dlc;
  std::optional<TimeReference> time;  ///< within / for
  std::string text;                   ///< as written, without comment
  int number = 0;                     ///< line in the block, from 0

  [[nodiscard]] CanId can_id(NodeId node) const { return CanId(id + (add_node ? node.value() : 0U)); }
};

struct Problem {
  int line = 0;    ///< line in the text, from 0
  int column = 0;  ///< code point in the line, from 0
  int length = 1;
  std::string what, hint;
};

/// Reads all lines; every mistake is in `problems`.
[[nodiscard]] std::vector<Line> parse_conversation(std::string_view text, std::vector<Problem>& problems);

/// Bytes of a line to send. Error: a name without value, or more than eight bytes.
[[nodiscard]] Result<can::Frame> build_frame(const Line& line, Scope& scope,
                                             std::optional<Multiplexer> object);

/// How a frame compares with a line.
struct Comparison {
  bool equal = false;
  std::optional<std::size_t> first_wrong;  ///< byte index; the frame's size when it is too short
  std::string reason;
  std::vector<std::string> tolerated;                ///< reserved bytes not zero, abort codes that only warn
  std::vector<std::pair<std::string, Bytes>> names;  ///< what {name:n} met
};
[[nodiscard]] Comparison compare(const Line& line, const can::Frame& frame, Scope& scope,
                                 std::optional<Multiplexer> object);

}  // namespace conform::steps
