// SPDX-License-Identifier: Apache-2.0
// What a device description becomes.
#include <string>

#include "catch.hpp"
#include "eds/expand.hpp"
#include "eds/read.hpp"

namespace {

using namespace conform;
using namespace conform::eds;

EdsFile good(std::string_view text) {
  auto file = eds::read(text, "a.eds");
  REQUIRE(file);
  return std::move(*file);
}

constexpr std::string_view small =
    "[FileInfo]\nFileName=a.eds\nEDSVersion=4.0\n"
    "[DeviceInfo]\nVendorNumber=0x1F\nBaudRate_125=1\nBaudRate_250=0\nGranularity=8\n"
    "[DummyUsage]\nDummy0005=1\nDummy001B=0\n"
    "[MandatoryObjects]\nSupportedObjects=2\n1=0x1000\n2=0x1018\n2=0x1001\n"
    "[1000]\nParameterName=Device type\nDataType=7\nAccessType=RO\nDefaultValue=0x000F0191\n"
    "[1018]\nParameterName=Identity\nObjectType=9\nSubNumber=2\n"
    "[1018SUB1]\nParameterName=Vendor-ID\nDataType=0x0007\nAccessType=const\nDefaultValue=0x1F\nLowLimit=\nPDOMapping=0\n"
    "[1018sub0]\nDataType=5\nAccessType=ro\nDefaultValue=1\nObjFlags=3\n"
    "[Comments]\nLines=1\nLine1=Hello\n";

TEST_CASE("An EDS becomes the model, with the places of what it says") {
  const auto file = good(small);
  CHECK(file.format == Format::eds);
  CHECK(file.file_info.eds_version.text == "4.0");
  CHECK(file.file_info.eds_version.at == Position{3, 12});
  CHECK_FALSE(file.file_info.description.present);
  CHECK(number_of(file.device_info.vendor_number) == 0x1FU);
  REQUIRE(file.device_info.baud_rates.size() == 2);
  CHECK(file.device_info.baud_rates[0].number == 125);
  REQUIRE(file.dummy_usage.entries.size() == 2);
  CHECK(file.dummy_usage.entries[1].number == 0x1B);
  CHECK(file.mandatory_objects.entries.size() == 3);
  CHECK(file.comments.entries[0].field.text == "Hello");
  REQUIRE(file.objects.size() == 2);
  const auto* type = file.find(Multiplexer{Index(0x1000), SubIndex(0)});
  REQUIRE(type != nullptr);
  CHECK(object_code(*type) == ObjectCode::var);
  CHECK(data_type(*type) == 7);
  CHECK(access(*type) == Access::ro);
  CHECK(type->at == Position{17, 1});
  const auto* vendor = file.find(Multiplexer{Index(0x1018), SubIndex(1)});
  REQUIRE(vendor != nullptr);
  CHECK(access(*vendor) == Access::constant);
  CHECK(vendor->low_limit.present);
  CHECK(vendor->low_limit.empty());
  CHECK(vendor->default_value.at == Position{30, 14});
  const auto* zero = file.find(Multiplexer{Index(0x1018), SubIndex(0)});
  REQUIRE(zero != nullptr);
  CHECK(refuses_write(*zero));
  CHECK(refuses_read(*zero));
  CHECK(file.find(Multiplexer{Index(0x1018), SubIndex(2)}) == nullptr);
  REQUIRE(file.remarks.all().size() == 1);
  CHECK(file.remarks.all()[0].what == Deviation::duplicate_entry);
  CHECK(file.remarks.all()[0].at == Position{16, 1});
  CHECK(file.remarks.all()[0].first == Position{15, 1});
}

TEST_CASE("A DCF is known by what only a configuration says, and both spellings of its section are read") {
  const auto right =
      good("[DeviceComissioning]\nNodeID=5\nBaudrate=250\n[2000]\nParameterValue=0x10\nDenotation=left\n");
  CHECK(right.format == Format::dcf);
  CHECK(number_of(right.commissioning.node_id) == 5U);
  CHECK(right.objects[0].entry.parameter_value.text == "0x10");
  CHECK(right.remarks.all().empty());
  const auto english = good("[DeviceCommissioning]\nNodeID=5\n");
  CHECK(number_of(english.commissioning.node_id) == 5U);
  REQUIRE(english.remarks.all().size() == 1);
  CHECK(english.remarks.all()[0].what == Deviation::commissioning_spelling);
  CHECK(good("[2000]\nUploadFile=a.bin\n").format == Format::dcf);
}

TEST_CASE("What is unknown or has no object is remarked, not lost in silence") {
  const auto file =
      good("[Vendor]\nx=1\n[DeviceInfo]\nColour=red\n[2000sub1]\nDataType=5\n[2001Value]\n1=5\n");
  REQUIRE(file.remarks.all().size() == 4);
  CHECK(file.remarks.all()[0].what == Deviation::unknown_section);
  CHECK(file.remarks.all()[1].what == Deviation::unknown_entry);
  CHECK(file.remarks.all()[2].what == Deviation::sub_without_object);
  CHECK(file.remarks.all()[2].at == Position{5, 1});
  CHECK(file.remarks.all()[3].what == Deviation::sub_without_object);
  REQUIRE(file.objects.size() == 1);
  CHECK(is_structured(file.objects[0]));
}

TEST_CASE("CompactSubObj is written out and what is implied says by what") {
  const auto file = good(
      "[2000]\nParameterName=Gain\nObjectType=8\nDataType=6\nAccessType=rw\nDefaultValue=9\nPDOMapping=1\nCompactSubObj=3\n"
      "[2000Name]\nNrOfEntries=1\n2=Middle\n[2000Value]\nNrOfEntries=1\n3=7\n[2000Denotation]\n1=left\n");
  const auto objects = expand(file);
  REQUIRE(objects);
  const auto* gain = find_object(*objects, Index(0x2000));
  REQUIRE(gain != nullptr);
  REQUIRE(gain->subs.size() == 4);
  CHECK(gain->subs[0].entry.default_value.text == "3");
  CHECK(data_type(gain->subs[0].entry) == 5);
  CHECK(gain->subs[1].entry.parameter_name.text == "Gain1");
  CHECK(gain->subs[1].entry.denotation.text == "left");
  CHECK(gain->subs[2].entry.parameter_name.text == "Middle");
  CHECK(gain->subs[2].entry.parameter_name.at == Position{11, 3});
  CHECK(gain->subs[3].entry.parameter_value.text == "7");
  CHECK(gain->subs[3].entry.default_value.text == "9");
  CHECK(pdo_mapping(gain->subs[3].entry) == PdoMapping::yes);
  CHECK(gain->subs[3].entry.implied_by == Position{8, 15});
  CHECK(file.objects[0].subs.empty());
}

TEST_CASE("Sub-index 00h of a compact error history counts errors, and writing to it clears them") {
  const auto objects = expand(good("[1003]\nObjectType=8\nDataType=7\nAccessType=ro\nCompactSubObj=8\n"
                                   "[1010]\nObjectType=8\nDataType=7\nAccessType=rw\nCompactSubObj=2\n"));
  REQUIRE(objects);
  const auto& history = find_object(*objects, Index(0x1003))->subs;
  REQUIRE(history.size() == 9);
  CHECK(access(history[0].entry) == Access::rw);
  CHECK(history[0].entry.default_value.text == "0");
  CHECK(access(history[8].entry) == Access::ro);
  const auto& store = find_object(*objects, Index(0x1010))->subs;
  CHECK(access(store[0].entry) == Access::ro);
  CHECK(store[0].entry.default_value.text == "2");
}

TEST_CASE("CompactPDO implies the PDOs that are not described, at the lowest free indices") {
  const auto file = good(
      "[DeviceInfo]\nNrOfRXPDO=2\nNrOfTXPDO=0\nCompactPDO=0x13\n[1400]\nParameterName=RPDO\nObjectType=9\n");
  const auto objects = expand(file);
  REQUIRE(objects);
  REQUIRE(objects->size() == 3);
  const auto* pdo = find_object(*objects, Index(0x1401));
  REQUIRE(pdo != nullptr);
  CHECK(pdo->entry.implied_by == Position{4, 12});
  REQUIRE(pdo->subs.size() == 4);
  CHECK(pdo->subs[0].entry.default_value.text == "5");
  CHECK(pdo->subs[3].sub == SubIndex(5));
  CHECK(data_type(pdo->subs[3].entry) == 6);
  CHECK(find_object(*objects, Index(0x1601)) != nullptr);
}

TEST_CASE("More implied entries than a device can have are refused") {
  std::string text;
  for (int index = 0x2000; index < 0x2200; ++index) {
    char line[64];
    std::snprintf(line, sizeof line, "[%04X]\nCompactSubObj=254\n", static_cast<unsigned>(index));
    text += line;
  }
  const auto objects = expand(good(text));
  REQUIRE_FALSE(objects);
  CHECK(objects.error().where.starts_with("a.eds:"));
}

TEST_CASE("Only hopeless input is refused, and the refusal says where") {
  for (const std::string text : {"", " \r\n", "just words\nand more\n", "\xFF\xFE[", "<a", "<a></a>"}) {
    CAPTURE(text);
    const auto file = eds::read(text, "a.eds");
    REQUIRE_FALSE(file);
    CHECK(file.error().where.starts_with("a.eds:1:"));
  }
  CHECK(eds::read("junk\n[1000\nmore junk", "a.eds"));
}

}  // namespace
