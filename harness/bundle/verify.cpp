// SPDX-License-Identifier: Apache-2.0
#include "bundle/verify.hpp"

#include <algorithm>

#include "bundle/walk.hpp"

namespace conform::bundle {
namespace {

/// Keeps those of some roles.
class Keep final : public Sink {
 public:
  explicit Keep(const std::vector<std::string_view>& roles) : roles_(roles) {}

  Result<void> begin(const File& file) override {
    wanted_ = std::ranges::find(roles_, file.role) != roles_.end();
    if (wanted_) kept.push_back({file.name, file.role, {}});
    return {};
  }
  Result<void> add(ByteView bytes) override {
    if (wanted_) kept.back().bytes.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return {};
  }
  Result<void> end() override { return {}; }

  std::vector<Content> kept{};

 private:
  const std::vector<std::string_view>& roles_;
  bool wanted_ = false;
};

}  // namespace

std::string_view to_string(Problem::Kind kind) {
  using Kind = Problem::Kind;
  switch (kind) {
    case Kind::changed: return "changed";
    case Kind::missing: return "missing";
    case Kind::extra: return "extra";
    case Kind::repeated: return "repeated";
    case Kind::unsafe_name: return "unsafe name";
    case Kind::not_a_file: return "not a file";
    case Kind::manifest: return "manifest";
    case Kind::signature: return "signature";
    case Kind::damaged: return "damaged";
    case Kind::too_large: return "too large";
  }
  return "unknown";
}

std::string_view to_string(Verification::Signature signature) {
  using Signature = Verification::Signature;
  switch (signature) {
    case Signature::none: return "none";
    case Signature::unchecked: return "unchecked";
    case Signature::good: return "good";
    case Signature::wrong: return "wrong";
  }
  return "unknown";
}

Result<Verification> verify(const std::string& path, const PublicKey* key) {
  return walk(path, key, nullptr);
}

Result<std::vector<Content>> contents(const std::string& path, const std::vector<std::string_view>& roles,
                                      Manifest* manifest) {
  Keep keep(roles);
  auto found = walk(path, nullptr, &keep);
  if (!found) return std::unexpected(found.error());
  if (!found->not_a_bundle.empty()) return fail("is no bundle: " + found->not_a_bundle, path);
  if (!found->problems.empty()) return fail("is not whole: " + found->problems.front().what, path);
  if (manifest != nullptr) *manifest = std::move(found->manifest);
  return std::move(keep.kept);
}

}  // namespace conform::bundle
