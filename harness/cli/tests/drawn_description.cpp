// SPDX-License-Identifier: Apache-2.0
#include "drawn_description.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <map>
#include <optional>
#include <vector>

#include "base/random.hpp"

namespace conform::cli {
namespace {

constexpr int boolean = 1, u8 = 5, i16 = 3, u16 = 6, u32 = 7, text = 9;
constexpr int variable = 7, array = 8, record = 9;

struct Entry {
  std::string name;
  int type = u32;
  std::string access;
  std::string value;
  bool mappable = false;
  std::string lower{}, upper{};  ///< limits; empty: none
};
struct Object {
  std::string name;
  int code = variable;
  std::map<int, Entry> subs;  ///< of a variable: number 0
};
/// An entry that PDOs can carry.
struct Signal {
  int index, sub, bits;
};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : number_(seed), state_(seed) {}

  std::string description(bool rich) {
    communication();
    if (rich) {
      rare_communication();
      application();
    }
    std::vector<Signal> inputs, outputs;
    signals("Read input", 0x6000, u8, 8, "ro", 16, inputs);
    signals("Write output", 0x6200, u8, 8, chance(50) ? "rw" : "rww", 16, outputs);
    if (chance(30)) signals("Read input word", 0x6100, u16, 16, "ro", 4, inputs);
    if (chance(60)) signals("Analogue input", 0x6401, i16, 16, "ro", 12, inputs);
    if (chance(60)) signals("Analogue output", 0x6411, i16, 16, "rww", 12, outputs);
    if (chance(40)) signals("Counter", 0x6402, u32, 32, "ro", 4, inputs);
    if (chance(40)) signals("Set point", 0x6412, u32, 32, "rww", 4, outputs);
    if (rich && chance(50)) {
      signals("Contact", 0x6030, boolean, 1, "ro", 20, inputs);
      signals("Relay", 0x6230, boolean, 1, "rw", 20, outputs);
      granularity_ = 1;
    }
    // In an RPDO some bits may be nobody's.
    if (rich && chance(40)) outputs.push_back({u8, 0, 8});
    rich_ = rich;
    constexpr int all = 512;
    const int rpdos = pdos(false, outputs, any_of({0, 1, 2, 3, 4, 6, 8, 12}));
    const int tpdos = pdos(true, inputs, number_ % 20 == 19 ? all : any_of({0, 1, 2, 3, 4, 6, 8, 12}));
    return written(rpdos, tpdos);
  }

 private:
  int below(int limit) { return static_cast<int>(next_random(state_) % static_cast<std::uint64_t>(limit)); }
  bool chance(int percent) { return below(100) < percent; }
  template <typename T>
  T any_of(std::initializer_list<T> items) {
    return items.begin()[below(static_cast<int>(items.size()))];
  }
  std::string word(std::initializer_list<const char*> items) { return any_of(items); }

  void single(int index, std::string name, int type, std::string access, std::string value) {
    objects_[index] = {name, variable, {{0, {name, type, std::move(access), std::move(value)}}}};
  }
  void list(int index, std::string name, int code, std::string access_of_count,
            const std::vector<Entry>& entries, std::string count = {}) {
    Object object{std::move(name), code, {}};
    if (count.empty()) count = std::to_string(entries.size());
    object.subs[0] = {"Number of entries", u8, std::move(access_of_count), std::move(count)};
    for (std::size_t i = 0; i < entries.size(); ++i) object.subs[static_cast<int>(i) + 1] = entries[i];
    objects_[index] = std::move(object);
  }

