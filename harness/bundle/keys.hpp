// SPDX-License-Identifier: Apache-2.0
// Ed25519 keys as `openssl genpkey -algorithm ed25519` makes them, and signatures by them.
#pragma once

#include <memory>
#include <string>

#include "base/bytes.hpp"
#include "base/error.hpp"

struct evp_pkey_st;

namespace conform::bundle {

inline constexpr std::size_t signature_size = 64;

class PrivateKey {
 public:
  /// From a PEM file. Error: no such file, another kind of key, a public one, one behind a passphrase.
  [[nodiscard]] static Result<PrivateKey> read(const std::string& path);
  /// The signature (RFC 8032) of all of these bytes, `signature_size` long.
  [[nodiscard]] Bytes sign(ByteView bytes) const;
  /// That of its public half.
  [[nodiscard]] const std::string& fingerprint() const { return fingerprint_; }

 private:
  std::shared_ptr<evp_pkey_st> key_;
  std::string fingerprint_;
};

class PublicKey {
 public:
  /// From a PEM file. Error: no such file, another kind of key, a private one.
  [[nodiscard]] static Result<PublicKey> read(const std::string& path);
  /// Whether the owner of the private half signed exactly these bytes.
  [[nodiscard]] bool verifies(ByteView bytes, ByteView signature) const;
  /// SHA-256 of the key in DER (SubjectPublicKeyInfo), 64 hexadecimal digits: what
  /// `openssl pkey -pubin -in KEY -outform DER | sha256sum` prints.
  [[nodiscard]] const std::string& fingerprint() const { return fingerprint_; }

 private:
  std::shared_ptr<evp_pkey_st> key_;
  std::string fingerprint_;
};

}  // namespace conform::bundle
