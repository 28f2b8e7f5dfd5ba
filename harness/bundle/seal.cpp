// SPDX-License-Identifier: Apache-2.0
#include "bundle/seal.hpp"

#include <algorithm>

#include "bundle/archive.hpp"
#include "bundle/digest.hpp"

namespace conform::bundle {
namespace {

constexpr std::int64_t nanoseconds = 1'000'000'000;

}  // namespace

Result<Bytes> seal(Manifest manifest, const std::vector<Content>& contents, const PrivateKey* key) {
  std::vector<const Content*> sorted;
  for (const auto& each : contents) sorted.push_back(&each);
  std::ranges::sort(sorted, {}, [](const Content* each) -> const std::string& { return each->name; });
  manifest.files.clear();
  std::uint64_t total = 0;
  for (const auto* each : sorted) {
    total += each->bytes.size();
    manifest.files.push_back({each->name, each->role, each->bytes.size(), sha256(each->bytes)});
  }
  manifest.signer = key == nullptr ? std::string() : key->fingerprint();
  const auto text = to_json(manifest);
  // Who unpacks it would refuse what is refused here.
  if (const auto read = parse_manifest(text); !read)
    return fail("cannot be made: of its manifest, " + read.error().what);
  if (text.size() > largest_manifest) return fail("cannot be made: its manifest is too large");

  // The time stamp of a tar is not negative everywhere.
  Packer packer(std::max<std::int64_t>(manifest.run.started_utc_ns / nanoseconds, 0));
  if (auto added = packer.add(manifest_name, bytes_of(text)); !added) return std::unexpected(added.error());
  if (key != nullptr) {
    if (auto added = packer.add(signature_name, key->sign(bytes_of(text))); !added)
      return std::unexpected(added.error());
  }
  for (const auto* each : sorted) {
    if (auto added = packer.add(each->name, bytes_of(each->bytes)); !added)
      return std::unexpected(added.error());
  }
  auto out = packer.finish();
  if (out && total > suspicious_size && total / most_packed > out->size())
    return fail("cannot be made: so much that packs so well is taken for an attack by who unpacks it");
  return out;
}

}  // namespace conform::bundle
