// SPDX-License-Identifier: Apache-2.0
// Defects of reading requests: the server gets other bytes than those that came, or frames of others.
#include <algorithm>
#include <utility>

#include "defects/sdo_rules.hpp"
#include "defects/tools.hpp"

namespace refnode {

using namespace defect;

namespace {

using Request = std::array<std::uint8_t, 8>;

/// Changes data frames with an identifier of 11 bits, whatever it is.
Change misread(std::function<void(Frame&, std::uint8_t node_id)> how) {
  return misreads([how = std::move(how)](Parts& parts, Frame& frame) {
    if (is_base_data_frame(frame)) how(frame, parts.device.node_id);
  });
}

/// The sub-blocks of a block download: their frames begin with a sequence number, not with a command.
class SubBlocks {
 public:
  bool is_segment(const Request& request) {
    const auto number = static_cast<std::uint8_t>(request[0] & 0x7FU);
    if ((request[0] & 0xE1U) == 0xC0U && !running_) {  // 110x xxx0: initiate
      running_ = true;
      next_ = 1;
      return false;
    }
    // Skipped numbers are segments that were lost; anything else has ended the transfer. Behind the last
    // segment comes the end frame, or what was lost once more.
    const bool end = last_seen_ && (request[0] & 0xE1U) == 0xC1U;
    running_ = running_ && !end && number >= 1 && number <= next_ + 2;
    last_seen_ = running_ && (last_seen_ || (request[0] & 0x80U) != 0);
    next_ = number == 127 ? 1 : number + 1;
    return running_;
  }

