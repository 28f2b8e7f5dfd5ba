// SPDX-License-Identifier: Apache-2.0
// The model of a device description (EDS, DCF, XDD, XDC): what the file says, with positions. Values stay
// text; the helpers at the end read the few that have one meaning for everybody (object type, data type,
// access...). What a default means as bytes is decided by those who use it, each on its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/strong.hpp"
#include "eds/number.hpp"
#include "eds/position.hpp"

namespace conform::eds {

/// One entry: the text behind the '=', raw bytes of the file without the blanks around them.
struct Field {
  std::string text;
  Position at;      ///< of the text; behind the '=' when it is empty
  Position key_at;  ///< of the key
  bool present = false;

  /// By CiA 306 an empty entry is as good as none.
  [[nodiscard]] bool empty() const { return text.empty(); }
};

/// Which key fills which field of a section.
template <typename Section>
struct FieldRow {
  std::string_view key;
  Field Section::* field;
};

/// An entry whose key is a number or ends in one: `3=0x1018`, `Line2=text`, `Dummy0005=1`, `BaudRate_250=1`.
struct NumberedField {
  std::uint64_t number = 0;
  Field field;
};

/// A count and what it counts: `[OptionalObjects]`, `[1A00Value]`, `[2000ObjectLinks]`, `[Comments]`. The
/// entries are in the order of the file, repeated numbers included: any of them could be the one that was
/// meant.
struct NumberedList {
  std::string name;  ///< of the section, as spelled, shortened for messages
  Position at;       ///< of the section
  bool present = false;
  Field count;
  std::vector<NumberedField> entries;
};

struct FileInfo {
  Position at;
  bool present = false;
  Field file_name, file_version, file_revision, eds_version, description, creation_time, creation_date,
      created_by, modification_time, modification_date, modified_by;
  Field last_eds;  ///< DCF
};

struct DeviceInfo {
  Position at;
  bool present = false;
  Field vendor_name, vendor_number, product_name, product_number, revision_number, order_code;
  std::vector<NumberedField> baud_rates;  ///< by kbit/s
  Field simple_boot_up_master, simple_boot_up_slave, granularity, dynamic_channels, group_messaging;
  Field nr_of_rx_pdo, nr_of_tx_pdo, lss_supported;
  Field compact_pdo;  ///< bit mask of the sub-indices of the implied communication parameters
};

/// `[DeviceComissioning]`, as the standard spells it; read under the right spelling, too.
struct DeviceCommissioning {
  Position at;
  bool present = false;
  Field node_id, node_name, node_refd, baudrate, net_number, network_name, net_refd, canopen_manager,
      lss_serial_number;
};

/// What a section of an object or of a sub-object says.
struct Entry {
  Position at;  ///< of the section
  Field parameter_name, object_type, data_type, access_type, default_value, low_limit, high_limit,
      pdo_mapping, obj_flags;
  Field parameter_value, denotation, param_refd, upload_file, download_file;  ///< DCF
  /// Known when no section describes it: of the CompactSubObj or CompactPDO that implies it.
  Position implied_by;
};

struct SubObject {
  SubIndex sub;
  Entry entry;
};

/// Lists that few objects have.
struct ObjectLists {
  NumberedList names, values, denotations;  ///< [xxxxName], [xxxxValue], [xxxxDenotation] of CompactSubObj
  NumberedList links;                       ///< [xxxxObjectLinks]
};

/// A value that is mostly empty and takes no room then: a dictionary has thousands of objects.
template <typename T>
class Rare {
 public:
  Rare() = default;
  Rare(const Rare& other) : held_(other.held_ ? std::make_unique<T>(*other.held_) : nullptr) {}
  Rare(Rare&&) noexcept = default;
  Rare& operator=(Rare other) noexcept {
    held_ = std::move(other.held_);
    return *this;
  }
  ~Rare() = default;
  [[nodiscard]] const T* operator->() const {
    static const T empty;
    return held_ ? held_.get() : &empty;
  }
  /// To be filled.
  [[nodiscard]] T& edit() {
    if (!held_) held_ = std::make_unique<T>();
    return *held_;
  }

 private:
  std::unique_ptr<T> held_;
};

struct Object {
  Index index;
  bool described = true;  ///< false: only sub-objects have sections, `entry` is empty
  Entry entry;
  Field sub_number, compact_sub_obj;
  std::vector<SubObject> subs;  ///< ascending, each sub-index once
  Rare<ObjectLists> lists;

