// SPDX-License-Identifier: Apache-2.0
// A small SDO server with block transfers for tests of the client, written from the tables of CiA 301 once
// more and without the codec under test: frame in, frames out. One object.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace conform::testing {

class ScriptedServer {
 public:
  using Frame = std::array<std::uint8_t, 8>;

  // What a test arranges.
  std::vector<std::uint8_t> data;     ///< the object
  std::deque<std::uint8_t> blksizes;  ///< of the answers of a download, one after the other; then 127
  bool crc = true;                    ///< supported
  bool size_told = true;
  bool acks_gaps_at_once = false;             ///< acknowledges at the gap, not at the end of the sub-block
  bool switches = false;                      ///< to the normal upload where pst allows
  std::size_t abort_at_segment = 0;           ///< of a download: aborts with 0800 0020h when it comes
  std::size_t most_sent_at_once = 1'000'000;  ///< of an upload: stops in the middle of a sub-block
  // What it saw.
  std::size_t written = 0;  ///< downloads that were completed

  [[nodiscard]] bool idle() const { return phase_ == Phase::idle; }
  /// The answers to one request, in order.
  std::vector<Frame> on_request(const std::uint8_t* bytes, std::size_t size) {
    out_.clear();
    if (size == 8) {
      Frame frame{};
      std::copy_n(bytes, 8, frame.begin());
      handle(frame);
    }
    return out_;
  }

 private:
  enum class Phase {
    idle,
    block_download,
    block_download_end,
    block_upload,
    upload_sent,
    block_upload_end,
    upload
  };

  void handle(const Frame& in) {
    if (in[0] == 0x80) {
      phase_ = Phase::idle;
      return;
    }
    if (phase_ == Phase::block_download) return segment(in);
    if ((in[0] & 0xE1) == 0xC0) return begin_download(in);
    if ((in[0] & 0xE3) == 0xA0) return begin_upload(in);
    if (in[0] == 0x40) return expedited(in);
    if (phase_ == Phase::block_download_end && (in[0] & 0xE3) == 0xC1) return end_download(in);
    if (phase_ == Phase::block_upload && in[0] == 0xA3) return send_sub_block();
    if (phase_ == Phase::upload_sent && in[0] == 0xA2) return acknowledged(in);
    if (phase_ == Phase::block_upload_end && in[0] == 0xA1) {
      phase_ = Phase::idle;
      return;
    }
    abort(0x05040001);
  }

  void abort(std::uint32_t code) {
    phase_ = Phase::idle;
    out_.push_back({0x80, mux_[0], mux_[1], mux_[2], static_cast<std::uint8_t>(code),
                    static_cast<std::uint8_t>(code >> 8U), static_cast<std::uint8_t>(code >> 16U),
                    static_cast<std::uint8_t>(code >> 24U)});
  }
  void note_object(const Frame& in) { mux_ = {in[1], in[2], in[3]}; }
  std::uint8_t next_blksize() {
    if (blksizes.empty()) return 127;
    const auto size = blksizes.front();
    if (blksizes.size() > 1) blksizes.pop_front();
    return size;
  }

  void expedited(const Frame& in) {
    note_object(in);
    phase_ = Phase::idle;
    out_.push_back({0x43, in[1], in[2], in[3], 0x91, 0x01, 0, 0});
  }

  void begin_download(const Frame& in) {
    note_object(in);
    phase_ = Phase::block_download;
    crc_agreed_ = crc && (in[0] & 4) != 0;
    incoming_.clear();
    good_ = 0;
    came_ = 0;
    gap_ = false;
    last_ = false;
    blksize_ = next_blksize();
    out_.push_back({static_cast<std::uint8_t>(crc ? 0xA4 : 0xA0), in[1], in[2], in[3], blksize_});
  }

  void segment(const Frame& in) {
    const auto number = static_cast<std::uint8_t>(in[0] & 0x7F);
    const bool last = (in[0] & 0x80) != 0;
    if (abort_at_segment != 0 && ++came_ == abort_at_segment) return abort(0x08000020);
    if (gap_ && good_ == 0 && number != 1 && acks_gaps_at_once) return;  // rest of the broken sub-block
    if (number == good_ + 1) {
      good_ = number;
      gap_ = false;
      incoming_.insert(incoming_.end(), in.begin() + 1, in.end());
      last_ = last;
    } else if (number > good_ + 1) {
      gap_ = true;
      if (acks_gaps_at_once) return acknowledge();
    }
    if (last || number == blksize_) acknowledge();
  }

