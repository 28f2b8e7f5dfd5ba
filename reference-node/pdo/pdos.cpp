// SPDX-License-Identifier: Apache-2.0
#include "pdo/pdos.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace refnode {

void Pdos::add_objects() {
  // Every output is mapped to one RPDO at most, and every input that repeats it to the TPDO of the same
  // number.
  constexpr std::uint16_t pdos = 4;
  const std::vector<std::uint32_t> outputs[pdos] = {{0x62000108, 0x62000208, 0x64110110},
                                                    {0x64110210, 0x62000308},
                                                    {0x62000408, 0x64120120},
                                                    {0x62000508, 0x62000608, 0x62000708, 0x62000808}};
  const std::vector<std::uint32_t> inputs[pdos] = {{0x60000108, 0x60000208, 0x64010110},
                                                   {0x64010210, 0x60000308},
                                                   {0x60000408, 0x64020120},
                                                   {0x60000508, 0x60000608, 0x60000708, 0x60000808}};
  // Bit 30 of the TPDOs: not on remote request.
  for (std::uint16_t number = 0; number < pdos; ++number) {
    const std::uint32_t step = number * 0x100U;
    add_pdo_objects(device_->dictionary, PdoDirection::receive, number, 0x200 + step, device_->node_id,
                    outputs[number]);
    add_pdo_objects(device_->dictionary, PdoDirection::transmit, number, 0x40000180 + step, device_->node_id,
                    inputs[number]);
  }
}

void Pdos::bind() {
  const auto& objects = device_->dictionary.objects();
  for (std::uint16_t number = 0; number < pdos_of_a_direction; ++number) {
    const auto exists = [&](PdoDirection direction) {
      return objects.contains(static_cast<std::uint16_t>(first_communication_index(direction) + number));
    };
    if (exists(PdoDirection::receive)) {
      receive_.emplace_back(*device_, rpdo, number).on_applied = [this] { on_application_change(); };
    }
    if (exists(PdoDirection::transmit)) transmit_.emplace_back(*device_, tpdo, number);
  }
}

void Pdos::on_application_change() {
  if (std::ranges::any_of(receive_, &ReceivePdo::applying)) return;
  const TransmitPdo* told = nullptr;
  for (TransmitPdo& pdo : transmit_) {
    if (told != nullptr && tpdo.choices.first_alone_is_sent && pdo.shares_an_object_with(*told)) {
      pdo.take_as_told();
    } else if (pdo.on_application_change() && told == nullptr) {
      told = &pdo;
    }
  }
}

void Pdos::on_frame(const Frame& frame) {
  // Nothing forbids two RPDOs of the same CAN-ID.
  for (ReceivePdo& pdo : receive_) pdo.on_frame(frame);
}

void Pdos::on_remote(const Frame& frame) {
  for (TransmitPdo& pdo : transmit_) {
    if (pdo.on_remote(frame)) return;
  }
}

void Pdos::on_sync(std::optional<std::uint8_t> counter) {
  for (ReceivePdo& pdo : receive_) pdo.on_sync();
  for (TransmitPdo& pdo : transmit_) pdo.on_sync(counter);
}

void Pdos::on_state_change() {
  for (ReceivePdo& pdo : receive_) pdo.on_state_change();
  for (TransmitPdo& pdo : transmit_) pdo.on_state_change();
}

void Pdos::on_boot_up() {
  for (TransmitPdo& pdo : transmit_) pdo.on_state_change();
}

void Pdos::on_time() {
  for (ReceivePdo& pdo : receive_) pdo.on_time();
  for (TransmitPdo& pdo : transmit_) pdo.on_time();
}

}  // namespace refnode
