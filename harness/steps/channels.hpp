// SPDX-License-Identifier: Apache-2.0
// What a verdict rests on: the channels through which a scenario sees what a device does. Each is judged
// first, by requirements of its own (`establishes` of a scenario); what rests on a channel that failed says
// nothing about the device. docs/decisions/0003-what-a-verdict-rests-on.md tells why these.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace conform::steps {

struct Channel {
  std::string_view name;     ///< as scenarios write it: "block upload"
  std::string_view summary;  ///< what is seen through it, one line
};

namespace channel {
inline constexpr std::string_view device_type = "device type";
inline constexpr std::string_view boot_up = "boot-up";
inline constexpr std::string_view heartbeat = "heartbeat";
inline constexpr std::string_view nmt_commands = "NMT commands";
inline constexpr std::string_view segmented_upload = "segmented upload";
inline constexpr std::string_view segmented_download = "segmented download";
inline constexpr std::string_view block_upload = "block upload";
inline constexpr std::string_view block_download = "block download";
inline constexpr std::string_view emcy = "EMCY";
inline constexpr std::string_view pdo_parameters = "PDO parameters";
inline constexpr std::string_view tpdo = "TPDO";
inline constexpr std::string_view sync = "SYNC";
}  // namespace channel

/// All, each behind those that it rests on itself.
[[nodiscard]] std::span<const Channel> channels();
[[nodiscard]] bool is_channel(std::string_view name);
/// Place in the table; channels().size() for what is none.
[[nodiscard]] std::size_t rank_of_channel(std::string_view name);

/// A set of channels, each once, in the order of the table.
using Channels = std::vector<std::string_view>;
void add_channels(Channels& to, const Channels& more);

}  // namespace conform::steps