  void communication() {
    single(0x1000, "Device type", u32, "ro", word({"0", "0x191", "0xF0191", "0x20192"}));
    single(0x1001, "Error register", u8, "ro", "0");
    std::vector<Entry> identity;
    for (int i = 1 + below(4); i > 0; --i)
      identity.push_back({"Part of the identity", u32, "ro", fmt::format("{:#x}", 1 + below(0xFFFFFF))});
    list(0x1018, "Identity", record, word({"ro", "const"}), identity);
    if (chance(70)) {
      const std::vector<Entry> fields(static_cast<std::size_t>(1 + below(8)),
                                      {"Standard error field", u32, "ro", "0"});
      list(0x1003, "Pre-defined error field", array, "rw", fields, "0");
    }
    has_sync_ = chance(80);
    if (has_sync_) {
      single(0x1005, "COB-ID SYNC", u32, word({"rw", "rw", "const"}), "0x80");
      if (chance(40)) single(0x1006, "Communication cycle period", u32, "rw", "0");
      if (chance(30)) single(0x1019, "Synchronous counter overflow value", u8, "rw", "0");
    }
    if (chance(70)) single(0x1008, "Manufacturer device name", text, "const", "Drawn device");
    if (chance(80)) {
      single(0x1014, "COB-ID EMCY", u32, word({"rw", "ro", "const"}), "$NODEID+0x80");
      if (chance(50)) single(0x1015, "Inhibit time EMCY", u16, "rw", word({"0", "100"}));
    }
    if (chance(60)) {
      const std::vector<Entry> consumed(static_cast<std::size_t>(1 + below(4)),
                                        {"Consumer heartbeat time", u32, "rw", "0"});
      list(0x1016, "Consumer heartbeat time", array, "const", consumed);
    }
    const bool fixed = chance(25);
    single(0x1017, "Producer heartbeat time", u16, fixed ? "const" : "rw",
           fixed ? "1000" : word({"0", "0", "500", "1000"}));
  }

  /// What many devices leave out, or have from the start.
  void rare_communication() {
    if (has_sync_ && chance(15)) {
      single(0x1005, "COB-ID SYNC", u32, word({"rw", "const"}), "0x40000080");
      single(0x1006, "Communication cycle period", u32, "rw", word({"50000", "200000"}));
    }
    if (chance(10)) single(0x1014, "COB-ID EMCY", u32, word({"rw", "const"}), "$NODEID+0x80000080");
    if (chance(20))
      single(0x1017, "Producer heartbeat time", u16, word({"rw", "const"}), word({"20", "100", "5000"}));
    if (chance(20)) {
      const auto monitored = fmt::format("{:#x}", (100 + below(20)) << 16 | (200 + below(2000)));
      list(0x1016, "Consumer heartbeat time", array, "const",
           {{"Consumer heartbeat time", u32, "rw", monitored}, {"Consumer heartbeat time", u32, "rw", "0"}});
    }
    if (has_sync_ && chance(30)) single(0x1007, "Synchronous window length", u32, "rw", "0");
    if (chance(40)) single(0x1002, "Manufacturer status register", u32, "ro", "0");
    if (chance(40)) single(0x1009, "Manufacturer hardware version", text, word({"const", "ro"}), "A");
    if (chance(40))
      single(0x100A, "Manufacturer software version", text, word({"const", "ro"}), "1.02.003-x");
    if (chance(40)) {
      single(0x100C, "Guard time", u16, "rw", "0");
      single(0x100D, "Life time factor", u8, "rw", "0");
    }
    const std::vector<Entry> commands(static_cast<std::size_t>(1 + below(4)), {"Group", u32, "rw", "1"});
    if (chance(50)) list(0x1010, "Store parameters", array, word({"ro", "const"}), commands);
    if (chance(50)) list(0x1011, "Restore default parameters", array, word({"ro", "const"}), commands);
    if (chance(30)) single(0x1012, "COB-ID TIME", u32, word({"rw", "const"}), "0x80000100");
    if (chance(20)) single(0x1013, "High resolution time stamp", u32, word({"rw", "ro"}), "0");
    if (chance(20)) list(0x1020, "Verify configuration", array, "const", {2, {"Part of it", u32, "rw", "0"}});
    if (chance(30)) {
      const std::vector<Entry> producers(static_cast<std::size_t>(1 + below(5)),
                                         {"COB-ID of a producer", u32, "rw", "0x80000000"});
      list(0x1028, "Emergency consumer", array, "const", producers);
    }
    if (chance(40)) {
      const std::vector<Entry> reactions(
          static_cast<std::size_t>(1 + below(3)),
          {"Reaction", u8, word({"rw", "rw", "const"}), word({"0", "1"}), false, "0", "2"});
      list(0x1029, "Error behaviour", array, word({"ro", "const"}), reactions);
    }
    if (chance(50)) {
      const auto access = word({"ro", "const"});
      list(0x1200, "SDO server parameter", record, access,
           {{"Client to server", u32, access, "$NODEID+0x600"},
            {"Server to client", u32, access, "$NODEID+0x580"}});
    }
    for (int index = 0x1201; index < 0x1203 && chance(40); ++index) {
      const auto access = word({"rw", "rw", "ro"});
      list(index, "SDO server parameter", record, "const",
           {{"Client to server", u32, access, "0x80000000"},
            {"Server to client", u32, access, "0x80000000"},
            {"Node-ID of the client", u8, "rw", "1"}});
    }
    if (chance(30))
      list(0x1280, "SDO client parameter", record, "const",
           {{"Client to server", u32, "rw", "0x80000000"},
            {"Server to client", u32, "rw", "0x80000000"},
            {"Node-ID of the server", u8, "rw", "1"}});
  }

