// SPDX-License-Identifier: Apache-2.0
#include "steps/channels.hpp"

#include <algorithm>
#include <array>

namespace conform::steps {
namespace {

constexpr auto table = std::to_array<Channel>({
    {channel::device_type, "1000h is there, which every device has: what scenarios read to see SDO at work"},
    {channel::segmented_upload, "values of more than four bytes can be read"},
    {channel::segmented_download, "values of more than four bytes can be written"},
    {channel::block_upload, "block uploads run through"},
    {channel::block_download, "block downloads run through"},
    {channel::boot_up, "a reset ends with the boot-up message"},
    {channel::heartbeat, "1017h switches the heartbeat on and off, and it shows the NMT state"},
    {channel::nmt_commands, "start, stop and enter pre-operational are obeyed"},
    {channel::emcy, "an error that the profile can raise is reported by EMCY"},
    {channel::pdo_parameters, "PDOs can be switched off, changed and switched on again"},
    {channel::tpdo, "a TPDO comes when it is asked for"},
    {channel::sync, "a synchronous TPDO comes after SYNC"},
});

}  // namespace

std::span<const Channel> channels() { return table; }

std::size_t rank_of_channel(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(table, name, &Channel::name) - table.begin());
}

bool is_channel(std::string_view name) { return rank_of_channel(name) < table.size(); }

void add_channels(Channels& to, const Channels& more) {
  to.insert(to.end(), more.begin(), more.end());
  std::ranges::sort(to, {}, rank_of_channel);
  const auto repeated = std::ranges::unique(to);
  to.erase(repeated.begin(), repeated.end());
}

}  // namespace conform::steps
