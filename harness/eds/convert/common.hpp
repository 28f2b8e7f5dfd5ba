// SPDX-License-Identifier: Apache-2.0
// What both directions of a conversion share.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "eds/convert/unsaid.hpp"

namespace conform::eds {

/// The list of what is left behind, as it grows.
class UnsaidList {
 public:
  void add(std::string where, std::string_view key, const Field& field, std::string why) {
    all_.push_back({std::move(where), std::string(key), shortened(field.text), std::move(why), field.at});
  }
  void add(std::string where, std::string why, Position at = {}) {
    all_.push_back({std::move(where), {}, {}, std::move(why), at});
  }
  [[nodiscard]] std::vector<Unsaid> take() { return std::move(all_); }

 private:
  std::vector<Unsaid> all_;
};

[[nodiscard]] inline Field said(std::string text, Position at = {}) {
  return {std::move(text), at, at, true};
}

}  // namespace conform::eds