  [[nodiscard]] const Entry* find(SubIndex sub) const;
};

/// [MxSubExtxxxx]: an object that grows with every module of this kind.
struct SubExtension {
  Index index;
  Entry entry;
  Field count, obj_extend;
};

struct Module {
  std::uint64_t number = 0;  ///< the x of Mx...
  Position at;               ///< of the first section of the module
  bool has_info = false;     ///< [MxModuleInfo] exists
  Field product_name, product_version, product_revision, order_code;
  NumberedList fixed_list;            ///< [MxFixedObjects]
  std::vector<Object> fixed_objects;  ///< [MxFixedxxxx], [MxFixedxxxxsubx]
  NumberedList extension_list;        ///< [MxSubExtends]
  std::vector<SubExtension> extensions;
};

enum class Format : std::uint8_t { eds, dcf, xdd, xdc };
[[nodiscard]] std::string_view to_string(Format format);

/// Something that the file says and this model has no place for: `[Tools]`, a list of LEDs. It is lost where
/// the model is written in another format.
struct Unmodelled {
  std::string what;  ///< of the file: "[Tools]", "DeviceManager/indicatorList"
  Position at;       ///< of the first
  std::size_t count = 1;
};

struct EdsFile {
  std::string name;  ///< as the user wrote it
  Format format = Format::eds;
  FileInfo file_info;
  DeviceInfo device_info;
  DeviceCommissioning commissioning;
  NumberedList dummy_usage;  ///< number: the data type; no count
  NumberedList mandatory_objects, optional_objects, manufacturer_objects;
  NumberedList comments;
  Position dynamic_channels;       ///< of [DynamicChannels], whose contents are those of CiA 302 and CiA 405
  std::vector<Object> objects;     ///< ascending by index, each once; only what is described (see expand.hpp)
  NumberedList supported_modules;  ///< a count alone: the modules follow as sections
  NumberedList connected_modules;  ///< DCF: numbers of supported modules, in the order of the slots
  std::vector<Module> modules;     ///< ascending by number
  std::vector<Unmodelled> unmodelled;
  Remarks remarks;

