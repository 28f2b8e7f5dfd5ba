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

/// A manufacturer's variable that only the variant has, as its maker would describe it.
device::Entry entry_of(Multiplexer mux, const refnode::Entry& own) {
  device::Entry out;
  out.mux = mux;
  out.name = own.name;
  out.type = static_cast<canopen::DataType>(own.type);
  out.access = access_of(own.access, device::Access::rw);
  // What is computed when it is looked at has no value of its own.
  out.may_change = static_cast<bool>(own.read);
  if (!out.may_change) out.default_value = own.default_value;
  out.claimed = true;
  return out;
}

void describe_manufacturer_variables(device::Profile& out, const refnode::ObjectDictionary& dictionary) {
  const auto& objects = dictionary.objects();
  for (auto at = objects.lower_bound(0x2000); at != objects.upper_bound(0x5FFF); ++at) {
    const auto& [index, object] = *at;
    const Multiplexer mux{Index(index), SubIndex(0)};
    const bool described = std::ranges::find(out.objects, mux, &device::Entry::mux) != out.objects.end();
    if (object.kind != refnode::ObjectKind::variable || described) continue;
    out.objects.push_back(entry_of(mux, object.entries.at(0)));
    out.safe_objects.push_back(mux);
  }
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
  describe_manufacturer_variables(out, dictionary);
  // An input that is computed when it is looked at repeats no output.
  std::erase_if(out.wired, [&](const device::Wire& wire) {
    return gone(wire.output) || gone(wire.input) || held(wire.input)->read;
  });
  for (device::Entry& entry : out.objects) {
    const refnode::Entry& node_entry = *held(entry.mux);
    entry.access = access_of(node_entry.access, entry.access);
    // What an application computes when it is looked at may be something else the next time.
    if (entry.mux.index >= Index(0x2000) && node_entry.read && !entry.command) entry.may_change = true;
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
