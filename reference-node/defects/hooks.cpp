// SPDX-License-Identifier: Apache-2.0
#include "defects/hooks.hpp"

#include "defects/receivers.hpp"

namespace refnode::defect {

namespace {

void put_check(Parts& parts, Entry& entry, std::function<Accepted(Parts&, const Check&, ByteView)> check) {
  Check former = entry.check ? entry.check : [](ByteView) { return Accepted{}; };
  entry.check = [&parts, former = std::move(former), check = std::move(check)](ByteView bytes) {
    return check(parts, former, bytes);
  };
}

void put_read(Parts& parts, Entry& entry, std::function<Upload(Parts&, const Read&)> read) {
  Read former = entry.read ? entry.read : [&entry]() -> Upload { return entry.value; };
  read_by(entry,
          [&parts, former = std::move(former), read = std::move(read)] { return read(parts, former); });
}

void put_written(Parts& parts, Entry& entry,
                 std::function<void(Parts&, const std::function<void()>&)> written) {
  std::function<void()> former = entry.written ? entry.written : [] {};
  entry.written = [&parts, former = std::move(former), written = std::move(written)] {
    written(parts, former);
  };
}

template <typename Do>
void for_all(Parts& parts, std::uint16_t index, Do what) {
  const auto object = parts.device.dictionary.objects().find(index);
  if (object == parts.device.dictionary.objects().end()) return;
  for (auto& [sub, entry] : object->second.entries) {
    if (sub != 0 && sub != 0xFF) what(sub, entry);
  }
}

}  // namespace

Change checking(std::uint16_t index, std::uint8_t sub,
                std::function<Accepted(Parts&, const Check&, ByteView)> check) {
  return [=](Parts& parts) {
    if (Entry* entry = parts.device.dictionary.entry(index, sub)) put_check(parts, *entry, check);
  };
}

Change checking_all(std::uint16_t index,
                    std::function<Accepted(Parts&, const Check&, std::uint8_t, ByteView)> check) {
  return [=](Parts& parts) {
    for_all(parts, index, [&](std::uint8_t sub, Entry& entry) {
      put_check(parts, entry, [check, sub](Parts& node, const Check& former, ByteView bytes) {
        return check(node, former, sub, bytes);
      });
    });
  };
}

Change reading(std::uint16_t index, std::uint8_t sub, std::function<Upload(Parts&, const Read&)> read) {
  return [=](Parts& parts) {
    if (Entry* entry = parts.device.dictionary.entry(index, sub)) put_read(parts, *entry, read);
  };
}

Change reading_all(std::uint16_t index, std::function<Upload(Parts&, const Read&, std::uint8_t)> read) {
  return [=](Parts& parts) {
    for_all(parts, index, [&](std::uint8_t sub, Entry& entry) {
      put_read(parts, entry,
               [read, sub](Parts& node, const Read& former) { return read(node, former, sub); });
    });
  };
}

Change after_writing(std::uint16_t index, std::uint8_t sub,
                     std::function<void(Parts&, const std::function<void()>&)> written) {
  return [=](Parts& parts) {
    if (Entry* entry = parts.device.dictionary.entry(index, sub)) put_written(parts, *entry, written);
  };
}

Change after_writing_all(std::uint16_t index,
                         std::function<void(Parts&, const std::function<void()>&, std::uint8_t)> written) {
  return [=](Parts& parts) {
    for_all(parts, index, [&](std::uint8_t sub, Entry& entry) {
      put_written(parts, entry, [written, sub](Parts& node, const std::function<void()>& former) {
        written(node, former, sub);
      });
    });
  };
}

Change without_effect_in_operational(std::uint16_t index) {
  return after_writing(index, 0, [](Parts& parts, const std::function<void()>& former) {
    if (parts.device.state != NmtState::operational) former();
  });
}

Change confirms(std::uint16_t index, std::uint8_t sub, bool (*when)(std::uint64_t value)) {
  return checking(index, sub, [when](Parts&, const Check& former, ByteView bytes) {
    return when(conform::load_le(bytes)) ? Accepted{} : former(bytes);
  });
}

Change refuses(std::uint16_t index, std::uint8_t sub, AbortCode code,
               bool (*when)(std::uint64_t present, std::uint64_t wanted)) {
  return checking(index, sub, [=](Parts& parts, const Check& former, ByteView bytes) -> Accepted {
    if (when(parts.device.dictionary.number(index, sub), conform::load_le(bytes))) return refuse(code);
    return former(bytes);
  });
}

Change unnoticed(ErrorSource source, std::uint16_t code) {
  return [=](Parts& parts) {
    parts.device.errors.raise.replace([=](const auto& former, const ErrorCause& cause, std::uint8_t detail) {
      if (cause.source != source || (code != 0 && cause.code != code)) former(cause, detail);
    });
  };
}

Change works_also(Service service, NmtState state) {
  return [=](Parts& parts) {
    parts.device.works.replace([=](const auto& former, Service which, NmtState present) {
      return (which == service && present == state) || former(which, present);
    });
  };
}

Change deaf_to(std::function<bool(Parts&, const Frame&)> when) {
  return Reading([when = std::move(when)](Parts& parts, std::vector<Frame>& frames) {
    std::erase_if(frames, [&](const Frame& frame) { return when(parts, frame); });
  });
}

Change misreads(std::function<void(Parts&, Frame&)> change) {
  return Reading([change = std::move(change)](Parts& parts, std::vector<Frame>& frames) mutable {
    for (Frame& frame : frames) change(parts, frame);
  });
}

Change with_boot_up(std::function<void(Parts&)> act) {
  return [act = std::move(act)](Parts& parts) {
    parts.device.outbox.add_filter([&parts, act](const FilterContext& context, std::vector<Outgoing>&) {
      if (context.service == Service::boot_up) act(parts);
    });
  };
}

Change ahead_of_state_change(std::function<void(Parts&)> act) {
  return [act = std::move(act)](Parts& parts) {
    parts.nmt.on_change = [&parts, act, former = parts.nmt.on_change](NmtState from) {
      act(parts);
      former(from);
    };
  };
}

std::shared_ptr<bool> led_by_error(Parts& parts) {
  auto led = std::make_shared<bool>(false);
  parts.error_behaviour.enter = [&parts, led, former = parts.error_behaviour.enter](NmtState state) {
    *led = *led || state != parts.device.state;
    former(state);
  };
  deaf_to([led](Parts& node, const Frame& frame) {
    if (is_nmt_command(frame) && is_for(node, frame)) *led = false;
    return false;
  })(parts);
  return led;
}

Change works_where_led_by_error(Service which, NmtState where) {
  return [which, where](Parts& parts) {
    parts.device.works.replace(
        [=, led = led_by_error(parts)](const auto& former, Service service, NmtState state) {
          return (*led && service == which && state == where) || former(service, state);
        });
  };
}

std::shared_ptr<std::set<Multiplexer>> written_since_boot_up(Parts& parts,
                                                             std::initializer_list<std::uint16_t> indices) {
  const auto written = since_boot_up<std::set<Multiplexer>>(parts);
  const auto note = [&](std::uint16_t index, std::uint8_t sub, Entry& entry) {
    put_written(parts, entry, [written, index, sub](Parts&, const std::function<void()>& former) {
      written->insert({conform::Index(index), conform::SubIndex(sub)});
      former();
    });
  };
  for (const std::uint16_t index : indices) {
    if (Entry* entry = parts.device.dictionary.entry(index, 0)) note(index, 0, *entry);
    for_all(parts, index, [&](std::uint8_t sub, Entry& entry) { note(index, sub, entry); });
  }
  return written;
}

bool has_open_transfer(const Parts& parts) {
  const SdoServer* server =
      parts.sdo.server_of(conform::can::data_frame(conform::CanId(0x600U + parts.device.node_id), {}));
  return server != nullptr && server->busy();
}

}  // namespace refnode::defect
