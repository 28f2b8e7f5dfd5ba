// SPDX-License-Identifier: Apache-2.0
#include "steps/sdo_access.hpp"

namespace conform::steps {

Actual outcome_of(const SdoAnswer& answer) {
  using Kind = SdoAnswer::Kind;
  Actual out;
  out.decisive = answer.decisive;
  out.data = answer.data;
  switch (answer.kind) {
    case Kind::confirmed: out.kind = Actual::Kind::confirmed; return out;
    case Kind::aborted:
      out.kind = Actual::Kind::aborted;
      out.code = answer.code;
      return out;
    case Kind::silence: out.kind = Actual::Kind::silence; break;
    case Kind::gave_up:
    case Kind::violation: out.kind = Actual::Kind::violation; break;
  }
  out.detail = answer.detail;
  return out;
}

Result<Actual> read(Session& session, Multiplexer object) {
  const auto answer = session.upload(object, std::nullopt);
  if (!answer) return std::unexpected(answer.error());
  auto out = outcome_of(*answer);
  if (answer->kind == SdoAnswer::Kind::confirmed) out.measured["size_open"] = answer->size_indicated ? 0 : 1;
  return out;
}

Result<Actual> write(Session& session, Multiplexer object, const Bytes& bytes) {
  const auto answer = session.download(object, bytes, canopen::SdoDownload::Mode::automatic, std::nullopt);
  if (!answer) return std::unexpected(answer.error());
  return outcome_of(*answer);
}

Result<Actual> write(Session& session, Multiplexer object, std::uint64_t value, std::size_t size) {
  return write(session, object, to_le(value, size));
}

}  // namespace conform::steps
