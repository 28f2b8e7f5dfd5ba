// SPDX-License-Identifier: Apache-2.0
// The verb `noise`: random frames on the request channel of the default SDO server, the same in every run.
#include <algorithm>

#include "base/random.hpp"
#include "canopen/cob_id.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

constexpr std::uint64_t most_frames = 100'000;

/// Nothing in the frame may write to an entry that exists, not even where a server completes a short frame
/// from the one before: requests that begin a download are long enough for their multiplexer, and that is
/// below 1000h, where CiA 301 (7.4.2) has data types and reserved indices. Both bytes of the index are below
/// 10h, so that a server that swaps them errs in the same area.
can::Frame random_request(std::uint64_t& state, CanId id) {
  const std::uint64_t content = next_random(state);
  const std::uint64_t form = next_random(state);
  Bytes bytes = to_le(content, 8);
  // Half of the frames are full requests: short ones end at the first check of a good server.
  std::size_t length = (form & 1U) != 0 ? 8 : (form >> 1U) % 9;
  const unsigned command = bytes[0] >> 5U;
  const bool download = command == 1 || command == 6;  // initiate, block initiate or end
  if (download) {
    length = std::max<std::size_t>(length, 4);
    bytes[1] &= 0x0FU;
    bytes[2] &= 0x0FU;
  }
  bytes.resize(length);
  return can::data_frame(id, bytes);
}

class Noise final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext&) {
    auto out = std::make_unique<Noise>();
    auto fields = value.fields("noise");
    const auto frames = fields.required("frames");
    if (frames) out->frames_ = frames.number(1, most_frames).value_or(1);
    if (const auto every = fields.optional("every")) out->every_ = parse_time_at(every);
    if (const auto seed = fields.optional("seed")) {
      out->seed_ = seed.number(0, ~std::uint64_t{0}).value_or(1);
    }
    return frames ? std::move(out) : nullptr;
  }
  std::string words(Session&) const override {
    return "send " + std::to_string(frames_) + " random SDO requests";
  }
  Result<Actual> run(Session& session) const override {
    const CanId id = canopen::connection_set(session.node()).sdo_request;
    const auto begin = session.capture().size();
    auto state = seed_;
    session.sdo_channel_dirty();
    for (std::uint64_t i = 0; i < frames_; ++i) {
      auto sent = session.send(random_request(state, id));
      if (!sent) return std::unexpected(sent.error());
      if (!every_) continue;
      auto waited = session.wait_until(session.now() + every_->resolve(session.profile()));
      if (!waited) return std::unexpected(waited.error());
    }
    session.sdo_answer_may_be_late();
    Actual out;
    out.decisive = sent_frame(session, begin);
    return out;
  }

 private:
  std::uint64_t frames_ = 1, seed_ = 1;
  std::optional<TimeReference> every_;
};

constexpr Verb table[] = {
    {"noise", "Send random frames on the SDO request CAN-ID; none of them can write to an entry that exists.",
     "frames: how many\nevery: time between two\nseed: number, for other frames (default 1)",
     "- noise: {frames: 2000, every: 2 ms}", &Noise::parse},
};

}  // namespace

std::span<const Verb> noise_verbs() { return table; }

}  // namespace conform::steps
