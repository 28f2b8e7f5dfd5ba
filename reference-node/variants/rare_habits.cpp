// SPDX-License-Identifier: Apache-2.0
#include "variants/rare_habits.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sdo/frames.hpp"

namespace refnode::variant {

using std::chrono::milliseconds;

static bool is_data_frame(const Frame& frame) {
  return !frame.extended && !frame.remote && frame.size() == 8;
}

/// `change` is given index, sub-index and entry.
template <typename Change>
static void each_entry(Parts& parts, Change change) {
  for (auto& [index, object] : parts.device.dictionary.objects()) {
    for (auto& [sub, entry] : object.entries) change(index, sub, entry);
  }
}

/// One more condition for the values of an entry.
static void condition(Entry& entry, std::function<Accepted(ByteView)> asked) {
  entry.check = [asked = std::move(asked), former = std::move(entry.check)](ByteView bytes) -> Accepted {
    if (const Accepted good = asked(bytes); !good) return good;
    return former ? former(bytes) : Accepted{};
  };
}

How answers_after(std::function<Duration(Parts&, const SdoExchange&)> time) {
  return [time](Parts& parts) {
    // One answer after the other: none overtakes the one to the request before.
    parts.device.outbox.add_filter([&parts, time, last = BusTime{}](const FilterContext& context,
                                                                    std::vector<Outgoing>& frames) mutable {
      if (context.sdo == nullptr || context.sdo->step == SdoStep::time_out) return;
      for (Outgoing& outgoing : frames) {
        outgoing.delay = std::max<Duration>(outgoing.delay + time(parts, *context.sdo), last - context.now);
        last = context.now + outgoing.delay;
      }
    });
  };
}

bool ends_a_download(const SdoExchange& sdo) {
  switch (sdo.step) {
    case SdoStep::download_initiate: return (sdo.request[0] & 2U) != 0;
    case SdoStep::download_segment: return (sdo.request[0] & 1U) != 0;
    default: return sdo.step == SdoStep::block_download_end;
  }
}

Duration written_in_30ms(Parts&, const SdoExchange& sdo) {
  return ends_a_download(sdo) && !sdo.aborted ? milliseconds(30) : Duration{};
}

Duration operational_in_60ms(Parts& parts, const SdoExchange& sdo) {
  return parts.device.state == NmtState::operational && begins_transfer(sdo) ? milliseconds(60) : Duration{};
}

Duration irregular(Parts& parts, const SdoExchange& sdo) {
  constexpr milliseconds times[] = {milliseconds(0), milliseconds(35), milliseconds(2), milliseconds(95)};
  if (!begins_transfer(sdo)) return {};
  return times[static_cast<std::size_t>(parts.device.now.time_since_epoch() / milliseconds(1)) % 4];
}

How chosen_for_each_block_transfer(std::function<void(Parts&, const Frame&)> choose) {
  return [choose](Parts& parts) {
    parts.device.inbox.add_filter([&parts, choose](std::vector<Frame>& frames) {
      for (const Frame& frame : frames) {
        const bool begins = (frame.data[0] & 0xE1U) == 0xC0 || (frame.data[0] & 0xE3U) == 0xA0;
        if (is_data_frame(frame) && begins && parts.sdo.server_of(frame) != nullptr) choose(parts, frame);
      }
    });
  };
}

void fitting_block_size(Parts& parts, const Frame& frame) {
  constexpr std::size_t most = 127;
  const bool sized = (frame.data[0] & 0xE3U) == 0xC2;
  const std::size_t segments = sized ? (size_field(frame.data) + 6) / 7 : most;
  parts.sdo.choices.block_size = static_cast<std::uint8_t>(std::clamp<std::size_t>(segments, 1, most));
}

void crc_of_uploads(Parts& parts, const Frame& frame) {
  parts.sdo.choices.crc = (frame.data[0] & 0xE0U) == 0xA0;
}

void restless_block_size(Parts& parts) {
  parts.sdo.choices.block_size = 5;
  parts.sdo.choices.next_block_size = 1;
  parts.device.outbox.add_filter(
      [&parts, turn = 0U](const FilterContext& context, const std::vector<Outgoing>& frames) mutable {
        constexpr std::uint8_t sizes[] = {127, 2, 33, 1, 9};
        if (context.sdo == nullptr || context.sdo->step != SdoStep::block_download_ack || frames.empty())
          return;
        parts.sdo.choices.next_block_size = sizes[turn++ % std::size(sizes)];
      });
}

void one_transfer_at_a_time(Parts& parts) {
  const auto channels = std::make_shared<std::map<std::uint8_t, const SdoServer*>>();
  const auto others_busy = std::make_shared<bool>(false);
  parts.device.inbox.add_filter([&parts, channels, others_busy](std::vector<Frame>& frames) {
    for (const Frame& frame : frames) {
      const SdoServer* server = parts.sdo.server_of(frame);
      if (server == nullptr) continue;
      (*channels)[server->channel()] = server;
      *others_busy = std::ranges::any_of(
          *channels, [server](const auto& each) { return each.second != server && each.second->busy(); });
    }
  });
  const auto granted = [others_busy](Accepted former) -> Accepted {
    if (former && *others_busy) return refuse(AbortCode(0x05040005));
    return former;
  };
  parts.sdo.rules.segmented.granted.replace(
      [granted](const auto& former, Multiplexer mux, std::optional<std::size_t> size) {
        return granted(former(mux, size));
      });
  parts.sdo.rules.block_download.may_begin.replace(
      [granted](const auto& former, Multiplexer mux, std::optional<std::size_t> size) {
        return granted(former(mux, size));
      });
}

void last_segment_empty(Parts& parts) {
  const auto goes_on = std::make_shared<bool>(false);
  parts.sdo.rules.segmented.goes_on_at.replace(
      [goes_on](const auto& former, std::size_t sent, std::size_t size) -> std::optional<std::size_t> {
        const bool full = sent == size && size != 0 && size % 7 == 0;
        *goes_on = full && !*goes_on;
        return *goes_on ? std::optional(size) : former(sent, size);
      });
  parts.device.outbox.add_filter([goes_on](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.sdo == nullptr || context.sdo->aborted || context.sdo->step != SdoStep::upload_segment)
      return;
    for (Outgoing& outgoing : frames) {
      if (*goes_on) outgoing.frame.data[0] &= 0xFEU;
    }
  });
}

