// SPDX-License-Identifier: Apache-2.0
#include "can/capture_stream.hpp"

#include <fcntl.h>

#include <cerrno>
#include <system_error>

#include "base/files.hpp"
#include "base/text_bytes.hpp"
#include "can/candump_log.hpp"
#include "can/pcapng.hpp"

namespace conform::can {

Result<CaptureStream> CaptureStream::create(std::string path, Format format, CaptureInfo info) {
  const Bytes head = format == Format::pcapng ? pcapng_head(info) : Bytes();
  if (auto written = write_file_atomically(path, head); !written) return std::unexpected(written.error());
  Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC));
  if (!file.valid())
    return fail("cannot open the file: " + std::generic_category().message(errno), std::move(path));
  return CaptureStream(std::move(file), format, std::move(info));
}

void CaptureStream::add(const CapturedFrame& frame) {
  if (format_ == Format::pcapng) {
    append_pcapng(bytes_, frame, info_);
  } else {
    append_candump_line(text_, frame, info_);
  }
  if (!oldest_) oldest_ = frame.time;
  waited(frame.time);
}

void CaptureStream::flush() {
  oldest_.reset();
  auto rest = format_ == Format::pcapng ? ByteView(bytes_) : bytes_of(text_);
  while (!rest.empty() && error_ == 0) {
    const auto count = ::write(file_.get(), rest.data(), rest.size());
    if (count >= 0) {
      rest = rest.subspan(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      error_ = errno;  // what follows would not fit behind a torn block
    }
  }
  bytes_.clear();
  text_.clear();
}

}  // namespace conform::can
