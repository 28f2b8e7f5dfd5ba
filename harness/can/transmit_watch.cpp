// SPDX-License-Identifier: Apache-2.0
#include "can/transmit_watch.hpp"

#include <chrono>
#include <utility>

#include "base/files.hpp"
#include "base/text.hpp"
#include "can/transport.hpp"

namespace conform::can {
namespace {

// While a frame waits: it is to be known when it left, because the device answers then.
constexpr Duration between_looks = std::chrono::milliseconds(10);

}  // namespace

TransmitWatch::TransmitWatch(std::string statistics) : statistics_(std::move(statistics)) { forget(); }

std::optional<std::uint64_t> TransmitWatch::gone() const {
  std::uint64_t sum = 0;
  for (const char* name : {"/tx_packets", "/tx_dropped", "/tx_errors"}) {
    const auto text = read_file(statistics_ + name, 1U << 16U);  // sysfs says that each file holds a page
    if (!text) return std::nullopt;
    const auto number = parse_number(trim(*text));
    if (!number) return std::nullopt;
    sum += *number;
  }
  return sum;
}

void TransmitWatch::took(BusTime now) {
  ++taken_;
  if (waiting_) return;
  waiting_ = taken_;
  waits_since_ = now;
}

std::optional<BusTime> TransmitWatch::next_look() const {
  if (!waiting_) return std::nullopt;
  return waits_since_ + (standing_ ? between_looks : host_is_late);
}

bool TransmitWatch::stands_still(BusTime now) {
  const auto look = next_look();
  if (!look || now < *look) return false;
  const auto current = gone();
  if (!current) {
    forget();
    return false;
  }
  const bool stood = standing_.has_value();
  const bool stands = *current < *waiting_;
  // Whoever sends what came later has lost what came before, and did not count it.
  const bool lost =
      stood && taken_ > standing_->taken && *current - standing_->gone >= taken_ - standing_->taken;
  if (*current >= taken_ || lost) {
    taken_ = *current;  // other programs may send as well
    waiting_.reset();
    standing_.reset();
  } else {
    if (!stands) waiting_ = taken_;
    if (!stands) standing_.reset();
    if (stands && !stood) standing_ = Standing{*current, taken_};
    waits_since_ = now;
  }
  return stands || stood;
}

void TransmitWatch::forget() {
  taken_ = gone().value_or(0);
  waiting_.reset();
  standing_.reset();
}

}  // namespace conform::can