void time_out_silent(Parts& parts) {
  parts.device.outbox.add_filter([](const FilterContext& context, std::vector<Outgoing>& frames) {
    if (context.sdo != nullptr && context.sdo->step == SdoStep::time_out) frames.clear();
  });
}

void write_only_unsupported(Parts& parts) {
  ObjectDictionary& dictionary = parts.device.dictionary;
  dictionary.upload.replace([](const auto& former, Multiplexer mux) -> Upload {
    Upload value = former(mux);
    if (!value && value.error() == abort_code::write_only) return refuse(abort_code::unsupported_access);
    return value;
  });
}

void read_only_before_absent(Parts& parts) {
  ObjectDictionary& dictionary = parts.device.dictionary;
  const auto code = [&dictionary](Multiplexer mux, Accepted former) -> Accepted {
    if (former || former.error() != abort_code::no_sub_index) return former;
    const auto object = dictionary.objects().find(mux.index.value());
    if (object == dictionary.objects().end() || object->second.kind == ObjectKind::variable) return former;
    const bool read_only = std::ranges::none_of(object->second.entries, [](const auto& each) {
      return each.second.access == Access::rw || each.second.access == Access::wo;
    });
    return read_only ? refuse(abort_code::read_only) : former;
  };
  dictionary.may_download.replace(
      [code](const auto& former, Multiplexer mux, std::optional<std::size_t> size) -> Accepted {
        return code(mux, former(mux, size));
      });
  dictionary.download.replace([code](const auto& former, Multiplexer mux, ByteView bytes) -> Accepted {
    return code(mux, former(mux, bytes));
  });
}

How locked_in_operational(std::function<bool(std::uint16_t)> which) {
  return [which](Parts& parts) {
    ObjectDictionary& dictionary = parts.device.dictionary;
    const auto granted = [&parts, which](Multiplexer mux, Accepted former) -> Accepted {
      const Entry* entry = parts.device.dictionary.entry(mux.index.value(), mux.sub.value());
      const bool writable = entry != nullptr && (entry->access == Access::rw || entry->access == Access::wo);
      if (former && writable && parts.device.state == NmtState::operational && which(mux.index.value()))
        return refuse(abort_code::device_state);
      return former;
    };
    dictionary.may_download.replace(
        [granted](const auto& former, Multiplexer mux, std::optional<std::size_t> size) -> Accepted {
          return granted(mux, former(mux, size));
        });
    dictionary.download.replace([granted](const auto& former, Multiplexer mux, ByteView bytes) -> Accepted {
      if (const Accepted good = granted(mux, {}); !good) return good;
      return former(mux, bytes);
    });
  };
}

static bool is_pdo_parameter(std::uint16_t index) { return index >= 0x1400 && index <= 0x1BFF; }
bool is_configuration(std::uint16_t index) {
  return (index >= 0x1005 && index <= 0x100D) || (index >= 0x1012 && index <= 0x1019) || index == 0x1028 ||
         index == 0x1029 || is_pdo_parameter(index);
}

void printable_texts(Parts& parts) {
  each_entry(parts, [](std::uint16_t, std::uint8_t, Entry& entry) {
    if (entry.type != DataType::visible_string || entry.access != Access::rw) return;
    condition(entry, [](ByteView bytes) -> Accepted {
      const bool printable =
          std::ranges::all_of(bytes, [](auto byte) { return byte >= 0x20 && byte < 0x7F; });
      return printable ? Accepted{} : refuse(abort_code::invalid_value);
    });
  });
}

void domains_of_words(Parts& parts) {
  each_entry(parts, [](std::uint16_t, std::uint8_t, Entry& entry) {
    if (entry.type != DataType::domain || entry.access != Access::rw) return;
    condition(entry, [](ByteView bytes) -> Accepted {
      return bytes.size() % 4 == 0 ? Accepted{} : refuse(abort_code::length_mismatch);
    });
  });
}

void domains_write_only(Parts& parts) {
  each_entry(parts, [](std::uint16_t, std::uint8_t, Entry& entry) {
    if (entry.type == DataType::domain && entry.access == Access::rw) entry.access = Access::wo;
  });
}

void running_status(Parts& parts) {
  Entry* status = parts.device.dictionary.entry(0x1002, 0);
  if (status == nullptr) return;
  read_by(*status, [&device = parts.device]() -> Upload {
    return conform::to_le(static_cast<std::uint64_t>(device.now.time_since_epoch() / milliseconds(1)), 4);
  });
}

How in_local_control(std::initializer_list<std::uint16_t> indices) {
  return [all = std::vector<std::uint16_t>(indices)](Parts& parts) {
    each_entry(parts, [&all](std::uint16_t index, std::uint8_t, Entry& entry) {
      if (std::ranges::find(all, index) == all.end() || entry.access != Access::rw) return;
      condition(entry, [](ByteView) -> Accepted { return refuse(AbortCode(0x08000021)); });
    });
  };
}

}  // namespace refnode::variant
