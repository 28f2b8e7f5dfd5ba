// SPDX-License-Identifier: Apache-2.0
// SHA-256, by OpenSSL.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "base/text_bytes.hpp"

struct evp_md_ctx_st;

namespace conform::bundle {

/// Of bytes that come in parts.
class Sha256 {
 public:
  Sha256();
  void add(ByteView bytes);
  /// 64 lower-case hexadecimal digits. Nothing may be added afterwards.
  [[nodiscard]] std::string hex();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

[[nodiscard]] std::string sha256(ByteView bytes);
[[nodiscard]] std::string sha256(std::string_view bytes);

}  // namespace conform::bundle