  /// One entry of any type, with or without limits.
  Entry any_entry() {
    struct Type {
      int number;
      const char *value, *lower, *upper;
    };
    constexpr auto types = std::to_array<Type>({{1, "1", "", ""},
                                                {2, "-5", "-100", "100"},
                                                {3, "-300", "-1000", "1000"},
                                                {4, "70000", "-100000", "100000"},
                                                {5, "7", "1", "200"},
                                                {6, "0x1234", "0x10", "0xF000"},
                                                {7, "0x12345678", "0x100", "0xF0000000"},
                                                {8, "0x3F800000", "", ""},
                                                {9, "words", "", ""},
                                                {10, "1A 2B 3C", "", ""},
                                                {12, "", "", ""},
                                                {15, "", "", ""},
                                                {16, "-70000", "", ""},
                                                {17, "0x3FF0000000000000", "", ""},
                                                {21, "-5", "", ""},
                                                {22, "0x123456", "", ""},
                                                {24, "0x1234567890", "", ""},
                                                {25, "0x123456789012", "", ""},
                                                {26, "0x12345678901234", "", ""},
                                                {27, "0x1234567890123456", "1", "0x7000000000000000"}});
    const auto& type = types[static_cast<std::size_t>(below(static_cast<int>(types.size())))];
    Entry out{"Any", type.number, word({"rw", "rw", "ro", "const", "wo"}), type.value};
    if (out.access == "const" && out.value.empty()) out.access = "ro";
    if (chance(40)) {
      out.lower = type.lower;
      out.upper = type.upper;
    }
    return out;
  }

  void application() {
    for (int i = below(12); i > 0; --i) {
      auto entry = any_entry();
      objects_[0x2000 + below(0x1000)] = {entry.name, variable, {{0, entry}}};
    }
    for (int i = below(4); i > 0; --i) {
      const std::vector<Entry> elements(static_cast<std::size_t>(1 + below(chance(20) ? 254 : 6)),
                                        any_entry());
      list(0x3000 + below(0x1000), "Alike", array, word({"ro", "const"}), elements);
    }
    for (int i = below(5); i > 0; --i) {
      const int index = 0x4000 + below(0x1000);
      std::vector<Entry> members;
      for (int count = 1 + below(8); count > 0; --count) members.push_back(any_entry());
      list(index, "Of several kinds", record, word({"ro", "const"}), members);
      auto& subs = objects_[index].subs;
      // Some sub-indices are left out, never the last one.
      for (int sub = 1; sub < static_cast<int>(members.size()); ++sub) {
        if (chance(20)) subs.erase(sub);
      }
    }
  }

