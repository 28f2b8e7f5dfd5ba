// SPDX-License-Identifier: Apache-2.0
#include "cli/proof/variant_profile.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "variants/variant.hpp"

namespace conform::cli {
namespace {

device::Access access_of(refnode::Access access, device::Access declared) {
  switch (access) {
    case refnode::Access::ro: return device::Access::ro;
    case refnode::Access::wo: return device::Access::wo;
    case refnode::Access::constant: return device::Access::constant;
    case refnode::Access::rw: break;
  }
  return device::is_writable(declared) && device::is_readable(declared) ? declared : device::Access::rw;
}

}  // namespace

device::Profile profile_of_variants(const device::Profile& reference,
                                    const refnode::ObjectDictionary& dictionary,
                                    const std::vector<std::string>& variants) {
  device::Profile out = reference;
  const auto held = [&dictionary](Multiplexer mux) {
    return dictionary.entry(mux.index.value(), mux.sub.value());
  };
  const auto gone = [&held](Multiplexer mux) { return held(mux) == nullptr; };
  std::erase_if(out.objects, [&gone](const device::Entry& entry) { return gone(entry.mux); });
  std::erase_if(out.safe_objects, gone);
  std::erase_if(out.wired,
                [&gone](const device::Wire& wire) { return gone(wire.output) || gone(wire.input); });
  for (device::Entry& entry : out.objects) {
    const refnode::Entry& node_entry = *held(entry.mux);
    entry.access = access_of(node_entry.access, entry.access);
    // A default that is the standard's need not be declared, another one is.
    if (entry.default_value || node_entry.default_value != node_entry.value ||
        entry.mux.index == Index(0x1017)) {
      entry.default_value = node_entry.default_value;
      entry.default_adds_node_id = false;
    }
  }
  std::erase_if(out.errors, [&](const device::ErrorTrigger& error) {
    if (error.heartbeat_node) {
      const auto* consumer = dictionary.entry(0x1016, 1);
      return consumer == nullptr || consumer->access != refnode::Access::rw;
    }
    return (error.raise && gone(error.raise->object)) || (error.clear && gone(error.clear->object));
  });
  if (out.store_fault && gone(out.store_fault->arm.object)) out.store_fault.reset();
  if (held({Index(0x1018), SubIndex(2)}) == nullptr) out.identity.product.reset();
  if (held({Index(0x1018), SubIndex(3)}) == nullptr) out.identity.revision.reset();
  if (held({Index(0x1018), SubIndex(4)}) == nullptr) out.identity.serial.reset();
  for (const std::string& id : variants) {
    const refnode::Variant* variant = refnode::find_variant(id);
    if (variant == nullptr) continue;
    for (const auto word : variant->lacks) out.claims.erase(std::string(word));
    for (const auto word : variant->gains) out.claims.insert(std::string(word));
  }
  out.device_info.lss = out.claimed("lss");
  const auto between = [&dictionary](std::uint16_t first, std::uint16_t last) {
    const auto& objects = dictionary.objects();
    return static_cast<std::uint64_t>(std::distance(objects.lower_bound(first), objects.upper_bound(last)));
  };
  out.device_info.rpdos = between(0x1400, 0x15FF);
  out.device_info.tpdos = between(0x1800, 0x19FF);
  // Nothing is mapped variably without PDOs.
  if (!out.claimed("rpdo") && !out.claimed("tpdo")) out.claims.erase("variable mapping");
  // How quick the node is by default is said of it alone: a variant may take what a profile grants that says
  // nothing.
  const device::Profile unsaid;
  out.boot_time = unsaid.boot_time;
  out.nmt_time = unsaid.nmt_time;
  out.process_time = unsaid.process_time;
  out.quiet_time = unsaid.quiet_time;
  out.lss_timeout = unsaid.lss_timeout;
  return out;
}

}  // namespace conform::cli
