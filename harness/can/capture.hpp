// SPDX-License-Identifier: Apache-2.0
// Every frame of a run in order, with stamps, directions and comments; what reports and capture files are
// made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "can/transport.hpp"

namespace conform::can {

/// What is said of a frame, if anything is. A run keeps every frame, and most have none: it takes the room of
/// a pointer.
class Comment {
 public:
  Comment() = default;
  Comment(std::string_view text) { set(text); }
  Comment(const std::string& text) { set(text); }
  Comment(const char* text) { set(text); }
  Comment(const Comment& other) { set(other.view()); }
  Comment(Comment&&) noexcept = default;
  Comment& operator=(const Comment& other) { return set(other.view()); }
  Comment& operator=(Comment&&) noexcept = default;
  ~Comment() = default;

  [[nodiscard]] bool empty() const { return text_ == nullptr; }
  [[nodiscard]] bool contains(std::string_view part) const { return view().contains(part); }
  [[nodiscard]] std::string_view view() const {
    return text_ ? std::string_view(*text_) : std::string_view();
  }
  void append(std::string_view text) { set(std::string(view()).append(text)); }
  friend bool operator==(const Comment& a, const Comment& b) { return a.view() == b.view(); }

 private:
  Comment& set(std::string_view text) {
    text_ = text.empty() ? nullptr : std::make_unique<std::string>(text);
    return *this;
  }
  std::unique_ptr<std::string> text_;
};

struct CapturedFrame {
  Frame frame{};
  BusTime time{};
  Direction direction = Direction::received;
  Comment comment{};  ///< shown by Wireshark as packet comment
};

/// What a capture file says about itself besides the frames.
struct CaptureInfo {
  std::string interface_name = "can0";  ///< blanks and control characters are written as '_'
  std::int64_t epoch_ns = 0;            ///< UTC of BusTime 0, in ns since 1970-01-01
  std::string tool{};                   ///< program and version that made the file; pcapng only
  std::string comment{};                ///< about the whole run; pcapng only
};

/// Frames in the order of receive(). Indices are stable: findings refer to frames by them.
class Capture {
 public:
  void add(const BusEvent& event) { frames_.push_back({event.frame, event.time, event.direction, {}}); }
  void add(CapturedFrame frame) { frames_.push_back(std::move(frame)); }
  /// Room for so many frames: to move a hundred megabytes in the middle of a transfer takes longer than the
  /// device may wait. What is not used costs address space only.
  void reserve(std::size_t frames) { frames_.reserve(frames); }
  /// Appends `text` to the comment of frame `index` (separated by "; ").
  void comment(std::size_t index, std::string_view text);
  /// Continues the comment of frame `index` by `text`, where it ends with `end`.
  void continue_comment(std::size_t index, std::string_view end, std::string_view text);
  [[nodiscard]] const std::vector<CapturedFrame>& frames() const { return frames_; }
  [[nodiscard]] std::size_t size() const { return frames_.size(); }

 private:
  std::vector<CapturedFrame> frames_;
};

/// A capture as read from a file. Its time 0 is the first frame's stamp; info.epoch_ns tells when that was.
struct LoadedCapture {
  Capture capture;
  CaptureInfo info;
  /// Bytes at the end of the file that are the beginning of a block or line which was never completed: the
  /// program that recorded it was killed. They are left out.
  std::size_t cut_off = 0;
};

}  // namespace conform::can
