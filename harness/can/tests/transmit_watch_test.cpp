// SPDX-License-Identifier: Apache-2.0
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "can/transmit_watch.hpp"
#include "can/transport.hpp"
#include "catch.hpp"

using namespace conform;
using namespace conform::can;
using namespace std::chrono_literals;

namespace {

/// The counters of an interface, as the kernel shows them.
class Counters {
 public:
  Counters()
      : folder_(std::filesystem::temp_directory_path() / ("conform-counters-" + std::to_string(::getpid()))) {
    std::filesystem::create_directory(folder_);
    show(1000);
  }
  Counters(const Counters&) = delete;
  Counters& operator=(const Counters&) = delete;
  ~Counters() { std::filesystem::remove_all(folder_); }

  void show(int sent, int dropped = 0) const {
    std::ofstream(folder_ / "tx_packets") << sent << '\n';
    std::ofstream(folder_ / "tx_dropped") << dropped << '\n';
    std::ofstream(folder_ / "tx_errors") << 0 << '\n';
  }
  [[nodiscard]] std::string folder() const { return folder_.string(); }

 private:
  std::filesystem::path folder_;
};

BusTime at(Duration time) { return BusTime(time); }

}  // namespace

TEST_CASE("an interface that sends what it takes does not stand still") {
  const Counters counters;
  TransmitWatch watch(counters.folder());
  CHECK_FALSE(watch.next_look().has_value());
  watch.took(at(1ms));
  watch.took(at(2ms));
  CHECK(watch.next_look() == at(101ms));
  CHECK_FALSE(watch.stands_still(at(50ms)));
  counters.show(1002);
  CHECK_FALSE(watch.stands_still(at(101ms)));
  CHECK_FALSE(watch.next_look().has_value());
}

TEST_CASE("a frame that was handed over just now may still be on its way") {
  const Counters counters;
  TransmitWatch watch(counters.folder());
  watch.took(at(0ms));
  watch.took(at(99ms));
  counters.show(1001);
  CHECK_FALSE(watch.stands_still(at(100ms)));
  CHECK(watch.next_look() == at(200ms));
  CHECK(watch.stands_still(at(200ms)));
}

TEST_CASE("an interface that keeps a frame stands still until it has sent it") {
  const Counters counters;
  TransmitWatch watch(counters.folder());
  watch.took(at(0ms));
  CHECK(watch.stands_still(at(100ms)));
  watch.took(at(101ms));
  CHECK_FALSE(watch.stands_still(at(105ms)));  // no look yet
  CHECK(watch.stands_still(at(110ms)));
  counters.show(1002);
  CHECK(watch.next_look() == at(120ms));
  CHECK(watch.stands_still(at(120ms)));  // it left just now
  CHECK_FALSE(watch.next_look().has_value());
  CHECK_FALSE(watch.stands_still(at(300ms)));
}

TEST_CASE("a frame that was dropped or lost waits for nobody") {
  const Counters counters;
  TransmitWatch watch(counters.folder());
  watch.took(at(0ms));
  counters.show(1000, 1);
  CHECK_FALSE(watch.stands_still(at(100ms)));
  watch.took(at(1s));  // will never be counted
  CHECK(watch.stands_still(at(2s)));
  CHECK(watch.stands_still(at(3s)));
  watch.took(at(4s));
  counters.show(1001, 1);
  CHECK(watch.stands_still(at(5s)));
  CHECK_FALSE(watch.next_look().has_value());
  watch.took(at(6s));
  counters.show(1002, 1);
  CHECK_FALSE(watch.stands_still(at(7s)));
}

TEST_CASE("frames of other programs do not count as ours that wait, and an outage leaves nothing waiting") {
  const Counters counters;
  TransmitWatch watch(counters.folder());
  watch.took(at(0ms));
  counters.show(1050);
  CHECK_FALSE(watch.stands_still(at(100ms)));
  watch.took(at(1s));
  CHECK(watch.stands_still(at(2s)));
  watch.forget();
  CHECK_FALSE(watch.next_look().has_value());
  watch.took(at(3s));
  counters.show(1051);
  CHECK_FALSE(watch.stands_still(at(4s)));
}

TEST_CASE("an interface that tells no counters is never said to stand still") {
  TransmitWatch watch("/no/such/folder");
  watch.took(at(0ms));
  CHECK_FALSE(watch.stands_still(at(1s)));
}
