// SPDX-License-Identifier: Apache-2.0
// Segmented transfers behind their initiate (CiA 301, 7.2.4.3.4 and 7.2.4.3.7).
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "sdo/choices.hpp"
#include "sdo/frames.hpp"
#include "sdo/rules.hpp"

namespace refnode {

class SegmentedUpload {
 public:
  SegmentedUpload(const SdoChoices& choices, const SegmentedRules& rules, Multiplexer mux, Bytes data)
      : choices_(&choices), rules_(&rules), mux_(mux), data_(std::move(data)) {}

  [[nodiscard]] SdoReply segment(const SdoData& request);
  [[nodiscard]] Multiplexer mux() const { return mux_; }
  [[nodiscard]] bool finished() const { return finished_; }

 private:
  const SdoChoices* choices_;
  const SegmentedRules* rules_;
  Multiplexer mux_;
  Bytes data_;
  std::size_t position_ = 0;  ///< next byte to send
  bool toggle_ = false;       ///< expected next
  bool finished_ = false;
};

class SegmentedDownload {
 public:
  SegmentedDownload(const SdoChoices& choices, const SegmentedRules& rules, Multiplexer mux,
                    std::optional<std::size_t> announced)
      : choices_(&choices), rules_(&rules), mux_(mux), announced_(announced) {}

  [[nodiscard]] SdoReply segment(const SdoData& request, const ObjectDictionary& dictionary);
  [[nodiscard]] Multiplexer mux() const { return mux_; }
  [[nodiscard]] bool finished() const { return finished_; }

 private:
  [[nodiscard]] Accepted store() const;

  const SdoChoices* choices_;
  const SegmentedRules* rules_;
  Multiplexer mux_;
  std::optional<std::size_t> announced_;
  Bytes data_;           ///< received so far; grows with what comes, whatever was announced
  bool toggle_ = false;  ///< expected next
  bool finished_ = false;
};

}  // namespace refnode
