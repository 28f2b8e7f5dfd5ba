// SPDX-License-Identifier: Apache-2.0
#include "variants/sdo_habits.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "sdo/frames.hpp"
#include "variants/tools.hpp"

namespace refnode::variant {

void fill_unused_bytes(Parts& parts) {
  parts.device.outbox.add_filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.sdo == nullptr || context.sdo->aborted) return;
    for (Outgoing& outgoing : frames) {
      auto& data = outgoing.frame.data;
      std::size_t unused = 0;
      if (context.sdo->step == SdoStep::upload_initiate && (data[0] & 0xE3U) == 0x43)
        unused = (data[0] >> 2U) & 3U;
      if (context.sdo->step == SdoStep::upload_segment) unused = (data[0] >> 1U) & 7U;
      for (std::size_t i = 0; i < unused; ++i) data[7 - i] = 0x5A;
    }
  });
}

void refuse_reserved_bits(Parts& parts) {
  parts.device.outbox.add_filter(
      [refused = false](const FilterContext& context, std::vector<Outgoing>& frames) mutable {
        if (context.sdo == nullptr) return;
        const auto times_out = [](const Outgoing& outgoing) {
          return outgoing.frame.size() == 8 && outgoing.frame.data[0] == 0x80 &&
                 conform::load_le(outgoing.frame.bytes().subspan(4)) == 0x05040000;
        };
        if (refused) std::erase_if(frames, times_out);
        if (context.sdo->aborted || frames.empty()) return;
        const unsigned command = context.sdo->request[0];
        const bool upload = context.sdo->step == SdoStep::block_upload_initiate && (command & 0x1BU) != 0;
        const bool download = context.sdo->step == SdoStep::block_download_initiate && (command & 0x18U) != 0;
        refused = upload || download;
        if (!refused) return;
        for (Outgoing& outgoing : frames) outgoing.frame.data = {0x80, 0, 0, 0, 0x01, 0x00, 0x04, 0x05};
      });
}

void block_transfer_unknown(Parts& parts) {
  parts.sdo.choices.block = false;
  parts.device.outbox.add_filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.sdo == nullptr || context.sdo->aborted != abort_code::command_unknown) return;
    if (context.sdo->step != SdoStep::block_upload_initiate &&
        context.sdo->step != SdoStep::block_download_initiate)
      return;
    for (Outgoing& outgoing : frames) std::fill_n(outgoing.frame.data.begin() + 1, 3, std::uint8_t{0});
  });
}

static bool is_request(const conform::can::Frame& frame) {
  return !frame.extended && !frame.remote && frame.size() == 8;
}

void aborts_of_its_object(Parts& parts) {
  parts.device.inbox.add_filter([&parts](std::vector<conform::can::Frame>& frames) {
    std::erase_if(frames, [&parts](const auto& frame) {
      if (!is_request(frame) || frame.data[0] != 0x80) return false;
      const SdoServer* server = parts.sdo.server_of(frame);
      const auto running = server == nullptr ? std::nullopt : server->running_mux();
      return running && *running != mux_of(frame.data);
    });
  });
}

void busy_names_the_transfer(Parts& parts) {
  const auto running = std::make_shared<std::map<std::uint8_t, Multiplexer>>();
  parts.device.inbox.add_filter([&parts, running](std::vector<conform::can::Frame>& frames) {
    for (const auto& frame : frames) {
      const SdoServer* server = is_request(frame) ? parts.sdo.server_of(frame) : nullptr;
      if (server == nullptr) continue;
      running->erase(server->channel());
      if (const auto mux = server->running_mux()) (*running)[server->channel()] = *mux;
    }
  });
  parts.device.outbox.add_filter([running](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.sdo == nullptr || context.sdo->aborted != abort_code::command_unknown) return;
    const auto former = running->find(context.sdo->channel);
    if (former == running->end() || !begins_transfer(*context.sdo)) return;
    const SdoData named = with_mux(0x80, former->second);
    for (Outgoing& outgoing : frames) std::copy_n(named.begin(), 4, outgoing.frame.data.begin());
  });
}

void gap_refused(Parts& parts) {
  parts.device.inbox.add_filter([&parts](std::vector<conform::can::Frame>& frames) {
    for (auto& frame : frames) {
      const SdoServer* server = is_request(frame) ? parts.sdo.server_of(frame) : nullptr;
      const auto* transfer = server == nullptr ? nullptr : server->running<BlockDownload>();
      if (transfer == nullptr || !transfer->in_sub_block() || frame.data[0] == 0x80) continue;
      // Number 0 is one that cannot be, and refused as such.
      if ((frame.data[0] & 0x7FU) != transfer->sequence() + 1U) frame.data[0] = 0;
    }
  });
}

/// Whether the entry can be written is asked when the data are there, not when they are announced.
static Accepted leave_to_the_end(const Accepted& granted) {
  if (granted || granted.error() == abort_code::no_object || granted.error() == abort_code::no_sub_index ||
      granted.error() == abort_code::read_only)
    return {};
  return granted;
}
void segments_checked_at_the_end(Parts& parts) {
  parts.sdo.rules.segmented.granted.replace(
      [](const auto& former, Multiplexer mux, std::optional<std::size_t> announced) {
        return leave_to_the_end(former(mux, announced));
      });
}
void blocks_checked_at_the_end(Parts& parts) {
  parts.sdo.rules.block_download.may_begin.replace(
      [](const auto& former, Multiplexer mux, std::optional<std::size_t> size) {
        return leave_to_the_end(former(mux, size));
      });
}