  void signals(std::string name, int index, int type, int bits, const char* access, int most,
               std::vector<Signal>& out) {
    const std::vector<Entry> entries(static_cast<std::size_t>(1 + below(most)),
                                     {name, type, access, "0", true});
    list(index, std::move(name), array, word({"ro", "const"}), entries);
    for (int sub = 1; sub <= static_cast<int>(entries.size()); ++sub) out.push_back({index, sub, bits});
  }

  /// The first four have the CAN-IDs of the connection set; of the others some are not valid, some have a
  /// CAN-ID of node-IDs that nobody has, and some one of 29 bits.
  std::string cob_id(bool tpdo, int number) {
    const std::uint32_t no_rtr = tpdo && chance(40) ? 0x4000'0000U : 0;
    if (number <= 4) {
      const auto base = static_cast<std::uint32_t>((tpdo ? 0x80 : 0x100) + 0x100 * number);
      return fmt::format("$NODEID+{:#x}", base | no_rtr | (chance(20) ? 0x8000'0000U : 0));
    }
    const int kind = below(10);
    if (kind < 6 || taken_ >= 200) return "0x80000000";
    if (kind < 9) {
      const auto place = static_cast<std::uint32_t>(taken_++);
      return fmt::format("{:#x}", (0x180U + 0x80U * (place / 25) + 100 + place % 25) | no_rtr);
    }
    const auto extended = 0x2000'0000U + 0x18000U + static_cast<std::uint32_t>(number);
    return fmt::format("{:#x}", (extended + (tpdo ? 0x1000U : 0)) | no_rtr);
  }

  int pdos(bool tpdo, const std::vector<Signal>& carried, int count) {
    enum class Style : std::uint8_t { mapped_anew, fixed, only_the_number };
    const auto style = any_of({Style::mapped_anew, Style::fixed, Style::only_the_number});
    const auto access_of_cob_id = word({"rw", "rw", "rw", "const", "ro"});
    const auto access_of_type = word({"rw", "rw", "const"});
    int number = 0;
    for (int i = 0; i < count; ++i) {
      number += count < 100 && chance(10) ? 2 : 1;  // some are left out
      const auto type = has_sync_ ? any_of({255, 254, 255, 254, 0, 1, 3, 240}) : any_of({255, 254});
      std::vector<Entry> parameters{{"COB-ID", u32, access_of_cob_id, cob_id(tpdo, number)},
                                    {"Transmission type", u8, access_of_type, std::to_string(type)}};
      list((tpdo ? 0x1800 : 0x1400) + number - 1, "PDO communication parameter", record, "const", parameters);
      if (!tpdo && rich_ && chance(50)) {
        auto& subs = objects_[0x1400 + number - 1].subs;
        subs[5] = {"Event timer", u16, word({"rw", "const"}), "0"};
        subs[0].value = "5";
      }
      if (tpdo && chance(80)) {
        auto& subs = objects_[0x1800 + number - 1].subs;
        subs[3] = {"Inhibit time", u16, "rw", word({"0", "0", "100", "50"})};
        subs[5] = {"Event timer", u16, "rw", word({"0", "0", "0", "200", "1000"})};
        if (has_sync_ && chance(30)) subs[6] = {"SYNC start value", u8, "rw", "0"};
        subs[0].value = std::to_string(subs.rbegin()->first);
      }
      std::vector<Entry> mapped;
      int room = 64;
      for (int wanted = 1 + below(8); wanted > 0; --wanted) {
        const auto& signal = carried[static_cast<std::size_t>(below(static_cast<int>(carried.size())))];
        if (signal.bits > room) continue;
        room -= signal.bits;
        mapped.push_back({"Mapped object", u32, style == Style::mapped_anew ? "rw" : "const",
                          fmt::format("{:#x}", (signal.index << 16) | (signal.sub << 8) | signal.bits)});
      }
      const auto used = std::to_string(mapped.size());
      if (style == Style::mapped_anew) mapped.resize(8, {"Mapped object", u32, "rw", "0"});
      list((tpdo ? 0x1A00 : 0x1600) + number - 1, "PDO mapping parameter", record,
           style == Style::fixed ? "const" : "rw", mapped, used);
    }
    return count;
  }

  static void add_list(std::string& out, const char* section, const std::vector<int>& indices) {
    out += fmt::format("[{}]\nSupportedObjects={}\n", section, indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i) out += fmt::format("{}=0x{:04X}\n", i + 1, indices[i]);
    out += "\n";
  }
  static void add_entry(std::string& out, const Entry& entry) {
    out += fmt::format("ObjectType=0x7\nDataType=0x{:04X}\nAccessType={}\nDefaultValue={}\nPDOMapping={}\n",
                       entry.type, entry.access, entry.value, entry.mappable ? 1 : 0);
    if (!entry.lower.empty()) out += "LowLimit=" + entry.lower + "\n";
    if (!entry.upper.empty()) out += "HighLimit=" + entry.upper + "\n";
    out += "\n";
  }

  std::string written(int rpdos, int tpdos) {
    std::string out =
        "[FileInfo]\nFileName=drawn.eds\nFileVersion=1\nFileRevision=0\nEDSVersion=4.0\nDescription=Drawn\n"
        "CreationTime=12:00AM\nCreationDate=01-01-2026\nCreatedBy=drawn\nModificationTime=12:00AM\n"
        "ModificationDate=01-01-2026\nModifiedBy=drawn\n\n"
        "[DeviceInfo]\nVendorName=Nobody\nProductName=Drawn device\nBaudRate_10=0\nBaudRate_20=0\n"
        "BaudRate_50=0\nBaudRate_125=1\nBaudRate_250=1\nBaudRate_500=1\nBaudRate_800=0\nBaudRate_1000=1\n"
        "SimpleBootUpMaster=0\nSimpleBootUpSlave=1\nDynamicChannelsSupported=0\nGroupMessaging=0\n"
        "LSS_Supported=0\n";
    out += fmt::format("Granularity={}\nNrOfRXPDO={}\nNrOfTXPDO={}\n\n[DummyUsage]\nDummy0001=0\n",
                       granularity_ == 1 ? 1 : any_of({8, 8, 16}), rpdos, tpdos);
    for (int type = 2; type <= 7; ++type)
      out += fmt::format("Dummy{:04}={}\n", type, rich_ && type == u8 ? 1 : below(2));
    out += "\n";
    std::vector<int> mandatory, optional, of_the_manufacturer;
    for (const auto& [index, object] : objects_) {
      const bool is_mandatory = index == 0x1000 || index == 0x1001 || index == 0x1018;
      const bool is_own = index >= 0x2000 && index < 0x6000;
      (is_mandatory ? mandatory : is_own ? of_the_manufacturer : optional).push_back(index);
    }
    add_list(out, "MandatoryObjects", mandatory);
    add_list(out, "OptionalObjects", optional);
    add_list(out, "ManufacturerObjects", of_the_manufacturer);
    for (const auto& [index, object] : objects_) {
      out += fmt::format("[{:04X}]\nParameterName={}\n", index, object.name);
      if (object.code == variable) {
        add_entry(out, object.subs.at(0));
        continue;
      }
      out += fmt::format("ObjectType=0x{:X}\nSubNumber={}\n\n", object.code, object.subs.size());
      for (const auto& [sub, entry] : object.subs) {
        out += fmt::format("[{:04X}sub{:X}]\nParameterName={}\n", index, sub, entry.name);
        add_entry(out, entry);
      }
    }
    return out;
  }

  std::uint64_t number_, state_;
  std::map<int, Object> objects_;
  bool has_sync_ = false, rich_ = false;
  int granularity_ = 8;
  int taken_ = 0;  ///< CAN-IDs of node-IDs that nobody has
};

}  // namespace

std::string draw_description(std::uint64_t seed) { return Draw(seed).description(false); }
std::string draw_rich_description(std::uint64_t seed) { return Draw(seed).description(true); }

}  // namespace conform::cli
