// SPDX-License-Identifier: Apache-2.0
// Defects of the memory behind 1010h, 1011h and the store of LSS: they show when the power is gone.
#include <functional>
#include <memory>
#include <utility>

#include "defects/hooks.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

/// A copy in the working memory: what it says is `kept` reaches the memory itself, for the time without
/// power.
class Cached final : public Storage {
 public:
  using Kept = std::function<Images(const Images& former, const Images& wanted)>;

  Cached(std::shared_ptr<Storage> memory, Kept kept) : memory_(std::move(memory)), kept_(std::move(kept)) {
    images_ = memory_->images();
  }

 private:
  conform::Result<void> write(const Images& wanted) override {
    return memory_->replace(kept_(memory_->images(), wanted));
  }

  std::shared_ptr<Storage> memory_;
  Kept kept_;
};

Change keeps(Cached::Kept kept) {
  return [kept = std::move(kept)](Parts& parts) {
    parts.store.memory = std::make_shared<Cached>(parts.store.memory, kept);
  };
}

/// What is stored in these groups stays in the working memory.
Change forgets_without_power(bool (*forgotten)(Group)) {
  return keeps([forgotten](const Images& former, const Images& wanted) {
    Images out;
    for (const auto& [group, image] : wanted) {
      if (!forgotten(group)) out[group] = image;
    }
    for (const auto& [group, image] : former) {
      if (forgotten(group)) out[group] = image;
    }
    return out;
  });
}

bool of_dictionary(Group group) { return group != Group::layer_setting; }

/// "load" takes the values out of the working memory only.
Images without_removals(const Images& former, const Images& wanted) {
  Images out = wanted;
  for (const auto& [group, image] : former) out.try_emplace(group, image);
  return out;
}

bool is_reset_of(const Parts& parts, const Frame& frame) {
  return frame.id == 0 && !frame.extended && !frame.remote && frame.size() == 2 &&
         (frame.data[0] == 0x81 || frame.data[0] == 0x82) &&
         (frame.data[1] == 0 || frame.data[1] == parts.device.node_id);
}

/// The memory is written with the next reset, long after the confirmation.
Change written_with_the_reset() {
  return [](Parts& parts) {
    const auto memory = parts.store.memory;
    parts.store.memory = std::make_shared<Cached>(memory, [](const Images& former, const Images& wanted) {
      Images out = former;
      if (const auto own = wanted.find(Group::layer_setting); own != wanted.end())
        out[own->first] = own->second;
      return out;
    });
    misreads([memory](Parts& whole, Frame& frame) {
      if (!is_reset_of(whole, frame)) return;
      [[maybe_unused]] const auto done = memory->replace(whole.store.memory->images());
    })(parts);
  };
}

constexpr Multiplexer node_id_setting = mux(0, 1);

/// A configure node-ID of LSS, whoever is selected, changes the memory.
Change node_id_reaches_memory(std::uint8_t (*what)(std::uint8_t configured)) {
  return [what](Parts& parts) {
    const auto memory = parts.store.memory;
    parts.store.memory =
        std::make_shared<Cached>(memory, [](const Images&, const Images& wanted) { return wanted; });
    parts.lss.rules.node_id_allowed.replace([what, memory](const auto& former, std::uint8_t node_id) {
      const bool allowed = former(node_id);
      if (allowed) {
        Images images = memory->images();
        images[Group::layer_setting][node_id_setting] = {what(node_id)};
        [[maybe_unused]] const auto done = memory->replace(std::move(images));
      }
      return allowed;
    });
  };
}

}  // namespace

DefectTable storage_memory_defects() {
  return {
      {"1010-saved-in-ram",
       "\"save\" is confirmed, and what is stored survives every reset, but not the loss of power",
       {"STO-1010-06"},
       forgets_without_power(of_dictionary)},
      {"1010-saved-with-the-next-reset",
       "\"save\" is confirmed before anything is written: with the next reset it is",
       {"STO-1010-06"},
       written_with_the_reset()},
      {"1010-application-saved-in-ram",
       "Of what is stored the application parameters do not survive the loss of power",
       {"STO-1010-06"},
       forgets_without_power([](Group group) { return group == Group::application; })},
      {"1011-restored-in-ram",
       "\"load\" and a reset make the defaults valid; without power the values stored earlier are back",
       {"STO-1011-07"},
       keeps(without_removals)},
      {"lss-node-id-stored-unasked",
       "A node-ID that LSS configures is stored without being told so",
       {"LSS-CN-05"},
       node_id_reaches_memory([](std::uint8_t configured) { return configured; })},
      {"lss-node-id-lost-with-the-new-one",
       "A node-ID that LSS configures takes the stored one out of the memory: without power none is left",
       {"LSS-CN-05"},
       node_id_reaches_memory([](std::uint8_t) { return LssSlave::no_node_id; })},
      {"lss-stored-in-ram",
       "What LSS stores survives every reset, but not the loss of power",
       {"LSS-ST-02"},
       forgets_without_power([](Group group) { return group == Group::layer_setting; })},
  };
}

}  // namespace refnode