  void acknowledge() {
    const auto ackseq = good_;
    good_ = 0;
    blksize_ = next_blksize();
    if (last_) phase_ = Phase::block_download_end;
    if (!acks_gaps_at_once) gap_ = false;
    out_.push_back({0xA2, ackseq, blksize_});
  }

  void end_download(const Frame& in) {
    const auto unused = static_cast<std::size_t>(in[0] >> 2U & 7U);
    if (incoming_.size() < unused) return abort(0x05040001);
    incoming_.resize(incoming_.size() - unused);
    const auto got = static_cast<std::uint16_t>(in[1] | in[2] << 8U);
    if (crc_agreed_ && got != crc_of(incoming_)) return abort(0x05040004);
    data = incoming_;
    ++written;
    phase_ = Phase::idle;
    out_.push_back({0xA1});
  }

  void begin_upload(const Frame& in) {
    note_object(in);
    if (in[4] == 0 || in[4] > 127) return abort(0x05040002);
    if (switches && data.size() <= 4 && in[5] >= data.size()) {
      Frame answer{static_cast<std::uint8_t>(0x43U | (4 - data.size()) << 2U), in[1], in[2], in[3]};
      std::copy(data.begin(), data.end(), answer.begin() + 4);
      out_.push_back(answer);
      return;
    }
    phase_ = Phase::block_upload;
    crc_agreed_ = crc && (in[0] & 4) != 0;
    blksize_ = in[4];
    sent_ = 0;
    Frame answer{static_cast<std::uint8_t>(0xC0U | (crc ? 4U : 0U) | (size_told ? 2U : 0U)), in[1], in[2],
                 in[3]};
    if (size_told) {
      for (unsigned i = 0; i < 4; ++i) answer[4 + i] = static_cast<std::uint8_t>(data.size() >> (8U * i));
    }
    out_.push_back(answer);
  }

  [[nodiscard]] std::size_t segments() const { return std::max<std::size_t>(1, (data.size() + 6) / 7); }

  void send_sub_block() {
    phase_ = Phase::upload_sent;
    in_block_ = std::min<std::size_t>({blksize_, segments() - sent_, most_sent_at_once});
    for (std::size_t i = 1; i <= in_block_; ++i) {
      const auto from = (sent_ + i - 1) * 7;
      Frame frame{static_cast<std::uint8_t>(i)};
      for (std::size_t k = 0; k < 7 && from + k < data.size(); ++k) frame[1 + k] = data[from + k];
      if (sent_ + i == segments()) frame[0] |= 0x80;
      out_.push_back(frame);
    }
  }

  void acknowledged(const Frame& in) {
    if (in[1] > in_block_) return abort(0x05040003);
    sent_ += in[1];
    if (sent_ < segments()) {
      if (in[2] == 0 || in[2] > 127) return abort(0x05040002);
      blksize_ = in[2];
      return send_sub_block();
    }
    phase_ = Phase::block_upload_end;
    const auto unused = segments() * 7 - data.size();
    const auto sum = crc_agreed_ ? crc_of(data) : std::uint16_t{0};
    out_.push_back({static_cast<std::uint8_t>(0xC1U | unused << 2U), static_cast<std::uint8_t>(sum),
                    static_cast<std::uint8_t>(sum >> 8U)});
  }

  static std::uint16_t crc_of(const std::vector<std::uint8_t>& bytes) {
    unsigned sum = 0;
    for (const auto byte : bytes) {
      sum ^= static_cast<unsigned>(byte) << 8U;
      for (int i = 0; i < 8; ++i) sum = (sum & 0x8000U) != 0 ? (sum << 1U ^ 0x1021U) & 0xFFFFU : sum << 1U;
    }
    return static_cast<std::uint16_t>(sum);
  }

  Phase phase_ = Phase::idle;
  std::array<std::uint8_t, 3> mux_{};
  std::vector<Frame> out_;
  std::vector<std::uint8_t> incoming_;
  bool crc_agreed_ = false, gap_ = false, last_ = false;
  std::uint8_t blksize_ = 127, good_ = 0;
  std::size_t came_ = 0, sent_ = 0, in_block_ = 0;
};

}  // namespace conform::testing
