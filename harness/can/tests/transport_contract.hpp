// SPDX-License-Identifier: Apache-2.0
// The rules of transport.hpp as checks that every implementation must pass. The bench gives a fresh bus with
// a peer that answers data frames on 605h with the same bytes on 585h, and says nothing otherwise.
#pragma once

#include <functional>
#include <memory>

#include "can/transport.hpp"
#include "catch.hpp"

namespace conform::can::testing {

struct Bench {
  virtual ~Bench() = default;
  [[nodiscard]] virtual Transport& transport() = 0;
};

inline std::optional<BusEvent> receive_ok(Transport& transport, BusTime deadline) {
  auto event = transport.receive(deadline);
  if (!event) FAIL(event.error().text());
  return *event;
}

inline void check_transport_contract(const std::function<std::unique_ptr<Bench>()>& make) {
  using namespace std::chrono_literals;
  const auto bench = make();
  Transport& transport = bench->transport();
  const Frame request = data_frame(CanId(0x605), {0x40, 0x00, 0x10, 0x00, 1, 2, 3, 4});

  SECTION("silence lasts until the deadline and not a moment less") {
    const BusTime deadline = transport.now() + 20ms;
    CHECK_FALSE(receive_ok(transport, deadline).has_value());
    CHECK(transport.now() >= deadline);
  }
  SECTION("a deadline in the past polls and does not wait") {
    const BusTime before = transport.now();
    CHECK_FALSE(receive_ok(transport, before - 1s).has_value());
    CHECK_FALSE(receive_ok(transport, before).has_value());
  }
  SECTION("the own frame comes back as transmitted before the answer, and stamps order them") {
    const BusTime before = transport.now();
    REQUIRE(transport.send(request));
    const auto echo = receive_ok(transport, transport.now() + 10s);
    REQUIRE(echo.has_value());
    CHECK(echo->direction == Direction::transmitted);
    CHECK(echo->frame == request);
    CHECK(echo->time >= before);
    const auto answer = receive_ok(transport, transport.now() + 10s);
    REQUIRE(answer.has_value());
    CHECK(answer->direction == Direction::received);
    CHECK(answer->frame == data_frame(CanId(0x585), request.bytes()));
    CHECK(answer->time >= echo->time);
    CHECK(answer->time <= transport.now());
    CHECK(transport.health().frames_dropped == 0);
  }
  SECTION("an event stamped at the deadline is delivered") {
    REQUIRE(transport.send(request));
    const auto echo = receive_ok(transport, transport.now() + 10s);
    REQUIRE(echo.has_value());
    const auto answer = receive_ok(transport, transport.now() + 10s);
    REQUIRE(answer.has_value());
    // The stamp lies in the past now; a second round trip's answer is stamped later than this deadline.
    REQUIRE(transport.send(request));
    CHECK_FALSE(receive_ok(transport, answer->time - 1ns).has_value());
    CHECK(receive_ok(transport, transport.now() + 10s).has_value());
  }
  SECTION("own frames of every kind come back as they were sent, in order") {
    Frame extended = data_frame(CanId(0x12345678), {9});
    extended.extended = true;
    const std::vector<Frame> frames{data_frame(CanId(0x7FF), {}), data_frame(CanId(0x000), {0x81, 0x00}),
                                    remote_frame(CanId(0x705), 1), remote_frame(CanId(0x705), 0), extended};
    for (const Frame& frame : frames) REQUIRE(transport.send(frame));
    for (const Frame& frame : frames) {
      const auto event = receive_ok(transport, transport.now() + 10s);
      REQUIRE(event.has_value());
      CHECK(event->frame == frame);
      CHECK(event->direction == Direction::transmitted);
    }
  }
  SECTION("a hundred round trips lose nothing and time never goes back") {
    BusTime last = transport.now();
    for (std::uint8_t i = 0; i < 100; ++i) {
      REQUIRE(transport.send(data_frame(CanId(0x605), {i})));
      for (const auto direction : {Direction::transmitted, Direction::received}) {
        const auto event = receive_ok(transport, transport.now() + 10s);
        REQUIRE(event.has_value());
        REQUIRE(event->direction == direction);
        REQUIRE(event->frame.data[0] == i);
        REQUIRE(event->time >= last);
        last = event->time;
      }
    }
    CHECK(transport.health().frames_dropped == 0);
    CHECK(transport.health().error_frames == 0);
  }
  SECTION("error frames cannot be sent") {
    Frame frame;
    frame.error = true;
    CHECK_FALSE(transport.send(frame).has_value());
  }
  SECTION("the transport tells its name") { CHECK_FALSE(transport.info().name.empty()); }
}

}  // namespace conform::can::testing
