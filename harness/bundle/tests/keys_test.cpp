// SPDX-License-Identifier: Apache-2.0
#include <openssl/evp.h>
#include <openssl/pem.h>

#include "bundle/tests/archives.hpp"

using namespace conform;
using namespace conform::bundle;
using namespace conform::bundle::tests;

namespace {

using Told = std::vector<std::string>;
using Signature = Verification::Signature;

/// Files of a pair of keys, as the openssl program makes them.
struct Pair {
  std::string secret, open;

  Pair(const Folder& folder, const std::string& name, const char* kind = "ED25519",
       const char* pass = nullptr)
      : secret(folder / (name + ".pem")), open(folder / (name + ".pub.pem")) {
    EVP_PKEY* key = std::string(kind) == "RSA" ? EVP_PKEY_Q_keygen(nullptr, nullptr, "RSA", std::size_t{2048})
                                               : EVP_PKEY_Q_keygen(nullptr, nullptr, kind);
    REQUIRE(key != nullptr);
    auto* file = std::fopen(secret.c_str(), "w");
    PEM_write_PrivateKey(file, key, pass == nullptr ? nullptr : EVP_aes_256_cbc(),
                         reinterpret_cast<const unsigned char*>(pass), pass == nullptr ? 0 : 4, nullptr,
                         nullptr);
    std::fclose(file);
    file = std::fopen(open.c_str(), "w");
    PEM_write_PUBKEY(file, key);
    std::fclose(file);
    EVP_PKEY_free(key);
  }
};

const std::vector<Content> contents_in{{"a.txt", "report", "first"}};

}  // namespace

TEST_CASE("the signature of a bundle is that of its key, and of no other") {
  const Folder folder;
  const Pair mine(folder, "mine"), other(folder, "other");
  const auto secret = PrivateKey::read(mine.secret);
  const auto open = PublicKey::read(mine.open);
  const auto wrong = PublicKey::read(other.open);
  REQUIRE((secret && open && wrong));
  CHECK(secret->fingerprint() == open->fingerprint());
  const auto bytes = seal({.tool = "t"}, contents_in, &*secret);
  REQUIRE(bytes);
  CHECK(*seal({.tool = "t"}, contents_in, &*secret) == *bytes);
  const std::string text(bytes->begin(), bytes->end());

  const auto good = verified(folder, text, &*open);
  CHECK(good.good());
  CHECK(good.signature == Signature::good);
  CHECK(good.manifest.signer == open->fingerprint());
  const auto unchecked = verified(folder, text);
  CHECK(unchecked.good());
  CHECK(unchecked.signature == Signature::unchecked);
  const auto bad = verified(folder, text, &*wrong);
  CHECK(told(bad) == Told{"signature MANIFEST.sig"});
  CHECK(bad.problems.front().what.find(wrong->fingerprint()) != std::string::npos);
  CHECK(bad.signature == Signature::wrong);
  REQUIRE(extract(folder / "x.tar.zst", &*open, folder / "out"));
  CHECK(fs::file_size(folder / "out/MANIFEST.sig") == signature_size);
}

TEST_CASE("a bundle without a signature is not good for who has a key") {
  const Folder folder;
  const Pair mine(folder, "mine");
  const auto open = PublicKey::read(mine.open);
  const auto bytes = seal({.tool = "t"}, contents_in, nullptr);
  const auto found = verified(folder, {bytes->begin(), bytes->end()}, &*open);
  CHECK(told(found) == Told{"signature MANIFEST.sig"});
  CHECK(found.signature == Signature::wrong);
}

TEST_CASE("a signed manifest that is changed, or whose signature is taken away, is told") {
  const Folder folder;
  const Pair mine(folder, "mine");
  const auto secret = PrivateKey::read(mine.secret);
  const auto open = PublicKey::read(mine.open);
  const std::vector<Raw> files{{"a.txt", "first"}};
  const auto manifest = manifest_of(files, open->fingerprint());
  const auto made = secret->sign(bytes_of(manifest));
  const Raw signature{"MANIFEST.sig", std::string(made.begin(), made.end())};
  std::vector<Raw> entries{{"MANIFEST.json", manifest}, signature, files[0]};
  REQUIRE(verified(folder, packed(entries), &*open).good());

  SECTION("another file, and a manifest that fits it") {
    entries[2].content = "other";
    entries[0].content = manifest_of({entries[2]}, open->fingerprint());
    CHECK(verified(folder, packed(entries)).good());  // who has no key cannot see it
    CHECK(told(verified(folder, packed(entries), &*open)) == Told{"signature MANIFEST.sig"});
  }
  SECTION("the signature is taken away") {
    entries.erase(entries.begin() + 1);
    CHECK(told(verified(folder, packed(entries), &*open)) == Told{"missing MANIFEST.sig"});
    CHECK(told(verified(folder, packed(entries))) == Told{"missing MANIFEST.sig"});
  }
  SECTION("and the manifest does not tell of one any more") {
    entries.erase(entries.begin() + 1);
    entries[0].content = manifest_of(files);
    CHECK(told(verified(folder, packed(entries), &*open)) == Told{"signature MANIFEST.sig"});
  }
  SECTION("a bit of the signature is another one") {
    entries[1].content[10] = static_cast<char>(entries[1].content[10] ^ 1);
    CHECK(told(verified(folder, packed(entries), &*open)) == Told{"signature MANIFEST.sig"});
  }
  SECTION("the signature is longer, or shorter, or a link") {
    entries[1].content += "x";
    CHECK_FALSE(verified(folder, packed(entries), &*open).good());
    entries[1].content.resize(10);
    CHECK_FALSE(verified(folder, packed(entries), &*open).good());
    entries[1] = {"MANIFEST.sig", "", AE_IFLNK, "a.txt"};
    CHECK_FALSE(verified(folder, packed(entries), &*open).good());
  }
  SECTION("the signature is there twice") {
    entries.push_back(signature);
    CHECK(told(verified(folder, packed(entries), &*open)) == Told{"repeated MANIFEST.sig"});
  }
}

TEST_CASE("a file that is no fitting key is refused with a reason") {
  const Folder folder;
  const Pair mine(folder, "mine"), rsa(folder, "rsa", "RSA"), locked(folder, "locked", "ED25519", "pass");
  CHECK(PrivateKey::read(mine.open).error().what.find("public key") != std::string::npos);
  CHECK(PublicKey::read(mine.secret).error().what.find("private key") != std::string::npos);
  CHECK(PrivateKey::read(rsa.secret).error().what == "is no Ed25519 key");
  CHECK(PublicKey::read(rsa.open).error().what == "is no Ed25519 key");
  CHECK(PrivateKey::read(locked.secret).error().what.find("passphrase") != std::string::npos);
  CHECK_FALSE(PrivateKey::read(folder / "none"));
  const auto text = folder / "text";
  REQUIRE(write_file_atomically(text, std::string_view("no key")));
  CHECK(PrivateKey::read(text).error().what == "is no private key in PEM");
  CHECK(PublicKey::read(text).error().what == "is no public key in PEM");
}
