// SPDX-License-Identifier: Apache-2.0
// Monitors of SDO transfers of several frames.
#include <fmt/format.h>

#include "base/text.hpp"
#include "monitor/factories.hpp"

namespace conform::monitor {
namespace {

using result::Verdict;

bool is_response(Observation::Subject subject) { return subject == Observation::Subject::sdo_response; }
bool is_response(const Observation& seen) { return seen.subject == Observation::Subject::sdo_response; }

class SdoToggle final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { upload, download };

  [[nodiscard]] bool wants(Observation::Subject subject) const override { return is_response(subject); }
  void on_frame(const Observation& seen, const Follower&) override {
    if (!is_response(seen) || !seen.answer.toggle) return;
    const auto toggle = *seen.answer.toggle;
    const auto requirement = seen.answer.asked == Asked::upload_segment ? upload : download;
    if (toggle.got == toggle.wanted) return good(requirement);
    if (!bad(requirement)) return;
    tell(requirement, seen, fmt::format("toggle bit {}", toggle.got ? 1 : 0),
         fmt::format("toggle bit {}", toggle.wanted ? 1 : 0), "the toggle bit of the request is mirrored");
  }
};

class SdoSize final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { segmented, block };

  [[nodiscard]] bool wants(Observation::Subject subject) const override { return is_response(subject); }
  void on_frame(const Observation& seen, const Follower&) override {
    if (!is_response(seen) || !seen.answer.size) return;
    const auto size = *seen.answer.size;
    const auto requirement = seen.answer.block ? block : segmented;
    if (size.announced == size.delivered) return good(requirement);
    if (!bad(requirement)) return;
    tell(requirement, seen,
         fmt::format("{} bytes delivered{}", size.delivered,
                     size.delivered > size.announced && !seen.answer.end ? " so far" : ""),
         fmt::format("{} bytes", size.announced), "the size that was announced is the number of bytes");
  }
};

class SdoBlockUpload final : public Monitor {
 public:
  using Monitor::Monitor;
  enum : std::size_t { numbers, block_size, crc, no_crc, unused };

  [[nodiscard]] bool wants(Observation::Subject subject) const override { return is_response(subject); }
  void on_frame(const Observation& seen, const Follower&) override {
    if (!is_response(seen)) return;
    if (seen.answer.segment) segment(seen, *seen.answer.segment);
    if (seen.answer.end) end(seen, *seen.answer.end);
  }

 private:
  void segment(const Observation& seen, const SdoAnswer::Segment& segment) {
    if (segment.too_many) {
      if (bad(block_size)) {
        tell(block_size, seen, fmt::format("a further frame, number {}", segment.got), "an acknowledge first",
             fmt::format("the sub-block of at most {} segments was complete", segment.block_size));
      }
      return;
    }
    good(block_size);
    if (segment.got == segment.wanted) return good(numbers);
    if (bad(numbers)) {
      tell(numbers, seen, fmt::format("segment number {}", segment.got), fmt::format("{}", segment.wanted),
           "the segments of a sub-block are numbered 1, 2, ...");
    }
  }

  void end(const Observation& seen, const SdoAnswer::End& end) {
    if (end.unused_wanted) {
      if (end.unused == *end.unused_wanted) {
        good(unused);
      } else if (bad(unused)) {
        tell(unused, seen, fmt::format("n = {}", end.unused), fmt::format("n = {}", *end.unused_wanted),
             "n counts the bytes of the last segment behind the announced size");
      }
    }
    if (!end.agreed) {
      if (end.got == 0) return good(no_crc);
      if (bad(no_crc)) {
        tell(no_crc, seen, fmt::format("CRC {}", hex(end.got, 4)), "0000h", "no CRC was agreed",
             Verdict::warn);
      }
      return;
    }
    // With a wrong n the bytes that the CRC is about are not known.
    if (!end.wanted || (end.unused_wanted && *end.unused_wanted != end.unused)) return;
    if (end.got == *end.wanted) return good(crc);
    if (!bad(crc)) return;
    tell(crc, seen, fmt::format("CRC {}", hex(end.got, 4)), hex(*end.wanted, 4),
         "the CRC is about the bytes that were delivered, without those that n counts");
  }
};

class SdoBlockDownload final : public Monitor {
 public:
  using Monitor::Monitor;

  [[nodiscard]] bool wants(Observation::Subject subject) const override { return is_response(subject); }
  void on_frame(const Observation& seen, const Follower&) override {
    if (!is_response(seen) || !seen.answer.block_size) return;
    const auto size = *seen.answer.block_size;
    if (size >= 1 && size <= 127) return good(0);
    if (!bad(0)) return;
    tell(0, seen, fmt::format("block size {}", size), "1 to 127", "a block has 1 to 127 segments");
  }
};

}  // namespace

std::unique_ptr<Monitor> make_sdo_toggle(const Rule& rule) { return std::make_unique<SdoToggle>(rule); }
std::unique_ptr<Monitor> make_sdo_size(const Rule& rule) { return std::make_unique<SdoSize>(rule); }
std::unique_ptr<Monitor> make_sdo_block_upload(const Rule& rule) {
  return std::make_unique<SdoBlockUpload>(rule);
}
std::unique_ptr<Monitor> make_sdo_block_download(const Rule& rule) {
  return std::make_unique<SdoBlockDownload>(rule);
}

}  // namespace conform::monitor
