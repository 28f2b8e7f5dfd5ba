// SPDX-License-Identifier: Apache-2.0
// An SDO transfer as scenarios write it, for the verbs that run one or several: its keys, its words, and what
// came of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "steps/step.hpp"

namespace conform::steps {

/// The outcome of a transfer, measurements included.
[[nodiscard]] Actual to_actual(const SdoAnswer& answer, const Session& session, Multiplexer object,
                               bool upload);

/// The measurements it may have.
[[nodiscard]] Measures measures_of(bool upload, bool block);

/// Reproducible bytes for `pattern`; visible characters where the entry wants them.
[[nodiscard]] Bytes pattern_bytes(std::size_t size, bool visible);

/// A phrase of `fault`; numbers in it, or all of it, may be $names.
class FaultPhrase {
 public:
  static std::optional<FaultPhrase> parse(const yaml::Field& field, const NameCheck& names);
  [[nodiscard]] Result<canopen::SdoFault> resolve(Scope& scope) const;
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

class SdoStep {
 public:
  /// Mistakes go to the diagnostics; nullopt when nothing can be run.
  static std::optional<SdoStep> parse_upload(const yaml::Field& value, ParseContext& context);
  static std::optional<SdoStep> parse_download(const yaml::Field& value, ParseContext& context);

  [[nodiscard]] bool is_upload() const { return upload_; }
  /// The lowest tier it may run at, as far as its words tell.
  [[nodiscard]] Need need() const;
  [[nodiscard]] const ObjectReference& object() const { return object_; }
  [[nodiscard]] std::string words(Session& session) const;
  [[nodiscard]] Measures measures() const;
  /// Of an automatic transfer nobody knows before whether it takes segments.
  [[nodiscard]] Channels rests_on() const;
  [[nodiscard]] Result<SdoJob> job(Session& session) const;
  /// Saves what was asked to be saved, and tells what came.
  [[nodiscard]] Actual conclude(Session& session, const SdoJob& job, const SdoAnswer& answer) const;

 private:
  struct Channel {
    Expression request, response;
  };
  void parse_common(yaml::Fields& fields, ParseContext& context);
  void parse_content(yaml::Fields& fields, ParseContext& context);
  [[nodiscard]] std::optional<canopen::DataType> type_of(const Session& session, Multiplexer object) const;
  [[nodiscard]] Result<Bytes> encode(Session& session, Multiplexer object) const;

  bool upload_ = true;
  ObjectReference object_;
  std::string transfer_;  ///< as written; empty: automatic
  Expression value_, pattern_, size_, blksize_, pst_;
  std::optional<Bytes> bytes_;
  std::optional<canopen::DataType> as_;
  bool crc_ = true;
  std::vector<FaultPhrase> faults_;
  std::optional<Channel> channel_;
  std::optional<TimeReference> timeout_, wait_;
  std::string save_;
};

}  // namespace conform::steps
