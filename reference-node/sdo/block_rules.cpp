// SPDX-License-Identifier: Apache-2.0
#include "sdo/block_rules.hpp"

#include <utility>

#include "sdo/crc.hpp"

namespace refnode {

BlockDownloadRules::BlockDownloadRules(ObjectDictionary& dictionary)
    : may_begin([&dictionary](Multiplexer mux, std::optional<std::size_t> size) {
        return dictionary.may_download(mux, size);
      }),
      follows([](std::uint8_t number, std::uint8_t last) { return number == last + 1; }),
      fits([](std::size_t size, const BlockDownloadTerms& terms) { return size <= terms.limit(); }),
      crc_checked([](bool agreed) { return agreed; }),
      crc([](ByteView segments, std::size_t size) { return sdo_crc(segments.first(size)); }),
      value([](Bytes data, const BlockDownloadTerms& terms) -> std::expected<Bytes, AbortCode> {
        if (data.size() < terms.announced.value_or(0)) return refuse(abort_code::length_too_low);
        if (data.size() > terms.limit()) return refuse(abort_code::length_too_high);
        return data;
      }),
      store([&dictionary](Multiplexer mux, ByteView bytes) { return dictionary.download(mux, bytes); }) {}

BlockUploadRules::BlockUploadRules()
    : may_switch(
          [](std::size_t size, std::uint8_t threshold) { return threshold != 0 && size <= threshold; }) {}

}  // namespace refnode
