// SPDX-License-Identifier: Apache-2.0
#include "storage/parameter_store.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace refnode {

namespace {

constexpr std::uint8_t sub_all = 1;
constexpr std::uint8_t sub_communication = 2;
constexpr std::uint8_t sub_application = 3;
constexpr std::uint8_t sub_last = 0x7F;    // from 04h on: parameters of the manufacturer
constexpr std::uint64_t on_command = 1;    // capability, bit 0
constexpr std::uint64_t autonomously = 2;  // of 1010h only, bit 1
constexpr Group all_groups[] = {Group::communication, Group::application, Group::manufacturer};

// The signature in transmission order, least significant byte first.
bool matches(std::string_view wanted, ByteView signature, const StoreFaults& fault) {
  std::string given(signature.begin(), signature.end());
  if (fault.byte_order_wrong) std::reverse(given.begin(), given.end());
  if (fault.case_ignored) {
    for (char& letter : given) {
      if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    }
  }
  return given == wanted;
}

bool is_parameter(const Entry& entry) {
  return (entry.access == Access::rw || entry.access == Access::wo) && !entry.command && entry.storable;
}

std::vector<Group> groups_of(std::uint8_t sub, const StoreFaults& fault) {
  const bool nothing = (sub == sub_communication && fault.sub2_without_effect) ||
                       (sub == sub_application && fault.sub3_without_effect);
  if (nothing) return {};
  if (fault.groups_mixed) return {std::begin(all_groups), std::end(all_groups)};
  switch (sub) {
    case sub_all: return {std::begin(all_groups), std::end(all_groups)};
    case sub_communication: return {Group::communication};
    case sub_application: return {Group::application};
    default: return {Group::manufacturer};
  }
}

}  // namespace

ParameterStore::ParameterStore(Device& device, std::shared_ptr<Storage> storage)
    : device_(&device), storage_(std::move(storage)), stamp_(device) {}

void ParameterStore::add_objects() {
  stamp_.add_objects();
  ObjectDictionary& od = device_->dictionary;
  od.add_complex(0x1010, "Store parameters", ObjectKind::array);
  od.add_complex(0x1011, "Restore default parameters", ObjectKind::array);
  constexpr const char* names[] = {"", "All parameters", "Communication parameters",
                                   "Application parameters"};
  for (const std::uint8_t sub : {sub_all, sub_communication, sub_application}) {
    // Reading gives the capability: bit 0, on command.
    od.add_sub(0x1010, sub, integer_entry(names[sub], DataType::unsigned32, Access::rw, on_command));
    od.add_sub(0x1011, sub, integer_entry(names[sub], DataType::unsigned32, Access::rw, on_command));
  }
  Entry& failing =
      od.add_variable(0x2F20, integer_entry("Storage fault", DataType::unsigned8, Access::rw, 0));
  failing.storable = false;
}

void ParameterStore::bind() {
  stamp_.bind();
  using Command = Accepted (ParameterStore::*)(std::uint8_t, ByteView);
  const auto bind_object = [this](std::uint16_t index, Command command) {
    const auto object = device_->dictionary.objects().find(index);
    if (object == device_->dictionary.objects().end()) return;
    for (auto& [sub, entry] : object->second.entries) {
      if (sub == 0 || sub > sub_last) continue;
      entry.command = true;
      // A description may give the signature as the only value; what is wrong about another the command says.
      entry.low.reset();
      entry.high.reset();
      if ((entry.number() & on_command) != 0) {
        entry.check = [this, command, which = sub](ByteView bytes) { return (this->*command)(which, bytes); };
      } else {
        entry.check = [](ByteView) -> Accepted { return refuse(abort_code::cannot_store); };
      }
    }
  };
  bind_object(0x1010, &ParameterStore::save);
  bind_object(0x1011, &ParameterStore::restore);

  device_->dictionary.on_download = [this](Multiplexer mux) { store_soon(mux); };
}

/// Where the group has a sub-index of its own, that one decides, and "all parameters" says it of the rest.
std::vector<Group> ParameterStore::stored_autonomously() const {
  std::vector<Group> out;
  for (const Group group : all_groups) {
    const std::uint8_t own = group == Group::communication ? sub_communication
                             : group == Group::application ? sub_application
                                                           : sub_all;
    const std::uint8_t sub = device_->dictionary.entry(0x1010, own) != nullptr ? own : sub_all;
    const bool by_itself = (device_->dictionary.number(0x1010, sub) & autonomously) != 0;
    if (by_itself && !restored_.contains(group)) out.push_back(group);
  }
  return out;
}

void ParameterStore::store_soon(Multiplexer mux) {
  const Entry* entry = device_->dictionary.entry(mux.index.value(), mux.sub.value());
  if (entry == nullptr || !is_parameter(*entry)) return;
  const std::vector<Group> stored = stored_autonomously();
  if (std::ranges::find(stored, group_of(mux.index)) == stored.end()) return;
  store_at_ = device_->now + device_->choices.rest_before_storing;
  if (device_->choices.rest_before_storing == Duration::zero()) on_time();
}

void ParameterStore::on_time() {
  if (!store_at_ || device_->now < *store_at_) return;
  store_at_.reset();
  // Nobody asked, so nobody can be told that it failed.
  [[maybe_unused]] const auto kept = store(stored_autonomously(), {});
}

