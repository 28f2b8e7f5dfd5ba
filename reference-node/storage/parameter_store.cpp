// SPDX-License-Identifier: Apache-2.0
#include "storage/parameter_store.hpp"

#include <algorithm>
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

// Index 0000h is no entry of the dictionary: places in the memory.
constexpr Multiplexer node_id_setting{conform::Index(0), conform::SubIndex(1)};
constexpr Multiplexer bit_rate_setting{conform::Index(0), conform::SubIndex(2)};

// The text in transmission order, least significant byte first.
bool is_signature(std::string_view wanted, ByteView given) {
  return std::ranges::equal(
      wanted, given, [](char one, std::uint8_t other) { return static_cast<std::uint8_t>(one) == other; });
}

bool is_parameter(const Entry& entry) {
  return (entry.access == Access::rw || entry.access == Access::wo) && !entry.command && entry.storable;
}

std::vector<Group> groups_of(std::uint8_t sub) {
  switch (sub) {
    case sub_all: return {std::begin(all_groups), std::end(all_groups)};
    case sub_communication: return {Group::communication};
    case sub_application: return {Group::application};
    default: return {Group::manufacturer};
  }
}

}  // namespace

PowerOnRules::PowerOnRules()
    : reset_loads([](Group group, bool whole_node) { return whole_node || group == Group::communication; }),
      stored_values([](const Images& images, Group group) { return images.contains(group); }) {}

ParameterStore::ParameterStore(Device& device, std::shared_ptr<Storage> storage)
    : stamp(device), memory(std::move(storage)), device_(&device) {}

void ParameterStore::add_objects() {
  stamp.add_objects();
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
  stamp.bind();
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
  store_at_ = device_->now + choices.rest_before_storing;
  if (choices.rest_before_storing == Duration::zero()) on_time();
}

void ParameterStore::on_time() {
  if (!store_at_ || device_->now < *store_at_) return;
  store_at_.reset();
  // Nobody asked, so nobody can be told that it failed.
  [[maybe_unused]] const auto kept = store(stored_autonomously());
}

Accepted ParameterStore::store(const std::vector<Group>& groups) {
  Images images = memory->images();
  for (const Group group : groups) images[group] = image_of(group, images[group]);
  const bool with_stamp = std::ranges::find(groups, Group::communication) != groups.end();
  const bool outdated = stamp.before_storing(memory->images(), images, with_stamp);
  if (auto kept = keep(std::move(images)); !kept) return kept;
  stamp.after_storing(outdated, with_stamp);
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

Accepted ParameterStore::keep(Images images) {
  const Entry* armed = storage_fault();
  if (armed != nullptr && armed->number() != 0) return refuse(abort_code::hardware_error);
  if (!memory->replace(std::move(images))) return refuse(abort_code::hardware_error);
  return {};
}

Accepted ParameterStore::save(std::uint8_t sub, ByteView signature) {
  if (!is_signature("save", signature)) return refuse(choices.wrong_signature);
  if (choices.storing_needs_pre_operational && device_->state == NmtState::operational)
    return refuse(abort_code::device_state);
  if (auto kept = store(groups_of(sub)); !kept) return kept;
  for (const Group group : groups_of(sub)) restored_.erase(group);
  return {};
}

// The stored values go at once, the present ones stay until the reset that makes the defaults valid.
Accepted ParameterStore::restore(std::uint8_t sub, ByteView signature) {
  if (!is_signature("load", signature)) return refuse(choices.wrong_signature);
  Images images = memory->images();
  for (const Group group : groups_of(sub)) images.erase(group);
  stamp.before_restoring(memory->images(), images);
  if (auto kept = keep(std::move(images)); !kept) return kept;
  for (const Group group : groups_of(sub)) restored_.insert(group);
  return {};
}

bool ParameterStore::store_layer_setting(std::uint8_t node_id, std::optional<std::uint8_t> bit_rate) {
  Images images = memory->images();
  Image& image = images[Group::layer_setting];
  image[node_id_setting] = {node_id};
  if (bit_rate) image[bit_rate_setting] = {*bit_rate};
  return keep(std::move(images)).has_value();
}

std::optional<std::uint8_t> ParameterStore::stored_node_id() const {
  const auto group = memory->images().find(Group::layer_setting);
  if (group == memory->images().end()) return std::nullopt;
  const auto value = group->second.find(node_id_setting);
  if (value == group->second.end() || value->second.size() != 1) return std::nullopt;
  return value->second.front();
}

void ParameterStore::load_power_on_values(bool whole_node) {
  store_at_.reset();
  restored_.clear();
  stamp.on_reset();
  for (const Group group : all_groups) {
    if (rules.reset_loads(group, whole_node)) load(group);
  }
  if (Entry* armed = storage_fault(); armed != nullptr && whole_node) armed->value = armed->default_value;
}

void ParameterStore::load(Group group) {
  static const Image nothing;
  const Images& images = memory->images();
  const Image& stored = rules.stored_values(images, group) ? images.at(group) : nothing;
  for (auto& [index, object] : device_->dictionary.objects()) {
    if (group_of(conform::Index(index)) != group) continue;
    for (auto& [sub, entry] : object.entries) {
      if (!is_parameter(entry)) {
        // What is never stored begins with its default as well.
        if (entry.access == Access::rw && !entry.command) entry.value = entry.default_value;
        continue;
      }
      entry.value = entry.default_value;
      const auto value = stored.find({conform::Index(index), conform::SubIndex(sub)});
      if (value == stored.end()) continue;
      // An image of another version of the device may hold another length: such a value is left out.
      const std::size_t fixed = fixed_size(entry.type);
      const std::size_t size = value->second.size();
      if (fixed != 0 ? size == fixed : size <= entry.max_size) entry.value = value->second;
    }
  }
}

}  // namespace refnode
