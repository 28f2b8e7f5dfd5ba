// SPDX-License-Identifier: Apache-2.0
// libFuzzer target: SDO clients of every kind, with options and faults, against servers that are right,
// wrong, slow or forgetful. Whatever comes, a client ends, keeps no more than it was sent, and tells a
// consistent result.
//
// Input: clients (1 byte, & 1: two of them), for each a setup:
//   kind (& 3: upload, download, block upload, block download; & 4: no CRC, 8: no size, 10h: announces a
//   wrong size, 20h: short max_bytes, 40h: faults, 80h: the server has no CRC and tells no size) length[2]
//   (of the object, % 1200)  mode blksize pst server_blksize with faults: count (& 3), for each the number of
//   its phrase, K and the second number
// Then one operation in each byte (low nibble; bit 4 chooses the client):
//   0 one frame is handed over            1 as many as the client gives, at most 8 wait
//   2 one frame gets on the bus           3 all do
//   4 one frame of the server comes       5 all do
//   6 the next one comes changed: position, mask     7 one comes that nobody sent: dlc, bytes
//   8 the next one of the server is lost  9 the next one of the client is lost
//   A nothing comes in time               B the server's timer
//   C goes on without a mistake for 64 rounds
#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/fuzz/input.hpp"
#include "base/text.hpp"
#include "canopen/fuzz/right_server.hpp"
#include "canopen/sdo_request.hpp"

namespace {

using namespace conform;
using namespace conform::canopen;
using fuzz::Input;
using fuzz::RightServer;
using Kind = TransferResult::Kind;

constexpr Multiplexer object{Index(0x2008), SubIndex(0)};

Bytes pattern(std::size_t size, std::uint8_t seed) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 7U + i / 251U + seed);
  return bytes;
}

std::optional<SdoFault> fault_of(Input& input) {
  const auto phrases = sdo_fault_phrases();
  const auto phrase = phrases[input.u8() % phrases.size()];
  const auto at = std::to_string(input.u8());
  const auto other = std::to_string(input.u8());
  std::string text;
  for (const auto word : split(phrase, ' ')) {
    if (!text.empty()) text += ' ';
    const bool number = word.size() == 1 && word[0] >= 'A' && word[0] <= 'Z';
    text += number ? (word == "K" ? at : other) : std::string(word);
  }
  auto fault = SdoFault::parse(text);
  return fault ? std::optional(*fault) : std::nullopt;
}

class Pair {
 public:
  explicit Pair(Input& input) : server_({}, {}) {
    const std::uint8_t kind = input.u8();
    const std::size_t length = input.u16() % 1200U;
    SdoRequest request;
    request.object = object;
    request.upload = (kind & 1U) == 0;
    request.block = (kind & 2U) != 0;
    request.crc = (kind & 4U) == 0;
    request.size_told = (kind & 8U) == 0;
    const std::uint8_t mode = input.u8();
    request.mode = static_cast<SdoDownload::Mode>(mode % 5U);
    request.blksize = input.u8();
    request.pst = input.u8();
    RightServer::Choices choices;
    choices.crc = choices.size_told = (kind & 0x80U) == 0;
    choices.expedited = (mode & 0x80U) == 0;
    choices.switches = (mode & 0x40U) == 0;
    choices.blksize = static_cast<std::uint8_t>(input.u8() % 127U + 1U);
    if ((kind & 0x20U) != 0) request.max_bytes = 100;
    with_crc_ = request.crc && choices.crc;
    data_ = pattern(length, kind);
    if (request.upload) {
      server_ = RightServer(data_, choices);
    } else {
      request.data = data_;
      server_ = RightServer({}, choices);
    }
    if ((kind & 0x10U) != 0 && !request.upload) request.announced = input.u16();
    if ((kind & 0x40U) != 0) {
      for (int count = input.u8() & 3; count > 0; --count) {
        if (auto fault = fault_of(input)) request.faults.push_back(*fault);
      }
    }
    auto client = make_sdo_client(request);
    if (!client) {
      // What has no place in this transfer is refused; the transfer without it is not, unless the data do not
      // fit.
      request.faults.clear();
      request.announced.reset();
      client = make_sdo_client(request);
    }
    if (!client) {
      request.mode = SdoDownload::Mode::automatic;
      client = make_sdo_client(request);
    }
    CONFORM_CHECK(client.has_value());
    client_ = std::move(*client);
    request_ = std::move(request);
  }

  void operation(unsigned code, Input& input) {
    switch (code) {
      case 0: give(); return;
      case 1:
        while (give()) {
        }
        return;
      case 2: transmit(); return;
      case 3: transmit_all(); return;
      case 4: receive(); return;
      case 5: receive_all(); return;
      case 6: return changed(input);
      case 7: return invented(input);
      case 8:
        if (server_.out.empty()) return;
        server_.out.pop_front();
        impatient_ = true;
        return;
      case 9:
        if (!waiting_.empty()) waiting_.pop_front();
        return;
      case 10: silence(); return;
      case 11: impatient_ = true; return server_.on_timer();
      case 12:
        for (int i = 0; i < 64 && !client_->ended(); ++i) round();
        return;
      default: return;
    }
  }

  /// The bus is right from now on, and so is the server: the client ends, and after a clean run it got what
  /// it wanted.
  void finish() {
    for (int rounds = 0; !client_->ended() && rounds < 4000; ++rounds) {
      const auto before = steps_;
      round();
      if (steps_ == before) server_.on_timer();
      if (steps_ == before && server_.out.empty()) silence();
    }
    CONFORM_CHECK(client_->ended());
    while (give()) CONFORM_CHECK(false);  // nothing after the end
    judge();
  }