Accepted ParameterStore::store(const std::vector<Group>& groups, const StoreFaults& fault) {
  Images images = storage_->images();
  for (const Group group : groups) images[group] = image_of(group, images[group]);
  const bool with_stamp = std::ranges::find(groups, Group::communication) != groups.end();
  const bool outdated = stamp_.before_storing(storage_->images(), images, with_stamp);
  if (auto kept = keep(std::move(images), fault); !kept) return kept;
  stamp_.after_storing(outdated, with_stamp);
  return {};
}

Image ParameterStore::image_of(Group group, const Image& former) const {
  Image image;
  for (const auto& [index, object] : device_->dictionary.objects()) {
    if (group_of(conform::Index(index)) != group) continue;
    for (const auto& [sub, entry] : object.entries) {
      if (!is_parameter(entry)) continue;
      const Multiplexer mux{conform::Index(index), conform::SubIndex(sub)};
      if (!entry.not_stored_now || !entry.not_stored_now()) {
        image[mux] = entry.value;
      } else if (const auto kept = former.find(mux); kept != former.end()) {
        image[mux] = kept->second;
      }
    }
  }
  return image;
}

Entry* ParameterStore::storage_fault() const {
  return device_->described ? nullptr : device_->dictionary.entry(0x2F20, 0);
}

Accepted ParameterStore::keep(Images images, const StoreFaults& fault) {
  const Entry* armed = storage_fault();
  const bool failed =
      (armed != nullptr && conform::load_le(armed->value) != 0) || !storage_->replace(std::move(images));
  if (!failed || fault.failure_confirmed) return {};
  return refuse(fault.failure_aborted_as_refusal ? abort_code::cannot_store : abort_code::hardware_error);
}

Accepted ParameterStore::save(std::uint8_t sub, ByteView signature) {
  const StoreFaults& fault = device_->behaviour.store;
  const bool good = matches("save", signature, fault);
  if (!good && !fault.signature_unchecked && !fault.acts_on_wrong_signature)
    return refuse(device_->choices.wrong_signature);
  if (good && device_->choices.storing_needs_pre_operational && device_->state == NmtState::operational)
    return refuse(abort_code::device_state);
  if (!fault.without_effect) {
    if (auto kept = store(groups_of(sub, fault), fault); !kept) return kept;
    for (const Group group : groups_of(sub, fault)) restored_.erase(group);
  }
  if (!good && !fault.signature_unchecked) return refuse(device_->choices.wrong_signature);
  return {};
}

Accepted ParameterStore::restore(std::uint8_t sub, ByteView signature) {
  const StoreFaults& fault = device_->behaviour.restore;
  const bool good = matches("load", signature, fault);
  if (!good && !fault.signature_unchecked && !fault.acts_on_wrong_signature)
    return refuse(device_->choices.wrong_signature);
  if (!fault.without_effect) {
    // The stored values go at once, the present ones stay until the reset that makes the defaults valid.
    Images images = storage_->images();
    for (const Group group : groups_of(sub, fault)) images.erase(group);
    stamp_.before_restoring(storage_->images(), images);
    if (auto kept = keep(std::move(images), fault); !kept) return kept;
    for (const Group group : groups_of(sub, fault)) restored_.insert(group);
    if (fault.effective_at_once) {
      for (const Group group : groups_of(sub, fault)) load(group);
    }
  }
  if (!good && !fault.signature_unchecked) return refuse(device_->choices.wrong_signature);
  return {};
}

bool ParameterStore::keeps(Group group, bool whole_node) const {
  const Behaviour& behaviour = device_->behaviour;
  if (group == Group::communication) {
    return whole_node ? behaviour.reset_node_keeps_communication : behaviour.reset_communication_keeps_values;
  }
  return whole_node ? behaviour.reset_node_keeps_application
                    : !behaviour.reset_communication_resets_application;
}

void ParameterStore::load_power_on_values(bool whole_node) {
  store_at_.reset();
  restored_.clear();
  stamp_.on_reset();
  for (const Group group : all_groups) {
    if (!keeps(group, whole_node)) load(group);
  }
  if (Entry* armed = storage_fault(); armed != nullptr && whole_node) armed->value = armed->default_value;
}

void ParameterStore::load(Group group) {
  const auto stored = storage_->images().find(group);
  const bool usable = stored != storage_->images().end() && !device_->behaviour.stored_values_ignored;
  for (auto& [index, object] : device_->dictionary.objects()) {
    if (group_of(conform::Index(index)) != group) continue;
    for (auto& [sub, entry] : object.entries) {
      if (!is_parameter(entry)) {
        // What is never stored begins with its default as well.
        if (entry.access == Access::rw && !entry.command) entry.value = entry.default_value;
        continue;
      }
      entry.value = entry.default_value;
      if (!usable) continue;
      const auto value = stored->second.find({conform::Index(index), conform::SubIndex(sub)});
      if (value == stored->second.end()) continue;
      // An image of another version of the device may hold another length: such a value is left out.
      const std::size_t fixed = fixed_size(entry.type);
      const std::size_t size = value->second.size();
      if (fixed != 0 ? size == fixed : size <= entry.max_size) entry.value = value->second;
    }
  }
}

}  // namespace refnode
