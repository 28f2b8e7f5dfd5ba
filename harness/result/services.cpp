// SPDX-License-Identifier: Apache-2.0
#include "result/services.hpp"

#include <algorithm>
#include <array>

namespace conform::result {
namespace {

constexpr Service can_frames{"CAN frames", 0};
constexpr Service sdo_frames{"SDO frames", 1};
constexpr Service sdo_upload{"SDO upload", 2};
constexpr Service sdo_download{"SDO download", 2};
constexpr Service segmented_upload{"SDO segmented upload", 3};
constexpr Service segmented_download{"SDO segmented download", 3};
constexpr Service block_upload{"SDO block upload", 3};
constexpr Service block_download{"SDO block download", 3};
constexpr Service sdo_channels{"additional SDO channels", 5};
constexpr Service boot_up{"boot-up", 3};
constexpr Service heartbeat{"heartbeat producer", 4};
constexpr Service guarding{"guarding", 4};
constexpr Service error_control{"error control", 4};
constexpr Service nmt{"NMT", 5};
constexpr Service emergency{"emergency", 6};
constexpr Service consumer{"heartbeat consumer", 6};
constexpr Service error_behaviour{"error behaviour", 7};
constexpr Service sync{"SYNC", 6};
constexpr Service time{"TIME", 6};
constexpr Service rpdo{"RPDO", 7};
constexpr Service tpdo{"TPDO", 7};
constexpr Service storage{"storage", 7};
constexpr Service information{"device information", 6};
constexpr Service configuration{"configuration and operating system", 7};
constexpr Service application{"application objects", 7};
constexpr Service lss{"LSS", 6};

/// Of rules about entries in general: where one entry breaks such a rule and one of its own, the latter says
/// more.
constexpr int entry_depth = 9;

struct Family {
  std::string_view prefix;
  const Service* service;  ///< nullptr: of the entry
};

// The first that fits.
constexpr auto families = std::to_array<Family>({
    {"CAN-RID", nullptr},
    {"CAN-", &can_frames},
    {"SDO-GEN", &sdo_frames},
    {"SDO-ERR", &sdo_frames},
    {"SDO-UPL", &sdo_upload},
    {"SDO-DNL", &sdo_download},
    {"SDO-SUP", &segmented_upload},
    {"SDO-SDN", &segmented_download},
    {"SDO-BUP", &block_upload},
    {"SDO-BDN", &block_download},
    {"SDO-MUL", &sdo_channels},
    {"NMT-BOOT", &boot_up},
    {"NMT-", &nmt},
    {"EC-HBP", &heartbeat},
    {"EC-HBC", &consumer},
    {"EC-NG", &guarding},
    {"EC-EB", &error_behaviour},
    {"EMCY-CON", &consumer},
    {"EMCY-", &emergency},
    {"SYNC-", &sync},
    {"TIME-", &time},
    {"PDO-RX", &rpdo},
    {"PDO-TX", &tpdo},
    {"PDO-MPDO", &tpdo},
    {"STO-", &storage},
    {"OD-RST", &storage},
    {"OD-ERC", &error_control},
    {"LSS-", &lss},
});

struct Range {
  std::uint16_t first, last;
  const Service* service;
};

constexpr auto objects = std::to_array<Range>({
    {0x1000, 0x1000, &information},
    {0x1001, 0x1001, &emergency},
    {0x1002, 0x1002, &information},
    {0x1003, 0x1003, &emergency},
    {0x1005, 0x1007, &sync},
    {0x1008, 0x100A, &information},
    {0x100C, 0x100D, &guarding},
    {0x1010, 0x1011, &storage},
    {0x1012, 0x1013, &time},
    {0x1014, 0x1015, &emergency},
    {0x1016, 0x1016, &consumer},
    {0x1017, 0x1017, &heartbeat},
    {0x1018, 0x1018, &information},
    {0x1019, 0x1019, &sync},
    {0x1020, 0x1027, &configuration},
    {0x1028, 0x1028, &consumer},
    {0x1029, 0x1029, &error_behaviour},
    {0x1200, 0x12FF, &sdo_channels},
    {0x1400, 0x17FF, &rpdo},
    {0x1800, 0x1BFF, &tpdo},
    {0x1F80, 0x1F80, &nmt},
});

}  // namespace

std::optional<Index> object_of_requirement(std::string_view requirement) {
  if (!requirement.starts_with("OD-1") || requirement.size() < 7) return std::nullopt;
  std::uint32_t value = 0;
  for (const char c : requirement.substr(3, 4)) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit && !(c >= 'A' && c <= 'F')) return std::nullopt;
    value = value * 16 + static_cast<std::uint32_t>(digit ? c - '0' : c - 'A' + 10);
  }
  return Index(static_cast<std::uint16_t>(value));
}

const Service* service_of_requirement(std::string_view requirement) {
  if (const auto object = object_of_requirement(requirement)) return &service_of_object(*object);
  const auto found = std::ranges::find_if(
      families, [&](const Family& family) { return requirement.starts_with(family.prefix); });
  return found == families.end() ? nullptr : found->service;
}

const Service& service_of_object(Index index) {
  const auto found = std::ranges::find_if(objects, [index](const Range& range) {
    return index.value() >= range.first && index.value() <= range.last;
  });
  return found == objects.end() ? application : *found->service;
}

int depth_of_requirement(std::string_view requirement) {
  const auto* service = service_of_requirement(requirement);
  return service != nullptr ? service->depth : entry_depth;
}

}  // namespace conform::result