 private:
  void round() {
    while (give()) {
    }
    transmit_all();
    receive_all();
  }

  bool give() {
    if (waiting_.size() >= 8) return false;
    const auto frame = client_->next(waiting_.size());
    if (!frame) return false;
    ++steps_;
    CONFORM_CHECK(frame->size <= 8);
    CONFORM_CHECK(!ended_before_);
    if (request_.block && !request_.upload && request_.faults.empty() &&
        frame->part == SdoFrame::Part::segment) {
      CONFORM_CHECK(++in_block_ <= blksize_);
      CONFORM_CHECK((frame->bytes[0] & 0x7FU) == in_block_);
    }
    CONFORM_CHECK(++given_ <= 40'000);
    waiting_.push_back(*frame);
    ended_before_ = client_->ended();
    return true;
  }
  void transmit() {
    if (waiting_.empty()) return;
    const auto frame = waiting_.front();
    waiting_.pop_front();
    server_.on_frame(frame.view());
  }
  void transmit_all() {
    while (!waiting_.empty()) transmit();
  }

  void receive() {
    if (server_.out.empty()) return;
    const auto data = server_.out.front();
    server_.out.pop_front();
    hear(data);
  }
  void receive_all() {
    // A client that has something to say in between says it: frames that come too early are another
    // operation.
    while (!server_.out.empty()) receive();
  }
  void changed(Input& input) {
    if (server_.out.empty()) return;
    auto data = server_.out.front();
    server_.out.pop_front();
    const std::uint8_t position = input.u8();
    data[position & 7U] = static_cast<std::uint8_t>(data[position & 7U] ^ input.u8());
    honest_ = false;
    hear(data);
  }
  void invented(Input& input) {
    const auto bytes = input.take(input.u8() % 9U);
    honest_ = false;
    hear(bytes);
  }
  void hear(ByteView data) {
    if (client_->ended()) return;  // as the caller does
    ++heard_;
    const bool taken = client_->on_frame(data, waiting_.size());
    if (taken) ++steps_;
    if (taken && data.size() == 8 && (data[0] & 0xE1U) == 0xA0U) {
      blksize_ = (data[0] & 2U) != 0 ? data[2] : data[4];
      in_block_ = 0;
    }
    bounded();
  }
  void silence() {
    if (client_->ended()) return;
    // Time runs out only when everything is on the bus.
    transmit_all();
    client_->on_silence();
    ++steps_;
    bounded();
  }

  void bounded() const {
    const auto& result = client_->result();
    CONFORM_CHECK(result.data.size() <= 7 * heard_);
    // A second transfer, begun on purpose, has the usual bound.
    CONFORM_CHECK(!request_.faults.empty() || result.data.size() <= request_.max_bytes + 7);
    CONFORM_CHECK(result.remarks.size() <= 16);
  }

  void judge() const {
    const auto& result = client_->result();
    const auto& counts = result.counts;
    bounded();
    switch (result.kind) {
      case Kind::confirmed: CONFORM_CHECK(result.detail.empty() && !result.reply); break;
      case Kind::aborted: CONFORM_CHECK(!result.reply); break;
      case Kind::violation: CONFORM_CHECK(!result.detail.empty()); break;
      case Kind::silence: CONFORM_CHECK(result.abandoned || result.reply); break;
      case Kind::gave_up: CONFORM_CHECK(!request_.faults.empty()); break;
    }
    if (result.kind != Kind::confirmed || !request_.faults.empty()) return;
    if (request_.upload) {
      if (result.announced_size) CONFORM_CHECK(result.data.size() == *result.announced_size);
      if (request_.block && !counts.switched && counts.crc_agreed == true) {
        CONFORM_CHECK(counts.crc_ok == true && counts.crc == RightServer::crc(result.data));
      }
      if (honest_) CONFORM_CHECK(result.data == data_);
    } else if (honest_ && !(impatient_ && request_.block && !with_crc_)) {
      // Without a CRC nobody sees that segments were stored twice: when two acknowledgements are under way,
      // or one got lost, the second speaks of what the server took for a new sub-block.
      CONFORM_CHECK(
          server_.object() ==
          (request_.mode == SdoDownload::Mode::expedited_unsized && !request_.block ? padded(data_) : data_));
    }
  }
  static Bytes padded(Bytes data) {
    data.resize(4);
    return data;
  }

  SdoRequest request_;
  std::unique_ptr<SdoClient> client_;
  RightServer server_;
  Bytes data_;
  std::deque<SdoFrame> waiting_;  ///< handed over, not on the bus yet
  std::size_t heard_ = 0, given_ = 0, in_block_ = 0;
  std::uint64_t steps_ = 0;
  std::uint8_t blksize_ = 0;
  bool honest_ = true, ended_before_ = false, with_crc_ = false;
  bool impatient_ = false;  ///< acknowledged a part of a sub-block in time, or an acknowledgement was lost
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  std::vector<std::unique_ptr<Pair>> pairs;
  for (int count = 1 + (input.u8() & 1); count > 0; --count) pairs.push_back(std::make_unique<Pair>(input));
  while (!input.empty()) {
    const std::uint8_t code = input.u8();
    pairs[(code >> 4U & 1U) % pairs.size()]->operation(code & 0x0FU, input);
  }
  for (auto& pair : pairs) pair->finish();
  return 0;
}
