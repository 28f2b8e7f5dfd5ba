// SPDX-License-Identifier: Apache-2.0
#include "device/feature_objects.hpp"

namespace conform::device {
namespace {

constexpr FeatureObjects rows[] = {
    {"emcy", 0x1014, 0x1014},
    {"emcy consumer", 0x1028, 0x1028},
    {"error behaviour", 0x1029, 0x1029},
    {"heartbeat producer", 0x1017, 0x1017},
    {"heartbeat consumer", 0x1016, 0x1016},
    {"life guarding", 0x100D, 0x100D},
    {"sync counter", 0x1019, 0x1019},
    {"rpdo", 0x1400, 0x15FF},
    {"tpdo", 0x1800, 0x19FF},
    {"store", 0x1010, 0x1010},
    {"restore", 0x1011, 0x1011},
    {"additional sdo servers", 0x1201, 0x127F},
    {"sdo client", 0x1280, 0x12FF},
    {"modular device", 0x1027, 0x1027},
    {"program download", 0x1F50, 0x1F50},
};

}  // namespace

std::span<const FeatureObjects> features_of_objects() { return rows; }

}  // namespace conform::device
