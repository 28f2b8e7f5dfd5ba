// SPDX-License-Identifier: Apache-2.0
// Verbs of the SDO client: upload, download, and the change of a COB-ID by the procedure the standard
// prescribes.
#include <algorithm>

#include "base/text.hpp"
#include "canopen/cob_id.hpp"
#include "steps/sdo_step.hpp"
#include "steps/verb_tables.hpp"

namespace conform::steps {
namespace {

/// upload and download
class Transfer final : public Action {
 public:
  static std::unique_ptr<Action> parse_upload(const yaml::Field& value, ParseContext& context) {
    return made(SdoStep::parse_upload(value, context));
  }
  static std::unique_ptr<Action> parse_download(const yaml::Field& value, ParseContext& context) {
    return made(SdoStep::parse_download(value, context));
  }
  explicit Transfer(SdoStep step) : step_(std::move(step)) {}

  bool rests_on_time() const override { return false; }
  std::string words(Session& session) const override { return step_.words(session); }
  Need need() const override { return step_.need(); }
  const ObjectReference* object() const override { return &step_.object(); }
  Measures measures() const override { return step_.measures(); }
  Channels rests_on() const override { return step_.rests_on(); }

  Result<Actual> run(Session& session) const override {
    auto job = step_.job(session);
    if (!job) return std::unexpected(job.error());
    auto answers = session.transfer({*job});
    if (!answers) return std::unexpected(answers.error());
    return step_.conclude(session, *job, answers->front());
  }

 private:
  static std::unique_ptr<Action> made(std::optional<SdoStep> step) {
    return step ? std::make_unique<Transfer>(std::move(*step)) : nullptr;
  }
  SdoStep step_;
};

/// CiA 301 locks bits 0-29 while the service is active, so a change takes three writes: off, change, on.
class SetCobId final : public Action {
 public:
  static std::unique_ptr<Action> parse(const yaml::Field& value, ParseContext& context) {
    auto out = std::make_unique<SetCobId>();
    auto fields = value.fields("set_cob_id");
    const auto object = fields.required("object");
    const auto to = fields.required("to");
    if (object) {
      if (auto parsed = parse_object_at(object, context.names)) out->object_ = *parsed;
    }
    if (to) {
      if (auto parsed = parse_expression_at(to, context.names)) out->to_ = *parsed;
    }
    return object && to ? std::move(out) : nullptr;
  }

  bool rests_on_time() const override { return false; }
  std::string words(Session& session) const override {
    const auto object = object_.resolve(session);
    const auto to = to_.evaluate(session);
    return "set COB-ID " + (object ? to_string(*object) : object_.text()) + " to " +
           (to ? to->text() : to_.text()) + " (off, change, on)";
  }
  const ObjectReference* object() const override { return &object_; }

  Result<Actual> run(Session& session) const override {
    const auto object = object_.resolve(session);
    if (!object) return std::unexpected(object.error());
    const auto to = to_.number(session);
    if (!to) return std::unexpected(to.error());
    const auto kind = canopen::cob_id_kind(*object);
    if (!kind) return fail_scenario(to_string(*object) + " is no COB-ID");
    auto before = session.upload(*object, std::nullopt);
    if (!before) return std::unexpected(before.error());
    if (before->kind != SdoAnswer::Kind::confirmed || before->data.size() != 4) {
      return to_actual(*before, session, *object, true);
    }
    const CobId old(static_cast<std::uint32_t>(load_le(before->data)));
    const CobId target(static_cast<std::uint32_t>(*to));
    for (const auto value : canopen::change_sequence(*kind, old, target)) {
      auto answer = session.download(*object, to_le(value.value(), 4), canopen::SdoDownload::Mode::automatic,
                                     std::nullopt);
      if (!answer) return std::unexpected(answer.error());
      auto actual = to_actual(*answer, session, *object, false);
      if (actual.kind != Actual::Kind::confirmed) {
        return actual;
      }
      actual.detail = "confirmed";
      if (value == target) return actual;
    }
    return fail("unreachable");
  }

 private:
  ObjectReference object_;
  Expression to_;
};

constexpr Verb table[] = {
    {"upload", "Read an entry by SDO.",
     "object: the entry, 1003h:00 or $name\nsave: name that the data get\n"
     "transfer: automatic (the server chooses), block\nblksize, pst: of a block upload (default 127 and 0)\n"
     "crc: whether a block transfer asks for the CRC (default true)\n"
     "channel: {request: 6C0h, response: 6C1h}, another SDO channel\n"
     "timeout: how long an answer may take (default: profile)\n"
     "fault: what the client does wrong, a phrase or a list (writing-scenarios.md has all): lose segment 2, abort after segment 3, ...\n"
     "wait: how long to listen after a fault (default: $profile.quiet_time)\n"
     "measured: segments, announced, size_open, latency; block: sub_blocks, retransmitted, crc_agreed, crc_ok, crc, unused, switched, wrong_numbers, "
     "timeouts; fault: surplus, answers",
     "- upload: {object: 1003h:00, save: count}\n  checks: OD-1003-01\n  expect: {size: 1, range: 0..FEh}",
     &Transfer::parse_upload},
    {"download", "Write an entry by SDO. The engine puts the old value back.",
     "object: the entry\nvalue: number, $name or expression, encoded with the entry's type\nbytes: data as they are, \"E8 03\"\n"
     "text: characters\npattern: N bytes, the same in every run\nas: data type to encode with when it is not the entry's own\n"
     "transfer: automatic, expedited, expedited without size, segmented, segmented without size, block, block without size\n"
     "size: announces so many bytes, whatever is delivered\nsave: name that the data get\n"
     "crc, channel, timeout, fault, wait: as with upload\n"
     "measured: segments; block: sub_blocks, retransmitted, acks, first_ackseq, blksize, crc_agreed; fault: surplus, answers",
     "- download: {object: 1003h:00, value: 02h}\n  checks: OD-1003-06\n  expect: abort 0609 0030h\n  warn: [abort 0609 0031h]",
     &Transfer::parse_download},
    {"set_cob_id", "Change a COB-ID by the procedure of the standard: switch off, change, switch on.",
     "object: the COB-ID entry\nto: its new value, control bits included",
     "- set_cob_id: {object: 1014h:00, to: 6A0h}\n  checks: OD-1014-07", &SetCobId::parse},
};

}  // namespace

std::span<const Verb> sdo_verbs() { return table; }

}  // namespace conform::steps
