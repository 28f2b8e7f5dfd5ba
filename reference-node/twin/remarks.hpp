// SPDX-License-Identifier: Apache-2.0
// What of a device description could not be served as it is written.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "eds/position.hpp"

namespace refnode {

struct TwinRemark {
  conform::eds::Position at;
  std::string text;
};

/// The first `most` remarks and the number of all others, so that a hostile file cannot fill the memory.
class TwinRemarks {
 public:
  static constexpr std::size_t most = 1000;

  void add(conform::eds::Position at, std::string text) {
    if (all_.size() < most) {
      all_.push_back({at, std::move(text)});
    } else {
      ++left_out_;
    }
  }
  [[nodiscard]] const std::vector<TwinRemark>& all() const { return all_; }
  [[nodiscard]] std::size_t left_out() const { return left_out_; }

 private:
  std::vector<TwinRemark> all_;
  std::size_t left_out_ = 0;
};

}  // namespace refnode
