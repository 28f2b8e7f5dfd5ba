// SPDX-License-Identifier: Apache-2.0
#include "bundle/keys.hpp"

#include <openssl/bio.h>
#include <openssl/crypto.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include "base/check.hpp"
#include "base/files.hpp"
#include "bundle/digest.hpp"

namespace conform::bundle {
namespace {

constexpr std::uint64_t largest_key = 64 * 1024;

constexpr const char* how_made = "openssl genpkey -algorithm ed25519 -out KEY.pem";
constexpr const char* how_public = "openssl pkey -in KEY.pem -pubout -out PUBLIC.pem";

using Key = std::shared_ptr<evp_pkey_st>;
using Context = std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)>;

Key owned(EVP_PKEY* key) { return {key, EVP_PKEY_free}; }

/// Nobody is asked: a run has no terminal to ask at.
int no_passphrase(char* /*buffer*/, int /*size*/, int /*writing*/, void* asked) {
  *static_cast<bool*>(asked) = true;
  return -1;
}

std::string fingerprint_of(EVP_PKEY* key) {
  unsigned char* der = nullptr;
  const int size = i2d_PUBKEY(key, &der);
  CONFORM_CHECK(size > 0);
  auto out = sha256(ByteView(der, static_cast<std::size_t>(size)));
  OPENSSL_free(der);
  return out;
}

/// What OpenSSL has to say about a key is no help to the user, and must not be left for its next caller.
struct ForgetErrors {
  ForgetErrors() = default;
  ForgetErrors(const ForgetErrors&) = delete;
  ForgetErrors& operator=(const ForgetErrors&) = delete;
  ~ForgetErrors() { ERR_clear_error(); }
};

struct PemFile {
  std::string text;
  std::unique_ptr<BIO, decltype(&BIO_free)> bio{nullptr, BIO_free};

  PemFile() = default;
  PemFile(const PemFile&) = delete;
  PemFile& operator=(const PemFile&) = delete;
  ~PemFile() { OPENSSL_cleanse(text.data(), text.size()); }

  Result<void> open(const std::string& path) {
    auto content = read_file(path, largest_key);
    if (!content) return std::unexpected(content.error());
    text.swap(*content);
    OPENSSL_cleanse(content->data(), content->size());
    bio.reset(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
    CONFORM_CHECK(bio != nullptr);
    return {};
  }
};

bool is_ed25519(const Key& key) { return EVP_PKEY_get_id(key.get()) == EVP_PKEY_ED25519; }

}  // namespace

Result<PrivateKey> PrivateKey::read(const std::string& path) {
  const ForgetErrors forget;
  PemFile file;
  if (auto opened = file.open(path); !opened) return std::unexpected(opened.error());
  bool asked = false;
  PrivateKey out;
  out.key_ = owned(PEM_read_bio_PrivateKey(file.bio.get(), nullptr, no_passphrase, &asked));
  if (asked)
    return fail("the key is behind a passphrase, and a run cannot ask for it", path,
                "openssl pkey -in KEY.pem -out PLAIN.pem, for as long as it is needed");
  if (out.key_ == nullptr && file.text.find("BEGIN PUBLIC KEY") != std::string::npos)
    return fail("is a public key: signing takes the private one", path, how_made);
  if (out.key_ == nullptr) return fail("is no private key in PEM", path, how_made);
  if (!is_ed25519(out.key_)) return fail("is no Ed25519 key", path, how_made);
  out.fingerprint_ = fingerprint_of(out.key_.get());
  return out;
}

Bytes PrivateKey::sign(ByteView bytes) const {
  const Context context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  Bytes out(signature_size);
  std::size_t size = out.size();
  CONFORM_CHECK(context != nullptr &&
                EVP_DigestSignInit(context.get(), nullptr, nullptr, nullptr, key_.get()) == 1);
  CONFORM_CHECK(EVP_DigestSign(context.get(), out.data(), &size, bytes.data(), bytes.size()) == 1 &&
                size == signature_size);
  return out;
}

Result<PublicKey> PublicKey::read(const std::string& path) {
  const ForgetErrors forget;
  PemFile file;
  if (auto opened = file.open(path); !opened) return std::unexpected(opened.error());
  PublicKey out;
  out.key_ = owned(PEM_read_bio_PUBKEY(file.bio.get(), nullptr, nullptr, nullptr));
  if (out.key_ == nullptr && file.text.find("PRIVATE KEY-----") != std::string::npos)
    return fail("is a private key: verifying takes the public one", path, how_public);
  if (out.key_ == nullptr) return fail("is no public key in PEM", path, how_public);
  if (!is_ed25519(out.key_)) return fail("is no Ed25519 key", path, how_made);
  out.fingerprint_ = fingerprint_of(out.key_.get());
  return out;
}

bool PublicKey::verifies(ByteView bytes, ByteView signature) const {
  const ForgetErrors forget;
  const Context context(EVP_MD_CTX_new(), EVP_MD_CTX_free);
  CONFORM_CHECK(context != nullptr &&
                EVP_DigestVerifyInit(context.get(), nullptr, nullptr, nullptr, key_.get()) == 1);
  return signature.size() == signature_size &&
         EVP_DigestVerify(context.get(), signature.data(), signature.size(), bytes.data(), bytes.size()) == 1;
}

}  // namespace conform::bundle