void block_download_of_domains(Parts& parts) {
  const ObjectDictionary& dictionary = parts.device.dictionary;
  parts.sdo.rules.block_download.may_begin.replace(
      [&dictionary](const auto& former, Multiplexer mux, std::optional<std::size_t> size) -> Accepted {
        const Entry* entry = dictionary.entry(mux.index.value(), mux.sub.value());
        if (entry != nullptr && entry->type != DataType::domain) return refuse(abort_code::command_unknown);
        return former(mux, size);
      });
}

How erases_before_block_download(Duration time) {
  return [time](Parts& parts) {
    struct Erasing {
      const SdoServer* server;
      conform::BusTime until;
    };
    const auto servers = std::make_shared<std::map<std::uint8_t, const SdoServer*>>();
    const auto erasing = std::make_shared<std::map<std::uint8_t, Erasing>>();
    parts.device.inbox.add_filter([&parts, servers, erasing](std::vector<conform::can::Frame>& frames) {
      std::erase_if(frames, [&](const auto& frame) {
        const SdoServer* server = parts.sdo.server_of(frame);
        if (server == nullptr) return false;
        (*servers)[server->channel()] = server;
        const auto at = erasing->find(server->channel());
        if (at == erasing->end() || (is_request(frame) && frame.data[0] == 0x80)) return false;
        if (server->running<BlockDownload>() == nullptr) return erasing->erase(at), false;
        parts.device.inbox.put_newest(frame, at->second.until + std::chrono::microseconds(1));
        return true;
      });
    });
    parts.device.outbox.add_filter(
        [time, servers, erasing](const FilterContext& context, std::vector<Outgoing>& frames) {
          if (context.sdo == nullptr || context.sdo->aborted) return;
          if (context.sdo->step != SdoStep::block_download_initiate) return;
          const std::uint8_t channel = context.sdo->channel;
          const auto server = servers->find(channel);
          if (server == servers->end()) return;
          (*erasing)[channel] = {server->second, context.now + time};
          for (Outgoing& outgoing : frames) {
            outgoing.delay += time;
            outgoing.still_wanted = [erasing, channel, mux = context.sdo->mux] {
              const auto at = erasing->extract(channel);
              return !at.empty() && at.mapped().server->running_mux() == mux;
            };
          }
        });
  };
}

How oldest_request_in(Duration cycle) {
  return [cycle](Parts& parts) {
    const auto taken_at = std::make_shared<std::map<std::uint8_t, conform::BusTime>>();
    parts.device.inbox.add_filter([&parts, cycle, taken_at](std::vector<conform::can::Frame>& frames) {
      Device& device = parts.device;
      std::erase_if(frames, [&](const auto& frame) {
        const SdoServer* server = is_request(frame) ? parts.sdo.server_of(frame) : nullptr;
        if (server == nullptr) return false;
        const auto* receiving = server->running<BlockDownload>();
        const bool end_of_upload =
            server->running<BlockUpload>() != nullptr && (frame.data[0] & 0xE3U) == 0xA1;
        if (end_of_upload || (receiving != nullptr && receiving->in_sub_block())) return false;
        conform::BusTime& next = (*taken_at)[server->channel()];
        if (device.now < next) return true;
        next = device.now + (cycle - device.now.time_since_epoch() % cycle);
        device.inbox.put(frame, next);
        return true;
      });
    });
  };
}

void leave_out_size(Parts& parts) {
  const ObjectDictionary& dictionary = parts.device.dictionary;
  parts.device.outbox.add_filter([&dictionary](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.sdo == nullptr || context.sdo->aborted || context.sdo->step != SdoStep::upload_initiate)
      return;
    const auto* entry = dictionary.entry(context.sdo->index(), context.sdo->sub());
    if (entry == nullptr || fixed_size(entry->type) == 0) return;
    for (Outgoing& outgoing : frames) {
      if ((outgoing.frame.data[0] & 0xE3U) == 0x43) outgoing.frame.data[0] = 0x42;
    }
  });
}

void expedited_only(Parts& parts) {
  // Commands and replies are longer, and their records cannot be without them.
  for (std::uint16_t index = 0x1021; index <= 0x1025; ++index) parts.device.dictionary.remove(index);
  for (auto object = parts.device.dictionary.objects().begin();
       object != parts.device.dictionary.objects().end();) {
    auto& entries = object->second.entries;
    std::erase_if(entries, [](const auto& entry) {
      const std::size_t fixed = fixed_size(entry.second.type);
      return fixed > 4 || (fixed == 0 && (entry.second.value.empty() || entry.second.max_size > 4));
    });
    const bool nothing_left =
        entries.empty() || (entries.size() == 1 && object->second.kind != ObjectKind::variable);
    // Mappings and the error history count something else.
    const unsigned index = object->first;
    const bool mapping = index >= 0x1600 && index <= 0x1BFF && (index & 0x200U) != 0;
    if (!nothing_left && object->second.kind != ObjectKind::variable && !mapping && index != 0x1003 &&
        entries.contains(0) && entries.at(0).access == Access::constant) {
      // FFh is the structure of the object and not counted.
      auto highest = std::prev(entries.end());
      if (highest->first == 0xFF) --highest;
      entries.at(0).value = entries.at(0).default_value = Bytes{highest->first};
    }
    object = nothing_left ? parts.device.dictionary.objects().erase(object) : std::next(object);
  }
  parts.sdo.choices.segmented = false;
  parts.sdo.choices.block = false;
}

}  // namespace refnode::variant