  [[nodiscard]] bool is_xml() const { return format == Format::xdd || format == Format::xdc; }
  [[nodiscard]] const Object* find(Index index) const;
  [[nodiscard]] const Entry* find(Multiplexer mux) const;
};

/// The object of this index in a list that is ascending by index.
[[nodiscard]] const Object* find_object(const std::vector<Object>& objects, Index index);

// ---- the keys
// ---------------------------------------------------------------------------------------------------

inline constexpr std::array file_info_fields = std::to_array<FieldRow<FileInfo>>({
    {"FileName", &FileInfo::file_name},
    {"FileVersion", &FileInfo::file_version},
    {"FileRevision", &FileInfo::file_revision},
    {"EDSVersion", &FileInfo::eds_version},
    {"Description", &FileInfo::description},
    {"CreationTime", &FileInfo::creation_time},
    {"CreationDate", &FileInfo::creation_date},
    {"CreatedBy", &FileInfo::created_by},
    {"ModificationTime", &FileInfo::modification_time},
    {"ModificationDate", &FileInfo::modification_date},
    {"ModifiedBy", &FileInfo::modified_by},
    {"LastEDS", &FileInfo::last_eds},
});

inline constexpr std::array device_info_fields = std::to_array<FieldRow<DeviceInfo>>({
    {"VendorName", &DeviceInfo::vendor_name},
    {"VendorNumber", &DeviceInfo::vendor_number},
    {"ProductName", &DeviceInfo::product_name},
    {"ProductNumber", &DeviceInfo::product_number},
    {"RevisionNumber", &DeviceInfo::revision_number},
    {"OrderCode", &DeviceInfo::order_code},
    {"SimpleBootUpMaster", &DeviceInfo::simple_boot_up_master},
    {"SimpleBootUpSlave", &DeviceInfo::simple_boot_up_slave},
    {"Granularity", &DeviceInfo::granularity},
    {"DynamicChannelsSupported", &DeviceInfo::dynamic_channels},
    {"GroupMessaging", &DeviceInfo::group_messaging},
    {"NrOfRXPDO", &DeviceInfo::nr_of_rx_pdo},
    {"NrOfTXPDO", &DeviceInfo::nr_of_tx_pdo},
    {"LSS_Supported", &DeviceInfo::lss_supported},
    {"CompactPDO", &DeviceInfo::compact_pdo},
});

inline constexpr std::array commissioning_fields = std::to_array<FieldRow<DeviceCommissioning>>({
    {"NodeID", &DeviceCommissioning::node_id},
    {"NodeName", &DeviceCommissioning::node_name},
    {"NodeRefd", &DeviceCommissioning::node_refd},
    {"Baudrate", &DeviceCommissioning::baudrate},
    {"NetNumber", &DeviceCommissioning::net_number},
    {"NetworkName", &DeviceCommissioning::network_name},
    {"NetRefd", &DeviceCommissioning::net_refd},
    {"CANopenManager", &DeviceCommissioning::canopen_manager},
    {"LSS_SerialNumber", &DeviceCommissioning::lss_serial_number},
});

inline constexpr std::array entry_fields = std::to_array<FieldRow<Entry>>({
    {"ParameterName", &Entry::parameter_name},
    {"ObjectType", &Entry::object_type},
    {"DataType", &Entry::data_type},
    {"AccessType", &Entry::access_type},
    {"DefaultValue", &Entry::default_value},
    {"LowLimit", &Entry::low_limit},
    {"HighLimit", &Entry::high_limit},
    {"PDOMapping", &Entry::pdo_mapping},
    {"ObjFlags", &Entry::obj_flags},
    {"ParameterValue", &Entry::parameter_value},
    {"Denotation", &Entry::denotation},
    {"ParamRefd", &Entry::param_refd},
    {"UploadFile", &Entry::upload_file},
    {"DownloadFile", &Entry::download_file},
});

inline constexpr std::array object_fields = std::to_array<FieldRow<Object>>({
    {"SubNumber", &Object::sub_number},
    {"CompactSubObj", &Object::compact_sub_obj},
});

inline constexpr std::array module_fields = std::to_array<FieldRow<Module>>({
    {"ProductName", &Module::product_name},
    {"ProductVersion", &Module::product_version},
    {"ProductRevision", &Module::product_revision},
    {"OrderCode", &Module::order_code},
});

// ---- what has one meaning for everybody
// ---------------------------------------------------------------------------

/// Object codes of CiA 301, 7.4.3.
enum class ObjectCode : std::uint8_t {
  null = 0,
  domain = 2,
  deftype = 5,
  defstruct = 6,
  var = 7,
  array = 8,
  record = 9
};
enum class Access : std::uint8_t { ro, wo, rw, rwr, rww, constant };
enum class PdoMapping : std::uint8_t { no, yes, rpdo_only, tpdo_only };  ///< the last two only in XDD

/// The value of a plain number; nullopt when the field is empty, no number, negative or a formula.
[[nodiscard]] std::optional<std::uint64_t> number_of(const Field& field);
/// 0 or 1, in XDD false or true; nullopt for anything else.
[[nodiscard]] std::optional<bool> flag_of(const Field& field);
/// VAR when the file says nothing (CiA 306); nullopt when it says something unknown.
[[nodiscard]] std::optional<ObjectCode> object_code(const Entry& entry);
/// nullopt when absent or no 16-bit number.
[[nodiscard]] std::optional<std::uint16_t> data_type(const Entry& entry);
/// nullopt when absent or none of the six words, in whatever case.
[[nodiscard]] std::optional<Access> access(const Entry& entry);
/// `no` when absent or not understood.
[[nodiscard]] PdoMapping pdo_mapping(const Entry& entry);
/// ObjFlags bit 0: not to be written by a download of the whole dictionary (CiA 306).
[[nodiscard]] bool refuses_write(const Entry& entry);
/// ObjFlags bit 1: not to be read by a scan of the whole dictionary (CiA 306).
[[nodiscard]] bool refuses_read(const Entry& entry);
/// Whether sub-objects are described or implied, or its object code says that there should be some.
[[nodiscard]] bool is_structured(const Object& object);
[[nodiscard]] bool can_be_read(Access access);
[[nodiscard]] bool can_be_written(Access access);

}  // namespace conform::eds