 private:
  bool running_ = false;
  bool last_seen_ = false;
  int next_ = 1;
};

/// Changes full requests to this node.
Change misread_request(std::function<void(Request&)> change) {
  return misread(
      [change = std::move(change), sub_blocks = SubBlocks{}](Frame& frame, std::uint8_t node_id) mutable {
        if (frame.id != 0x600U + node_id || frame.size() != 8) return;
        if (!sub_blocks.is_segment(frame.data)) change(frame.data);
      });
}

/// A client abort in place of the frame: it ends the running transfer without a word.
void take_for_abort(Frame& frame, std::uint8_t node_id) {
  frame.id = 0x600U + node_id;
  frame.dlc = 8;
  frame.data = {0x80};
}
/// Frames of other nodes on `base` + node-ID.
Change foreign_ends_transfer(std::uint32_t base) {
  return misread([base](Frame& frame, std::uint8_t node_id) {
    const bool foreign = frame.id > base && frame.id <= base + 0x7FU && frame.id != base + node_id;
    if (foreign) take_for_abort(frame, node_id);
  });
}

/// A remote frame on the request CAN-ID, while a segmented download is open there.
void take_remote_frame_for_segment(Parts& parts, Frame& frame) {
  if (frame.extended || !frame.remote) return;
  const SdoServer* server = parts.sdo.server_of(frame);
  if (server == nullptr || server->running<SegmentedDownload>() == nullptr) return;
  frame.remote = false;
  frame.dlc = 8;
  frame.data = {};
}

// 001x nnes: an expedited download that tells its length.
bool sized_download(const Request& request) { return (request[0] & 0xE3U) == 0x23; }
std::size_t told_length(const Request& request) { return 4U - ((request[0] >> 2U) & 0x03U); }
// 000t nnnc: a download segment.
bool download_segment(const Request& request) { return (request[0] & 0xE0U) == 0; }
bool last(const Request& request) { return (request[0] & 0x01U) != 0; }
std::size_t segment_length(const Request& request) { return 7U - ((request[0] >> 1U) & 0x07U); }
void set_segment_length(Request& request, std::size_t length) {
  request[0] = static_cast<std::uint8_t>((request[0] & 0x11U) | ((7U - length) << 1U));
}
bool any_from(const Request& request, std::size_t first) {
  return std::any_of(request.begin() + static_cast<std::ptrdiff_t>(first), request.end(),
                     [](std::uint8_t byte) { return byte != 0; });
}

DefectTable expedited_rows() {
  return {
      {"request-index-byte-swapped",
       "The index of requests is read in big-endian order",
       {"SDO-GEN-01", "SDO-GEN-03", "SDO-ERR-04"},
       misread_request([](Request& request) { std::swap(request[1], request[2]); })},
      {"upload-and-download-exchanged",
       "The command specifiers of upload and download requests are exchanged",
       {"SDO-GEN-01"},
       misread_request([](Request& request) {
         const unsigned command = request[0] >> 5U;
         if (command == 1 || command == 2) request[0] ^= 0x60U;
       })},
      {"expedited-length-ignored",
       "Expedited downloads are taken for four bytes, whatever length they tell",
       {"SDO-DNL-01", "SDO-DNL-02", "SDO-DNL-04", "OD-ACC-04"},
       misread_request([](Request& request) {
         if (sized_download(request)) request[0] = 0x23;
       })},
      {"expedited-length-by-content",
       "Bytes behind the data of an expedited download count as data when they are not zero",
       {"SDO-DNL-17"},
       misread_request([](Request& request) {
         if (sized_download(request) && any_from(request, 4 + told_length(request))) request[0] = 0x23;
       })},
      {"three-bytes-taken-for-two",
       "A download of three bytes is taken for one of two",
       {"SDO-DNL-12", "SDO-DNL-04"},
       misread_request([](Request& request) {
         if (request[0] == 0x27) request[0] = 0x2B;
       })},
      {"three-bytes-taken-for-four",
       "A download of three bytes is taken for one of four",
       {"SDO-DNL-12", "SDO-DNL-04"},
       misread_request([](Request& request) {
         if (request[0] == 0x27) request[0] = 0x23;
       })},
      {"four-bytes-taken-for-two",
       "A download of four bytes is taken for one of two",
       {"SDO-DNL-03", "SDO-DNL-12", "OD-ACC-04"},
       misread_request([](Request& request) {
         if (request[0] == 0x23) request[0] = 0x2B;
       })},
      {"node-id-cut-to-four-bits",
       "Of the node-ID in a request only the lower four bits are compared",
       {"SDO-GEN-08"},
       misread([](Frame& frame, std::uint8_t node_id) {
         const bool near = frame.id > 0x600 && frame.id < 0x680 && ((frame.id ^ node_id) & 0x0FU) == 0;
         if (near) frame.id = 0x600U + node_id;
       })},
  };
}

DefectTable segment_rows() {
  return {
      {"last-segment-length-ignored",
       "The last download segment is taken for seven bytes, whatever length it tells",
       {"SDO-SDN-11", "SDO-SDN-01", "OD-ACC-04"},
       misread_request([](Request& request) {
         if (download_segment(request) && last(request)) request[0] &= 0x11U;
       })},
      {"middle-segment-length-ignored",
       "Download segments but the last are taken for seven bytes, whatever length they tell",
       {"SDO-SDN-13"},
       misread_request([](Request& request) {
         if (download_segment(request) && !last(request)) request[0] &= 0x11U;
       })},
      {"last-segment-length-by-content",
       "Bytes behind the data of the last segment count as data when they are not zero",
       {"SDO-SDN-12"},
       misread_request([](Request& request) {
         if (!download_segment(request) || !last(request)) return;
         const std::size_t length = segment_length(request);
         if (length < 7 && any_from(request, 1 + length)) set_segment_length(request, 7);
       })},
      {"full-last-segment-taken-for-none",
       "A last download segment of seven bytes is taken for an empty one",
       {"SDO-SDN-11", "OD-ACC-04", "SDO-SDN-03"},
       misread_request([](Request& request) {
         if ((request[0] & 0xEFU) == 0x01U) set_segment_length(request, 0);
       })},
      {"long-download-after-a-short-one-refused",
       "After a download of up to four bytes, a longer one fails",
       {"SDO-SDN-03", "SDO-SDN-01", "OD-ACC-04"},
       misread_request([stale = std::uint8_t{0}](Request& request) mutable {
         if (sized_download(request)) stale = static_cast<std::uint8_t>(told_length(request));
         if (request[0] == 0x21 && stale != 0) request[4] = std::min(request[4], stale);
       })},
      {"short-frame-ends-a-transfer",
       "A frame of fewer than eight bytes ends the running transfer without a word",
       {"SDO-ERR-08"},
       misread([](Frame& frame, std::uint8_t node_id) {
         if (frame.id == 0x600U + node_id && frame.size() < 8) take_for_abort(frame, node_id);
       })},
      {"remote-frame-taken-for-a-segment",
       "A remote frame within a segmented download is taken for a segment full of zeros",
       {"SDO-GEN-10"},
       misreads(take_remote_frame_for_segment)},
      {"foreign-request-ends-a-transfer",
       "An SDO request to another node ends the running transfer",
       {"SDO-SUP-22"},
       foreign_ends_transfer(0x600)},
      {"foreign-response-ends-a-transfer",
       "An SDO response of another node ends the running transfer",
       {"SDO-SUP-22"},
       foreign_ends_transfer(0x580)},
      {"foreign-heartbeat-ends-a-transfer",
       "A heartbeat of another node ends the running SDO transfer",
       {"SDO-SUP-22"},
       foreign_ends_transfer(0x700)},
      {"client-abort-ignored-and-busy",
       "A client abort does not end the transfer, and while it runs no new one is served",
       {"SDO-SUP-10", "SDO-SDN-19", "SDO-SUP-11", "SDO-SUP-12", "SDO-SDN-17", "SDO-BUP-29", "SDO-BUP-17",
        "SDO-BUP-18", "SDO-BDN-19", "SDO-BDN-20"},
       together(goes_on_after_abort(SdoSide::client), begins_nothing_while_busy())},
  };
}

}  // namespace

DefectTable sdo_request_defects() {
  DefectTable rows = expedited_rows();
  DefectTable segments = segment_rows();
  append(rows, std::move(segments));
  return rows;
}

}  // namespace refnode
